// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/gather.h"
#include "pipeline/neighbor_similarity.h"
#include "pipeline/pass/pass.h"

/// Light that bounces, smoothed over neighbours that see the same surface. Direct light never is.    [theory: path-smoothing]
namespace tofray::pipeline {

constexpr int smoothed_radius = 7;  ///< [px]
constexpr int smoothed_side = 2 * smoothed_radius + 1;

/// What of a neighbour's light counts as the pixel's own: how much it sees the same, less with its distance in the image. The light of a
/// neighbour of another reflectivity ρ is as much of another brightness: ρ_p·Σ w·ρ_q·L_q/Σ w·ρ_q².
template <class F>
TOFRAY_INLINE void smoothing_weights(const flow::LightImage& image, const InRow& at, F* weight) {
  const SurfaceGuide<F> here = guide_near<F>(image, at, 0, 0);
  F squares = F(0.0f);
  for (int i = 0; i < smoothed_side * smoothed_side; ++i) {
    const int dx = i % smoothed_side - smoothed_radius, dy = i / smoothed_side - smoothed_radius;
    constexpr float reach = (smoothed_radius + 1) * (smoothed_radius + 1);
    const float far = static_cast<float>(dx * dx + dy * dy), left = far < reach ? 1.0f - far / reach : 0.0f;
    weight[i] = F(0.0f);
    if (!(left > 0.0f) || at.y + dy < 0 || at.y + dy >= at.height) continue;
    const SurfaceGuide<F> there = guide_near<F>(image, at, dx, dy);
    const F counts = num::select(is_within<F>(at, dx), F(left * left) * similarity(here, there), F(0.0f)) * there.reflectivity;
    weight[i] = counts, squares = num::fma(counts, there.reflectivity, squares);
  }
  // A pixel that sees nothing, or what is black, keeps what it has.
  const num::Mask<F> any = squares > F(0.0f);
  const F per = num::select(any, here.reflectivity / squares, F(0.0f));
  for (int i = 0; i < smoothed_side * smoothed_side; ++i) weight[i] = weight[i] * per;
  constexpr int middle = smoothed_side * smoothed_side / 2;
  weight[middle] = num::select(any, weight[middle], F(1.0f));
}

/// Σ over the neighbours of a plane's values, times their weights or those squared.
template <class F>
TOFRAY_INLINE F weighted_sum(const float* plane, const InRow& at, const F* weight, bool squared) {
  F sum = F(0.0f);
  for (int dy = -smoothed_radius; dy <= smoothed_radius; ++dy) {
    if (at.y + dy < 0 || at.y + dy >= at.height) continue;
    const F* const row = weight + (dy + smoothed_radius) * smoothed_side + smoothed_radius;
    for (int dx = -smoothed_radius; dx <= smoothed_radius; ++dx)
      sum = num::fma(load_near<F>(plane, at, dx, dy), squared ? row[dx] * row[dx] : row[dx], sum);
  }
  return sum;
}

template <class F>
TOFRAY_INLINE void smooth_light(const Setup& s, const flow::LightImage& image, const Pixels& p) {
  const std::int64_t pixels = std::int64_t{s.lens.width} * s.lens.height;
  const InRow at = in_row(s, p);
  F weight[smoothed_side * smoothed_side];
  smoothing_weights(image, at, weight);
  const int planes = image.times * light_planes(s, image.times);
  for (int i = 0; i < planes; ++i)
    num::store(image.indirect_before + i * pixels + p.index, weighted_sum(image.indirect + i * pixels, at, weight, false), p.count);
  if (image.noise == nullptr) return;
  // Each pixel's paths are its own: variances add up.
  for (int j = 0; j < s.decoder.modulations; ++j)
    num::store(image.smoothed_noise + j * pixels + p.index, weighted_sum(image.noise + j * pixels, at, weight, true), p.count);
}

struct Smooth {
  static constexpr const char* name = "smooth";
  static constexpr const char* does = "bounced light smoothed over neighbours alike";
  static constexpr Over over = Over::tiles;
  static constexpr int most_threads = most_block_threads;

  template <class F>
  TOFRAY_INLINE static void pixels(const PassWork& w, const Pixels& p) {
    smooth_light<F>(w.s, w.job.light, p);
  }
};

}  // namespace tofray::pipeline
