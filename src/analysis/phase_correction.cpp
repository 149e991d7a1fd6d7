// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/phase_correction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/constants.h"

namespace tofray::analysis {

PhaseCorrection::PhaseCorrection(const camera::DecoderView& decoder, const camera::DecodeModulation& modulation) {
  for (int j = 0; j < decoder.wiggling_nodes; ++j) value_.push_back(static_cast<double>(modulation.wiggling[4 * j]));
}

double PhaseCorrection::operator()(double measured) const {
  const double turns = measured / base::two_pi, nodes = static_cast<double>(value_.size());
  const double place = (turns - std::floor(turns)) * nodes, part = place - std::floor(place);
  const std::size_t node = std::min(static_cast<std::size_t>(place), value_.size() - 1), next = (node + 1) % value_.size();
  return measured + base::two_pi * ((1 - part) * value_[node] + part * value_[next]);
}

double PhaseCorrection::slope(double measured) const {
  const double turns = measured / base::two_pi, nodes = static_cast<double>(value_.size());
  const std::size_t node = std::min(static_cast<std::size_t>((turns - std::floor(turns)) * nodes), value_.size() - 1);
  return 1 + (value_[(node + 1) % value_.size()] - value_[node]) * nodes;
}

}  // namespace tofray::analysis
