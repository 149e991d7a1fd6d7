// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Objects and the camera placed from outside, within a frame: the same bytes as a scene whose keyframes say so.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "support/placed_scene.h"
#include "support/same_frame.h"
#include "support/samples.h"

using namespace tofray;
using namespace tofray::test;
using out_test::error_of;

namespace {

SimulatorOptions one_thread() { return {.seed = 5, .threads = 1}; }

Frame of_request(Simulator& simulator, const FrameRequest& request) {
  Frame out;
  simulator.frame(request, out);
  return out;
}

/// Frames of a film.
constexpr std::uint64_t film = 6;

}  // namespace

TEST(placed_objects, give_the_bytes_of_a_scene_with_the_same_keyframes) {
  const Camera camera = placed_camera();
  const Scene moving = scene_on_a_path(placed_scene_at_rest(), camera, film + 2, true);
  Simulator of_the_file(moving, camera, one_thread()), outside(placed_scene_at_rest(), camera, one_thread());
  for (const std::uint64_t i : {0, 3, 1, 3, 5}) {
    FrameRequest request{.index = i, .camera = moving.camera.keyframes};
    request.objects = {{"stone", {}, {}, moving.objects[2].keyframes}, {"crate", {}, {}, moving.objects[1].keyframes}};
    EXPECT_EQ(first_difference(of_request(outside, request), of_the_file.frame(i)), "") << i;
  }
}

// Start, end and what comes after it are all that a frame and its optical flow look at.
TEST(placed_objects, need_no_more_than_start_and_end_where_they_go_on_evenly) {
  const Camera camera = placed_camera();
  const Scene rest = placed_scene_at_rest(), moving = scene_on_a_path(rest, camera, film + 2, true);
  Simulator outside(rest, camera, one_thread());
  for (std::uint64_t i = 0; i < film; ++i) {
    const FrameRequest request = request_on_the_path(moving, i);
    // What goes on beyond the next frame's start is worked out of both: it is part of the scene that says the same.
    const Frame expected = Simulator(placed_scene(rest, camera, request), camera, one_thread()).frame(i);
    const Frame got = of_request(outside, request), path = Simulator(moving, camera, one_thread()).frame(i);
    EXPECT_EQ(first_difference(got, expected), "") << i;
    EXPECT_EQ(got.raw.raw, path.raw.raw) << i;
    EXPECT_EQ(got.truth.velocity_m_per_s, path.truth.velocity_m_per_s) << i;
    ASSERT_EQ(got.truth.flow_px.size(), path.truth.flow_px.size());
    for (std::size_t p = 0; p < got.truth.flow_px.size(); ++p)
      if (!std::isnan(path.truth.flow_px[p])) {
        ASSERT_NEAR(got.truth.flow_px[p], path.truth.flow_px[p], 2e-3) << i << " " << p;
      }
  }
}

TEST(placed_objects, are_where_they_are_at_each_raw_frame_not_at_the_frames_end) {
  const Camera camera = placed_camera();
  const Scene rest = placed_scene_at_rest();
  Simulator outside(rest, camera, one_thread());
  FrameRequest request{.index = 2};
  request.objects = {{"crate", {{-0.2, 0, 0}, {}}, Placement{{0.4, 0, -0.3}, {}}, {}}};
  const Frame moving = of_request(outside, request);
  request.objects = {{"crate", {{0.4, 0, -0.3}, {}}, {}, {}}};
  const Frame at_end = of_request(outside, request);
  EXPECT_NE(moving.raw.raw, at_end.raw.raw);
  // The truth is that of the middle raw frame.
  const std::vector<double> times = exposure_times(camera, moving.raw.start_time_s[0]);
  ASSERT_EQ(times.size(), camera.mode.sequence.size());
  EXPECT_EQ(times[times.size() / 2], moving.truth.time_s);
  const double share = (moving.truth.time_s - moving.raw.start_time_s[0]) * camera.mode.frame_rate_hz;
  request.objects = {{"crate", {{-0.2 + share * 0.6, 0, -0.3 * share}, {}}, {}, {}}};
  const Frame middle = of_request(outside, request);
  for (std::size_t p = 0; p < middle.truth.z_m.size(); ++p)
    if (middle.truth.object_id[p] == 1 && moving.truth.object_id[p] == 1) {
      ASSERT_NEAR(moving.truth.z_m[p], middle.truth.z_m[p], 1e-5) << p;
    }
}

