// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "base/constants.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "cli/requests.h"
#include "commands/film_text.h"
#include "commands/first_frame.h"
#include "commands/pixel_report.h"
#include "commands/results.h"
#include "files/npy.h"
#include "pictures/pictures.h"
#include "results/array_table.h"
#include "results/file_arrays.h"
#include "results/meta.h"
#include "run/file_pixel.h"
#include "run/input_kind.h"
#include "run/mcap_recording.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

struct Statistics {
  double low = 0, median = 0, high = 0;
  std::size_t count = 0, invalid = 0;  ///< elements; those that are not finite
};

/// In the array's own type: numbers of a byte do not become eight.
template <class T>
Statistics statistics_in(const files::NpyArray& array) {
  Statistics out;
  out.count = array.count();
  std::vector<T> values(out.count);
  if (out.count > 0) std::memcpy(values.data(), array.bytes.data(), out.count * sizeof(T));
  if (array.type.kind == 'b')
    std::transform(values.begin(), values.end(), values.begin(), [](T value) { return static_cast<T>(value != 0); });
  if constexpr (std::is_floating_point_v<T>) std::erase_if(values, [](T value) { return !std::isfinite(value); });
  out.invalid = out.count - values.size();
  if (values.empty()) {
    out.low = out.median = out.high = std::nan("");
    return out;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  out.median = static_cast<double>(*middle);
  out.low = static_cast<double>(*std::min_element(values.begin(), middle + 1));
  out.high = static_cast<double>(*std::max_element(middle, values.end()));
  return out;
}

Statistics statistics_of(const files::NpyArray& array) {
  const int size = array.type.size;
  switch (array.type.kind) {
    case 'f': return size == 4 ? statistics_in<float>(array) : statistics_in<double>(array);
    case 'i':
      return size == 1   ? statistics_in<std::int8_t>(array)
             : size == 2 ? statistics_in<std::int16_t>(array)
             : size == 4 ? statistics_in<std::int32_t>(array)
                         : statistics_in<std::int64_t>(array);
    default:
      return size == 1   ? statistics_in<std::uint8_t>(array)
             : size == 2 ? statistics_in<std::uint16_t>(array)
             : size == 4 ? statistics_in<std::uint32_t>(array)
                         : statistics_in<std::uint64_t>(array);
  }
}

std::string array_table(const results::Arrays& arrays) {
  std::string text = fmt::format("{:<24} {:<8} {:<16} {:<10} {:>11} {:>11} {:>11} {:>9}\n", "array", "type", "shape", "unit", "min",
                                 "median", "max", "invalid");
  for (const files::NamedArray& one : arrays.all()) {
    const files::NpyArray& array = one.array;
    if (array.type.kind == 'U') {
      text += fmt::format("{:<24} {:<8} {:<16} {}\n", one.name, array.type.name(), files::shape_text(array.shape), "text");
      continue;
    }
    const Statistics s = statistics_of(array);
    text += fmt::format("{:<24} {:<8} {:<16} {:<10} {:>11.5g} {:>11.5g} {:>11.5g} {:>9}\n", one.name, array.type.name(),
                        files::shape_text(array.shape), arrays.unit(one.name), s.low, s.median, s.high, s.invalid);
  }
  return text;
}

files::Json array_json(const results::Arrays& arrays) {
  files::Json list = files::Json::array();
  for (const files::NamedArray& one : arrays.all()) {
    const files::NpyArray& array = one.array;
    files::Json json = files::Json::object();
    json.set("name", one.name)
        .set("dtype", array.type.name())
        .set("shape", files::Json::list(array.shape))
        .set("unit", arrays.unit(one.name));
    if (const results::ArrayRow* known = results::find_array(one.name)) json.set("what", known->what);
    if (array.type.kind != 'U') {
      const Statistics s = statistics_of(array);
      json.set("min", s.low).set("median", s.median).set("max", s.high).set("invalid", s.invalid);
    }
    list.push(std::move(json));
  }
  return list;
}

std::string phase_table(const results::Arrays& arrays) {
  if (arrays.phases() == 0 || arrays.find("lit") == nullptr) return {};
  std::string text = fmt::format("\n{:<10} {:>4} {:>15} {:>14} {:>12} {:>10}\n", "raw frame", "lit", "modulation MHz", "reference deg",
                                 "exposure us", "start ms");
  for (std::size_t k = 0; k < arrays.phases(); ++k) {
    text += fmt::format("{:<10} {:>4} {:>15.6g} {:>14.6g} {:>12.6g} {:>10.5g}\n", k, arrays.at("lit", k) != 0 ? "yes" : "no",
                        1e-6 * arrays.at("modulation_frequency_hz", k), arrays.at("reference_phase_rad", k) * 180 / base::pi,
                        1e6 * arrays.at("integration_time_s", k), 1e3 * arrays.at("start_time_s", k));
  }
  return text;
}

files::Json phase_json(const results::Arrays& arrays) {
  files::Json list = files::Json::array();
  for (std::size_t k = 0; k < arrays.phases(); ++k) {
    files::Json json = files::Json::object();
    json.set("lit", arrays.at("lit", k) != 0);
    for (const char* name : {"modulation_frequency_hz", "reference_phase_rad", "integration_time_s", "start_time_s"})
      json.set(name, arrays.at(name, k));
    list.push(std::move(json));
  }
  return list;
}

/// How many pixels have each flag; a pixel can have several.
std::vector<std::size_t> flag_counts(const results::Arrays& arrays, std::size_t& valid) {
  std::vector<std::size_t> counts(flag_names().size());
  const files::NpyArray* flags = arrays.find("flags");
  valid = 0;
  for (std::size_t i = 0; flags != nullptr && i < flags->count(); ++i) {
    const auto bits = results::flag_bits(flags->number(i));
    if ((bits & flags_invalid) == 0) ++valid;
    for (std::size_t bit = 0; bit < counts.size(); ++bit) counts[bit] += bits >> bit & 1u;
  }
  return counts;
}

std::string flag_table(const results::Arrays& arrays) {
  const files::NpyArray* flags = arrays.find("flags");
  if (flags == nullptr) return {};
  std::size_t valid = 0;
  const std::vector<std::size_t> counts = flag_counts(arrays, valid);
  const double pixels = static_cast<double>(std::max<std::size_t>(1, flags->count()));
  std::string text = fmt::format("\n{:<26} {:>8} {:>7.1f} %\n", "pixels with a depth", valid, 100 * static_cast<double>(valid) / pixels);
  for (std::size_t bit = 0; bit < counts.size(); ++bit) {
    const pictures::FlagRow* const row = pictures::flag_of_bit(static_cast<int>(bit));
    const bool stays = row != nullptr && !row->invalid, warns = (flags_reasons >> bit & 1) != 0;
    const std::string effect = stays ? fmt::format("   ({})", warns ? "a warning, the depth stays" : row->what) : "";
    text += fmt::format("  {:<24} {:>8} {:>7.1f} %{}\n", flag_names()[bit], counts[bit], 100 * static_cast<double>(counts[bit]) / pixels,
                        effect);
  }
  return text;
}

files::Json flag_json(const results::Arrays& arrays) {
  std::size_t valid = 0;
  const std::vector<std::size_t> counts = flag_counts(arrays, valid);
  files::Json json = files::Json::object().set("valid", valid);
  for (std::size_t bit = 0; bit < counts.size(); ++bit) {
    std::string key = flag_names()[bit];
    std::replace(key.begin(), key.end(), ' ', '_');
    json.set(key, counts[bit]);
  }
  return json;
}

std::string word(const files::Json& from, const char* key, const char* inner = nullptr) {
  const files::Json* found = from.find(key);
  if (found != nullptr && inner != nullptr) found = found->find(inner);
  return found == nullptr ? "" : found->is_string() ? *found->string() : files::json_text(*found);
}

/// One line out of `meta`: what made the file.
std::string origin(const results::Arrays& arrays) {
  const files::Json& meta = arrays.meta();
  if (!meta.is_object()) return arrays.where() + "\n\n";
  const files::Json* camera = meta.find("camera");
  return fmt::format("{}: tofray {}, scene {}, camera {} in mode {}, frame {}, seed {}, noise {}\n\n", arrays.where(), word(meta, "tofray"),
                     word(meta, "scene", "name"), word(meta, "camera", "name"), camera == nullptr ? "" : word(*camera, "mode", "name"),
                     word(meta, "frame"), word(meta, "seed"), word(meta, "noise"));
}

/// Frames with fewer bounces take their time.
PixelBounces bounces_with_progress(const results::Arrays& arrays, run::FrameOrigin& origin, int u, int v) {
  if (!origin.in || !has_bounces(run::pixel_arrays(arrays), u, v)) return run::pixel_bounces(arrays, origin, u, v);
  FrameProgress now;
  origin.simulated.progress = &now;
  Progress progress(static_cast<std::uint64_t>(origin.in->scene.transport.bounces), "bounces", false, &now);
  return run::pixel_bounces(arrays, origin, u, v, [&] { progress.step(); });
}

/// A file's arrays; those of a scene are simulated now.
struct Inspected {
  results::Arrays arrays;
  run::FrameOrigin origin;  ///< only of a pixel is it asked for
};

Inspected inspected(const Options& options) {
  const NameChoice chosen = run::frame_or_scene(options.words[0], "inspect");
  const std::string& path = chosen.name;
  say(run::note_of(chosen));
  if (results::holds_arrays(path)) {
    run::refuse_missing(path);
    if (!options.set.empty() || options.seed || options.noise || !options.mode.empty())
      throw Error(
          ErrorKind::bad_input,
          path +
              ": error: this file is finished, its settings cannot be changed\n  expected a scene with --set, --mode, --seed and --noise");
    return {results::read_arrays(path), {}};
  }
  run::FrameOrigin origin;
  const run::Loaded& in = origin.in.emplace(run::load(input_request(path, options)));
  say(texts(in.remarks));
  const SimulatorOptions& wanted = origin.simulated = simulator_options(options);
  const Frame frame = first_frame(in, wanted);
  const std::string meta = results::frame_meta(in.scene, in.camera, wanted, 0);
  results::Arrays arrays(
      files::parse_npz(results::frame_npz_bytes(frame, in.camera, camera_pose(in.scene, frame.truth.time_s), meta), path), path);
  return {std::move(arrays), std::move(origin)};
}

void inspect_pixel(const Inspected& of, const Options& options) {
  const auto [u, v] = *options.pixel;
  const results::Arrays& arrays = of.arrays;
  const PixelChain chain = run::pixel_chain(arrays, u, v);
  const bool knows = of.origin.in.has_value() || arrays.find("gt_indirect_e") == nullptr;
  run::FrameOrigin origin = knows ? of.origin : run::origin_of_file(arrays.where(), options.root, simulator_options(options));
  const PixelBounces bounces = bounces_with_progress(arrays, origin, u, v);
  print(options.json ? files::json_text(pixel_json(arrays.where(), arrays.meta(), chain, bounces), 2) + "\n"
                     : pixel_text(arrays, chain, bounces));
}

/// The steps of a scene's frame, one a line.
std::string plan_text(const std::vector<PlanStep>& steps) {
  std::string text = fmt::format("{:>3} {:<16} {:<26} {:<58} {}\n", "#", "pass", "part", "what it does", "over");
  int number = 0;
  for (const PlanStep& one : steps)
    text += fmt::format("{:>3} {:<16} {:<26} {:<58} {} {}\n", ++number, one.name, one.part, one.does, one.pieces, one.over);
  return text;
}
files::Json plan_json(const std::vector<PlanStep>& steps) {
  files::Json all = files::Json::array();
  for (const PlanStep& one : steps) {
    all.push(files::Json::object()
                 .set("name", one.name)
                 .set("part", one.part)
                 .set("does", one.does)
                 .set("over", one.over)
                 .set("pieces", one.pieces));
  }
  return files::Json::object().set("plan", all);
}

int inspect_plan(const Options& options) {
  const std::string& path = options.words[0];
  if (run::is_film(path) || results::holds_arrays(path))
    throw Error(ErrorKind::bad_input, path + ": error: --plan is of scenes: this file is finished");
  if (options.pixel)
    throw Error(ErrorKind::bad_input, "error: --plan computes nothing, and --pixel asks for a frame\n  take one of them out");
  const run::Loaded in = run::load(input_request(path, options));
  say(texts(in.remarks));
  const std::vector<PlanStep> steps = Simulator(in.scene, in.camera, simulator_options(options)).plan();
  print(options.json ? files::json_text(plan_json(steps), 2) + "\n" : plan_text(steps));
  return 0;
}

}  // namespace

int run_inspect(const Options& options) {
  if (options.plan) return inspect_plan(options);
  if (run::is_film(options.words[0])) {
    if (options.pixel)
      throw Error(
          ErrorKind::bad_input,
          options.words[0] +
              ": error: --pixel is of frame.npz and of scenes\n  `tofray process` makes a frame_0000.npz of each frame's raw topics");
    return inspect_film(options.words[0], options.json);
  }
  const Inspected of = inspected(options);
  const results::Arrays& arrays = of.arrays;
  if (options.pixel) return inspect_pixel(of, options), 0;
  if (options.json) {
    files::Json json = files::Json::object();
    json.set("file", arrays.where())
        .set("arrays", array_json(arrays))
        .set("raw_frames", phase_json(arrays))
        .set("flags", flag_json(arrays));
    print(files::json_text(json.set("meta", arrays.meta()), 2) + "\n");
  } else {
    print(origin(arrays) + array_table(arrays) + phase_table(arrays) + flag_table(arrays));
  }
  return 0;
}

}  // namespace tofray::app
