// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/mesh.h"

namespace tofray::shape {

/// Where on its triangle a point is.
template <class F>
struct MeshPlace {
  F first, second, third;  ///< the corners' weights
  F per_square;            ///< 1/n² [theory: barycentric]
};

/// What the triangle's corners say of a point.
template <class F>
struct MeshDetail {
  Direction<F> normal;  ///< the mean of the corners', in the camera's frame, of unit length; zero where they have none
  F u, v;               ///< the mean of the corners' texture coordinates
  F uv_per_area;        ///< [1/m²] area in texture coordinates of a square metre of the triangle
  F shade;              ///< the mean of the corners'; 1 where they have none
};

/// The corners' weights are areas, of the triangles that the point's foot makes with each side: b_1 = (p × e_2)·n/n², b_2 = (e_1 × p)·n/n²,
/// b_0 = 1 − b_1 − b_2, with p from the first corner, e_1, e_2 two sides and n = e_1 × e_2.         [theory: barycentric]
/// @param facet  the mesh's first
/// @param x,y,z  the point, in the camera's frame
template <class F>
TOFRAY_INLINE MeshPlace<F> mesh_place(const Facet& facet, Int<F> triangle, F x, F y, F z) {
  const Int<F> place = triangle & Int<F>(block_width - 1), block = triangle - place;
  const Int<F> at = block * Int<F>(mesh_triangles_words / block_width) + place;
  const float *turn = facet.number, *origin = (&facet + 1)->number, *corners = facet.triangles->corner[0][0];
  F one[3], two[3], p[3], n[3];
  for (int k = 0; k < 3; ++k) {
    const F first = num::gather(corners + k * block_width, at);
    one[k] = num::gather(corners + (3 + k) * block_width, at) - first, two[k] = num::gather(corners + (6 + k) * block_width, at) - first;
    const float* m = turn + 3 * k;
    p[k] = num::fma(x, F(m[0]), num::fma(y, F(m[1]), num::fma(z, F(m[2]), F(origin[k])))) - first;
  }
  const auto cross = [](const F(&a)[3], const F(&b)[3], F(&out)[3]) TOFRAY_LAMBDA {
    for (int k = 0; k < 3; ++k) {
      const int i = next_coordinate(k), j = next_coordinate(i);
      out[k] = difference_of_products(a[i], b[j], a[j], b[i]);
    }
  };
  cross(one, two, n);
  const F square = flow::square_of(n[0], n[1], n[2]), per_square = F(1.0f) / num::max(square, F(1e-37f));
  F q[3], r[3];
  cross(p, two, q), cross(one, p, r);
  const auto held = [](F a) TOFRAY_LAMBDA { return num::min(num::max(a, F(0.0f)), F(1.0f)); };
  const F second = held(num::fma(q[0], n[0], num::fma(q[1], n[1], q[2] * n[2])) * per_square);
  const F third = num::min(held(num::fma(r[0], n[0], num::fma(r[1], n[1], r[2] * n[2])) * per_square), F(1.0f) - second);
  return {F(1.0f) - second - third, second, third, per_square};
}

/// Where in tables of [block][corner][width coordinates][block_width] the triangles' first numbers are.
template <class F>
TOFRAY_INLINE Int<F> mesh_column(Int<F> triangle, int words_of_block) {
  const Int<F> place = triangle & Int<F>(block_width - 1);
  return (triangle - place) * Int<F>(words_of_block / block_width) + place;
}
/// The mean of a number that each corner has.
/// @param table   its first block's
/// @param width   so many numbers each corner has there
template <class F>
TOFRAY_INLINE F mesh_mean(const MeshPlace<F>& at, Int<F> column, const float* table, int width) {
  const F a = num::gather(table, column), b = num::gather(table + width * block_width, column);
  return num::fma(at.first, a, num::fma(at.second, b, at.third * num::gather(table + 2 * width * block_width, column)));
}
/// From the mesh's frame into the camera's.
/// @param facet  the mesh's first
template <class F>
TOFRAY_INLINE Direction<F> mesh_turned(const Facet& facet, F x, F y, F z) {
  const float* turn = facet.number;
  const auto row = [&](int c) TOFRAY_LAMBDA { return num::fma(x, F(turn[c]), num::fma(y, F(turn[3 + c]), z * F(turn[6 + c]))); };
  return {row(0), row(1), row(2)};
}

/// Whether corners have shades. @param facet  the mesh's first
TOFRAY_INLINE bool has_shades(const Facet& facet) { return (&facet + 1)->number[4] != 0.0f; }

template <class F>
TOFRAY_INLINE MeshDetail<F> mesh_detail(const Facet& facet, Int<F> triangle, F x, F y, F z) {
  const MeshPlace<F> at = mesh_place(facet, triangle, x, y, z);
  const Int<F> detail = mesh_column<F>(triangle, mesh_details_words);
  const float *normals = facet.details->normal[0][0], *texcoords = facet.details->texcoord[0][0];
  MeshDetail<F> out;
  const auto mean = [&](const float* table, int width) TOFRAY_LAMBDA { return mesh_mean(at, detail, table, width); };
  const F s[3] = {mean(normals, 3), mean(normals + block_width, 3), mean(normals + 2 * block_width, 3)};
  const F size = num::sqrt(flow::square_of(s[0], s[1], s[2])), unit = num::select(size > F(1e-3f), F(1.0f) / size, F(0.0f));
  const Direction<F> normal = mesh_turned(facet, s[0], s[1], s[2]);
  out.normal = {normal.x * unit, normal.y * unit, normal.z * unit};
  out.u = mean(texcoords, 2), out.v = mean(texcoords + block_width, 2);
  F du[2], dv[2];
  for (int c = 0; c < 2; ++c) {
    du[c] = num::gather(texcoords + (2 + 2 * c) * block_width, detail) - num::gather(texcoords, detail);
    dv[c] = num::gather(texcoords + (3 + 2 * c) * block_width, detail) - num::gather(texcoords + block_width, detail);
  }
  out.uv_per_area = num::abs(difference_of_products(du[0], dv[1], du[1], dv[0])) * num::sqrt(at.per_square);
  out.shade = has_shades(facet) ? mean(facet.details->shade[0], 1) : F(1.0f);
  return out;
}

/// The triangles' numbers in the user's list.
template <class F>
TOFRAY_INLINE Int<F> mesh_number(const Facet& facet, Int<F> triangle) {
  const Int<F> place = triangle & Int<F>(block_width - 1);
  return num::gather(facet.triangles->number, (triangle - place) * Int<F>(mesh_triangles_words / block_width) + place);
}
/// How the points of a mesh that changes its shape move at the time of the truth, in the camera's frame but for what moves all of it.
template <class F>
struct MeshStep {
  Direction<F> velocity, step;
};
TOFRAY_INLINE bool has_steps(const Facet& facet) { return (&facet + 1)->steps != nullptr; }
template <class F>
TOFRAY_INLINE MeshStep<F> mesh_step(const Facet& facet, Int<F> triangle, F x, F y, F z) {
  const MeshPlace<F> at = mesh_place(facet, triangle, x, y, z);
  const Int<F> column = mesh_column<F>(triangle, mesh_steps_words);
  const auto mean = [&](const float* table) TOFRAY_LAMBDA {
    return mesh_turned(facet, mesh_mean(at, column, table, 3), mesh_mean(at, column, table + block_width, 3),
                       mesh_mean(at, column, table + 2 * block_width, 3));
  };
  const MeshSteps& steps = *(&facet + 1)->steps;
  return {mean(steps.velocity[0][0]), mean(steps.step[0][0])};
}
/// Whether mesh_detail() knows texture coordinates.
TOFRAY_INLINE bool has_texcoords(const Facet& facet) { return facet.details != nullptr && (&facet + 1)->number[3] != 0.0f; }

}  // namespace tofray::shape
