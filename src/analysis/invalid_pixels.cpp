// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/reach.h"
#include "analysis/reasons.h"
#include "tofray/analysis.h"
#include "tofray/simulator.h"

namespace tofray {

NoDepth analysis::reason_by_flags(std::uint16_t flags) {
#define TOFRAY_REASON(name, bit, ...) \
  if ((flags & (bit)) != 0) return NoDepth::name;
  TOFRAY_REASONS(TOFRAY_REASON)
#undef TOFRAY_REASON
  return NoDepth::inconsistent_frequencies;
}

namespace {

/// A frame's truth, pixel by pixel, where it is there. Where the object is not known, a range says that there is a surface.
class PixelTruth {
 public:
  PixelTruth(const Frame& frame, double reach_m)
      : truth_(frame.truth),
        reach_m_(reach_m),
        known_(truth_.range_m.size() == frame.depth.flags.size()),
        named_(truth_.object_id.size() == frame.depth.flags.size()) {}
  [[nodiscard]] bool beyond(std::size_t i) const {
    return known_ && reach_m_ > 0 && is_surface(i) && static_cast<double>(truth_.range_m[i]) > reach_m_;
  }
  /// How far a range is from the true one; NaN where that is not known.
  [[nodiscard]] double error(std::size_t i, float range_m) const {
    return known_ ? static_cast<double>(range_m) - static_cast<double>(truth_.range_m[i]) : std::nan("");
  }
  [[nodiscard]] NoDepth reason(std::size_t i, NoDepth by_flags) const {
    if (!known_ || by_flags == NoDepth::outside_lens || by_flags == NoDepth::saturated) return by_flags;
    if (!is_surface(i)) return NoDepth::no_surface;
    if (beyond(i)) return NoDepth::beyond_reach;
    return by_flags == NoDepth::low_signal || by_flags == NoDepth::no_return ? NoDepth::dark : by_flags;
  }

 private:
  [[nodiscard]] bool is_surface(std::size_t i) const { return named_ ? truth_.object_id[i] >= 0 : std::isfinite(truth_.range_m[i]); }

  const Truth& truth_;
  double reach_m_;
  bool known_, named_;
};

/// The frame's depth without the check for flying pixels; empty where its raw data are not there.
Depth with_flying_pixels(const Frame& frame, Camera camera) {
  const Raw& raw = frame.raw;
  if (raw.raw.empty() && (raw.tap_a.empty() || raw.tap_b.empty())) return {};
  camera.decoding.flying_check = false;
  camera.decoding.filter = {};
  SimulatorOptions options;
  options.backend = Backend::cpu;
  return process(raw, camera, options);
}

/// Whether a step in range is a whole number of cycles of one of the modulation frequencies, but for noise.
bool is_whole_cycles(double step, double noise, const std::vector<double>& ranges) {
  constexpr double share = 0.06, sigmas = 3;  // of a range that two modulation frequencies' cycles may be apart and still be taken
  return std::any_of(ranges.begin(), ranges.end(), [&](double range) {
    const double cycles = std::round(std::abs(step) / range);
    return cycles >= 1 && std::abs(std::abs(step) - cycles * range) <= std::min(share * range + sigmas * noise, 0.2 * range);
  });
}

/// Most of its neighbours that have a range are whole cycles off.
bool is_cycles_off(const Depth& all, std::size_t i, const std::vector<double>& ranges) {
  const auto width = static_cast<std::size_t>(all.width);
  const std::size_t x = i % width;
  int known = 0, off = 0;
  const auto look = [&](bool there, std::size_t k) {
    if (!there || !std::isfinite(all.range_m[k])) return;
    ++known;
    const auto noise = static_cast<double>(std::hypot(all.noise_m[i], all.noise_m[k]));
    if (is_whole_cycles(static_cast<double>(all.range_m[i]) - static_cast<double>(all.range_m[k]), std::isfinite(noise) ? noise : 0,
                        ranges))
      ++off;
  };
  look(x > 0, i - 1), look(x + 1 < width, i + 1), look(i >= width, i - width), look(i + width < all.range_m.size(), i + width);
  return std::isfinite(all.range_m[i]) && 2 * off > known;
}

/// Whether truth says that a range is off by no whole cycle: a neighbour is.
bool is_right(double error, float noise, const std::vector<double>& ranges) {
  return std::isfinite(error) && !is_whole_cycles(error, std::isfinite(noise) ? static_cast<double>(noise) : 0, ranges);
}

#define TOFRAY_MEMBER(name, ...) &InvalidPixels::name,
constexpr std::int64_t InvalidPixels::*members[no_depth_count] = {&InvalidPixels::no_surface, &InvalidPixels::beyond_reach,
                                                                  &InvalidPixels::dark, &InvalidPixels::wrong_cycle,
                                                                  TOFRAY_REASONS(TOFRAY_MEMBER)};
#undef TOFRAY_MEMBER
std::int64_t& count_of(InvalidPixels& of, NoDepth reason) { return of.*members[static_cast<std::size_t>(reason)]; }

}  // namespace

const char* no_depth_name(NoDepth reason) {
#define TOFRAY_WORDS(name, bit, invalid, letter, dark, light, words, ...) words,
  static constexpr const char* names[no_depth_count] = {"no surface", "beyond reach", "dark", "wrong cycle", TOFRAY_REASONS(TOFRAY_WORDS)};
#undef TOFRAY_WORDS
  return names[static_cast<std::size_t>(reason)];
}

std::int64_t InvalidPixels::count(NoDepth reason) const { return this->*members[static_cast<std::size_t>(reason)]; }

InvalidPixels invalid_pixels(const Frame& frame, const Camera& camera, bool wrong_cycles) {
  const analysis::Reach reach = analysis::reach_of(camera);
  InvalidPixels out;
  out.ambiguity_range_m = reach.ambiguity_range_m, out.ranges_m = reach.ranges_m;
  const std::vector<std::uint16_t>& flags = frame.depth.flags;
  out.pixels = static_cast<std::int64_t>(flags.size());
  const PixelTruth seen(frame, reach.ambiguity_range_m);
  // (Of one modulation frequency alone, what is near either end of its range.)
  const double half_a_cycle = reach.ranges_m.empty() ? std::numeric_limits<double>::infinity()
                                                     : 0.5 * *std::min_element(reach.ranges_m.begin(), reach.ranges_m.end());
  std::vector<std::size_t> flying;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if ((flags[i] & flags_invalid) == 0) {
      const bool beyond = seen.beyond(i);
      ++out.valid, out.wrapped += beyond ? 1 : 0;
      if (!beyond && i < frame.depth.range_m.size() && std::abs(seen.error(i, frame.depth.range_m[i])) > half_a_cycle)
        ++out.valid_on_wrong_cycle;
      continue;
    }
    const NoDepth reason = seen.reason(i, analysis::reason_by_flags(flags[i]));
    ++count_of(out, reason);
    if (reason == NoDepth::flying_pixel) flying.push_back(i);
  }
  if (!wrong_cycles || 100 * flying.size() < flags.size() || flying.empty()) return out;
  const Depth all = with_flying_pixels(frame, camera);
  if (all.range_m.size() != flags.size()) return out;
  for (const std::size_t i : flying)
    if (is_cycles_off(all, i, reach.ranges_m) && !is_right(seen.error(i, all.range_m[i]), all.noise_m[i], reach.ranges_m))
      --count_of(out, NoDepth::flying_pixel), ++count_of(out, NoDepth::wrong_cycle);
  return out;
}

}  // namespace tofray
