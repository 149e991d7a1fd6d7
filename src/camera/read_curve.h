// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/views.h"

namespace tofray::camera {

/// What is read of a tap's charge, and how it grows with it.                                               [theory: eq. 3.18]
template <class F>
struct ReadCharge {
  F value, slope;
};

/// @param curve  not null; below 0 its first line goes on, beyond its end the last
template <class F>
TOFRAY_FN ReadCharge<F> read_charge(const ReadCurveView& curve, F charge) {
  const F place = charge * F(curve.per_cell);
  const F cell = num::min(num::max(num::floor(place), F(0.0f)), F(static_cast<float>(curve.cells - 1)));
  F value, step;
  num::gather_pair(curve.cell, num::to_int(cell), value, step);
  return {num::fma(place - cell, step, value), step * F(curve.per_cell)};
}

}  // namespace tofray::camera
