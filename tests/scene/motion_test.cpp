// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Rigid motion in double: where things are, against Rodrigues' formula and quaternions; how they move, against central differences.
#include "scene/motion.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/rotation.h"
#include "shape/list.h"
#include "support/pi.h"
#include "support/random.h"
#include "support/turning.h"

using namespace tofray;
using namespace tofray::test;
using base::operator+;
using base::operator-;
using base::operator*;
using base::cross;
using base::dot;
using base::length;
using scene::camera_at;
using scene::Motion;
using scene::motion_at;
using scene::pose_at;

namespace {

Vec3 array_of(const shape::Vec& a) { return {a.x, a.y, a.z}; }
Vec3 moved(const Motion& motion, const Vec3& p) { return array_of(motion.turn * scene::vec(p) + motion.shift); }

/// An object that turns, and the place about which it does, by the words of tofray/scene.h.
struct Turning {
  Object object;
  Vec3 center;         ///< before the shift
  shape::Vec derived;  ///< what the code says of it
};

template <class T, class Said>
Turning turning(const Said& said, const Vec3& center) {
  Object object;
  object.shape = said;
  return {object, center, T::center_of(said)};
}

std::vector<Turning> one_of_each() {
  const Triangle triangle{{Vec3{0.3, 0.1, 2}, Vec3{0.9, 0.4, 2.6}, Vec3{-0.2, 1, 1.7}}};
  return {turning<shape::Plane>(Plane{{0.5, -0.2, 3}, {0, 0.6, -0.8}}, {0.5, -0.2, 3}),
          turning<shape::Sphere>(Sphere{{0.2, 0.3, 1.5}, 0.4}, {0.2, 0.3, 1.5}),
          turning<shape::Box>(Box{{-0.2, 0.1, 1}, {0.4, 0.3, 2}}, {0.1, 0.2, 1.5}),
          turning<shape::Triangle>(triangle, (1.0 / 3) * (triangle.vertices[0] + triangle.vertices[1] + triangle.vertices[2])),
          turning<shape::Cylinder>(Cylinder{{0.1, 0.2, 1.4}, {1, 2, 3}, 0.2, 0.7}, {0.1, 0.2, 1.4}),
          turning<shape::Rectangle>(Rectangle{{0.4, -0.1, 2}, {0.3, 0.5}}, {0.4, -0.1, 2}),
          turning<shape::Disk>(Disk{{0.1, -0.6, 1.8}, {0, 1, -1}, 0.3}, {0.1, -0.6, 1.8}),
          turning<shape::Capsule>(Capsule{{0, 0.2, 1}, {0.6, -0.4, 2}, 0.1}, {0.3, -0.1, 1.5}),
          turning<shape::Cone>(Cone{{0.3, 0.3, 1.2}, {0, -1, 0.2}, 0.2, 0.5}, {0.3, 0.3, 1.2}),
          turning<shape::Mesh>(Mesh{}, {0, 0, 0})};
}

Vec3 about(const Vec3& center, const Rotation& by, const Vec3& p) { return turned(by, p - center) + center; }

/// The velocity that a motion gives what is at P now, and the same by a central difference of places.
/// @param step  [s]; the difference is off by the square of step times rate, and by the rounding of places over the step
void expect_velocity_field(const Object& object, const Vec3& center, double time, double step, double tolerance) {
  const Motion now = motion_at(object, scene::vec(center), time), before = motion_at(object, scene::vec(center), time - step),
               after = motion_at(object, scene::vec(center), time + step);
  for (const Vec3& from : {Vec3{0, 0, 0}, Vec3{1, 0.5, 2}, center}) {
    const Vec3 difference = (0.5 / step) * (moved(after, from) - moved(before, from));
    const Vec3 field = array_of(now.drift + cross(now.spin, scene::vec(moved(now, from))));
    EXPECT_LT(length(field - difference), tolerance) << "at " << time;
  }
}

Object with_keyframes(std::vector<Keyframe> keys) {
  Object out;
  out.keyframes = std::move(keys);
  return out;
}

void expect_turn(const Motion& got, const Rotation& expected, double tolerance = 1e-12) {
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    EXPECT_LT(length(array_of(got.turn * scene::vec(axis)) - turned(expected, axis)), tolerance);
}

}  // namespace

