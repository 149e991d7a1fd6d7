// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Things that turn or follow keyframes, and a camera that does: what each raw frame sees is a still scene, posed by hand at its time.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/random_scene.h"
#include "support/same_frame.h"
#include "support/turning.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr int across = 96, high = 64;
constexpr std::size_t image_pixels = std::size_t{across} * high;

/// A grey raw frame and four lit ones, apart; a light aside.
Camera turning_camera(double focal_px = 80) {
  Camera out = lit_camera(across, high, focal_px);
  out.illumination[0].position = {-0.15, 0.05, 0};
  out.mode.sequence.insert(out.mode.sequence.begin(), {false, 0, 0, 5e-4});
  out.readout_time_s = 2e-3;
  return out;
}

Ambient sun_from(const Vec3& direction) { return {Ambient::Spectrum::sun_am15, Ambient::Quantity::level, 0.3, {}, {}, direction}; }

/// Before a wall that stands: a box that turns, a stone (a mesh) that tumbles along keyframes, a capsule that turns and flies, and a disk that
/// rolls; a sun.
Scene turning_scene() {
  Random random(11);
  Scene scene = wall(2, 0.5);
  scene.materials.push_back({"grey", Material::Brdf::lambert, 0.3});
  scene.ambient = sun_from({0.4, 0.3, 1});
  Object box = object(Box{{-0.55, -0.15, 1.1}, {-0.25, 0.15, 1.3}}, 1);
  box.rotation = {{0, 0, 1}, 0.2}, box.angular_velocity_rad_per_s = {10, 60, -20};
  scene.objects.push_back(box);
  Object stone = object(shared(single(test::stone(random, 2, 0.25, {0.05, 0, 0}))));
  stone.keyframes = {
      {0.19, {0.2, -0.1, 1.2}, {{1, 0, 0}, 0.3}}, {0.204, {0.35, 0, 1.3}, {{0, 1, 0.2}, 1.2}}, {0.215, {0.3, 0.1, 1.2}, {{0, 1, 0}, 1.5}}};
  scene.objects.push_back(stone);
  Object capsule = object(Capsule{{-0.3, 0.3, 1.5}, {0.2, 0.35, 1.4}, 0.06}, 1);
  capsule.angular_velocity_rad_per_s = {0, 5, 40}, capsule.velocity_m_per_s = {-2, 0.1, 0.5}, capsule.position = {0.4, 0, 0};
  scene.objects.push_back(capsule);
  Object disk = object(Disk{{0, -0.4, 1.6}, {0.1, 0.2, -1}, 0.2});
  disk.angular_velocity_rad_per_s = {30, 50, 0};
  scene.objects.push_back(disk);
  return scene;
}

/// A camera that sweeps by and turns while frame 2 is taken.
void sweep(Scene& scene) {
  scene.camera.keyframes = {{0.195, {{-0.1, 0, 0}, {0.2, 0, 1.5}, {0, -1, 0}}},
                            {0.206, {{0.1, 0.05, -0.1}, {-0.05, 0.1, 1.5}, {0.2, -1, 0}}},
                            {0.22, {{0.2, 0, 0}, {0, 0, 1.5}, {0, -1, 0}}}};
}

double middle_of_raw_frame(const Raw& raw, int k) {
  return raw.start_time_s[static_cast<std::size_t>(k)] + 0.5 * raw.integration_time_s[static_cast<std::size_t>(k)];
}

/// How many values of one raw frame differ by more than a share of them.
int differing(const std::vector<float>& a, const std::vector<float>& b, int raw_frame, double share) {
  int off = 0;
  for (std::size_t i = image_pixels * static_cast<std::size_t>(raw_frame); i < image_pixels * static_cast<std::size_t>(raw_frame + 1); ++i)
    off += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])) > share * std::abs(static_cast<double>(b[i])) + 1e-3;
  return off;
}

Frame noiseless(const Scene& scene, const Camera& camera, std::uint64_t frame, int samples = 1) {
  return Simulator(scene, camera, {.noise = Noise::off, .threads = 1, .exposure_samples = samples}).frame(frame);
}

