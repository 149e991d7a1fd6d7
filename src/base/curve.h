// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/spline.h"
#include "tofray/camera.h"
#include "tofray/error.h"

namespace tofray::base {

constexpr int read_cells = 1024;  ///< equal lines that stand for a pixel's nonlinearity in kernels; a power of two  [theory: nonlinearity]

/// A measured function of one variable as profiles give it: a limited not-a-knot spline through its samples, held at its first and last
/// value outside their range (a cubic that runs on would soon be far from anything measured). One sample is a constant. So it is never
/// below its lowest sample nor above its highest: what is a share of something stays one.
class ClampedCurve {
 public:
  /// @param what what the curve describes, for the message
  /// @throws Error (bad_input) for no samples, and as Spline does
  ClampedCurve(const Curve& curve, const std::string& what) : positions_(curve.x) {
    if (curve.y.empty()) throw Error(ErrorKind::bad_input, "error: " + what + " has no samples");
    first_ = curve.y.front();
    last_ = curve.y.back();
    lowest_ = *std::min_element(curve.y.begin(), curve.y.end());
    highest_ = *std::max_element(curve.y.begin(), curve.y.end());
    if (curve.y.size() > 1) spline_.emplace(curve.x, curve.y, Spline::Kind::limited);
  }

  [[nodiscard]] double evaluate(double x) const {
    if (!spline_ || x <= positions_.front()) return first_;
    return x >= positions_.back() ? last_ : std::clamp(spline_->evaluate(x), lowest_, highest_);  // rounding can push it beyond
  }

  /// Where one cubic ends and the next begins; empty for a constant.
  [[nodiscard]] std::vector<double> knots() const { return spline_ ? positions_ : std::vector<double>{}; }

 private:
  std::vector<double> positions_;
  std::optional<Spline> spline_;
  double first_ = 0, last_ = 0, lowest_ = 0, highest_ = 0;
};

}  // namespace tofray::base
