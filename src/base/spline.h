// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

namespace tofray::base {

/// A piecewise cubic through given samples (knots).
///
/// Between x_i and x_{i+1}, with t = x − x_i:   s = y_i + t·(b_i + t·(c_i + t·d_i))   (b, c, d: members `slope`, `square`, `cube` below).
/// All values, derivatives and integrals are those of this function, without further error than rounding.
class Spline {
 public:
  enum class Kind {
    /// C² everywhere, and the third derivative is continuous at the second and the last-but-one knot. 2 knots give a line, 3 a
    /// parabola, 4 one cubic; any cubic is reproduced exactly. Beyond the ends the outer pieces go on.  [theory: not-a-knot]
    not_a_knot,
    /// A not-a-knot spline that never turns between two samples: monotone wherever they are, and never beyond the two beside it. Where a piece
    /// would turn, the slopes at its ends are limited (0 where the samples turn); elsewhere it is the spline above.
    ///                                                                                                        [theory: monotone-spline]
    limited,
    /// C² with period x_last − x_first; the last value must equal the first. 2 knots give a constant. Arguments: modulo the period.
    periodic,
    /// Straight lines between the knots; beyond the ends the outer ones go on.
    linear,
  };

  /// @param x knots, strictly ascending, at least 2
  /// @param y values, as many
  /// @throws Error (bad_input) for fewer than 2 knots, sizes that differ, knots not ascending, numbers not finite, and
  ///         (periodic) a last value that differs from the first
  Spline(std::vector<double> x, std::vector<double> y, Kind kind = Kind::not_a_knot);

  [[nodiscard]] double evaluate(double x) const;
  /// ds/dx; at a knot of a linear one: to the right of it.
  [[nodiscard]] double derivative(double x) const;
  /// ∫_a^b s dx; negative for b < a.
  [[nodiscard]] double integral(double a, double b) const;

  [[nodiscard]] const std::vector<double>& x() const { return x_; }
  [[nodiscard]] const std::vector<double>& y() const { return y_; }
  [[nodiscard]] Kind kind() const { return kind_; }

 private:
  /// Where x lies: its interval, and its distance from the interval's left knot.
  struct Place {
    std::size_t interval;
    double offset;
  };
  [[nodiscard]] Place place(double x) const;
  [[nodiscard]] double wrapped(double x) const;
  [[nodiscard]] double integral_from_start(double x) const;
  void pieces_from_slopes(const std::vector<double>& slope);

  Kind kind_;
  std::vector<double> x_, y_;
  std::vector<double> slope_, square_, cube_;  // per interval: b, c, d
  std::vector<double> area_;                   // per knot: ∫ from the first knot to it
};

}  // namespace tofray::base
