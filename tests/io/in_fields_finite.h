// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <initializer_list>
#include <variant>
#include <vector>

#include "tofray/camera.h"
#include "tofray/scene.h"

/// Whether every number that the readers hand on is finite, and no zero is negative.
namespace tofray::test {

inline bool sane(double value) { return std::isfinite(value) && !(value == 0 && std::signbit(value)); }
inline bool sane(std::initializer_list<double> values) {
  for (const double value : values)
    if (!sane(value)) return false;
  return true;
}
template <class List>
bool sane_all(const List& values) {
  for (const double value : values)
    if (!sane(value)) return false;
  return true;
}
inline bool sane(const Curve& curve) { return sane_all(curve.x) && sane_all(curve.y); }

inline bool finite(const Object& object) {
  bool good =
      sane_all(object.position) && sane_all(object.velocity_m_per_s) && sane_all(object.rotation.axis) && sane(object.rotation.angle_rad);
  if (const auto* plane = std::get_if<Plane>(&object.shape)) good = good && sane_all(plane->point) && sane_all(plane->normal);
  if (const auto* sphere = std::get_if<Sphere>(&object.shape)) good = good && sane_all(sphere->center) && sane(sphere->radius);
  if (const auto* box = std::get_if<Box>(&object.shape)) good = good && sane_all(box->min) && sane_all(box->max);
  if (const auto* triangle = std::get_if<Triangle>(&object.shape))
    for (const auto& vertex : triangle->vertices) good = good && sane_all(vertex);
  return good;
}

inline bool finite(const Scene& scene) {
  bool good = sane_all(scene.camera.pose.position) && sane_all(scene.camera.pose.look_at) && sane_all(scene.camera.pose.up);
  good =
      good && sane(scene.ambient.amount) && sane_all(scene.ambient.table_wavelength_m) && sane_all(scene.ambient.table_irradiance_w_per_m3);
  if (scene.ambient.direction) good = good && sane_all(*scene.ambient.direction);
  for (const auto& material : scene.materials) good = good && sane({material.diffuse, material.specular, material.exponent});
  for (const auto& object : scene.objects)
    good = good && finite(object) && object.material >= 0 && static_cast<std::size_t>(object.material) < scene.materials.size();
  return good;
}

inline bool finite(const Illumination& light) {
  const Pattern& p = light.pattern;
  const Waveform& w = light.waveform;
  return sane_all(light.position) && sane_all(light.axis) && sane({light.illumination_wavelength_m, light.power_w}) &&
         sane({p.half_angle_rad, p.exponent, p.width_rad, p.height_rad, p.half_range_x_rad, p.half_range_y_rad}) && sane_all(p.samples) &&
         sane({w.duty, w.rise_time_s, w.bandwidth_hz, w.jitter_s, w.modulation_depth}) && sane_all(w.correlation);
}

inline bool finite(const Camera& c) {
  bool good = sane({c.sensor.pixel_pitch_m, c.sensor.fill_factor, c.lens.fx_px, c.lens.fy_px, c.lens.cx_px, c.lens.cy_px, c.lens.k1,
                    c.lens.k2, c.lens.p1, c.lens.p2, c.lens.k3, c.lens.f_number, c.lens.transmission, c.filter.center_m,
                    c.filter.half_width_m, c.filter.peak});
  good = good && sane(c.lens.vignetting_table) && sane(c.filter.table) && sane(c.pixel.quantum_efficiency) && sane(c.pixel.contrast);
  good = good &&
         sane({c.pixel.bandwidth_hz, c.pixel.full_well_e, c.pixel.read_noise_e, c.pixel.dark_current_e_per_s, c.pixel.prnu, c.pixel.dsnu_dn,
               c.pixel.delay_s, c.pixel.suppression_threshold_e, c.pixel.suppression_budget_e, c.pixel.suppression_noise_factor});
  good = good && sane({c.adc.step_e_per_dn, c.adc.mid_code, c.decoding.low_signal_noise_m, c.decoding.flying_near_z_m,
                       c.decoding.flying_near_limit_m, c.decoding.flying_far_z_m, c.decoding.flying_far_limit_m,
                       c.decoding.inconsistent_range_m, c.decoding.filter.sigma_px});
  good = good &&
         sane({c.temperature.celsius, c.temperature.reference_celsius, c.temperature.drift_m_per_kelvin, c.temperature.warm_up_m,
               c.temperature.warm_up_time_s, c.temperature.since_start_s, c.refractive_index, c.readout_time_s, c.min_integration_time_s});
  for (const auto& light : c.illumination) good = good && finite(light);
  good = good && sane(c.mode.frame_rate_hz) && !c.mode.sequence.empty() && c.sensor.width > 0 && c.sensor.height > 0;
  for (const auto& raw : c.mode.sequence)
    good = good && sane({raw.modulation_frequency_hz, raw.reference_phase_rad, raw.integration_time_s});
  return good;
}

}  // namespace tofray::test
