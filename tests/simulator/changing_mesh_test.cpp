// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Meshes that change their shape: each raw frame sees the shape of its time; the truth says how it moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "backend/cpu/cpu.h"
#include "scene/frozen_scene.h"
#include "support/pixels.h"
#include "support/random_scene.h"
#include "support/same_frame.h"
#include "support/seen.h"
#include "support/wobble.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;
using base::operator+, base::operator-, base::operator*;

namespace {

using Corners = std::vector<std::array<float, 3>>;

/// By a function of the vertices as the mesh has them.
class By : public MeshMotion {
 public:
  using Change = std::function<void(double time_s, Corners& vertices, Corners& normals)>;
  By(std::shared_ptr<const TriangleMesh> mesh, Change change) : mesh_(std::move(mesh)), change_(std::move(change)) {}
  void at(double time_s, Corners& vertices, Corners& normals) const override {
    vertices = mesh_->vertices, normals = mesh_->normals;
    change_(time_s, vertices, normals);
  }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  Change change_;
};

Mesh changing(Mesh mesh, const By::Change& change) {
  mesh.motion = std::make_shared<By>(mesh.triangles, change);
  return mesh;
}

void shift(Corners& vertices, const Vec3& by) {
  for (auto& v : vertices)
    for (std::size_t k = 0; k < 3; ++k) v[k] = static_cast<float>(static_cast<double>(v[k]) + by[k]);
}

/// A bumpy ball before a wall.
Scene ball_scene(const Mesh& ball) {
  Scene scene = wall(2.5, 0.5);
  Object one = object(ball);
  one.position = {0.05, 0.1, 1.5};
  one.rotation = {{1, 2, 0.5}, 0.8};
  scene.objects.push_back(one);
  return scene;
}
Mesh ball() {
  Random random(5);
  TriangleMesh triangles = single(stone(random, 3, 0.4, {0, 0, 0}));
  add_details(random, triangles);
  return shared(std::move(triangles));
}

}  // namespace

TEST(changing_mesh, is_in_each_raw_frame_the_still_mesh_of_its_time) {
  const Scene scene = ball_scene(wobbling(ball(), 0.08, 3));
  const Camera camera = lit_camera(120, 90, 90);
  const SimulatorOptions options{.noise = Noise::off};
  const Frame moving = Simulator(scene, camera, options).frame(2);
  const Mesh& mesh = std::get<Mesh>(scene.objects[1].shape);
  const auto pixels = static_cast<std::size_t>(120 * 90);
  for (int k = 0; k < moving.raw.phases; ++k) {
    const auto phase = static_cast<std::size_t>(k);
    TriangleMesh then = *mesh.triangles;
    mesh.motion->at(moving.raw.start_time_s[phase] + 0.5 * moving.raw.integration_time_s[phase], then.vertices, then.normals);
    const Frame still = Simulator(ball_scene(shared(std::move(then))), camera, options).frame(2);
    for (std::size_t i = phase * pixels; i < (phase + 1) * pixels; ++i) {
      ASSERT_EQ(moving.raw.tap_a[i], still.raw.tap_a[i]) << k;
      ASSERT_EQ(moving.raw.tap_b[i], still.raw.tap_b[i]) << k;
    }
    if (k != moving.raw.phases / 2) continue;
    EXPECT_EQ(moving.truth.z_m, still.truth.z_m);
    EXPECT_EQ(moving.truth.normal, still.truth.normal);
    EXPECT_EQ(moving.truth.triangle_id, still.truth.triangle_id);
  }
}

// A shift of all vertices is the object's velocity, in its own turned frame.
TEST(changing_mesh, that_shifts_moves_as_an_object_does) {
  const Vec3 own{0.4, -0.3, 1.1};
  const Scene scene = ball_scene(changing(ball(), [&](double time_s, Corners& v, Corners&) { shift(v, time_s * own); }));
  Scene rigid = ball_scene(ball());
  rigid.objects[1].velocity_m_per_s = turned(rigid.objects[1].rotation, own);
  const Camera camera = lit_camera(120, 90, 90);
  const SimulatorOptions options{.noise = Noise::off};
  const Truth a = Simulator(scene, camera, options).frame(1).truth, b = Simulator(rigid, camera, options).frame(1).truth;
  int compared = 0;
  for (std::size_t i = 0; i < a.object_id.size(); ++i) {
    if (a.object_id[i] != b.object_id[i] || a.triangle_id[i] != b.triangle_id[i]) continue;  // edges: rounded elsewhere
    ASSERT_NEAR(a.z_m[i], b.z_m[i], 2e-5);                                                   // vertices are rounded elsewhere
    if (a.object_id[i] != 1) continue;
    ++compared;
    // Coordinates of 0.5 m, rounded to 3e-8 m, 2 ms apart; then over a frame.
    for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(a.velocity_m_per_s[3 * i + k], b.velocity_m_per_s[3 * i + k], 6e-5) << i;
    for (std::size_t k = 0; k < 2; ++k) ASSERT_NEAR(a.flow_px[2 * i + k], b.flow_px[2 * i + k], 2e-4) << i;
  }
  EXPECT_GT(compared, 500);
}

