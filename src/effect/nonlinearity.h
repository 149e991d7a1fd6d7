// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "effect/sensor.h"

namespace tofray::effect {

/// What is read of a tap's charge: lines between equidistant charges from 0 on; the last one goes on.    [theory: nonlinearity]
struct ReadCurveView {
  const float* cell;  ///< [cells][2] what is read where a cell begins, and how much more at its end; null: the charge itself
  std::int32_t cells;
  float per_cell;  ///< 1/width of a cell [1/e⁻]
  float most;      ///< full well [e⁻]: no tap holds more
  bool operator==(const ReadCurveView&) const = default;
};

/// What is read of a tap's charge, and how it grows with it.                                           [theory: nonlinearity]
template <class F>
struct ReadCharge {
  F value, slope;
};

/// @param curve  not null; below 0 its first line goes on, beyond its end the last
template <class F>
TOFRAY_INLINE ReadCharge<F> read_charge(const ReadCurveView& curve, F charge) {
  const F place = charge * F(curve.per_cell);
  const F cell = num::min(num::max(num::floor(place), F(0.0f)), F(static_cast<float>(curve.cells - 1)));
  F value, step;
  num::gather_pair(curve.cell, num::to_int(cell), value, step);
  return {num::fma(place - cell, step, value), step * F(curve.per_cell)};
}

/// The cell in which this is read, by halves: a curve may bend to either side. There is a power of two of cells.
template <class F>
TOFRAY_INLINE F cell_of(const ReadCurveView& curve, F read) {
  F cell = F(0.0f), value, step;
  for (std::int32_t half = curve.cells / 2; half > 0; half /= 2) {
    const F upper = cell + F(static_cast<float>(half));
    num::gather_pair(curve.cell, num::to_int(upper), value, step);
    cell = num::select(read < value, cell, upper);
  }
  return cell;
}

/// Charge of which this is read: read_charge the other way round.                                     [theory: noise-as-read]
template <class F>
TOFRAY_INLINE F charge_of(const ReadCurveView& curve, F read) {
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

/// Full well per tap, and what is read of it. The well comes first: it holds charge, and the curve is that of the amplifier behind.
///                                                                                                      [theory: nonlinearity]
struct Nonlinearity {
  struct View {
    float full_well;  ///< [e⁻] of a tap
    float full_read;  ///< what is read of a full well
    ReadCurveView read;
    bool operator==(const View&) const = default;
  };
  /// Without a curve, which tabulate adds.
  template <class Camera>
  static void set(const Camera& camera, View& s) {
    const float full_well = static_cast<float>(camera.pixel.full_well_e);
    s.full_well = s.full_read = full_well < flow::max_charge ? full_well : flow::max_charge;
  }
  /// Lines between equidistant charges for what is read of them, as far as a tap can hold them.
  /// @param read   a function: what is read of a charge
  /// @param ends   charge at which it ends, full well at most [e⁻]
  /// @param cells  a power of two
  /// @param table  [cells][2]
  template <class Read>
  static void tabulate(const Read& read, double ends, int cells, float* table, View& s) {
    const double width = ends / cells;
    for (int i = 0; i < cells; ++i) {
      const double from = read(i * width), to = read((i + 1) * width);
      table[2 * i] = static_cast<float>(from), table[2 * i + 1] = static_cast<float>(to - from);
    }
    s.read = {table, cells, static_cast<float>(1 / width), s.full_well};
    s.full_read = read_charge(s.read, s.full_well).value;
  }
  static bool on(const View& s) { return s.read.cell != nullptr; }
  /// Wells add; the amplifier behind them reads as much of each.
  template <class Pixel>
  static void bin(Pixel& pixel, int n) {
    constexpr double no_well = 1e30;
    const double all = static_cast<double>(n) * n;
    pixel.full_well_e = pixel.full_well_e * all < no_well ? pixel.full_well_e * all : no_well;
    for (double& charge : pixel.nonlinearity.x) charge *= all;
    for (double& read : pixel.nonlinearity.y) read *= all;
  }
  template <class Camera>
  static double variance(const Camera&) {
    return 0;
  }

  template <class F>
  TOFRAY_INLINE static void change_reading(const View& s, TapPair<F>& charge) {
    if (s.read.cell == nullptr) return;
    charge = {read_charge(s.read, num::min(charge.a, F(s.full_well))).value, read_charge(s.read, num::min(charge.b, F(s.full_well))).value};
  }
};

}  // namespace tofray::effect
