// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/ray.h"
#include "pipeline/store.h"
#include "power/received.h"
#include "raw/expose.h"
#include "trace/visible.h"

/// The pipeline, and the only place that knows its order:
///
///     ray → nearest surface → light that reaches it → power received → raw frames → depth
///
/// A tile of pixels goes to `see` first and on from there, so that shadow rays can be culled for what the tile sees.
namespace tofray::pipeline {

/// Which forms the pixels of a tile can meet: seen from the camera, and from each light.
struct Near {
  trace::Culled camera_still, camera_moving;
  trace::Culled light_still[flow::max_lights], light_moving[flow::max_lights];

  /// What `light` can see of the pixels is known before they are lit: nothing to do for the ray that goes to one of them.
  template <class F>
  TOFRAY_FN void look(int, int, const flow::Ray<F>&, num::Mask<F>) const {}
  TOFRAY_FN const trace::Culled& still_from(int light) const { return light_still[light]; }
  TOFRAY_FN const trace::Culled& moving_from(int light) const { return light_moving[light]; }
};

/// Stage 1: the nearest surface, of what stands still.
template <class F, class Near>
TOFRAY_FN flow::Hit<F> see_still(const Setup& s, const Near& near, const flow::Ray<F>& ray) {
  return trace::nearest(s.scene.camera_still, near.camera_still, ray, flow::Hit<F>{F(0.0f), num::Int<F>(0)});
}

/// … and of what moves, at the time of one raw frame.
template <class F, class Near>
TOFRAY_FN flow::Hit<F> see_moving(const Setup& s, const Near& near, int slot, const flow::Ray<F>& ray, const flow::Hit<F>& still) {
  return trace::nearest(s.scene.camera_moving[slot], near.camera_moving, ray, still);
}

/// Light that a surface point sends to its pixel.
template <class F>
struct Lighting {
  flow::Light<F> light;
  flow::Radiometry<F> radiometry;
};

/// Shadow rays through what stands still and, if it can come between, what moves.
template <class F, class Near>
struct ShadowRays {
  const Setup& s;
  Near& near;
  int slot;
  bool moving;

