// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A budget's numbers against the simulator's own frames with noise, cause by cause, and against closed forms.
#include "tofray/budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/pi.h"
#include "tofray/error.h"
#include "tofray/load.h"
#include "tofray/simulator.h"
#include "tofray/stages.h"

using namespace tofray;
using test::pi;

namespace {

const std::vector<std::string> cameras = {"adtf3175",
                                          "azure-kinect-nfov-binned",
                                          "azure-kinect-nfov",
                                          "azure-kinect-wfov",
                                          "custom",
                                          "flexx2",
                                          "imx556",
                                          "kinect-v2",
                                          "o3d303-binned",
                                          "o3d303",
                                          "opt8241",
                                          "pico-flexx",
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
std::vector<double> simulated_ranges(Camera camera, double z, double reflectivity, const AmbientCase& light, int frames,
                                     double angle_rad = 0) {
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
    EXPECT_NEAR(row.sigma_m / simulated.sigma, 1, 4 / std::sqrt(2.0 * frames) + 0.005)
        << at.z << " m, " << at.reflectivity << ", " << at.lux;
    ++compared;
  }
  EXPECT_GE(compared, 3);
}

INSTANTIATE_TEST_SUITE_P(all, of_camera, testing::ValuesIn(cameras), [](const auto& one) {
  std::string name = one.param;
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
});

/// A camera in which every cause has a share that counts.
Camera with_all_causes() {
  Camera camera = load_camera("pico-flexx");
  Pixel& pixel = camera.pixel;
  pixel.read_noise_e = 60, pixel.reset_noise_e = 30, pixel.column_noise_e = 60, pixel.row_noise_e = 65;
  pixel.dark_current_e_per_s = 1e6, pixel.dark_current_doubling_k = 8;
  pixel.full_well_e = 1e6, pixel.suppression_threshold_e = 3000, pixel.suppression_budget_e = 2000, pixel.suppression_noise_factor = 1.6;
  pixel.tap_gain_mismatch = 0.03, pixel.tap_offset_mismatch_e = 40;
  camera.temperature.celsius = 33, camera.temperature.reference_celsius = 25;
  camera.adc = {12, 300, 2048, 1, 4094};
  return camera;
}

struct Removal {
  const char* name;
  double VarianceShares::*share;
  void (*remove)(Camera& camera, AmbientCase& light);
};

class cause : public testing::TestWithParam<Removal> {};

// Of 4,000 frames: the variance has a standard error of √(2/4000) = 2.2 %.
TEST_P(cause, takes_its_share_with_it) {
  constexpr int frames = 4000;
  Camera camera = with_all_causes();
  AmbientCase light = sun_of(800);
  const BudgetRow row = row_of(camera, 0.9, 0.6, light);
  const double share = row.share.*(GetParam().share);
  EXPECT_GT(share, 0.05);
  GetParam().remove(camera, light);
  const double left = spread_of(simulated_ranges(camera, 0.9, 0.6, light, frames)).sigma / row.sigma_m;
  EXPECT_NEAR(left * left / (1 - share), 1, 4 * std::sqrt(2.0 / frames)) << share;
}

INSTANTIATE_TEST_SUITE_P(each, cause,
                         testing::Values(Removal{"read", &VarianceShares::read,
                                                 [](Camera& c, AmbientCase&) { c.pixel.read_noise_e = c.pixel.reset_noise_e = 0; }},
                                         Removal{"adc", &VarianceShares::adc,
                                                 [](Camera& c, AmbientCase&) {
                                                   c.adc = {16, 18.75, 32768, 16, 65504};
                                                 }},
                                         Removal{"suppression", &VarianceShares::suppression,
                                                 [](Camera& c, AmbientCase&) { c.pixel.suppression_noise_factor = 0; }},
                                         Removal{"lines", &VarianceShares::lines,
                                                 [](Camera& c, AmbientCase&) { c.pixel.column_noise_e = c.pixel.row_noise_e = 0; }}),
                         [](const auto& one) { return std::string(one.param.name); });

// Ambient light and dark charge set off suppression, too: without it their shot noise goes alone.
TEST(share, of_ambient_light_and_of_dark_charge_go_with_them) {
  Camera camera = with_all_causes();
  camera.pixel.suppression_threshold_e = 0;
  const AmbientCase light = sun_of(1500);
  const BudgetRow row = row_of(camera, 0.9, 0.6, light);
  EXPECT_GT(row.share.ambient_shot, 0.1);
  EXPECT_GT(row.share.dark_shot, 0.1);
  const double in_the_dark = spread_of(simulated_ranges(camera, 0.9, 0.6, {}, 4000)).sigma / row.sigma_m;
  EXPECT_NEAR(in_the_dark * in_the_dark / (1 - row.share.ambient_shot), 1, 4 * std::sqrt(2.0 / 4000));
  camera.pixel.dark_current_e_per_s = 0;
  const double cold = spread_of(simulated_ranges(camera, 0.9, 0.6, light, 4000)).sigma / row.sigma_m;
  EXPECT_NEAR(cold * cold / (1 - row.share.dark_shot), 1, 4 * std::sqrt(2.0 / 4000));
}

TEST(share, of_the_cameras_own_light_is_what_it_has_alone) {
  Camera camera = with_all_causes();
  camera.pixel.suppression_threshold_e = 0;
  const BudgetRow row = row_of(camera, 0.9, 0.6, sun_of(800));
  EXPECT_GT(row.share.signal_shot, 0.1);
  Pixel& pixel = camera.pixel;
  pixel.read_noise_e = pixel.reset_noise_e = pixel.column_noise_e = pixel.row_noise_e = pixel.dark_current_e_per_s = 0;
  camera.adc = {16, 18.75, 32768, 16, 65504};
  const double alone = spread_of(simulated_ranges(camera, 0.9, 0.6, sun_of(0), 4000)).sigma / row.sigma_m;
  EXPECT_NEAR(alone * alone / row.share.signal_shot, 1, 4 * std::sqrt(2.0 / 4000) + 0.004);  // (the finer step: 0.4 %)
}

TEST(share, sums_to_one) {
  for (const std::string& name : cameras) {
    const VarianceShares s = row_of(load_camera(name), 1.2, 0.5, sun_of(5000)).share;
    EXPECT_NEAR(s.signal_shot + s.ambient_shot + s.dark_shot + s.read + s.adc + s.suppression + s.lines, 1, 1e-12) << name;
  }
}

// h of [theory: nonlinearity], suppression that is at its budget or not, taps that differ, gains: where the law is not
// [theory: phase-noise] alone.
TEST(sigma, is_that_of_simulated_frames_with_each_effect_of_the_pixel) {
  constexpr int frames = 4000;
  Camera bent = load_camera("pico-flexx");
  bent.pixel.nonlinearity = {{0, 20000, 40000, 60000, 80000}, {0, 19000, 35000, 47000, 55000}};
  bent.pixel.full_well_e = 80000;
  Camera held = bent;
  held.pixel.nonlinearity = {{0, 1000, 4000, 20000, 80000}, {0, 1000, 3500, 13000, 25000}};
  held.pixel.suppression_threshold_e = 500, held.pixel.suppression_budget_e = 1e6, held.pixel.suppression_noise_factor = 1;
  Camera spent = held;
  spent.pixel.suppression_threshold_e = 1000, spent.pixel.suppression_budget_e = 800;
  Camera twice = load_camera("pico-flexx");
  twice.pixel.cancels_reset_noise = true, twice.pixel.reset_noise_e = 300;
  Camera shifted = load_camera("flexx2");
  shifted.calibration.range_offset_m = 0.1, shifted.spread_spectrum.width = 0.01;
  int number = 0;
  for (const Camera& camera : {with_all_causes(), bent, held, spent, twice, shifted}) {
    const BudgetRow row = row_of(camera, 0.6, 0.8, sun_of(3000), 0.4);
    ASSERT_TRUE(is_linear(row)) << number;
    const double simulated = spread_of(simulated_ranges(camera, 0.6, 0.8, sun_of(3000), frames, 0.4)).sigma;
    EXPECT_NEAR(row.sigma_m / simulated, 1, 4 / std::sqrt(2.0 * frames) + 0.005) << number;
    ++number;
  }
}

/// A sine has no harmonics: nothing but light and noise depends on the distance. Its one light is at the pupil.
Camera plain_camera() {
  Camera camera = load_camera("pico-flexx");
  camera.illumination.resize(1), camera.illumination[0].position = {0, 0, 0}, camera.illumination[0].waveform = {};
  camera.illumination[0].waveform.kind = Waveform::Kind::sine, camera.illumination[0].waveform.harmonics = 1;
  camera.pixel.read_noise_e = camera.pixel.dark_current_e_per_s = camera.pixel.suppression_threshold_e = 0;
  camera.adc = {16, 2, 32768, 1, 65534}, camera.pixel.full_well_e = 1e30;
  return camera;
}

// [theory: noise-by-cause]: of fused ranges each frequency's share counts by its weight.
TEST(share, is_that_of_each_frequency_by_its_weight) {
  Camera camera = plain_camera();
  camera.pixel.read_noise_e = 60;
  for (RawFrame& one : camera.mode.sequence)
    if (one.modulation_frequency_hz == 60.24e6) one.integration_time_s /= 8;
  const BudgetRow row = row_of(camera, 1, 0.8, {});
  double shot = 0, weights = 0;
  for (const BudgetFrequency& one : row.frequencies) {
    const double weight = 1 / (one.sigma_m * one.sigma_m);
    shot += weight * one.signal_e / (one.signal_e + 2 * 60 * 60 + 2.0 * 2 / 12), weights += weight;
  }
  EXPECT_NEAR(row.share.signal_shot, shot / weights, 1e-5);
}

// [theory: phase-noise]: σ_d = c/(4πf)·√(2V/N)/(S·C), fused by [theory: fusion], with what the row itself says of S, B and C.
TEST(sigma, is_the_closed_form_of_its_own_electrons) {
  Camera camera = plain_camera();
  camera.pixel.read_noise_e = 30, camera.adc = {12, 20, 2048, 1, 4094};
  const BudgetRow row = row_of(camera, 1, 0.5, sun_of(10000));
  double weights = 0;
  for (const BudgetFrequency& one : row.frequencies) {
    const double variance = one.signal_e + one.ambient_e + one.dark_e + 2 * 30 * 30 + 20.0 * 20 / 12;
    const double sigma = 299792458.0 / (4 * pi * one.modulation_frequency_hz) * std::sqrt(2 * variance / 4) / (one.signal_e * one.contrast);
    EXPECT_NEAR(one.sigma_m / sigma, 1, 1e-5) << one.modulation_frequency_hz;
    weights += 1 / (sigma * sigma);
  }
  EXPECT_NEAR(row.sigma_m * std::sqrt(weights), 1, 1e-5);
  EXPECT_NEAR(row.ambient_irradiance_w_m2 * 0.5 / pi / (row.ambient_power_w / row.power_w), row.irradiance_w_m2 * 0.5 / pi,
              1e-5 * row.irradiance_w_m2);  // the same lens sees both of one matt surface
}

TEST(exponent, is_one_of_shot_noise_alone_and_two_of_read_noise_alone) {
  Camera camera = plain_camera();
  camera.pixel.read_noise_e = 0;
  const auto growth = [&](double z) { return std::log2(row_of(camera, 2 * z, 0.5, {}).sigma_m / row_of(camera, z, 0.5, {}).sigma_m); };
  EXPECT_NEAR(growth(0.5), 1, 1e-3);
  EXPECT_NEAR(row_of(camera, 1, 0.5, {}).exponent, 1, 1e-3);
  camera.pixel.read_noise_e = 3000;
  EXPECT_NEAR(growth(2), 2, 2e-2);
  EXPECT_NEAR(row_of(camera, 4, 0.5, {}).exponent, 2, 2e-3);
  camera.pixel.read_noise_e = 60;
  const double before = row_of(camera, 1 / 1.01, 0.5, {}).sigma_m, behind = row_of(camera, 1.01, 0.5, {}).sigma_m;
  EXPECT_NEAR(row_of(camera, 1, 0.5, {}).exponent, std::log(behind / before) / (2 * std::log(1.01)), 1e-3);
}

TEST(row, has_the_light_of_the_scene_that_a_frame_sees) {
  const Camera camera = load_camera("pico-flexx");
  BudgetRequest request;
  request.distances_m = {1.3}, request.reflectivities = {0.4}, request.ambients = {sun_of(30000)}, request.pixel = {{10, 20}};
  request.angle_rad = 0.3;
  const BudgetRow row = budget(camera, request).at(0);
  Geometry wall;
  wall.width = camera.sensor.width, wall.height = camera.sensor.height;
  const auto pixels = static_cast<std::size_t>(wall.width) * static_cast<std::size_t>(wall.height), at = 20UL * camera.sensor.width + 10;
  wall.z_m.assign(pixels, 1.3F), wall.diffuse.assign(pixels, 0.4F), wall.normal.assign(3 * pixels, 0.0F);
  for (std::size_t i = 0; i < pixels; ++i)
    wall.normal[3 * i] = static_cast<float>(std::sin(0.3)), wall.normal[3 * i + 2] = static_cast<float>(-std::cos(0.3));
  SimulatorOptions options;
  options.noise = Noise::off, options.backend = Backend::cpu;
  Scene scene;
  scene.ambient = sun_of(30000).ambient;
  Camera alone = camera;  // light of neighbours left out
  alone.lens.scatter = {}, alone.pixel.crosstalk_left_right = alone.pixel.crosstalk_up_down = 0;
  const Frame frame = Simulator(scene, alone, options).frame(0, wall);
  EXPECT_NEAR(row.range_m, static_cast<double>(frame.truth.range_m[at]), 1e-6);
  EXPECT_NEAR(row.power_w / static_cast<double>(frame.truth.power_w[at]), 1, 1e-5);
  EXPECT_NEAR(row.irradiance_w_m2 / static_cast<double>(frame.truth.irradiance_w_m2[at]), 1, 1e-5);
  EXPECT_NEAR(row.amplitude_e / static_cast<double>(frame.depth.amplitude_e[at]), 1, 1e-3);  // (patterns)
  EXPECT_NEAR(row.sigma_m / static_cast<double>(frame.depth.noise_m[at]), 1, 2e-2);
  EXPECT_NEAR(row.sigma_z_m / row.sigma_m, 1.3 / row.range_m, 1e-6);
}

TEST(row, has_the_drift_of_its_temperature) {
  Camera camera = load_camera("pico-flexx");
  camera.temperature.drift_m_per_kelvin = 2e-4, camera.temperature.warm_up_m = 0, camera.temperature.reference_celsius = 25;
  camera.pixel.dark_current_e_per_s = 1e5, camera.pixel.dark_current_doubling_k = 7;
  BudgetRequest request;
  request.distances_m = {1}, request.reflectivities = {0.5}, request.temperature_celsius = 60;
  const BudgetRow hot = budget(camera, request).at(0), cool = row_of(camera, 1, 0.5, {});
  EXPECT_NEAR(hot.bias_m - cool.bias_m, 35 * 2e-4, 2e-5);
  EXPECT_NEAR(hot.dark_e / (2 * 1e5 * hot.frequencies[0].integration_time_s), std::exp2(35.0 / 7), 1e-3);
}

TEST(row, says_when_the_wall_is_too_near_or_too_far) {
  Camera camera = load_camera("pico-flexx");
  const BudgetRow near = row_of(camera, 0.02, 0.9, {}), far = row_of(camera, 9, 0.9, {});
  EXPECT_TRUE(near.saturated && std::isnan(near.sigma_m) && std::isnan(near.wrong_cycle) && std::isnan(near.share.read));
  EXPECT_GT(std::max(near.tap_filling, near.adc_filling), 1);
  EXPECT_TRUE(far.beyond_ambiguity && !row_of(camera, 7, 0.9, {}).beyond_ambiguity);
  EXPECT_NEAR(far.bias_m, -7.464952, 1e-3);
  EXPECT_TRUE(far.low_signal);
  camera.illumination[0].power_w = 0;
  const BudgetRow dark = row_of(camera, 1, 0.5, {});
  EXPECT_TRUE(dark.no_return && std::isnan(dark.sigma_m));
}

// u = aim of [theory: brightness] where the law's limits allow it.
TEST(auto_exposure, leaves_what_its_law_aims_at) {
  Camera camera = load_camera("pico-flexx");
  camera.auto_exposure.aim = 0.6, camera.min_integration_time_s = 0, camera.auto_exposure.shortest_s = 1e-7;
  BudgetRequest request;
  request.distances_m = {0.1, 0.3, 3}, request.reflectivities = {0.8}, request.auto_exposure = true;
  const std::vector<BudgetRow> rows = budget(camera, request);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    EXPECT_NEAR(std::max(rows[i].tap_filling, rows[i].adc_filling), 0.6, 2e-3) << i;
    EXPECT_LT(rows[i].exposure, 1);
    EXPECT_FALSE(rows[i].saturated);
  }
  EXPECT_EQ(rows[2].exposure, 1);  // no longer than the mode's
}

