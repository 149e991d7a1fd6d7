// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tofray/analysis.h"
#include "tofray/camera.h"
#include "tofray/file_record.h"
#include "tofray/frame.h"
#include "tofray/mcap.h"
#include "tofray/scene.h"
#include "tofray/simulator.h"

/// Runs: a scene with what is changed of it, simulated frame by frame into the files of a folder, as `tofray render` does. As load.h, of
/// libtofray_files. Nothing here prints.
namespace tofray {

/// Something worth telling of what goes on all the same.
struct Remark {
  bool warning = true;  ///< false: a note
  std::string where;    ///< the file it is about, or nothing
  std::string what;     ///< one line, complete in itself
  std::string more;     ///< what it means and how to mend it, one line; may be empty

  /// "FILE: warning: WHAT", a line; behind it MORE, another one.
  [[nodiscard]] std::string text() const;
};

/// What a simulation starts from: a scene and what to change of it and of its camera.
struct InputRequest {
  std::string scene;  ///< a scene's file, a built-in scene, or a mesh alone (.obj, .ply, .stl, .gltf, .glb)
  /// Dotted key and value as written in YAML, in order: {"camera.lens.f_number", "1.2"}.
  std::vector<std::pair<std::string, std::string>> set;
  std::string mode;  ///< mode of the camera; empty: the one that the scene names, or the profile's first
  std::string root;  ///< files that the scene names have to lie in or below its own folder, or in or below this one where it is not empty
  /// A manifest.json: where not empty, scene, profile and tables come from the texts in it, and `scene` does not count.
  std::string manifest = {};
};

/// Scene and camera, ready for a Simulator.
struct Inputs {
  Scene scene;
  Camera camera;
  std::vector<InputFile> files;  ///< the scene first
  std::vector<Remark> remarks;   ///< remarks on the inputs, which can be simulated all the same
};

/// Reads the scene and the camera that it asks for, with all that is changed of them.
/// @throws Error with every fault of a file at once, also (bad_input) for keys of light paths where no light bounces
Inputs load_inputs(const InputRequest& request);

/// Which files each frame gets.
struct FrameFileRequest {
  /// Out of npz, png, ply, and mcap: one run.mcap of all frames (run_0120.mcap from frame 120 on); none: the first three for one frame, npz for several.
  std::optional<std::vector<std::string>> emit = {};
  std::string arrays;            ///< arrays of frame.npz, as in `--arrays`: names, `all`, groups, with "," between; empty: all
  bool compress = false;         ///< frame.npz deflated
  bool light_theme = false;      ///< preview.png and raw.png on white
  int scale = 1;                 ///< scale of these pictures, 1…8
  MessageOptions messages = {};  ///< options of the messages in run.mcap
  std::optional<McapCompression> compression = {};  ///< compression of its chunks; none: the usual one
};

/// What a run is asked for.
struct RunRequest {
  InputRequest inputs;
  SimulatorOptions simulator;  ///< `arrays` and `progress` are the run's own
  /// Frames from `first_frame` on; none: one, whose files have no number in their names unless first_frame is more than 0.
  std::optional<std::uint64_t> frames = {};
  std::uint64_t first_frame = 0;
  FrameFileRequest files;
  std::filesystem::path folder;      ///< folder for the files; empty: the scene's name
  bool clean = false;                ///< remove what an earlier run left in the folder, where it is as that run wrote it
  std::vector<std::string> command;  ///< the command as it was typed, for readers of manifest.json
};

/// How a run went.
struct RunResult {
  std::filesystem::path folder;
  std::vector<FileRecord> files;  ///< manifest.json last
  std::uint64_t frames = 0;       ///< number of complete frames
  bool interrupted = false;       ///< fewer than were asked for
  std::vector<Remark> remarks;    ///< remarks on the inputs, the scene as the camera sees it, the frames, the folder
  Validity last;                  ///< validity of the last frame's depth
  RanOn ran_on;
  std::vector<std::pair<std::string, double>> timings_s;  ///< seconds by stage: prepare, simulate, write
};

/// Callbacks of a run. All of them may be left empty.
struct RunWatch {
  FrameProgress* progress = nullptr;               ///< progress of the frame under way; its `stop` ends the run with the last whole frame
  std::function<void(const Remark&)> remark = {};  ///< told each as soon as it is known
  std::function<void(const RanOn&)> started = {};  ///< told what computes, before the first frame
  /// Shown each frame when it is done (good until this returns), and told how many are.
  std::function<void(const Frame&, std::uint64_t)> frame_done = {};
};

/// Simulates, writes the frames' files while the next ones are computed, and manifest.json at last. The same request leaves the same bytes
/// (but for the manifest's times and machine), and those of `tofray render` with the same words.
/// @throws Error: (io) where the folder cannot be written; as load_inputs() and Simulator; nothing is half-written
RunResult render(const RunRequest& request, const RunWatch& watch = {});

/// What a manifest.json says was asked for: render() makes the same bytes of it. The folder, threads and machine are not in it.
/// @throws Error (bad_input, io) where it cannot be read, or a newer tofray wrote it
RunRequest request_of_manifest(const std::string& file);

}  // namespace tofray
