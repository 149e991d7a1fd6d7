// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "depth/decode.h"
#include "flow/frame_view.h"

/// What looks at neighbours: flying pixels, and the image filters. Each is a pure function of one row and a view.
namespace tofray::depth {

/// Largest step in z that one surface may show between neighbours: grows linearly between two distances. [theory: flying-pixel-limit]
template <class F>
TOFRAY_INLINE F flying_limit(const camera::DecoderView& s, F z) {
  const F share =
      (num::min(num::max(z, F(s.flying_near_z)), F(s.flying_far_z)) - F(s.flying_near_z)) * F(1.0f / (s.flying_far_z - s.flying_near_z));
  return num::fma(share, F(s.flying_far_limit - s.flying_near_limit), F(s.flying_near_limit));
}

/// z and noise of a row's pixels, from the first of `count` on; neighbours stand around them in memory.
struct FlyingImage {
  const float* z;      ///< NaN where invalid, so that comparisons with an invalid neighbour are false
  const float* noise;  ///< σ̂ of the range [m]
  std::int32_t width;
};

/// Whether a neighbour's z is off by more than the limit.
template <class F>
TOFRAY_INLINE Mask<F> is_apart(const FlyingImage& image, int neighbour, int count, F here, F limit) {
  return num::abs(num::load<F>(image.z + neighbour, count) - here) > limit;
}
/// Whether a neighbour's z is off by more than k√(σ̂² + σ̂_n²), by squares.                                      [theory: flying-pixel-step]
template <class F>
TOFRAY_INLINE Mask<F> is_no_noise(const camera::DecoderView& s, const FlyingImage& image, int neighbour, int count, F here, F variance) {
  const F apart = num::load<F>(image.z + neighbour, count) - here, noise = num::load<F>(image.noise + neighbour, count);
  return apart * apart > F(s.flying_factor) * num::fma(noise, noise, variance);
}

/// Flying where both left and right, or both up and down, are valid and off by more than the limit and than their noise. Noise is looked
/// at only where a limit was passed, which is seldom; so next to nothing is added to the time of a frame.
template <class F>
TOFRAY_INLINE Mask<F> flies(const camera::DecoderView& s, const FlyingImage& image, int count, bool has_rows, bool has_left_right) {
  const F here = num::load<F>(image.z, count), limit = flying_limit(s, here);
  Mask<F> across = F(1.0f) < F(0.0f), down = across;
  if (has_left_right) across = is_apart(image, -1, count, here, limit) & is_apart(image, 1, count, here, limit);
  if (has_rows) down = is_apart(image, -image.width, count, here, limit) & is_apart(image, image.width, count, here, limit);
  if (!(s.flying_factor > 0) || !num::any(across | down)) return across | down;
  const F noise = num::load<F>(image.noise, count), variance = noise * noise;
  if (has_left_right) across = across & is_no_noise(s, image, -1, count, here, variance) & is_no_noise(s, image, 1, count, here, variance);
  if (has_rows)
    down = down & is_no_noise(s, image, -image.width, count, here, variance) & is_no_noise(s, image, image.width, count, here, variance);
  return across | down;
}

}  // namespace tofray::depth
