// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

#include "scene/view.h"

/// Forms and facets out of the bodies, for a camera's pose and a frame's times. One unit of work is one body as seen from one point at one
/// time; none depends on another, so that a thread of a GPU can do each. The same text, and the same bits, on every machine.
namespace tofray::scene {

template <class T>
TOFRAY_INLINE void derive_facets(const Body<T>& body, const T& seen, Facet* facets) {
  for (int side = 0; side < T::facets; ++side) {
    Facet facet{};
    facet.curved = T::curved ? 1 + shape::place_in<T>(shape::Shapes{}) : 0;
    facet.object = body.object, facet.material = body.material;
    facet_of(seen, side, facet);
    facets[body.facet + side] = facet;
  }
}

/// The body in the camera's frame.
template <class T>
TOFRAY_INLINE T body_at(const SceneView& s, const Body<T>& body, int moment) {
  return in_frame(body.shape, body.mover < 0 ? s.camera : s.frames[moment * s.movers + body.mover]);
}

/// @param eye     0: the camera; then the lights; then the sun
/// @param facets  of the group in this moment; null: they are not wanted
/// @param first   number of the group's first facet in this moment
template <class T>
TOFRAY_INLINE void derive_body(const SceneView& s, const Group& group, int moment, int i, int eye, bool forms, Facet* facets, int first) {
  const int count = group.bodies.of<T>().count;
  const Body<T>& body = group.bodies.of<T>().at(moment, i);
  const T seen = body_at(s, body, moment);
  if (facets != nullptr) derive_facets(body, seen, facets);
  if (!forms) return;
  if (eye > s.lights) {
    typename T::Along along = seen_along(seen, s.toward_sun[moment]);
    along.object = body.object;
    if constexpr (shape::bounded<T>) along.bounds = bounds_along(seen, s.toward_sun[moment]);
    group.derived.of<T>().along[moment * count + i] = along;
    return;
  }
  if (eye == 0 && s.bounces != 0) {
    typename T::Free free = free_of(seen);
    free.facet = first + body.facet, free.object = body.object;
    if constexpr (T::closed) free.inside = inside(seen, {0, 0, 0});
    group.derived.of<T>().free[moment * count + i] = free;
  }
  typename T::Form form = seen_from(seen, eye == 0 ? shape::Vec{0, 0, 0} : s.light_positions[eye - 1]);
  form.facet = first + body.facet, form.object = body.object;
  group.derived.of<T>().forms[(moment * (1 + s.lights) + eye) * count + i] = form;
}

/// Body number `i` of all shapes.
template <class... T>
TOFRAY_INLINE void derive_any(shape::List<T...>, const SceneView& s, const Group& group, int moment, int i, int eye, bool forms,
                              Facet* facets, int first) {
  ((i >= 0 && i < group.bodies.of<T>().count ? derive_body<T>(s, group, moment, i, eye, forms, facets, first) : void(),
    i -= group.bodies.of<T>().count),
   ...);
}

/// What is wanted: the facets and forms of what moves and the facets of what stands still; or these and the forms of what stands still.
enum class Derive : std::int32_t { moving, all };

TOFRAY_INLINE int eyes_of(const SceneView& s) { return 1 + s.lights + (s.has_sun != 0 ? 1 : 0); }
TOFRAY_INLINE int moving_units(const SceneView& s) { return s.moments * eyes_of(s) * s.moving.body_count; }
TOFRAY_INLINE int unit_count(const SceneView& s, Derive what) {
  return moving_units(s) + (what == Derive::all ? eyes_of(s) : 1) * s.still.body_count;
}

/// Unit number `unit`.
TOFRAY_INLINE void derive(const SceneView& s, Derive what, int unit) {
  const int eyes = eyes_of(s), moving = moving_units(s);
  if (unit < moving) {
    const int i = unit % s.moving.body_count, row = unit / s.moving.body_count, eye = row % eyes, moment = row / eyes;
    const int first = s.still.facet_count + moment * s.moving.facet_count;
    derive_any(shape::Shapes{}, s, s.moving, moment, i, eye, true, eye == 0 ? s.facets + first : nullptr, first);
  } else {
    const int i = (unit - moving) % s.still.body_count, eye = (unit - moving) / s.still.body_count;
    derive_any(shape::Shapes{}, s, s.still, 0, i, eye, what == Derive::all, eye == 0 ? s.facets : nullptr, 0);
  }
}

/// Facets of a frame, one at least: where nothing is hit, facet 0 is read all the same, and what it says is thrown away.
TOFRAY_INLINE int facet_count(const SceneView& s) {
  const int count = s.still.facet_count + s.moments * s.moving.facet_count;
  return count > 0 ? count : 1;
}

/// Tells place(pointer, count) of the arrays of one group.
template <class... T, class Place>
void each_derived(shape::List<T...>, const SceneView& s, Group& group, int moments, Place& place) {
  ((place(group.derived.of<T>().forms, static_cast<std::size_t>(group.bodies.of<T>().count * (1 + s.lights) * moments)),
    place(group.derived.of<T>().along, static_cast<std::size_t>(s.has_sun != 0 ? group.bodies.of<T>().count * moments : 0)),
    place(group.derived.of<T>().free, static_cast<std::size_t>(s.bounces != 0 ? group.bodies.of<T>().count * moments : 0))),
   ...);
}
/// Tells place(pointer, count) of all arrays that derive() fills, in an order that is always the same.
template <class Place>
void each_derived(SceneView& s, Derive what, Place&& place) {
  if (what == Derive::all) each_derived(shape::Shapes{}, s, s.still, 1, place);
  each_derived(shape::Shapes{}, s, s.moving, s.moments, place);
  place(s.facets, static_cast<std::size_t>(facet_count(s)));
}

}  // namespace tofray::scene
