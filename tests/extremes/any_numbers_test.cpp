// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Whatever numbers scene and camera hold, the answer is an error that says which, or a frame without a number that means nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "backend/cpu/cpu.h"
#include "support/numbers.h"
#include "support/random_scene.h"
#include "support/sanitizers.h"
#include "support/whole_pixel.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
constexpr double extremes[] = {nan,   infinite, -infinite, 0.0,   -0.0,  1,    -1,   1e-310, -1e-310, 1e-300, 1e-30, 1e-12, 1e-6,
                               -1e-6, 1e-3,     0.999,     1e-38, 1e-45, 3e38, 1e39, 1e30,   -1e30,   1e300,  1e9,   1e6,   -1e6,
                               1e5,   -1e5,     1e4,       1e3,   100,   -100, 10,   -10,    0.3,     3.2,    1e12,  1e13,  1.7e308};

/// 8 × 4 pixels; all kinds of light, waveform, vignetting, filter and mode, one after the other.
Camera random_camera(Random& random) {
  Camera c = lit_camera(8, 4, 9);
  c.decoding.filter.kind = static_cast<ImageFilter::Kind>(random.below(5));
  c.illumination.resize(static_cast<std::size_t>(random.below(3)), c.illumination[0]);
  for (Illumination& light : c.illumination) {
    light.pattern.kind = static_cast<Pattern::Kind>(random.below(5));
    light.pattern.width_rad = light.pattern.height_rad = 1;
    light.pattern.columns = 3, light.pattern.rows = 2, light.pattern.half_range_x_rad = light.pattern.half_range_y_rad = 0.6;
    light.pattern.samples = {1, 2, 3, 4, 5, 6};
    // A table of harmonics takes milliseconds: the sine most of the time.
    light.waveform.kind = random.below(20) == 0 ? static_cast<Waveform::Kind>(random.below(6)) : Waveform::Kind::sine;
    light.waveform.sigma_s = 1e-9, light.waveform.fall_time_s = 1e-9, light.waveform.emission = {3, 2, 1, 0, 0, 0, 1, 2};
    light.waveform.harmonics = 2, light.waveform.correlation = {1, 0.7, 0, -0.7, -1, -0.7, 0, 0.7};
    light.position = random.point(0.1);
    light.area = {static_cast<Area::Kind>(random.below(3)), 0.02, 0.03, 0.01, 1 + random.below(4)};
  }
  c.lens.vignetting = static_cast<Lens::Vignetting>(random.below(3));
  c.lens.vignetting_table = {{0, 0.5, 1}, {1, 0.8, 0.3}};
  if (random.below(2) == 0) c.filter.table = {{830e-9, 850e-9, 870e-9}, {0, 0.9, 0}};
  c.pixel.prnu = 0.01, c.pixel.dsnu_dn = 1, c.pixel.delay_s = 1e-11, c.pixel.read_noise_e = 30, c.pixel.full_well_e = 1e5;
  if (random.below(2) == 0) turn_on_every_effect(c);
  if (random.below(2) == 0) c.pixel.suppression_threshold_e = 1e4, c.pixel.suppression_budget_e = 1e5;
  c.adc.step_e_per_dn = 20;
  if (random.below(4) == 0) c.mode.sequence.insert(c.mode.sequence.begin(), {false, 0, 0, 1e-4});
  if (random.below(8) == 0) {
    for (int k = 0; k < 3; ++k) c.mode.sequence.push_back({true, 45e6, k * 2 * pi / 3, 1e-3});
  }
  if (random.below(8) == 0) c.power_model = PowerModel::paper_literal;
  return c;
}

Scene any_scene(Random& random) {
  Scene scene = random_scene(random, random.below(5), random.below(3) == 0);
  if (random.below(2) == 0) {
    scene.ambient.spectrum = static_cast<Ambient::Spectrum>(random.below(4));
    scene.ambient.quantity = static_cast<Ambient::Quantity>(random.below(3));
    scene.ambient.amount = 0.5;
    scene.ambient.table_wavelength_m = {800e-9, 850e-9, 900e-9}, scene.ambient.table_irradiance_w_per_m3 = {1e9, 2e9, 1e9};
    if (random.below(2) == 0) scene.ambient.direction = Vec3{0.3, 0.8, 0.4};
  }
  if (random.below(20) == 0) {
    Object broken = object(shared(garbage(random, 1 + random.below(60))));
    broken.position = random.point(0.5) + Vec3{0, 0, 2};
    scene.objects.push_back(broken);
  }
  return scene;
}

