// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/readout/image_camera.h"

#include <algorithm>
#include <cmath>

#include "base/readout.h"
#include "effect/list.h"

namespace tofray::camera {

namespace {

/// Pixels lie n apart: what a kernel moves from pixel to pixel moves by fewer of them, each of the n × n places in a pixel as likely.
void bin_kernel(Scatter& scatter, int n) {
  const int rows = (scatter.rows / 2 + n - 1) / n, columns = (scatter.columns / 2 + n - 1) / n, wide = 2 * columns + 1;
  std::vector<double> out(static_cast<std::size_t>(2 * rows + 1) * static_cast<std::size_t>(wide));
  const auto step = [n](int place, int by) { return static_cast<int>(std::floor(static_cast<double>(place + by) / n)); };
  std::size_t at = 0;
  for (int dy = -(scatter.rows / 2); dy <= scatter.rows / 2; ++dy)
    for (int dx = -(scatter.columns / 2); dx <= scatter.columns / 2; ++dx, ++at)
      for (int place = 0; place < n * n; ++place)
        out[static_cast<std::size_t>((step(place / n, dy) + rows) * wide + step(place % n, dx) + columns)] += scatter.kernel[at];
  scatter.kernel = std::move(out), scatter.rows = 2 * rows + 1, scatter.columns = wide;
}

/// Light is collected in n × n places, where it was in one.
void repeat_mask(Sensor& sensor, int n) {
  PixelMask& mask = sensor.mask;
  if (mask.kind == PixelMask::Kind::square) {
    mask = {PixelMask::Kind::table, {1}, 1, 1};  // squares so close to each other are as good as the whole
    return;
  }
  PixelMask out{PixelMask::Kind::table, {}, n * mask.columns, n * mask.rows};
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.columns; ++x)
      out.samples.push_back(mask.samples[static_cast<std::size_t>(y % mask.rows * mask.columns + x % mask.columns)]);
  mask = std::move(out);
}

/// Directions stay what they are; pixels are n times as large.                                  [theory: image-pixels]
void bin_lens(Lens& lens, int n) {
  constexpr double narrowest = 0.1;  // [px] of a Gaussian: it stays in its pixel
  lens.fx_px /= n, lens.fy_px /= n;
  lens.cx_px = (lens.cx_px + 0.5) / n - 0.5, lens.cy_px = (lens.cy_px + 0.5) / n - 0.5;
  if (lens.scatter.kind == Scatter::Kind::kernel) bin_kernel(lens.scatter, n);
  for (double& sigma : lens.scatter.sigma_px) sigma = std::max(sigma / n, narrowest);
}

}  // namespace

ImageCamera::ImageCamera(const Camera& profile) : Camera(profile) {
  const Readout r = profile.readout;
  readout = {};
  const base::ImageExtent image = base::image_extent(profile);
  sensor.width = image.width, sensor.height = image.height;
  lens.cx_px -= r.left, lens.cy_px -= r.top;
  if (r.binning == 1) return;
  sensor.pixel_pitch_m *= r.binning;
  repeat_mask(sensor, r.binning);
  bin_lens(lens, r.binning);
  effect::bin(pixel, r.binning);
}

}  // namespace tofray::camera
