// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "analysis/reasons.h"
#include "base/text.h"
#include "base/units.h"
#include "tofray/analysis.h"

namespace tofray {

namespace {

/// Median of the noise of the pixels that are invalid for too little light [m], but for those of which truth says that nothing is there;
/// NaN where none has one.
double median_noise(const Frame& frame) {
  const Depth& depth = frame.depth;
  const bool knows = frame.truth.object_id.size() == depth.flags.size();
  std::vector<float> noise;
  for (std::size_t i = 0; i < depth.flags.size(); ++i) {
    const bool low = (depth.flags[i] & flags_invalid) != 0 && analysis::reason_by_flags(depth.flags[i]) == NoDepth::low_signal;
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
    case NoDepth::no_surface:
      return "the rays of these pixels hit nothing: more light does not help; see camera.pose, or add a wall or a floor";
    case NoDepth::beyond_reach:
      return fmt::format("surfaces farther than the ambiguity range of {:.3f} m: a smaller scene, or a mode of a longer range",
                         pixels.ambiguity_range_m);
    case NoDepth::dark:
    case NoDepth::low_signal: return more_light(frame, camera);
    case NoDepth::wrong_cycle: return whole_cycles(pixels);
    default: break;
  }
#define TOFRAY_ADVICE(name, bit, invalid, letter, dark, light, words, what, advice) \
  if (reason == NoDepth::name) return advice;
  TOFRAY_REASONS(TOFRAY_ADVICE)
#undef TOFRAY_ADVICE
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

}  // namespace tofray
