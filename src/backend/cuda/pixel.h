// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "backend/cuda/arguments.h"
#include "pipeline/pass/list.h"
#include "pipeline/plan.h"
#include "pipeline/tile.h"

/// What one thread of the GPU does: the pipeline's own functions for one pixel, on plain floats. Compiled for the host, too, where a
/// stand-in for the CUDA runtime runs it (tests/backend).
///
/// The 32 threads of a warp hold a patch of 16 × 2 pixels. Which forms the patch can meet is found by all of them together: each tests
/// one form against the patch's rectangle of directions, and a vote makes a word of 32 bits out of that, in which the forms keep their
/// order. No list is kept, so there is no limit to it, and no thread waits for another warp.
namespace tofray::backend::gpu {

using pipeline::Job;
using pipeline::Pixels;
using pipeline::Setup;

constexpr int warp_size = 32, patch_width = 16, patch_height = 2;
constexpr int max_block_size = 1024;

TOFRAY_INLINE int patches_across(const camera::LensView& lens) { return (lens.width + patch_width - 1) / patch_width; }
TOFRAY_INLINE int patch_count(const camera::LensView& lens) {
  return patches_across(lens) * ((lens.height + patch_height - 1) / patch_height);
}

/// Pixel of one lane. A lane beyond the image does its edge once more, so that all lanes go the same way: both write the same.
TOFRAY_INLINE Pixels pixel_of(const camera::LensView& lens, int patch, int lane) {
  const int across = patches_across(lens);
  const int x = patch % across * patch_width + lane % patch_width, y = patch / across * patch_height + lane / patch_width;
  return {(y < lens.height ? y : lens.height - 1) * lens.width + (x < lens.width ? x : lens.width - 1), 1};
}

/// A way through the forms that a bundle of rays can meet, 32 at a time.
template <class Warp, class Form>
struct WarpFormIterator {
  Warp& warp;
  const Form* forms;
  int count, base;
  const flow::Bounds* within;  ///< null: all of them
  std::uint32_t left;          ///< those of the 32 from `base` on that are still to come

  TOFRAY_INLINE bool more() {
    while (left == 0) {
      base += warp_size;
      if (base >= count) return false;
      left = within == nullptr ? (count - base < warp_size ? (1u << (count - base)) - 1 : ~0u) : vote();
    }
    return true;
  }
  TOFRAY_INLINE const Form& form() const { return forms[base + Warp::lowest_bit(left)]; }
  TOFRAY_INLINE void next() { left &= left - 1; }

 private:
  TOFRAY_INLINE std::uint32_t vote() const {
    return warp.vote(forms + base, [&](int lane) { return base + lane < count && can_meet(forms[base + lane], *within); });
  }
};

/// What is left of one view's forms.
template <class Warp>
struct WarpCulled {
  Warp& warp;
  const flow::Bounds* within;
  scene::Forms forms;
  template <class T>
  TOFRAY_INLINE WarpFormIterator<Warp, typename T::Form> iterate() const {
    return {warp, forms.of<T>().at, forms.of<T>().count, -warp_size, within, 0};
  }
};

/// Which forms a patch can meet, from the camera and from the light that is looked at now.
/// \tparam can_move  false: nothing moves, and the kernel has no code for what does
template <bool can_move, class Warp>
struct WarpNear {
  Warp& warp;
  bool culling;
  const flow::Bounds* from_camera;  ///< null: all of them
  flow::Bounds from_light;
  bool all_from_light;

  TOFRAY_INLINE WarpNear(Warp& w, const flow::Bounds* view) : warp(w), culling(view != nullptr), from_camera(view) {}

  static constexpr bool keeps_places = false;  // it would take registers of each thread
  TOFRAY_INLINE bool moves(const Setup& s) const { return can_move && s.scene.moments > 0; }
  TOFRAY_INLINE bool any(bool mask) const { return warp.any(mask); }
  TOFRAY_INLINE bool can_be_shaded(const Setup&) const { return true; }  // known once the rays to the lights are
  /// The rectangle that holds the rays of all lanes from a light to their surfaces.
  TOFRAY_INLINE void look(int moment, int light, const flow::Ray<float>& ray, bool use) {
    if (!culling) return;
    pipeline::Rectangle<float> seen;
    seen.add(ray.x, ray.y, ray.z, use);
    warp.unite(moment * flow::max_lights + light, seen);
    all_from_light = seen.open;
    from_light = seen.bounds();
  }
  TOFRAY_INLINE WarpCulled<Warp> still_from_camera(const Setup& s) const { return {warp, from_camera, s.scene.camera_still()}; }
  TOFRAY_INLINE WarpCulled<Warp> moving_from_camera(const Setup& s, int moment) const {
    return {warp, from_camera, s.scene.camera_moving(moment)};
  }
  TOFRAY_INLINE WarpCulled<Warp> still_from(const Setup& s, int light) const { return {warp, seen_by_light(), s.scene.light_still(light)}; }
  TOFRAY_INLINE WarpCulled<Warp> moving_from(const Setup& s, int moment, int light) const {
    return {warp, seen_by_light(), s.scene.light_moving(moment, light)};
  }
  /// The sun's rays have no common origin: each looks at everything.
  TOFRAY_INLINE void look_along(const Setup&, int, const flow::Place<float>&) const {}
  TOFRAY_INLINE trace::Uncut<scene::Alongs> still_along(const Setup& s) const { return {s.scene.sun_still()}; }
  TOFRAY_INLINE trace::Uncut<scene::Alongs> moving_along(const Setup& s, int moment) const { return {s.scene.sun_moving(moment)}; }
  /// Each ray looks at meshes by itself.
  static constexpr int sun = 0;
  template <class F>
  TOFRAY_INLINE bool behind_still_meshes(int) const {
    return false;
  }
  template <class F>
  TOFRAY_INLINE bool behind_moving_meshes(int) const {
    return false;
  }

