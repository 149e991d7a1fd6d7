// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/manifest.h"

#include <fmt/core.h>

#include <charconv>

#include "base/text.h"
#include "base/version.h"
#include "results/meta.h"
#include "tofray/error.h"

namespace tofray::run {

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
  return text;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(',', from), text.size());
    out.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return out;
}

/// One option of a manifest.
struct Option {
  const std::string &file, &key, &value;

  [[noreturn]] void refuse(const std::string& expected) const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: error: option {} cannot be {}\n  expected {}", base::printable(file),
                                                  base::in_quotes(key), base::in_quotes(value), expected));
  }
  /// A whole number of low … high.
  [[nodiscard]] std::uint64_t whole(std::uint64_t low, std::uint64_t high) const {
    std::uint64_t number = 0;
    const char* const end = value.data() + value.size();
    const auto read = std::from_chars(value.data(), end, number);
    if (read.ec != std::errc() || read.ptr != end || number < low || number > high)
      refuse(fmt::format("a whole number of {} to {}", low, high));
    return number;
  }
  /// Which of two words it is.
  [[nodiscard]] bool is(const char* word, const char* other) const {
    if (value != word && value != other) refuse(fmt::format("{} or {}", word, other));
    return value == word;
  }
  [[nodiscard]] std::vector<std::string> kinds() const {
    std::vector<std::string> out = words_of(value);
    for (const std::string& one : out)
      if (one != "npz" && one != "png" && one != "ply") refuse("some of npz, png, ply, with \",\" between");
    return out;
  }
};

/// Whether the option is known.
bool take(const Option& option, RunRequest& out) {
  const std::string& key = option.key;
  if (key == "mode")
    out.inputs.mode = option.value;
  else if (key == "noise")
    out.simulator.noise = option.is("off", "exact") ? Noise::off : Noise::exact;
  else if (key == "exposure-samples")
    out.simulator.exposure_samples = static_cast<int>(option.whole(1, 1000));
  else if (key == "subpixel")
    out.simulator.subpixel = static_cast<int>(option.whole(1, 16));
  else if (key == "emit")
    out.files.emit = option.kinds();
  else if (key == "arrays")
    out.files.arrays = option.value;
  else if (key == "compress")
    out.files.compress = option.is("on", "off");
  else if (key == "theme")
    out.files.light_theme = option.is("light", "dark");
  else if (key == "scale")
    out.files.scale = static_cast<int>(option.whole(1, 8));
  else if (key == "frames")
    out.frames = option.whole(1, most_frames);
  else if (key == "first-frame")
    out.first_frame = option.whole(0, most_frames);
  else
    return false;
  return true;
}

}  // namespace

results::Manifest manifest_of(const RunRequest& request) {
  const SimulatorOptions& simulator = request.simulator;
  const FrameFileRequest& files = request.files;
  results::Manifest out;
  out.tofray_version = base::version();
  out.command = request.command;
  out.set = request.inputs.set;
  out.seed = simulator.seed;
  const auto add = [&](bool differs, const char* key, const std::string& value) {
    if (differs) out.options.emplace_back(key, value);
  };
  add(!request.inputs.mode.empty(), "mode", request.inputs.mode);
  add(simulator.noise != Noise::exact, "noise", results::noise_name(simulator.noise));
  add(simulator.exposure_samples != 1, "exposure-samples", std::to_string(simulator.exposure_samples));
  add(simulator.subpixel != 1, "subpixel", std::to_string(simulator.subpixel));
  if (files.emit) add(true, "emit", joined(*files.emit));
  add(files.light_theme, "theme", "light");
  add(files.scale != 1, "scale", std::to_string(files.scale));
  add(!files.arrays.empty(), "arrays", files.arrays);
  add(files.compress, "compress", "on");
  if (request.frames) add(true, "frames", std::to_string(*request.frames));
  add(request.first_frame > 0, "first-frame", std::to_string(request.first_frame));
  return out;
}

RunRequest request_of(const results::Manifest& manifest, const std::string& file) {
  for (const auto& [key, value] : manifest.options)
    if (key == "vary")
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: error: this is the manifest of a sweep\n  expected that of a `tofray render`; its command makes the "
                              "sweep again",
                              base::printable(file)));
  RunRequest out;
  out.inputs.manifest = file;
  out.inputs.set = manifest.set;
  if (!manifest.inputs.empty()) out.inputs.scene = manifest.inputs[0].name;
  out.simulator.seed = manifest.seed;
  for (const auto& [key, value] : manifest.options)
    if (!take({file, key, value}, out))
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: error: unknown option {}\n  a newer tofray wrote this", base::printable(file), base::in_quotes(key)));
  return out;
}

}  // namespace tofray::run

namespace tofray {

RunRequest request_of_manifest(const std::string& file) { return run::request_of(results::read_manifest(file), file); }

}  // namespace tofray
