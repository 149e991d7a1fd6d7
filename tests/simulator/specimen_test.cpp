// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What decoding knows of the specimen whose raw frames it gets: all, nothing, or what a calibration says.  [theory: specimen-calibration]
#include <gtest/gtest.h>

#include <cmath>

#include "support/bench.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

using Kind = DecoderCalibration::Kind;

constexpr double light_in_vacuum = 299792458;

/// Taps whose measured phase at modulation frequency f is φ̂(f), in all of two pixels.
template <class Phase>
Raw measured(const Camera& camera, const Phase& phase) {
  Raw raw;
  raw.width = camera.sensor.width, raw.height = camera.sensor.height, raw.phases = static_cast<int>(camera.mode.sequence.size());
  for (const RawFrame& k : camera.mode.sequence) {
    raw.modulation_frequency_hz.push_back(k.modulation_frequency_hz), raw.reference_phase_rad.push_back(k.reference_phase_rad);
    raw.integration_time_s.push_back(k.integration_time_s), raw.lit.push_back(1);
    const double swing = 0.7 * std::cos(phase(k.modulation_frequency_hz) + k.reference_phase_rad);
    for (int i = 0; i < raw.width * raw.height; ++i)
      raw.tap_a.push_back(static_cast<float>(1e4 * (1 + swing))), raw.tap_b.push_back(static_cast<float>(1e4 * (1 - swing)));
  }
  return raw;
}

/// Two pixels that look along the axis, and whose harmonics and specimen differ from what is simulated here: what they are is in the phases.
Camera two_pixels() {
  Camera camera = bench_camera({80e6, 60e6});
  camera.sensor.width = 2, camera.lens.fx_px = camera.lens.fy_px = 1e5;
  camera.decoding.flying_check = false, camera.decoding.noise_threshold_m = 10;
  return camera;
}

std::vector<float> ranges(const Raw& raw, const Camera& camera) { return process(raw, camera, {.noise = Noise::off}).range_m; }

DecoderCalibration known_of_two_pixels() {
  DecoderCalibration out;
  out.kind = Kind::specimen, out.reference_celsius = 30;
  out.frequencies = {{60e6, 0.3, 2e-4, {0, 0.01}, {0.004, 0}, "sixty.npy", {0.05, -0.05}}, {80e6, -0.4, 2e-4, {}, {}, "", {}}};
  return out;
}

