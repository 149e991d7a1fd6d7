// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "depth/filters.h"

/// A mean over frames that follow each other, pixel by pixel, and what it leaves of the noise.            [theory: temporal-mean]
namespace tofray::depth {

/// Range and noise of a frame before; the range of an invalid pixel is NaN.
struct PastFrame {
  const float* range;
  const float* noise;
};

/// Mean of a pixel and of what it was in earlier frames within k√(σ̂² + σ̂_n²) of it, weighted by 1/σ̂².
/// Of an invalid pixel, whose range is NaN, nothing is near.
/// @param past    the youngest first
/// @param factor  k²
TOFRAY_INLINE Filtered mean_over_time(const RangeImage& image, const PastFrame* past, int count, int at, float factor) {
  constexpr float least = 1e-12f;  // [m²] of a frame: a micrometre
  const float here = image.range[at], variance = num::max(image.variance(at), least);
  const float own = 1.0f / variance;
  float weights = own, sum = 0;
  for (int n = 0; n < count; ++n) {
    const float apart = past[n].range[at] - here, noise = num::max(past[n].noise[at] * past[n].noise[at], least);
    if (!(apart * apart <= factor * (variance + noise))) continue;
    weights += 1.0f / noise;
    sum += apart / noise;
  }
  if (!(weights > own)) return {here, image.noise[at]};  // no other frame counts
  return {here + sum / weights, num::sqrt(1.0f / weights)};
}

}  // namespace tofray::depth
