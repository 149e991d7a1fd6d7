// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/elementary.h"

/// What the arrows of the pipeline carry, for one pixel (or one pack of them).
namespace tofray::flow {

constexpr int max_lights = 8;
constexpr int max_raw_frames = 64;
constexpr int max_harmonics = 8;
constexpr int max_modulation_frequencies = 8;

/// Beyond what any sensor meets, and so small that sums and squares of it are far from single precision's largest number.
constexpr float max_irradiance = 1e12f;   ///< [W/m²] on a surface
constexpr float max_distance = 1e5f;      ///< [m] of a surface that another renderer saw
constexpr float max_charge = 1e15f;       ///< [e⁻] of a tap

/// Which pixels: the first `count` lanes, from `index` (row-major) on.
struct Pixels {
  std::int32_t index;
  std::int32_t count;
};

/// Images are cut into tiles of this size, which see a rectangle of directions each.
constexpr int tile_width = 32, tile_height = 8;

/// Rectangle in d.x/d.z, d.y/d.z (z > 0).
struct Bounds {
  float x_min, x_max, y_min, y_max;
};

/// A ray from a common origin: P = t·d. Camera rays have z = 1, so that t is z; d is not of unit length.
template <class F>
struct Ray {
  F x, y, z;
  F square;          ///< d·d
  F inverse_length;  ///< 1/|d|
};

template <class F>
TOFRAY_FN F square_of(F x, F y, F z) { return num::fma(x, x, num::fma(y, y, z * z)); }

/// A ray of any direction but zero.
template <class F>
TOFRAY_FN Ray<F> make_ray(F x, F y, F z) {
  const F square = square_of(x, y, z);
  return {x, y, z, square, F(1.0f) / num::sqrt(num::max(square, F(1e-30f)))};
}

/// The nearest surface. w = 1/t; 0: nothing.
template <class F>
struct Hit {
  F w;
  num::Int<F> facet;
};

/// Where the light lands: position and normal in the camera frame, lengths, material.
template <class F>
struct Surface {
  F x, y, z;               ///< position [m]
  F nx, ny, nz;            ///< unit normal, toward the camera
  F range;                 ///< [m]
  F cos_view;              ///< of the angle between normal and the way back to the camera
  F diffuse, specular, exponent;
  num::Int<F> object;
  num::Mask<F> found;
};

/// Light that reaches the pixel, as expected photo-electrons per second of both taps together, one path for each light source.
template <class F>
struct Light {
  F signal_rate[max_lights];   ///< [e⁻/s]
  F path_length[max_lights];   ///< ℓ [m]
  F total_rate;                ///< sum of the signal rates [e⁻/s]
  F ambient_rate;              ///< [e⁻/s]
};

/// What the truth arrays show of it.
template <class F>
struct Radiometry {
  F irradiance;                ///< [W/m²] on the surface, of the camera's own light
  F radiance;                  ///< [W/(m² sr)] toward the camera
  F power;                     ///< [W] on the pixel
};

/// What one raw frame reads out.
template <class F>
struct Taps {
  F a, b;                      ///< [e⁻]
  F level;                     ///< [DN] the code before it was held to the code range, a whole number
  F code;                      ///< [DN], a whole number
  F difference;                ///< A−B as depth takes it [e⁻]: from the code, or unrounded within the codes' reach where noise is off
};

/// Depth of one pixel.
template <class F>
struct Depth {
  F range, amplitude, ambient, noise;
  num::Int<F> flags;
};

}  // namespace tofray::flow
