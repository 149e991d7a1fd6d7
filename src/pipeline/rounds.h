// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/setup.h"

/// How many paths of light are followed, and when: in rounds, each of which doubles the paths of those pixels that are not known well enough.
namespace tofray::pipeline {

/// Paths of each sample within the pixels in the first round: as many in either half.
/// @param paths    that are asked for, of a pixel
/// @param samples  within it
TOFRAY_INLINE int paths_at_first(int paths, int samples) { return 2 * ((paths + 2 * samples - 1) / (2 * samples)); }
TOFRAY_INLINE int paths_at_first(const Setup& s) { return paths_at_first(s.bounces.samples, s.subpixel.count); }
/// Paths of a pixel that needs them, after a round.
TOFRAY_INLINE int paths_after(const Setup& s, int round) { return s.subpixel.count * (paths_at_first(s) << round); }

/// What a step adds: paths `first` to `first + count` of either half, of one of the samples within the pixels.
struct PathsOfStep {
  int round, sample;
  int first, count;
  int all;     ///< paths of the sample, this round's and those before it, of both halves
  float kept;  ///< what the light of the rounds before it counts
};
/// @param item  which step: round by round, of each all samples within the pixels
TOFRAY_INLINE PathsOfStep paths_of_step(const Setup& s, int item) {
  const int round = item / s.subpixel.count, sample = item % s.subpixel.count, all = paths_at_first(s) << round;
  const int before = round == 0 ? 0 : all / 2, added = all - before;
  return {round, sample, (s.subpixel.count * before + sample * added) / 2, added / 2, all, round > 0 && sample == 0 ? 0.5f : 1.0f};
}

/// Pixels that get the paths of a round.
template <class F>
TOFRAY_INLINE num::Mask<F> takes_part(const Setup& s, const flow::LightImage& image, int round, const flow::Pixels& p) {
  if (round == 0) return F(0.0f) < F(1.0f);
  return num::load_int<F>(image.goal + p.index, p.count) > num::Int<F>(paths_after(s, round) - 1);
}
/// Paths of each pixel after a round.
template <class F>
TOFRAY_INLINE num::Int<F> paths_known(const Setup& s, const flow::LightImage& image, int round, const flow::Pixels& p) {
  const num::Int<F> most(paths_after(s, round));
  if (round == 0) return most;
  const num::Int<F> goal = num::load_int<F>(image.goal + p.index, p.count);
  return num::select(goal > most, most, goal);
}

}  // namespace tofray::pipeline
