// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What another renderer sees becomes raw frames and depth. Here that renderer is a formula: ripples on water, seen from above.
// The camera is made here, too, so that nothing but libtofray is needed; load_camera("pico-flexx") would be a line of libtofray_files.
#include <tofray/tofray.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

namespace {

// Height of the water z(x, y) [m] along the optical axis.
double water(double x, double y) { return 1.2 + 0.03 * std::cos(20 * std::hypot(x, y)); }

// Where the ray (x, y, 1)·z meets the water: z = water(x z, y z), by a few steps of a fixed point.
double meet(double x, double y) {
  double z = 1.2;
  for (int i = 0; i < 60; ++i) z = 0.5 * (z + water(x * z, y * z));
  return z;
}

// 224 × 172 pixels, an LED beside the lens, two modulation frequencies with four reference phases each.
tofray::Camera small_camera() {
  tofray::Camera camera;
  camera.sensor = {.width = 224, .height = 172, .pixel_pitch_m = 12e-6};
  camera.lens.fx_px = camera.lens.fy_px = 212;
  camera.lens.cx_px = 111.5, camera.lens.cy_px = 85.5;
  tofray::Illumination led;
  led.position = {0.015, 0, 0};
  led.power_w = 0.2;
  camera.illumination.push_back(led);
  camera.pixel.quantum_efficiency = {{led.illumination_wavelength_m}, {0.3}};  // one sample: a constant
  camera.pixel.contrast = {{0}, {0.8}};
  camera.pixel.full_well_e = 100e3;
  camera.adc.step_e_per_dn = 50;
  camera.mode.frame_rate_hz = 5;
  for (const double frequency_hz : {80.32e6, 60.24e6}) {
    for (int k = 0; k < 4; ++k) camera.mode.sequence.push_back({true, frequency_hz, k * 1.5707963267948966, 1e-3});
  }
  return camera;
}

}  // namespace

int main() try {
  const tofray::Camera camera = small_camera();
  const std::vector<float> rays = tofray::pixel_rays(camera);

  tofray::Geometry seen;
  seen.width = camera.sensor.width, seen.height = camera.sensor.height;
  for (std::size_t i = 0; i < rays.size() / 2; ++i) {
    const double x = static_cast<double>(rays[2 * i]), y = static_cast<double>(rays[2 * i + 1]);
    const double z = std::isnan(x) ? 0 : meet(x, y);  // 0: nothing is seen
    const double step = 1e-5, slope_x = (water(x * z + step, y * z) - water(x * z - step, y * z)) / (2 * step);
    const double slope_y = (water(x * z, y * z + step) - water(x * z, y * z - step)) / (2 * step);
    const double length = std::sqrt(slope_x * slope_x + slope_y * slope_y + 1);
    seen.z_m.push_back(static_cast<float>(z));
    for (const double n : {slope_x, slope_y, -1.0}) seen.normal.push_back(static_cast<float>(n / length));
    seen.diffuse.push_back(0.6f);
  }

  // No object is needed: of the scene only its ambient light would count.
  tofray::Simulator simulator({}, camera, {.seed = 7});
  const tofray::Frame frame = simulator.frame(0, seen);

  std::vector<float> errors;
  for (std::size_t i = 0; i < frame.depth.range_m.size(); ++i) {
    if ((frame.depth.flags[i] & tofray::flags_invalid) == 0) errors.push_back(std::abs(frame.depth.range_m[i] - frame.truth.range_m[i]));
  }
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
  std::printf("%zu valid pixels, half of them within %.1f mm of the truth\n", errors.size(),
              1e3 * static_cast<double>(errors[errors.size() / 2]));
  return 0;
} catch (const tofray::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return static_cast<int>(error.kind());
}
