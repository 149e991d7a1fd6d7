// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/lens/frozen_scatter.h"

#include <algorithm>
#include <cmath>

#include "effect/crosstalk.h"
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

/// Beyond 6 widths is 2e-9 of the light.
int radius_of(double sigma_px) { return static_cast<int>(std::ceil(6 * sigma_px)); }

}  // namespace

int scattered_radius(const Scatter& scatter) {
  if (!(scatter.share > 0)) return 0;
  int out = 0;
  if (scatter.kind == Scatter::Kind::kernel) out = std::max(scatter.columns, scatter.rows) / 2;
  if (scatter.kind != Scatter::Kind::gaussians) return out;
  for (std::size_t i = 0; i < scatter.sigma_px.size(); ++i)
    if (scatter.weights.empty() || scatter.weights[i] > 0) out = std::max(out, radius_of(scatter.sigma_px[i]));
  return out;
}

bool FrozenScatter::spreads(const Camera& camera) {
  return camera.lens.scatter.kind != Scatter::Kind::none || effect::Crosstalk::on(camera.pixel);
}

FrozenScatter::FrozenScatter(const Scatter& scatter, const Sensor& sensor, const Pixel& pixel) {
  const bool scatters = scatter.kind != Scatter::Kind::none && scatter.share > 0;
  if (scatters && scatter.kind == Scatter::Kind::kernel) {
    view_.separable = 0;
    add_kernel(scatter);
  } else if (scatters) {
    add_gaussians(scatter, std::max(sensor.width, sensor.height) - 1);
  }
  if (scatters) view_.kept = single(1 - scatter.share);
  add_sharing(pixel);
  view_.terms = static_cast<std::int32_t>(terms_.size()), view_.term = terms_.data();
}

/// Of its light a pixel gives a share to the neighbours on either side, of what the lens has brought there.          [theory: crosstalk]
void FrozenScatter::add_sharing(const Pixel& pixel) {
  if (!effect::Crosstalk::on(pixel)) return;
  view_.shares = 1;
  const auto [row, column] = effect::Crosstalk::shares(pixel);
  add_separable({row.before, row.own, row.after}, {column.before, column.own, column.after});
}

/// K(dx, dy) = row(dx)·column(dy).
void FrozenScatter::add_separable(const Weights& row, const Weights& column) {
  constexpr std::size_t pad = ScatterTerm::pad;
  std::vector<float> padded(row.size() + 2 * pad), other;
  for (std::size_t i = 0; i < row.size(); ++i) padded[i + pad] = single(row[i]), other.push_back(single(column[i]));
  const auto radius = static_cast<std::int32_t>(row.size() / 2);
  weights_.push_back(std::move(padded)), weights_.push_back(std::move(other));
  terms_.push_back({radius, weights_[weights_.size() - 2].data(), weights_.back().data()});
}

/// Integrals over pixels, or as far as the sensor goes.                                                   [theory: scatter-gaussians]
void FrozenScatter::add_gaussians(const Scatter& scatter, int most) {
  double sum = 0;
  const auto weight = [&](std::size_t i) { return scatter.weights.empty() ? 1.0 : scatter.weights[i]; };
  for (std::size_t i = 0; i < scatter.sigma_px.size(); ++i) sum += weight(i);
  for (std::size_t i = 0; i < scatter.sigma_px.size(); ++i) {
    if (weight(i) <= 0) continue;
    const double sigma = scatter.sigma_px[i], share = scatter.share * weight(i) / sum;
    const int radius = std::min(radius_of(sigma), most);
    Weights row, column;
    for (int d = -radius; d <= radius; ++d) row.push_back(share_of_pixel(sigma, d)), column.push_back(share * share_of_pixel(sigma, d));
    add_separable(row, column);
  }
}

void FrozenScatter::add_kernel(const Scatter& scatter) {
  const int radius = std::max(scatter.columns, scatter.rows) / 2;
  const std::size_t side = 2 * static_cast<std::size_t>(radius) + 1;
  std::vector<Weights> rows(side, Weights(side));
  const double largest = *std::max_element(scatter.kernel.begin(), scatter.kernel.end());
  double sum = 0;
  for (const double value : scatter.kernel) sum += value / largest;
  std::size_t at = 0;
  for (int row = 0; row < scatter.rows; ++row) {
    for (int column = 0; column < scatter.columns; ++column, ++at) {
      const int y = row - scatter.rows / 2 + radius, x = column - scatter.columns / 2 + radius;
      rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = scatter.share * (scatter.kernel[at] / largest) / sum;
    }
  }
  constexpr std::size_t pad = ScatterTerm::pad;
  const std::size_t stride = side + 2 * pad;
  std::vector<float> weights(stride * side);
  for (std::size_t y = 0; y < side; ++y)
    for (std::size_t x = 0; x < side; ++x) weights[y * stride + pad + x] = single(rows[y][x]);
  weights_.push_back(std::move(weights));
  terms_.push_back({static_cast<std::int32_t>(side / 2), weights_.back().data(), nullptr});
}

}  // namespace tofray::camera
