// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/multipath.h"
#include "pipeline/neighbor_similarity.h"

/// How well light that bounces is known, and how many paths a pixel needs.                           [theory: path-noise]
///
/// A pixel's paths come in two halves that chance keeps apart: how far these are from each other says, on average over many pixels, how far
/// their mean is from the truth.
namespace tofray::pipeline {

/// A−B of each raw frame of all light [e⁻], as far as it is known.
template <class F>
TOFRAY_INLINE void expected_differences(const Setup& s, const flow::LightImage& image, const Pixels& p, F* difference) {
  F indirect[flow::max_raw_frames];
  differences(s, image.before, p, image.times, difference), differences(s, image.indirect, p, image.times, indirect);
  for (int k = 0; k < s.sensor.raw_frames; ++k) difference[k] = (difference[k] + indirect[k]) * F(s.sensor.frame[k].integration_time);
}

/// Paths·(what half the difference of the two halves adds across Ẑ)² of each modulation frequency [e⁻²].
template <class F>
TOFRAY_INLINE void store_path_error(const Setup& s, const flow::LightImage& image, int round, const Pixels& p) {
  F all[flow::max_raw_frames], apart[flow::max_raw_frames];
  expected_differences(s, image, p, all);
  differences(s, image.indirect + light_values(s, image.times), p, image.times, apart);
  for (int k = 0; k < s.sensor.raw_frames; ++k) apart[k] = apart[k] * F(s.sensor.frame[k].integration_time);
  const F paths = num::to_float(paths_known<F>(s, image, round, p));
  for (int j = 0; j < s.decoder.modulations; ++j) {
    const camera::DecodeModulation& m = s.decoder.modulation[j];
    const depth::Phasor<F> z = depth::phasor(s.decoder, m, all), half = depth::phasor(s.decoder, m, apart);
    const F across = num::fma(half.imaginary, z.real, -(half.real * z.imaginary));
    const F square = num::fma(z.real, z.real, z.imaginary * z.imaginary);
    const F error = num::select(square > F(0.0f), across * across / square, F(0.0f));
    num::store(image.error + std::int64_t{j} * s.lens.width * s.lens.height + p.index, error * paths, p.count);
  }
}

constexpr int pooled_radius = 3;  ///< [px] of the square within which like neighbours share what is known of their error

/// Share of a pixel's depth noise that the error of its light may have, unless a scene says otherwise.
constexpr float share_of_depth_noise = 0.2f;

/// The errors of like neighbours, as those of white surfaces: Σ error/Σ ρ², of each modulation frequency.
///
/// Of what chance does to the light of a pixel, material and direct light change no more than this.
template <class F>
TOFRAY_INLINE void pooled_errors(const Setup& s, const flow::LightImage& image, const InRow& at, const SurfaceGuide<F>& here, F* pooled) {
  const std::int64_t pixels = std::int64_t{s.lens.width} * s.lens.height;
  const int modulations = s.decoder.modulations;
  F squares = F(0.0f);
  for (int j = 0; j < modulations; ++j) pooled[j] = F(0.0f);
  for (int dy = -pooled_radius; dy <= pooled_radius; ++dy) {
    if (at.y + dy < 0 || at.y + dy >= at.height) continue;
    for (int dx = -pooled_radius; dx <= pooled_radius; ++dx) {
      const SurfaceGuide<F> there = guide_near<F>(image, at, dx, dy);
      const num::Mask<F> like = is_within<F>(at, dx) & (similarity(here, there) > F(0.0f));
      squares = squares + num::select(like, there.reflectivity * there.reflectivity, F(0.0f));
      for (int j = 0; j < modulations; ++j)
        pooled[j] = pooled[j] + num::select(like, load_near<F>(image.error + j * pixels, at, dx, dy), F(0.0f));
    }
  }
  for (int j = 0; j < modulations; ++j) pooled[j] = num::select(squares > F(0.0f), pooled[j] / squares, F(0.0f));
}

/// The variance of each pixel's light across Ẑ, and how many paths it shall have in the end.
template <class F>
TOFRAY_INLINE void store_path_noise(const Setup& s, const flow::LightImage& image, int round, const Pixels& p) {
  F all[flow::max_raw_frames], pooled[flow::max_modulation_frequencies];
  expected_differences(s, image, p, all);
  const InRow at = in_row(s, p);
  const SurfaceGuide<F> here = guide_near<F>(image, at, 0, 0);
  pooled_errors(s, image, at, here, pooled);
  const num::Int<F> paths = paths_known<F>(s, image, round, p);
  // What a pixel stopped by is what is said of it: with neighbours that went on it would be another guess, which was not asked for.
  const num::Mask<F> goes_on = takes_part<F>(s, image, round, p);
  const auto ambient = [&](const float* values)
                           TOFRAY_LAMBDA { return num::load<F>(values + light_place(s, p, image.times, image.times / 2, 1), p.count); };
  const F ambient_rate = ambient(image.before) + ambient(image.indirect);
  F worst = F(0.0f), weight = F(0.0f);
  for (int j = 0; j < s.decoder.modulations; ++j) {
    const camera::DecodeModulation& m = s.decoder.modulation[j];
    const depth::Estimate<F> e = depth::estimate(s.decoder, m, all);
    const auto [turns, slope, light] = depth::unwiggle(s.decoder, m, e.turns);
    weight = weight +
             depth::inverse_variance(m, e, depth::variance_of(s.decoder, m, all, e, light, ambient_rate * F(m.integration_time)), slope);
    const F variance = pooled[j] * (here.reflectivity * here.reflectivity) / num::to_float(paths);
    float* const known = image.noise + std::int64_t{j} * s.lens.width * s.lens.height + p.index;
    num::store(known, round == 0 ? variance : num::select(goes_on, variance, num::load<F>(known, p.count)), p.count);
    const F error = half_path_error(m, slope, e.amplitude, variance);
    worst = num::max(worst, error * error);
  }
  if (image.goal == nullptr) return;
  num::Int<F> goal = round == 0 ? paths : num::load_int<F>(image.goal + p.index, p.count);
  if (round + 1 < s.bounces.rounds) {
    const F enough = s.bounces.noise > 0 ? F(s.bounces.noise * s.bounces.noise) : F(share_of_depth_noise * share_of_depth_noise) / weight;
    goal = num::select(goes_on & (worst > enough), num::Int<F>(paths_after(s, round + 1)), goal);
  }
  num::store(image.goal + p.index, goal, p.count);
}

}  // namespace tofray::pipeline
