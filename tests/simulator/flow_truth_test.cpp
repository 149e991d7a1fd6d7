// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Ground truth of motion: velocity, and optical flow against the lens model in double and against what the next frame shows.
#include <gtest/gtest.h>

#include <bit>

#include "camera/lens/image_motion.h"
#include "camera/lens/lens.h"
#include "support/random.h"
#include "support/random_scene.h"
#include "support/turning.h"

using namespace tofray;
using namespace tofray::test;
using camera::Point2;

namespace {

Truth truth_of(const Scene& scene, const Camera& camera, std::uint64_t frame = 0) {
  return Simulator(scene, camera, {.noise = Noise::off, .last_stage = Stage::trace}).frame(frame).truth;
}

Vec3 in_camera(const Pose& pose, const Vec3& direction) { return scene::camera_frame(pose).rotation * direction; }

Point2 pixel_of(const Lens& lens, const Vec3& p) { return camera::project(lens, {p[0] / p[2], p[1] / p[2]}); }
bool is_seen(const Lens& lens, const Vec3& p) {
  return p[2] > 0 && (p[0] * p[0] + p[1] * p[1]) / (p[2] * p[2]) < camera::growing_radius_squared(lens);
}
Point2 flow_at(const Truth& truth, std::size_t i) {
  return {static_cast<double>(truth.flow_px[2 * i]), static_cast<double>(truth.flow_px[2 * i + 1])};
}
bool is_none(const Point2& flow) {
  EXPECT_EQ(std::isnan(flow.x), std::isnan(flow.y));
  return std::isnan(flow.x);
}

/// OpenCV's order: k1, k2, p1, p2, k3, k4, k5, k6.
Lens distorted(const std::array<double, 8>& distortion) {
  Lens out;
  auto& [k1, k2, p1, p2, k3, k4, k5, k6] = distortion;
  out.k1 = k1, out.k2 = k2, out.p1 = p1, out.p2 = p2, out.k3 = k3, out.k4 = k4, out.k5 = k5, out.k6 = k6;
  return out;
}
Lens fisheye(double k1, double k2, double k3, double k4) {
  Lens out;
  out.distortion = Lens::Distortion::fisheye;
  out.k1 = k1, out.k2 = k2, out.k3 = k3, out.k4 = k4;
  return out;
}
/// 120 × 90 pixels, 10 frames a second.
Camera camera_with(const Lens& distortion, double focal_px = 100) {
  Camera out = lit_camera(120, 90, focal_px);
  const Lens pinhole = out.lens;
  out.lens = distortion;
  out.lens.fx_px = pinhole.fx_px, out.lens.fy_px = 1.1 * focal_px, out.lens.cx_px = pinhole.cx_px + 3.25, out.lens.cy_px = pinhole.cy_px;
  return out;
}
constexpr double period = 0.1;

/// A wall, and balls before it.
Scene moving_scene(Random& random) {
  Scene scene = wall(4, 0.5);
  scene.objects[0].velocity_m_per_s = random.point(2);
  for (int i = 0; i < 12; ++i) {
    Object ball = object(Sphere{random.point(0.8) + Vec3{0, 0, 1.8}, 0.25});
    if (i % 3 != 0) ball.velocity_m_per_s = random.point(i % 3 == 1 ? 0.5 : 12);
    scene.objects.push_back(ball);
  }
  scene.camera.pose = random_pose(random);
  return scene;
}

}  // namespace