TEST(placed_objects, leave_the_others_their_own_motion) {
  const Camera camera = placed_camera();
  Scene scene = placed_scene_at_rest();
  scene.objects[2].velocity_m_per_s = {0.5, 0, 0}, scene.objects[2].angular_velocity_rad_per_s = {0, 20, 0};
  Scene expected = scene;
  expected.objects[1].keyframes = {{0, {0.1, 0, 0}, {}}};
  FrameRequest request{.index = 4};
  request.objects = {{"crate", {{0.1, 0, 0}, {}}, {}, {}}};
  Simulator outside(scene, camera, one_thread());
  EXPECT_EQ(first_difference(of_request(outside, request), Simulator(expected, camera, one_thread()).frame(4)), "");
  EXPECT_EQ(first_difference(outside.frame(4), Simulator(scene, camera, one_thread()).frame(4)), "")
      << "without a request it is the scene's";
}

TEST(placed_objects, take_the_place_of_their_own_motion) {
  const Camera camera = placed_camera();
  Scene scene = placed_scene_at_rest(), moves = scene;
  moves.objects[1].velocity_m_per_s = {3, 0, 0}, moves.objects[1].position = {0.3, 0, 0};
  moves.objects[2].keyframes = {{0, {1, 0, 0}, {}}, {9, {2, 0, 0}, {}}};
  FrameRequest request{.index = 1};
  request.objects = {{"crate", {{0.1, 0, 0}, {}}, {}, {}}, {"stone", {{0, 0.1, 0}, {{0, 0, 1}, 0.3}}, {}, {}}};
  Simulator one(scene, camera, one_thread()), other(moves, camera, one_thread());
  EXPECT_EQ(first_difference(of_request(one, request), of_request(other, request)), "");
}

TEST(placed_camera, carries_its_lights_along) {
  const Camera camera = placed_camera();
  const Scene rest = placed_scene_at_rest();
  FrameRequest request{.index = 3, .pose = Pose{{0.1, 0, -0.3}, {0, 0, 2}}, .pose_end = Pose{{0.3, 0, -0.2}, {0, 0.1, 2}}};
  Simulator outside(rest, camera, one_thread());
  EXPECT_EQ(first_difference(of_request(outside, request), Simulator(placed_scene(rest, camera, request), camera, one_thread()).frame(3)),
            "");
  Scene mirrored = rest;  // by hand
  const double start = 3 / camera.mode.frame_rate_hz, end = 4 / camera.mode.frame_rate_hz;
  mirrored.camera.pose = {}, mirrored.camera.keyframes = {{start, *request.pose}, {end, *request.pose_end}};
  EXPECT_EQ(of_request(outside, request).raw.raw, Simulator(mirrored, camera, one_thread()).frame(3).raw.raw);
}

TEST(placed_camera, may_stand_still_where_the_scenes_own_moves) {
  const Camera camera = placed_camera();
  const Scene rest = placed_scene_at_rest(), moving = scene_on_a_path(rest, camera, film, true);
  FrameRequest request{.index = 2, .pose = Pose{{0.1, 0, -0.3}, {0, 0, 2}}};
  Simulator outside(moving, camera, one_thread());
  for (const bool with_objects : {false, true}) {
    if (with_objects) request.objects = request_on_the_path(moving, 4).objects;
    const Frame expected = Simulator(placed_scene(moving, camera, request), camera, one_thread()).frame(2);
    EXPECT_EQ(first_difference(of_request(outside, request), expected), "") << with_objects;
  }
}

