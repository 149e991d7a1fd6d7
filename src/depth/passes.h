// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "depth/decode.h"
#include "flow/frame_view.h"

/// What looks at neighbours: flying pixels, and the image filters. Each is a pure function of one row and a view.
namespace tofray::depth {

/// Largest step in z that one surface may show between neighbours: grows linearly between two distances. [eq. 4.11]
template <class F>
TOFRAY_FN F flying_limit(const camera::DecoderView& s, F z) {
  const F share =
      (num::min(num::max(z, F(s.flying_near_z)), F(s.flying_far_z)) - F(s.flying_near_z)) * F(1.0f / (s.flying_far_z - s.flying_near_z));
  return num::fma(share, F(s.flying_far_limit - s.flying_near_limit), F(s.flying_near_limit));
}

/// Flying where both left and right, or both up and down, are valid and off by more than the limit. z is NaN where invalid, so that
/// comparisons with an invalid neighbour are false.
template <class F>
TOFRAY_FN Mask<F> flies(const camera::DecoderView& s, const float* z, std::int32_t width, int count, bool has_rows, bool has_left_right) {
  const F here = num::load<F>(z, count), limit = flying_limit(s, here);
  Mask<F> apart = F(1.0f) < F(0.0f);
  if (has_left_right) {
    apart = (num::abs(num::load<F>(z - 1, count) - here) > limit) & (num::abs(num::load<F>(z + 1, count) - here) > limit);
  }
  if (has_rows) {
    apart = apart | ((num::abs(num::load<F>(z - width, count) - here) > limit) & (num::abs(num::load<F>(z + width, count) - here) > limit));
  }
  return apart;
}

}  // namespace tofray::depth
