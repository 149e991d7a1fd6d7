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

/// Between a surface's normal and the directions from it to light and camera.
template <class F>
struct Cosines {
  F light, view;
  F between;  ///< of the angle between light and camera
};

constexpr float per_pi = 0.318309886f;

}  // namespace tofray::brdf