/// Anything into a few of the numbers, or factors to many.
void disturb(Random& random, const Numbers& numbers) {
  if (random.below(4) == 0) {
    for (double* value : numbers.reals) *value *= random.below(3) == 0 ? random.scale(1e-2, 1e2) : 1;
    return;
  }
  for (int i = random.below(3); i >= 0; --i) {
    if (random.below(8) == 0) {
      const int values[] = {0, -1, 1, 2, 7, 255, 65535, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
      *numbers.integers[static_cast<std::size_t>(random.below(static_cast<int>(numbers.integers.size())))] = values[random.below(9)];
      continue;
    }
    double& value = *numbers.reals[static_cast<std::size_t>(random.below(static_cast<int>(numbers.reals.size())))];
    if (random.below(3) == 0) {
      value *= random.scale(1e-6, 1e6);
    } else {
      value = extremes[random.below(static_cast<int>(std::size(extremes)))];
    }
  }
}

template <class Vector>
void expect_finite(const Vector& values, const char* name) {
  const auto odd = std::find_if(values.begin(), values.end(), [](auto value) { return !std::isfinite(value); });
  EXPECT_TRUE(odd == values.end()) << name << " " << *odd;
}

/// A written NaN exactly where the pixel has no value; all else is finite.
void expect_flagged(const std::vector<float>& values, const std::vector<bool>& valid, std::size_t each, const char* name) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (valid[i / each]) {
      EXPECT_TRUE(std::isfinite(values[i])) << name << " " << values[i];
    } else {
      EXPECT_TRUE(std::isnan(values[i])) << name << " " << values[i];
    }
  }
}

void expect_sane(const Depth& depth) {
  std::vector<bool> valid, returned;
  for (const std::uint16_t flags : depth.flags) {
    valid.push_back((flags & flags_invalid) == 0), returned.push_back((flags & flag_no_return) == 0);
    EXPECT_LT(flags, 512);
  }
  expect_flagged(depth.z_m, valid, 1, "z"), expect_flagged(depth.range_m, valid, 1, "range"),
      expect_flagged(depth.points_m, valid, 3, "points");
  expect_flagged(depth.noise_m, returned, 1, "noise");
  expect_finite(depth.amplitude_e, "amplitude"), expect_finite(depth.ambient_e, "ambient");
}

void expect_sane(const Frame& frame) {
  expect_finite(frame.raw.tap_a, "tap_a"), expect_finite(frame.raw.tap_b, "tap_b"), expect_finite(frame.raw.start_time_s, "start");
  const Truth& t = frame.truth;
  std::vector<bool> found;
  for (const std::int32_t object : t.object_id) found.push_back(object >= 0);
  expect_flagged(t.range_m, found, 1, "gt range"), expect_flagged(t.z_m, found, 1, "gt z");
  expect_flagged(t.position_m, found, 3, "gt position"), expect_flagged(t.normal, found, 3, "gt normal");
  expect_flagged(t.reflectivity, found, 1, "gt reflectivity");
  expect_finite(t.irradiance_w_m2, "gt irradiance"), expect_finite(t.radiance_w_m2_sr, "gt radiance"), expect_finite(t.power_w, "gt power");
  expect_finite(t.signal_e, "gt signal");
  expect_sane(frame.depth);
}

class AnyNumbers : public testing::TestWithParam<int> {};

constexpr int sets = often(12500);  // times 8: 100,000 in all

}  // namespace

TEST_P(AnyNumbers, give_an_error_or_a_frame_of_finite_numbers) {
  int frames = 0, errors = 0;
  for (int i = 0; i < sets; ++i) {
    const int seed = GetParam() * sets + i;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(static_cast<std::uint64_t>(seed));
    Scene scene = any_scene(random);
    Camera camera = random_camera(random);
    Numbers numbers;
    numbers.all(scene, camera);
    disturb(random, numbers);
    const std::uint64_t index = random.below(8) == 0 ? ~0ull >> random.below(64) : 0;
    const SimulatorOptions options{
        .seed = 3, .noise = static_cast<Noise>(random.below(3)), .threads = 1, .isa = i % 8 == 0 ? Isa::scalar : Isa::best};
    try {
      const Frame frame = Simulator(scene, camera, options).frame(index);
      expect_sane(frame);
      if (i % 4 == 0) expect_sane(process(frame.raw, camera, options));
      ++frames;
    } catch (const Error& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.rfind("error: ", 0), 0u) << what;
      ++errors;
    }
  }
  EXPECT_GT(frames, sets / 8);
  EXPECT_GT(errors, sets / 4);
}

INSTANTIATE_TEST_SUITE_P(eighth, AnyNumbers, testing::Range(0, 8));

