// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <cstddef>

#include "base/vec.h"
#include "support/pi.h"
#include "tofray/tofray.h"

/// Small cameras and scenes, built in code, for closed forms.
namespace tofray::test {

using base::operator+;
using base::operator-;
using base::operator*;

/// A pinhole without distortion, 17.5 µm pixels, N = 0.9, T = 1, FF = 1, QE 0.4 at 850 nm; one lit raw frame of 1 ms; no light source.
inline Camera plain_camera(int width = 1, int height = 1, double focal_px = 200) {
  Camera camera;
  camera.name = "plain";
  camera.sensor = {width, height, 17.5e-6, 1};
  camera.lens.fx_px = camera.lens.fy_px = focal_px;
  camera.lens.cx_px = 0.5 * (width - 1), camera.lens.cy_px = 0.5 * (height - 1);
  camera.lens.f_number = 0.9;
  camera.pixel.quantum_efficiency = {{850e-9}, {0.4}};
  camera.pixel.contrast = {{60e6}, {1}};
  camera.mode = {"one", 10, {}};
  for (int k = 0; k < 4; ++k) camera.mode.sequence.push_back({true, 60e6, k * pi / 2, 1e-3});
  return camera;
}

/// A cone of 60 degrees half angle and 1 W/sr.
inline Illumination one_watt_per_steradian(const Vec3& position = {0, 0, 0}) {
  Illumination light;
  light.position = position;
  light.pattern.kind = Pattern::Kind::cone;
  light.pattern.half_angle_rad = pi / 3;
  light.power_w = 2 * pi * (1 - 0.5);
  light.waveform.kind = Waveform::Kind::sine;
  return light;
}

inline Camera lit_camera(int width = 1, int height = 1, double focal_px = 200) {
  Camera camera = plain_camera(width, height, focal_px);
  camera.illumination.push_back(one_watt_per_steradian());
  return camera;
}

inline Object object(const decltype(Object::shape)& shape, int material = 0) {
  Object out;
  out.shape = shape;
  out.material = material;
  return out;
}

/// A wall that faces the camera, reflectivity 1 unless said otherwise.
inline Scene wall(double z, double reflectivity = 1) {
  Scene scene;
  scene.materials.push_back({"white", Material::Brdf::lambert, reflectivity, 0, 1});
  scene.objects.push_back(object(Plane{{0, 0, z}, {0, 0, -1}}));
  return scene;
}

/// A matt wall at 1 m in even sunlight.
inline Scene sunny_wall(double reflectivity = 0.5) {
  Scene scene = wall(1, reflectivity);
  scene.ambient.spectrum = Ambient::Spectrum::sun_am15, scene.ambient.amount = 0.2;
  return scene;
}

/// Frame 0 without noise, on one thread.
inline Frame expected_frame(const Scene& scene, const Camera& camera) {
  SimulatorOptions options;
  options.noise = Noise::off;
  options.threads = 1;
  return Simulator(scene, camera, options).frame(0);
}
inline Truth truth(const Scene& scene, const Camera& camera) { return expected_frame(scene, camera).truth; }

/// Range [m] that the four phases of plain_camera() make of a pixel's electrons, in double precision and whatever the ADC does.
inline double range_of_taps(const Raw& raw, std::size_t pixel) {
  double real = 0, imaginary = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t at = k * raw.raw.size() / 4 + pixel;
    const double difference = static_cast<double>(raw.tap_a[at]) - static_cast<double>(raw.tap_b[at]);
    real += difference * std::cos(raw.reference_phase_rad[k]), imaginary -= difference * std::sin(raw.reference_phase_rad[k]);
  }
  const double turns = std::atan2(imaginary, real) / two_pi;
  return (turns - std::floor(turns)) * 299792458.0 / (2 * raw.modulation_frequency_hz[0]);
}

/// The nearest float's relative distance, times a few: how far a chain of so many roundings in single precision may be off.
constexpr double roundings(int count) { return count * 0x1p-24; }

}  // namespace tofray::test
