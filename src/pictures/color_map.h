// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>

namespace tofray::pictures {

/// A colour of a screen, sRGB.
struct Rgb {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const Rgb&) const = default;
};

inline constexpr Rgb invalid_color{44, 46, 51};  ///< neutral and dark: no pixel of a map looks like it

/// Near (0) to far (1): pale yellow over orange and rose to blue, ever darker, so that it reads in grey, too. Clamped to 0…1.
Rgb depth_color(double t);

/// Too near (−1) over white (0) to too far (1): blue and red, equally dark at equal distance. Clamped to −1…1.
Rgb error_color(double t);

/// Dark (0) to white (1), neutral. Clamped to 0…1.
Rgb grey_color(double t);

/// The colours that these maps are made of, evenly spaced from 0 to 1; between two of them lies mixed(). Of errors: what is too near, and what is too far.
std::span<const Rgb> depth_stops();
std::span<const Rgb> near_stops();
std::span<const Rgb> far_stops();
std::span<const Rgb> grey_stops();

/// Between two colours, t = 0…1.
Rgb mixed(Rgb a, Rgb b, double t);

}  // namespace tofray::pictures