/// Each raw frame of a scene in motion against that of a scene posed by hand; the truth likewise.
void expect_still_scenes(const Scene& scene, const Camera& camera, const char* what) {
  const Frame got = noiseless(scene, camera, 2);
  EXPECT_EQ(got.raw.phases, 5);
  for (int k = 0; k < 5; ++k) {
    const Raw expected = noiseless(test::standing(scene, middle_of_raw_frame(got.raw, k)), camera, 2).raw;
    // Edges: one place is rounded from a sum. Elsewhere the normals' last digits, at grazing light.
    EXPECT_LE(differing(got.raw.tap_a, expected.tap_a, k, 2e-4), 12) << what << ", raw frame " << k;
    EXPECT_LE(differing(got.raw.tap_b, expected.tap_b, k, 2e-4), 12) << what << ", raw frame " << k;
  }
  const Truth expected = noiseless(test::standing(scene, got.truth.time_s), camera, 2).truth;
  EXPECT_NEAR(got.truth.time_s, middle_of_raw_frame(got.raw, 2), 1e-15);
  int off = 0;
  for (std::size_t i = 0; i < image_pixels; ++i) {
    if (got.truth.object_id[i] != expected.object_id[i]) {
      ++off;
      continue;
    }
    if (got.truth.object_id[i] < 0) continue;
    ASSERT_NEAR(got.truth.z_m[i], expected.z_m[i], 1e-5F) << what << " at " << i;
    for (std::size_t k = 0; k < 3; ++k) off += std::abs(got.truth.normal[3 * i + k] - expected.normal[3 * i + k]) > 1e-4F;
  }
  EXPECT_LE(off, 12) << what;
  // It would be no test: from the second to the last raw frame much of the image changes.
  int moved = 0;
  for (std::size_t i = 0; i < image_pixels; ++i)
    moved += std::abs(got.raw.tap_a[image_pixels + i] + got.raw.tap_b[image_pixels + i] - got.raw.tap_a[4 * image_pixels + i] -
                      got.raw.tap_b[4 * image_pixels + i]) > 20;
  EXPECT_GT(moved, 700) << what;
}

/// A mesh that stands about the origin, before, behind and beside a camera there: a wall around it, and stones.
Object world_about_the_camera() {
  Random random(5);
  TriangleMesh all;
  const auto add = [&](const TriangleMesh& one) {
    const int first = static_cast<int>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), one.vertices.begin(), one.vertices.end());
    for (const auto& t : one.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  };
  ClosedMesh wall_around = icosphere(3);
  for (Vec3& v : wall_around.vertices) v = 3.0 * v;
  add(single(wall_around));
  for (int i = 0; i < 6; ++i) add(single(test::stone(random, 1, 0.2, {0.5 * i - 1.2, random.between(-0.3, 0.3), 1.4})));
  return object(shared(std::move(all)));
}

}  // namespace

TEST(turning, of_a_raw_frame_is_a_still_scene_posed_by_hand_shadows_and_sun_included) {
  expect_still_scenes(turning_scene(), turning_camera(), "things move");
}

TEST(moving_camera, sees_in_each_raw_frame_what_one_that_stands_there_sees) {
  Scene scene = turning_scene();
  sweep(scene);
  expect_still_scenes(scene, turning_camera(), "all moves");
  for (Object& one : scene.objects) one = test::standing(one, 0.2);
  expect_still_scenes(scene, turning_camera(), "the camera moves");
}

TEST(moving_camera, is_a_scene_that_is_shifted_the_other_way) {
  const Vec3 speed{3, -1, 2};
  Scene things = turning_scene();
  for (Object& one : things.objects) one = test::standing(one, 0.2);
  Scene passing = things;
  for (Object& one : things.objects) one.velocity_m_per_s = -1.0 * speed;
  for (const double time : {0.0, 1.0}) passing.camera.keyframes.push_back({time, {time * speed, time * speed + Vec3{0, 0, 1}, {0, -1, 0}}});
  const Camera camera = turning_camera();
  const Frame one = noiseless(things, camera, 2), other = noiseless(passing, camera, 2);
  for (int k = 0; k < 5; ++k) EXPECT_LE(differing(one.raw.tap_a, other.raw.tap_a, k, 2e-4), 12) << k;
  for (std::size_t i = 0; i < image_pixels; ++i) {
    if (one.truth.object_id[i] != other.truth.object_id[i] || one.truth.object_id[i] < 0) continue;
    ASSERT_LT(base::length(vector_at(one.truth.velocity_m_per_s, i) - vector_at(other.truth.velocity_m_per_s, i)), 1e-5) << i;
    for (std::size_t k = 0; k < 2; ++k)
      if (std::isfinite(one.truth.flow_px[2 * i + k])) {
        ASSERT_NEAR(one.truth.flow_px[2 * i + k], other.truth.flow_px[2 * i + k], 1e-3F + 1e-5F * std::abs(other.truth.flow_px[2 * i + k]))
            << i;
      }
  }
}

