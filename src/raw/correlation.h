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

/// \tparam harmonics  how many orders are summed; those that the camera does not have are zero
template <int harmonics, class F>
TOFRAY_FN void correlate(const camera::ModulationView& modulation, const Light<F>& light, int lights, F delay, Phasors<F>& sum) {
  for (int h = 0; h < harmonics; ++h) sum.real[h] = F(0.0f), sum.imaginary[h] = F(0.0f);
  for (int l = 0; l < lights; ++l) {
    const F turns = path_turns(modulation, light.path_length[l]) + num::fma(delay, F(modulation.frequency), F(modulation.delay_turns));
    F sine, cosine;
    num::sincos_turns(turns, sine, cosine);
    // e^{imφ} for odd m: times e^{2iφ} from one to the next
    const F step_real = num::fnma(sine, sine, cosine * cosine), step_imaginary = F(2.0f) * sine * cosine;
    F real = cosine * light.signal_rate[l], imaginary = sine * light.signal_rate[l];
    for (int h = 0; h < harmonics; ++h) {
      const F a = F(modulation.real[l][h]), b = F(modulation.imaginary[l][h]);
      sum.real[h] = num::fma(real, a, num::fnma(imaginary, b, sum.real[h]));
      sum.imaginary[h] = num::fma(real, b, num::fma(imaginary, a, sum.imaginary[h]));
      const F next = num::fnma(imaginary, step_imaginary, real * step_real);
      imaginary = num::fma(real, step_imaginary, imaginary * step_real);
      real = next;
    }
  }
}

/// D/t_int = Re Σ_m P_m·e^{imτ}.                                                                             [eq. 3.2]
template <int harmonics, class F>
TOFRAY_FN F difference_rate(const camera::RawFrameView& frame, const Phasors<F>& phasors) {
  F sum = F(0.0f);
  for (int h = 0; h < harmonics; ++h) {
    sum = num::fma(phasors.real[h], F(frame.cosine[h]), num::fnma(phasors.imaginary[h], F(frame.sine[h]), sum));
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
TOFRAY_FN Means<F> tap_means(const camera::RawFrameView& frame, F signal_rate, F ambient_rate, F difference) {
  const F dark = F(frame.dark);
  if (frame.lit == 0) return {num::fma(ambient_rate, F(frame.integration_time), dark), dark};
  const F common = signal_rate + ambient_rate, half_time = F(0.5f * frame.integration_time);
  return {num::fma(num::max(common + difference, F(0.0f)), half_time, dark), num::fma(num::max(common - difference, F(0.0f)), half_time, dark)};
}

}  // namespace tofray::raw
