// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "trace/nearest.h"

/// Shadow rays. They leave the light, so that all of them have one origin: d = P − L, and the surface itself is at w = 1.
namespace tofray::trace {

/// An occluder must be nearer to the light than the surface by this share of the distance: more than rounding, less than is seen.
constexpr float shadow_margin = 1e-4f;

/// True where a form stands between the light and the surface. No object shadows itself, since all are flat or convex; but where light
/// and camera are on different sides of a closed one, its surface is in the dark (`own_blocks`).
template <class F, class Culled>
TOFRAY_FN Mask<F> blocked(const scene::Forms& forms, const Culled& culled, const Ray<F>& ray, Int<F> own) {
  const F limit = F(1.0f + shadow_margin);
  Mask<F> dark = F(1.0f) < F(0.0f);
  for (auto i = culled.walk(forms.planes, forms.plane_count); i.more(); i.next()) {
    const scene::PlaneForm& plane = forms.planes[i.index()];
    dark = dark | ((inverse_range(plane, ray) > limit) & (own != Int<F>(plane.object)));
  }
  for (auto i = culled.walk(forms.spheres, forms.sphere_count); i.more(); i.next()) {
    const scene::SphereForm& sphere = forms.spheres[i.index()];
    const auto mine = own == Int<F>(sphere.object);
    dark = dark | ((inverse_range(sphere, ray) > limit) & (!mine));
    if (sphere.own_blocks != 0) dark = dark | mine;
  }
  for (auto i = culled.walk(forms.boxes, forms.box_count); i.more(); i.next()) {
    const scene::BoxForm& box = forms.boxes[i.index()];
    const auto mine = own == Int<F>(box.object);
    Int<F> axis;
    dark = dark | ((inverse_range(box, ray, axis) > limit) & (!mine));
    if (box.own_blocks != 0) dark = dark | mine;
  }
  for (auto i = culled.walk(forms.triangles, forms.triangle_count); i.more(); i.next()) {
    const scene::TriangleForm& triangle = forms.triangles[i.index()];
    dark = dark | ((inverse_range(triangle, ray) > limit) & (own != Int<F>(triangle.object)));
  }
  return dark;
}

/// P·m in the camera frame.
template <class F>
TOFRAY_FN F affine(const Surface<F>& p, const float* m, float offset) {
  return num::fma(p.x, F(m[0]), num::fma(p.y, F(m[1]), num::fma(p.z, F(m[2]), F(offset))));
}

template <class F>
TOFRAY_FN Mask<F> blocks(const scene::ParallelSphere& sphere, const Surface<F>& p, const float* s, F margin) {
  const F x = F(sphere.c[0]) - p.x, y = F(sphere.c[1]) - p.y, z = F(sphere.c[2]) - p.z;
  const F b = num::fma(x, F(s[0]), num::fma(y, F(s[1]), z * F(s[2])));
  const F lx = num::fnma(b, F(s[0]), x), ly = num::fnma(b, F(s[1]), y), lz = num::fnma(b, F(s[2]), z);
  const F rest = F(sphere.radius_squared) - num::fma(lx, lx, num::fma(ly, ly, lz * lz));
  return (rest > F(0.0f)) & (b + num::sqrt(num::max(rest, F(0.0f))) > margin);
}

template <class F>
TOFRAY_FN Mask<F> blocks(const scene::ParallelBox& box, const Surface<F>& p, F margin) {
  F enter = F(0.0f), leave = F(3e38f);
  for (int k = 0; k < 3; ++k) {
    const F place = affine(p, box.axis[k], box.offset[k]);
    const F one = (F(-box.half[k]) - place) * F(box.inverse[k]), other = (F(box.half[k]) - place) * F(box.inverse[k]);
    enter = num::max(enter, num::min(one, other));
    leave = num::min(leave, num::max(one, other));
  }
  return leave > enter + margin;
}

template <class F>
TOFRAY_FN Mask<F> blocks(const scene::ParallelTriangle& t, const Surface<F>& p, F margin) {
  F least = affine(p, t.edge[0], t.edge_offset[0]);
  least = num::min(least, affine(p, t.edge[1], t.edge_offset[1]));
  least = num::min(least, affine(p, t.edge[2], t.edge_offset[2]));
  return (least >= F(0.0f)) & (affine(p, t.m, t.c) > margin);
}

/// The same for parallel light that comes from the unit direction s.
template <class F>
TOFRAY_FN Mask<F> blocked_parallel(const scene::ParallelForms& forms, const float* s, const Surface<F>& p) {
  const F margin = F(shadow_margin) * p.range;
  Mask<F> dark = F(1.0f) < F(0.0f);
  for (int i = 0; i < forms.plane_count; ++i) {
    const scene::ParallelPlane& plane = forms.planes[i];
    dark = dark | ((affine(p, plane.m, plane.c) > margin) & (p.object != Int<F>(plane.object)));
  }
  for (int i = 0; i < forms.sphere_count; ++i) {
    const auto mine = p.object == Int<F>(forms.spheres[i].object);
    dark = dark | (blocks(forms.spheres[i], p, s, margin) & (!mine));
    if (forms.spheres[i].own_blocks != 0) dark = dark | mine;
  }
  for (int i = 0; i < forms.box_count; ++i) {
    const auto mine = p.object == Int<F>(forms.boxes[i].object);
    dark = dark | (blocks(forms.boxes[i], p, margin) & (!mine));
    if (forms.boxes[i].own_blocks != 0) dark = dark | mine;
  }
  for (int i = 0; i < forms.triangle_count; ++i) {
    const scene::ParallelTriangle& triangle = forms.triangles[i];
    dark = dark | (blocks(triangle, p, margin) & (p.object != Int<F>(triangle.object)));
  }
  return dark;
}

}  // namespace tofray::trace
