// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/common.h"

/// Box: |axis_k·(P − c)| <= half_k for k = 0, 1, 2.
namespace tofray::shape {

/// Per axis k of the box: d_k = d·axis_k. The ray is inside the slab for w_out_k <= w <= w_in_k, with
/// w_in = d_k·near_scale + near_offset and w_out = max(d_k·far_scale[0], d_k·far_scale[1]).
struct BoxForm {
  float axis[3][3];
  float near_scale[3], near_offset[3];
  float far_scale[3][2];
  std::int32_t facet, object;  ///< facet of axis 0; those of axes 1 and 2 follow
  std::int32_t inside;         ///< 1: the origin is inside the box: it sees the far side
  std::int32_t own_blocks;     ///< light's view: 1 where light and camera are on different sides of its surface
  Bounds bounds;
};

/// p_k = P·axis_k + offset_k, from the centre; slab k is left at t = (±half_k − p_k)·inverse_k.
struct BoxAlong {
  float axis[3][3], offset[3], half[3], inverse[3];
  std::int32_t object;
  std::int32_t own_blocks;  ///< 1: the camera is inside
  Bounds bounds;            ///< on the light's screen
};

/// For rays from anywhere: p_k = P·axis_k + offset_k, from the centre.
struct BoxFree {
  float axis[3][3], offset[3], half[3];
  std::int32_t facet, object, inside;  ///< inside: the camera is
};

struct Box {
  using Form = BoxForm;
  using Along = BoxAlong;
  using Free = BoxFree;
  static constexpr int facets = 3;
  static constexpr bool closed = true, curved = false;

  Vec center;
  Mat axes;
  Vec half;

