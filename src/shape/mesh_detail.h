// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/mesh.h"

namespace tofray::shape {

/// Where on its triangle a point is, and what the triangle's corners say of it.
template <class F>
struct MeshDetail {
  Direction<F> normal;  ///< the mean of the corners', in the camera's frame, of unit length; zero where they have none
  F u, v;               ///< the mean of the corners' texture coordinates
  F uv_per_area;        ///< [1/m²] area in texture coordinates of a square metre of the triangle
};

/// The corners' weights are areas, of the triangles that the point's foot makes with each side: b_1 = (p × e_2)·n/n², b_2 = (e_1 × p)·n/n²,
/// b_0 = 1 − b_1 − b_2, with p from the first corner, e_1, e_2 two sides and n = e_1 × e_2.            [theory: eq. 2.20]
/// @param facet  the mesh's first
/// @param x,y,z  the point, in the camera's frame
template <class F>
TOFRAY_FN MeshDetail<F> mesh_detail(const Facet& facet, Int<F> triangle, F x, F y, F z) {
  const Int<F> place = triangle & Int<F>(block_width - 1), block = triangle - place;
  const Int<F> at = block * Int<F>(mesh_triangles_words / block_width) + place;
  const Int<F> detail = block * Int<F>(mesh_details_words / block_width) + place;
  const float *turn = facet.number, *origin = (&facet + 1)->number, *corners = facet.triangles->corner[0][0];
  const float *normals = facet.details->normal[0][0], *texcoords = facet.details->texcoord[0][0];
  F one[3], two[3], p[3], n[3];
  for (int k = 0; k < 3; ++k) {
    const F first = num::gather(corners + k * block_width, at);
    one[k] = num::gather(corners + (3 + k) * block_width, at) - first, two[k] = num::gather(corners + (6 + k) * block_width, at) - first;
    const float* m = turn + 3 * k;
    p[k] = num::fma(x, F(m[0]), num::fma(y, F(m[1]), num::fma(z, F(m[2]), F(origin[k])))) - first;
  }
  const auto cross = [](const F(&a)[3], const F(&b)[3], F(&out)[3]) __attribute__((always_inline)) {
    for (int k = 0; k < 3; ++k) {
      const int i = next_coordinate(k), j = next_coordinate(i);
      out[k] = difference_of_products(a[i], b[j], a[j], b[i]);
    }
  };
  cross(one, two, n);
  const F square = flow::square_of(n[0], n[1], n[2]), per_square = F(1.0f) / num::max(square, F(1e-37f));
  F q[3], r[3];
  cross(p, two, q), cross(one, p, r);
  const auto held = [](F a) __attribute__((always_inline)) { return num::min(num::max(a, F(0.0f)), F(1.0f)); };
  const F second = held(num::fma(q[0], n[0], num::fma(q[1], n[1], q[2] * n[2])) * per_square);
  const F third = num::min(held(num::fma(r[0], n[0], num::fma(r[1], n[1], r[2] * n[2])) * per_square), F(1.0f) - second);
  const F first = F(1.0f) - second - third;
  const auto mean = [&](const float* table, int width, int k) __attribute__((always_inline)) {
    const F a = num::gather(table + k * block_width, detail), b = num::gather(table + (width + k) * block_width, detail);
    const F c = num::gather(table + (2 * width + k) * block_width, detail);
    return num::fma(first, a, num::fma(second, b, third * c));
  };
  MeshDetail<F> out;
  const F s[3] = {mean(normals, 3, 0), mean(normals, 3, 1), mean(normals, 3, 2)};
  const F size = num::sqrt(flow::square_of(s[0], s[1], s[2])), unit = num::select(size > F(1e-3f), F(1.0f) / size, F(0.0f));
  const auto turned = [&](int c) __attribute__((always_inline)) {
    return num::fma(s[0], F(turn[c]), num::fma(s[1], F(turn[3 + c]), s[2] * F(turn[6 + c]))) * unit;
  };
  out.normal = {turned(0), turned(1), turned(2)};
  out.u = mean(texcoords, 2, 0), out.v = mean(texcoords, 2, 1);
  F du[2], dv[2];
  for (int c = 0; c < 2; ++c) {
    du[c] = num::gather(texcoords + (2 + 2 * c) * block_width, detail) - num::gather(texcoords, detail);
    dv[c] = num::gather(texcoords + (3 + 2 * c) * block_width, detail) - num::gather(texcoords + block_width, detail);
  }
  out.uv_per_area = num::abs(difference_of_products(du[0], dv[1], du[1], dv[0])) * num::sqrt(per_square);
  return out;
}

/// The triangles' numbers in the user's list.
template <class F>
TOFRAY_FN Int<F> mesh_number(const Facet& facet, Int<F> triangle) {
  const Int<F> place = triangle & Int<F>(block_width - 1);
  return num::gather(facet.triangles->number, (triangle - place) * Int<F>(mesh_triangles_words / block_width) + place);
}
/// Whether mesh_detail() knows texture coordinates.
TOFRAY_FN bool has_texcoords(const Facet& facet) { return facet.details != nullptr && (&facet + 1)->number[3] != 0.0f; }

}  // namespace tofray::shape
