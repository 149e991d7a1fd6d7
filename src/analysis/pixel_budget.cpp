// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/pixel_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/one_pixel.h"
#include "analysis/wrong_cycles.h"
#include "base/calibration.h"
#include "scene/ambient.h"

namespace tofray::analysis {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

Scene lit_by(const AmbientCase& light) {
  Scene out;
  out.ambient = light.ambient, out.camera.pose = light.pose;
  return out;
}

/// The camera whose taps hold the camera's illumination as it is collected.
Camera that_only_collects(Camera camera) {
  Pixel& pixel = camera.pixel;
  pixel.full_well_e = 1e30, pixel.nonlinearity = {};
  pixel.dark_current_e_per_s = pixel.tap_gain_mismatch = pixel.tap_offset_mismatch_e = pixel.suppression_threshold_e = 0;
  return camera;
}

double inverse_of(double variance) { return variance > 0 ? 1 / variance : 0; }

}  // namespace

PixelBudget::PixelBudget(const Camera& pixel, const AmbientCase& light)
    : pixel_(pixel),
      modulations_(camera::modulations_of(pixel.mode)),
      frozen_(base::with_offsets(pixel), false, 0),
      sensor_(frozen_.sensor(0)),
      seen_(lit_by(light), pixel, expected_values(Stage::depth)),
      own_(Scene(), that_only_collects(pixel), expected_values(Stage::raw)) {
  const camera::DecoderView& decoder = frozen_.decoder();
  for (std::size_t i = 0; i < modulations_.frequency_hz.size(); ++i) corrections_.emplace_back(decoder, decoder.modulation[i]);
  band_irradiance_ = scene::band_irradiance(light.ambient, pixel.filter);
  const double rate = scene::band_electron_rate_factor(light.ambient, pixel.filter, pixel.pixel.quantum_efficiency);
  ambient_j_per_e_ = rate > 0 ? band_irradiance_ / rate : 0;
}

std::vector<ReadFrame> PixelBudget::read_frames() const {
  std::vector<ReadFrame> out;
  const double ambient_rate = static_cast<double>(frame_.truth.ambient_e_per_s[0]);
  for (std::size_t k = 0; k < pixel_.mode.sequence.size(); ++k) {
    const camera::RawFrameView& frame = sensor_.frame[k];
    if (frame.lit == 0) {
      out.emplace_back();
      continue;
    }
    out.push_back(read_frame(sensor_, {static_cast<double>(own_frame_.raw.tap_a[k]), static_cast<double>(own_frame_.raw.tap_b[k]),
                                       ambient_rate * static_cast<double>(frame.integration_time), static_cast<double>(frame.dark)}));
  }
  return out;
}

void PixelBudget::add_light(BudgetRow& row) const {
  row.range_m = static_cast<double>(frame_.truth.range_m[0]);
  row.irradiance_w_m2 = static_cast<double>(frame_.truth.irradiance_w_m2[0]);
  row.ambient_irradiance_w_m2 = band_irradiance_;
  row.power_w = static_cast<double>(frame_.truth.power_w[0]);
  row.ambient_power_w = static_cast<double>(frame_.truth.ambient_e_per_s[0]) * ambient_j_per_e_;
}

void PixelBudget::add_charge(const std::vector<ReadFrame>& frames, BudgetRow& row) const {
  const camera::DecoderView& decoder = frozen_.decoder();
  const double middle = static_cast<double>(sensor_.mid_code), valid = static_cast<double>(sensor_.valid_middle);
  const double half = static_cast<double>(sensor_.valid_half), reach = std::min(middle - (valid - half), valid + half - middle);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (!pixel_.mode.sequence[k].lit) continue;
    row.tap_filling = std::max(row.tap_filling, frames[k].charge / static_cast<double>(sensor_.full_well));
    const double code = std::fabs(frames[k].difference) / static_cast<double>(sensor_.step);
    row.adc_filling = std::max(row.adc_filling, code / reach);
  }
  for (std::size_t i = 0; i < modulations_.frequency_hz.size(); ++i) {
    BudgetFrequency one;
    const auto k = static_cast<std::size_t>(decoder.modulation[i].raw_frame[0]);
    one.modulation_frequency_hz = modulations_.frequency_hz[i];
    one.integration_time_s = pixel_.mode.sequence[k].integration_time_s;
    one.signal_e = static_cast<double>(frame_.truth.signal_e[k]);
    one.ambient_e = static_cast<double>(frame_.truth.ambient_e_per_s[0]) * one.integration_time_s;
    one.dark_e = 2 * static_cast<double>(sensor_.frame[k].dark);
    row.signal_e = std::max(row.signal_e, one.signal_e), row.ambient_e = std::max(row.ambient_e, one.ambient_e);
    row.dark_e = std::max(row.dark_e, one.dark_e);
    row.frequencies.push_back(one);
  }
}

