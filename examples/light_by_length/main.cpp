// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Light by the length of its path, as renderers of transient light write it, becomes raw frames and depth: a histogram for each pixel,
// [height][width][bin]. Here that renderer is a formula: a wall at 1.5 m, and a tenth of its light once more, spread over longer ways.
#include <tofray/tofray.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <vector>

namespace {

constexpr int width = 40, height = 30, bins = 1500;
constexpr double first_m = 2, bin_width_m = 2e-3;  // whole paths: from the light by all surfaces to the camera
constexpr double wall_m = 1.5, direct_e_per_s = 2e7, decay_m = 0.5;

tofray::Camera small_camera() {
  tofray::Camera camera;
  camera.sensor = {.width = width, .height = height, .pixel_pitch_m = 70e-6};
  camera.lens.fx_px = camera.lens.fy_px = 38;
  camera.lens.cx_px = 0.5 * (width - 1), camera.lens.cy_px = 0.5 * (height - 1);
  tofray::Illumination light;
  light.power_w = 0.2;  // histograms have all light already; this is what a scene would get
  light.waveform.kind = tofray::Waveform::Kind::sine;
  camera.illumination.push_back(light);
  camera.pixel.quantum_efficiency = {{light.illumination_wavelength_m}, {0.3}};  // one sample: a constant
  camera.pixel.contrast = {{0}, {0.8}};
  camera.adc.step_e_per_dn = 50;
  camera.mode.frame_rate_hz = 5;
  for (int k = 0; k < 4; ++k) camera.mode.sequence.push_back({true, 60e6, k * std::numbers::pi / 2, 1e-3});
  return camera;
}

// What the renderer hands over: electrons per second, [height][width][bin].
std::vector<float> histograms(const std::vector<float>& rays, bool indirect) {
  std::vector<float> out(static_cast<std::size_t>(width * height * bins));
  for (std::size_t pixel = 0; pixel < rays.size() / 2; ++pixel) {
    const double range = wall_m * std::hypot(rays[2 * pixel], rays[2 * pixel + 1], 1.0);
    float* const histogram = &out[pixel * bins];
    const double place = (2 * range - first_m) / bin_width_m - 0.5;  // between the middles of two bins
    const auto bin = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(bin);
    histogram[bin] += static_cast<float>((1 - share) * direct_e_per_s), histogram[bin + 1] += static_cast<float>(share * direct_e_per_s);
    for (std::size_t k = bin + 1; k < bins && indirect; ++k) {
      const double further = first_m + (static_cast<double>(k) + 0.5) * bin_width_m - 2 * range;
      histogram[k] += static_cast<float>(0.1 * direct_e_per_s * std::exp(-further / decay_m) * bin_width_m / decay_m);
    }
  }
  return out;
}

// tofray has the bins first, as a film has its pictures.
tofray::Transient light_of(const std::vector<float>& by_pixel) {
  tofray::Transient out{width, height, bins, first_m, bin_width_m, std::vector<float>(by_pixel.size()), {}};
  constexpr std::size_t pixels = width * height;
  for (std::size_t i = 0; i < by_pixel.size(); ++i) out.e_per_s[i % bins * pixels + i / bins] = by_pixel[i];
  return out;
}

}  // namespace

int main() try {
  const tofray::Camera camera = small_camera();
  const std::vector<float> rays = tofray::pixel_rays(camera);
  tofray::Simulator simulator({}, camera, {.noise = tofray::Noise::off});
  const auto mean_error_mm = [&](bool indirect) {
    const tofray::Frame frame = simulator.frame(0, light_of(histograms(rays, indirect)));
    double sum = 0;
    for (const float z : frame.depth.z_m) sum += 1e3 * (static_cast<double>(z) - wall_m);
    return sum / static_cast<double>(frame.depth.z_m.size());
  };
  std::printf("direct light: %.1f mm off\n", std::abs(mean_error_mm(false)));
  std::printf("all light: %.1f mm too far\n", mean_error_mm(true));
  return 0;
} catch (const tofray::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return static_cast<int>(error.kind());
}
