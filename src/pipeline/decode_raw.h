// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/one_pixel.h"

/// Stage 4 alone, for raw data from elsewhere.
namespace tofray::pipeline {

/// Raw data to decode: ADC codes, or both taps where `raw` is null. [phase][height][width]
struct Recording {
  const std::uint16_t* raw;
  const float *tap_a, *tap_b;
};

template <class F>
TOFRAY_FN void decode_pixels(const Setup& s, const Job& job, const Recording& in, const Pixels& p) {
  F difference[flow::max_raw_frames];
  num::Mask<F> clipped = F(1.0f) < F(0.0f);
  const camera::SensorView& sensor = s.sensor;
  for (int k = 0; k < sensor.raw_frames; ++k) {
    const std::int32_t at = p.index + k * s.lens.width * s.lens.height;
    num::Mask<F> over = F(1.0f) < F(0.0f);
    if (in.raw != nullptr) {
      std::int32_t codes[num::lanes<F>] = {};
      for (int i = 0; i < p.count; ++i) codes[i] = in.raw[at + i];
      const F code = num::to_float(num::load_int<F>(codes, p.count));
      difference[k] = (code - F(sensor.mid_code)) * F(sensor.step);
      over = num::abs(code - F(sensor.valid_middle)) > F(sensor.valid_half);
    }
    if (in.tap_a != nullptr) {
      const F a = num::load<F>(in.tap_a + at, p.count), b = num::load<F>(in.tap_b + at, p.count);
      const auto charges = (num::abs(a) <= F(flow::max_charge)) & (num::abs(b) <= F(flow::max_charge));
      if (in.raw == nullptr) difference[k] = num::select(charges, a - b, F(0.0f));
      over = over | !charges | (a >= F(sensor.full_well)) | (b >= F(sensor.full_well));
    }
    if (sensor.frame[k].lit != 0) clipped = clipped | over;
  }
  find_depth(s, job, p, camera::ray<F>(s.lens, p), difference, clipped, raw::pattern<F>(s.decoder.delay, p, 0.0f), camera::vignetting<F>(s.lens, p));
}

}  // namespace tofray::pipeline
