// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/unwrap_candidates.h"

#include <algorithm>
#include <cmath>

#include "depth/decode.h"

namespace tofray::analysis {

namespace {

/// The candidate of one cycle of the reference, in the decoder's own steps.
UnwrapCandidate candidate(const camera::DecoderView& d, const camera::LensView& lens, std::size_t pixel, const std::vector<float>& turns,
                          const std::vector<float>& weight, int cycle) {
  const auto reference = static_cast<std::size_t>(d.reference);
  const float half_path = d.modulation[reference].half_wave * (turns[reference] + static_cast<float>(cycle));
  float misfit = 0, weights = 0, sum = 0;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const float off = depth::nearest_half_path(d.modulation[i], turns[i], half_path) - half_path;
    if (i != reference) misfit = num::fma(off, off, misfit);
    weights += weight[i], sum = num::fma(weight[i], off, sum);
  }
  const auto common = static_cast<double>(d.common_range);
  double mean = static_cast<double>(half_path + sum / weights);
  mean -= common * std::floor(mean / common);
  UnwrapCandidate out;
  for (std::size_t i = 0; i < turns.size(); ++i)
    out.cycles.push_back(std::round(mean / static_cast<double>(d.modulation[i].half_wave) - static_cast<double>(turns[i])) + 0.0);
  const float scale = lens.inverse_length[pixel];
  out.range_m = static_cast<double>(
      depth::range_from_path(d, static_cast<float>(2 * mean), lens.ray_x[pixel] * scale, lens.ray_y[pixel] * scale, scale).range);
  out.cost_m2 = static_cast<double>(misfit);
  return out;
}

}  // namespace

std::vector<UnwrapCandidate> unwrap_candidates(const camera::DecoderView& d, const camera::LensView& lens, std::size_t pixel,
                                               const std::vector<float>& turns, const std::vector<float>& weight) {
  const auto finite = [](float value) { return std::isfinite(value); };
  std::vector<UnwrapCandidate> out;
  if (turns.size() < 2 || !std::all_of(turns.begin(), turns.end(), finite)) return out;
  const int cycles = static_cast<int>(d.modulation[d.reference].cycles);
  for (int n = 0; n < cycles; ++n) out.push_back(candidate(d, lens, pixel, turns, weight, n));
  // Of equal ones the decoder takes the first.
  std::stable_sort(out.begin(), out.end(), [](const UnwrapCandidate& a, const UnwrapCandidate& b) { return a.cost_m2 < b.cost_m2; });
  if (!out.empty()) out.front().chosen = true;
  return out;
}

}  // namespace tofray::analysis