void PixelBudget::add_noise(const std::vector<ReadFrame>& frames, BudgetRow& row) {
  const camera::DecoderView& decoder = frozen_.decoder();
  const camera::LensView& lens = frozen_.lens();
  const double inverse_length = static_cast<double>(lens.inverse_length[0]);
  const double u[3] = {static_cast<double>(lens.ray_x[0]) * inverse_length, static_cast<double>(lens.ray_y[0]) * inverse_length,
                       inverse_length};
  const double apart = static_cast<double>(decoder.light_square);
  double along = 0;
  for (std::size_t i = 0; i < 3; ++i) along += u[i] * static_cast<double>(decoder.light[i]);
  // ℓ of the range, with the light where the decoder takes it to be: [theory: range-and-z] the other way round.
  const double range = row.range_m, length = range + std::sqrt(std::max(range * range - 2 * range * along + apart, 0.0));
  const double slope = 2 * (length - range) / (length - along);  // [theory: range-slope]
  row.beyond_ambiguity = 0.5 * length > static_cast<double>(decoder.common_range);
  double weights = 0;
  Terms fused{};
  for (std::size_t i = 0; i < corrections_.size(); ++i) {
    const PhaseNoise phase = phase_noise(decoder, i, corrections_[i], frames);
    BudgetFrequency& one = row.frequencies[i];
    one.amplitude_e = phase.amplitude, one.contrast = one.signal_e > 0 ? phase.amplitude / one.signal_e : 0;
    const double variance = sum_of(phase.variance_m2), weight = inverse_of(variance);
    one.sigma_m = std::fabs(slope) * std::sqrt(variance);
    weights += weight;
    for (std::size_t cause = 0; cause < causes; ++cause) fused[cause] += weight * weight * phase.variance_m2[cause];
    row.amplitude_e += phase.amplitude / static_cast<double>(corrections_.size());
    row.contrast += one.contrast / static_cast<double>(corrections_.size());
    phases_.push_back(phase);
  }
  const double all = sum_of(fused);
  row.sigma_m = std::fabs(slope) / std::sqrt(weights), row.sigma_z_m = row.sigma_m * inverse_length;
  const auto share = [&](Cause cause) { return fused[cause] / all; };
  row.share = {share(signal_shot),  share(ambient_shot),      share(dark_shot), share(read_noise),
               share(adc_rounding), share(suppression_noise), share(line_noise)};
  row.exponent = 2 - row.share.signal_shot;
}

BudgetRow PixelBudget::at(double z, double reflectivity, double angle_rad) {
  const Geometry wall = wall_at(1, 1, z, reflectivity, angle_rad);
  seen_.frame(0, wall, frame_), own_.frame(0, wall, own_frame_);
  BudgetRow row;
  row.z_m = z, row.reflectivity = reflectivity;
  phases_.clear();
  add_light(row);
  const std::vector<ReadFrame> frames = read_frames();
  add_charge(frames, row);
  add_noise(frames, row);
  const std::uint16_t flags = frame_.depth.flags[0];
  row.saturated = (flags & flag_saturated) != 0, row.no_return = (flags & flag_no_return) != 0;
  row.noise_estimate_m = static_cast<double>(frame_.depth.noise_m[0]);
  row.bias_m = static_cast<double>(frame_.depth.range_m[0]) - row.range_m;
  if (row.saturated || row.no_return) {
    row.sigma_m = row.sigma_z_m = row.noise_estimate_m = row.bias_m = row.exponent = row.wrong_cycle = no_number;
    for (BudgetFrequency& one : row.frequencies) one.sigma_m = no_number;
    row.share = {no_number, no_number, no_number, no_number, no_number, no_number, no_number};
    phases_.clear();
  } else {
    row.low_signal = row.sigma_m > pixel_.decoding.noise_threshold_m || row.amplitude_e < pixel_.decoding.amplitude_threshold_e;
  }
  return row;
}

double PixelBudget::wrong_cycle() const {
  if (phases_.empty()) return no_number;
  if (phases_.size() < 2) return 0;
  std::vector<NoisyPhase> noisy;
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    if (!std::isfinite(phases_[i].sigma_rad)) return 1;
    const PhaseCorrection& correction = corrections_[i];
    const double measured = phases_[i].measured_rad, corrected = correction(measured);
    noisy.push_back(
        {phases_[i].sigma_rad, [&correction, measured, corrected](double error) { return correction(measured + error) - corrected; }});
  }
  return wrong_cycle_probability(noisy, modulations_.cycles);
}

}  // namespace tofray::analysis
