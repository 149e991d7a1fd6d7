// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/variance_terms.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "effect/nonlinearity.h"

namespace tofray::analysis {

namespace {

/// What is read of a tap's charge, and the slope there.                                          [theory: nonlinearity]
struct TapRead {
  double value, slope;
};
TapRead tap_read(const camera::SensorView& sensor, double charge) {
  if (sensor.read.cell == nullptr) return {charge, 1};
  const auto read = effect::read_charge(sensor.read, std::min(static_cast<float>(charge), sensor.full_well));
  return {static_cast<double>(read.value), static_cast<double>(read.slope)};
}

}  // namespace

double sum_of(const Terms& terms) {
  double sum = 0;
  for (const double one : terms) sum += one;
  return sum;
}

ReadFrame read_frame(const camera::SensorView& sensor, const Collected& light) {
  const auto of = [](float number) { return static_cast<double>(number); };
  const double half = of(sensor.half_gain_mismatch), gain_a = 1 + half, gain_b = 1 - half, offset = of(sensor.half_offset_mismatch);
  // Independent counts: the variance of a tap is its mean.
  const Terms shot_a = {gain_a * light.own_a, gain_a * 0.5 * light.ambient, gain_a * light.dark};
  const Terms shot_b = {gain_b * light.own_b, gain_b * 0.5 * light.ambient, gain_b * light.dark};
  double a = sum_of(shot_a) + offset, b = sum_of(shot_b) - offset;
  const double difference = gain_a * light.own_a - gain_b * light.own_b + 2 * half * (0.5 * light.ambient + light.dark) + 2 * offset;
  const double budget = of(sensor.suppression_budget);
  const double excess = sensor.suppression_threshold > 0 ? std::max(std::min(a, b) - of(sensor.suppression_threshold), 0.0) : 0;
  const double removed = std::min(excess, budget);  // [theory: background-suppression]
  a -= removed, b -= removed;
  const TapRead read_a = tap_read(sensor, a), read_b = tap_read(sensor, b);
  // While suppression holds the smaller tap at its threshold, all of the noise of both is in the larger one.
  const bool held = removed > 0 && excess < budget;
  const double larger = a > b ? read_a.slope : read_b.slope;
  const double square_a = held ? larger * larger : read_a.slope * read_a.slope,
               square_b = held ? larger * larger : read_b.slope * read_b.slope;
  ReadFrame out;
  out.charge = std::max(a, b);
  out.difference = sensor.read.cell == nullptr ? difference : read_a.value - read_b.value;
  for (const Cause cause : {signal_shot, ambient_shot, dark_shot})
    out.variance[cause] = square_a * shot_a[cause] + square_b * shot_b[cause];
  out.variance[read_noise] = (square_a + square_b) * of(sensor.read_variance);
  out.variance[suppression_noise] =
      of(sensor.suppression_noise) * of(sensor.suppression_noise) * removed * (read_a.slope * read_a.slope + read_b.slope * read_b.slope);
  const double step = of(sensor.step);
  out.variance[adc_rounding] = step * step / 12;
  out.variance[line_noise] = effect::LineNoise::variance_as_set(sensor);
  return out;
}

PhaseNoise phase_noise(const camera::DecoderView& decoder, std::size_t modulation, const PhaseCorrection& correction,
                       const std::vector<ReadFrame>& frames) {
  const camera::DecodeModulation& m = decoder.modulation[modulation];
  double real = 0, imaginary = 0;
  for (int j = 0; j < m.count; ++j) {
    const camera::DecodeRawFrame& weight = decoder.frame[m.raw_frame[j]];
    const double difference = frames[static_cast<std::size_t>(m.raw_frame[j])].difference;
    real += difference * static_cast<double>(weight.cosine), imaginary -= difference * static_cast<double>(weight.sine);
  }
  PhaseNoise out;
  out.amplitude = std::sqrt(real * real + imaginary * imaginary), out.measured_rad = std::atan2(imaginary, real);
  // A disturbance of a raw frame turns Ẑ by its part across it: (2/N) sin(φ̂ + τ_k)/Â.
  const double slope = correction.slope(out.measured_rad);
  const double per_rad = static_cast<double>(m.half_wave) / base::two_pi * slope;
  double square = 0;
  for (int j = 0; j < m.count; ++j) {
    const camera::DecodeRawFrame& weight = decoder.frame[m.raw_frame[j]];
    const double across =
        (imaginary * static_cast<double>(weight.cosine) + real * static_cast<double>(weight.sine)) / (out.amplitude * out.amplitude);
    const Terms& variance = frames[static_cast<std::size_t>(m.raw_frame[j])].variance;
    for (std::size_t cause = 0; cause < causes; ++cause) out.variance_m2[cause] += across * across * variance[cause] * per_rad * per_rad;
    square += across * across * sum_of(variance);
  }
  out.sigma_rad = std::sqrt(square);
  return out;
}

}  // namespace tofray::analysis
