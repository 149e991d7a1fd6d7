// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "analysis/phase_correction.h"
#include "camera/frozen_camera.h"

/// What the noise of a range is made of, cause by cause.                                      [theory: noise-by-cause]
namespace tofray::analysis {

enum Cause : std::size_t { signal_shot, ambient_shot, dark_shot, read_noise, adc_rounding, suppression_noise, line_noise };
constexpr std::size_t causes = 7;
using Terms = std::array<double, causes>;
double sum_of(const Terms& terms);

/// Expected electrons of a raw frame.
struct Collected {
  double own_a = 0, own_b = 0;  ///< electrons of the camera's illumination in each tap
  double ambient = 0;           ///< ambient light in both taps together
  double dark = 0;              ///< dark charge in each tap
};

/// What is read of it.
struct ReadFrame {
  double difference = 0;  ///< expected A−B [e⁻]
  double charge = 0;      ///< of the fuller tap, after background suppression and before the well clips
  Terms variance{};       ///< of A−B [e²]
};

/// Expected values and variances through [theory: charge-order]: gains and offsets of the taps, background suppression, nonlinearity,
/// converter.
ReadFrame read_frame(const camera::SensorView& sensor, const Collected& light);

/// A modulation frequency's phase, and the noise of the half path that it says.
struct PhaseNoise {
  double amplitude = 0;     ///< Â [e⁻]
  double measured_rad = 0;  ///< φ̂
  double sigma_rad = 0;     ///< of φ̂
  Terms variance_m2{};      ///< of half the path
};
/// @param frames  of all raw frames of the sequence
PhaseNoise phase_noise(const camera::DecoderView& decoder, std::size_t modulation, const PhaseCorrection& correction,
                       const std::vector<ReadFrame>& frames);

}  // namespace tofray::analysis
