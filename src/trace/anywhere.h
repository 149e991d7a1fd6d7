// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "trace/boxes.h"
#include "trace/detail.h"

/// Rays that leave from anywhere: the nearest surface, and what is there.
///
/// Nothing flat or convex stands in its own way, but that who is within a closed body always meets it again. So a body that a ray leaves is
/// known by its facet, not by a distance, and light that leaves a wall beside a corner meets the other one, down to micrometres. Only
/// meshes may shade themselves: their rays begin a little before the surface.
namespace tofray::trace {

using shape::FreeRay;

/// The nearest surface of a ray from anywhere, `distance` from where it begins; shape::never: nothing.
template <class F>
struct Met {
  F distance;
  Int<F> facet, triangle;
  F lift;  ///< how far before the surface that it left, along its normal, the ray began that met it [m]
};
template <class F>
TOFRAY_INLINE Met<F> nothing_met() {
  return {F(shape::never), Int<F>(0), Int<F>(0), F(0.0f)};
}

/// Where a ray leaves from.
template <class F>
struct Leaving {
  Int<F> facet;  ///< −1: from no surface
  F nx, ny, nz;  ///< of the surface, on the side that it leaves to
  F away;        ///< how far from the camera [m]: coordinates are known to some 10⁻⁷ of it
  Mask<F> wanted;
};

/// How far before a mesh its rays begin, in units of the distances from which coordinates come.
constexpr float before_mesh = static_cast<float>(scene::position_error);

template <class T, class F>
TOFRAY_INLINE Mask<F> leaves(const typename T::Free& form, const Leaving<F>& from) {
  if constexpr (T::facets == 1) return from.facet == Int<F>(form.facet);
  return (from.facet > Int<F>(form.facet - 1)) & (from.facet < Int<F>(form.facet + T::facets));
}

template <class T, class F>
TOFRAY_INLINE void take_met(const typename T::Free& form, F distance, Int<F> side, Met<F>& met) {
  const auto nearer = distance < met.distance;
  met.facet = num::select(nearer, Int<F>(form.facet) + side, met.facet);
  met.distance = num::select(nearer, distance, met.distance), met.lift = num::select(nearer, F(0.0f), met.lift);
}

/// A closed body: whoever is outside never meets it again, whoever is inside always does.
template <class T, class F>
TOFRAY_INLINE void meet_closed(const typename T::Free& form, const FreeRay<F>& ray, const Leaving<F>& from, Met<F>& met) {
  const shape::Passage<F> line = passage(form, ray);
  if (form.inside != 0) {
    take_met<T>(form, num::max(line.out, F(0.0f)), line.out_facet, met);
  } else {
    const auto meets = (line.in <= line.out) & (line.out > F(0.0f)) & (!leaves<T>(form, from));
    take_met<T>(form, num::select(meets, num::max(line.in, F(0.0f)), F(shape::never)), line.in_facet, met);
  }
}

template <class T, class F>
TOFRAY_INLINE void meet_flat(const typename T::Free& form, const FreeRay<F>& ray, const Leaving<F>& from, Met<F>& met) {
  Int<F> side;
  const F distance = distance_to(form, ray, F(0.0f), side);
  take_met<T>(form, num::select(leaves<T>(form, from), F(shape::never), distance), side, met);
}

template <class T, class F>
TOFRAY_NOINLINE void meet_mesh(const typename T::Free& form, const FreeRay<F>& ray, const Leaving<F>& from, Met<F>& met) {
  const F before = num::select(from.facet > Int<F>(-1), F(before_mesh) * (from.away + F(form.extent)), F(0.0f));
  const FreeRay<F> moved{
      num::fma(before, from.nx, ray.x), num::fma(before, from.ny, ray.y), num::fma(before, from.nz, ray.z), ray.dx, ray.dy, ray.dz};
  Int<F> triangle;
  const F distance = distance_to(form, moved, F(0.0f), met.distance, from.wanted, triangle);
  const auto nearer = distance < met.distance;
  met.facet = num::select(nearer, Int<F>(form.facet), met.facet);
  met.triangle = num::select(nearer, triangle, met.triangle);
  met.distance = num::select(nearer, distance, met.distance), met.lift = num::select(nearer, before, met.lift);
}

template <class T, class F>
TOFRAY_INLINE void meet_one(const typename T::Free& form, const FreeRay<F>& ray, const Leaving<F>& from, Met<F>& met) {
  if constexpr (T::closed) {
    meet_closed<T>(form, ray, from, met);
  } else if constexpr (shape::many_of<T>) {
    // What is handed to a function lies in memory; the originals need not.
    const FreeRay<F> ray_copy = ray;
    const Leaving<F> from_copy = from;
    Met<F> copy = met;
    meet_mesh<T>(form, ray_copy, from_copy, copy);
    met = copy;
  } else {
    meet_flat<T>(form, ray, from, met);
  }
}

/// Of many bodies those whose boxes a ray meets. They come in no order; of two at the same distance the first one is met all the same.
template <class T, class F>
TOFRAY_NOINLINE void meet_in_boxes(const typename T::Free* forms, const scene::Boxes& boxes, const FreeRay<F>& ray, const Leaving<F>& from,
                                   Met<F>& met) {
  RaysApart<F> rays;
  take_apart<F>(ray, met.distance, from.wanted, rays);
  Met<F> best{met.distance, Int<F>(-1), Int<F>(0), F(0.0f)};
  each_in_reach<F>(boxes, rays, [&](int body) TOFRAY_LAMBDA {
    const F beyond = num::fma(best.distance, F(1.0f + 1e-6f), F(1e-30f));  // so that what is as far is met, too
    Met<F> one{beyond, Int<F>(0), Int<F>(0), F(0.0f)};
    meet_one<T>(forms[body], ray, from, one);
    const auto better =
        (one.distance < beyond) & ((one.distance < best.distance) | ((!(one.distance > best.distance)) & (best.facet > one.facet)));
    best.distance = num::select(better, one.distance, best.distance);
    best.facet = num::select(better, one.facet, best.facet), best.triangle = num::select(better, one.triangle, best.triangle);
    best.lift = num::select(better, one.lift, best.lift);
  });
  const auto nearer = best.distance < met.distance;
  met.distance = num::select(nearer, best.distance, met.distance);
  met.facet = num::select(nearer, best.facet, met.facet), met.triangle = num::select(nearer, best.triangle, met.triangle);
  met.lift = num::select(nearer, best.lift, met.lift);
}

template <class T, class F>
TOFRAY_INLINE void meet_all(const scene::Group& group, int moment, const FreeRay<F>& ray, const Leaving<F>& from, Met<F>& met) {
  const int count = group.bodies.of<T>().count;
  if (count == 0) return;
  const typename T::Free* forms = group.derived.of<T>().free + moment * count;
  if constexpr (has_boxes<T, F>) {
    const scene::Boxes boxes = group.clusters.of<T>().around(moment);
    if (boxes.count > 0) {
      const FreeRay<F> ray_copy = ray;
      const Leaving<F> from_copy = from;
      Met<F> copy = met;
      meet_in_boxes<T, F>(forms, boxes, ray_copy, from_copy, copy);
      met = copy;
      return;
    }
  }
  for (int i = 0; i < count; ++i) meet_one<T>(forms[i], ray, from, met);
}
template <class... T, class F>
TOFRAY_NOINLINE void meet_each(shape::List<T...>, const scene::Group& group, int moment, const FreeRay<F>& ray, const Leaving<F>& from,
                               Met<F>& met) {
  (meet_all<T>(group, moment, ray, from, met), ...);
}

/// The nearest surface of all.
template <class F>
TOFRAY_INLINE Met<F> nearest_from(const scene::SceneView& s, int moment, const FreeRay<F>& ray, const Leaving<F>& from) {
  Met<F> met = nothing_met<F>();
  meet_each(shape::Shapes{}, s.still, 0, ray, from, met);
  if (s.moments > 0) meet_each(shape::Shapes{}, s.moving, moment, ray, from, met);
  return met;
}

/// Where and what it is: position, normal toward where the ray comes from, material; `range` is left to the caller.
template <class F>
TOFRAY_INLINE Surface<F> surface_met(const scene::SceneView& s, const FreeRay<F>& ray, const Leaving<F>& from, const Met<F>& met) {
  Surface<F> out;
  out.found = from.wanted & (met.distance < F(shape::never));
  const F t = num::select(out.found, met.distance, F(0.0f)), lift = num::select(out.found, met.lift, F(0.0f));
  // From where the ray began that met it: a point that is beside its triangle by that much may be on the other side, and the next ray leaves a
  // closed mesh.
  out.x = num::fma(t, ray.dx, num::fma(lift, from.nx, ray.x)), out.y = num::fma(t, ray.dy, num::fma(lift, from.ny, ray.y));
  out.z = num::fma(t, ray.dz, num::fma(lift, from.nz, ray.z));
  const shape::Direction<F> n = what_is_there(s, met.facet, met.triangle, out);
  face_camera(n.x, n.y, n.z, Ray<F>{ray.dx, ray.dy, ray.dz, F(1.0f), F(1.0f)}, out);
  return out;
}

}  // namespace tofray::trace