// The sun shines along the axis, so that its light does not turn in the one world and not in the other.
TEST(moving_camera, that_turns_is_a_scene_that_turns_the_other_way) {
  constexpr double rate = 40;
  Scene things, turning;
  things.materials.push_back({"grey", Material::Brdf::lambert, 0.5});
  things.ambient = sun_from({0, 1, 0});
  things.objects = {world_about_the_camera()};
  turning = things;
  things.objects[0].angular_velocity_rad_per_s = {0, -rate, 0};
  // Evenly mixed keyframes follow a circle up to (angle between two)²/8 of its radius.
  for (int i = 0; i <= 4000; ++i) {
    const double time = 0.195 + 5e-6 * i;
    turning.camera.keyframes.push_back({time, {{0, 0, 0}, {std::sin(rate * time), 0, std::cos(rate * time)}, {0, -1, 0}}});
  }
  const Camera camera = turning_camera();
  const Frame one = noiseless(things, camera, 2), other = noiseless(turning, camera, 2);
  for (int k = 0; k < 5; ++k) {
    EXPECT_LE(differing(one.raw.tap_a, other.raw.tap_a, k, 3e-4), 20) << k;
    EXPECT_LE(differing(one.raw.tap_b, other.raw.tap_b, k, 3e-4), 20) << k;
  }
  int same = 0;
  for (std::size_t i = 0; i < image_pixels; ++i) {
    if (one.truth.triangle_id[i] != other.truth.triangle_id[i]) continue;
    ASSERT_LT(base::length(vector_at(one.truth.velocity_m_per_s, i) - vector_at(other.truth.velocity_m_per_s, i)), 2e-2) << i;
    ++same;
  }
  EXPECT_GT(same, 6100);
}

// A pose that is asked for stands still, also where the scene's own camera would be just there at that time.
TEST(moving_camera, gives_way_to_a_pose_that_is_asked_for) {
  Scene scene = turning_scene();
  sweep(scene);
  Camera camera = turning_camera();
  camera.mode.sequence.erase(camera.mode.sequence.begin() + 1, camera.mode.sequence.end());
  const Scene still = test::standing(scene, 0.2 + 2.5e-4);
  Simulator simulator(scene, camera, {.noise = Noise::off, .threads = 1});
  const Frame own = simulator.frame(2);
  Scene posed = scene;
  posed.camera = still.camera;
  const Frame expected = Simulator(posed, camera, {.noise = Noise::off, .threads = 1}).frame(2);
  const FrameRequest requests[] = {{2, {}, {}}, {2, {}, still.camera.pose}, {2, {}, {}}};
  int i = 0;
  simulator.frames(requests, [&](const FrameArrays& got) {
    const Frame& wanted = i++ == 1 ? expected : own;
    const std::vector<float> velocity(got.gt_velocity_m_per_s, got.gt_velocity_m_per_s + 3 * image_pixels);
    EXPECT_EQ(std::memcmp(velocity.data(), wanted.truth.velocity_m_per_s.data(), velocity.size() * sizeof(float)), 0) << i;
  });
  EXPECT_EQ(i, 3);
  EXPECT_NE(own.truth.velocity_m_per_s, expected.truth.velocity_m_per_s);
}

