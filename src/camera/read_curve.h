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

/// The cell in which this is read, by halves: a curve may bend to either side. There is a power of two of cells.
template <class F>
TOFRAY_FN F cell_of(const ReadCurveView& curve, F read) {
  F cell = F(0.0f), value, step;
  for (std::int32_t half = curve.cells / 2; half > 0; half /= 2) {
    const F upper = cell + F(static_cast<float>(half));
    num::gather_pair(curve.cell, num::to_int(upper), value, step);
    cell = num::select(read < value, cell, upper);
  }
  return cell;
}

/// Charge of which this is read: read_charge the other way round.                                          [theory: eq. 4.21]
template <class F>
TOFRAY_FN F charge_of(const ReadCurveView& curve, F read) {
  // Most curves are nearly straight: along the line at a first guess lies the cell, unless its neighbour's beginning says otherwise.
  const F last = F(static_cast<float>(curve.cells - 1));
  F cell = num::min(num::max(num::floor(read * F(curve.per_cell)), F(0.0f)), last), value, step, next, unused;
  num::gather_pair(curve.cell, num::to_int(cell), value, step);
  cell = num::min(num::max(num::floor(cell + (read - value) / num::max(step, F(1e-20f))), F(0.0f)), last);
  num::gather_pair(curve.cell, num::to_int(cell), value, step);
  num::gather_pair(curve.cell, num::to_int(num::min(cell + F(1.0f), last)), next, unused);
  const auto found = ((value <= read) | (cell == F(0.0f))) & ((read < next) | (cell == last));
  if (!num::all(found)) {
    cell = num::select(found, cell, cell_of(curve, read));
    num::gather_pair(curve.cell, num::to_int(cell), value, step);
  }
  const F charge = (cell + (read - value) / num::max(step, F(1e-20f))) * F(1.0f / curve.per_cell);
  return num::max(num::min(charge, F(curve.most)), F(-curve.most));
}

}  // namespace tofray::camera
