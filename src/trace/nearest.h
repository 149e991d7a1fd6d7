// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "trace/cull.h"
#include "trace/shapes.h"

/// Stage 1: the nearest surface along a camera ray, and whether a light reaches it.
namespace tofray::trace {

using flow::Hit;
using flow::Surface;
using num::Int;

template <class F>
TOFRAY_FN void keep_nearer(Hit<F>& hit, F w, Int<F> facet) {
  const auto nearer = w > hit.w;
  hit.facet = num::select(nearer, facet, hit.facet);
  hit.w = num::select(nearer, w, hit.w);
}

/// The nearer of `hit` and the forms in `culled`; of two at the same place the first one stays.
template <class F, class Culled>
TOFRAY_FN Hit<F> nearest(const scene::Forms& forms, const Culled& culled, const Ray<F>& ray, Hit<F> hit) {
  for (auto i = culled.walk(forms.planes, forms.plane_count); i.more(); i.next()) {
    const scene::PlaneForm& plane = forms.planes[i.index()];
    keep_nearer(hit, inverse_range(plane, ray), Int<F>(plane.facet));
  }
  for (auto i = culled.walk(forms.spheres, forms.sphere_count); i.more(); i.next()) {
    const scene::SphereForm& sphere = forms.spheres[i.index()];
    keep_nearer(hit, inverse_range(sphere, ray), Int<F>(sphere.facet));
  }
  for (auto i = culled.walk(forms.boxes, forms.box_count); i.more(); i.next()) {
    const scene::BoxForm& box = forms.boxes[i.index()];
    Int<F> axis;
    const F w = inverse_range(box, ray, axis);
    keep_nearer(hit, w, Int<F>(box.facet) + axis);
  }
  for (auto i = culled.walk(forms.triangles, forms.triangle_count); i.more(); i.next()) {
    const scene::TriangleForm& triangle = forms.triangles[i.index()];
    keep_nearer(hit, inverse_range(triangle, ray), Int<F>(triangle.facet));
  }
  return hit;
}

/// Column `c` of each lane's facet. A pack that sees a single facet reads it once.
template <class F>
TOFRAY_FN F facet_value(const scene::Facet* facets, Int<F> facet, bool same, int c) {
  const float* table = reinterpret_cast<const float*>(facets);
  if (same) return F(table[num::first(facet) * scene::facet_floats + c]);
  return num::gather(table + c, facet * Int<F>(scene::facet_floats));
}

/// Puts a surface at P = t·d.
template <class F>
TOFRAY_FN void put_at(const Ray<F>& ray, F t, Surface<F>& out) {
  out.x = ray.x * t, out.y = ray.y * t, out.z = ray.z * t;
  out.range = ray.square * ray.inverse_length * t;
}

/// Turns a surface's normal to the camera.
template <class F>
TOFRAY_FN void face_camera(F nx, F ny, F nz, const Ray<F>& ray, Surface<F>& out) {
  const F along = num::fma(nx, ray.x, num::fma(ny, ray.y, nz * ray.z));
  const F sign = num::select(along > F(0.0f), F(-1.0f), F(1.0f));
  out.nx = nx * sign, out.ny = ny * sign, out.nz = nz * sign;
  out.cos_view = num::abs(along) * ray.inverse_length;
}

/// Where and what the hit is: position, normal toward the camera, material.
template <class F>
TOFRAY_FN Surface<F> surface(const scene::SceneView& s, const Ray<F>& ray, const Hit<F>& hit) {
  const bool same = num::all(hit.facet == Int<F>(num::first(hit.facet)));
  const auto column = [&](int c) __attribute__((always_inline)) { return facet_value<F>(s.facets, hit.facet, same, c); };
  Surface<F> out;
  out.found = hit.w > F(0.0f);
  put_at(ray, F(1.0f) / num::select(out.found, hit.w, F(1.0f)), out);
  const F curvature = column(3);
  const F nx = num::fma(out.x, curvature, column(0)), ny = num::fma(out.y, curvature, column(1)), nz = num::fma(out.z, curvature, column(2));
  face_camera(nx, ny, nz, ray, out);
  out.diffuse = column(4), out.specular = F(0.0f), out.exponent = F(1.0f);
  if (s.any_specular != 0) out.specular = column(5), out.exponent = column(6);
  const std::int32_t* objects = reinterpret_cast<const std::int32_t*>(s.facets);
  out.object = same ? Int<F>(objects[num::first(hit.facet) * scene::facet_floats + 7])
                    : num::gather(objects + 7, hit.facet * Int<F>(scene::facet_floats));
  return out;
}

/// Number of its material; only truth asks.
template <class F>
TOFRAY_FN Int<F> material(const scene::SceneView& s, const Hit<F>& hit) {
  return num::gather(reinterpret_cast<const std::int32_t*>(s.facets) + 8, hit.facet * Int<F>(scene::facet_floats));
}

}  // namespace tofray::trace
