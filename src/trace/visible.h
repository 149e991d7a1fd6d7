// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "trace/nearest.h"

/// Shadow rays. They leave the light, so that all of them have one origin: d = P − L, and the surface itself is at w = 1.
namespace tofray::trace {

/// Shadow rays end a little before the surface, on the way from which it is seen. Where that way has come there is room: so they do not end
/// beyond another wall that meets it, however far the light, and no light passes a corner. It is this share of the distances from which the
/// point is known, and SceneView::roughness.
constexpr float way_back = static_cast<float>(scene::position_error);
/// How far before the surface shadow rays end [m]: at most half of the way, so that its beginning stays out.
template <class F>
TOFRAY_INLINE F room_before(const scene::SceneView& s, F away, F step) {
  return num::min(num::fma(F(2 * way_back), away, F(s.roughness)), F(0.5f) * step);
}

/// A point a little before a surface, on the way that leads to it.
/// @param way   the ray that leads to the surface, of any length
/// @param away  how far the surface is from the camera [m]
/// @param step  length of the way [m]
template <class F>
TOFRAY_INLINE Place<F> a_little_before(const scene::SceneView& s, const Place<F>& p, const Ray<F>& way, F away, F step) {
  const F back = room_before(s, away, step) * way.inverse_length;
  Place<F> out = p;
  out.x = num::fnma(back, way.x, p.x), out.y = num::fnma(back, way.y, p.y), out.z = num::fnma(back, way.z, p.z);
  out.range = away;
  return out;
}
/// A point a little before a surface that the camera sees: the way begins at the camera.
template <class F>
TOFRAY_INLINE Place<F> a_little_before(const scene::SceneView& s, const Place<F>& p, const Ray<F>& way) {
  return a_little_before(s, p, way, p.range, p.range);
}

/// An occluder must be nearer to the light than where its ray ends by this share of the distance: some roundings.
constexpr float shadow_margin = 0x1p-21f;
constexpr float before_surface = 1.0f / (1.0f + shadow_margin);

/// No object but a mesh shadows itself, since all others are flat or convex; but where light and camera are on different sides of a closed one, its surface
/// is in the dark (`own_blocks`).
/// @param hits  the lanes whose way to the light the form is in
template <class T, class F, class Form>
TOFRAY_INLINE Mask<F> shaded(const Form& form, Mask<F> hits, Int<F> own) {
  const auto mine = own == Int<F>(form.object);
  const auto dark = hits & (!mine);
  if constexpr (T::closed) {
    if (form.own_blocks != 0) return dark | mine;
  }
  return dark;
}

/// What one form keeps from a light, and what was in the dark before.
template <class T, class F>
TOFRAY_INLINE Mask<F> blocked_by_one(const typename T::Form& form, const Ray<F>& ray, const Place<F>& p, Mask<F> dark) {
  if constexpr (shape::many_of<T>) {
    return dark | stands_before(form, ray, F(before_surface), p.found & (!dark));
  } else {
    Int<F> facet;
    return dark | shaded<T, F>(form, hit_of<T>(form, ray, facet) > F(1.0f + shadow_margin), p.object);
  }
}
template <class T, class F, class Culled>
TOFRAY_INLINE Mask<F> blocked_by(const Culled& culled, const Ray<F>& ray, const Place<F>& p, Mask<F> dark) {
  if constexpr (by_tile<T, F, Culled>) return dark;
  for (auto i = culled.template iterate<T>(); i.more(); i.next()) dark = blocked_by_one<T>(i.form(), ray, p, dark);
  return dark;
}

template <class... T, class F, class Culled>
TOFRAY_INLINE Mask<F> blocked_by_each(shape::List<T...>, const Culled& culled, const Ray<F>& ray, const Place<F>& p) {
  Mask<F> dark = F(1.0f) < F(0.0f);
  ((dark = blocked_by<T>(culled, ray, p, dark)), ...);
  return dark;
}

/// True where a form stands between the light and the surface.
template <class F, class Culled>
TOFRAY_INLINE Mask<F> blocked(const Culled& culled, const Ray<F>& ray, const Place<F>& p) {
  return blocked_by_each(shape::Shapes{}, culled, ray, p);
}

template <class T, class F>
TOFRAY_INLINE Mask<F> blocked_along_one(const typename T::Along& form, const float* s, const Place<F>& p, F margin, Mask<F> dark) {
  const Mask<F> hits = blocks(form, p, s, margin);
  if constexpr (shape::many_of<T>) {
    return dark | hits;
  } else {
    return dark | shaded<T, F>(form, hits, p.object);
  }
}
template <class T, class F, class Culled>
TOFRAY_INLINE Mask<F> blocked_along(const Culled& culled, const float* s, const Place<F>& p, Mask<F> dark) {
  if constexpr (by_tile<T, F, Culled>) return dark;
  const F margin = F(shadow_margin) * p.range;
  for (auto i = culled.template iterate<T>(); i.more(); i.next()) dark = blocked_along_one<T>(i.form(), s, p, margin, dark);
  return dark;
}

template <class... T, class F, class Culled>
TOFRAY_INLINE Mask<F> blocked_along_each(shape::List<T...>, const Culled& culled, const float* s, const Place<F>& p) {
  Mask<F> dark = F(1.0f) < F(0.0f);
  ((dark = blocked_along<T>(culled, s, p, dark)), ...);
  return dark;
}

/// Where something stands between a surface and parallel light that comes from the unit direction s.
template <class F, class Culled>
TOFRAY_INLINE Mask<F> blocked_parallel(const Culled& culled, const float* s, const Place<F>& p) {
  return blocked_along_each(shape::Shapes{}, culled, s, p);
}

}  // namespace tofray::trace
