// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/surface_truth.h"
#include "power/received.h"
#include "trace/detail.h"
#include "trace/visible.h"

/// Stages 1 and 2 of a pack of pixels at one moment: what it sees, and the light it gets from there.
namespace tofray::pipeline {

/// A time at which the scene is looked at, and the raw frames that are exposed to what it shows: one, or all where nothing moves.
struct Moment {
  int first, last;      ///< raw frames, without the last
  int index;            ///< what moves is where it is at this time
  int sample, samples;  ///< which one of so many times within each exposure
  bool truth;           ///< ground truth is that of this moment
  bool whole;           ///< it is the only one: all that is seen is the same at all times of the frame
};

/// Times at which an exposure sees what moves.
TOFRAY_INLINE int times_within_exposure(const Setup& s) { return s.scene.moments > 0 ? s.scene.moments / s.sensor.raw_frames : 1; }

/// @param moments  1, or as many for each raw frame. The truth is that of the middle of the middle one.
/// @param blurs    whether the light of an exposure is a mean over its times also where there is one moment for all
TOFRAY_INLINE Moment moment_of(const Setup& s, int moment, int moments, bool blurs) {
  if (moments == 1) return {0, s.sensor.raw_frames, 0, 0, blurs ? times_within_exposure(s) : 1, true, true};
  const int samples = moments / s.sensor.raw_frames, frame = moment / samples, sample = moment % samples;
  return {frame, frame + 1, moment, sample, samples, frame == s.sensor.raw_frames / 2 && sample == samples / 2, false};
}

/// Which of the scene's moments that is.
TOFRAY_INLINE int truth_moment(const Setup& s) {
  if (s.scene.moments == 0) return 0;
  const int samples = s.scene.moments / s.sensor.raw_frames;
  return s.sensor.raw_frames / 2 * samples + samples / 2;
}

/// Light of what stands still may serve all raw frames; other light serves those of its moment.
TOFRAY_INLINE power::Wanted wanted(const Setup& s, const Moment& now, bool undisturbed) {
  if (undisturbed || now.last > now.first + 1) return power::all_of(s.phasors);
  const camera::RawFrameView& frame = s.sensor.frame[now.first];
  return frame.lit != 0 ? power::Wanted{frame.modulation, frame.modulation + 1} : power::Wanted{0, 0};
}

/// Stage 1: the nearest surface of all that stands still.
template <class F, class Candidates>
TOFRAY_INLINE flow::Hit<F> see_still(const Setup& s, const Candidates& near, const flow::Ray<F>& ray) {
  return trace::nearest(near.still_from_camera(s), ray, flow::no_hit<F>());
}

/// Stage 1: the nearest surface, of what stands still and of what moves at the time of one raw frame.
template <class F, class Candidates>
TOFRAY_INLINE flow::Hit<F> see_moving(const Setup& s, const Candidates& near, int moment, const flow::Ray<F>& ray,
                                      const flow::Hit<F>& still) {
  return trace::nearest(near.moving_from_camera(s, moment), ray, still);
}

/// Outside the lens model a pixel sees nothing; its ray is only a stand-in.
template <class F>
TOFRAY_INLINE void hide_outside_lens(F vignetting, flow::Surface<F>& surface) {
  surface.found = surface.found & (vignetting > F(0.0f));
}

/// What is where a ray through the lens hits.
template <class F>
TOFRAY_INLINE flow::Surface<F> surface_seen(const Setup& s, const camera::LensView& lens, const flow::Ray<F>& ray, const flow::Hit<F>& hit,
                                            F vignetting) {
  flow::Surface<F> surface = trace::surface(s.scene, ray, hit);
  if (s.scene.any_details != 0) {
    // What is handed to a function lies in memory; the originals need not.
    const flow::Ray<F> ray_copy = ray;
    const flow::Hit<F> hit_copy = hit;
    flow::Surface<F> copy = surface;
    trace::add_details(s.scene, F(lens.pixel_area) * surface.z * surface.z * ray.inverse_length, ray_copy, hit_copy, copy);
    surface = copy;
  }
  hide_outside_lens(vignetting, surface);
  return surface;
}

/// Where something that moves stands between a light and the surface, or the sun and it: asked in two places.
template <class F, class Culled>
TOFRAY_NOINLINE num::Mask<F> blocked_by_what_moves(const Culled& culled, const flow::Ray<F>& from_light, const flow::Place<F>& p) {
  return trace::blocked(culled, from_light, p);
}
template <class F, class Culled>
TOFRAY_NOINLINE num::Mask<F> blocked_by_what_moves(const Culled& culled, const float* sun, const flow::Place<F>& p) {
  return trace::blocked_parallel(culled, sun, p);
}

/// Shadow rays of a pack of pixels at one moment.
template <class F, class Candidates>
struct ShadowRays {
  const Setup& s;
  Candidates& near;
  int moment;
  flow::Place<F> p;                  ///< a little before the surface
  bool still = true, moving = true;  ///< whether what stands still, and what moves, can come between
  bool known = false;                ///< of the only light: the ray from it, and where something that moves stands in its way
  flow::Ray<F> from_light;
  num::Mask<F> behind_moving;

