// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What moves is seen by each raw frame at its own mid-exposure: depth against an explicit mix of the four phases, in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "support/statistics.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double f = 60.24e6, exposure = 600e-6, readout = 3.5e-3, grey = 200e-6;

/// The profile's five-phase mode with a sine, an undistorted lens and the light at the pupil.
Camera sine_camera() {
  CameraOptions options;
  options.mode = "MODE_5_35FPS_600";
  Camera camera = load_camera("pico-flexx", options);
  camera.lens.k1 = 0;
  camera.illumination[0].position = {0, 0, 0};
  camera.illumination[0].waveform.kind = Waveform::Kind::sine;
  camera.pixel.bandwidth_hz = 0;                                                  // ψ_1 = 0
  camera.decoding.flying_near_limit_m = camera.decoding.flying_far_limit_m = 10;  // a ball's rim may be steep
  return camera;
}

/// Middle of lit raw frame k of frame n.
double middle_of(int k, std::uint64_t n) { return static_cast<double>(n) / 35 + grey + readout + k * (exposure + readout) + exposure / 2; }

/// Where the light meets the surface at a time: range, and cosine of the angle to its normal.
struct Meeting {
  double range, cosine;
};
using Surface = std::function<Meeting(double x, double y, double time)>;

/// Range that four phases of S ∝ cosine/range² make of the moving surface.
double expected_range(const Surface& surface, double x, double y, std::uint64_t n) {
  double real = 0, imaginary = 0;
  for (int k = 0; k < 4; ++k) {
    const Meeting at = surface(x, y, middle_of(k, n));
    const double d = at.cosine / (at.range * at.range) * std::cos(4 * pi * f * at.range / c + k * pi / 2);
    real += d * std::cos(k * pi / 2), imaginary -= d * std::sin(k * pi / 2);
  }
  const double turns = std::atan2(imaginary, real) / two_pi;
  return (turns - std::floor(turns)) * c / (2 * f);
}

void compare(const Object& object, const Surface& surface, int least) {
  Scene scene;
  scene.materials.push_back({"", Material::Brdf::lambert, 0.5});
  scene.objects.push_back(object);
  Simulator simulator(scene, sine_camera(), {.noise = Noise::off});
  double worst = 0, largest_bias = 0;
  int compared = 0;
  for (const std::uint64_t n : {0u, 7u}) {
    const Frame frame = simulator.frame(n);
    EXPECT_NEAR(frame.truth.time_s, middle_of(1, n), 1e-12);  // the third of five raw frames
    for (int v = 6; v < 172; v += 16) {
      for (int u = 5; u < 224; u += 16) {
        const double x = (u - 111.5) / 212, y = (v - 85.5) / 212;
        const Meeting truth = surface(x, y, frame.truth.time_s);
        const std::size_t i = static_cast<std::size_t>(v * 224 + u);
        if (!(truth.cosine > 0.1)) continue;
        ASSERT_NEAR(static_cast<double>(frame.truth.range_m[i]), truth.range, 3e-6) << u << ", " << v;
        ASSERT_EQ(frame.depth.flags[i] & flags_invalid, 0) << u << ", " << v;
        const double expected = expected_range(surface, x, y, n);
        worst = std::max(worst, std::abs(static_cast<double>(frame.depth.range_m[i]) - expected));
        largest_bias = std::max(largest_bias, std::abs(expected - surface(x, y, 0.5 * (middle_of(1, n) + middle_of(2, n))).range));
        ++compared;
      }
    }
  }
  EXPECT_LT(worst, 5e-6);
  EXPECT_GT(largest_bias, 1e-3);  // the effect is there
  EXPECT_GE(compared, least);
}

}  // namespace

TEST(motion, of_a_plane_is_mixed_from_its_places) {
  for (const double speed : {-1.5, 1.0}) {
    compare(
        {"wall", Plane{{0, 0, 1.4}, {0, 0, -1}}, 0, {0, 0, 0}, {}, {0, 0, speed}},
        [&](double x, double y, double time) {
          const double length = std::sqrt(x * x + y * y + 1);
          return Meeting{(1.4 + speed * time) * length, 1 / length};
        },
        200);
  }
}

