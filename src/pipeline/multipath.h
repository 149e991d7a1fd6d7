// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "depth/decode.h"
#include "pipeline/gather.h"
#include "pipeline/rounds.h"
#include "raw/correlation.h"

/// Ground truth of light that comes by several surfaces: how much of it there is, and what it does to the range.
namespace tofray::pipeline {

constexpr float per_turn = 0.15915494f;  ///< 1/(2π)

/// A−B per second of each raw frame, of light as the image keeps it.
template <class F>
TOFRAY_INLINE void differences(const Setup& s, const float* values, const Pixels& p, int times, F* difference) {
  flow::Light<F> light;
  for (int k = 0; k < s.sensor.raw_frames; ++k) {
    if (times > 1 || k == 0) load_light(s, values, p, times, times > 1 ? k : 0, light);
    const camera::RawFrameView& frame = s.sensor.frame[k];
    difference[k] = frame.lit != 0 ? raw::difference_rate(frame, s.phasors.orders, light) : F(0.0f);
  }
}

/// Half path that all light shows less that which the direct light shows, as the decoder has them from raw frames without noise, for each
/// modulation frequency: at most half its unambiguous range to either side.                             [theory: multipath-error]
template <class F>
struct MultipathError {
  F value;              ///< [m]
  F slope, amplitude;   ///< dφ/dφ̂ and |Ẑ| of all light
  num::Mask<F> exists;  ///< there is direct light
};
template <class F>
TOFRAY_INLINE MultipathError<F> multipath_error(const camera::DecoderView& s, const camera::DecodeModulation& m, const F* all,
                                                const F* direct) {
  const depth::Estimate<F> of_all = depth::estimate(s, m, all), of_direct = depth::estimate(s, m, direct);
  const depth::Unwiggled<F> phase = depth::unwiggle(s, m, of_all.turns);
  const F turns = phase.turns - depth::unwiggle(s, m, of_direct.turns).turns;
  return {(turns - num::round_even(turns)) * F(m.half_wave), phase.slope, of_all.amplitude, of_direct.amplitude > F(0.0f)};
}

/// What an error across Ẑ does to the half path: at most half its unambiguous range, and nothing where there is no light.
///                                                                                                                     [theory: path-noise]
/// @param slope      dφ/dφ̂
/// @param amplitude  |Ẑ| [e⁻]
/// @param variance   of the light across Ẑ [e⁻²]
template <class F>
TOFRAY_INLINE F half_path_error(const camera::DecodeModulation& m, F slope, F amplitude, F variance) {
  const F error = num::abs(slope) * F(m.half_wave * per_turn) * num::sqrt(variance) / num::max(amplitude, F(1e-20f));
  return num::select(variance > F(0.0f), num::min(error, F(0.5f * m.half_wave)), F(0.0f));
}

/// Of each raw frame that of its modulation frequency, and the standard error of it.
template <class F>
TOFRAY_NOINLINE void store_multipath(const Setup& s, const flow::FrameView& out, const flow::LightImage& image, const Pixels& p) {
  F all[flow::max_raw_frames], direct[flow::max_raw_frames];
  differences(s, image.values, p, image.times, all), differences(s, image.before, p, image.times, direct);
  const int pixels = s.lens.width * s.lens.height;
  const auto put = [&](int k, F error, F noise) TOFRAY_LAMBDA {
    const Pixels at{p.index + k * pixels, p.count};
    store(out.gt_multipath_m, at, error), store(out.gt_path_noise_m, at, noise);
  };
  for (int k = 0; k < s.sensor.raw_frames; ++k)
    if (s.sensor.frame[k].lit == 0) put(k, nan<F>(), nan<F>());
  const float* const variance = image.smoothed_noise != nullptr ? image.smoothed_noise : image.noise;
  for (int j = 0; j < s.decoder.modulations; ++j) {
    const camera::DecodeModulation& m = s.decoder.modulation[j];
    const MultipathError<F> error = multipath_error(s.decoder, m, all, direct);
    const auto known = [&](F value) TOFRAY_LAMBDA { return num::select(error.exists, value, nan<F>()); };
    F noise = nan<F>();
    if (variance != nullptr)
      noise = known(half_path_error(m, error.slope, error.amplitude * F(m.integration_time),
                                    num::load<F>(variance + std::int64_t{j} * pixels + p.index, p.count)));
    for (int i = 0; i < m.count; ++i) put(m.raw_frame[i], known(error.value), noise);
  }
}

/// @param time  of the ground truth
template <class F>
TOFRAY_INLINE void store_bounced(const Setup& s, const flow::FrameView& out, const flow::LightImage& image, const Pixels& p, int time) {
  if (image.indirect == nullptr) return;
  const auto rate = [&](const float* values, int at, int plane)
                        TOFRAY_LAMBDA { return num::load<F>(values + light_place(s, p, image.times, at, plane), p.count); };
  store(out.gt_ambient_e_per_s, p, rate(image.values, time, 1));
  const auto electrons = [&](float* to, const float* values) TOFRAY_LAMBDA {
    for (int k = 0; k < s.sensor.raw_frames && to != nullptr; ++k) {
      const camera::RawFrameView& frame = s.sensor.frame[k];
      const F charge = frame.lit != 0 ? rate(values, image.times > 1 ? k : 0, 0) * F(frame.integration_time) : F(0.0f);
      num::store(to + p.index + k * s.lens.width * s.lens.height, charge, p.count);
    }
  };
  electrons(out.gt_direct_e, image.before), electrons(out.gt_indirect_e, image.indirect);
  if (out.gt_multipath_m != nullptr || out.gt_path_noise_m != nullptr) store_multipath<F>(s, out, image, p);
  if (out.gt_path_count == nullptr) return;
  num::store(out.gt_path_count + p.index, paths_known<F>(s, image, s.bounces.rounds - 1, p), p.count);
}

}  // namespace tofray::pipeline
