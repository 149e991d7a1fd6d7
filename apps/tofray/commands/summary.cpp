// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>

#include "base/text.h"
#include "commands/results.h"
#include "files/json.h"

namespace tofray::app {

namespace {

/// "1.2 MB".
std::string size_text(double bytes) {
  const char* const units[] = {"bytes", "kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  while (bytes >= 1000 && unit < 4) bytes /= 1000, ++unit;
  return fmt::format("{:.{}f} {}", bytes, unit == 0 ? 0 : 1, units[unit]);
}

double stage_seconds(const RunResult& result, const char* stage) {
  for (const auto& [name, seconds] : result.timings_s) {
    if (name == stage) return seconds;
  }
  return 0;
}

/// Frames per second: while they were computed, and with what the run had to wait for files besides.
struct Rates {
  double computed, written;
};

Rates rates_of(const RunResult& result) {
  const auto frames = static_cast<double>(result.frames);
  const double computing = stage_seconds(result, "simulate") + stage_seconds(result, "process");
  return {frames / computing, frames / (computing + stage_seconds(result, "write"))};
}

}  // namespace

double total_time(const RunResult& result) {
  double sum = 0;
  for (const auto& [stage, seconds] : result.timings_s) sum += seconds;
  return sum;
}

files::Json summary_json(const RunResult& result, const Remarks& remarks) {
  files::Json files = files::Json::array(), timings = files::Json::object();
  for (const FileRecord& file : result.files)
    files.push(files::Json::object().set("name", file.name).set("bytes", file.bytes).set("sha256", file.sha256));
  for (const auto& [stage, seconds] : result.timings_s) timings.set(stage, seconds);
  const Rates rates = rates_of(result);
  files::Json json = files::Json::object();
  json.set("computed_frames_per_s", rates.computed).set("written_frames_per_s", rates.written);
  files::Json invalid = files::Json::object();
  for (std::size_t i = 0; i < no_depth_count; ++i) {
    const auto reason = static_cast<NoDepth>(i);
    std::string name = no_depth_name(reason);
    std::replace(name.begin(), name.end(), ' ', '_');
    invalid.set(name, result.last.pixels.count(reason));
  }
  json.set("folder", result.folder.native())
      .set("frames", result.frames)
      .set("pixels", result.last.pixels.pixels)
      .set("valid_pixels", result.last.pixels.valid);
  json.set("invalid_pixels", std::move(invalid))
      .set("valid_beyond_ambiguity_range", result.last.pixels.wrapped)
      .set("valid_on_wrong_cycle", result.last.pixels.valid_on_wrong_cycle)
      .set("advice", result.last.advice);
  remarks.put(json);
  return json.set("backend", result.ran_on.backend)
      .set("gpu", gpu_of(result.ran_on))
      .set("isa", result.ran_on.isa)
      .set("threads", result.ran_on.threads)
      .set("timings_s", std::move(timings))
      .set("files", std::move(files));
}

std::string picture_to_open(const RunResult& result) {
  std::string preview;
  bool depth = false;
  for (const FileRecord& file : result.files) {
    if (preview.empty() && file.name.starts_with("preview")) preview = (result.folder / file.name).native();
    depth = depth || file.name.starts_with("depth");
  }
  if (preview.empty()) return {};
  return fmt::format("open {}{}\n", base::printable(preview),
                     depth ? "   # the picture; depth.png is for programs: 16-bit mm, black in viewers" : "");
}

std::string summary_text(const RunResult& result) {
  double bytes = 0;
  for (const FileRecord& file : result.files) bytes += static_cast<double>(file.bytes);
  std::string text = fmt::format("{} files, {}, in {}\n", result.files.size(), size_text(bytes), result.folder.native());
  text += depth_text(result.last, result.frames > 1 ? "of the last frame " : "");
  if (!result.last.advice.empty()) text += fmt::format("  {}\n", result.last.advice);
  const Rates rates = rates_of(result);
  if (result.frames > 1)
    text += fmt::format("{} frames in {:.2f} s: {:.1f} frames/s computed, {:.1f} written", result.frames, total_time(result),
                        rates.computed, rates.written);
  else
    text += fmt::format("{:.2f} s", total_time(result));
  return text + fmt::format(" with {}\n", machine_text(result.ran_on)) + picture_to_open(result);
}

}  // namespace tofray::app
