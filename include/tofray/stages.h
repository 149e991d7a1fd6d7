// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <complex>
#include <cstdint>
#include <vector>

#include "tofray/camera.h"

/// Arrays of one's own in the place of what the first stages find: plain, contiguous, row-major. (Raw data of one's own: see process().)
///
/// `moment`: one for all raw frames of a frame, or one for each of them, at the middle of its exposure, where something moves.
/// `light`: one for each of Camera::illumination, in its order; a ring has one for each of its LEDs, an area one for each of its points
/// (LED by LED).
namespace tofray {

/// What another renderer saw, pixel for pixel along the camera's rays, for stage 2 (power). Camera frame: x right, y down, z forward.
/// Where nothing is seen, no other value is looked at.
struct Geometry {
  int width = 0, height = 0, moments = 1;
  std::vector<float> z_m;       ///< [moment][height][width] along the optical axis; not above 0 (or NaN), or beyond 1e5: nothing is seen
  std::vector<float> normal;    ///< [moment][height][width][3] on either side of the surface, of unit length to 0.1 %
  std::vector<float> diffuse;   ///< [moment][height][width] k_d, 0…1: of a Lambertian surface its reflectivity
  std::vector<float> specular;  ///< [moment][height][width] k_s of the Phong lobe, 0…1 − k_d; empty: Lambert
  std::vector<float> exponent;  ///< [moment][height][width] n of the Phong lobe, 1…1e4, also where k_s is 0; empty: Lambert
  std::vector<std::int32_t> object_id;   ///< [moment][height][width] for Truth::object_id; empty: 0 wherever something is seen
  std::vector<std::uint8_t> shadow;      ///< [moment][light][height][width] 1 where the light does not reach; empty: it reaches everywhere
  std::vector<std::uint8_t> sun_shadow;  ///< [moment][height][width] the same for ambient light that has a direction
};

/// The light that each pixel receives, for stage 3 (raw): path by path, or summed already by modulation frequency.
///
/// Any number of paths may end at a pixel: what a surface reflects, what comes over several of them, what a transparent one lets through.
/// Either each has a power and a length, or `phasor_w` says what all of a light's come to,
///
///     Σ_paths power · e^{i m 2π f n ℓ/c}          n the camera's refractive index                     [theory: phasor]
///
/// for each modulation frequency f, in the order in which the mode's raw frames first have them, and each odd harmonic m. What light and
/// pixel make of a harmonic (waveform, contrast, bandwidth) is added by the camera. Depth takes every ℓ to begin where the camera's lights
/// are on the mean.
struct PixelLight {
  int width = 0, height = 0, moments = 1;
  /// [moment][path][height][width] on the pixel, mean of a modulation period of a lit raw frame, 0…1; with phasors
  /// [moment][light][height][width]
  std::vector<float> power_w;
  /// [moment][path][height][width] ℓ from the light to the surface and on to the camera, 0…1e6 (no light: 0)
  std::vector<float> path_length_m;
  std::vector<int> light_of_path;  ///< [path] which of the camera's lights it comes from; empty: one path of each, in their order
  /// [moment][light][modulation frequency][harmonic][height][width], in place of path_length_m; none is longer than its power.
  /// Harmonics 1, 3, 5 …, as many as there are: the array's size says it
  std::vector<std::complex<float>> phasor_w;
  std::vector<float> ambient_e_per_s;  ///< [moment][height][width] electrons of both taps together, 0…1e20; empty: none
};

/// The light that each pixel receives by the length of its path, for stage 3 (raw): as Truth::transient_e_per_s has it, or another renderer.
///
/// Bin k is centred at ℓ_k = first_m + (k + ½)·bin_width_m, and all of its light counts as of that length:
///
///     S = Σ_k S_k,   Z_jm = a_m·e^{iψ_m}·Σ_k S_k·e^{i m 2π f_j n ℓ_k/c}                 [theory: transient-to-phasor]
///
/// All of the camera's lights have one waveform (a_m, ψ_m), since a histogram does not say whose light is whose.
struct Transient {
  int width = 0, height = 0, bins = 0;
  double first_m = 0;                  ///< 0…1e6: where the first bin begins. Whole paths: from the light by all surfaces to the camera
  double bin_width_m = 0;              ///< 1e-6…1e6
  std::vector<float> e_per_s;          ///< [bin][height][width] S_k, electrons per second of both taps together, 0…1e20
  std::vector<float> ambient_e_per_s;  ///< [height][width] likewise of light that has no modulation, 0…1e20; empty: none
};

/// Pixels of the image that a camera delivers.
struct ImageSize {
  int width = 0, height = 0;
};
/// Size of the image that is read from the sensor, binned pixels as one (theory 4.8): the size of all arrays of a frame, and of those given to a stage.
/// @throws Error as a Simulator's constructor does for this camera
ImageSize image_size(const Camera& camera);

/// Which way each pixel looks, for renderers of one's own: x/z and y/z of its ray in the camera frame, the lens undistorted (theory 4.3).
/// @return [height][width][2]; NaN where the lens model has no inverse
/// @throws Error as a Simulator's constructor does for this camera: all of it has to be good, not the lens alone
std::vector<float> pixel_rays(const Camera& camera);

}  // namespace tofray