TEST(velocity, is_the_object_s_in_the_camera_s_frame) {
  int moving = 0, still = 0, none = 0;
  for (int trial = 0; trial < 8; ++trial) {
    Random random(static_cast<std::uint64_t>(trial) + 1);
    Scene scene = random_scene(random, 20, true);
    scene.objects.erase(scene.objects.begin());  // the wall
    scene.camera.pose = random_pose(random);
    scene.camera.pose.up = random.direction();
    const Truth seen = truth_of(scene, camera_with(Lens{}));
    for (std::size_t i = 0; i < seen.object_id.size(); ++i) {
      const Vec3 got = vector_at(seen.velocity_m_per_s, i);
      if (seen.object_id[i] < 0) {
        for (const double v : got) ASSERT_TRUE(std::isnan(v)) << i;
        ++none;
        continue;
      }
      const Vec3 world = scene.objects[static_cast<std::size_t>(seen.object_id[i])].velocity_m_per_s;
      const Vec3 expected = in_camera(scene.camera.pose, world);
      ASSERT_LE(base::length(got - expected), 3e-7 * base::length(world)) << i;
      if (base::length(world) > 0) {
        ++moving;
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) ASSERT_FALSE(std::signbit(seen.velocity_m_per_s[3 * i + k])) << "a zero of its own kind at " << i;
      ++still;
    }
  }
  EXPECT_GT(moving, 2000);
  EXPECT_GT(still, 2000);
  EXPECT_GT(none, 2000);
}

TEST(velocity, goes_the_way_the_axes_say) {
  Scene scene = wall(2, 0.5);
  scene.camera.pose = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};  // looks along x; its right is −y, its down −z
  scene.objects = {object(Plane{{2, 0, 0}, {-1, 0, 0}})};
  scene.objects[0].velocity_m_per_s = {0.5, 0.25, -2};
  const Truth seen = truth_of(scene, camera_with(Lens{}));
  EXPECT_EQ(vector_at(seen.velocity_m_per_s, 77), (Vec3{-0.25, 2, 0.5}));
}

// The lens model in double, from the same point: the difference of two numbers there, which the kernels do not take.
TEST(flow, is_that_of_the_lens_model_in_double) {
  const Lens lenses[] = {{},
                         distorted({-0.3}),
                         distorted({0.12, -0.08, 0, 0, 0.02}),
                         distorted({0, 0, 2e-3, -3e-3}),
                         distorted({-0.28, 0.11, 1e-3, 2e-3, -0.015}),
                         distorted({-0.5, 0.3, -4e-3, 1e-3, -0.05}),
                         distorted({0.6, 0.1, 1e-3, -1e-3, 0.02, 0.95, 0.3, 0.05}),
                         distorted({0, 0, 0, 0, 0, 0.4}),
                         fisheye(0, 0, 0, 0),
                         fisheye(-0.02, 0.01, -0.004, 0.001),
                         fisheye(0.15, -0.03, 0.002, 0)};
  int moving = 0, lost = 0, large = 0, within = 0;
  for (const Lens& distortion : lenses) {
    for (int trial = 0; trial < 6; ++trial) {
      Random random(static_cast<std::uint64_t>(trial) + 300);
      const Scene scene = moving_scene(random);
      const Camera camera = camera_with(distortion, trial % 2 == 0 ? 100 : 700);
      const Truth seen = truth_of(scene, camera, static_cast<std::uint64_t>(trial % 3));
      for (std::size_t i = 0; i < seen.object_id.size(); i += 3) {
        const Point2 got = flow_at(seen, i);
        if (seen.object_id[i] < 0) {
          ASSERT_TRUE(is_none(got)) << i;
          continue;
        }
        const Vec3 p = vector_at(seen.position_m, i), world = scene.objects[static_cast<std::size_t>(seen.object_id[i])].velocity_m_per_s;
        const Vec3 m = period * in_camera(scene.camera.pose, world), to = p + m;
        const double square = (to[0] * to[0] + to[1] * to[1]) / (to[2] * to[2]), limit = camera::growing_radius_squared(camera.lens);
        if (std::abs(to[2]) < 1e-3 || std::abs(square / limit - 1) < 1e-4) continue;
        ASSERT_EQ(is_none(got), !is_seen(camera.lens, to)) << "pixel " << i << " r2 " << square << " z " << to[2];
        if (is_none(got)) {
          ++lost;
          continue;
        }
        const Point2 one = pixel_of(camera.lens, p), other = pixel_of(camera.lens, to);
        const Point2 expected{other.x - one.x, other.y - one.y};
        // The bound of camera/image_motion.h; where no pixel looks this lens may be as steep as it likes.
        const bool inside = other.x > 0 && other.x < 119 && other.y > 0 && other.y < 89;
        const double scale = camera.lens.fy_px * base::length(m) / to[2] * (1 + p[2] / to[2]);
        const double bound = scale * (inside ? 3e-7 : 1e-6 * (1 + std::sqrt(square)) * (1 + 20 * (square + std::pow(square, 3))));
        ASSERT_NEAR(got.x, expected.x, bound) << "pixel " << i << " lens " << distortion.k1;
        ASSERT_NEAR(got.y, expected.y, bound) << "pixel " << i << " lens " << distortion.k1;
        within += inside && base::length(m) > 0;
        moving += base::length(m) > 0;
        large += std::abs(expected.x) + std::abs(expected.y) > 20;
      }
    }
  }
  EXPECT_GT(moving, 65000);
  EXPECT_GT(within, 50000);
  EXPECT_GT(large, 16000);
  EXPECT_GT(lost, 300);
}

