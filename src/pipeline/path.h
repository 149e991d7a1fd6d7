// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "brdf/sample.h"
#include "num/sobol.h"
#include "pipeline/light_up.h"
#include "trace/anywhere.h"

/// A path of light from surface to surface.                                                       [theory: bounces, path-tracing]
///
/// Paths are followed from the camera on, against the way of the light: from the first surface along a way that its BRDF chooses to the next
/// one, at each of which all lights are asked directly. What the first surface itself gets from the lights is not part of this: that is
/// direct light, which light_up.h knows without chance.
namespace tofray::pipeline {

/// First bounce with Russian roulette.
constexpr int first_roulette = 3;
/// Share of a path's light below which roulette begins: the weights of paths that go on do not fall below it.
constexpr float least_left = 0.25f;
/// What random numbers are for, beside pixel and surface.
constexpr std::uint32_t of_transport = 0x70617468u;

/// A surface on the way, as the one before it sees it.
template <class F>
struct Vertex {
  flow::Surface<F> at;     ///< its range is that of the path so far
  flow::Direction<F> way;  ///< unit vector of the ray that came here
  F step;                  ///< its length [m]
  num::Int<F> facet;
  num::Mask<F> escaped;  ///< the ray went on without end
};

/// What is met by a ray that leaves from anywhere.
/// @param before  length of the path up to there [m]
/// @param area    that a pixel sees 1 m along its ray, across it [m²]
template <class F>
TOFRAY_NOINLINE Vertex<F> next_vertex(const Setup& s, int moment, F area, const shape::FreeRay<F>& ray, const trace::Leaving<F>& from,
                                      F before) {
  Vertex<F> out;
  const trace::Met<F> met = trace::nearest_from(s.scene, moment, ray, from);
  flow::Surface<F> p = trace::surface_met(s.scene, ray, from, met);
  out.step = num::select(p.found, met.distance, F(0.0f));
  p.range = before + out.step;
  out.escaped = from.wanted & (!p.found);
  out.way = {ray.dx, ray.dy, ray.dz}, out.facet = met.facet;
  if (s.scene.any_details != 0) {
    flow::Surface<F> copy = p;
    trace::add_details(s.scene, area * p.range * p.range, flow::Ray<F>{ray.dx, ray.dy, ray.dz, F(1.0f), F(1.0f)},
                       flow::Hit<F>{F(1.0f), met.facet, met.triangle}, copy);
    p = copy;
  }
  out.at = p;
  return out;
}

/// The first surface of a path.
template <class F>
TOFRAY_INLINE Vertex<F> first_vertex(const Setup& s, int moment, const flow::Ray<F>& ray, F area, F vignetting) {
  const F per = ray.inverse_length, zero = F(0.0f);
  const trace::Leaving<F> from{num::Int<F>(-1), zero, zero, zero, zero, vignetting > zero};
  return next_vertex<F>(s, moment, area, {zero, zero, zero, ray.x * per, ray.y * per, ray.z * per}, from, zero);
}

/// Three numbers of a path for one of its surfaces: two say along which way it goes on, one whether it does.
///
/// Random numbers of a pixel's two halves of paths are independent, so that the halves' difference says how well their mean is known.
template <class F>
struct Choice {
  F u, v, chance;
};
/// What they are drawn from: the same for all samples.
template <class F>
struct ChoiceSeed {
  num::Random4<F> word;
};
template <class F>
TOFRAY_INLINE ChoiceSeed<F> seed_of(const BounceView& s, num::Int<F> pixel, int bounce, int half) {
  return {num::philox<F>(num::to_uint(pixel), static_cast<std::uint32_t>(bounce), static_cast<std::uint32_t>(half), of_transport, s.keys)};
}
template <class F>
TOFRAY_INLINE Choice<F> choose(const ChoiceSeed<F>& seed, num::Uint<F> sample) {
  const auto& w = seed.word.w;
  Choice<F> out;
  num::sobol_pair<F>(num::shuffled<F>(sample, w[0]), w[1], w[2], out.u, out.v);
  const num::Uint<F> other = num::shuffled<F>(sample, w[3]);
  out.chance = num::unit<F>(num::reversed(num::turned_over<F>(other, w[0] ^ w[2])));
  return out;
}

/// Where shadow rays end. [as trace::a_little_before]
template <class F>
TOFRAY_INLINE flow::Place<F> a_little_before(const Setup& s, const flow::Place<F>& p, const flow::Ray<F>& way, F step) {
  return trace::a_little_before(s.scene, p, way, num::sqrt(flow::square_of(p.x, p.y, p.z)), step);
}

/// The way of one light straight to a surface, and from there along `ray` to where it came from.
/// @param step    length of the way along `ray` [m]
/// @param weight  how much of what the surface sends back the pixel gets
template <class F>
TOFRAY_NOINLINE flow::Path<F> path_by(const Setup& s, int moment, int l, const flow::Surface<F>& p, const flow::Ray<F>& ray, const F& step,
                                      const F& weight) {
  const flow::Place<F> before = a_little_before(s, p, ray, step);
  const flow::Ray<F> from_light = power::light_ray(s.lights[l], p), to_shade = power::light_ray(s.lights[l], before);
  const float* const at = s.lights[l].position;
  num::Mask<F> dark = trace::blocked_anywhere(s.scene.still, 0, s.scene.row_of_light(0, l), at, to_shade, before);
  if (s.scene.moments > 0)
    dark = dark | trace::blocked_anywhere(s.scene.moving, moment, s.scene.row_of_light(moment, l), at, to_shade, before);
  flow::Radiometry<F> unused{F(0.0f), F(0.0f), F(0.0f)};
  flow::Path<F> path = power::received<F>(s.power, s.lights[l], p, ray, from_light, dark, weight, unused);
  path.rate = num::select(p.found, path.rate, F(0.0f));  // where the path ended before, nothing need be a number
  return path;
}
/// Calls take(l, path) for the way of each light.
template <class F, class Take>
TOFRAY_INLINE void each_light(const Setup& s, int moment, const flow::Surface<F>& p, const flow::Ray<F>& ray, F step, F weight,
                              const Take& take) {
  for (int l = 0; l < s.scene.lights; ++l) take(l, path_by<F>(s, moment, l, p, ray, step, weight));
}
template <class F>
TOFRAY_INLINE flow::Ray<F> ray_to(const Vertex<F>& v) {
  return {v.way.x, v.way.y, v.way.z, F(1.0f), F(1.0f)};
}

/// The sun's light that reaches a surface on the way, and through it the pixel. [as power::ambient_rate]
template <class F>
TOFRAY_INLINE F sunlight(const Setup& s, int moment, const Vertex<F>& v, F weight) {
  const float* const sun = s.scene.sun(moment);
  const flow::Place<F> p = a_little_before(s, v.at, ray_to(v), v.step);
  num::Mask<F> dark = trace::blocked_parallel_anywhere(s.scene.still, 0, sun, p);
  if (s.scene.moments > 0) dark = dark | trace::blocked_parallel_anywhere(s.scene.moving, moment, sun, p);
  return power::ambient_rate<F>(s.power, sun, v.at, dark, weight);
}
/// The light that reaches a surface on the way straight from the lights, and through it the pixel.
template <class F>
TOFRAY_INLINE void light_vertex(const Setup& s, int moment, const power::Wanted& wanted, const Vertex<F>& v, F weight,
                                flow::Light<F>& light) {
  each_light<F>(s, moment, v.at, ray_to(v), v.step, weight,
                [&](int l, const flow::Path<F>& path) TOFRAY_LAMBDA { power::add_one_of_many(s.phasors, wanted, l, path, light); });
  if (s.power.ambient == camera::AmbientLight::directional) light.ambient_rate = light.ambient_rate + sunlight<F>(s, moment, v, weight);
}

/// The way on from a surface, and what is left of the light that goes it.
template <class F>
struct Onward {
  shape::FreeRay<F> ray;
  trace::Leaving<F> from;
  F weight;
};
/// @param weight  what was left up to here
template <class F>
TOFRAY_INLINE Onward<F> leave(const Choice<F>& choice, bool roulette, const Vertex<F>& v, F weight) {
  const flow::Surface<F>& p = v.at;
  const brdf::Sampled<F> sampled = brdf::sample<F>(p.finish, {p.nx, p.ny, p.nz}, {-v.way.x, -v.way.y, -v.way.z}, choice.u, choice.v);
  const flow::Direction<F>& d = sampled.light;
  const flow::Direction<F> flat = p.leans ? p.flat : flow::Direction<F>{p.nx, p.ny, p.nz};
  const F along = num::fma(d.x, flat.x, num::fma(d.y, flat.y, d.z * flat.z));
  num::Mask<F> goes_on = p.found & (sampled.weight > F(0.0f)) & (along > F(0.0f));
  weight = weight * sampled.weight;
  if (roulette) {
    const F chance = num::min(weight * F(1.0f / least_left), F(1.0f));
    goes_on = goes_on & (choice.chance < chance);
    weight = weight / num::select(goes_on, chance, F(1.0f));
  }
  // The ray begins a little before the surface, on the way that led there: in a corner nobody knows on which side of the other wall the point
  // itself is, but where a ray has just been there is room.
  const F away = num::sqrt(flow::square_of(p.x, p.y, p.z)), back = num::min(F(trace::way_back) * (away + v.step), F(0.5f) * v.step);
  const shape::FreeRay<F> ray{num::fnma(back, v.way.x, p.x), num::fnma(back, v.way.y, p.y), num::fnma(back, v.way.z, p.z), d.x, d.y, d.z};
  return {ray, {v.facet, flat.x, flat.y, flat.z, away, goes_on}, weight};
}

/// Calls meet(b, surface, weight) for what one path of each pixel meets beyond the first surface, b = 1 … most.
template <class F, class Meet>
TOFRAY_INLINE void each_vertex(const Setup& s, int moment, F area, const Pixels& p, const Vertex<F>& first, F vignetting, int half,
                               int sample, int most, const Meet& meet) {
  const num::Int<F> pixel = num::Int<F>(p.index) + num::lane_index<F>();
  Vertex<F> v = first;
  F weight = F(1.0f);
  for (int b = 1; b <= most; ++b) {
    const Choice<F> choice = choose<F>(seed_of<F>(s.bounces, pixel, b, half), num::Uint<F>(static_cast<std::uint32_t>(sample)));
    const Onward<F> on = leave<F>(choice, b >= first_roulette, v, weight);
    if (!num::any(on.from.wanted)) return;
    v = next_vertex<F>(s, moment, area, on.ray, on.from, v.at.range);
    weight = on.weight;
    meet(b, v, weight * vignetting);
    if (!num::any(v.at.found)) return;
  }
}

/// Surfaces that a path may meet beyond the first one, or nothing in place of the last of them where light comes from everywhere.
TOFRAY_INLINE int most_surfaces(const Setup& s) { return s.bounces.most + (s.power.ambient == camera::AmbientLight::uniform ? 1 : 0); }

/// The light of one path of each pixel.
template <class F>
TOFRAY_INLINE void follow_path(const Setup& s, int moment, F area, const power::Wanted& wanted, const Pixels& p, const Vertex<F>& first,
                               F vignetting, int half, int sample, flow::Light<F>& light) {
  const bool uniform = s.power.ambient == camera::AmbientLight::uniform;
  each_vertex<F>(s, moment, area, p, first, vignetting, half, sample, most_surfaces(s),
                 [&](int b, const Vertex<F>& v, F share) TOFRAY_LAMBDA {
                   if (uniform) light.ambient_rate = light.ambient_rate + num::select(v.escaped, share * F(s.power.ambient_rate), F(0.0f));
                   if (b <= s.bounces.most && num::any(v.at.found)) light_vertex<F>(s, moment, wanted, v, share, light);
                 });
}

}  // namespace tofray::pipeline
