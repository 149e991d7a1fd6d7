// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/elementary.h"

/// What the arrows of the pipeline carry, for one pixel (or one pack of them).
namespace tofray::flow {

/// Limits of what a worker keeps at hand; no type that goes to a GPU has arrays of these sizes.
constexpr int max_lights = 64;
constexpr int max_raw_frames = 64;
constexpr int max_harmonics = 8;
constexpr int max_modulation_frequencies = 8;

/// Beyond what any sensor meets, and so small that sums and squares of it are far from single precision's largest number.
constexpr float max_irradiance = 1e12f;  ///< [W/m²] on a surface
constexpr float max_distance = 1e5f;     ///< [m] of a surface that another renderer saw
constexpr float max_charge = 1e15f;      ///< [e⁻] of a tap

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

template <class F>
struct Direction {
  F x, y, z;
};

/// A ray from a common origin: P = t·d. Camera rays have z = 1, so that t is z; d is not of unit length.
template <class F>
struct Ray {
  F x, y, z;
  F square;          ///< d·d
  F inverse_length;  ///< 1/|d|
};

template <class F>
TOFRAY_INLINE F square_of(F x, F y, F z) {
  return num::fma(x, x, num::fma(y, y, z * z));
}

/// A ray of any direction but zero.
template <class F>
TOFRAY_INLINE Ray<F> make_ray(F x, F y, F z) {
  const F square = square_of(x, y, z);
  return {x, y, z, square, F(1.0f) / num::sqrt(num::max(square, F(1e-30f)))};
}

/// The nearest surface. w = 1/t; 0: nothing.
template <class F>
struct Hit {
  F w;
  num::Int<F> facet;
  num::Int<F> triangle;  ///< where the facet is a mesh: which of its triangles
};
template <class F>
TOFRAY_INLINE Hit<F> no_hit() {
  return {F(0.0f), num::Int<F>(0), num::Int<F>(0)};
}

/// What a surface is made of, for its BRDF (brdf/list.h).
constexpr int brdf_numbers = 3;
template <class F>
struct Finish {
  F reflectivity;
  F number[brdf_numbers];
  num::Int<F> brdf;  ///< its place in the list; 0, Lambert, needs no numbers
};

/// A point of a surface, as shadow rays know it.
template <class F>
struct Place {
  F x, y, z;  ///< position in the camera frame [m]
  F range;    ///< [m]
  num::Int<F> object;
  num::Mask<F> found;
};

/// Where the light lands: position and normal in the camera frame, lengths, material.
template <class F>
struct Surface : Place<F> {
  F nx, ny, nz;  ///< unit normal, toward the camera
  /// Where corners or pictures have normals of their own, that of the facet itself, on whose side light can arrive. Else the same, and not set.
  Direction<F> flat;
  bool leans;
  F cos_view;  ///< of the angle between normal and the way back to the camera
  Finish<F> finish;
};

/// Light over one path from a source to the pixel.
template <class F>
struct Path {
  F rate;    ///< expected photo-electrons per second of both taps together [e⁻/s]
  F length;  ///< ℓ [m]
};

/// All light that reaches the pixel, over any number of paths: what stage 3 needs to know of it.
///
///     S    = Σ_paths rate
///     Z_jm = Σ_paths a_m·e^{iψ_m}·rate·e^{imφ_j},   φ_j = 2π f_j n ℓ/c                    [theory: received-phasors]
///
/// for each modulation frequency f_j and odd harmonic m, at [j·orders + (m − 1)/2].
template <class F>
struct Light {
  F signal_rate;   ///< S [e⁻/s]
  F ambient_rate;  ///< [e⁻/s]
  F real[max_modulation_frequencies * max_harmonics], imaginary[max_modulation_frequencies * max_harmonics];
  /// [j] Re Σ_m Z_jm and Re Σ_m Z_jm·e^{−imπ/2}: what gates at quarter turns correlate with.
  F in_phase[max_modulation_frequencies], quarter[max_modulation_frequencies];
};

/// What the truth arrays show of it.
template <class F>
struct Radiometry {
  F irradiance;  ///< [W/m²] on the surface, by the camera's illumination
  F radiance;    ///< [W/(m² sr)] toward the camera
  F power;       ///< [W] on the pixel
};

/// What one raw frame reads out.
template <class F>
struct Taps {
  F a, b;        ///< [e⁻]
  F level;       ///< [DN] the code before it was held to the code range, a whole number
  F code;        ///< [DN], a whole number
  F difference;  ///< A−B as depth takes it [e⁻]: from the code, or unrounded within the codes' reach where noise is off
};

/// Depth of one pixel.
template <class F>
struct Depth {
  F range, amplitude, ambient, noise;
  F trust;  ///< how likely the range is on the right cycle, 0…1
  num::Int<F> flags;
};

}  // namespace tofray::flow