TEST(summary, says_what_rows_say) {
  const Camera camera = load_camera("pico-flexx");
  BudgetRequest request;
  request.reflectivities = {0.2, 0.8}, request.ambients = {sun_of(0), sun_of(10000)};
  const BudgetSummary summary = budget_summary(camera, request);
  EXPECT_NEAR(summary.ambiguity_range_m, 7.464952, 1e-6);
  ASSERT_EQ(summary.reach.size(), 4U);
  bool saturates = false;
  for (std::size_t i = 0; i < 4; ++i) {
    const BudgetReach& one = summary.reach[i];
    const AmbientCase light = sun_of(i < 2 ? 0 : 10000);
    EXPECT_LE(row_of(camera, one.reach_m, one.reflectivity, light).sigma_m, summary.low_signal_m);
    for (const double z : {1.001, 1.01, 1.1, 1.5, 4.0})
      EXPECT_GT(row_of(camera, one.reach_m * z, one.reflectivity, light).sigma_m, summary.low_signal_m) << z;
    EXPECT_FALSE(row_of(camera, std::max(one.nearest_m, 0.01) * 1.001, one.reflectivity, light).saturated);
    if (one.nearest_m > 0) {
      EXPECT_TRUE(row_of(camera, one.nearest_m * 0.999, one.reflectivity, light).saturated);
    }
    saturates = saturates || one.nearest_m > 0;
  }
  EXPECT_TRUE(saturates);
  EXPECT_EQ(summary.noise_at_1_m_m, row_of(camera, 1, 1, {}).sigma_m);
  double power = 0, time = 0;
  for (const Illumination& one : camera.illumination) power += one.power_w;
  for (const RawFrame& one : camera.mode.sequence) time += one.lit ? one.integration_time_s : 0;
  EXPECT_NEAR(summary.energy_per_frame_j, power * time, 1e-15);
  EXPECT_NEAR(summary.mean_power_w, power * time * camera.mode.frame_rate_hz, 1e-12);
}

