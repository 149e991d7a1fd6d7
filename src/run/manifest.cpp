// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/manifest.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>

#include "base/text.h"
#include "base/version.h"
#include "messages/topics.h"
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
  /// Which of some words.
  [[nodiscard]] std::size_t one_of(const std::vector<std::string>& words) const {
    const auto found = std::find(words.begin(), words.end(), value);
    if (found == words.end()) refuse(base::listed(words));
    return static_cast<std::size_t>(found - words.begin());
  }
  [[nodiscard]] double number() const {
    double out = 0;
    const char* const end = value.data() + value.size();
    const auto read = std::from_chars(value.data(), end, out);
    if (read.ec != std::errc() || read.ptr != end) refuse("a number");
    return out;
  }
  [[nodiscard]] std::vector<std::string> kinds() const {
    std::vector<std::string> out = words_of(value);
    for (const std::string& one : out)
      if (one != "npz" && one != "png" && one != "ply" && one != "mcap") refuse("some of npz, png, ply, mcap, with \",\" between");
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
  else if (key == "driver")
    out.files.messages.driver = static_cast<Driver>(option.one_of(driver_words()));
  else if (key == "stamp")
    out.files.messages.stamp = static_cast<StampAt>(option.one_of(stamp_words()));
  else if (key == "camera-name")
    out.files.messages.name = option.value;
  else if (key == "topics")
    out.files.messages.topics = words_of(option.value);
  else if (key == "depth-encoding")
    out.files.messages.depth_encoding = option.value;
  else if (key == "unorganized")
    out.files.messages.unorganized = option.is("on", "off");
  else if (key == "amplitude-step")
    out.files.messages.amplitude_step_e = option.number();
  else if (key == "epoch")
    out.files.messages.epoch_s = option.number();
  else if (key == "mcap-compression")
    out.files.compression = option.is("zstd", "none") ? McapCompression::zstd : McapCompression::none;
  else if (key == "frames")
    out.frames = option.whole(1, most_frames);
  else if (key == "first-frame")
    out.first_frame = option.whole(0, most_frames);
  else
    return false;
  return true;
}

}  // namespace

const std::vector<std::string>& driver_words() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> words;
    for (const messages::Profile& one : messages::profiles()) words.emplace_back(one.word);
    return words;
  }();
  return all;
}

const std::vector<std::string>& stamp_words() {
  static const std::vector<std::string> all = {"start", "middle", "end"};
  return all;
}

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
  const MessageOptions& messages = files.messages;
  add(messages.driver != Driver::plain, "driver", driver_words()[static_cast<std::size_t>(messages.driver)]);
  add(messages.stamp != StampAt::middle, "stamp", stamp_words()[static_cast<std::size_t>(messages.stamp)]);
  add(!messages.name.empty(), "camera-name", messages.name);
  add(!messages.topics.empty(), "topics", joined(messages.topics));
  add(!messages.depth_encoding.empty(), "depth-encoding", messages.depth_encoding);
  add(messages.unorganized, "unorganized", "on");
  add(messages.amplitude_step_e != 0, "amplitude-step", base::number_text(messages.amplitude_step_e));
  add(messages.epoch_s != 0, "epoch", base::number_text(messages.epoch_s));
  if (files.compression) add(true, "mcap-compression", *files.compression == McapCompression::zstd ? "zstd" : "none");
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
