// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/mesh_detail.h"

/// Normals that a picture lets lean.
namespace tofray::shape {

/// Which way texture coordinates grow on the triangles, and which way these face, in the camera's frame and of unit length; 0 where there
/// is none.
template <class F>
struct MeshAxes {
  Direction<F> u, v;    ///< along growing u, and growing v
  Direction<F> normal;  ///< (B − A) × (C − A)
};

/// Of unit length; 0 where it is 0.
template <class F>
TOFRAY_INLINE Direction<F> unit_or_zero(const Direction<F>& a) {
  const F largest = num::max(num::abs(a.x), num::max(num::abs(a.y), num::abs(a.z))), scale = F(1.0f) / num::max(largest, F(1e-37f));
  const F x = a.x * scale, y = a.y * scale, z = a.z * scale, size = num::sqrt(flow::square_of(x, y, z));
  const F unit = F(1.0f) / num::max(size, F(0.5f));
  return {x * unit, y * unit, z * unit};
}

/// With sides e_1, e_2 and their steps (Δu_1, Δv_1), (Δu_2, Δv_2): P_u ∝ (e_1 Δv_2 − e_2 Δv_1)·s, P_v ∝ (e_2 Δu_1 − e_1 Δu_2)·s, s the
/// sign of Δu_1 Δv_2 − Δu_2 Δv_1.                                                                           [theory: normal-map]
/// @param facet  the mesh's first
template <class F>
TOFRAY_INLINE MeshAxes<F> mesh_axes(const Facet& facet, Int<F> triangle) {
  const Int<F> at = mesh_column<F>(triangle, mesh_triangles_words), detail = mesh_column<F>(triangle, mesh_details_words);
  const float *corners = facet.triangles->corner[0][0], *texcoords = facet.details->texcoord[0][0];
  const auto side = [&](int corner, int k) TOFRAY_LAMBDA {
    return num::gather(corners + (3 * corner + k) * block_width, at) - num::gather(corners + k * block_width, at);
  };
  const auto step = [&](int corner, int k) TOFRAY_LAMBDA {
    return num::gather(texcoords + (2 * corner + k) * block_width, detail) - num::gather(texcoords + k * block_width, detail);
  };
  const F one[3] = {side(1, 0), side(1, 1), side(1, 2)}, two[3] = {side(2, 0), side(2, 1), side(2, 2)};
  const F u1 = step(1, 0), v1 = step(1, 1), u2 = step(2, 0), v2 = step(2, 1);
  const F turned = num::select(difference_of_products(u1, v2, u2, v1) < F(0.0f), F(-1.0f), F(1.0f));
  const auto along = [&](const F& a, const F& b) TOFRAY_LAMBDA {
    return unit_or_zero(mesh_turned(facet, difference_of_products(one[0], a, two[0], b) * turned,
                                    difference_of_products(one[1], a, two[1], b) * turned,
                                    difference_of_products(one[2], a, two[2], b) * turned));
  };
  const auto cross = [&](int i, int j) TOFRAY_LAMBDA { return difference_of_products(one[i], two[j], one[j], two[i]); };
  return {along(v2, v1), along(F(0.0f) - u2, F(0.0f) - u1), unit_or_zero(mesh_turned(facet, cross(1, 2), cross(2, 0), cross(0, 1)))};
}

/// n ∝ x·X + y·Y + z·N: X is P_u without its part along N, Y at right angles to both and against P_v.         [theory: normal-map]
/// @param normal  N, of unit length
/// @param lean    x, y, z
/// @return N where texture coordinates do not say which way they grow
template <class F>
TOFRAY_INLINE Direction<F> leaning(const MeshAxes<F>& axes, const Direction<F>& normal, const Direction<F>& lean) {
  const auto inner = [](const Direction<F>& a, const Direction<F>& b)
                         TOFRAY_LAMBDA { return num::fma(a.x, b.x, num::fma(a.y, b.y, a.z * b.z)); };
  const F part = inner(axes.u, normal);
  const Direction<F> across{num::fnma(part, normal.x, axes.u.x), num::fnma(part, normal.y, axes.u.y), num::fnma(part, normal.z, axes.u.z)};
  const F square = flow::square_of(across.x, across.y, across.z);
  const auto known = square > F(1e-6f);
  const F unit = F(1.0f) / num::sqrt(num::select(known, square, F(1.0f)));
  const Direction<F> x{across.x * unit, across.y * unit, across.z * unit};
  const Direction<F> y{difference_of_products(normal.y, x.z, normal.z, x.y), difference_of_products(normal.z, x.x, normal.x, x.z),
                       difference_of_products(normal.x, x.y, normal.y, x.x)};
  const F up = num::select(inner(y, axes.v) > F(0.0f), F(0.0f) - lean.y, lean.y);
  const auto sum = [&](F a, F b, F c) TOFRAY_LAMBDA { return num::fma(lean.x, a, num::fma(up, b, lean.z * c)); };
  const Direction<F> out = unit_or_zero(Direction<F>{sum(x.x, y.x, normal.x), sum(x.y, y.y, normal.y), sum(x.z, y.z, normal.z)});
  return {num::select(known, out.x, normal.x), num::select(known, out.y, normal.y), num::select(known, out.z, normal.z)};
}

}  // namespace tofray::shape
