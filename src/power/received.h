// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "brdf/list.h"
#include "power/light_source.h"
#include "power/paper_literal.h"
#include "power/phasors.h"

/// Stage 2: how much light each pixel receives, and over which path.
namespace tofray::power {

using flow::Radiometry;
using flow::Ray;
using flow::Surface;
using num::Mask;

/// The ray from a light to the surface point, d = P − L.
template <class F>
TOFRAY_INLINE Ray<F> light_ray(const camera::LightView& light, const flow::Place<F>& p) {
  return flow::make_ray(p.x - F(light.position[0]), p.y - F(light.position[1]), p.z - F(light.position[2]));
}

/// Whether light from there arrives on the side of the facet that is seen: no normal of a corner or of a picture lets light through it.
template <class F>
TOFRAY_INLINE Mask<F> before_facet(const Surface<F>& p, F x, F y, F z) {
  if (!p.leans) return F(0.0f) < F(1.0f);  // as the cosine says
  return num::fma(p.flat.x, x, num::fma(p.flat.y, y, p.flat.z * z)) > F(0.0f);
}

/// One light source: E_s = I·max(0, n·l)·V/r_L²  [theory: irradiance], L = f_r·E_s, S/t = L·(π T pitch² FF/4N²)·vignetting·λQE/(hc)
/// [theory: image-irradiance, pixel-power, signal-electrons], ℓ = |P − L| + |P|  [theory: path-length]. What the truth shows of it is added
/// to `sum`.
template <class F>
TOFRAY_INLINE Path<F> received(const camera::PowerView& s, const camera::LightView& light, const Surface<F>& p, const Ray<F>& ray,
                               const Ray<F>& from_light, Mask<F> dark, F vignetting, Radiometry<F>& sum) {
  const F per_distance = from_light.inverse_length, distance = from_light.square * per_distance;
  const F cos_light = -num::fma(p.nx, from_light.x, num::fma(p.ny, from_light.y, p.nz * from_light.z)) * per_distance;
  const auto lit = p.found & (!dark) & (cos_light > F(0.0f)) & before_facet(p, -from_light.x, -from_light.y, -from_light.z);
  const F radiant = intensity(light, from_light.x, from_light.y, from_light.z, per_distance);
  const F irradiance = num::select(lit, num::min(radiant * cos_light * (per_distance * per_distance), F(flow::max_irradiance)), F(0.0f));
  // both directions point from the surface: to the light −from_light/r_L, to the camera −ray/|ray|
  const F towards = num::fma(ray.x, from_light.x, num::fma(ray.y, from_light.y, ray.z * from_light.z));
  const F cos_between = towards * per_distance * ray.inverse_length;
  const auto directions = [&]() TOFRAY_LAMBDA {
    const F per_range = ray.inverse_length;
    return brdf::Directions<F>{{p.nx, p.ny, p.nz},
                               {-from_light.x * per_distance, -from_light.y * per_distance, -from_light.z * per_distance},
                               {-ray.x * per_range, -ray.y * per_range, -ray.z * per_range}};
  };
  F radiance = irradiance * brdf::reflection(p.finish, {cos_light, p.cos_view, cos_between}, directions);
  F watts = radiance * F(s.watts_per_radiance) * vignetting;
  if (s.paper_literal != 0) {
    radiance = paper_radiance(light, p, p.found & (!dark) & before_facet(p, -from_light.x, -from_light.y, -from_light.z));
    watts = radiance * F(s.paper_scale) * vignetting;
  }
  sum.irradiance = sum.irradiance + irradiance;
  sum.radiance = sum.radiance + radiance;
  sum.power = sum.power + watts;
  return {watts * F(light.electrons_per_joule), num::select(p.found, distance + p.range, F(0.0f))};
}

/// Electrons per second from ambient light, both taps together: ρ·E_B/π, through lens and pixel; of light from everywhere ρ is the albedo at
/// the view.                                                                                              [theory: ambient-light]
/// @param sun  unit vector toward it
template <class F>
TOFRAY_INLINE F ambient_rate(const camera::PowerView& s, const float* sun, const Surface<F>& p, Mask<F> dark, F vignetting) {
  const bool directional = s.ambient == camera::AmbientLight::directional;
  F rate = F(s.ambient_rate) * (directional ? p.finish.reflectivity : brdf::albedo(p.finish, p.cos_view)) * vignetting;
  if (directional) {
    const F cosine = num::fma(p.nx, F(sun[0]), num::fma(p.ny, F(sun[1]), p.nz * F(sun[2])));
    const auto lit = (!dark) & before_facet(p, F(sun[0]), F(sun[1]), F(sun[2]));
    rate = num::select(lit, rate * num::max(cosine, F(0.0f)), F(0.0f));
  }
  return num::select(p.found, rate, F(0.0f));
}

}  // namespace tofray::power
