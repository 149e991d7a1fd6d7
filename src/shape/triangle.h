// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/polygon.h"

/// Triangle of three vertices, both sides reflect.
namespace tofray::shape {

using TriangleForm = PolygonForm<3>;
using TriangleAlong = PolygonAlong<3>;

struct Triangle {
  using Form = TriangleForm;
  using Along = TriangleAlong;
  using Free = PolygonFree<3>;
  static constexpr int facets = 1;
  static constexpr bool closed = false, curved = false;

  Vec vertex[3];

  /// What it turns about.
  template <class Said>
  static Vec center_of(const Said& said) {
    return (1.0 / 3) * (Placement::vec(said.vertices[0]) + Placement::vec(said.vertices[1]) + Placement::vec(said.vertices[2]));
  }
  /// Its surface as triangles, about what it turns about (shape/list.h says what `to` takes).
  template <class Said, class Sink>
  static void tessellate(const Said& said, Sink& to) {
    const Vec center = center_of(said);
    to.triangle(Placement::vec(said.vertices[0]) - center, Placement::vec(said.vertices[1]) - center,
                Placement::vec(said.vertices[2]) - center);
  }
  template <class Said>
  static Triangle placed(const Said& said, const Placement& at) {
    const Vec v[3] = {Placement::vec(said.vertices[0]), Placement::vec(said.vertices[1]), Placement::vec(said.vertices[2])};
    // Without a rotation the vertices keep their exact differences: meshes stay closed.
    const Vec about = at.turns() ? center_of(said) : Vec{0, 0, 0};
    return {{at.point(v[0], about), at.point(v[1], about), at.point(v[2], about)}};
  }
};

TOFRAY_INLINE Triangle in_frame(const Triangle& t, const CoordinateFrame& frame) {
  return {{frame.point(t.vertex[0]), frame.point(t.vertex[1]), frame.point(t.vertex[2])}};
}

TOFRAY_INLINE Span span_along(const Triangle& t, const Vec& a) { return span_of_points(t.vertex, 3, a); }
TOFRAY_INLINE double spread(const Triangle& t, const Vec& s) { return spread_of_corners(t.vertex, s); }
TOFRAY_INLINE void facet_of(const Triangle& t, int, Facet& out) { face(normalized(normal_of_corners(t.vertex)), out); }

TOFRAY_INLINE TriangleForm seen_from(const Triangle& t, const Vec& origin) { return polygon_seen_from(t.vertex, origin); }
TOFRAY_INLINE TriangleAlong seen_along(const Triangle& t, const Vec& s) { return polygon_seen_along(t.vertex, s); }

TOFRAY_INLINE PolygonFree<3> free_of(const Triangle& t) { return polygon_free(t.vertex); }

}  // namespace tofray::shape