// Half a frame's motion of a micrometre: the numbers are as good as those of large flows.
TEST(flow, of_what_hardly_moves_has_as_many_digits) {
  Scene scene = wall(2, 0.5);
  scene.objects[0].velocity_m_per_s = {1e-6, -2e-6, 0};
  const Camera camera = camera_with(distorted({-0.2}));
  const Truth seen = truth_of(scene, camera);
  for (std::size_t i = 0; i < seen.object_id.size(); ++i) {
    const Vec3 p = vector_at(seen.position_m, i);
    const double x = p[0] / p[2], y = p[1] / p[2], r2 = x * x + y * y, a = 1e-7 / p[2], b = -2e-7 / p[2];
    const double radial = 1 - 0.2 * r2, slope = -0.4 * (x * a + y * b);
    ASSERT_NEAR(flow_at(seen, i).x, 100 * (a * radial + x * slope), 2e-11) << i;
    ASSERT_NEAR(flow_at(seen, i).y, 110 * (b * radial + y * slope), 2e-11) << i;
  }
}

TEST(flow, is_zero_for_what_stands_still) {
  Random random(5);
  Scene scene = random_scene(random, 20, false);
  scene.camera.pose = random_pose(random);
  for (const bool something_moves : {false, true}) {
    scene.objects.back().velocity_m_per_s = {0, 0, something_moves ? 1.0 : 0.0};
    const Truth seen = truth_of(scene, camera_with(distorted({-0.5, 0, 1e-3}), 60));  // corners without an inverse
    int still = 0, none = 0;
    for (std::size_t i = 0; i < seen.object_id.size(); ++i) {
      const std::int32_t id = seen.object_id[i];
      const auto bits = [&](std::size_t k) { return std::bit_cast<std::uint32_t>(seen.flow_px[2 * i + k]); };
      if (id < 0) {
        ASSERT_EQ(bits(0), 0x7fc00000U);
        ASSERT_EQ(bits(1), 0x7fc00000U);
        ++none;
      } else if (base::length(scene.objects[static_cast<std::size_t>(id)].velocity_m_per_s) == 0) {
        ASSERT_EQ(bits(0), 0U) << i;
        ASSERT_EQ(bits(1), 0U) << i;
        ++still;
      }
    }
    EXPECT_GT(still, 3000);
    EXPECT_GT(none, 10);
  }
}

