// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/pixel/pixel_delay.h"

/// Light as phasors: where every path ends, whatever it came by.                                   [theory: received-phasors]
namespace tofray::power {

using flow::Light;
using flow::Path;

/// Modulation frequencies that are asked for: of light that serves a single raw frame, no more than that frame's.
struct Wanted {
  int first, last;
};
TOFRAY_INLINE Wanted all_of(const camera::PhasorView& s) { return {0, s.modulations}; }

/// No light yet. (Where sums alone are asked for, they are it.)
template <class F>
TOFRAY_INLINE void clear(const camera::PhasorView& s, const Wanted& wanted, Light<F>& light) {
  light.signal_rate = F(0.0f), light.ambient_rate = F(0.0f);
  for (int i = wanted.first * s.orders; i < wanted.last * s.orders; ++i) light.real[i] = F(0.0f), light.imaginary[i] = F(0.0f);
  for (int j = wanted.first; j < wanted.last; ++j) light.in_phase[j] = F(0.0f), light.quarter[j] = F(0.0f);
}

/// Adds up light that was gathered apart, as far as it is wanted.
template <class F>
TOFRAY_INLINE void add_light(const camera::PhasorView& s, const Wanted& wanted, const Light<F>& part, Light<F>& light) {
  light.signal_rate = light.signal_rate + part.signal_rate, light.ambient_rate = light.ambient_rate + part.ambient_rate;
  for (int j = wanted.first; j < wanted.last; ++j) {
    light.in_phase[j] = light.in_phase[j] + part.in_phase[j], light.quarter[j] = light.quarter[j] + part.quarter[j];
    for (int i = j * s.orders; i < (j + 1) * s.orders && s.sums_alone == 0; ++i)
      light.real[i] = light.real[i] + part.real[i], light.imaginary[i] = light.imaginary[i] + part.imaginary[i];
  }
}

/// Of two lights their sum and their difference, a + b and a − b, in their place.
template <class F>
TOFRAY_INLINE void sum_and_difference(const camera::PhasorView& s, const Wanted& wanted, Light<F>& a, Light<F>& b) {
  const auto both = [](F& x, F& y) TOFRAY_LAMBDA {
    const F sum = x + y;
    y = x - y, x = sum;
  };
  both(a.signal_rate, b.signal_rate), both(a.ambient_rate, b.ambient_rate);
  for (int j = wanted.first; j < wanted.last; ++j) {
    both(a.in_phase[j], b.in_phase[j]), both(a.quarter[j], b.quarter[j]);
    for (int i = j * s.orders; i < (j + 1) * s.orders && s.sums_alone == 0; ++i)
      both(a.real[i], b.real[i]), both(a.imaginary[i], b.imaginary[i]);
  }
}

/// The mean of the light at several times within one exposure: what is seen at one of them, from the first on, is added.
///                                                                                                               [theory: exposure-samples]
template <class F>
TOFRAY_NOINLINE void blend(const camera::PhasorView& s, const Wanted& wanted, const Light<F>& light, int sample, int samples,
                           Light<F>& mean) {
  const F share = F(1.0f / static_cast<float>(samples));
  const auto add = [&](F& sum, F value) TOFRAY_LAMBDA { sum = sample == 0 ? value * share : num::fma(value, share, sum); };
  add(mean.signal_rate, light.signal_rate), add(mean.ambient_rate, light.ambient_rate);
  for (int j = wanted.first; j < wanted.last; ++j) {
    for (int i = j * s.orders; i < (j + 1) * s.orders && s.sums_alone == 0; ++i) {
      add(mean.real[i], light.real[i]), add(mean.imaginary[i], light.imaginary[i]);
    }
    add(mean.in_phase[j], light.in_phase[j]), add(mean.quarter[j], light.quarter[j]);
  }
}

/// Phase of a path in turns, φ/2π = ℓ·f/c less whole turns. The factor comes in two parts so that long paths keep their last digits.
template <class F>
TOFRAY_INLINE F path_turns(const camera::ModulationView& modulation, F path_length) {
  const F whole = num::round_even(path_length * F(modulation.turns_per_metre_high));
  return num::fma(path_length, F(modulation.turns_per_metre_low), num::fma(path_length, F(modulation.turns_per_metre_high), -whole));
}

/// e^{iφ}, and e^{2iφ}, the way from one odd order to the next.
template <class F>
struct Turn {
  F real, imaginary, step_real, step_imaginary;
};
template <class F>
TOFRAY_INLINE Turn<F> turn_of(F turns) {
  F sine, cosine;
  num::sincos_turns(turns, sine, cosine);
  return {cosine, sine, num::fnma(sine, sine, cosine * cosine), F(2.0f) * sine * cosine};
}

/// Z_m += a_m·e^{iψ_m}·rate·e^{imφ} of one modulation frequency.
/// \tparam first   there was no light: Z_m is written, not read
/// @param source  [orders][2] a_m·e^{iψ_m}
template <int orders, bool first, class F>
TOFRAY_INLINE void add_turns(const float* source, F rate, const Turn<F>& turn, F* real, F* imaginary) {
  F x = turn.real * rate, y = turn.imaginary * rate;
  for (int h = 0; h < orders; ++h) {
    const F a = F(source[2 * h]), b = F(source[2 * h + 1]);
    real[h] = num::fma(x, a, first ? -(y * b) : num::fnma(y, b, real[h]));
    imaginary[h] = num::fma(x, b, first ? y * a : num::fma(y, a, imaginary[h]));
    const F next = num::fnma(y, turn.step_imaginary, x * turn.step_real);
    y = num::fma(x, turn.step_imaginary, y * turn.step_real);
    x = next;
  }
}
/// What gates at quarter turns correlate with: sums over the orders, once for all raw frames, as soon as all paths are in. e^{imπ/2} is ±i.
template <int orders, class F>
TOFRAY_INLINE void add_up(const F* real, const F* imaginary, F& in_phase, F& quarter) {
  in_phase = quarter = F(0.0f);
  for (int h = 0; h < orders; ++h) in_phase = in_phase + real[h];
  for (int h = 0; h < orders; h += 2) quarter = quarter + (imaginary[h] - imaginary[h + 1]);
}
template <class F>
TOFRAY_INLINE void add_up(const camera::PhasorView& s, const Wanted& wanted, Light<F>& light) {
  for (int j = wanted.first; j < wanted.last; ++j) {
    const F *real = light.real + j * s.orders, *imaginary = light.imaginary + j * s.orders;
    if (s.orders <= 4) {
      add_up<4>(real, imaginary, light.in_phase[j], light.quarter[j]);
    } else {
      add_up<flow::max_harmonics>(real, imaginary, light.in_phase[j], light.quarter[j]);
    }
  }
}

/// sin(2πt)/(2πt), t in turns.
template <class F>
TOFRAY_INLINE F sinc_turns(F t) {
  const F held = num::max(num::abs(t), F(1e-6f));
  F sine, cosine;
  num::sincos_turns(held, sine, cosine);
  return sine / (held * F(6.28318531f));
}

/// Adds the harmonics of a modulation frequency that is swept over a band of width Δf: the mean over it is e^{imφ}·sinc(m·Δf·ℓ/c), φ at its middle.
///                                                                                                 [theory: spread-spectrum]
template <bool first, class F>
TOFRAY_NOINLINE void add_swept_turns(const camera::ModulationView& modulation, int orders, const float* source, const Path<F>& path,
                                     F* real, F* imaginary) {
  const F turns = path_turns(modulation, path.length), swept = path.length * F(modulation.swept_turns_per_metre);
  for (int h = 0; h < orders; ++h) {
    const F m = F(static_cast<float>(2 * h + 1)), left = path.rate * sinc_turns(m * swept);
    const Turn<F> turn = turn_of(m * turns);
    const F x = turn.real * left, y = turn.imaginary * left, a = F(source[2 * h]), b = F(source[2 * h + 1]);
    real[h] = num::fma(x, a, first ? -(y * b) : num::fnma(y, b, real[h]));
    imaginary[h] = num::fma(x, b, first ? y * a : num::fma(y, a, imaginary[h]));
  }
}

template <bool first, class F>
TOFRAY_INLINE void add_turns(const camera::PhasorView& s, int j, int l, const Path<F>& path, Light<F>& light) {
  const camera::ModulationView& modulation = s.modulation[j];
  const float* source = modulation.source + 2 * l * s.orders;
  F *real = light.real + j * s.orders, *imaginary = light.imaginary + j * s.orders;
  if (modulation.swept_turns_per_metre > 0) return add_swept_turns<first>(modulation, s.orders, source, path, real, imaginary);
  const Turn<F> turn = turn_of(path_turns(modulation, path.length));
  if (s.orders <= 4) {
    add_turns<4, first>(source, path.rate, turn, real, imaginary);
  } else {
    add_turns<flow::max_harmonics, first>(source, path.rate, turn, real, imaginary);
  }
}

/// Adds one path of light source `l`.
/// @param first  `light` was not cleared: this path is all of it
template <class F>
TOFRAY_INLINE void add_path(const camera::PhasorView& s, const Wanted& wanted, int l, const Path<F>& path, bool first, Light<F>& light) {
  light.signal_rate = first ? path.rate : light.signal_rate + path.rate;
  for (int j = wanted.first; j < wanted.last; ++j) {
    if (first) {
      add_turns<true>(s, j, l, path, light);
    } else {
      add_turns<false>(s, j, l, path, light);
    }
  }
}

/// The light of a single path from the only source, as no more than its sums.
template <int orders, class F>
TOFRAY_INLINE void sums_of_turns(const float* source, F rate, const Turn<F>& turn, F& in_phase, F& quarter) {
  F x = turn.real * rate, y = turn.imaginary * rate, other = F(0.0f), re = F(0.0f), im = F(0.0f);
  for (int h = 0; h < orders; ++h) {
    const F a = F(source[2 * h]), b = F(source[2 * h + 1]);
    re = re + num::fma(x, a, -(y * b));
    const F z = num::fma(x, b, y * a);
    if (h % 2 == 0)
      other = z;
    else
      im = im + (other - z);
    const F next = num::fnma(y, turn.step_imaginary, x * turn.step_real);
    y = num::fma(x, turn.step_imaginary, y * turn.step_real);
    x = next;
  }
  in_phase = re, quarter = im;
}
/// Calls take(j, in_phase, quarter) for each modulation frequency.
template <int orders, class F, class Take>
TOFRAY_INLINE void sums_of_orders(const camera::PhasorView& s, const Wanted& wanted, const Path<F>& path, const Take& take) {
  for (int j = wanted.first; j < wanted.last; ++j) {
    const camera::ModulationView& modulation = s.modulation[j];
    const Turn<F> turn = turn_of(path_turns(modulation, path.length));
    F in_phase, quarter;
    sums_of_turns<orders>(modulation.source, path.rate, turn, in_phase, quarter);
    take(j, in_phase, quarter);
  }
}
template <class F, class Take>
TOFRAY_INLINE void sums_of_path(const camera::PhasorView& s, const Wanted& wanted, const Path<F>& path, const Take& take) {
  if (s.orders <= 4) {
    sums_of_orders<4>(s, wanted, path, take);
  } else {
    sums_of_orders<flow::max_harmonics>(s, wanted, path, take);
  }
}
template <class F>
TOFRAY_INLINE void sums_of_path(const camera::PhasorView& s, const Wanted& wanted, const Path<F>& path, Light<F>& light) {
  light.signal_rate = path.rate;
  sums_of_path(s, wanted, path,
               [&](int j, F in_phase, F quarter) TOFRAY_LAMBDA { light.in_phase[j] = in_phase, light.quarter[j] = quarter; });
}

/// Adds a path to light that other paths have brought, as far as it is wanted: to the sums alone, or to all orders.
template <class F>
TOFRAY_INLINE void add_one_of_many(const camera::PhasorView& s, const Wanted& wanted, int l, const Path<F>& path, Light<F>& light) {
  if (s.sums_alone == 0) {
    add_path(s, wanted, l, path, false, light);
    return;
  }
  light.signal_rate = light.signal_rate + path.rate;
  sums_of_path(s, wanted, path, [&](int j, F in_phase, F quarter) TOFRAY_LAMBDA {
    light.in_phase[j] = light.in_phase[j] + in_phase, light.quarter[j] = light.quarter[j] + quarter;
  });
}

/// Adds light that is summed already: one order of Σ rate·e^{imφ} over paths of light source `l`. (Their rates are added beside.)
/// @param h  which order, (m − 1)/2
template <class F>
TOFRAY_INLINE void add_phasor(const camera::PhasorView& s, int j, int l, int h, F x, F y, Light<F>& light) {
  const float* source = s.modulation[j].source + 2 * (l * s.orders + h);
  F &real = light.real[j * s.orders + h], &imaginary = light.imaginary[j * s.orders + h];
  real = num::fma(x, F(source[0]), num::fnma(y, F(source[1]), real));
  imaginary = num::fma(x, F(source[1]), num::fma(y, F(source[0]), imaginary));
}

/// Turns all phasors by m·2π·f·delay, and adds them up again: a pixel that is late by `delay` [s] sees longer paths.
/// @param sensor  has delays
template <class F>
TOFRAY_INLINE void delay_by(const camera::PhasorView& s, const Wanted& wanted, const camera::SensorView& sensor, const flow::Pixels& p,
                            Light<F>& light) {
  for (int j = wanted.first; j < wanted.last; ++j) {
    const Turn<F> turn = turn_of(camera::late_by<F>(sensor, j, p) * F(s.modulation[j].frequency));
    F x = turn.real, y = turn.imaginary;
    for (int h = 0; h < s.orders; ++h) {
      F &real = light.real[j * s.orders + h], &imaginary = light.imaginary[j * s.orders + h];
      const F turned = num::fnma(imaginary, y, real * x);
      imaginary = num::fma(real, y, imaginary * x);
      real = turned;
      const F next = num::fnma(y, turn.step_imaginary, x * turn.step_real);
      y = num::fma(x, turn.step_imaginary, y * turn.step_real);
      x = next;
    }
  }
  add_up(s, wanted, light);
}

}  // namespace tofray::power
