// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "flow/flow.h"

/// What the BRDFs share.
namespace tofray::brdf {

using flow::Finish;

/// A material as kernels read it: out of the public struct by its BRDF's view().
struct MaterialView {
  float reflectivity;                ///< what truth shows, and how much ambient light comes back
  float number[flow::brdf_numbers];  ///< what its BRDF's f_r() reads
  std::int32_t brdf;                 ///< its place in the list
  float matt;                        ///< what of the reflectivity a map scales
  std::int32_t matt_numbers;         ///< how many of the numbers, the first ones, it scales
  std::int32_t map;                  ///< number of its map; −1: none
  std::int32_t normals = -1;         ///< number of the first of three maps: how the normal leans; −1: it does not
  std::int32_t finish = -1;          ///< number of the first of five maps: `number`, reflectivity, matt; −1: they are the same everywhere
};

/// Between a surface's normal and the directions from it to light and camera.
template <class F>
struct Cosines {
  F light, view;
  F between;  ///< of the angle between light and camera
};

/// Unit vectors: the normal, to the light, to the camera.
template <class F>
struct Directions {
  flow::Direction<F> normal, light, view;
};

/// |l − v|²: of a narrow lobe about l, where l·v hardly differs from 1.
template <class F>
TOFRAY_INLINE F squared_gap(const Directions<F>& d) {
  return flow::square_of(d.light.x - d.view.x, d.light.y - d.view.y, d.light.z - d.view.z);
}
/// |s − n·(n·s)|² of the sum s = l + v: of a narrow lobe of half vectors about n.
template <class F>
TOFRAY_INLINE F squared_slant(const Directions<F>& d, F normal_part) {
  const auto slant = [&](F n, F l, F v) TOFRAY_LAMBDA { return num::fnma(n, normal_part, l + v); };
  return flow::square_of(slant(d.normal.x, d.light.x, d.view.x), slant(d.normal.y, d.light.y, d.view.y),
                         slant(d.normal.z, d.light.z, d.view.z));
}

constexpr float per_pi = 0.318309886f;

template <class F>
TOFRAY_INLINE F fifth_power(F a) {
  const F square = a * a;
  return square * square * a;
}

}  // namespace tofray::brdf