// Several times within an exposure: the taps' mean over as many still scenes.
TEST(exposure_samples, give_the_mean_of_still_scenes_at_their_times) {
  Scene scene = turning_scene();
  Camera camera = turning_camera();
  for (const bool delayed : {false, true}) {
    if (delayed) camera.pixel.delay_s = 2e-10, sweep(scene);
    for (const int samples : delayed ? std::vector<int>{2, 3} : std::vector<int>{1, 2, 3, 16}) {
      const Frame got = noiseless(scene, camera, 2, samples);
      for (const int k : {0, 3}) {  // a grey one and a lit one
        std::vector<double> a(image_pixels), b(image_pixels), signal(image_pixels);
        const std::size_t first = image_pixels * static_cast<std::size_t>(k);
        for (int i = 0; i < samples; ++i) {
          const double time = got.raw.start_time_s[static_cast<std::size_t>(k)] +
                              (i + 0.5) / samples * got.raw.integration_time_s[static_cast<std::size_t>(k)];
          const Frame still = noiseless(test::standing(scene, time), camera, 2);
          for (std::size_t p = 0; p < image_pixels; ++p) {
            a[p] += static_cast<double>(still.raw.tap_a[first + p]) / samples,
                b[p] += static_cast<double>(still.raw.tap_b[first + p]) / samples;
            signal[p] += static_cast<double>(still.truth.signal_e[first + p]) / samples;
          }
        }
        int off = 0, blurred = 0;
        double worst = 0;
        const Raw once = noiseless(scene, camera, 2).raw;
        for (std::size_t p = 0; p < image_pixels; ++p) {
          const double error = std::abs(static_cast<double>(got.raw.tap_a[first + p]) - a[p]) +
                               std::abs(static_cast<double>(got.raw.tap_b[first + p]) - b[p]);
          const double relative = error / (a[p] + b[p]);
          off += relative > 1e-4;
          if (relative < 1e-4) worst = std::max(worst, relative);
          off += std::abs(static_cast<double>(got.truth.signal_e[first + p]) - signal[p]) > 1e-4 * signal[p] + 1e-3;
          blurred += std::abs(static_cast<double>(once.tap_a[first + p]) - a[p]) > 1e-2 * a[p] + 1;
        }
        EXPECT_LE(off, 2 + 8 * samples) << samples << " times, raw frame " << k;  // edges
        if (samples > 1) {
          EXPECT_GT(blurred, samples > 2 ? 20 : 5) << samples << " times, raw frame " << k;
        }
      }
    }
  }
}

// An edge that sweeps over pixels: each raw frame has its own share of what was before it and what is behind it.
TEST(exposure_samples, of_an_edge_give_each_raw_frame_its_own_share) {
  Scene scene = wall(2, 0.2);
  Object card = object(Rectangle{{-0.5013, 0, 1}, {1, 3}}, 0);
  card.velocity_m_per_s = {20, 0, 0};
  scene.objects.push_back(card);
  Camera camera = turning_camera();
  camera.illumination[0].position = {0, 0, 0};
  constexpr int samples = 16;
  const Frame got = noiseless(scene, camera, 0, samples);
  Scene without = scene, before = scene;
  without.objects.pop_back();
  before.objects[1] = object(Plane{{0, 0, 1}, {0, 0, -1}}, 0);
  const Raw far = noiseless(without, camera, 0).raw, near = noiseless(before, camera, 0).raw;
  int mixed = 0;
  for (int k = 0; k < 5; ++k) {
    for (std::size_t i = 0; i < image_pixels; ++i) {
      const double x = (static_cast<double>(i % across) - 47.5) / 80;
      int covered = 0;
      for (int s = 0; s < samples; ++s) {
        const double time = got.raw.start_time_s[static_cast<std::size_t>(k)] +
                            (s + 0.5) / samples * got.raw.integration_time_s[static_cast<std::size_t>(k)];
        covered += x < -0.0013 + 20 * time;
      }
      const std::size_t at = image_pixels * static_cast<std::size_t>(k) + i;
      const double share = static_cast<double>(covered) / samples;
      for (const auto tap : {&Raw::tap_a, &Raw::tap_b}) {
        const double expected = share * static_cast<double>((near.*tap)[at]) + (1 - share) * static_cast<double>((far.*tap)[at]);
        const double scale = static_cast<double>(near.tap_a[at] + near.tap_b[at]);
        ASSERT_NEAR(static_cast<double>((got.raw.*tap)[at]), expected, 1e-6 * scale) << "raw frame " << k << " at " << i << ", " << covered;
      }
      mixed += covered > 0 && covered < samples;
    }
  }
  EXPECT_GE(mixed, 4 * high);
}

