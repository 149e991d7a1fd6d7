// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/decoder/view.h"

namespace tofray::depth {

/// Confidence 255·p·max(0, 1 − σ̂/0.07 m), rounded.                                                 [theory: confidence]
/// @param trust  p, how likely the range is on the right cycle
template <class F>
TOFRAY_INLINE num::Int<F> confidence(const camera::DecoderView& s, F noise, F trust) {
  return num::to_int(num::round_even(F(255.0f) * trust * num::max(num::fnma(noise, F(s.per_confidence_noise), F(1.0f)), F(0.0f))));
}

}  // namespace tofray::depth
