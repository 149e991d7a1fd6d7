// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "earlier_files.h"
#include "files/json.h"
#include "files/output_folder.h"
#include "inputs.h"
#include "options.h"
#include "remarks.h"
#include "results/frame_file.h"
#include "results/manifest.h"
#include "results/meta.h"
#include "tofray/analysis.h"
#include "tofray/frame.h"

/// What demo, render and process leave behind.
namespace tofray::app {

/// Seconds from one stage to the next, added up by name.
class Stopwatch {
 public:
  /// The time since the last call (or the start) belongs to `stage`.
  void lap(const std::string& stage);
  [[nodiscard]] const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }
  [[nodiscard]] double total() const;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
  std::vector<std::pair<std::string, double>> stages_;
};

/// How many pixels are invalid, and the first reason of each.
struct Validity {
  InvalidPixels pixels;
  /// "12 dark, 3 no surface"; empty where all are valid
  std::string reasons;
  /// Where fewer than half are valid, the reason of most, and what helps: "71 % dark: noise 0.11 m at the median; more light …"
  std::string advice;
  bool has_light = true;  ///< the camera's own has any power
  [[nodiscard]] bool few() const { return 2 * pixels.valid < pixels.pixels; }
};
/// @param wrong_cycles  whether they are told from flying pixels, which takes as long as to decode the frame
Validity validity(const Frame& frame, const Camera& camera, bool wrong_cycles = true);
/// "600 of 616 pixels have a depth; invalid: 16 dark", a line; those that the truth knows to be whole cycles off are none of them.
/// @param which  behind "pixels ": "of the last frame ", or nothing
std::string depth_text(const Validity& of, const char* which);
/// Name of each bit of Depth::flags, from bit 0.
const std::vector<std::string>& flag_names();

/// Which files each frame gets, and what they tell of where it comes from.
struct FrameFiles {
  /// @param emit  out of npz, png, ply, where the user has not said
  /// @throws Error (bad_input) where --arrays or --compress is of files that --emit leaves out
  FrameFiles(const Options& options, const std::vector<std::string>& emit, const Inputs& inputs, const SimulatorOptions& simulated);
  /// What the files and the summary are made of, as SimulatorOptions::arrays has it: what pixels see of the scene is always among it.
  [[nodiscard]] std::vector<std::string> needed_arrays() const;
  /// … and histograms of light by path length.
  [[nodiscard]] bool need_transient() const;

  std::vector<std::string> emit;
  results::FrameFileOptions npz;
  const Inputs& inputs;
  results::FrameMeta meta;
  pictures::Theme theme;
  int scale;  ///< of preview.png and raw.png
};

/// Writes the files of one frame, each name with `suffix` before its extension. Arrays that the frame does not have are left out.
/// Several threads may write to a folder at once.
/// @param memory  used again by the next frame
/// @return what was written, to be added to the folder
std::vector<files::FileRecord> write_frame(const files::OutputFolder& folder, const FrameFiles& what, const std::string& suffix,
                                           const Frame& frame, std::string& memory);
/// The same for a single frame; the folder knows its files then.
void write_frame(files::OutputFolder& folder, const FrameFiles& what, const Frame& frame);

/// The line above a picture: "room seen by pico-flexx MODE_9_5FPS_2000, frame 3".
/// @param numbered  whether the frame is one of a series
std::string caption_of(const std::string& scene, const std::string& camera, const std::string& mode, std::uint64_t frame, bool numbered);

/// Warns where depth.png is written and cannot hold all that has a depth. @param pixels  how many, of all frames
void warn_of_depth_png(const FrameFiles& what, std::size_t pixels, Remarks& remarks);

/// The GPU's name; empty where the processor computed.
std::string gpu_of(const RanOn& machine);
/// "avx512 on 2 threads", "NVIDIA H200".
std::string machine_text(const RanOn& machine);

/// One line on stderr where the backend was left to choose and no GPU is used: if `auto` was typed, or if there is a GPU all the same.
void say_fallback(const Options& options, const RanOn& machine, Remarks& remarks);

/// Writes manifest.json, last of all: what made the other files.
/// @param interrupted_after  how many frames are complete where the run did not come to its end
/// @param left  what lay in the folder before: what of it stays is told, or removed where --clean says so
void write_manifest(files::OutputFolder& folder, const Options& options, const std::vector<results::InputFile>& inputs,
                    const RanOn& machine, const Stopwatch& stopwatch, EarlierFiles& left, Remarks& remarks,
                    std::optional<std::uint64_t> interrupted_after = {});

/// How a run went, for --json and for people.
/// @param remarks  the warnings and notes that were said
files::Json summary_json(const files::OutputFolder& folder, const Validity& last, std::uint64_t frames, const RanOn& machine,
                         const Stopwatch& stopwatch, const Remarks& remarks);
/// Which picture to look at, on a line of its own; nothing where there is none.
std::string picture_to_open(const files::OutputFolder& folder);
std::string summary_text(const files::OutputFolder& folder, const Validity& last, std::uint64_t frames, const RanOn& machine,
                         const Stopwatch& stopwatch);

}  // namespace tofray::app
