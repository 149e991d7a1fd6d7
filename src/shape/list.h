// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/list.h"
#include "shape/box.h"
#include "shape/capsule.h"
#include "shape/cone.h"
#include "shape/cylinder.h"
#include "shape/disk.h"
#include "shape/mesh_search.h"
#include "shape/plane.h"
#include "shape/rectangle.h"
#include "shape/sphere.h"
#include "shape/triangle.h"

/// All shapes, and what everything else asks of one. No other file but a shape's own names it.
///
///     a shape T        its numbers in double precision: in the world, or in the camera's frame
///     T::placed        … out of the public struct
///     T::center_of     … what that turns about
///     T::tessellate    … its surface as triangles about that point, seen from outside, for those who draw it: to.triangle(a, b, c),
///                      to.quad(a, b, c, d), to.box(low, high); or an outline out of to.corner(radius, along) and to.arc(radius, middle,
///                      from, to), which to.turn_about(axis) turns. Of what has no end it is a square of ±to.patch_m
///     in_frame(T, …)   … as seen in another frame
///     T::Form          what rays of a common origin need; seen_from(T, origin) makes it, the camera being at 0
///     T::Along         what light from one direction needs; seen_along(T, direction) makes it
///     T::Free          what rays from anywhere need; free_of(T) makes it; passage(Free, ray) says where they are within what is closed,
///                      distance_to(Free, ray, …) where they meet anything else
///     span_along(T, a) from where to where it reaches along a unit vector, unless it has no end
///     T::facets        how many a hit may name; facet_of(T, side, …) says which way they face
///     T::closed        it has an inside: its forms say where its own surface is in the dark (own_blocks)
///     T::curved        T::normal(facet, P) finds the normal of those that face_of does not make flat
///     can_meet(Form, rectangle), inverse_range(Form, ray[, side]), blocks(Along, P, …)
///     Form::bounds, Along::bounds    rectangles of directions, and on the light's screen, that hold it, unless it has no end
///     many_of<T>       it is made of many triangles: nearest_in(Form, ray, hit) and stands_before(Form, ray, …) in place of
///                      inverse_range, and T::normal(facet, triangle); search_tile(Form, rays), search_tile(Along, rays) in place of
///                      all three where has_beams
namespace tofray::shape {

using num::List;
using num::place_in;

/// Made of many triangles, which may shade each other.
template <class T>
constexpr bool many_of = requires {
  T::many;
};

/// It ends somewhere, so that its forms have bounds.
template <class T>
constexpr bool bounded = requires(typename T::Form form) {
  form.bounds;
};

/// In the order of the public Object's variant. Of two surfaces at one place the first shape's is seen.
using Shapes = List<Plane, Sphere, Box, Triangle, Cylinder, Rectangle, Disk, Capsule, Cone, Mesh>;

/// One Each<T> for every shape T.
template <template <class> class Each, class List>
struct OneForEach;
template <template <class> class Each, class... T>
struct OneForEach<Each, List<T...>> : Each<T>... {
  bool operator==(const OneForEach&) const = default;
};
template <template <class> class Each>
struct ByShape : OneForEach<Each, Shapes> {
  template <class T>
  TOFRAY_INLINE Each<T>& of() {
    return *this;
  }
  template <class T>
  TOFRAY_INLINE const Each<T>& of() const {
    return *this;
  }
  bool operator==(const ByShape&) const = default;
};

}  // namespace tofray::shape
