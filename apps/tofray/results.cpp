// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "results.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "backend/cuda/cuda.h"
#include "base/text.h"
#include "base/units.h"
#include "console.h"
#include "pictures/pictures.h"
#include "results/array_table.h"
#include "results/ply.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

/// Bytes that are not UTF-8 replaced as JSON replaces them: a scene that comes from a manifest has the same caption.
std::string as_utf8(const std::string& name) { return *files::parse_json(files::json_text(files::Json(name)), "name").string(); }

}  // namespace

std::string caption_of(const std::string& scene, const std::string& camera, const std::string& mode, std::uint64_t frame, bool numbered) {
  std::string text = fmt::format("{} seen by {}", as_utf8(scene), camera);
  if (!mode.empty()) text += " " + mode;
  if (numbered || frame > 0) text += fmt::format(", frame {}", frame);
  return text;
}

std::string gpu_of(const RanOn& machine) { return machine.backend == "cuda" ? machine.device : ""; }

std::string machine_text(const RanOn& machine) {
  if (machine.backend == "cuda") return machine.device;
  return fmt::format("{} on {} thread{}", machine.isa, machine.threads, machine.threads == 1 ? "" : "s");
}

void say_fallback(const Options& options, const RanOn& machine, Remarks& remarks) {
  const std::string& reason = machine.fallback_reason;
  if (reason.empty() || (!options.backend && !backend::why_no_cuda(options.device).gpu_present)) return;
  remarks.tell(fmt::format("note: the processor computes, not a GPU: {}\n", reason));
}

void Stopwatch::lap(const std::string& stage) {
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - last_).count();
  last_ = now;
  for (auto& [name, sum] : stages_) {
    if (name == stage) {
      sum += seconds;
      return;
    }
  }
  stages_.emplace_back(stage, seconds);
}

double Stopwatch::total() const {
  double sum = 0;
  for (const auto& [name, seconds] : stages_) sum += seconds;
  return sum;
}

const std::vector<std::string>& flag_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (int bit = 0; bit < pictures::flag_count; ++bit) all.emplace_back(pictures::flag_name(bit));
    return all;
  }();
  return names;
}

namespace {

/// Median of the noise of the pixels that are invalid for too little light [m], but for those of which truth says that nothing is there;
/// NaN where none has one.
double median_noise(const Frame& frame) {
  const Depth& depth = frame.depth;
  const bool knows = frame.truth.object_id.size() == depth.flags.size();
  std::vector<float> noise;
  for (std::size_t i = 0; i < depth.flags.size(); ++i) {
    const bool low = 1 << std::max(pictures::invalid_reason(depth.flags[i]), 0) == flag_low_signal;
    if (low && std::isfinite(depth.noise_m[i]) && (!knows || frame.truth.object_id[i] >= 0)) noise.push_back(depth.noise_m[i]);
  }
  if (noise.empty()) return std::nan("");
  const auto middle = noise.begin() + static_cast<std::ptrdiff_t>(noise.size() / 2);
  std::nth_element(noise.begin(), middle, noise.end());
  return static_cast<double>(*middle);
}

bool has_light(const Camera& camera) {
  return std::any_of(camera.illumination.begin(), camera.illumination.end(), [](const Illumination& one) { return one.power_w > 0; });
}

std::string more_light(const Frame& frame, const Camera& camera) {
  if (!has_light(camera)) return "the camera has no light: see camera.illumination";
  const double noise = median_noise(frame);
  return (std::isnan(noise) ? "" : fmt::format("noise {:.2g} m at the median; ", noise)) +
         fmt::format("more light, a longer integration time, or a higher camera.decoding.noise_threshold (now {})",
                     base::quantity_text(camera.decoding.noise_threshold_m, "1 mm"));
}

std::string whole_cycles(const InvalidPixels& pixels) {
  std::vector<std::string> ranges;
  for (const double range : pixels.ranges_m) ranges.push_back(fmt::format("{:.3f} m", range));
  return fmt::format("noise moves these by whole cycles, of {}: more light, a longer integration time{}", base::listed(ranges, "and"),
                     ranges.size() > 1 ? ", or modulation frequencies in a ratio of smaller whole numbers" : "");
}

/// What helps against a reason why pixels are invalid.
std::string help_against(NoDepth reason, const InvalidPixels& pixels, const Frame& frame, const Camera& camera) {
  switch (reason) {
    case NoDepth::saturated: return "less light, a shorter integration time, or more distance";
    case NoDepth::no_surface:
      return "the rays of these pixels hit nothing: more light does not help; see camera.pose, or add a wall or a floor";
    case NoDepth::beyond_reach:
      return fmt::format("surfaces farther than the ambiguity range of {:.3f} m: a smaller scene, or a mode of a longer range",
                         pixels.ambiguity_range_m);
    case NoDepth::dark:
    case NoDepth::low_signal: return more_light(frame, camera);
    case NoDepth::no_return: return "no light comes back: nothing is there, it is dark, or out of the light's reach";
    case NoDepth::wrong_cycle: return whole_cycles(pixels);
    case NoDepth::flying_pixel:
      return "surfaces that are seen at a glancing angle, or thinner than a few pixels; camera.decoding says what is one";
    case NoDepth::outside_lens: return "the lens model has no rays there: see camera.lens.distortion";
    case NoDepth::inconsistent_phases: return "something moves, or camera.decoding.asymmetry rejects too much";
    case NoDepth::inconsistent_frequencies: return "light on several ways, a wrong cycle, or camera.decoding.multipath rejects too much";
  }
  return "see flags";
}

}  // namespace