  /// What it turns about.
  template <class Said>
  static Vec center_of(const Said& said) {
    return 0.5 * (Placement::vec(said.min) + Placement::vec(said.max));
  }
  /// Its surface as triangles, about what it turns about (shape/list.h says what `to` takes).
  template <class Said, class Sink>
  static void tessellate(const Said& said, Sink& to) {
    const Vec half = 0.5 * (Placement::vec(said.max) - Placement::vec(said.min));
    to.box(-1 * half, half);
  }
  template <class Said>
  static Box placed(const Said& said, const Placement& at) {
    const Vec low = Placement::vec(said.min), high = Placement::vec(said.max), center = center_of(said);
    return {at.point(center, center), {{at.direction({1, 0, 0}), at.direction({0, 1, 0}), at.direction({0, 0, 1})}}, 0.5 * (high - low)};
  }
};

TOFRAY_INLINE Box in_frame(const Box& b, const CoordinateFrame& frame) {
  return {
      frame.point(b.center), {{frame.direction(b.axes.row[0]), frame.direction(b.axes.row[1]), frame.direction(b.axes.row[2])}}, b.half};
}
/// How far a box about zero reaches along a.
TOFRAY_INLINE double reach_of_box(const Mat& axes, const Vec& half, const Vec& a) {
  const Vec along = axes * a;
  return half.x * ::fabs(along.x) + half.y * ::fabs(along.y) + half.z * ::fabs(along.z);
}
TOFRAY_INLINE Span span_along(const Box& b, const Vec& a) { return span_about(dot(b.center, a), reach_of_box(b.axes, b.half, a)); }
TOFRAY_INLINE bool inside(const Box& b, const Vec& p) {
  const Vec q = b.axes * (p - b.center);
  return ::fabs(q.x) < b.half.x && ::fabs(q.y) < b.half.y && ::fabs(q.z) < b.half.z;
}

TOFRAY_INLINE void facet_of(const Box& b, int side, Facet& out) { face(b.axes.row[side], out); }

TOFRAY_INLINE BoxForm seen_from(const Box& b, const Vec& origin) {
  BoxForm form{};
  const Vec center = b.axes * (b.center - origin);
  for (int k = 0; k < 3; ++k) {
    copy(b.axes.row[k], form.axis[k]);
    const double low = center[k] - b.half[k], high = center[k] + b.half[k];
    const bool between = low < 0 && high > 0;
    // Between the two sides the slab is entered at t = 0 (w = infinite) and left through the side that d points to.
    const double near_side = low >= 0 ? low : high, far_side = low >= 0 ? high : low;
    // Seen from the very plane of a side, the slab is where the axis points away from it: the sign does not come from a zero.
    form.near_scale[k] = between ? 0 : single(low >= 0 ? inverse(::fabs(low)) : -inverse(::fabs(high)));
    form.near_offset[k] = between ? single(huge) : 0;
    form.far_scale[k][0] = single(inverse(far_side));
    form.far_scale[k][1] = between ? single(inverse(near_side)) : form.far_scale[k][0];
  }
  Vec corners[8] = {};
  for (int i = 0; i < 8; ++i) {
    const Vec q{(i & 1 ? 1 : -1) * b.half.x, (i & 2 ? 1 : -1) * b.half.y, (i & 4 ? 1 : -1) * b.half.z};
    corners[i] = b.center + back(b.axes, q) - origin;
  }
  form.inside = inside(b, origin);
  form.own_blocks = (form.inside != 0) != inside(b, {0, 0, 0});
  form.bounds = form.inside != 0 ? unbounded() : bounds_of_points(corners, 8);
  return form;
}

TOFRAY_INLINE bool can_meet(const BoxForm& box, const Bounds& r) { return overlap(box.bounds, r); }

/// By slabs in w; `axis` says through which pair of sides the hit goes.
template <class F>
TOFRAY_INLINE F inverse_range(const BoxForm& box, const Ray<F>& ray, Int<F>& axis) {
  F enter = F(2e30f), leave = F(-2e30f);
  Int<F> enter_axis(0), leave_axis(0);
  for (int k = 0; k < 3; ++k) {
    const F d = dot(ray, box.axis[k]);
    const F in = num::fma(d, F(box.near_scale[k]), F(box.near_offset[k]));
    const F out = num::max(d * F(box.far_scale[k][0]), d * F(box.far_scale[k][1]));
    enter_axis = num::select(in < enter, Int<F>(k), enter_axis);
    enter = num::min(enter, in);
    leave_axis = num::select(out > leave, Int<F>(k), leave_axis);
    leave = num::max(leave, out);
  }
  if (box.inside != 0) {
    axis = leave_axis;
    return leave;
  }
  axis = enter_axis;
  return num::select(enter >= leave, enter, F(0.0f));
}

TOFRAY_INLINE BoxAlong seen_along(const Box& b, const Vec& s) {
  BoxAlong form{};
  const Vec direction = b.axes * s, center = b.axes * b.center;
  for (int k = 0; k < 3; ++k) {
    copy(b.axes.row[k], form.axis[k]);
    form.offset[k] = single(-center[k]), form.half[k] = single(b.half[k]), form.inverse[k] = single(inverse(direction[k]));
  }
  form.own_blocks = inside(b, {0, 0, 0});
  return form;
}

template <class F>
TOFRAY_INLINE Mask<F> blocks(const BoxAlong& box, const Place<F>& p, const float*, F margin) {
  F enter = F(0.0f), leave = F(3e38f);
  for (int k = 0; k < 3; ++k) {
    const F place = affine(p, box.axis[k], box.offset[k]);
    const F one = (F(-box.half[k]) - place) * F(box.inverse[k]), other = (F(box.half[k]) - place) * F(box.inverse[k]);
    enter = num::max(enter, num::min(one, other));
    leave = num::min(leave, num::max(one, other));
  }
  return leave > enter + margin;
}

TOFRAY_INLINE BoxFree free_of(const Box& b) {
  BoxFree form{};
  const Vec center = b.axes * b.center;
  for (int k = 0; k < 3; ++k) {
    copy(b.axes.row[k], form.axis[k]);
    form.offset[k] = single(-center[k]), form.half[k] = single(b.half[k]);
  }
  return form;
}

template <class F>
TOFRAY_INLINE Passage<F> passage(const BoxFree& b, const FreeRay<F>& ray) {
  const auto slab = [&](int k) TOFRAY_LAMBDA {
    return between_planes(placed(ray, b.axis[k], b.offset[k]), turned(ray, b.axis[k]), F(b.half[k]), Int<F>(k));
  };
  return common_passage(common_passage(slab(0), slab(1)), slab(2));
}

}  // namespace tofray::shape