TEST(summary, has_figures_of_merit_of_the_pixel) {
  Camera camera = plain_camera();
  camera.pixel.tap_gain_mismatch = 0.02;
  camera.pixel.quantum_efficiency = {{850e-9}, {0.3}}, camera.pixel.contrast = {{0}, {0.5}}, camera.pixel.bandwidth_hz = 0;
  camera.illumination[0].illumination_wavelength_m = 850e-9, camera.illumination[0].waveform.bandwidth_hz = 0;
  camera.illumination[0].pattern = {}, camera.illumination[0].pattern.kind = Pattern::Kind::lambertian;
  const BudgetSummary summary = budget_summary(camera);
  const double per_joule = 0.3 * 850e-9 / (6.62607015e-34 * 299792458.0);
  EXPECT_NEAR(summary.correlated_e_per_j / (per_joule * 0.5 * 2 / pi), 1, 1e-4);
  EXPECT_NEAR(summary.uncorrelated_e_per_j / (per_joule * 0.01), 1, 1e-4);
  EXPECT_NEAR(*summary.rejection, (1 / pi) / 0.01, 1e-2);
  EXPECT_NEAR(summary.radiant_intensity_w_sr, camera.illumination[0].power_w / pi, 1e-4 * camera.illumination[0].power_w);
  camera.pixel.tap_gain_mismatch = 0;
  EXPECT_FALSE(budget_summary(camera).rejection.has_value());
}

