// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/views.h"

/// Correlation of the light with the pixel's gate.                                                  [theory: eq. 3.1–3.4]
namespace tofray::raw {

using flow::Light;
using num::Mask;

/// Phasors P_m = Σ_lights S_l·a_m·e^{iψ_m}·e^{imφ_l} of one modulation frequency, electrons per second; m = 1, 3, 5, 7 …
template <class F>
struct Phasors {
  F real[flow::max_harmonics], imaginary[flow::max_harmonics];
};

/// Phase of a path in turns, φ/2π = ℓ·f/c less whole turns. The factor comes in two parts so that long paths keep their last digits.
template <class F>
TOFRAY_FN F path_turns(const camera::ModulationView& modulation, F path_length) {
  const F whole = num::round_even(path_length * F(modulation.turns_per_metre_high));
  return num::fma(path_length, F(modulation.turns_per_metre_low), num::fma(path_length, F(modulation.turns_per_metre_high), -whole));
}

template <class F>
TOFRAY_FN Phasors<F> correlate(const camera::SensorView& s, const camera::ModulationView& modulation, const Light<F>& light, int lights, F delay) {
  Phasors<F> sum;
  for (int h = 0; h < s.harmonics; ++h) sum.real[h] = F(0.0f), sum.imaginary[h] = F(0.0f);
  for (int l = 0; l < lights; ++l) {
    const F turns = path_turns(modulation, light.path_length[l]) + num::fma(delay, F(modulation.frequency), F(modulation.delay_turns));
    F sine, cosine;
    num::sincos_turns(turns, sine, cosine);
    // e^{imφ} for odd m: times e^{2iφ} from one to the next
    const F step_real = num::fma(cosine, cosine, -(sine * sine)), step_imaginary = F(2.0f) * sine * cosine;
    F real = cosine * light.signal_rate[l], imaginary = sine * light.signal_rate[l];
    for (int h = 0; h < s.harmonics; ++h) {
      const F a = F(modulation.real[l][h]), b = F(modulation.imaginary[l][h]);
      sum.real[h] = num::fma(real, a, num::fma(-imaginary, b, sum.real[h]));
      sum.imaginary[h] = num::fma(real, b, num::fma(imaginary, a, sum.imaginary[h]));
      const F next = num::fma(real, step_real, -(imaginary * step_imaginary));
      imaginary = num::fma(real, step_imaginary, imaginary * step_real);
      real = next;
    }
  }
  return sum;
}

/// D/t_int = Re Σ_m P_m·e^{imτ}.                                                                             [eq. 3.2]
template <class F>
TOFRAY_FN F difference_rate(const camera::RawFrameView& frame, const Phasors<F>& phasors, int harmonics) {
  F sum = F(0.0f);
  for (int h = 0; h < harmonics; ++h) {
    sum = num::fma(phasors.real[h], F(frame.cosine[h]), num::fma(-phasors.imaginary[h], F(frame.sine[h]), sum));
  }
  return sum;
}

/// Expected electrons of the two taps.
template <class F>
struct Means {
  F a, b;
};

/// N_A,B = ½(S + B) ± ½D + dark; below zero counts as zero. In an unlit raw frame the gate rests on A, which takes all ambient light. [eq. 3.1]
template <class F>
TOFRAY_FN Means<F> tap_means(const camera::SensorView& s, const camera::RawFrameView& frame, F signal_rate, F ambient_rate, F difference) {
  const F t = F(frame.integration_time), dark = F(s.dark_rate) * t;
  if (frame.lit == 0) return {num::fma(ambient_rate, t, dark), dark};
  const F common = F(0.5f) * (signal_rate + ambient_rate) * t, half = F(0.5f) * difference * t;
  return {num::max(common + half, F(0.0f)) + dark, num::max(common - half, F(0.0f)) + dark};
}

}  // namespace tofray::raw