Validity validity(const Frame& frame, const Camera& camera, bool wrong_cycles) {
  Validity out{invalid_pixels(frame, camera, wrong_cycles), {}, {}, has_light(camera)};
  NoDepth most{};
  for (std::size_t i = 0; i < no_depth_count; ++i) {
    const auto reason = static_cast<NoDepth>(i);
    const std::int64_t count = out.pixels.count(reason);
    if (count > 0) out.reasons += fmt::format("{}{} {}", out.reasons.empty() ? "" : ", ", count, no_depth_name(reason));
    if (count > out.pixels.count(most)) most = reason;
  }
  const std::int64_t wrong = out.pixels.valid_on_wrong_cycle;
  if (100 * wrong > out.pixels.valid && out.has_light)  // without light there is no right one
    out.advice = fmt::format("{:.0f} % of the pixels that have a depth are whole cycles off, and noise_m does not know: {}",
                             100 * static_cast<double>(wrong) / static_cast<double>(out.pixels.valid), whole_cycles(out.pixels));
  if (!out.few()) return out;
  const double share = static_cast<double>(out.pixels.count(most)) / static_cast<double>(out.pixels.pixels);
  out.advice += fmt::format("{}{:.0f} % {}: {}", out.advice.empty() ? "" : "\n  ", 100 * share, no_depth_name(most),
                            help_against(most, out.pixels, frame, camera));
  return out;
}

std::string depth_text(const Validity& of, const char* which) {
  const InvalidPixels& pixels = of.pixels;
  const std::int64_t off = pixels.valid_on_wrong_cycle + pixels.wrapped;
  const std::string invalid = of.reasons.empty() ? "" : "; invalid: " + of.reasons;
  if (!of.has_light && pixels.valid > 0)
    return fmt::format("{} of {} pixels {}have a depth, of noise alone{}\n", pixels.valid, pixels.pixels, which, invalid);
  if (off == 0) return fmt::format("{} of {} pixels {}have a depth{}\n", pixels.valid, pixels.pixels, which, invalid);
  return fmt::format("{} of {} pixels {}have a depth that is right, {} one that is whole cycles off{}\n", pixels.valid - off, pixels.pixels,
                     which, off, invalid);
}

