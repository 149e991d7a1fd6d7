// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <variant>
#include <vector>

#include "tofray/tofray.h"

/// Every number of a scene and a camera, so that tests can put anything into any of them.
namespace tofray::test {

struct Numbers {
  std::vector<double*> reals;
  std::vector<int*> integers;

  void add(double& value) { reals.push_back(&value); }
  void add(int& value) { integers.push_back(&value); }
  void add(Vec3& value) {
    for (double& one : value) add(one);
  }
  void add(std::vector<double>& values) {
    for (double& one : values) add(one);
  }
  void add(Curve& curve) { add(curve.x), add(curve.y); }
  template <class... Values>
  void all(Values&... values) {
    (add(values), ...);
  }

  void add(Object& object) {
    all(object.material, object.position, object.rotation.axis, object.rotation.angle_rad, object.velocity_m_per_s);
    if (auto* plane = std::get_if<Plane>(&object.shape)) all(plane->point, plane->normal);
    if (auto* sphere = std::get_if<Sphere>(&object.shape)) all(sphere->center, sphere->radius);
    if (auto* box = std::get_if<Box>(&object.shape)) all(box->min, box->max);
    if (auto* triangle = std::get_if<Triangle>(&object.shape)) all(triangle->vertices[0], triangle->vertices[1], triangle->vertices[2]);
  }
  void add(Scene& scene) {
    all(scene.camera.pose.position, scene.camera.pose.look_at, scene.camera.pose.up);
    all(scene.ambient.amount, scene.ambient.table_wavelength_m, scene.ambient.table_irradiance_w_per_m3);
    if (scene.ambient.direction) add(*scene.ambient.direction);
    for (Material& one : scene.materials) all(one.diffuse, one.specular, one.exponent);
    for (Object& one : scene.objects) add(one);
  }

  void add(Illumination& light) {
    Pattern& p = light.pattern;
    Waveform& w = light.waveform;
    all(light.position, light.axis, light.illumination_wavelength_m, light.power_w);
    all(p.half_angle_rad, p.exponent, p.width_rad, p.height_rad, p.columns, p.rows, p.half_range_x_rad, p.half_range_y_rad, p.samples);
    all(w.duty, w.rise_time_s, w.bandwidth_hz, w.jitter_s, w.harmonics, w.correlation);
  }
  void add(Camera& c) {
    all(c.sensor.pixel_pitch_m, c.sensor.fill_factor);  // not its size: that has tests of its own
    all(c.lens.fx_px, c.lens.fy_px, c.lens.cx_px, c.lens.cy_px, c.lens.k1, c.lens.k2, c.lens.p1, c.lens.p2, c.lens.k3, c.lens.f_number);
    all(c.lens.transmission, c.lens.vignetting_table, c.filter.center_m, c.filter.half_width_m, c.filter.peak, c.filter.table);
    for (Illumination& light : c.illumination) add(light);
    Pixel& p = c.pixel;
    all(p.quantum_efficiency, p.contrast, p.bandwidth_hz, p.full_well_e, p.read_noise_e, p.dark_current_e_per_s, p.prnu, p.dsnu_dn,
        p.delay_s);
    all(p.suppression_threshold_e, p.suppression_budget_e, p.suppression_noise_factor);
    all(c.adc.bits, c.adc.step_e_per_dn, c.adc.mid_code, c.adc.valid_min, c.adc.valid_max);
    Decoding& d = c.decoding;
    all(d.low_signal_noise_m, d.flying_near_z_m, d.flying_near_limit_m, d.flying_far_z_m, d.flying_far_limit_m, d.inconsistent_range_m);
    all(d.filter.sigma_px, d.filter.radius_px);
    Temperature& t = c.temperature;
    all(t.celsius, t.reference_celsius, t.drift_m_per_kelvin, t.warm_up_m, t.warm_up_time_s, t.since_start_s);
    all(c.refractive_index, c.readout_time_s, c.min_integration_time_s, c.mode.frame_rate_hz);
    for (RawFrame& k : c.mode.sequence) all(k.modulation_frequency_hz, k.reference_phase_rad, k.integration_time_s);
  }
};

}  // namespace tofray::test
