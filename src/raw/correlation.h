// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "effect/sensor.h"

/// Correlation of the light with the pixel's gate.                                         [theory: two-taps, correlation]
namespace tofray::raw {

using effect::correlated;
using effect::TapPair;
using flow::Light;
using num::Mask;

/// D/t_int = Re Σ_m Z_m·e^{imτ} of one raw frame; τ from where the modulation's sources begin. At quarter turns e^{imτ} is ±1 or ±i, and the
/// sums are there already.                                                                                            [theory: correlation]
template <class F>
TOFRAY_INLINE F difference_rate(const effect::RawFrameView& frame, int orders, const Light<F>& light) {
  const int j = frame.modulation;
  switch (frame.gate_kind) {
    case effect::Gate::in_phase: return light.in_phase[j];
    case effect::Gate::opposite: return -light.in_phase[j];
    case effect::Gate::quarter_early: return light.quarter[j];
    case effect::Gate::quarter_late: return -light.quarter[j];
    case effect::Gate::other: break;
  }
  const F *real = light.real + j * orders, *imaginary = light.imaginary + j * orders;
  return orders <= 4 ? correlated<4>(frame.gate, real, imaginary) : correlated<flow::max_harmonics>(frame.gate, real, imaginary);
}

/// N_A,B = ½(S + B) ± ½D + dark; below zero counts as zero. In an unlit raw frame the gate rests on A, which takes all ambient light.
///                                                                                                                       [theory: two-taps]
template <class F>
TOFRAY_INLINE TapPair<F> tap_means(const effect::RawFrameView& frame, F signal_rate, F ambient_rate, F difference) {
  const F dark = F(frame.dark);
  if (frame.lit == 0) return {num::fma(ambient_rate, F(frame.integration_time), dark), dark};
  const F common = signal_rate + ambient_rate, half_time = F(0.5f * frame.integration_time);
  return {num::fma(num::max(common + difference, F(0.0f)), half_time, dark),
          num::fma(num::max(common - difference, F(0.0f)), half_time, dark)};
}

}  // namespace tofray::raw