TEST(placed_frames, start_when_they_are_told) {
  const Camera camera = placed_camera();
  Scene scene = placed_scene_at_rest();
  scene.objects[1].velocity_m_per_s = {0.5, 0, 0};
  Simulator simulator(scene, camera, one_thread());
  const Frame late = of_request(simulator, {.index = 0, .start_time_s = 7 / camera.mode.frame_rate_hz}), seventh = simulator.frame(7);
  EXPECT_EQ(late.truth.z_m, seventh.truth.z_m);
  EXPECT_EQ(late.raw.start_time_s, seventh.raw.start_time_s);
  EXPECT_EQ(late.truth.time_s, seventh.truth.time_s);
  EXPECT_NE(late.raw.raw, seventh.raw.raw) << "the noise is that of its index";
  EXPECT_EQ(late.index, 0u);
}

TEST(placed_frames, of_many_requests_come_in_their_order_whatever_each_places) {
  const Camera camera = placed_camera();
  const Scene rest = placed_scene_at_rest(), moving = scene_on_a_path(rest, camera, film + 2, true);
  std::vector<FrameRequest> requests;
  for (std::uint64_t i = 0; i < film; ++i) requests.push_back(request_on_the_path(moving, i));
  requests[1].objects.pop_back(), requests[2] = {2, {}, {}}, requests[4].pose = requests[4].pose_end = {};
  Simulator outside(rest, camera, one_thread()), again(rest, camera, one_thread());
  std::size_t next = 0;
  outside.frames(requests, [&](const FrameArrays& got) {
    const Frame expected = of_request(again, requests[next]);
    EXPECT_EQ(got.index, next++);
    EXPECT_EQ(std::memcmp(got.raw, expected.raw.raw.data(), expected.raw.raw.size() * sizeof *got.raw), 0) << got.index;
  });
  EXPECT_EQ(next, film);
}

namespace {
/// Swells.
class Swelling : public MeshMotion {
 public:
  explicit Swelling(std::shared_ptr<const TriangleMesh> mesh) : mesh_(std::move(mesh)) {}
  void at(double time_s, std::vector<std::array<float, 3>>& vertices, std::vector<std::array<float, 3>>& normals) const override {
    vertices = mesh_->vertices, normals = mesh_->normals;
    for (auto& vertex : vertices) vertex[1] *= static_cast<float>(1 + time_s);
  }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
};
}  // namespace

TEST(placed_objects, go_on_changing_their_shape) {
  const Camera camera = placed_camera();
  Scene rest = placed_scene_at_rest();
  auto& mesh = std::get<Mesh>(rest.objects[2].shape);
  mesh.motion = std::make_shared<const Swelling>(mesh.triangles);
  const Scene moving = scene_on_a_path(rest, camera, film, false);
  Simulator outside(rest, camera, one_thread());
  FrameRequest request{.index = 3,
                       .objects = {{"stone", {}, {}, moving.objects[2].keyframes}, {"crate", {}, {}, moving.objects[1].keyframes}}};
  EXPECT_EQ(first_difference(of_request(outside, request), Simulator(moving, camera, one_thread()).frame(3)), "");
}

TEST(placed_objects, of_several_materials_are_one_and_have_numbers) {
  const Camera camera = placed_camera();
  Scene rest = placed_scene_at_rest();
  Object half = rest.objects[2];
  rest.objects[2].name = "pot/clay", half.name = "pot/lid", rest.objects[2].key = half.key = "objects.2";
  rest.objects.push_back(half);
  FrameRequest request{.index = 0, .objects = {{"pot", {{0.1, 0, 0}, {}}, {}, {}}}};
  const Scene placed = placed_scene(rest, camera, request);
  EXPECT_EQ(placed.objects[2].keyframes.size(), 1u);
  EXPECT_EQ(placed.objects[3].keyframes.size(), 1u);
  request.objects[0].name = "objects.2";
  EXPECT_EQ(placed_scene(rest, camera, request).objects[3].keyframes.size(), 1u);
  request.objects[0].name = "pot/lid";
  EXPECT_TRUE(placed_scene(rest, camera, request).objects[2].keyframes.empty());
  EXPECT_EQ(placed_scene(rest, camera, request).objects[3].keyframes.size(), 1u);
}

