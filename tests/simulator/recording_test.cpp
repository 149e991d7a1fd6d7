// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Recordings as other programs and real cameras make them: an offset that decoding takes off, and units that were mistaken.
#include <gtest/gtest.h>

#include <cmath>

#include "support/bench.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double vacuum_speed = 299792458, signal_e = 20000, contrast = 0.7;

/// Taps of one pixel whose phase at modulation frequency f is φ(f): A, B = S/2·(1 ± C·cos(φ + τ)).
template <class Phase>
Raw recorded(const Camera& camera, const Phase& phi) {
  Raw raw;
  raw.width = raw.height = 1, raw.phases = static_cast<int>(camera.mode.sequence.size());
  for (const RawFrame& k : camera.mode.sequence) {
    raw.modulation_frequency_hz.push_back(k.modulation_frequency_hz), raw.reference_phase_rad.push_back(k.reference_phase_rad);
    raw.integration_time_s.push_back(k.integration_time_s), raw.lit.push_back(1);
    const double swing = contrast * std::cos(phi(k.modulation_frequency_hz) + k.reference_phase_rad);
    raw.tap_a.push_back(static_cast<float>(signal_e / 2 * (1 + swing)));
    raw.tap_b.push_back(static_cast<float>(signal_e / 2 * (1 - swing)));
  }
  return raw;
}

/// Phase of light that went there and back.
double phase_of(double range_m, double f, double n) { return 4 * std::acos(-1.0) * f * range_m * n / vacuum_speed; }

double range_of(const Raw& raw, Camera camera) {
  camera.decoding.flying_check = false, camera.decoding.noise_threshold_m = 10;
  return static_cast<double>(process(raw, camera, {.noise = Noise::off}).range_m.at(0));
}

std::string refusal(const Raw& raw, const Camera& camera) {
  try {
    (void)process(raw, camera);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

// φ = 4π·f·n·(r + d_off)/c + φ_off(f): decoding finds r. Without the calibration it finds r + d_off where there is no φ_off.
TEST(calibration, takes_a_constant_offset_of_range_and_phases_off) {
  for (const double n : {1.0, 1.33}) {
    Camera camera = bench_camera({80e6, 60e6}, 4);
    camera.refractive_index = n;
    const double range = 1.2345, offset = -0.217;
    const auto off = [&](double f) { return phase_of(range + offset, f, n); };
    EXPECT_NEAR(range_of(recorded(camera, off), camera), range + offset, 1e-5);
    camera.calibration.range_offset_m = offset;
    EXPECT_NEAR(range_of(recorded(camera, off), camera), range, 1e-5);
    // Each modulation frequency has its own offset; between samples there is no frequency.
    camera.calibration.phase_offset = {{60e6, 80e6}, {0.3, -0.4}};
    const auto both = [&](double f) { return phase_of(range + offset, f, n) + (f == 60e6 ? 0.3 : -0.4); };
    EXPECT_NEAR(range_of(recorded(camera, both), camera), range, 1e-5);
    // One sample is a constant.
    camera.calibration.phase_offset = {{60e6}, {0.5}};
    EXPECT_NEAR(range_of(recorded(camera, [&](double f) { return off(f) + 0.5; }), camera), range, 1e-5);
  }
}

// Raw frames that are simulated have what the camera is off by, and say nothing of it: its own decoding finds the wall, another one d_off behind.
TEST(calibration, is_in_raw_frames_that_are_simulated) {
  Scene scene;
  scene.materials.resize(1), scene.objects.resize(1);
  scene.materials[0].diffuse = 0.8;
  scene.objects[0].shape = Plane{{0, 0, 1.5}, {0, 0, -1}};
  Camera camera = bench_camera({80e6, 60e6}, 4), plain = camera;
  camera.calibration.range_offset_m = 0.35;
  const SimulatorOptions silent{.noise = Noise::off};
  const Frame frame = Simulator(scene, camera, silent).frame(0);
  EXPECT_NEAR(frame.depth.z_m.at(0), 1.5, 1e-4);
  EXPECT_EQ(frame.raw.reference_phase_rad, Simulator(scene, plain, silent).frame(0).raw.reference_phase_rad);
  EXPECT_NEAR(range_of(frame.raw, camera), 1.5, 1e-4);
  EXPECT_NEAR(range_of(frame.raw, plain), 1.85, 1e-4);
}

TEST(recording, of_degrees_megahertz_or_microseconds_is_told_at_its_array) {
  const Camera camera = bench_camera({80e6}, 4);
  const Raw good = recorded(camera, [](double) { return 1.0; });
  ASSERT_EQ(refusal(good, camera), "");
  const auto said = [&](const auto& spoil) {
    Raw raw = good;
    spoil(raw);
    return refusal(raw, camera);
  };
  EXPECT_EQ(said([](Raw& r) {
              r.reference_phase_rad = {0, 90, 180, 270};
            }),
            "error: array \"reference_phase_rad\" has 90 rad for raw frame 1\n"
            "  expected radians; are these degrees? np.deg2rad(reference_phase_rad) turns them into radians");
  EXPECT_EQ(said([](Raw& r) {
              r.reference_phase_rad = {0, 102.857, 205.714, 308.571};
            }),
            "error: array \"reference_phase_rad\" has 102.857 rad for raw frame 1\n"
            "  expected radians, -100 to 100 rad; are these degrees? np.deg2rad(reference_phase_rad) turns them into radians");
  EXPECT_EQ(said([](Raw& r) { r.modulation_frequency_hz.assign(4, 80.0); }),
            "error: array \"modulation_frequency_hz\" has 80 Hz for raw frame 0\n"
            "  expected hertz, 1000 or more; are these megahertz? Then multiply them by 1e6");
  EXPECT_EQ(said([](Raw& r) { r.modulation_frequency_hz.assign(4, 8e13); }),
            "error: array \"modulation_frequency_hz\" has 8e+13 Hz for raw frame 0\n  expected 1000 to 1e+10 Hz");
  EXPECT_EQ(said([](Raw& r) { r.integration_time_s.assign(4, 1200.0); }),
            "error: array \"integration_time_s\" has 1200 s for raw frame 0\n"
            "  expected 1e-09 to 1000 s; are these microseconds? Then multiply them by 1e-6");
  // Of raw frames without light nobody asks the phase; a turn and a half of radians is no table of degrees.
  EXPECT_EQ(said([](Raw& r) {
              r.reference_phase_rad = {0, 1.5707963267948966, 3.1415926535897931, 4.7123889803846897 + 6.2831853071795862};
            }),
            "");
}