  TOFRAY_INLINE ShadowRays(const Setup& setup, Candidates& candidates, int now) : s(setup), near(candidates), moment(now) {}

  TOFRAY_INLINE const float* sun_direction() const { return s.scene.sun(moment); }
  TOFRAY_INLINE bool sun_shines() const { return s.power.ambient == camera::AmbientLight::directional; }
  TOFRAY_INLINE num::Mask<F> of_light(int l) {
    if (!known) from_light = power::light_ray(s.lights[l], p), near.look(moment, l, from_light, p.found);
    num::Mask<F> dark = F(1.0f) < F(0.0f);
    if (still) dark = trace::blocked(near.still_from(s, l), from_light, p) | near.template behind_still_meshes<F>(l);
    if (!moving) return dark;
    return dark |
           (known ? behind_moving
                  : blocked_by_what_moves<F>(near.moving_from(s, moment, l), from_light, p) | near.template behind_moving_meshes<F>(l));
  }
  TOFRAY_INLINE num::Mask<F> of_sun() {
    near.look_along(s, moment, p);
    num::Mask<F> dark = F(1.0f) < F(0.0f);
    if (still) {
      dark = trace::blocked_parallel(near.still_along(s), sun_direction(), p) | near.template behind_still_meshes<F>(near.sun);
    }
    if (moving) {
      dark = dark | blocked_by_what_moves<F>(near.moving_along(s, moment), sun_direction(), p) |
             near.template behind_moving_meshes<F>(near.sun);
    }
    return dark;
  }
  /// Where something that moves keeps a light off.
  TOFRAY_INLINE num::Mask<F> of_what_moves() {
    still = false, behind_moving = F(1.0f) < F(0.0f);
    for (int l = 0; l < s.scene.lights; ++l) behind_moving = behind_moving | of_light(l);
    if (sun_shines()) behind_moving = behind_moving | of_sun();
    still = true, known = s.scene.lights == 1 && !sun_shines();
    return behind_moving & p.found;
  }
};

/// Stage 2: light, where no shadow is. The shadows are asked for light by light, in their order.
template <class F, class Shadows>
TOFRAY_INLINE void light_up(const Setup& s, const power::Wanted& wanted, Shadows&& shadows, const flow::Ray<F>& ray,
                            const flow::Surface<F>& p, F vignetting, flow::Light<F>& light, flow::Radiometry<F>& radiometry) {
  if (s.scene.lights == 0) power::clear(s.phasors, wanted, light);
  for (int l = 0; l < s.scene.lights; ++l) {
    const flow::Ray<F> from_light = power::light_ray(s.lights[l], p);
    const auto dark = shadows.of_light(l);
    const flow::Path<F> path = power::received<F>(s.power, s.lights[l], p, ray, from_light, dark, vignetting, radiometry);
    if (s.phasors.sums_alone != 0) {
      power::sums_of_path(s.phasors, wanted, path, light);
    } else {
      power::add_path(s.phasors, wanted, l, path, l == 0, light);
    }
  }
  if (s.phasors.sums_alone == 0) power::add_up(s.phasors, wanted, light);
  num::Mask<F> shade = F(1.0f) < F(0.0f);
  if (s.power.ambient == camera::AmbientLight::directional) shade = shadows.of_sun();
  light.ambient_rate = s.power.ambient == camera::AmbientLight::none
                           ? F(0.0f)
                           : power::ambient_rate<F>(s.power, shadows.sun_direction(), p, shade, vignetting);
}

/// Stages 1 and 2 from what a pack of pixels hits.
///
/// Where it sees what stands still and nothing that moves keeps a light off that, its light is the same at all moments, and is kept.
///
/// @param near   what the pixels can meet: still_from_camera(s), moving_from_camera(s, moment), and from each light. It knows moves(s);
///               any(mask), whether it is true for any pixel that goes the same way; can_be_shaded(s), false where nothing that moves can
///               stand before a light; look(…) and look_along(…), which are told of each shadow ray; and, where meshes are looked at by all
///               pixels of a tile at once, what that found: behind_still_meshes(light), behind_moving_meshes(light), the sun being one, too;
///               keeps_places: whether `before` lasts from one moment to the next
/// @param still  what they would hit if nothing moved
/// @param before  a little before that, once `undisturbed` is true
/// @return false where `light` is as it was
template <class F, class Candidates>
TOFRAY_INLINE bool light_of_scene(const Setup& s, const Job& job, Candidates& near, const Moment& now, const Pixels& p,
                                  const flow::Ray<F>& ray, const flow::Hit<F>& still, const flow::Hit<F>& hit, F vignetting,
                                  flow::Light<F>& light, bool& undisturbed, flow::Place<F>& before) {
  const bool moves = near.moves(s);
  if (job.out.gt_phase_flow_px != nullptr && now.sample == now.samples / 2) {
    const flow::Ray<F> ray_copy = ray;
    const flow::Hit<F> hit_copy = hit;
    const flow::Surface<F> copy = surface_seen(s, s.lens, ray, hit, vignetting);
    store_phase_flow<F>(s, job.out.gt_phase_flow_px, p, now.first, now.last, now.index, now.truth, ray_copy, hit_copy, copy);
  }
  const bool same = !moves || !near.any(hit.facet != still.facet);
  const bool open = !moves || s.last_stage < Stage::power || !near.can_be_shaded(s);  // nothing that moves can come between
  const bool again = same && undisturbed && !now.truth;
  if (again && open) return false;
  ShadowRays<F, Candidates> shadows(s, near, now.index);
  if constexpr (Candidates::keeps_places) {
    if (again) {
      shadows.p = before;
      if (!near.any(shadows.of_what_moves())) return false;
    }
  }
  const flow::Surface<F> surface = surface_seen(s, s.lens, ray, hit, vignetting);
  bool calm = false;
  if (!Candidates::keeps_places || !again) {
    shadows.p = trace::a_little_before(s.scene, surface, ray);
    calm = same && (open || !near.any(shadows.of_what_moves()));
    if (calm && again) return false;
    if (Candidates::keeps_places && calm && !now.whole) before = shadows.p;
  }
  undisturbed = calm;
  flow::Radiometry<F> radiometry{F(0.0f), F(0.0f), F(0.0f)};
  if (s.last_stage >= Stage::power) {
    shadows.moving = moves && !calm;
    light_up(s, wanted(s, now, calm), shadows, ray, surface, vignetting, light, radiometry);
    // Where rays say how much of the sky a surface sees, it does not see all of it.
    if (bounces(s, Stage::trace) && s.power.ambient == camera::AmbientLight::uniform) light.ambient_rate = F(0.0f);
  }
  const auto material = [&]() TOFRAY_LAMBDA { return trace::material<F>(s.scene, hit); };
  if (now.truth) {
    store_truth(job.out, p, surface, radiometry, material);
    if (s.last_stage >= Stage::power) store(job.out.gt_ambient_e_per_s, p, light.ambient_rate);
  }
  if (now.truth && wants_seen(job.out)) {
    const flow::Ray<F> ray_copy = ray;
    const flow::Hit<F> hit_copy = hit;
    const flow::Surface<F> copy = surface;
    store_surface_truth(s, job.out, p, ray_copy, hit_copy, copy);
  }
  return true;
}

}  // namespace tofray::pipeline