TEST(solver, finds_the_number_with_which_sigma_is_what_is_asked) {
  const Camera camera = load_camera("pico-flexx");
  const BudgetNeed need{0.01, 2, 0.3, sun_of(10000)};
  const auto with_power = [&](double power) {
    Camera out = camera;
    for (Illumination& one : out.illumination) one.power_w = power;
    return out;
  };
  const BudgetSolution found = solve_budget(with_power, 1, 0, 1e3, need);
  ASSERT_TRUE(found.reached);
  EXPECT_NEAR(found.row.sigma_m / 0.01, 1, 1e-6);
  EXPECT_NEAR(row_of(with_power(found.value), 2, 0.3, sun_of(10000)).sigma_m / 0.01, 1, 1e-6);
  EXPECT_EQ(found.row.wrong_cycle, row_of(with_power(found.value), 2, 0.3, sun_of(10000)).wrong_cycle);
  const auto with_read_noise = [&](double noise) {
    Camera out = with_power(2 * found.value);
    out.pixel.read_noise_e = noise;
    return out;
  };
  EXPECT_NEAR(solve_budget(with_read_noise, 50, 0, 1e6, need).row.sigma_m / 0.01, 1, 1e-6);
}

TEST(solver, says_with_figures_why_nothing_will_do) {
  const Camera camera = load_camera("pico-flexx");
  const auto with_power = [&](double power) {
    Camera out = camera;
    for (Illumination& one : out.illumination) one.power_w = power;
    return out;
  };
  const auto answer = [&](double low, double high, double sigma) {
    return solve_budget(with_power, std::sqrt(low * high), low, high, {sigma, 1, 0.5, {}});
  };
  const BudgetSolution bright = answer(1e-3, 1e3, 1e-5), weak = answer(0.2, 0.3, 1), dim = answer(1e-3, 1e-2, 1e-3);
  EXPECT_FALSE(bright.reached || weak.reached || dim.reached);
  EXPECT_TRUE(bright.why.starts_with("range noise goes down to ")) << bright.why;
  EXPECT_NE(bright.why.find("; beyond, the pixel is saturated (tap "), std::string::npos) << bright.why;
  EXPECT_TRUE(weak.why.starts_with("range noise goes no higher than ")) << weak.why;
  EXPECT_EQ(dim.value, 1e-2);
  EXPECT_EQ(dim.row.sigma_m, row_of(with_power(1e-2), 1, 0.5, {}).sigma_m);
  EXPECT_EQ(answer(900, 1e3, 1e-3).why.find("the pixel is saturated with each of them (tap "), 0U);
}

