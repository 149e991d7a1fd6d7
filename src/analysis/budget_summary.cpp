// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "analysis/budget_request.h"
#include "analysis/reach.h"
#include "tofray/budget.h"

namespace tofray {

namespace {

constexpr double summary_nearest_m = 0.01;

/// Of one raw frame of a white wall in the dark, where light is so weak that no tap is full.
void add_responsivity(const Camera& pixel, const BudgetRow& row, BudgetSummary& out) {
  const auto count = static_cast<double>(row.frequencies.size());
  for (const BudgetFrequency& one : row.frequencies) {
    const double joule = row.power_w * one.integration_time_s;
    if (!(joule > 0)) continue;
    out.correlated_e_per_j += one.amplitude_e / joule / count;
    // Light without modulation comes to both taps alike: what differs are their gains.                  [theory: tap-mismatch]
    out.uncorrelated_e_per_j += 0.5 * std::fabs(pixel.pixel.tap_gain_mismatch) * one.signal_e / joule / count;
  }
  if (out.uncorrelated_e_per_j > 0) out.rejection = out.correlated_e_per_j / out.uncorrelated_e_per_j;
}

void add_energy(const Camera& pixel, BudgetSummary& out) {
  double power = 0;
  for (const Illumination& one : pixel.illumination) power += one.power_w;
  for (const RawFrame& one : pixel.mode.sequence)
    if (one.lit) out.energy_per_frame_j += power * one.integration_time_s;
  out.mean_power_w = out.energy_per_frame_j * pixel.mode.frame_rate_hz;
}

}  // namespace

BudgetSummary budget_summary(const Camera& camera, const BudgetRequest& request) {
  const BudgetRequest complete = analysis::complete_request(request);
  analysis::BudgetCamera of(camera, complete);
  BudgetSummary out;
  out.ambiguity_range_m = analysis::reach_of(camera).ambiguity_range_m;
  out.low_signal_m = camera.decoding.noise_threshold_m;
  for (std::size_t light = 0; light < complete.ambients.size(); ++light)
    for (const double reflectivity : complete.reflectivities)
      out.reach.push_back({reflectivity, complete.ambients[light].name,
                           of.reach(light, reflectivity, summary_nearest_m, BudgetReach::everywhere_m),
                           of.saturated_up_to(light, reflectivity, summary_nearest_m, BudgetReach::everywhere_m)});
  BudgetRequest dark = complete;
  dark.ambients = {AmbientCase()}, dark.angle_rad = 0, dark.auto_exposure = false;
  analysis::BudgetCamera in_the_dark(camera, dark);
  out.noise_at_1_m_m = in_the_dark.at(0, 1, 1, false).sigma_m;
  constexpr double far = 10;
  const BudgetRow weak = in_the_dark.at(0, far, 1, false);
  const double facing = weak.z_m / weak.range_m;  // of the wall toward the pixel
  out.radiant_intensity_w_sr = weak.irradiance_w_m2 * weak.range_m * weak.range_m / facing;
  add_responsivity(of.pixel(), weak, out);
  add_energy(of.pixel(), out);
  return out;
}

}  // namespace tofray