TEST(exposure_samples, of_what_stands_still_change_no_byte) {
  Random random(3);
  Scene scene = random_scene(random, 12, false);
  scene.ambient = sun_from({0.2, 0.3, 1});
  Frame frames[2];
  for (const int which : {0, 1})
    frames[which] = Simulator(scene, turning_camera(), {.threads = 1, .exposure_samples = which == 0 ? 1 : 16}).frame(2);
  EXPECT_EQ(first_difference(frames[0], frames[1]), "");
  EXPECT_EQ(frames[0].truth.time_s, frames[1].truth.time_s);
}

// The truth is that of one of the times, the middle one; of an even number the first one behind the middle.
TEST(exposure_samples, leave_the_truth_sharp) {
  const Scene scene = turning_scene();
  for (const int samples : {1, 2, 3, 5}) {
    const Frame got = noiseless(scene, turning_camera(), 2, samples);
    const double begin = got.raw.start_time_s[2], exposure = got.raw.integration_time_s[2];
    const double expected = begin + (samples == 2 ? 0.75 : 0.5) * exposure;
    EXPECT_NEAR(got.truth.time_s, expected, 1e-12);
    const Frame still = noiseless(test::standing(scene, expected), turning_camera(), 2);
    int off = 0;
    for (std::size_t i = 0; i < image_pixels; ++i)
      off += std::abs(got.truth.power_w[i] - still.truth.power_w[i]) > 1e-4F * still.truth.power_w[i];
    EXPECT_LE(off, 12) << samples;
  }
}

TEST(exposure_samples, are_one_to_a_thousand_and_what_they_see_has_to_fit_into_memory) {
  const Scene scene = turning_scene();
  const auto refused = [&](const Scene& of, int samples) -> std::string {
    try {
      const Simulator simulator(of, turning_camera(), {.threads = 1, .exposure_samples = samples});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refused(scene, 1000), "");
  for (const int samples : {-1, 0, 1001})
    EXPECT_NE(refused(scene, samples).find("exposure_samples is out of range"), std::string::npos) << samples;
  Scene many = scene;
  while (many.objects.size() < 2000) many.objects.push_back(many.objects[1]);
  const std::string said = refused(many, 1000);
  EXPECT_NE(said.find("too many things are seen at too many times"), std::string::npos) << said;
  EXPECT_NE(said.find("lower exposure_samples"), std::string::npos) << said;
  for (std::size_t i = 0; i < many.objects.size(); ++i) many.objects[i] = test::standing(many.objects[i], 0);
  EXPECT_EQ(refused(many, 1000), "");
}

// Numbers as large as a scene may say: all that comes out is a number, or none.
TEST(turning, has_numbers_however_fast_and_far) {
  for (const int which : {0, 1, 2, 3}) {
    Scene scene = turning_scene();
    std::uint64_t frame = 0;
    if (which == 0) scene.objects[1].angular_velocity_rad_per_s = {1e4, 1e4, -1e4}, frame = 10'000'000;  // 1e6 s
    if (which == 1) scene.objects[1].angular_velocity_rad_per_s = {1e4, 1e4, -1e4}, frame = ~std::uint64_t{0};
    if (which == 2) {
      scene.objects[2].keyframes = {
          {-1e6, {1e5, 1e5, 1e5}, {}}, {3e-3, {0, 0, 1}, {}}, {3e-3 + 1e-9, {-1e5, 1e5, 1e5}, {{0, 1, 0}, 60}}, {1e6, {0, 0, 1}, {}}};
    }
    if (which == 3) {
      scene.camera.keyframes = {{-1e6, {{1e5, 1e5, 1e5}, {1e5, 1e5, -1e5}, {0, -1, 0}}},
                                {3e-3 + 1e-9, {{-1e5, 1e5, 1e5}, {-1e5, 1e5, -1e5}, {0, -1, 0}}},
                                {1e6, {{0, 0, 0}, {0, 0, -1}, {0, -1, 0}}}};
    }
    const Frame got = noiseless(scene, turning_camera(), frame, 2);
    for (const float tap : got.raw.tap_a) ASSERT_TRUE(std::isfinite(tap)) << which;
    for (std::size_t i = 0; i < image_pixels; ++i) {
      if (got.truth.object_id[i] < 0) continue;
      ASSERT_TRUE(std::isfinite(got.truth.velocity_m_per_s[3 * i])) << which;
      ASSERT_FALSE(std::isinf(got.truth.flow_px[2 * i])) << which;
    }
  }
}