TEST(motion, of_a_sphere_is_mixed_from_its_places) {
  for (const double speed : {-1.5, 1.0}) {
    compare(
        {"ball", Sphere{{0, 0, 1.5}, 0.4}, 0, {0.05, 0, 0}, {}, {0, 0, speed}},
        [&](double x, double y, double time) {
          const double length = std::sqrt(x * x + y * y + 1), ux = x / length, uy = y / length, uz = 1 / length;
          const double cz = 1.5 + speed * time, along = ux * 0.05 + uz * cz;
          const double off = std::pow(0.05 - along * ux, 2) + std::pow(along * uy, 2) + std::pow(cz - along * uz, 2);
          if (off > 0.16) return Meeting{0, 0};
          const double deep = std::sqrt(0.16 - off);
          return Meeting{along - deep, deep / 0.4};
        },
        30);
  }
}

// A frame does not depend on those before it, nor on the object that makes it.
TEST(motion, of_a_frame_depends_on_its_index_alone) {
  const Scene scene = load_scene("flying-ball");
  const Camera profile = load_camera(scene);
  Simulator one(scene, profile), other(scene, profile);
  (void)one.frame(0), (void)one.frame(9);
  const Frame a = one.frame(4), b = other.frame(4);
  EXPECT_EQ(a.raw.raw, b.raw.raw);
  EXPECT_NE(a.raw.raw, other.frame(5).raw.raw);
  EXPECT_EQ(other.frame(4).raw.raw, b.raw.raw);
}

TEST(motion, raises_the_warning_of_inconsistent_phases) {
  Scene scene;
  scene.materials.push_back({"", Material::Brdf::lambert, 0.8});
  scene.objects.push_back({"wall", Plane{{0, 0, 0.7}, {0, 0, -1}}, 0, {0, 0, 0}, {}, {0, 0, -15}});
  for (const bool moving : {true, false}) {
    if (!moving) scene.objects[0].velocity_m_per_s = {0, 0, 0};
    const Frame frame = Simulator(scene, sine_camera()).frame(0);
    int warned = 0;
    for (const std::uint16_t flags : frame.depth.flags) warned += (flags & flag_inconsistent_phases) != 0;
    if (moving) {
      EXPECT_GT(warned, 5000);
    } else {
      EXPECT_LE(warned, 1);  // 5 sigma, 77 000 pairs of phases: 0.04 expected, two by chance 8e-4
    }
  }
}

// Each raw frame is that of a scene which stands still where the moving one is then: its surfaces, its shadows and those of a sun.
TEST(motion, of_a_raw_frame_is_a_still_scene_at_its_time_shadows_included) {
  for (const bool sun : {false, true}) {
    Scene moving;
    moving.materials.push_back({"", Material::Brdf::lambert, 0.5});
    moving.objects.push_back({"wall", Plane{{0, 0, 1.2}, {0, 0, -1}}, 0, {0, 0, 0}, {}, {0, 0, 0}});
    moving.objects.push_back({"ball", Sphere{{-0.15, 0.05, 0.8}, 0.07}, 0, {0, 0, 0}, {}, {4, 1, 0}});
    if (sun) moving.ambient = {Ambient::Spectrum::sun_am15, Ambient::Quantity::level, 0.3, {}, {}, Vec3{0.5, 0.1, 1}};
    Camera profile = sine_camera();
    profile.illumination[0].position = {-0.12, 0, 0};
    const SimulatorOptions options{.noise = Noise::off};
    const Raw raw = Simulator(moving, profile, options).frame(0).raw;
    const std::size_t pixels = 224 * 172;
    for (int k = 0; k < raw.phases; ++k) {
      const double middle = raw.start_time_s[static_cast<std::size_t>(k)] + 0.5 * raw.integration_time_s[static_cast<std::size_t>(k)];
      Scene still = moving;
      still.objects[1].velocity_m_per_s = {0, 0, 0};
      still.objects[1].position = {4 * middle, 1 * middle, 0};
      const Raw expected = Simulator(still, profile, options).frame(0).raw;
      int off = 0;
      for (std::size_t i = 0; i < pixels; ++i) {
        const std::size_t at = static_cast<std::size_t>(k) * pixels + i;
        off += std::abs(raw.tap_a[at] - expected.tap_a[at]) > 1e-4f * expected.tap_a[at] + 0.01f;
      }
      EXPECT_LE(off, 8) << "raw frame " << k << (sun ? ", sun" : "");  // edges: one place is rounded from a sum
    }
    // The test can fail: between the second and the last raw frame the shadow moves over many pixels.
    int moved = 0;
    for (std::size_t i = 0; i < pixels; ++i)
      moved += std::abs(raw.tap_a[pixels + i] + raw.tap_b[pixels + i] - raw.tap_a[4 * pixels + i] - raw.tap_b[4 * pixels + i]) > 50;
    EXPECT_GT(moved, 1000);
  }
}