TEST(steady_motion, turns_every_shape_about_its_own_center) {
  Random random(1);
  const std::vector<Turning> all = one_of_each();
  ASSERT_EQ(all.size(), std::variant_size_v<decltype(Object::shape)>);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].object.shape.index(), i) << "each kind once";
    EXPECT_LT(length(array_of(all[i].derived) - all[i].center), 1e-15) << i;
    Object object = all[i].object;
    object.position = random.point(2);
    object.velocity_m_per_s = random.point(3), object.angular_velocity_rad_per_s = random.point(9);
    EXPECT_TRUE(scene::moves(object));
    const Vec3 center = all[i].center + object.position;
    for (const double time : {0.0, 0.01, 1.3, -0.7}) {
      const Motion motion = motion_at(object, all[i].derived + scene::vec(object.position), time);
      const Rotation by{object.angular_velocity_rad_per_s, time * length(object.angular_velocity_rad_per_s)};
      for (int k = 0; k < 3; ++k) {
        const Vec3 p = center + random.point(1);
        EXPECT_LT(length(moved(motion, p) - (about(center, by, p) + time * object.velocity_m_per_s)), 1e-12) << i;
      }
    }
    expect_velocity_field(object, center, 0.4, 1e-5, 1e-6);
  }
}

TEST(steady_motion, is_none_of_what_stands_still) {
  Object object;
  EXPECT_FALSE(scene::moves(object));
  object.position = {1, 2, 3}, object.rotation.angle_rad = 1;
  EXPECT_FALSE(scene::moves(object));
  for (const int which : {0, 1, 2}) {
    Object other = object;
    if (which == 0) other.velocity_m_per_s = {0, 0, 1e-9};
    if (which == 1) other.angular_velocity_rad_per_s = {0, 1e-9, 0};
    if (which == 2) other.keyframes = {{}};
    EXPECT_TRUE(scene::moves(other)) << which;
  }
}

// Beyond 1e9 rad the sine has no more digits; whole turns are taken off before.
TEST(steady_motion, has_numbers_at_any_time) {
  Object object;
  object.angular_velocity_rad_per_s = {1e4, -1e4, 1e4};
  for (const double time : {1e3, 1e6, 1e12, 1e23}) {
    const Motion motion = motion_at(object, {1, 2, 3}, time);
    for (const shape::Vec& row : motion.turn.row) EXPECT_NEAR(dot(row, row), 1, 1e-12) << time;
  }
  // 2e10 half turns about z and a quarter: 2e10·π is rounded by 4e-6 at most.
  object.angular_velocity_rad_per_s = {0, 0, pi};
  expect_turn(motion_at(object, {0, 0, 0}, 2e10 + 0.5), {{0, 0, 1}, pi / 2}, 2e-5);
  object.angular_velocity_rad_per_s = {0, 0, -pi};
  expect_turn(motion_at(object, {0, 0, 0}, 2e10 + 0.5), {{0, 0, 1}, -pi / 2}, 2e-5);
}

TEST(keyframes, change_shift_and_angle_evenly_about_the_center) {
  Random random(2);
  const Vec3 center{0.3, -0.2, 1.4}, axis{1, 2, -2};
  const Object object = with_keyframes({{1, {1, 0, 0}, {axis, 0.5}}, {3, {2, 4, -1}, {2.0 * axis, 2.5}}});
  for (const double share : {0.0, 0.1, 0.5, 0.75}) {
    const Motion motion = motion_at(object, scene::vec(center), 1 + 2 * share);
    const Vec3 shift = Vec3{1, 0, 0} + share * Vec3{1, 4, -1}, p = random.point(2);
    EXPECT_LT(length(moved(motion, p) - (about(center, {axis, 0.5 + 2 * share}, p) + shift)), 1e-12) << share;
    EXPECT_LT(length(array_of(motion.spin) - (1.0 / 3) * axis), 1e-12);  // 2 rad in 2 s
  }
  for (const double time : {1.2, 2.0, 2.9}) expect_velocity_field(object, center, time, 1e-5, 1e-8);
}

// Two whole turns stay two, forward and back, also about the opposite axis.
TEST(keyframes, about_one_axis_keep_all_their_angle) {
  const struct {
    Rotation from, to;
    double rate;  ///< about z, in one second
  } cases[] = {{{{0, 0, 1}, 0}, {{0, 0, 1}, 4 * pi}, 4 * pi},
               {{{0, 0, 1}, 4 * pi}, {{0, 0, 1}, 0}, -4 * pi},
               {{{0, 0, 1}, 1}, {{0, 0, 1}, 1 + 4 * pi}, 4 * pi},
               {{{0, 0, 1}, 1}, {{0, 0, -3}, 2}, -3},
               {{{1, 0, 0}, 0}, {{0, 0, 1}, -7}, -7},
               {{{0, 0, 2}, 9}, {{1, 0, 0}, 0}, -9}};
  for (const auto& one : cases) {
    const Object object = with_keyframes({{0, {}, one.from}, {1, {}, one.to}});
    const double start = one.from.angle_rad;
    for (const double time : {0.0, 0.2, 0.5, 0.999}) {
      const Motion motion = motion_at(object, {0, 0, 0}, time);
      expect_turn(motion, {{0, 0, 1}, start + time * one.rate});
      EXPECT_LT(length(array_of(motion.spin) - Vec3{0, 0, one.rate}), 1e-12);
    }
  }
}

