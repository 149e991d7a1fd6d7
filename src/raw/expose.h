// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "raw/charge.h"

/// Stage 3: what the sensor collects in one raw frame.                                                  [theory: eq. 3.6]
namespace tofray::raw {

/// What stays the same for a pixel over all raw frames of a frame, and the two things that are computed once for several of them.
template <class F>
struct Exposure {
  num::Int<F> pixel;
  F gain, offset, delay;
  Phasors<F> phasors;
  num::Random4<F> merged_words;
};

template <class F>
TOFRAY_FN F pattern(const float* map, const flow::Pixels& p, float otherwise) {
  return map != nullptr ? num::load<F>(map + p.index, p.count) : F(otherwise);
}

template <class F>
TOFRAY_FN Exposure<F> start(const camera::SensorView& s, const flow::Pixels& p) {
  Exposure<F> e;
  e.pixel = num::Int<F>(p.index) + num::lane_index<F>();
  e.gain = pattern<F>(s.gain, p, 1.0f), e.offset = pattern<F>(s.offset, p, 0.0f);
  e.delay = pattern<F>(s.delay, p, 0.0f);
  return e;
}

/// Mean electrons × (1 + PRNU) → Poisson → reset and read noise → background suppression → full well → ADC.
/// @param light_changed  false where the light is that of the raw frame before
template <class F>
TOFRAY_FN Taps<F> expose(const camera::SensorView& s, int k, const Light<F>& light, int lights, bool light_changed, FrameIndex index, Exposure<F>& e) {
  const camera::RawFrameView& frame = s.frame[k];
  F signal = F(0.0f), difference = F(0.0f);
  if (frame.lit != 0) {
    if (light_changed || k == 0 || frame.modulation != s.frame[k - 1].modulation) {
      e.phasors = correlate(s, s.modulation[frame.modulation], light, lights, e.delay);
    }
    difference = difference_rate(frame, e.phasors, s.harmonics);
    for (int l = 0; l < lights; ++l) signal = signal + light.signal_rate[l];
  }
  Means<F> charge = tap_means(s, frame, signal, light.ambient_rate, difference);
  charge.a = charge.a * e.gain, charge.b = charge.b * e.gain;
  if (s.noise == 2) {
    charge = expose_exact(s, charge, e.pixel, k, index);
  } else if (s.noise == 1) {
    if ((k & 1) == 0) e.merged_words = draw<F>(s, e.pixel, k, index, merged);
    charge = expose_fast(s, charge, k, e.merged_words);
  }
  if (s.suppression_threshold > 0) charge = suppress(s, charge, e.pixel, k, index);
  return read_out(s, frame, charge, e.offset);
}

}  // namespace tofray::raw
