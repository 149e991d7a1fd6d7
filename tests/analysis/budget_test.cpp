// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A budget's numbers against the simulator's own frames with noise, cause by cause, and against closed forms.
#include "tofray/budget.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "support/pi.h"
#include "tofray/error.h"
#include "tofray/load.h"
#include "tofray/simulator.h"
#include "tofray/stages.h"

using namespace tofray;
using test::pi;

namespace {

const std::vector<std::string> cameras = {"adtf3175",        "azure-kinect-nfov-binned", "azure-kinect-nfov", "azure-kinect-wfov",
                                          "custom",          "flexx2",                   "imx556",            "kinect-v2",
                                          "o3d303-binned",   "o3d303",                   "opt8241",           "pico-flexx",
                                          "pico-monstar"};

AmbientCase sun_of(double lux) {
  AmbientCase out;
  if (lux == 0) return out;
  out.name = "in light";
  out.ambient.spectrum = Ambient::Spectrum::sun_am15, out.ambient.quantity = Ambient::Quantity::illuminance_lx, out.ambient.amount = lux;
  return out;
}

/// One number that shows as the spread of others.
struct Spread {
  double sigma = 0, mean = 0;
  int count = 0;
};
Spread spread_of(const std::vector<double>& values) {
  Spread out;
  out.count = static_cast<int>(values.size());
  for (const double one : values) out.mean += one / out.count;
  for (const double one : values) out.sigma += (one - out.mean) * (one - out.mean) / (out.count - 1);
  out.sigma = std::sqrt(out.sigma);
  return out;
}

/// Ranges of one pixel in many frames, on the axis before a wall.
std::vector<double> simulated_ranges(Camera camera, double z, double reflectivity, const AmbientCase& light, int frames, double angle_rad = 0) {
  camera.lens.cx_px = camera.lens.cy_px = 0, camera.sensor.width = camera.sensor.height = 1;
  camera.readout = {};
  camera.lens.scatter = {}, camera.interference = {}, camera.auto_exposure = {}, camera.decoding.filter = {};
  camera.decoding.temporal_frames = 1, camera.decoding.noise_threshold_m = 1e3, camera.decoding.amplitude_threshold_e = 0;
  camera.decoding.flying_check = false;
  camera.pixel.prnu = camera.pixel.dsnu_dn = camera.pixel.delay_s = camera.pixel.phase_offset_rad = 0;
  camera.pixel.crosstalk_left_right = camera.pixel.crosstalk_up_down = 0;
  Geometry wall;
  wall.width = wall.height = 1;
  wall.z_m = {static_cast<float>(z)}, wall.diffuse = {static_cast<float>(reflectivity)};
  wall.normal = {static_cast<float>(std::sin(angle_rad)), 0, static_cast<float>(-std::cos(angle_rad))};
  SimulatorOptions options;
  options.backend = Backend::cpu, options.threads = 1, options.seed = 11, options.truth = false;
  Scene scene;
  scene.ambient = light.ambient;
  Simulator simulator(scene, camera, options);
  Frame frame;
  std::vector<double> out;
  for (int i = 0; i < frames; ++i) {
    simulator.frame(static_cast<std::uint64_t>(i), wall, frame);
    out.push_back(static_cast<double>(frame.depth.range_m[0]));
  }
  return out;
}

BudgetRow row_of(const Camera& camera, double z, double reflectivity, const AmbientCase& light, double angle_rad = 0) {
  BudgetRequest request;
  request.distances_m = {z}, request.reflectivities = {reflectivity}, request.ambients = {light}, request.angle_rad = angle_rad;
  return budget(camera, request).at(0);
}

struct Condition {
  double z, reflectivity, lux;
};
/// Where phases are off by little: first order holds, and next to no cycle is wrong.
bool is_linear(const BudgetRow& row) {
  if (!std::isfinite(row.sigma_m) || row.wrong_cycle > 1e-6) return false;
  for (const BudgetFrequency& one : row.frequencies)
    if (one.sigma_m * 4 * pi * one.modulation_frequency_hz / 299792458.0 > 0.07) return false;
  return true;
}

class of_camera : public testing::TestWithParam<std::string> {};

// 2,000 frames: a standard error of 1/√4000 = 1.6 % of σ. First order is up to 0.5 % low at 0.07 rad.
TEST_P(of_camera, sigma_is_that_of_simulated_frames) {
  constexpr int frames = 2000;
  const Camera camera = load_camera(GetParam());
  ASSERT_EQ(camera.readout.binning, GetParam().find("303-binned") == std::string::npos ? 1 : 2);
  if (camera.readout.binning > 1) GTEST_SKIP() << "its numbers are those of binned pixels, which one pixel of the sensor is not";
  int compared = 0;
  for (const Condition& at : {Condition{0.5, 0.2, 0}, Condition{1, 0.8, 0}, Condition{1.5, 0.5, 5000}, Condition{0.8, 0.8, 50000},
                              Condition{2.3, 0.8, 0}, Condition{0.4, 0.1, 20000}}) {
    const BudgetRow row = row_of(camera, at.z, at.reflectivity, sun_of(at.lux));
    if (!is_linear(row)) continue;
    const Spread simulated = spread_of(simulated_ranges(camera, at.z, at.reflectivity, sun_of(at.lux), frames));
    EXPECT_NEAR(row.sigma_m / simulated.sigma, 1, 4 / std::sqrt(2.0 * frames) + 0.005) << at.z << " m, " << at.reflectivity << ", " << at.lux;
    ++compared;
  }
  EXPECT_GE(compared, 3);
}

INSTANTIATE_TEST_SUITE_P(all, of_camera, testing::ValuesIn(cameras), [](const auto& one) {
  std::string name = one.param;
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
});

TEST(speed, fifty_distances) {
  for (const std::string& name : cameras) {
    const Camera camera = load_camera(name);
    BudgetRequest request;
    request.reflectivities = {0.5};
    for (int i = 0; i < 50; ++i) request.distances_m.push_back(0.3 + 0.1 * i);
    const auto start = std::chrono::steady_clock::now();
    (void)budget(camera, request);
    const double ms = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto again = std::chrono::steady_clock::now();
    (void)budget_summary(camera, request);
    std::printf("%s %.1f ms, summary %.1f ms\n", name.c_str(), ms, 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - again).count());
  }
}

}  // namespace