// What a pixel sees of a ball is, one frame later, seen by the pixel where the flow ends.
TEST(flow, ends_where_the_next_frame_has_the_point) {
  Scene scene = wall(4, 0.5);
  Object ball = object(Sphere{{-0.35, 0.1, 1.6}, 0.12});
  ball.velocity_m_per_s = {4, -1.5, -2};
  scene.objects.push_back(ball);
  const Camera camera = camera_with(distorted({-0.25, 0.05, 1e-3, -2e-3}), 110);
  const Truth now = truth_of(scene, camera, 0), next = truth_of(scene, camera, 1);
  EXPECT_NEAR(next.time_s - now.time_s, period, 1e-12);
  int followed = 0;
  for (std::size_t i = 0; i < now.object_id.size(); ++i) {
    if (now.object_id[i] != 1) continue;
    const Point2 flow = flow_at(now, i);
    ASSERT_GT(std::abs(flow.x), 10) << "it would be no test";
    const long u = std::lround(static_cast<double>(i % 120) + flow.x), v = std::lround(static_cast<double>(i / 120) + flow.y);
    ASSERT_TRUE(u >= 0 && u < 120 && v >= 0 && v < 90);
    const auto there = static_cast<std::size_t>(v * 120 + u);
    const Vec3 p = vector_at(now.position_m, i), q = vector_at(next.position_m, there), n = vector_at(now.normal, i);
    const double cosine = -base::dot(n, p) / base::length(p);
    if (cosine < 0.5) continue;  // at its rim the ball ends within a pixel
    ASSERT_EQ(next.object_id[there], 1);
    const Vec3 expected = p + period * in_camera(scene.camera.pose, ball.velocity_m_per_s);
    ASSERT_LT(base::length(q - expected), 0.8 * q[2] / 100 / 0.4) << i;
    ++followed;
  }
  EXPECT_GT(followed, 60);
}

TEST(flow, of_what_comes_nearer_ends_behind_the_camera) {
  for (const auto& [speed, none] : {std::pair(-19.99, false), std::pair(-20.01, true), std::pair(-1e4, true), std::pair(1e4, false)}) {
    Scene scene = wall(2, 0.5);
    scene.objects[0].velocity_m_per_s = {0, 0, speed};
    const Camera camera = lit_camera(3, 3, 100);
    // at the time of the truth, that is, some of the way has been gone
    scene.objects[0].position = {0, 0, -speed * truth_of(scene, camera).time_s};
    const Truth seen = truth_of(scene, camera);
    for (std::size_t i = 0; i < 9; ++i) {
      ASSERT_EQ(seen.object_id[i], 0);
      ASSERT_EQ(is_none(flow_at(seen, i)), none) << speed << " at " << i;
      ASSERT_EQ(seen.velocity_m_per_s[3 * i + 2], static_cast<float>(speed));
    }
    if (none) continue;
    // outward from the middle where it comes nearer, inward where it goes away
    const double grown = 2 / (2 + 0.1 * speed) - 1;
    EXPECT_NEAR(flow_at(seen, 8).x, grown, 1e-3 * std::abs(grown));
    EXPECT_NEAR(flow_at(seen, 0).y, -grown, 1e-3 * std::abs(grown));
    EXPECT_NEAR(flow_at(seen, 4).x, 0, 1e-9);
  }
}

TEST(flow, goes_on_beyond_the_image_and_not_beyond_the_lens_model) {
  for (const double k1 : {0.0, -0.5}) {
    int none = 0;
    for (const double speed : {5.0, 10.0, 40.0, -1e4}) {
      Scene scene = wall(2, 0.5);
      scene.objects[0].velocity_m_per_s = {speed, 0, 0};
      const Camera camera = camera_with(distorted({k1}));
      const Truth seen = truth_of(scene, camera);
      const std::size_t middle = 45 * 120 + 63;
      const double x = static_cast<double>(seen.position_m[3 * middle]) / 2 + 0.05 * speed;
      // The radial part of k1 = −0.5 grows up to r² = 2/3; without distortion the model ends at r = 100.
      const bool beyond = k1 != 0 ? x * x > 2.0 / 3 : std::abs(x) > 100;
      ASSERT_EQ(is_none(flow_at(seen, middle)), beyond) << k1 << ", " << speed;
      none += beyond;
      if (!beyond && k1 == 0) {
        EXPECT_NEAR(flow_at(seen, middle).x, 5 * speed, 1e-4 * std::abs(speed));
      }
    }
    EXPECT_EQ(none, k1 == 0 ? 1 : 2);
  }
}