TEST(placed_frames, say_what_is_wrong_of_a_request) {
  const Camera camera = placed_camera();
  Scene rest = placed_scene_at_rest();
  rest.objects.push_back(rest.objects[0]), rest.objects[3].name = rest.objects[0].name;
  Simulator simulator(rest, camera, one_thread());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Placement here{};
  const auto objects = [](PlacedObject one) { return FrameRequest{.index = 0, .objects = {std::move(one)}}; };
  const std::pair<FrameRequest, std::string> wrong[] = {
      {objects({"crat", here, {}, {}}), "error: the scene has no object \"crat\"; did you mean \"crate\"?"},
      {objects({"", here, {}, {}}), "error: the scene has no object \"\""},
      {objects({"wall", here, {}, {}}), "error: 2 objects are called \"wall\""},
      {{.index = 0, .objects = {{"crate", here, {}, {}}, {"objects.1", here, {}, {}}}},
       "error: request.objects[\"objects.1\"] is placed twice"},
      {objects({"crate", {{0, nan, 0}, {}}, {}, {}}), "request.objects[\"crate\"].start.position[1] is out of range"},
      {objects({"crate", here, Placement{{0, 0, 0}, {{0, 0, 1}, 0, tofray::Quaternion{0, 0, 0.5, 0.5}}}, {}}),
       "request.objects[\"crate\"].end.rotation.quaternion"},
      {objects({"crate", {{0, 0, 0}, {{0, 0, 0}, 1}}, {}, {}}), "axis has no length"},
      {objects({"crate", here, {}, {{0.2, {0, 0, 0}, {}}, {0.1, {0, 0, 0}, {}}}}), "a keyframe is not later than the one before"},
      {objects({"crate", here, {}, {{nan, {0, 0, 0}, {}}}}), "request.objects[\"crate\"].keyframes[0].time_s is out of range"},
      {objects({"crate", here, here, {{0, {0, 0, 0}, {}}}}), "request.objects[\"crate\"] has keyframes, and a start or an end"},
      {objects({"crate", here, {}, std::vector<Keyframe>(100'001)}), "request.objects[\"crate\"].keyframes has too many elements"},
      {{.index = 0, .pose = Pose{{0, 0, 0}, {0, 0, 0}}}, "the camera looks at the point where it stands"},
      {{.index = 0, .pose_end = Pose{}}, "error: request has a pose_end, and no pose"},
      {{.index = 0, .pose = Pose{}, .pose_end = Pose{{0, 0, 0}, {0, 0, -1}}}, "the camera turns too far between two keyframes"},
      {{.index = 0, .pose = Pose{}, .camera = {{0, Pose{}}}}, "error: request has a pose and keyframes of the camera"},
      {{.index = 0, .camera = {{1, Pose{}}, {1, Pose{}}}}, "a keyframe is not later than the one before"},
      {{.index = 0, .start_time_s = nan}, "error: request.start_time_s is out of range"},
  };
  for (const auto& [request, what] : wrong) {
    const std::string told = error_of([&, asked = &request] { (void)of_request(simulator, *asked); }).what();
    EXPECT_NE(told.find(what), std::string::npos) << told;
    EXPECT_TRUE(told.find("\n  ") != std::string::npos) << told;
    // In a list before the first frame, and by its place in it.
    const FrameRequest list[] = {{0, {}, {}}, request};
    int taken = 0;
    (void)error_of([&] { simulator.frames(list, [&](const FrameArrays&) { ++taken; }); });
    EXPECT_EQ(taken, 0) << what;
  }
  EXPECT_EQ(error_of([&] { (void)of_request(simulator, wrong[10].first); }).kind(), ErrorKind::limit);
}

TEST(placed_frames, cannot_hang_on_frames_before) {
  Camera camera = placed_camera();
  camera.decoding.temporal_frames = 3;
  Simulator simulator(placed_scene_at_rest(), camera, one_thread());
  const std::string told = error_of([&] { (void)of_request(simulator, {.index = 0, .objects = {{"crate", {}, {}, {}}}}); }).what();
  EXPECT_NE(told.find("decoding.temporal.frames"), std::string::npos) << told;
}
