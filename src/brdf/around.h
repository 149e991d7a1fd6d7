// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "brdf/common.h"

/// Directions around an axis, for lobes that light is drawn from.
namespace tofray::brdf {

using flow::Direction;

template <class F>
TOFRAY_INLINE F inner(const Direction<F>& a, const Direction<F>& b) {
  return num::fma(a.x, b.x, num::fma(a.y, b.y, a.z * b.z));
}
/// a·A + b·B.
template <class F>
TOFRAY_INLINE Direction<F> sum_of(F a, const Direction<F>& A, F b, const Direction<F>& B) {
  return {num::fma(a, A.x, b * B.x), num::fma(a, A.y, b * B.y), num::fma(a, A.z, b * B.z)};
}
/// a·A + B.
template <class F>
TOFRAY_INLINE Direction<F> sum_of(F a, const Direction<F>& A, const Direction<F>& B) {
  return {num::fma(a, A.x, B.x), num::fma(a, A.y, B.y), num::fma(a, A.z, B.z)};
}
template <class F>
TOFRAY_INLINE Direction<F> select(num::Mask<F> m, const Direction<F>& a, const Direction<F>& b) {
  return {num::select(m, a.x, b.x), num::select(m, a.y, b.y), num::select(m, a.z, b.z)};
}
/// Of the same direction, of unit length. Not of zero.
template <class F>
TOFRAY_INLINE Direction<F> unit(const Direction<F>& a) {
  const F per_length = F(1.0f) / num::sqrt(flow::square_of(a.x, a.y, a.z));
  return {a.x * per_length, a.y * per_length, a.z * per_length};
}

/// What completes a unit vector to three at right angles, x × y = axis. Without a branch, and good to the last digits everywhere
/// [duff2017]: where the axis' z is negative, signs turn.
template <class F>
struct Axes {
  Direction<F> x, y;
};
template <class F>
TOFRAY_INLINE Axes<F> axes_across(const Direction<F>& axis) {
  const F sign = num::copy_sign(F(1.0f), axis.z), a = F(-1.0f) / (sign + axis.z), b = axis.x * axis.y * a;
  return {{num::fma(sign * a, axis.x * axis.x, F(1.0f)), sign * b, -sign * axis.x}, {b, num::fma(a, axis.y * axis.y, sign), -axis.y}};
}

/// The direction whose parts along and across the axis are given, `turns` around it.
template <class F>
TOFRAY_INLINE Direction<F> beside(const Direction<F>& axis, F along, F across, F turns) {
  const Axes<F> frame = axes_across(axis);
  F sine, cosine;
  num::sincos_turns(turns, sine, cosine);
  return sum_of(along, axis, sum_of(across * cosine, frame.x, across * sine, frame.y));
}
/// The direction whose tip is the root of this square, below 4, away from the axis': good however near it is.
template <class F>
TOFRAY_INLINE Direction<F> beside(const Direction<F>& axis, F square, F turns) {
  return beside(axis, num::fnma(F(0.5f), square, F(1.0f)), num::sqrt(num::max(square * num::fnma(F(0.25f), square, F(1.0f)), F(0.0f))),
                turns);
}
/// The mirror image of v about a, which is neither of unit length nor zero: 2·a·(v·a)/a² − v.
template <class F>
TOFRAY_INLINE Direction<F> mirrored(const Direction<F>& v, const Direction<F>& a) {
  return sum_of((F(2.0f) * inner(v, a)) / flow::square_of(a.x, a.y, a.z), a, F(-1.0f), v);
}

}  // namespace tofray::brdf