 private:
  TOFRAY_INLINE const flow::Bounds* seen_by_light() const { return culling && !all_from_light ? &from_light : nullptr; }
};

/// The mean of the light over an exposure; where nothing moves it needs no memory of its own.
template <bool can_move>
struct MeanLight {
  flow::Light<float> light;
  TOFRAY_INLINE flow::Light<float>& in(flow::Light<float>&) { return light; }
};
template <>
struct MeanLight<false> {
  TOFRAY_INLINE flow::Light<float>& in(flow::Light<float>& only) { return only; }
};

/// One pixel.
template <bool can_move, class Warp>
class PixelSource {
 public:
  TOFRAY_INLINE PixelSource(const Setup& s, const Job& job, Warp& warp, int patch, int lane)
      : s_(s), job_(job), pixels_(pixel_of(s.lens, patch, lane)), near_(warp, s.culling != 0 ? s.lens.tile + patch : nullptr) {
    still_ = pipeline::see_still(s, near_, camera::ray<float>(s.lens, pixels_));
    hit_ = still_;
  }

  TOFRAY_INLINE int moments() const { return near_.moves(s_) ? s_.scene.moments : 1; }
  static constexpr bool once() { return false; }
  TOFRAY_INLINE int packs() const { return 1; }
  TOFRAY_INLINE Pixels pixels(int) const { return pixels_; }
  TOFRAY_INLINE Pixels ahead(int) const { return {0, 0}; }
  TOFRAY_INLINE pipeline::PackState<float>& pack(int) { return pack_; }
  static constexpr bool blurs = can_move, inlined = true;
  TOFRAY_INLINE flow::Light<float>& mean(int) { return mean_.in(pack_.light); }
  TOFRAY_INLINE void go_to(const pipeline::Moment& now) {
    if (near_.moves(s_)) hit_ = pipeline::see_moving(s_, near_, now.index, camera::ray<float>(s_.lens, pixels_), still_);
  }
  TOFRAY_INLINE bool find_light(const pipeline::Moment& now, int, const Pixels& p, const flow::Ray<float>& ray, float vignetting,
                                pipeline::PackState<float>& pack) {
    return pipeline::light_of_scene(s_, job_, near_, now, p, ray, still_, hit_, vignetting, pack.light, pack.undisturbed, pack.before);
  }

 private:
  const Setup& s_;
  const Job& job_;
  Pixels pixels_;
  WarpNear<can_move, Warp> near_;
  flow::Hit<float> still_, hit_;
  pipeline::PackState<float> pack_;
  MeanLight<can_move> mean_;
};

/// From ray to depth. All lanes of a warp must come here together.
template <bool can_move, class Warp>
TOFRAY_INLINE void run_pixel(const Setup& s, const Job& job, Warp& warp, int patch, int lane) {
  PixelSource<can_move, Warp> source(s, job, warp, patch, lane);
  pipeline::run_pipeline<float>(s, job, source);
}

/// Unit number `unit` of what is derived of a frame's scene.
TOFRAY_INLINE void run_derive(const Setup& s, scene::Derive what, int unit) {
  if (unit < scene::unit_count(s.scene, what)) scene::derive(s.scene, what, unit);
}

/// How much there is to do in a pass over images: its pixels; or the sensor's lines in all raw frames.
template <class P>
TOFRAY_INLINE int units_of(const Setup& s) {
  return P::over == pipeline::Over::raw_frames ? effect::LineNoise::line_draws(s.sensor) : s.lens.width * s.lens.height;
}

/// Unit number `index` of a pass over images.
template <class P>
TOFRAY_INLINE void run_unit(const pipeline::PassWork& work, int index) {
  if (index >= units_of<P>(work.s)) return;
  if constexpr (P::over == pipeline::Over::raw_frames) {
    P::line(work, index);
  } else {
    P::template pixels<float>(work, Pixels{index, 1});
  }
}

/// The place of an array in the frame that lies `bytes` further on.
template <class T>
TOFRAY_INLINE T* shifted(T* array, std::int64_t bytes) {
  return array == nullptr ? nullptr : reinterpret_cast<T*>(reinterpret_cast<char*>(array) + bytes);
}

/// Makes the job that a batch has in common that of one frame, whose arrays are `bytes` further on.
/// @param worker  does its share of it: all from 0 to `array_count` on are needed, in any order
TOFRAY_INLINE void take_frame(const FrameNumber& number, std::int64_t bytes, int worker, Job& job) {
  if (worker == 0) {
    job.index_low = number.low, job.index_high = number.high;
    job.scratch = shifted(job.scratch, bytes);
  }
  int i = 0;
  flow::each_array(job.out, [&](auto*& array, ArrayShape, Stage) {
    if (++i == worker) array = shifted(array, bytes);
  });
}

}  // namespace tofray::backend::gpu