// A plane and a ball that both move, before a wall that stands: each is where it is at that time, and shows its own number and material.
TEST(motion, of_a_plane_beside_that_of_a_ball_is_a_still_scene_at_its_time) {
  Scene moving;
  moving.materials = {{"", Material::Brdf::lambert, 0.5}, {"", Material::Brdf::lambert, 0.9}, {"", Material::Brdf::lambert, 0.2}};
  moving.objects.push_back({"wall", Plane{{0, 0, 1.5}, {0, 0, -1}}, 0, {0, 0, 0}, {}, {0, 0, 0}});
  moving.objects.push_back({"door", Plane{{0.1, 0, 1}, {-1, 0, -0.2}}, 1, {0, 0, 0}, {}, {2, 0, 0}});
  moving.objects.push_back({"ball", Sphere{{-0.15, 0.05, 0.8}, 0.1}, 2, {0, 0, 0}, {}, {-3, 1, 0}});
  const SimulatorOptions options{.noise = Noise::off};
  const Frame frame = Simulator(moving, sine_camera(), options).frame(1);
  Scene still = moving;
  for (Object& one : still.objects) {
    for (std::size_t k = 0; k < 3; ++k) one.position[k] = one.velocity_m_per_s[k] * frame.truth.time_s;
    one.velocity_m_per_s = {0, 0, 0};
  }
  const Truth expected = Simulator(still, sine_camera(), options).frame(1).truth;
  int off = 0, seen[3] = {};
  for (std::size_t i = 0; i < expected.z_m.size(); ++i) {
    const bool same = frame.truth.object_id[i] == expected.object_id[i];
    if (!same) {
      ++off;
      continue;
    }
    ++seen[expected.object_id[i]];
    ASSERT_NEAR(frame.truth.z_m[i], expected.z_m[i], 2e-6f) << i;
    ASSERT_EQ(frame.truth.reflectivity[i], expected.reflectivity[i]) << i;
    for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(frame.truth.normal[3 * i + k], expected.normal[3 * i + k], 1e-4f) << i;
  }
  EXPECT_LE(off, 8);  // edges: one place is rounded from a sum
  for (const int count : seen) EXPECT_GT(count, 1000);
}

// One raw frame is enough to see what moves, at its own time: a grey one, since each modulation frequency needs three.
TEST(motion, is_seen_by_a_sequence_of_a_single_raw_frame) {
  Scene scene;
  scene.materials.push_back({"", Material::Brdf::lambert, 0.5});
  scene.objects.push_back({"wall", Plane{{0, 0, 1}, {0, 0, -1}}, 0, {0, 0, 0}, {}, {0, 0, 10}});
  Camera profile = sine_camera();
  profile.mode.sequence = {{false, 0, 0, 600e-6}};
  scene.ambient = {Ambient::Spectrum::sun_am15, Ambient::Quantity::level, 0.1, {}, {}, {}};
  const Frame frame = Simulator(scene, profile, {.noise = Noise::off}).frame(2);
  const double expected = 1 + 10 * (2.0 / 35 + 300e-6);
  EXPECT_NEAR(static_cast<double>(frame.truth.z_m[224 * 86 + 112]), expected, 1e-5);
  EXPECT_GT(frame.raw.tap_a[224 * 86 + 112], 100);
}
