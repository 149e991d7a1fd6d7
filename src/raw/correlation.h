// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/views.h"

/// Correlation of the light with the pixel's gate.                                                  [theory: eq. 3.1–3.4]
namespace tofray::raw {

using flow::Light;
using num::Mask;

/// Phasors P_m = Σ_lights S_l·a_m·e^{iψ_m}·e^{imφ_l} of one modulation frequency, electrons per second; m = 1, 3, 5, 7 …
/// (With quadrature: X and Y in the first place.)
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

/// e^{iφ} of one light, and e^{2iφ}, the way from one odd order to the next.
template <class F>
struct Turn {
  F real, imaginary, step_real, step_imaginary;
};
template <class F>
TOFRAY_FN Turn<F> turn_of(const camera::ModulationView& modulation, F path_length, F delay) {
  const F turns = path_turns(modulation, path_length) + num::fma(delay, F(modulation.frequency), F(modulation.delay_turns));
  F sine, cosine;
  num::sincos_turns(turns, sine, cosine);
  return {cosine, sine, num::fnma(sine, sine, cosine * cosine), F(2.0f) * sine * cosine};
}

/// \tparam harmonics  how many orders are summed; those that the camera does not have are zero
template <int harmonics, class F>
TOFRAY_FN void correlate(const camera::ModulationView& modulation, const Light<F>& light, int lights, F delay, Phasors<F>& sum) {
  for (int h = 0; h < harmonics; ++h) sum.real[h] = F(0.0f), sum.imaginary[h] = F(0.0f);
  for (int l = 0; l < lights; ++l) {
    const Turn<F> turn = turn_of(modulation, light.path_length[l], delay);
    F real = turn.real * light.signal_rate[l], imaginary = turn.imaginary * light.signal_rate[l];
    for (int h = 0; h < harmonics; ++h) {
      const F a = F(modulation.real[l][h]), b = F(modulation.imaginary[l][h]);
      sum.real[h] = num::fma(real, a, num::fnma(imaginary, b, sum.real[h]));
      sum.imaginary[h] = num::fma(real, b, num::fma(imaginary, a, sum.imaginary[h]));
      const F next = num::fnma(imaginary, turn.step_imaginary, real * turn.step_real);
      imaginary = num::fma(real, turn.step_imaginary, imaginary * turn.step_real);
      real = next;
    }
  }
}

/// Re(e^{iφ}·(c_1 + e^{2iφ}(c_3 + e^{2iφ}(c_5 + …)))) by Horner's rule: one light's sum over all harmonics.
template <int harmonics, class F>
TOFRAY_FN F harmonic_sum(const Turn<F>& turn, const float* real, const float* imaginary) {
  F a = F(real[harmonics - 1]), b = F(imaginary[harmonics - 1]);
  for (int h = harmonics - 2; h >= 0; --h) {
    const F next = num::fma(a, turn.step_real, num::fnma(b, turn.step_imaginary, F(real[h])));
    b = num::fma(a, turn.step_imaginary, num::fma(b, turn.step_real, F(imaginary[h])));
    a = next;
  }
  return num::fnma(b, turn.imaginary, a * turn.real);
}

/// Where all reference phases are quarter turns apart: X = D/t_int of the first, Y of a quarter turn on; e^{imπ} = −1 for odd m gives the rest.
template <int harmonics, class F>
TOFRAY_FN void correlate_quadrature(const camera::ModulationView& modulation, const Light<F>& light, int lights, F delay, Phasors<F>& sum) {
  F x = F(0.0f), y = F(0.0f);
  for (int l = 0; l < lights; ++l) {
    const Turn<F> turn = turn_of(modulation, light.path_length[l], delay);
    x = num::fma(light.signal_rate[l], harmonic_sum<harmonics>(turn, modulation.x_real[l], modulation.x_imaginary[l]), x);
    y = num::fma(light.signal_rate[l], harmonic_sum<harmonics>(turn, modulation.y_real[l], modulation.y_imaginary[l]), y);
  }
  sum.real[0] = x, sum.imaginary[0] = y;
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

/// D/t_int of one raw frame; `anew`: the light or the modulation is not that of the raw frame before.
template <int harmonics, class F>
TOFRAY_FN F difference(const camera::ModulationView& modulation, const camera::RawFrameView& frame, const Light<F>& light, int lights, F delay, bool anew,
                       Phasors<F>& sum) {
  if (modulation.quadrature != 0) {
    if (anew) correlate_quadrature<harmonics>(modulation, light, lights, delay, sum);
    return num::fma(sum.real[0], F(frame.in_phase), sum.imaginary[0] * F(frame.in_quadrature));
  }
  if (anew) correlate<harmonics>(modulation, light, lights, delay, sum);
  return difference_rate<harmonics>(frame, sum);
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