// It turns about its zero and the object moves besides: both add up.
TEST(changing_mesh, that_turns_and_shifts_moves_as_an_object_that_does_both) {
  const double rate = 1.7;
  const auto turn = [&](double time_s, Corners& vertices, Corners& normals) {
    for (Corners* all : {&vertices, &normals})
      for (auto& v : *all) {
        const Vec3 to =
            turned({{0, 1, 0}, rate * time_s}, {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])});
        for (std::size_t k = 0; k < 3; ++k) v[k] = static_cast<float>(to[k]);
      }
  };
  Scene scene = ball_scene(changing(ball(), turn)), rigid = ball_scene(ball());
  for (Scene* one : {&scene, &rigid}) one->objects[1].rotation = {}, one->objects[1].velocity_m_per_s = {0.3, 0.1, -0.5};
  rigid.objects[1].angular_velocity_rad_per_s = {0, rate, 0};
  const Camera camera = lit_camera(120, 90, 90);
  const SimulatorOptions options{.noise = Noise::off};
  const Truth a = Simulator(scene, camera, options).frame(1).truth, b = Simulator(rigid, camera, options).frame(1).truth;
  int compared = 0;
  for (std::size_t i = 0; i < a.object_id.size(); ++i) {
    if (a.object_id[i] != 1 || b.object_id[i] != 1 || a.triangle_id[i] != b.triangle_id[i]) continue;
    ++compared;
    ASSERT_NEAR(a.z_m[i], b.z_m[i], 2e-5);  // vertices are rounded elsewhere
    // A third of the cube of the half angle of 1 ms, and rounding as above.
    for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(a.velocity_m_per_s[3 * i + k], b.velocity_m_per_s[3 * i + k], 6e-5) << i;
    for (std::size_t k = 0; k < 2; ++k) ASSERT_NEAR(a.flow_px[2 * i + k], b.flow_px[2 * i + k], 3e-4) << i;
  }
  EXPECT_GT(compared, 500);
}

TEST(changing_mesh, that_is_shared_by_objects_is_one_and_others_stay_as_they_are) {
  Mesh still = ball();
  Scene scene = ball_scene(wobbling(still, 0.05, 4));
  scene.objects.push_back(scene.objects[1]);
  scene.objects[2].position = {-0.5, 0, 1.6}, scene.objects[2].rotation = {}, scene.objects[2].velocity_m_per_s = {0.2, 0, 0};
  scene.objects.push_back(object(still));
  scene.objects[3].position = {0.4, -0.3, 1.4};
  // A mesh that shares its triangles with the first, but not how it moves.
  scene.objects.push_back(object(changing(still, [](double time_s, Corners& vertices, Corners&) {
    shift(vertices, {0.3 * time_s, 0, 0});
  })));
  scene.objects[4].position = {0.7, 0.5, 1.9};
  const Camera camera = lit_camera(120, 90, 90);
  const Truth seen = Simulator(scene, camera, {.noise = Noise::off}).frame(0).truth;
  double largest[5] = {};
  for (std::size_t i = 0; i < seen.object_id.size(); ++i)
    if (seen.object_id[i] >= 0)
      largest[seen.object_id[i]] = std::max(largest[seen.object_id[i]], base::length(vector_at(seen.velocity_m_per_s, i)));
  EXPECT_EQ(largest[0], 0);
  EXPECT_GT(largest[1], 0.8);  // 2π·4·0.05 m/s where it is fastest
  EXPECT_LT(largest[1], 1.3);
  EXPECT_GT(largest[2], 0.8);
  EXPECT_EQ(largest[3], 0);
  EXPECT_NEAR(largest[4], 0.3, 1e-3);
}