  TOFRAY_FN num::Mask<F> of_light(int l, const flow::Ray<F>& from_light, const flow::Surface<F>& p) {
    near.look(slot, l, from_light, p.found);
    auto dark = trace::blocked(s.scene.light_still[l], near.still_from(l), from_light, p.object);
    if (moving) {
      dark = dark | trace::blocked(s.scene.light_moving[slot * s.scene.lights + l], near.moving_from(l), from_light, p.object);
    }
    return dark;
  }
  TOFRAY_FN num::Mask<F> of_sun(const flow::Surface<F>& p) {
    auto dark = trace::blocked_parallel(s.scene.sun_still, s.power.sun_direction, p);
    if (s.scene.slots > 0) dark = dark | trace::blocked_parallel(s.scene.sun_moving[slot], s.power.sun_direction, p);
    return dark;
  }
};

/// Stage 2: power, where no shadow is. The shadows are asked for light by light, in their order.
template <class F, class Shadows>
TOFRAY_FN void light_up(const Setup& s, Shadows&& shadows, const flow::Ray<F>& ray, const flow::Surface<F>& p, F vignetting, Lighting<F>& out) {
  out.light.total_rate = F(0.0f);
  for (int l = 0; l < s.scene.lights; ++l) {
    const flow::Ray<F> from_light = power::light_ray(s.lights[l], p);
    const auto dark = shadows.of_light(l, from_light, p);
    power::add_light<F>(s.power, s.lights[l], p, ray, from_light, dark, vignetting, out.light.signal_rate[l], out.light.path_length[l],
                        out.radiometry);
    out.light.total_rate = out.light.total_rate + out.light.signal_rate[l];
  }
  num::Mask<F> shade = F(1.0f) < F(0.0f);
  if (s.power.ambient_kind == 2) shade = shadows.of_sun(p);
  out.light.ambient_rate = s.power.ambient_kind == 0 ? F(0.0f) : power::ambient_rate<F>(s.power, p, shade, vignetting);
}

/// Stage 3 for one raw frame: A−B as depth takes it.
template <class F>
TOFRAY_FN F collect(const Setup& s, const Job& job, const Pixels& p, int k, const flow::Light<F>& light, bool light_changed,
                                raw::Exposure<F>& exposure) {
  const flow::Taps<F> taps = raw::expose(s.sensor, k, light, s.scene.lights, light_changed, raw::FrameIndex{job.index_low, job.index_high}, exposure);
  store_taps(s.lens.width * s.lens.height, job.out, p, k, taps);
  if (job.out.gt_signal_e != nullptr) {
    const F signal = s.sensor.frame[k].lit != 0 ? light.total_rate * F(s.sensor.frame[k].integration_time) : F(0.0f);
    num::store(job.out.gt_signal_e + p.index + k * s.lens.width * s.lens.height, signal, p.count);
  }
  return taps.difference;
}

/// Stage 4.
template <class F>
TOFRAY_FN void find_depth(const Setup& s, const Job& job, const Pixels& p, const flow::Ray<F>& ray, const F* difference, num::Mask<F> clipped, F delay,
                          F vignetting) {
  const auto outside = !(vignetting > F(0.0f));
  const flow::Depth<F> found = depth::decode<F>(s.decoder, difference, clipped, outside, ray, delay);
  store(job.out.amplitude_e, p, found.amplitude);
  store(job.out.ambient_e, p, found.ambient);
  store_range(s, job.out, p, ray, found.range, found.noise, found.flags);
  store(job.out.noise_m, p, num::select((found.flags & num::Int<F>(depth::no_return)) == num::Int<F>(0), found.noise, nan<F>()));
}

/// Stage 4 once all raw frames are collected, where it is wanted.
template <class F>
TOFRAY_FN void end_frame(const Setup& s, const Job& job, const Pixels& p, const flow::Ray<F>& ray, const F* difference,
                         const raw::Exposure<F>& exposure, F vignetting) {
  if (s.last_stage < stage_depth) return;
  find_depth<F>(s, job, p, ray, difference, raw::saturated(s.sensor, exposure), exposure.delay, vignetting);
}

/// Outside the lens model a pixel sees nothing; its ray is only a stand-in.
template <class F>
TOFRAY_FN void hide_outside_lens(F vignetting, flow::Surface<F>& surface) {
  surface.found = surface.found & (vignetting > F(0.0f));
}

/// Stages 1 and 2 from the surface on, and what they show of the truth.
/// @param moving  whether anything that moves can stand in the way
template <class F, class Near>
TOFRAY_FN void light_surface(const Setup& s, const Job& job, Near& near, int slot, bool moving, bool truth, const Pixels& p,
                             const flow::Ray<F>& ray, const flow::Hit<F>& hit, F vignetting, Lighting<F>& lighting) {
  flow::Surface<F> surface = trace::surface(s.scene, ray, hit);
  hide_outside_lens(vignetting, surface);
  lighting.radiometry = {F(0.0f), F(0.0f), F(0.0f)};
  if (s.last_stage >= stage_power) light_up(s, ShadowRays<F, Near>{s, near, slot, moving}, ray, surface, vignetting, lighting);
  const auto material = [&]() __attribute__((always_inline)) { return trace::material<F>(s.scene, hit); };
  if (truth) store_truth(job.out, p, surface, lighting.radiometry, material);
}

/// Stages 3 and 4: every raw frame, then depth.
/// @param light     the light of raw frame k is light[entry[k]]
/// @param entry     a null pointer: always light[0]
template <class F>
TOFRAY_FN void measure(const Setup& s, const Job& job, const Pixels& p, const flow::Ray<F>& ray, F vignetting, const flow::Light<F>* light,
                       const std::int32_t* entry) {
  raw::Exposure<F> exposure = raw::start<F>(s.sensor, p);
  F difference[flow::max_raw_frames];
  for (int k = 0; k < s.sensor.raw_frames; ++k) {
    const std::int32_t now = entry != nullptr ? entry[k] : 0;
    const bool changed = entry != nullptr && k > 0 && entry[k] != entry[k - 1];
    difference[k] = collect(s, job, p, k, light[now], changed, exposure);
  }
  end_frame(s, job, p, ray, difference, exposure, vignetting);
}

/// Everything that follows once the nearest surface is known, where nothing moves.
template <class F, class Near>
TOFRAY_FN void one_pixel(const Setup& s, const Job& job, Near& near, const Pixels& p, const flow::Ray<F>& ray, const flow::Hit<F>& hit) {
  const F vignetting = camera::vignetting<F>(s.lens, p);
  Lighting<F> lighting;
  light_surface(s, job, near, 0, false, true, p, ray, hit, vignetting, lighting);
  if (s.last_stage < stage_raw) return;
  measure(s, job, p, ray, vignetting, &lighting.light, nullptr);
}

/// One pixel of a scene in which something moves, raw frame by raw frame, each with the scene at its own time. Where it sees what stands still
/// and nothing that moves comes between that and a light, the light is what it was. (Tiles keep the light of all raw frames instead:
/// pipeline/tile.h.)
/// @param near   knows besides: any(mask), whether it is true for any pixel that goes the same way; clear(s, slot), whether nothing that
///               moves can stand between the lights and the surfaces that were lit last
/// @param still  nearest surface of what stands still
template <class F, class Near>
TOFRAY_FN void one_moving_pixel(const Setup& s, const Job& job, Near& near, const Pixels& p, const flow::Ray<F>& ray, const flow::Hit<F>& still) {
  const F vignetting = camera::vignetting<F>(s.lens, p);
  raw::Exposure<F> exposure = raw::start<F>(s.sensor, p);
  F difference[flow::max_raw_frames];
  Lighting<F> lighting;
  bool undisturbed = false;     // the light in hand is that of what stands still
  for (int k = 0; k < s.sensor.raw_frames; ++k) {
    const bool truth = k == s.truth_slot;
    if (s.last_stage < stage_power && !truth) continue;
    const flow::Hit<F> hit = see_moving(s, near, k, ray, still);
    const bool same = !near.any(hit.facet != still.facet) && s.power.ambient_kind != 2 && s.last_stage >= stage_power;
    const bool keep = same && undisturbed && !truth && near.clear(s, k);
    if (!keep) {
      light_surface(s, job, near, k, true, truth, p, ray, hit, vignetting, lighting);
      undisturbed = same && near.clear(s, k);
    }
    if (s.last_stage >= stage_raw) difference[k] = collect(s, job, p, k, lighting.light, !keep, exposure);
  }
  end_frame(s, job, p, ray, difference, exposure, vignetting);
}

}  // namespace tofray::pipeline
