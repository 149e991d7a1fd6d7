// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "depth/decode.h"

/// Image filters over the range image, and what they leave of its noise. Invalid pixels are neither changed nor used, so that nothing
/// bleeds. Noise of different pixels is taken for independent.  [theory: gaussian-filter, median-filter, bilateral-filter, adaptive-filter]
namespace tofray::depth {

/// Range image, its noise, and flags that a filter reads.
struct RangeImage {
  const float* range;
  const float* noise;  ///< σ̂ [m]
  const std::uint16_t* flags;
  std::int32_t width, height;
  TOFRAY_INLINE bool valid(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && (flags[y * width + x] & invalid) == 0;
  }
  TOFRAY_INLINE float variance(int at) const { return noise[at] * noise[at]; }
};

struct Filtered {
  float range, noise;
};

/// Gaussian with the weights of the valid pixels in the window, normalised to their sum.                [theory: gaussian-filter]
TOFRAY_INLINE Filtered gaussian(const RangeImage& image, int x, int y, int radius, const float* weights) {
  float sum = 0, total = 0, variance = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      if (!image.valid(x + dx, y + dy)) continue;
      const int at = (y + dy) * image.width + x + dx;
      const float weight = weights[dx < 0 ? -dx : dx] * weights[dy < 0 ? -dy : dy];
      sum = num::fma(weight, image.range[at], sum);
      variance = num::fma(weight * weight, image.variance(at), variance);
      total += weight;
    }
  }
  return {sum / total, num::sqrt(variance) / total};
}

/// Median of the valid pixels in the window; of an even number the lower one of the middle two.           [theory: median-filter]
TOFRAY_INLINE Filtered median(const RangeImage& image, int x, int y, int radius) {
  float sorted[(2 * 4 + 1) * (2 * 4 + 1)], variance = 0;
  int count = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      if (!image.valid(x + dx, y + dy)) continue;
      const int at = (y + dy) * image.width + x + dx;
      const float value = image.range[at];
      variance += image.variance(at);
      int i = count++;
      for (; i > 0 && sorted[i - 1] > value; --i) sorted[i] = sorted[i - 1];
      sorted[i] = value;
    }
  }
  constexpr float half_pi = 1.57079633f;
  const float number = static_cast<float>(count);
  return {sorted[(count - 1) / 2], num::sqrt(variance / number * (half_pi / (number + (half_pi - 1.0f))))};
}

/// How far a neighbour's range may be off: s² = factor·(σ̂² + σ̂_n²) + square.
struct Reach {
  float factor, square;
};

/// Gaussian over the image times Tukey's biweight (1 − Δ²/s²)² over the range, normalised to their sum. What is left of the noise is
/// that of the function's slope: weights depend on ranges, too.                                          [theory: bilateral-filter]
TOFRAY_INLINE Filtered bilateral(const RangeImage& image, int x, int y, int radius, const float* weights, const Reach& reach) {
  const int middle = y * image.width + x;
  const float here = image.range[middle], variance = image.variance(middle);
  float sum = 0, total = weights[0] * weights[0];
  // of the slope by each neighbour, (a + m·b)/total with m the result's step: sums of a and b, and of their products times σ̂_n²
  float a_sum = 0, b_sum = 0, aa = 0, ab = 0, bb = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      if ((dx == 0 && dy == 0) || !image.valid(x + dx, y + dy)) continue;
      const int at = (y + dy) * image.width + x + dx;
      const float apart = image.range[at] - here, noise = image.variance(at);
      const float square = num::fma(reach.factor, variance + noise, reach.square);
      const float share = 1.0f - apart * apart / square;
      if (!(share > 0)) continue;
      const float weight = weights[dx < 0 ? -dx : dx] * weights[dy < 0 ? -dy : dy];
      const float a = weight * share * num::fma(5.0f, share, -4.0f), b = weight * share * 4.0f * apart / square;
      sum = num::fma(weight * share * share, apart, sum);
      total = num::fma(weight * share, share, total);
      a_sum += a, b_sum += b;
      aa = num::fma(a * a, noise, aa), ab = num::fma(a * b, noise, ab), bb = num::fma(b * b, noise, bb);
    }
  }
  const float step = sum / total, own = 1.0f - num::fma(step, b_sum, a_sum) / total;
  const float others = num::fma(step, num::fma(step, bb, 2.0f * ab), aa) / (total * total);
  return {here + step, num::sqrt(num::max(num::fma(own * own, variance, others), 0.0f))};
}

/// Mean of the pixel and of neighbours within k√(σ̂² + σ̂_n²) of it, weighted by 1/σ̂²: the window grows ring by ring until the noise is no
/// more than the goal.                                                                                    [theory: adaptive-filter]
/// @param factor  k²
/// @param goal    square of the noise that is good enough [m²]
TOFRAY_INLINE Filtered adaptive(const RangeImage& image, int x, int y, int radius, float factor, float goal) {
  constexpr float least = 1e-12f;  // [m²] of a neighbour: a micrometre
  const int middle = y * image.width + x;
  const float here = image.range[middle], variance = image.variance(middle);
  if (!(variance > goal) || !(variance > least)) return {here, image.noise[middle]};
  float weights = 1.0f / variance, sum = 0;
  for (int ring = 1; ring <= radius && goal * weights < 1.0f; ++ring) {
    for (int dy = -ring; dy <= ring; ++dy) {
      const int step = dy == -ring || dy == ring ? 1 : 2 * ring;
      for (int dx = -ring; dx <= ring; dx += step) {
        if (!image.valid(x + dx, y + dy)) continue;
        const int at = (y + dy) * image.width + x + dx;
        const float apart = image.range[at] - here, noise = num::max(image.variance(at), least);
        if (!(apart * apart <= factor * (variance + noise))) continue;
        weights += 1.0f / noise;
        sum += apart / noise;
      }
    }
  }
  return {here + sum / weights, num::sqrt(1.0f / weights)};
}

}  // namespace tofray::depth