// A random pair: the way is that of quaternions, spherically and the shortest one; no more than a half turn.
TEST(keyframes, about_different_axes_go_the_shortest_way) {
  Random random(3);
  int negated = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Rotation a{random.direction(), random.between(-6, 6)}, b{random.direction(), random.between(-6, 6)};
    const tofray::test::Quaternion from = quaternion(a), to = quaternion(b);
    double cosine = dot(from, to);
    const double sign = cosine < 0 ? -1 : 1;
    negated += cosine < 0;
    cosine *= sign;
    const double angle = std::acos(cosine);
    const Object object = with_keyframes({{2, {}, a}, {2.5, {}, b}});
    for (const double share : {0.0, 0.25, 0.5, 1 - 1e-9}) {
      const double one = std::sin((1 - share) * angle) / std::sin(angle), other = sign * std::sin(share * angle) / std::sin(angle);
      const Rotation expected = rotation(tofray::test::Quaternion{one * from.w + other * to.w, one * from.v + other * to.v});
      const Motion motion = motion_at(object, {0, 0, 0}, 2 + 0.5 * share);
      expect_turn(motion, expected, 1e-12 / std::sin(angle));
      EXPECT_NEAR(length(array_of(motion.spin)), 2 * angle / 0.5, 1e-12 / std::sin(angle));
    }
    expect_velocity_field(object, {0.2, 0.3, 0.4}, 2.2, 1e-5, 1e-6);
  }
  EXPECT_GT(negated, 50);
}

// Axes that are nearly the same meet the second keyframe all the same: nothing jumps there.
TEST(keyframes, with_axes_that_differ_little_arrive_where_they_should) {
  for (const double aside : {1e-3, 1e-6, 1e-9, 1e-13}) {
    const Rotation to{{aside, 0, 1}, 2};
    const Object object = with_keyframes({{0, {}, {{0, 0, 1}, 0.5}}, {1, {}, to}});
    expect_turn(motion_at(object, {0, 0, 0}, 1 - 1e-15), to);
  }
}

TEST(keyframes, hold_before_the_first_and_after_the_last) {
  const Vec3 center{1, 0, 0};
  const Object object = with_keyframes({{1, {1, 2, 3}, {{0, 1, 0}, 0.3}}, {2, {4, 5, 6}, {{0, 1, 0}, 0.9}}});
  const struct {
    double time;
    Vec3 shift;
    double angle;
  } cases[] = {{-1e6, {1, 2, 3}, 0.3}, {0.999, {1, 2, 3}, 0.3}, {2, {4, 5, 6}, 0.9}, {1e6, {4, 5, 6}, 0.9}};
  for (const auto& one : cases) {
    const Motion motion = motion_at(object, scene::vec(center), one.time);
    expect_turn(motion, {{0, 1, 0}, one.angle});
    EXPECT_LT(length(moved(motion, center) - (center + one.shift)), 1e-12);
    EXPECT_EQ(motion.drift, (shape::Vec{0, 0, 0})) << one.time;
    EXPECT_EQ(motion.spin, (shape::Vec{0, 0, 0})) << one.time;
  }
  // One alone is a place.
  const Motion alone = motion_at(with_keyframes({{5, {1, 1, 1}, {{0, 0, 1}, pi / 2}}}), {0, 0, 0}, 0);
  EXPECT_LT(length(moved(alone, {1, 0, 0}) - Vec3{1, 2, 1}), 1e-12);
  EXPECT_EQ(alone.drift, (shape::Vec{0, 0, 0}));
}