TEST(budget, refuses_what_cannot_be) {
  const Camera camera = load_camera("pico-flexx");
  const auto refused = [&](const auto& change) {
    BudgetRequest request;
    change(request);
    EXPECT_THROW((void)budget(camera, request), Error);
  };
  refused([](BudgetRequest& r) { r.distances_m = {0}; });
  refused([](BudgetRequest& r) { r.reflectivities = {1.1}; });
  refused([](BudgetRequest& r) { r.angle_rad = pi / 2; });
  refused([](BudgetRequest& r) { r.angle_rad = 20; });  // degrees
  refused([](BudgetRequest& r) { r.pixel = {{224, 0}}; });
  refused([](BudgetRequest& r) { r.temperature_celsius = 1e6; });
  Camera unlit = camera;
  for (RawFrame& one : unlit.mode.sequence) one.lit = false, one.modulation_frequency_hz = one.reference_phase_rad = 0;
  EXPECT_THROW((void)budget(unlit), Error);
}

TEST(budget, goes_by_light_then_reflectivity_then_distance) {
  BudgetRequest request;
  request.distances_m = {2, 1}, request.reflectivities = {0.5, 0.1}, request.ambients = {sun_of(1000), sun_of(0)};
  const std::vector<BudgetRow> rows = budget(load_camera("pico-flexx"), request);
  ASSERT_EQ(rows.size(), 8U);
  EXPECT_EQ(rows[0].ambient, "in light");
  EXPECT_EQ(rows[4].ambient, "in the dark");
  EXPECT_EQ(rows[2].reflectivity, 0.1);
  EXPECT_EQ(rows[1].z_m, 1);
}

}  // namespace
