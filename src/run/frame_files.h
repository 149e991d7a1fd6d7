// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "files/output_folder.h"
#include "pictures/pictures.h"
#include "results/frame_file.h"
#include "results/meta.h"
#include "run/inputs.h"
#include "tofray/frame.h"
#include "tofray/mcap.h"
#include "tofray/run.h"

/// The files of a frame: frame.npz, depth.png, amplitude.png, raw.png, preview.png, cloud.ply.
namespace tofray::run {

/// Which files each frame gets, and what they tell of where it comes from.
struct FrameFiles {
  /// @param otherwise  which kinds of files, out of npz, png, ply, mcap, where the request does not say
  /// @throws Error (bad_input) where arrays or compression is of files that the request leaves out
  FrameFiles(const FrameFileRequest& request, const std::vector<std::string>& otherwise, const Loaded& inputs,
             const SimulatorOptions& simulated);
  /// What the files and the summary are made of, as SimulatorOptions::arrays has it: what pixels see of the scene is always among it.
  [[nodiscard]] std::vector<std::string> needed_arrays() const;
  /// Whether they need histograms of light by path length.
  [[nodiscard]] bool need_transient() const;
  [[nodiscard]] bool emits(std::string_view kind) const;

  std::vector<std::string> emit;
  results::FrameFileOptions npz;
  const Loaded& inputs;
  results::FrameMeta meta;
  pictures::Theme theme;
  int scale;  ///< of preview.png and raw.png
  MessageOptions messages;
  McapCompression compression;
  std::vector<std::string> needed_messages;  ///< arrays that run.mcap is made of
};

/// Writes the files of one frame, each name with `suffix` before its extension. Arrays that the frame does not have are left out.
/// Several threads may write to a folder at once.
/// @param memory  used again by the next frame
/// @return what was written, to be added to the folder
std::vector<FileRecord> write_frame(const files::OutputFolder& folder, const FrameFiles& what, const std::string& suffix,
                                    const Frame& frame, std::string& memory);
/// Writes the files of a single frame, and tells the folder of them.
void write_frame(files::OutputFolder& folder, const FrameFiles& what, const Frame& frame);

/// The line above a picture: "room seen by pico-flexx MODE_9_5FPS_2000, frame 3".
/// @param numbered  whether the frame is one of a series
std::string caption_of(const std::string& scene, const std::string& camera, const std::string& mode, std::uint64_t frame, bool numbered);

/// Where depth.png is written and cannot hold all that has a depth. @param pixels  how many, of all frames
std::vector<Remark> depth_png_remarks(const FrameFiles& what, std::size_t pixels);

}  // namespace tofray::run
