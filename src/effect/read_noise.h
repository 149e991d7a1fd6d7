// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

namespace tofray::effect {

/// Reset and read noise of a tap.                                                                        [theory: reset-noise]
struct ReadNoise {
  struct View {
    float read_noise, read_variance;  ///< [e⁻], [e²]
    bool operator==(const View&) const = default;
  };
  template <class Camera>
  static void set(const Camera& camera, View& s) {
    const double noise = of(camera);
    s.read_noise = static_cast<float>(noise), s.read_variance = static_cast<float>(noise * noise);
  }
  /// Binned pixels have read noise once, by the amplifier.
  template <class Pixel>
  static void bin(Pixel&, int) {}

  /// Both together at the camera's temperature, 1 sigma [e⁻].
  template <class Camera>
  static double of(const Camera& camera) {
    constexpr double kelvin = 273.15;
    const auto& pixel = camera.pixel;
    const double read = pixel.read_noise_e * pixel.read_noise_e;
    if (pixel.cancels_reset_noise) return std::sqrt(2 * read);
    if (pixel.reset_noise_e == 0) return pixel.read_noise_e;
    const double warmer = (camera.temperature.celsius + kelvin) / (camera.temperature.reference_celsius + kelvin);
    return std::sqrt(read + pixel.reset_noise_e * pixel.reset_noise_e * warmer);
  }
};

}  // namespace tofray::effect