TEST(keyframes, are_met_exactly_where_there_are_a_thousand) {
  Random random(4);
  std::vector<Keyframe> keys;
  for (int i = 0; i < 1000; ++i) {
    keys.push_back(
        {i == 0 ? -50 : keys.back().time_s + random.scale(1e-9, 1), random.point(1e3), {random.direction(), random.between(-4, 4)}});
  }
  const Object object = with_keyframes(keys);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Motion motion = motion_at(object, {0, 0, 0}, keys[i].time_s);
    EXPECT_EQ(array_of(motion.shift), keys[i].position) << i;
    expect_turn(motion, keys[i].rotation);
    if (i + 1 == keys.size()) continue;
    // From here to the next one.
    const double duration = keys[i + 1].time_s - keys[i].time_s;
    const Vec3 speed = array_of(motion.drift + cross(motion.spin, motion.shift)), change = keys[i + 1].position - keys[i].position;
    // The drift is a difference: 1e3 m times the spin, which is rounded, is taken off and added again.
    EXPECT_LT(length(duration * speed - change), 1e-9) << i;
    const Motion half = motion_at(object, {0, 0, 0}, keys[i].time_s + 0.5 * duration);
    EXPECT_LT(length(array_of(half.shift) - 0.5 * (keys[i].position + keys[i + 1].position)), 2e3 * 1e-14 * 50 / duration + 1e-9) << i;
  }
}

TEST(moving_camera, changes_its_words_evenly_and_looks_at_the_same_point_all_the_way) {
  CameraChoice camera;
  const Pose alone{{1, 2, 3}, {1, 2, 4}, {0, -1, 0}};
  camera.pose = alone;
  EXPECT_EQ(pose_at(camera, 7).position, alone.position);
  const Vec3 target{0.2, 0.1, 2};
  camera.keyframes = {
      {1, {{-1, 0, 0}, target, {0, -1, 0}}}, {2, {{1, 0.5, -0.4}, target, {0.3, -1, 0}}}, {4, {{1, 0, 0.5}, target, {0, -1, 0}}}};
  for (const double time : {0.0, 1.0, 1.3, 1.9, 2.0, 3.7, 4.0, 9.0}) {
    const scene::CameraFrame frame = scene::camera_frame(pose_at(camera, time));
    const Vec3 seen = frame.rotation * (target - frame.position);
    EXPECT_NEAR(seen[0], 0, 1e-15) << time;
    EXPECT_NEAR(seen[1], 0, 1e-15) << time;
  }
  EXPECT_LT(length(pose_at(camera, 1.25).position - Vec3{-0.5, 0.125, -0.1}), 1e-15);
  EXPECT_LT(length(pose_at(camera, 1.25).up - Vec3{0.075, -1, 0}), 1e-15);
  EXPECT_EQ(pose_at(camera, 2).position, (Vec3{1, 0.5, -0.4}));
  for (const double time : {0.5, 4.0, 5.0}) {
    EXPECT_EQ(camera_at(camera, time).velocity, (shape::Vec{0, 0, 0})) << "it stands before the first and after the last";
    EXPECT_EQ(camera_at(camera, time).spin, (shape::Vec{0, 0, 0}));
  }
}

// Each axis changes by spin × axis: by central differences of the camera's frame.
TEST(moving_camera, moves_and_turns_as_the_differences_of_its_frames) {
  Random random(5);
  double turning = 0;
  for (int trial = 0; trial < 100; ++trial) {
    CameraChoice camera;
    for (int i = 0; i < 2; ++i) {
      const Vec3 at = random.point(1);
      camera.keyframes.push_back({0.4 * i, {at, at + Vec3{0.2, 0.3, 2} + random.point(0.8), Vec3{0, -1, 0} + random.point(0.3)}});
    }
    const double time = random.between(0.05, 0.35), step = 1e-5;
    const scene::MovingCamera now = camera_at(camera, time);
    const auto at = [&](double t) { return scene::camera_frame(pose_at(camera, t)); };
    EXPECT_EQ(now.frame, at(time));
    const scene::CameraFrame before = at(time - step), after = at(time + step);
    EXPECT_LT(length(array_of(now.velocity) - (0.5 / step) * (after.position - before.position)), 1e-9);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 change = (0.5 / step) * (after.rotation[k] - before.rotation[k]);
      // (step·rate)² of a rate below 20 rad/s
      EXPECT_LT(length(cross(array_of(now.spin), now.frame.rotation[k]) - change), 1e-6) << "axis " << k;
    }
    turning += length(array_of(now.spin)) / 100;
  }
  EXPECT_GT(turning, 0.3) << "it would be no test";
}

namespace {

tofray::Quaternion quaternion_about(const Vec3& axis, double angle) {
  const Vec3 v = std::sin(0.5 * angle) * base::normalized(axis);
  return {v[0], v[1], v[2], std::cos(0.5 * angle)};
}

CameraChoice turning_camera(const tofray::Quaternion& from, const tofray::Quaternion& to) {
  CameraChoice camera;
  camera.keyframes = {{1, {{0, 0, 0}, {0, 0, 1}, {0, -1, 0}, from}}, {3, {{0.4, 0, -2}, {0, 0, 1}, {0, -1, 0}, to}}};
  return camera;
}

}  // namespace

