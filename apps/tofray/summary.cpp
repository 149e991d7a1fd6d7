// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>

#include "base/text.h"
#include "base/version.h"
#include "files/json.h"
#include "results.h"
#include "results/meta.h"

namespace tofray::app {

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
  return text;
}

/// "1.2 MB".
std::string size_text(double bytes) {
  const char* const units[] = {"bytes", "kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  while (bytes >= 1000 && unit < 4) bytes /= 1000, ++unit;
  return fmt::format("{:.{}f} {}", bytes, unit == 0 ? 0 : 1, units[unit]);
}

double stage_seconds(const Stopwatch& stopwatch, const char* stage) {
  for (const auto& [name, seconds] : stopwatch.stages()) {
    if (name == stage) return seconds;
  }
  return 0;
}

/// Frames per second: while they were computed, and with what the run had to wait for files besides.
struct Rates {
  double computed, written;
};

Rates rates_of(std::uint64_t frames, const Stopwatch& stopwatch) {
  const double computing = stage_seconds(stopwatch, "simulate") + stage_seconds(stopwatch, "process");
  return {static_cast<double>(frames) / computing, static_cast<double>(frames) / (computing + stage_seconds(stopwatch, "write"))};
}

}  // namespace

void write_manifest(files::OutputFolder& folder, const Options& options, const std::vector<results::InputFile>& inputs,
                    const RanOn& machine, const Stopwatch& stopwatch, EarlierFiles& left, Remarks& remarks,
                    std::optional<std::uint64_t> interrupted_after) {
  results::Manifest manifest;
  manifest.tofray_version = base::version();
  manifest.command = options.typed;
  manifest.inputs = inputs;
  manifest.set = options.set;
  if (!options.mode.empty()) manifest.options.emplace_back("mode", options.mode);
  if (options.noise) manifest.options.emplace_back("noise", results::noise_name(*options.noise));
  if (options.exposure_samples) manifest.options.emplace_back("exposure-samples", std::to_string(*options.exposure_samples));
  if (options.subpixel) manifest.options.emplace_back("subpixel", std::to_string(*options.subpixel));
  if (options.emit) manifest.options.emplace_back("emit", joined(*options.emit));
  if (options.theme == pictures::Theme::light) manifest.options.emplace_back("theme", "light");
  if (options.scale != 1) manifest.options.emplace_back("scale", std::to_string(options.scale));
  if (!options.arrays.empty()) manifest.options.emplace_back("arrays", options.arrays);
  if (options.compress) manifest.options.emplace_back("compress", "on");
  if (options.frames) manifest.options.emplace_back("frames", std::to_string(*options.frames));
  if (options.first_frame > 0) manifest.options.emplace_back("first-frame", std::to_string(options.first_frame));
  manifest.seed = options.seed.value_or(0);
  manifest.backend = machine.backend;
  manifest.gpu = gpu_of(machine);
  manifest.cpu_model = results::cpu_model();
  manifest.isa = machine.isa;
  manifest.threads = machine.threads;
  manifest.timings_s = stopwatch.stages();
  manifest.files = folder.files();
  manifest.interrupted_after_frames = interrupted_after;
  left.settle(folder, options.clean, manifest, remarks);
  folder.write("manifest.json", results::manifest_text(manifest));
}

files::Json summary_json(const files::OutputFolder& folder, const Validity& last, std::uint64_t frames, const RanOn& machine,
                         const Stopwatch& stopwatch, const Remarks& remarks) {
  files::Json files = files::Json::array(), timings = files::Json::object();
  for (const files::FileRecord& file : folder.files())
    files.push(files::Json::object().set("name", file.name).set("bytes", file.bytes).set("sha256", file.sha256));
  for (const auto& [stage, seconds] : stopwatch.stages()) timings.set(stage, seconds);
  const Rates rates = rates_of(frames, stopwatch);
  files::Json json = files::Json::object();
  json.set("computed_frames_per_s", rates.computed).set("written_frames_per_s", rates.written);
  files::Json invalid = files::Json::object();
  for (std::size_t i = 0; i < no_depth_count; ++i) {
    const auto reason = static_cast<NoDepth>(i);
    std::string name = no_depth_name(reason);
    std::replace(name.begin(), name.end(), ' ', '_');
    invalid.set(name, last.pixels.count(reason));
  }
  json.set("folder", folder.path().native()).set("frames", frames).set("pixels", last.pixels.pixels).set("valid_pixels", last.pixels.valid);
  json.set("invalid_pixels", std::move(invalid))
      .set("valid_beyond_ambiguity_range", last.pixels.wrapped)
      .set("valid_on_wrong_cycle", last.pixels.valid_on_wrong_cycle)
      .set("advice", last.advice);
  remarks.put(json);
  return json.set("backend", machine.backend)
      .set("gpu", gpu_of(machine))
      .set("isa", machine.isa)
      .set("threads", machine.threads)
      .set("timings_s", std::move(timings))
      .set("files", std::move(files));
}

std::string picture_to_open(const files::OutputFolder& folder) {
  std::string preview;
  bool depth = false;
  for (const files::FileRecord& file : folder.files()) {
    if (preview.empty() && file.name.starts_with("preview")) preview = (folder.path() / file.name).native();
    depth = depth || file.name.starts_with("depth");
  }
  if (preview.empty()) return {};
  return fmt::format("open {}{}\n", base::printable(preview),
                     depth ? "   # the picture; depth.png is for programs: 16-bit mm, black in viewers" : "");
}

std::string summary_text(const files::OutputFolder& folder, const Validity& last, std::uint64_t frames, const RanOn& machine,
                         const Stopwatch& stopwatch) {
  double bytes = 0;
  for (const files::FileRecord& file : folder.files()) bytes += static_cast<double>(file.bytes);
  std::string text = fmt::format("{} files, {}, in {}\n", folder.files().size(), size_text(bytes), folder.path().native());
  text += depth_text(last, frames > 1 ? "of the last frame " : "");
  if (!last.advice.empty()) text += fmt::format("  {}\n", last.advice);
  const Rates rates = rates_of(frames, stopwatch);
  if (frames > 1)
    text += fmt::format("{} frames in {:.2f} s: {:.1f} frames/s computed, {:.1f} written", frames, stopwatch.total(), rates.computed,
                        rates.written);
  else
    text += fmt::format("{:.2f} s", stopwatch.total());
  return text + fmt::format(" with {}\n", machine_text(machine)) + picture_to_open(folder);
}

}  // namespace tofray::app