// The outermost pixels' rays are rounded, and so is the limit: what such a pixel sees is within the model, unless it goes outward.
TEST(flow, at_the_edge_of_the_lens_model_is_there_unless_it_leads_outward) {
  camera::ProjectionView lens{100, 100, -0.5F, 0, 0, 0, 0, 2.0F / 3, 0, 0, 0, 0};
  const auto ray = flow::make_ray(std::sqrt(lens.limit) * 1.000001F, 0.0F, 1.0F);
  for (const auto& [aside, there] : {std::pair(0.0F, true), std::pair(-0.01F, true), std::pair(0.01F, false)}) {
    float u = 1, v = 1;
    EXPECT_EQ(camera::image_motion(lens, ray, 2.0F, {aside, 0.0F, 0.0F}, u, v), there) << aside;
    if (aside == 0) {
      EXPECT_EQ(u, 0);
    }
    EXPECT_EQ(v, 0);
  }
}

// Twice as many frames a second: half the flow, the same velocity.
TEST(flow, is_that_of_one_frame_of_the_mode) {
  Scene scene = wall(2, 0.5);
  scene.objects[0].velocity_m_per_s = {0.5, 0, 0};
  Camera camera = camera_with(Lens{});
  camera.mode.frame_rate_hz = 20;
  const Truth fast = truth_of(scene, camera);
  EXPECT_NEAR(flow_at(fast, 100).x, 100 * 0.5 / 20 / 2, 1e-6);
  EXPECT_EQ(fast.velocity_m_per_s[300], 0.5F);
}

namespace {

/// What an object turns about before it is shifted, by the words of tofray/scene.h.
Vec3 center_of(const Object& object) {
  if (const auto* ball = std::get_if<Sphere>(&object.shape)) return ball->center;
  if (const auto* box = std::get_if<Box>(&object.shape)) return 0.5 * (box->min + box->max);
  if (const auto* capsule = std::get_if<Capsule>(&object.shape)) return 0.5 * (capsule->start + capsule->end);
  if (const auto* plane = std::get_if<Plane>(&object.shape)) return plane->point;
  return {0, 0, 0};  // a mesh
}

/// Where the camera sees at a time what it sees at P at another.
class Followed {
 public:
  Followed(const Scene& scene, const Object& object, double now, const Vec3& p)
      : scene_(scene), object_(object), center_(center_of(object)) {
    const Object there = test::standing(object, now);
    const Vec3 in_place = in_world(test::standing(scene, now).camera.pose, p) - center_ - there.position;
    own_ = turned({there.rotation.axis, -there.rotation.angle_rad}, in_place);
  }
  [[nodiscard]] Vec3 at(double time) const {
    const Object there = test::standing(object_, time);
    const scene::CameraFrame camera = scene::camera_frame(test::standing(scene_, time).camera.pose);
    return camera.rotation * (turned(there.rotation, own_) + center_ + there.position - camera.position);
  }

 private:
  Scene scene_;
  Object object_;
  Vec3 center_, own_;
};

/// Spinning and keyframed things before a wall, and a mesh; the camera moves if asked for.
Scene spinning_scene(Random& random, bool camera_moves) {
  Scene scene = wall(3, 0.5);
  const Object kinds[] = {object(Box{{-0.7, -0.3, 1.2}, {-0.2, 0.2, 1.5}}), object(Capsule{{0.1, -0.3, 1.1}, {0.5, 0.1, 1.6}, 0.12}),
                          object(shared(single(stone(random, 1, 0.3, {0.1, 0, 0})))), object(Sphere{{0.5, 0.4, 1.4}, 0.25})};
  for (const Object& kind : kinds) scene.objects.push_back(kind);
  scene.objects[1].angular_velocity_rad_per_s = random.point(6), scene.objects[1].rotation = {random.direction(), 0.4};
  scene.objects[2].angular_velocity_rad_per_s = random.point(6), scene.objects[2].velocity_m_per_s = random.point(1);
  scene.objects[3].keyframes = {{-0.2, {-0.2, 0.4, 1.3}, {random.direction(), 1.1}}, {0.4, {0, 0.3, 1.5}, {random.direction(), -0.8}}};
  scene.objects[4].angular_velocity_rad_per_s = random.point(6);
  if (camera_moves) {
    for (const double time : {-0.1, 0.3})
      scene.camera.keyframes.push_back({time, {random.point(0.2), Vec3{0, 0, 2} + random.point(0.4), Vec3{0, -1, 0} + random.point(0.2)}});
  } else {
    scene.camera.pose = random_pose(random);
  }
  return scene;
}

}  // namespace

