// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/frozen_scatter.h"

#include <algorithm>
#include <cmath>

#include "num/num.h"
#include "num/setup_math.h"

namespace tofray::camera {

using num::single;

namespace {

/// Share of a Gaussian, of width 1 and about 0, that lies below x.
double below(double x) { return 0.5 * num::setup::erfc(-x / std::sqrt(2.0)); }

/// Share of a Gaussian about the middle of a pixel that falls on the pixel `far` further on. Differences of small tails keep their digits.
double share_of_pixel(double sigma_px, int far) {
  const double d = std::abs(far);
  return below((-d + 0.5) / sigma_px) - below((-d - 0.5) / sigma_px);
}

}  // namespace

FrozenScatter::FrozenScatter(const Scatter& scatter, const Sensor& sensor) {
  if (scatter.kind == Scatter::Kind::none || scatter.share == 0) return;
  view_.kept = single(1 - scatter.share);
  if (scatter.kind == Scatter::Kind::kernel) {
    add_kernel(scatter);
  } else {
    double sum = 0;
    const auto weight = [&](std::size_t i) { return scatter.weights.empty() ? 1.0 : scatter.weights[i]; };
    for (std::size_t i = 0; i < scatter.sigma_px.size(); ++i) sum += weight(i);
    for (std::size_t i = 0; i < scatter.sigma_px.size(); ++i) {
      if (weight(i) > 0) add_gaussian(scatter.sigma_px[i], scatter.share * weight(i) / sum, std::max(sensor.width, sensor.height) - 1);
    }
  }
  view_.separable = scatter.kind == Scatter::Kind::gaussians;
  view_.terms = static_cast<std::int32_t>(terms_.size()), view_.term = terms_.data();
}

/// Integrals over pixels, up to 6 widths away (2e-9 of the light is beyond), or as far as the sensor goes.            [theory: eq. 7.5]
void FrozenScatter::add_gaussian(double sigma_px, double share, int most) {
  const int radius = std::min(static_cast<int>(std::ceil(6 * sigma_px)), most);
  constexpr int pad = ScatterTerm::pad;
  std::vector<float> row(static_cast<std::size_t>(2 * (radius + pad) + 1)), column;
  for (int i = -radius; i <= radius; ++i) {
    row[static_cast<std::size_t>(i + radius + pad)] = single(share_of_pixel(sigma_px, i));
    column.push_back(single(share * share_of_pixel(sigma_px, i)));
  }
  weights_.push_back(std::move(row)), weights_.push_back(std::move(column));
  terms_.push_back({radius, weights_[weights_.size() - 2].data(), weights_.back().data()});
}

void FrozenScatter::add_kernel(const Scatter& scatter) {
  const int radius = std::max(scatter.columns, scatter.rows) / 2;
  const auto stride = static_cast<std::size_t>(2 * (radius + ScatterTerm::pad) + 1);
  std::vector<float> weights(stride * static_cast<std::size_t>(2 * radius + 1));
  const double largest = *std::max_element(scatter.kernel.begin(), scatter.kernel.end());
  double sum = 0;
  for (const double value : scatter.kernel) sum += value / largest;
  std::size_t at = 0;
  for (int row = 0; row < scatter.rows; ++row) {
    for (int column = 0; column < scatter.columns; ++column, ++at) {
      const int y = row - scatter.rows / 2 + radius, x = column - scatter.columns / 2 + radius + ScatterTerm::pad;
      weights[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)] =
          single(scatter.share * (scatter.kernel[at] / largest) / sum);
    }
  }
  weights_.push_back(std::move(weights));
  terms_.push_back({radius, weights_.back().data(), nullptr});
}

}  // namespace tofray::camera
