// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/mesh.h"

/// Meshes whose surface a picture cuts out: leaves, wire, lace.
namespace tofray::shape {

/// Of the rays that meet a triangle those that meet a surface there: the picture, bilinear in its own texels, says ½ or more at the mean of
/// the corners' texture coordinates.                                                                      [theory: alpha-cut-out]
/// Of each triangle by itself, so that it does not matter in which order they are looked at. Apart: few meshes are cut out.
template <class F>
TOFRAY_NOINLINE Mask<F> not_cut_out(const MeshTree& mesh, std::int32_t triangle, const MeshParts<F>& parts, const Mask<F>& inside) {
  const MeshDetails& block = mesh.details[triangle / block_width];
  const int i = triangle % block_width;
  const F per_all = F(1.0f) / num::select(inside, parts.all, F(1.0f));
  const auto weight = [&](F part) TOFRAY_LAMBDA { return num::select(inside, part * per_all, F(0.0f)); };
  const F first = weight(parts.first), second = weight(parts.second), third = weight(parts.third);
  const auto mean = [&](int k) TOFRAY_LAMBDA {
    return num::fma(first, F(block.texcoord[0][k][i]), num::fma(second, F(block.texcoord[1][k][i]), third * F(block.texcoord[2][k][i])));
  };
  const brdf::MapView& picture = *mesh.cut;
  const F said = brdf::in_level(picture, Int<F>(0), brdf::wrapped(mean(0), picture.wrap[0]), brdf::wrapped(mean(1), picture.wrap[1]));
  return inside & (said >= F(0.5f));
}

}  // namespace tofray::shape