FrameFiles::FrameFiles(const Options& options, const std::vector<std::string>& otherwise, const Inputs& from,
                       const SimulatorOptions& wanted)
    : emit(options.emit.value_or(otherwise)),
      inputs(from),
      meta(from.scene, from.camera, wanted),
      theme(options.theme),
      scale(options.scale) {
  if (!options.arrays.empty()) npz.arrays = results::ArrayChoice(options.arrays);
  npz.kept = from.kept;
  npz.packing = options.compress ? files::Packing::deflated : files::Packing::stored;
  if ((!options.arrays.empty() || options.compress) && std::find(emit.begin(), emit.end(), "npz") == emit.end())
    throw Error(ErrorKind::bad_input,
                "error: --arrays and --compress are of npz files, and --emit leaves these out\n  expected npz in --emit");
}

std::vector<std::string> FrameFiles::needed_arrays() const {
  const auto emits = [&](const char* kind) { return std::find(emit.begin(), emit.end(), kind) != emit.end(); };
  if (emits("npz") && npz.arrays.is_all()) return {};
  std::vector<std::string> names;
  for (const results::ArrayRow& row : results::array_table()) {
    const bool filed = emits("npz") && npz.arrays.has(row), told = row.from == "depth";
    const bool drawn = emits("png") && (row.name == "raw" || row.name == "gt_z_m" || row.name == "gt_multipath_m");
    // What no bin holds is told beside what the bins hold.
    const bool counted = need_transient() && row.name.starts_with("transient_");
    // Why pixels have no depth.
    const bool seen = row.name == "gt_object_id" || row.name == "gt_range_m";
    if (row.is_image() && (filed || told || drawn || counted || seen)) names.push_back(row.name);
  }
  return names;
}

bool FrameFiles::need_transient() const {
  const auto shown = [&](const char* name) { return npz.arrays.has(*results::find_array(name)); };
  return std::find(emit.begin(), emit.end(), "npz") != emit.end() && (shown("transient_e_per_s") || shown("transient_lost_e_per_s"));
}

void warn_of_depth_png(const FrameFiles& what, std::size_t pixels, Remarks& remarks) {
  if (pixels == 0 || std::find(what.emit.begin(), what.emit.end(), "png") == what.emit.end()) return;
  remarks.tell(
      fmt::format("warning: depth.png is 0 in {} pixel{} whose z is beyond 65.535 m, the farthest that 16 bits of mm hold\n"
                  "  z_m in frame.npz has {}\n",
                  pixels, pixels == 1 ? "" : "s", pixels == 1 ? "it" : "them"));
}

std::vector<files::FileRecord> write_frame(const files::OutputFolder& folder, const FrameFiles& what, const std::string& suffix,
                                           const Frame& frame, std::string& memory) {
  std::vector<files::FileRecord> files;
  const auto put = [&](const char* stem, const char* extension, std::string_view bytes) {
    files.push_back(folder.put(stem + suffix + extension, bytes));
  };
  const Inputs& in = what.inputs;
  for (const std::string& kind : what.emit) {
    if (kind == "npz") {
      results::frame_npz_bytes(frame, in.camera, in.pose.value_or(camera_pose(in.scene, frame.truth.time_s)), what.meta.of(frame.index),
                               what.npz, memory);
      put("frame", ".npz", memory);
    } else if (kind == "png") {
      put("depth", ".png", pictures::depth_png(frame.depth));
      put("amplitude", ".png", pictures::amplitude_png(frame.depth));
      put("raw", ".png", pictures::raw_png(frame.raw, what.theme, what.scale));
      const std::string caption = caption_of(in.scene.name, in.camera.name, in.camera.mode.name, frame.index, !suffix.empty());
      put("preview", ".png", pictures::preview_png(frame.depth, frame.truth, frame.raw, caption, what.theme, what.scale));
    } else {
      put("cloud", ".ply", results::cloud_ply(frame.depth));
    }
  }
  return files;
}

void write_frame(files::OutputFolder& folder, const FrameFiles& what, const Frame& frame) {
  std::string memory;
  for (const files::FileRecord& file : write_frame(folder, what, "", frame, memory)) folder.add(file);
}

}  // namespace tofray::app
