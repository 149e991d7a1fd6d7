// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/decoder/view.h"
#include "camera/lens/view.h"
#include "camera/light/view.h"
#include "camera/pixel/view.h"
#include "effect/list.h"
#include "flow/frame_view.h"
#include "flow/light_image.h"
#include "scene/view.h"

namespace tofray::pipeline {

/// Light that goes from surface to surface before it comes back.                                       [theory: bounces]
struct BounceView {
  std::int32_t most;     ///< surfaces that a path meets beyond the first one; 0: light comes straight back
  std::int32_t samples;  ///< paths of each pixel in the first round, at least
  std::int32_t rounds;   ///< each doubles the paths of those pixels that are not known well enough
  std::int32_t smooth;   ///< 1: the indirect light is smoothed over like neighbours
  float noise;           ///< [m] of the half path, that is well enough; 0: a share of the pixel's own depth noise
  num::RoundKeys keys;   ///< of the random numbers that choose them
  bool operator==(const BounceView&) const = default;
};

/// Histograms of light by the length of its path.                                                     [theory: transient]
struct TransientView {
  std::int32_t bins;  ///< 0: there are none
  float first;        ///< where the first one begins [m]
  float per_metre;    ///< 1 / width of a bin
  bool operator==(const TransientView&) const = default;
};

/// The part of an image that is read, where what is computed is more: the rest is there for what comes from it, and has no depth.
struct Region {
  std::int32_t left, top, width, height;  ///< width 0: all of it
  bool operator==(const Region&) const = default;
};

/// Everything that a frame needs, frozen: plain numbers and pointers that any machine can read.
struct Setup {
  camera::LensView lens;
  camera::SubpixelView subpixel;
  camera::ScatterView scatter;
  scene::SceneView scene;
  const camera::LightView* lights;  ///< [scene.lights]
  camera::PowerView power;
  camera::PhasorView phasors;
  camera::SensorView sensor;
  camera::DecoderView decoder;
  BounceView bounces;
  TransientView transient;
  Region region;
  Stage last_stage;      ///< nothing is done after it
  std::int32_t culling;  ///< 0: every pixel tests every form
  bool operator==(const Setup&) const = default;
};

enum class FilterKind : std::int32_t { none, gaussian, median, bilateral, adaptive };
/// Whether it leaves edges as they are: then the check for flying pixels looks at what it left.
TOFRAY_INLINE bool keeps_edges(FilterKind filter) { return filter == FilterKind::bilateral || filter == FilterKind::adaptive; }

/// Whether stages 1 and 2 end in the light image, and what they add to it.
struct Gather {
  std::int32_t on;
  std::int32_t first;            ///< nothing was added before
  float share;                   ///< of the light that is found
  std::int32_t begins;           ///< a tile takes its samples one after the other: this is the first of them
  const std::int32_t* middle;    ///< [height][width] object that the middle of each pixel sees, or null: not asked for
  const camera::LensView* next;  ///< of the tile's next sample; null: this is the last
  bool operator==(const Gather&) const = default;
};

/// How electrons and codes of raw frames are written.
enum class TapStores : std::int32_t {
  some,         ///< where there is a place for them
  all,          ///< there are places for all three
  past_caches,  ///< there are places for all three, and they allow stores past the caches
};

/// One frame: where its arrays are and its place in the random numbers.
struct Job {
  flow::FrameView out;
  flow::LightImage light;
  Gather gather;
  std::uint32_t index_low, index_high;
  /// Images [height][width]: filtered range, its noise, what wells had no room for, how likely ranges are on the right cycle, as far as somebody
  /// asks; then the draws of noisy lines.
  float* scratch;
  FilterKind filter;
  std::int32_t filter_radius;
  float filter_weights[33];  ///< Gaussian, [0] the middle
  float filter_factor;       ///< square of how many σ neighbours may be off
  float filter_range;        ///< square of how far, besides [m²]
  float filter_goal;         ///< square of the noise that is good enough [m²]
  TapStores tap_stores;
  bool operator==(const Job&) const = default;
};

using flow::tile_height;
using flow::tile_width;

/// What the wells of each pixel had no room for [e⁻].
TOFRAY_INLINE float* overflow_in(const Setup& s, const Job& job) { return job.scratch + 2 * s.lens.width * s.lens.height; }
/// Number of images that `scratch` has room for.
TOFRAY_INLINE int scratch_images(const Setup& s, FilterKind filter) {
  const int before = s.sensor.blooms != 0 ? 3 : filter != FilterKind::none ? 2 : 0;
  return before + (filter != FilterKind::none ? 1 : 0);
}
/// How likely ranges are on the right cycle, for the filter that is on: the last image.
TOFRAY_INLINE float* trust_in(const Setup& s, const Job& job) {
  return job.scratch + (scratch_images(s, job.filter) - 1) * s.lens.width * s.lens.height;
}
/// Number of floats in `scratch`, images and draws of noisy lines.
TOFRAY_INLINE std::int64_t scratch_floats(const Setup& s, FilterKind filter) {
  return std::int64_t{scratch_images(s, filter)} * s.lens.width * s.lens.height + effect::LineNoise::line_draws(s.sensor);
}
/// Draws of the sensor's lines, [raw_frames][width + height].
TOFRAY_INLINE float* line_normals_in(const Setup& s, const Job& job) {
  return job.scratch + scratch_images(s, job.filter) * s.lens.width * s.lens.height;
}

constexpr int rows_per_band = 8;  ///< of an image, for one worker at a time in the passes that follow the pixels

/// Whether light is followed from surface to surface.
/// @param entry  the first stage that is computed
TOFRAY_INLINE bool bounces(const Setup& s, Stage entry) {
  return s.bounces.most > 0 && entry == Stage::trace && s.last_stage >= Stage::raw;
}

TOFRAY_INLINE int tiles_across(const camera::LensView& lens) { return (lens.width + tile_width - 1) / tile_width; }
TOFRAY_INLINE int tile_count(const camera::LensView& lens) { return tiles_across(lens) * ((lens.height + tile_height - 1) / tile_height); }

}  // namespace tofray::pipeline
