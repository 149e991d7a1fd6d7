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
};
constexpr int material_words = sizeof(MaterialView) / sizeof(float);

/// Between a surface's normal n and the directions l and v from it to light and camera.
template <class F>
struct Cosines {
  F light, view;  ///< n·l, n·v
  F between;      ///< l·v
  F apart;        ///< |l − v|²: of a narrow lobe about l, where l·v hardly differs from 1
  F aslant;       ///< |s − n·(n·s)|² of the sum s = l + v: of a narrow lobe of half vectors about n
};

template <class F>
TOFRAY_FN Cosines<F> cosines(const flow::Direction<F>& n, const flow::Direction<F>& l, const flow::Direction<F>& v, F light, F view,
                             F between) {
  const F along = light + view;
  const F x = num::fnma(n.x, along, l.x + v.x), y = num::fnma(n.y, along, l.y + v.y), z = num::fnma(n.z, along, l.z + v.z);
  return {light, view, between, flow::square_of(l.x - v.x, l.y - v.y, l.z - v.z), flow::square_of(x, y, z)};
}

constexpr float per_pi = 0.318309886f;

template <class F>
TOFRAY_FN F fifth_power(F a) {
  const F square = a * a;
  return square * square * a;
}

}  // namespace tofray::brdf