TEST(changing_mesh, has_the_same_bytes_by_all_kinds_of_code) {
  for (int number = 0; number < 4; ++number) {
    Random random(static_cast<std::uint64_t>(number) + 70);
    Scene scene = random_scene(random, 8, true);
    for (int i = 0; i < 3; ++i) {
      Object one = object(wobbling(ball(), 0.05 + 0.1 * i, 1 + 9 * number));
      one.position = random.point(0.4) + Vec3{0, 0, 1.5};
      if (i == 1) one.velocity_m_per_s = random.point(2);
      if (i == 2) one.angular_velocity_rad_per_s = random.point(9);
      scene.objects.push_back(one);
    }
    const Camera camera = lit_camera(101, 37, 70);
    const auto frame = [&](Isa isa, bool culling, int threads) {
      return Simulator(scene, camera, {.seed = 3, .threads = threads, .isa = isa, .exposure_samples = 1 + number % 3, .culling = culling})
          .frame(4);
    };
    const Frame reference = frame(Isa::scalar, false, 1);
    for (const Isa isa : backend::isas_here)
      for (const bool culling : {false, true}) {
        if (!backend::can_run(isa)) continue;
        EXPECT_EQ(first_difference(frame(isa, culling, 2), reference), "") << number;
      }
  }
}

// How well positions are known follows from the mesh as it is at the beginning: three times as large as its triangles in the file, 0.4 m. That
// it is 30 m large in another frame changes nothing: each frame is the same whatever was computed before it.
TEST(changing_mesh, has_positions_as_well_known_in_all_frames) {
  const Scene scene = ball_scene(changing(ball(), [](double time_s, Corners& vertices, Corners&) {
    for (auto& v : vertices)
      for (float& x : v) x *= static_cast<float>(3 + 200 * time_s);
  }));
  scene::FrozenScene frozen(scene, {{0.3, 0, 0.4}}, 2);
  double reach = 0;
  for (const auto& v : std::get<Mesh>(scene.objects[1].shape).triangles->vertices)
    for (const float x : v) reach = std::fmax(reach, 3 * std::abs(static_cast<double>(x)));
  const float expected = frozen.view().roughness;
  EXPECT_NEAR(static_cast<double>(expected), scene::position_error * (0.5 + reach), 1e-12);
  frozen.look({}, {{0.1, 0.2}, 0, 0.1});
  frozen.derive();
  EXPECT_EQ(frozen.view().roughness, expected);
}

TEST(changing_mesh, that_gives_what_it_may_not_is_refused) {
  const auto refused = [](const By::Change& change, const std::string& message) {
    try {
      (void)Simulator(ball_scene(changing(ball(), change)), lit_camera(12, 9, 9)).frame(0);
      ADD_FAILURE() << "taken: " << message;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::bad_input);
      EXPECT_NE(std::string(e.what()).find(message), std::string::npos) << e.what();
    }
  };
  refused([](double, Corners& v, Corners&) { v.pop_back(); }, "in place of");
  refused([](double, Corners&, Corners& n) { n.clear(); }, "0 normals in place of");
  refused([](double t, Corners& v, Corners&) { v[0][1] = t > 0.01 ? std::numeric_limits<float>::quiet_NaN() : 0.0F; }, "beyond the world");
  refused([](double, Corners& v, Corners&) { v[3][0] = 2e5F; }, "beyond the world");
  refused([](double, Corners&, Corners& n) { n[7][0] = std::numeric_limits<float>::infinity(); }, "a normal that is none");
}

TEST(changing_mesh, is_refused_where_its_triangles_at_all_times_are_too_many) {
  const Scene scene = ball_scene(wobbling(ball(), 0.05, 3));
  Camera camera = lit_camera(12, 9, 9);
  const auto triangles = static_cast<double>(std::get<Mesh>(scene.objects[1].shape).triangles->triangles.size());
  const auto times = static_cast<double>(camera.mode.sequence.size());
  // As many samples as 20 million triangles allow; the mesh is counted once for two objects that share it.
  Scene two = scene;
  two.objects.push_back(scene.objects[1]);
  while (camera.mode.sequence.size() < 64) camera.mode.sequence.push_back(camera.mode.sequence.back());
  const int most = static_cast<int>(20e6 / (triangles * 64));
  ASSERT_GT(times, 0);
  ASSERT_LT(most, 1000);
  EXPECT_THROW(Simulator(two, camera, {.exposure_samples = most + 1}), Error);
  try {
    (void)Simulator(scene, camera, {.exposure_samples = most + 1});
    ADD_FAILURE();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::limit);
    EXPECT_NE(std::string(e.what()).find("lower exposure_samples (--exposure-samples)"), std::string::npos) << e.what();
  }
}
