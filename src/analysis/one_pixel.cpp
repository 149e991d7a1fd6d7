// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/one_pixel.h"
#include "camera/readout/image_camera.h"

#include <cmath>

namespace tofray::analysis {

SimulatorOptions expected_values(Stage last) {
  SimulatorOptions out;
  out.noise = Noise::off;
  out.backend = Backend::cpu, out.threads = 1;
  out.last_stage = last;
  return out;
}

Geometry wall_at(int width, int height, double z, double reflectivity, double angle_rad) {
  Geometry out;
  out.width = width, out.height = height;
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  out.z_m.assign(pixels, static_cast<float>(z)), out.diffuse.assign(pixels, static_cast<float>(reflectivity));
  out.normal.assign(3 * pixels, 0.0F);
  for (std::size_t i = 0; i < pixels; ++i)
    out.normal[3 * i] = static_cast<float>(std::sin(angle_rad)), out.normal[3 * i + 2] = static_cast<float>(-std::cos(angle_rad));
  return out;
}

camera::ImageCamera pixel_alone(camera::ImageCamera camera, double u, double v) {
  camera.sensor.width = camera.sensor.height = 1;
  camera.lens.cx_px -= u, camera.lens.cy_px -= v;
  camera.lens.scatter = {}, camera.interference = {}, camera.auto_exposure = {};
  camera.decoding.temporal_frames = 1, camera.decoding.filter = {};
  Pixel& pixel = camera.pixel;
  pixel.crosstalk_left_right = pixel.crosstalk_up_down = pixel.blooming_share = pixel.blooming_limit_e = 0;
  for (FrequencyCalibration& one : camera.decoding.calibration.frequencies) one.pixel_phase_file.clear(), one.pixel_phase_rad.clear();
  pixel.prnu = pixel.dsnu_dn = pixel.delay_s = pixel.phase_offset_rad = 0;
  return camera;
}

}  // namespace tofray::analysis