// Both against the exact motion of the point that a pixel sees, the lens model in double.
TEST(motion_truth, of_turning_things_and_a_turning_camera_is_that_of_the_exact_motion) {
  int seen[5] = {}, large = 0, passed_by = 0;
  for (int trial = 0; trial < 6; ++trial) {
    Random random(static_cast<std::uint64_t>(trial) + 700);
    const Scene scene = spinning_scene(random, trial % 2 == 1);
    const Camera camera = camera_with(trial < 3 ? Lens{} : distorted({-0.2, 0.03, 1e-3, 2e-3}));
    const Truth truth = truth_of(scene, camera);
    for (std::size_t i = 0; i < truth.object_id.size(); ++i) {
      if (truth.object_id[i] < 0) continue;
      const auto id = static_cast<std::size_t>(truth.object_id[i]);
      const Vec3 p = vector_at(truth.position_m, i);
      const Followed point(scene, scene.objects[id], truth.time_s, p);
      ASSERT_LT(base::length(point.at(truth.time_s) - p), 1e-12);
      constexpr double step = 1e-5;
      const Vec3 velocity = (0.5 / step) * (point.at(truth.time_s + step) - point.at(truth.time_s - step));
      // Up to 10 rad/s at 3 m: 30 m/s, in single precision; the difference is off by (10 rad/s·step)²/6 of it, and 1e-15 m/step.
      ASSERT_LT(base::length(vector_at(truth.velocity_m_per_s, i) - velocity), 1e-5) << "trial " << trial << " at " << i << " of " << id;
      const Vec3 to = point.at(truth.time_s + period);
      if (!is_seen(camera.lens, to) || to[2] < 0.3 || to[0] * to[0] + to[1] * to[1] > to[2] * to[2]) continue;
      const Point2 one = pixel_of(camera.lens, p), other = pixel_of(camera.lens, to), got = flow_at(truth, i);
      // Step and turn are rounded at the size of the point, 3 m: 1e-6 m at 0.3 m and more, of 110 px.
      const double bound = 110 * 1.2e-6 / to[2] * (1 + p[2] / to[2]);
      ASSERT_NEAR(got.x, other.x - one.x, bound) << "trial " << trial << " at " << i << " of " << id;
      ASSERT_NEAR(got.y, other.y - one.y, bound) << "trial " << trial << " at " << i << " of " << id;
      ++seen[id];
      large += std::abs(got.x) + std::abs(got.y) > 5;
      passed_by += trial % 2 == 1 && id == 0 && got.x != 0;
    }
  }
  for (const int count : seen) EXPECT_GT(count, 1000);
  EXPECT_GT(large, 3000);
  EXPECT_GT(passed_by, 3000) << "what stands moves in the camera's frame";
}

// What turns or follows keyframes leaves what stands still at exact zeros; so does a camera whose keyframes are all the same.
TEST(motion_truth, of_what_stands_still_beside_it_is_exactly_zero) {
  for (const bool keyframes : {false, true}) {
    Random random(8);
    Scene scene = spinning_scene(random, false);
    if (keyframes) {
      scene.camera.keyframes = {{-1, scene.camera.pose}, {1, scene.camera.pose}};
      scene.camera.pose = {};
      scene.objects[3].keyframes.clear();
      scene.objects[3].position = {0, 0, 1.5};
    }
    const Truth truth = truth_of(scene, camera_with(distorted({-0.2})));
    int still = 0;
    for (std::size_t i = 0; i < truth.object_id.size(); ++i) {
      if (truth.object_id[i] != 0 && !(keyframes && truth.object_id[i] == 3)) continue;
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(std::bit_cast<std::uint32_t>(truth.velocity_m_per_s[3 * i + k]), 0U) << i;
      for (std::size_t k = 0; k < 2; ++k) ASSERT_EQ(std::bit_cast<std::uint32_t>(truth.flow_px[2 * i + k]), 0U) << i;
      ++still;
    }
    EXPECT_GT(still, 3000);
  }
}
