// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tofray/file_record.h"

/// manifest.json: what made the files of a folder, and all it takes to make the same bytes again.
namespace tofray::results {

struct Manifest {
  std::string tofray_version;        ///< version() of the writer
  std::vector<std::string> command;  ///< for people: the command line as it was typed
  // what is needed to make the same bytes again
  std::vector<InputFile> inputs;                             ///< the scene first
  std::vector<std::pair<std::string, std::string>> set;      ///< --set, in order
  std::vector<std::pair<std::string, std::string>> options;  ///< other options that change the bytes: mode, noise, frames, emit …
  std::uint64_t seed = 0;
  // what it ran on; none of it changes the bytes
  std::string backend;  ///< "cpu" or "cuda"
  std::string gpu;      ///< its name; empty where the processor computed
  std::string cpu_model;
  std::string isa;  ///< RanOn::isa
  int threads = 0;
  std::vector<std::pair<std::string, double>> timings_s;  ///< by stage
  std::vector<FileRecord> files;                          ///< every other file of the folder that this run wrote
  /// Files of earlier runs that lie in the folder besides, as far as they are known.
  std::vector<FileRecord> earlier_files;
  /// Frames that were complete when the run was interrupted, all of them in `files`; none where it came to its end. For people and
  /// scripts: `--from` makes the whole run.
  std::optional<std::uint64_t> interrupted_after_frames;
};

/// What /proc/cpuinfo calls the first processor: its "model name"; of ARM, which has none there, the numbers of its maker and its design;
/// else "unknown".
std::string cpu_model();
std::string cpu_model_in(std::string_view cpuinfo);

std::string manifest_text(const Manifest& manifest);

/// Reads the text of a manifest. @throws Error (bad_input) that names every key that is missing or of another kind
Manifest parse_manifest(std::string_view text, const std::string& path);

/// Reads a manifest for `--from`. @throws Error as parse_manifest, and (io) where the file cannot be read
Manifest read_manifest(const std::string& path);

}  // namespace tofray::results