TEST(moving_camera, by_quaternions_turns_evenly_the_shortest_way) {
  const Vec3 axis{1, 2, -3};
  const tofray::Quaternion start = quaternion_about({0.2, -1, 0.4}, 0.8);
  for (const double angle : {0.02, 1.5, 3.1, 3.2, 6.0}) {
    const double way = angle < pi ? angle : angle - 2 * pi;
    tofray::Quaternion end = base::product(quaternion_about(axis, angle), start);
    for (const int sign : {1, -1}) {
      for (double& part : end) part *= sign;
      const CameraChoice camera = turning_camera(start, end);
      for (const double time : {0.0, 1.0, 1.3, 2.0, 2.9, 3.0, 4.0}) {
        const double share = std::min(std::max(0.5 * (time - 1), 0.0), 1.0);
        const base::Mat3 got = base::transposed(scene::camera_frame(pose_at(camera, time)).rotation), first = base::matrix_of(start);
        for (const Vec3& p : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
          EXPECT_LT(length(got * p - turned({axis, share * way}, first * p)), 1e-14) << angle << " at " << time;
        EXPECT_LT(length(pose_at(camera, time).position - share * Vec3{0.4, 0, -2}), 1e-15);
      }
      const scene::MovingCamera moving = camera_at(camera, 1.7);
      EXPECT_LT(length(array_of(moving.spin) - (0.5 * way / length(axis)) * axis), 1e-14) << angle;
      EXPECT_LT(length(array_of(moving.velocity) - Vec3{0.2, 0, -1}), 1e-15);
    }
  }
}

TEST(moving_camera, by_a_quaternion_and_a_point_that_it_looks_at_turns_evenly_too) {
  const CameraChoice both = turning_camera({0, 0, 0, 1}, quaternion_about({0, 1, 0}, 2.1));
  for (const std::size_t which : {0U, 1U}) {
    CameraChoice one = both;
    Pose& pose = one.keyframes[which].pose;
    pose.quaternion.reset();
    const double angle = which == 0 ? 0 : 2.1;
    pose.look_at = pose.position + 7.0 * Vec3{std::sin(angle), 0, std::cos(angle)};
    for (const double time : {1.0, 1.5, 2.2, 3.0})
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LT(length(scene::camera_frame(pose_at(one, time)).rotation[k] - scene::camera_frame(pose_at(both, time)).rotation[k]),
                  1e-14);
    EXPECT_LT(length(array_of(camera_at(one, 2).spin) - array_of(camera_at(both, 2).spin)), 1e-14);
  }
}

TEST(keyframes, by_quaternions_go_the_shortest_way_as_others_do) {
  const tofray::Quaternion from = quaternion_about({0, 0, 1}, 170 * pi / 180), to = quaternion_about({0, 0, 1}, 190 * pi / 180);
  for (const double sign : {1.0, -1.0}) {
    Keyframe last{1, {0, 0, 0}, {}};
    last.rotation.quaternion = tofray::Quaternion{sign * to[0], sign * to[1], sign * to[2], sign * to[3]};
    Keyframe first{0, {0, 0, 0}, {}};
    first.rotation.quaternion = from;
    const Object object = with_keyframes({first, last});
    for (const double share : {0.0, 0.25, 0.5, 1.0})
      expect_turn(motion_at(object, {1, 2, 3}, share), {{0, 0, 1}, (170 + 20 * share) * pi / 180}, 1e-14);
    // From a quaternion to an angle: its whole turns count for nothing.
    Keyframe angle{1, {0, 0, 0}, {{0, 0, 1}, 190 * pi / 180 + 4 * pi}};
    expect_turn(motion_at(with_keyframes({first, angle}), {1, 2, 3}, 0.25), {{0, 0, 1}, 175 * pi / 180}, 1e-13);
  }
}

TEST(rotation, by_quaternion_is_that_about_its_axis) {
  Rotation by;
  by.quaternion = quaternion_about({1, 2, 3}, 1.2);
  Motion got;
  got.turn = scene::rotation_matrix(by);
  expect_turn(got, {{1, 2, 3}, 1.2}, 1e-15);
  for (double& part : *by.quaternion) part *= 1.0005;
  got.turn = scene::rotation_matrix(by);
  expect_turn(got, {{1, 2, 3}, 1.2}, 1e-15);
}
