// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/polygon.h"

/// Rectangle, both sides reflect: |x·(P − c)| <= width/2 and |y·(P − c)| <= height/2 in the plane of its axes x and y.
namespace tofray::shape {

struct Rectangle {
  using Form = PolygonForm<4>;
  using Along = PolygonAlong<4>;
  using Free = PolygonFree<4>;
  static constexpr int facets = 1;
  static constexpr bool closed = false, curved = false;

  Vec corner[4];

  /// What it turns about.
  template <class Said>
  static Vec center_of(const Said& said) {
    return Placement::vec(said.center);
  }
  /// Its surface as triangles, about what it turns about (shape/list.h says what `to` takes).
  template <class Said, class Sink>
  static void tessellate(const Said& said, Sink& to) {
    const double x = 0.5 * said.size[0], y = 0.5 * said.size[1];
    to.quad({-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0});
  }
  template <class Said>
  static Rectangle placed(const Said& said, const Placement& at) {
    const Vec given = center_of(said), center = at.point(given, given);
    const Vec x = at.direction({0.5 * said.size[0], 0, 0}), y = at.direction({0, 0.5 * said.size[1], 0});
    return {{center - x - y, center + x - y, center + x + y, center - x + y}};
  }
};

TOFRAY_INLINE Rectangle in_frame(const Rectangle& r, const CoordinateFrame& frame) {
  return {{frame.point(r.corner[0]), frame.point(r.corner[1]), frame.point(r.corner[2]), frame.point(r.corner[3])}};
}

TOFRAY_INLINE Span span_along(const Rectangle& r, const Vec& a) { return span_of_points(r.corner, 4, a); }
TOFRAY_INLINE double spread(const Rectangle& r, const Vec& s) { return spread_of_corners(r.corner, s); }
TOFRAY_INLINE void facet_of(const Rectangle& r, int, Facet& out) { face(normalized(normal_of_corners(r.corner)), out); }
TOFRAY_INLINE PolygonForm<4> seen_from(const Rectangle& r, const Vec& origin) { return polygon_seen_from(r.corner, origin); }
TOFRAY_INLINE PolygonAlong<4> seen_along(const Rectangle& r, const Vec& s) { return polygon_seen_along(r.corner, s); }

TOFRAY_INLINE PolygonFree<4> free_of(const Rectangle& r) { return polygon_free(r.corner); }

}  // namespace tofray::shape
