// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "trace/cull.h"

/// Stage 1: the nearest surface along a camera ray, and whether a light reaches it.
namespace tofray::trace {

using flow::Hit;
using flow::Place;
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
TOFRAY_INLINE F hit_of(const typename T::Form& form, const Ray<F>& ray, Int<F>& facet) {
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
TOFRAY_INLINE void nearest_of(const Culled& culled, const Ray<F>& ray, Hit<F>& hit) {
  for (auto i = culled.template iterate<T>(); i.more(); i.next()) {
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
TOFRAY_INLINE void nearest_of_each(shape::List<T...>, const Culled& culled, const Ray<F>& ray, Hit<F>& hit) {
  (nearest_of<T>(culled, ray, hit), ...);
}

/// The nearer of `hit` and the forms in `culled`; of two at the same place the first one stays.
template <class F, class Culled>
TOFRAY_INLINE Hit<F> nearest(const Culled& culled, const Ray<F>& ray, Hit<F> hit) {
  nearest_of_each(shape::Shapes{}, culled, ray, hit);
  return hit;
}

/// Puts a surface at P = t·d.
template <class F>
TOFRAY_INLINE void put_at(const Ray<F>& ray, F t, Place<F>& out) {
  out.x = ray.x * t, out.y = ray.y * t, out.z = ray.z * t;
  out.range = ray.square * ray.inverse_length * t;
}

/// Puts a surface where the ray hits. @return the lanes that hit something
template <class F>
TOFRAY_INLINE Mask<F> place(const Ray<F>& ray, const Hit<F>& hit, Place<F>& out) {
  const auto found = hit.w > F(0.0f);
  put_at(ray, F(1.0f) / num::select(found, hit.w, F(1.0f)), out);
  return found;
}

/// Turns a surface's normal to the camera.
template <class F>
TOFRAY_INLINE void face_camera(F nx, F ny, F nz, const Ray<F>& ray, Surface<F>& out) {
  const F along = num::fma(nx, ray.x, num::fma(ny, ray.y, nz * ray.z));
  const F sign = num::select(along > F(0.0f), F(-1.0f), F(1.0f));
  out.nx = nx * sign, out.ny = ny * sign, out.nz = nz * sign, out.leans = false;
  out.cos_view = num::abs(along) * ray.inverse_length;
}

/// Of a facet that is curved its shape knows the normal.
template <class T, class F>
TOFRAY_INLINE void curved_normal(const shape::Facet& facet, Int<F> triangle, const Surface<F>& at, shape::Direction<F>& n) {
  if constexpr (T::curved) {
    if (facet.curved != 1 + shape::place_in<T>(shape::Shapes{})) return;
    if constexpr (shape::many_of<T>) {
      n = T::template normal<F>(facet, triangle);
    } else {
      n = T::normal(facet, at.x, at.y, at.z);
    }
  }
}

/// @param triangle  0 in other lanes than the facet's
template <class... T, class F>
TOFRAY_INLINE shape::Direction<F> normal_of(shape::List<T...>, const shape::Facet& facet, Int<F> triangle, const Surface<F>& at) {
  shape::Direction<F> n{F(facet.number[0]), F(facet.number[1]), F(facet.number[2])};
  if (facet.curved != 0) (curved_normal<T>(facet, triangle, at, n), ...);
  return n;
}

/// What a material says. Lambert, the first BRDF, needs no numbers.
template <class F>
TOFRAY_INLINE void finish(const brdf::MaterialView& material, Mask<F> its, flow::Finish<F>& out) {
  out.reflectivity = num::select(its, F(material.reflectivity), out.reflectivity);
  if (material.brdf == 0) return;
  for (int i = 0; i < flow::brdf_numbers; ++i) out.number[i] = num::select(its, F(material.number[i]), out.number[i]);
  out.brdf = num::select(its, Int<F>(material.brdf), out.brdf);
}

/// What it is that lies there, as its facets and their materials say.
/// @param out  where it lies: its object and material are added
/// @return the normal, not turned to the camera
template <class F>
TOFRAY_INLINE shape::Direction<F> what_is_there(const scene::SceneView& s, Int<F> facet, Int<F> triangle, Surface<F>& out) {
  shape::Direction<F> n{F(0.0f), F(0.0f), F(0.0f)};
  out.finish.reflectivity = F(0.0f), out.finish.brdf = Int<F>(0);
  for (int i = 0; i < flow::brdf_numbers; ++i) out.finish.number[i] = F(0.0f);
  out.object = Int<F>(0);
  shape::for_each_facet<F>(s.facets, facet, out.found, [&](const shape::Facet& one, Mask<F> its) TOFRAY_LAMBDA {
    const shape::Direction<F> its_own = normal_of(shape::Shapes{}, one, num::select(its, triangle, Int<F>(0)), out);
    n = {num::select(its, its_own.x, n.x), num::select(its, its_own.y, n.y), num::select(its, its_own.z, n.z)};
    finish(s.materials[one.material], its, out.finish);
    out.object = num::select(its, Int<F>(one.object), out.object);
  });
  return n;
}

/// Where and what the hit is: position, normal toward the camera, material.
template <class F>
TOFRAY_INLINE Surface<F> surface(const scene::SceneView& s, const Ray<F>& ray, const Hit<F>& hit) {
  Surface<F> out;
  out.found = place(ray, hit, out);
  const shape::Direction<F> n = what_is_there(s, hit.facet, hit.triangle, out);
  face_camera(n.x, n.y, n.z, ray, out);
  return out;
}

/// Number of its material; only truth asks.
template <class F>
TOFRAY_INLINE Int<F> material(const scene::SceneView& s, const Hit<F>& hit) {
  Int<F> out(0);
  shape::for_each_facet<F>(s.facets, hit.facet, hit.w > F(0.0f),
                           [&](const shape::Facet& one, Mask<F> its) TOFRAY_LAMBDA { out = num::select(its, Int<F>(one.material), out); });
  return out;
}

}  // namespace tofray::trace
