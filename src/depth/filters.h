// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "depth/decode.h"

/// Image filters over the range image. Invalid pixels are neither changed nor used, so that nothing bleeds.
namespace tofray::depth {

/// Range image and flags that a filter reads.
struct RangeImage {
  const float* range;
  const std::uint16_t* flags;
  std::int32_t width, height;
  TOFRAY_FN bool valid(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height && (flags[y * width + x] & invalid) == 0; }
};

/// Gaussian with the weights of the valid pixels in the window, normalised to their sum.
TOFRAY_FN float gaussian(const RangeImage& image, int x, int y, int radius, const float* weights) {
  float sum = 0, total = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      if (!image.valid(x + dx, y + dy)) continue;
      const float weight = weights[dx < 0 ? -dx : dx] * weights[dy < 0 ? -dy : dy];
      sum = num::fma(weight, image.range[(y + dy) * image.width + x + dx], sum);
      total += weight;
    }
  }
  return sum / total;
}

/// Median of the valid pixels in the window; of an even number the lower one of the middle two.
TOFRAY_FN float median(const RangeImage& image, int x, int y, int radius) {
  float sorted[(2 * 4 + 1) * (2 * 4 + 1)];
  int count = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      if (!image.valid(x + dx, y + dy)) continue;
      const float value = image.range[(y + dy) * image.width + x + dx];
      int i = count++;
      for (; i > 0 && sorted[i - 1] > value; --i) sorted[i] = sorted[i - 1];
      sorted[i] = value;
    }
  }
  return sorted[(count - 1) / 2];
}

}  // namespace tofray::depth