// All that makes light and charge, at the most that is allowed; all that divides, at the least.
TEST(largest_numbers, give_flags_or_finite_numbers) {
  Camera camera = lit_camera(8, 4, 9);
  camera.sensor.pixel_pitch_m = 1e-3, camera.lens.f_number = 0.3, camera.lens.vignetting = Lens::Vignetting::off;
  Illumination& light = camera.illumination[0];
  light.power_w = 1e4, light.pattern.half_angle_rad = 1e-3, light.illumination_wavelength_m = 2e-6, light.axis = {0, 0, 1};
  camera.illumination.resize(8, light);
  camera.pixel.quantum_efficiency.y = {1}, camera.pixel.dark_current_e_per_s = 1e12, camera.pixel.read_noise_e = 1e6;
  camera.pixel.prnu = 1, camera.pixel.dsnu_dn = 1e4, camera.pixel.delay_s = 1e-6, camera.pixel.full_well_e = 1e30;
  camera.pixel.column_noise_e = camera.pixel.row_noise_e = 1e6, camera.pixel.phase_offset_rad = 6.28;
  camera.pixel.tap_gain_mismatch = 1, camera.pixel.tap_offset_mismatch_e = 1e6;
  camera.interference = {100, -1e9, 1, -100};
  camera.pixel.reset_noise_e = 1e6, camera.pixel.blooming_share = 0.25, camera.spread_spectrum = {0.5, SpreadSpectrum::Kind::down};
  camera.filter = {850e-9, 10e-6, 1, {}};
  camera.mode.frame_rate_hz = 1e-4;
  Scene scene = wall(1);
  scene.materials[0] = {"mirror", Material::Brdf::phong, 0, 1, 1e4};
  scene.ambient = {Ambient::Spectrum::sun_am15, Ambient::Quantity::band_irradiance_w_per_m2, 1e5, {}, {}, Vec3{0, 0, 1}};
  for (const double from_wall : {1.0, 1e-3, 1e-6, 1e-9, 0.0}) {
    for (Illumination& one : camera.illumination) one.position = {0, 0, 1 - from_wall};
    for (const double hertz : {1e3, 1e10}) {
      for (RawFrame& k : camera.mode.sequence) k.modulation_frequency_hz = hertz, k.integration_time_s = 1e3;
      for (const double step : {1e-6, 1e9}) {
        camera.adc.step_e_per_dn = step;
        for (const Noise noise : {Noise::off, Noise::exact}) {
          for (const Curve& curve : {Curve{}, Curve{{0, 1e12}, {0, 1e12}}, Curve{{0, 1}, {0, 10}}, Curve{{0, 1, 2}, {0, 1e-12, 1e-11}}}) {
            camera.pixel.nonlinearity = curve;
            expect_sane(Simulator(scene, camera, {.noise = noise, .threads = 1}).frame(0));
          }
          camera.pixel.nonlinearity = {};
          for (const Isa isa : {Isa::scalar, Isa::best}) {
            expect_sane(Simulator(scene, camera, {.noise = noise, .threads = 1, .isa = isa}).frame(0));
          }
        }
      }
    }
  }
}

// Measured data may hold anything, too.
TEST(any_taps, give_flags_or_finite_numbers) {
  Random random(5);
  const Scene scene = wall(1);
  Camera camera = lit_camera(8, 4, 9);
  camera.pixel.full_well_e = 1e5;
  for (const Isa isa : backend::isas_here) {
    if (!backend::can_run(isa)) continue;
    const SimulatorOptions options{.threads = 1, .isa = isa};
    Raw raw = Simulator(scene, camera, options).frame(0).raw;
    raw.raw.clear();
    for (int round = 0; round < often(500); ++round) {
      Raw any = raw;
      for (int i = 0; i < 20; ++i) {
        Array<float>& tap = random.below(2) == 0 ? any.tap_a : any.tap_b;
        tap[static_cast<std::size_t>(random.below(static_cast<int>(tap.size())))] =
            static_cast<float>(extremes[random.below(static_cast<int>(std::size(extremes)))]);
      }
      expect_sane(process(any, camera, options));
    }
  }
}

// A frame's own pose comes past the checks of the scene. No frame is made before all poses are seen to be good.
TEST(any_pose, of_a_request_is_refused_where_it_is_none) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Simulator simulator(wall(1), lit_camera(8, 4, 9));
  for (const Pose& pose : {Pose{{nan, 0, 0}}, Pose{{0, 0, 1}, {0, 0, 1}}, Pose{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}}}) {
    const std::vector<FrameRequest> requests{{0, {}, {}}, {1, {}, pose}};
    int taken = 0;
    try {
      simulator.frames(requests, [&](const FrameArrays&) { ++taken; });
      ADD_FAILURE() << "a pose that is none passed";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_input);
      EXPECT_NE(std::string(error.what()).find("error: requests[1].pose"), std::string::npos) << error.what();
    }
    EXPECT_EQ(taken, 0);
    DeviceFrames frames;
    EXPECT_THROW(simulator.frames_on_device(requests, frames), Error);
    Frame into;
    EXPECT_THROW(simulator.frame(requests[1], into), Error);
  }
}