std::string said_of(const Camera& camera) {
  try {
    (void)Simulator(Scene(), camera);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

// φ̂ = φ + o + P + 4πf·drift·ΔT/c + Σ c cos mφ̂ + s sin mφ̂, made from φ̂ on: decoding finds φ, of each pixel its own.
TEST(specimen, is_taken_off_term_by_term) {
  Camera camera = two_pixels();
  camera.decoding.calibration = known_of_two_pixels(), camera.temperature.celsius = 55;
  for (const double range : {0.7, 1.9, 3.3, 6.1}) {
    for (int pixel = 0; pixel < 2; ++pixel) {
      const auto phase = [&](double f) {
        const bool sixty = f == 60e6;
        double goal = 4 * pi * f * (range + 2e-4 * 25) / light_in_vacuum + (sixty ? 0.3 : -0.4), at = goal;
        if (!sixty) return goal;
        goal += pixel == 0 ? 0.05 : -0.05;
        for (int turn = 0; turn < 60; ++turn) at = goal + 0.01 * std::cos(2 * at) + 0.004 * std::sin(at);
        return at;
      };
      // Nodes of the table are 2π/1024 apart: lines between them are off by 0.5·0.04·(π/1024)² rad, far less than a float's.
      EXPECT_NEAR(static_cast<double>(ranges(measured(camera, phase), camera)[static_cast<std::size_t>(pixel)]), range, 5e-6) << range;
    }
  }
}

// What is not known stays in the range.
TEST(specimen, of_whom_nothing_is_known_has_no_wiggling_no_delay_and_no_pixels_taken_off) {
  Camera camera = two_pixels();
  camera.illumination[0].waveform.harmonics = 4, camera.illumination[0].waveform.rise_time_s = 2e-9;
  camera.illumination[0].waveform.bandwidth_hz = 100e6, camera.pixel.phase_offset_rad = 0.05;
  camera.decoding.calibration.kind = Kind::none;
  const auto at_2_m = [](double f) { return 4 * pi * f * 2 / light_in_vacuum; };
  for (const float range : ranges(measured(camera, at_2_m), camera)) EXPECT_NEAR(static_cast<double>(range), 2, 2e-6);
  camera.decoding.calibration.kind = Kind::exact;
  EXPECT_GT(std::abs(static_cast<double>(ranges(measured(camera, at_2_m), camera)[0]) - 2), 0.01);
}

TEST(specimen, by_whom_a_frame_was_made_is_found_in_simulated_frames_alone_by_exact) {
  Scene scene;
  scene.materials.resize(1), scene.objects.resize(1);
  scene.materials[0].diffuse = 0.8;
  scene.objects[0].shape = Plane{{0, 0, 1.5}, {0, 0, -1}};
  Camera camera = two_pixels();
  camera.illumination[0].waveform.harmonics = 4, camera.pixel.phase_offset_rad = 0.05;
  const SimulatorOptions silent{.noise = Noise::off};
  const Frame exact = Simulator(scene, camera, silent).frame(0);
  camera.decoding.calibration.kind = Kind::none;
  const Frame none = Simulator(scene, camera, silent).frame(0);
  EXPECT_EQ(exact.raw.raw, none.raw.raw);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(exact.depth.z_m[i], 1.5, 1e-4);
    EXPECT_GT(std::abs(none.depth.z_m[i] - 1.5F), 1e-3F);
    EXPECT_NEAR(process(exact.raw, camera, silent).z_m[i], none.depth.z_m[i], 5e-4);  // of codes, half a step of which is as much
  }
}

TEST(specimen, that_does_not_fit_is_refused_by_its_member) {
  Camera camera = two_pixels();
  const auto with = [&](const auto& spoil) {
    camera.decoding.calibration = known_of_two_pixels();
    spoil(camera.decoding.calibration);
    return said_of(camera);
  };
  EXPECT_EQ(with([](auto& known) { known.frequencies[0].pixel_phase_file = "", known.frequencies[0].pixel_phase_rad = {}; }), "");
  EXPECT_EQ(with([](auto& known) { known.frequencies.pop_back(); }),
            "error: decoding.calibration.frequencies: the calibration has no 80 MHz\n  got 60 MHz; the mode \"bench\" needs it");
  EXPECT_TRUE(with([](auto& known) { known.frequencies[1].modulation_frequency_hz = 60e6; }).find("the calibration has 60 MHz twice") !=
              std::string::npos);
  EXPECT_TRUE(
      with([](auto& known) {
        known.frequencies[0].pixel_phase_rad.pop_back();
      }).find("the pixels' phases at 60 MHz are of another image\n  got 1 of them, the image that is read out has 2 x 1 = 2 pixels") !=
      std::string::npos);
  EXPECT_TRUE(with([](auto& known) { known.frequencies[0].pixel_phase_rad[1] = std::nan(""); }).find("a pixel's phase at 60 MHz is none") !=
              std::string::npos);
  EXPECT_TRUE(with([](auto& known) { known.frequencies[0].pixel_phase_rad = {}; }).find("the pixels' phases at 60 MHz are not here") !=
              std::string::npos);
  EXPECT_TRUE(with([](auto& known) { known.frequencies[0].pixel_phase_file = ""; }).find("has no name") != std::string::npos);
  EXPECT_TRUE(with([](auto& known) {
                known.frequencies[0].wiggling_sin_rad.push_back(0);
              }).find("the wiggling has not as many sines as cosines") != std::string::npos);
  EXPECT_TRUE(with([](auto& known) { known.frequencies[0].wiggling_cos_rad[1] = 0.5; }).find("so steep") != std::string::npos);
}

// Where a pixel is looked at alone, it is like the mean of all.
TEST(specimen, has_a_budget) {
  Camera camera = two_pixels();
  camera.decoding.calibration = known_of_two_pixels();
  BudgetRequest request;
  request.distances_m = {1};
  EXPECT_GT(budget(camera, request).at(0).sigma_m, 0);
}
