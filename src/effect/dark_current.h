// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tofray::effect {

/// Charge without light.                                                                                [theory: dark-current]
struct DarkCurrent {
  /// Electrons of a tap per second at the camera's temperature: twice as many with every `dark_current_doubling_k` kelvin.
  /// @param exp  the exponential function
  template <class Camera, class Exp>
  static double rate(const Camera& camera, const Exp& exp) {
    constexpr double ln_2 = 0.69314718055994530942;
    const auto& pixel = camera.pixel;
    if (pixel.dark_current_doubling_k == 0) return pixel.dark_current_e_per_s;
    const double warmer = camera.temperature.celsius - camera.temperature.reference_celsius;
    return pixel.dark_current_e_per_s * exp(ln_2 * warmer / pixel.dark_current_doubling_k);
  }
  template <class Pixel>
  static void bin(Pixel& pixel, int n) {
    pixel.dark_current_e_per_s *= static_cast<double>(n) * n;
  }
};

}  // namespace tofray::effect
