// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "trace/cull.h"

/// Stage 1: the nearest surface along a camera ray, and whether a light reaches it.
namespace tofray::trace {

using flow::Hit;
using flow::Ray;
using flow::Surface;
using num::Int;
using num::Mask;

/// Whether forms of the shape T are searched for all pixels of a tile at once (mesh_tile.h), and left out here.
template <class T, class F, class Culled>
constexpr bool by_tile = shape::many_of<T>&& shape::has_beams<F> && !requires {
  Culled::each_by_itself;
};

/// The inverse range of the hit, 0 or less for none, and the facet that it names.
template <class T, class F>
TOFRAY_FN F hit_of(const typename T::Form& form, const Ray<F>& ray, Int<F>& facet) {
  if constexpr (T::facets == 1) {
    facet = Int<F>(form.facet);
    return inverse_range(form, ray);
  } else {
    Int<F> side;
    const F w = inverse_range(form, ray, side);
    facet = Int<F>(form.facet) + side;
    return w;
  }
}

template <class T, class F, class Culled>
TOFRAY_FN void nearest_of(const Culled& culled, const Ray<F>& ray, Hit<F>& hit) {
  for (auto i = culled.template walk<T>(); i.more(); i.next()) {
    if constexpr (by_tile<T, F, Culled>) {
      return;
    } else if constexpr (shape::many_of<T>) {
      nearest_in(i.form(), ray, hit);
    } else {
      Int<F> facet;
      const F w = hit_of<T>(i.form(), ray, facet);
      const auto nearer = w > hit.w;
      hit.facet = num::select(nearer, facet, hit.facet);
      hit.w = num::select(nearer, w, hit.w);
    }
  }
}

template <class... T, class F, class Culled>
TOFRAY_FN void nearest_of_each(shape::List<T...>, const Culled& culled, const Ray<F>& ray, Hit<F>& hit) {
  (nearest_of<T>(culled, ray, hit), ...);
}

/// The nearer of `hit` and the forms in `culled`; of two at the same place the first one stays.
template <class F, class Culled>
TOFRAY_FN Hit<F> nearest(const Culled& culled, const Ray<F>& ray, Hit<F> hit) {
  nearest_of_each(shape::Shapes{}, culled, ray, hit);
  return hit;
}

/// Puts a surface at P = t·d.
template <class F>
TOFRAY_FN void put_at(const Ray<F>& ray, F t, Surface<F>& out) {
  out.x = ray.x * t, out.y = ray.y * t, out.z = ray.z * t;
  out.range = ray.square * ray.inverse_length * t;
}

/// Puts a surface where the ray hits. @return the lanes that hit something
template <class F>
TOFRAY_FN Mask<F> place(const Ray<F>& ray, const Hit<F>& hit, Surface<F>& out) {
  const auto found = hit.w > F(0.0f);
  put_at(ray, F(1.0f) / num::select(found, hit.w, F(1.0f)), out);
  return found;
}

/// Turns a surface's normal to the camera.
template <class F>
TOFRAY_FN void face_camera(F nx, F ny, F nz, const Ray<F>& ray, Surface<F>& out) {
  const F along = num::fma(nx, ray.x, num::fma(ny, ray.y, nz * ray.z));
  const F sign = num::select(along > F(0.0f), F(-1.0f), F(1.0f));
  out.nx = nx * sign, out.ny = ny * sign, out.nz = nz * sign;
  out.cos_view = num::abs(along) * ray.inverse_length;
}

/// The lanes that see a curved facet of the shape T ask the shape for its normal.
template <class T, class F>
TOFRAY_FN void curved_normal(const shape::FacetColumns<F>& facet, Int<F> curved, Int<F> triangle, const Surface<F>& at,
                             shape::Direction<F>& n) {
  if constexpr (T::curved) {
    const auto its = curved == Int<F>(1 + shape::place_in<T>(shape::Shapes{}));
    if (!num::any(its)) return;
    shape::Direction<F> own;
    if constexpr (shape::many_of<T>) {
      own = T::normal(facet, triangle, its & at.found);
    } else {
      own = T::normal(facet, at.x, at.y, at.z);
    }
    n = {num::select(its, own.x, n.x), num::select(its, own.y, n.y), num::select(its, own.z, n.z)};
  }
}

template <class... T, class F>
TOFRAY_FN shape::Direction<F> normal_of(shape::List<T...>, const shape::FacetColumns<F>& facet, Int<F> triangle, const Surface<F>& at) {
  shape::Direction<F> n{facet.number(0), facet.number(1), facet.number(2)};
  if (facet.same && facet.first().curved == 0) return n;
  const Int<F> curved = facet.curved();
  (curved_normal<T>(facet, curved, triangle, at, n), ...);
  return n;
}

/// What the facets' materials say.
template <class F>
TOFRAY_FN void finish(const scene::SceneView& s, const shape::FacetColumns<F>& facet, flow::Finish<F>& out) {
  const Int<F> material = facet.material() * Int<F>(brdf::material_words);
  const float* table = reinterpret_cast<const float*>(s.materials);
  const auto number = [&](int c) __attribute__((always_inline)) {
    return facet.same ? F(table[num::first(material) + c]) : num::gather(table + c, material);
  };
  out.reflectivity = number(0);
  out.brdf = Int<F>(0);
  for (int i = 0; i < flow::brdf_numbers; ++i) out.number[i] = F(0.0f);
  if (s.any_other_brdf == 0) return;
  for (int i = 0; i < flow::brdf_numbers; ++i) out.number[i] = number(1 + i);
  const std::int32_t* brdfs = reinterpret_cast<const std::int32_t*>(s.materials) + 1 + flow::brdf_numbers;
  out.brdf = facet.same ? Int<F>(brdfs[num::first(material)]) : num::gather(brdfs, material);
}

/// Where and what the hit is: position, normal toward the camera, material.
template <class F>
TOFRAY_FN Surface<F> surface(const scene::SceneView& s, const Ray<F>& ray, const Hit<F>& hit) {
  const shape::FacetColumns<F> facet(s.facets, hit.facet);
  Surface<F> out;
  out.found = place(ray, hit, out);
  const shape::Direction<F> n = normal_of(shape::Shapes{}, facet, hit.triangle, out);
  face_camera(n.x, n.y, n.z, ray, out);
  finish(s, facet, out.finish);
  out.object = facet.object();
  return out;
}

/// Number of its material; only truth asks.
template <class F>
TOFRAY_FN Int<F> material(const scene::SceneView& s, const Hit<F>& hit) {
  return shape::FacetColumns<F>(s.facets, hit.facet).material();
}

}  // namespace tofray::trace
