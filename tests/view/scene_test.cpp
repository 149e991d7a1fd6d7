// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The scene in 3D: rays and triangles against what frames see.
#include <algorithm>
#include <fstream>
#include <limits>
#include <thread>

#include "support/text.h"
#include "view/viewer.h"

namespace tofray::test {
namespace {

using files::Json;
using Point = std::array<double, 3>;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The nearest distance of a point to a triangle, by Ericson's regions.
double distance_to(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp), d6 = dot(ac, cp);
  const auto away = [&](const Point& q) { return std::sqrt(dot(p - q, p - q)); };
  if (d1 <= 0 && d2 <= 0) return away(a);
  if (d3 >= 0 && d4 <= d3) return away(b);
  if (d6 >= 0 && d5 <= d6) return away(c);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return away(a + (d1 / (d1 - d3)) * ab);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return away(a + (d2 / (d2 - d6)) * ac);
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return away(b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b));
  return away(a + (vb / (va + vb + vc)) * ab + (vc / (va + vb + vc)) * ac);
}

/// Rows of a JSON rotation, and a position.
struct Pose {
  std::array<Point, 3> rows{};
  Point position{};
  [[nodiscard]] Point to_world(const Point& p) const { return Point{dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)} + position; }
  [[nodiscard]] Point from_world(const Point& p) const {
    const Point q = p - position;
    return q[0] * rows[0] + q[1] * rows[1] + q[2] * rows[2];
  }
};
Pose pose_of(const Json& json) { return {rows_of(*json.find("rotation")), three(*json.find("position"))}; }

/// An answer and the arrays behind it.
struct Scene3d {
  Json json;
  WireFrame arrays;
  [[nodiscard]] const std::vector<Json>& objects() const { return *json.find("objects")->items(); }
};
Scene3d scene_of(Page& page, int id = 1, const std::string& more = {}) {
  Scene3d out;
  out.json = page.answer(R"({"type":"view3d","id":)" + std::to_string(id) + more + "}", "view3d");
  EXPECT_EQ(*out.json.find("type")->string(), "view3d") << files::json_text(out.json);
  if (out.json.find("static") == nullptr || !*out.json.find("static")->boolean()) return out;
  const WsMessage next = page.next();
  EXPECT_EQ(next.opcode, 2) << "the arrays come right behind the text";
  if (next.opcode == 2) out.arrays = wire_frame(next.payload);
  return out;
}
bool is_fresh(const Scene3d& scene) { return *scene.json.find("static")->boolean(); }

/// All shapes, turned, shifted and before each other, and a camera that looks at them from aside.
constexpr const char* all_shapes =
    R"(camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000, pose: {position: [0.3, -0.4, -0.2], look_at: [0, 0.1, 2]}}
objects:
  - plane: {name: wall, point: [0.5, 0, 3], normal: [0.3, 0, -1], reflectivity: 0.5}
  - plane: {name: floor, point: [0, 1, 1], normal: [0, -1, 0], position: [0, 0.1, 0], rotation: {axis: [0, 0, 1], angle: 5 deg}, reflectivity: 0.5}
  - sphere: {name: ball, center: [-0.6, -0.4, 2], radius: 0.25 m, reflectivity: 0.5}
  - box: {min: [-0.2, -0.5, 1.9], max: [0.2, -0.2, 2.2], position: [0, 0.1, 0], rotation: {axis: [1, 1, 0], angle: 40 deg}, reflectivity: 0.5}
  - triangle: {vertices: [[0.3, -0.5, 2], [0.8, -0.5, 2.1], [0.6, -0.1, 2]], rotation: {axis: [0, 1, 0], angle: 20 deg}, reflectivity: 0.5}
  - cylinder: {center: [-0.6, 0.3, 2], axis: [1, 1, 0.4], radius: 0.15 m, height: 0.4 m, reflectivity: 0.5}
  - rectangle: {center: [0, 0.2, 2], size: [0.4 m, 0.3 m], rotation: {axis: [0, 1, 0], angle: 30 deg}, reflectivity: 0.5}
  - disk: {center: [0.5, 0.3, 2], normal: [0.5, 0, -1], radius: 0.2 m, rotation: {axis: [1, 0, 0], angle: 10 deg}, reflectivity: 0.5}
  - capsule: {start: [-0.4, 0.6, 2], end: [0, 0.65, 2.1], radius: 0.1 m, rotation: {axis: [0, 0, 1], angle: 15 deg}, reflectivity: 0.5}
  - cone: {base: [0.3, 0.9, 2], axis: [0, -1, 0.2], radius: 0.2 m, height: 0.35 m, velocity: [0.1 m/s, 0 m/s, 0 m/s], reflectivity: 0.5}
  - mesh: {file: "tofray:bumpy-ball", scale: 0.4, position: [0.8, 0.5, 2], rotation: {axis: [0, 1, 0], angle: 50 deg}, angular_velocity: [0 deg/s, 60 deg/s, 0 deg/s], reflectivity: 0.5}
)";

TEST(view3d, has_triangles_that_each_traced_point_lies_on) {
  NEEDS_THE_VIEWER;
  const Folder folder;
  std::ofstream(folder / "all.yaml") << all_shapes;
  const Viewer viewer({(folder / "all.yaml").native(), "--set", "camera.lens.fx=20 px", "--set", "camera.lens.fy=20 px"});
  Greeted one(viewer);
  one.page.send(R"({"type":"pause"})");
  one.page.send(R"({"type":"seek","frame":3})");
  one.page.want(R"("gt_object_id","gt_position_m","gt_z_m")");
  const auto frame = one.page.frame_with([](const WireFrame& each) { return each.frame == 3; });
  ASSERT_TRUE(frame);
  const Scene3d scene = scene_of(one.page);
  ASSERT_TRUE(is_fresh(scene));
  EXPECT_EQ(number_in(scene.json, "frame"), 3);
  ASSERT_EQ(scene.arrays.arrays.size(), 3u);
  const auto rays = numbers_of<float>(scene.arrays.arrays.at(0)), corners = numbers_of<float>(scene.arrays.arrays.at(1));
  const auto owners = numbers_of<std::uint32_t>(scene.arrays.arrays.at(2));
  ASSERT_EQ(corners.size(), 9 * owners.size());
  ASSERT_EQ(rays.size(), 2u * 28 * 22);
  EXPECT_TRUE(std::is_sorted(owners.begin(), owners.end()));
  ASSERT_EQ(scene.objects().size(), 11u);
  const Pose camera = pose_of(*scene.json.find("camera"));
  const auto ids = numbers_of<std::int32_t>(frame->arrays.at(number_of(one.hello, "gt_object_id")));
  const auto points = numbers_of<float>(frame->arrays.at(number_of(one.hello, "gt_position_m")));
  const auto depths = numbers_of<float>(frame->arrays.at(number_of(one.hello, "gt_z_m")));
  std::vector<int> seen(11, 0);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] < 0) continue;
    const auto id = static_cast<std::size_t>(ids[i]);
    const Point at{points[3 * i], points[3 * i + 1], points[3 * i + 2]};
    EXPECT_NEAR(at[0], depths[i] * rays[2 * i], 1e-5);
    EXPECT_NEAR(at[1], depths[i] * rays[2 * i + 1], 1e-5);
    const Point own = pose_of(scene.objects()[id]).from_world(camera.to_world(at));
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < owners.size(); ++k) {
      if (owners[k] != id) continue;
      const float* c = &corners[9 * k];
      nearest = std::min(nearest, distance_to(own, {c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}));
    }
    // Round shapes of 64 sides: (1 - cos(pi/64)) of a quarter metre, twice where they are round both ways.
    EXPECT_LT(nearest, id == 2 ? 7e-4 : 3.5e-4) << "object " << id << " in pixel " << i;
    ++seen[id];
  }
  for (std::size_t id = 0; id < 11; ++id) EXPECT_GT(seen[id], 0) << id;
}

TEST(view3d, says_what_there_is_and_where) {
  NEEDS_THE_VIEWER;
  const Folder folder;
  std::ofstream(folder / "all.yaml") << all_shapes;
  const Viewer viewer({(folder / "all.yaml").native(), "--set", "ambient={spectrum: sun_am15, level: 10 %, direction: [0, 3, 4]}"}, false);
  Greeted one(viewer);
  one.page.send(R"({"type":"pause"})");
  one.page.send(R"({"type":"seek","frame":2})");
  one.page.text("state");
  const Scene3d scene = scene_of(one.page);
  std::string kinds;
  for (const Json& each : scene.objects()) kinds += *each.find("kind")->string() + " ";
  EXPECT_EQ(kinds, "plane plane sphere box triangle cylinder rectangle disk capsule cone mesh ");
  EXPECT_EQ(*scene.objects()[2].find("name")->string(), "ball");
  EXPECT_EQ(*scene.objects()[2].find("key")->string(), "objects.2");
  EXPECT_TRUE(scene.objects()[0].find("bounds")->is_null());
  const auto& bounds = *scene.objects()[2].find("bounds")->items();
  const double expected[] = {-0.85, -0.65, 1.75, -0.35, -0.15, 2.25};
  for (std::size_t i = 0; i < 6; ++i) {
    double number = 0;
    bounds[i].number(number);
    EXPECT_NEAR(number, expected[i], 1e-12);
  }
  // What moves is where it is at the time of the truth.
  const double time = number_in(scene.json, "time_s");
  EXPECT_GT(time, 0.4);
  EXPECT_NEAR(three(*scene.objects()[9].find("position"))[0], 0.3 + 0.1 * time, 1e-12);
  const Pose mesh = pose_of(scene.objects()[10]);
  EXPECT_NEAR(std::atan2(mesh.rows[0][2], mesh.rows[0][0]), (50 + 60 * time) * std::acos(-1.0) / 180, 1e-9);
  const Pose camera = pose_of(*scene.json.find("camera"));
  EXPECT_EQ(camera.position, (Point{0.3, -0.4, -0.2}));
  const Point ahead = camera.to_world({0, 0, std::sqrt(dot(Point{0.3, -0.5, -2.2}, Point{0.3, -0.5, -2.2}))});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(ahead[i], (Point{0, 0.1, 2})[i], 1e-12) << "it looks there";
  // The light beside the lens, and the sun.
  const auto& lights = *scene.json.find("lights")->items();
  ASSERT_EQ(lights.size(), 2u);
  const Point beside = camera.from_world(three(*lights[0].find("position")));
  EXPECT_NEAR(beside[0], 0.01547, 1e-9);
  EXPECT_TRUE(*lights[0].find("camera")->boolean());
  EXPECT_GT(number_in(lights[0], "half_angle_rad"), 0.3);
  EXPECT_TRUE(lights[1].find("position")->is_null());
  const Point sun = three(*lights[1].find("direction"));
  EXPECT_NEAR(sun[1], 0.6, 1e-12);
  EXPECT_NEAR(sun[2], 0.8, 1e-12);
  // The image's corners lie half a pixel beyond the outermost rays.
  const auto rays = numbers_of<float>(scene.arrays.arrays.at(0));
  const auto& corners = *scene.json.find("frustum")->items();
  ASSERT_EQ(corners.size(), 4u);
  const auto corner = [&](std::size_t i, std::size_t k) {
    double out = 0;
    (*corners[i].items())[k].number(out);
    return out;
  };
  const auto ray = [&](std::size_t u, std::size_t v, std::size_t k) { return static_cast<double>(rays[2 * (v * 224 + u) + k]); };
  for (std::size_t i = 0; i < 4; ++i) {
    const bool at_right = i == 1 || i == 2, at_bottom = i >= 2;
    const std::size_t u = at_right ? 223 : 0, v = at_bottom ? 171 : 0, inner_u = at_right ? 222 : 1, inner_v = at_bottom ? 170 : 1;
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_NEAR(corner(i, k), 2 * ray(u, v, k) - 0.5 * (ray(inner_u, v, k) + ray(u, inner_v, k)), 5e-4) << i;
  }
}

TEST(view3d, sends_its_arrays_once_until_a_shape_or_the_lens_changes) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"demo"});
  Greeted one(viewer);
  const Scene3d first = scene_of(one.page, 7000000001 % 2147483647);
  ASSERT_TRUE(is_fresh(first));
  EXPECT_EQ(first.arrays.channel, 2);
  EXPECT_EQ(first.arrays.sequence, static_cast<std::uint32_t>(7000000001 % 2147483647));
  EXPECT_EQ(first.arrays.generation, 1u);
  EXPECT_EQ(files::json_text(*first.json.find("arrays")), R"(["rays","triangles","triangle_objects"])");
  EXPECT_FALSE(is_fresh(scene_of(one.page)));
  const auto set = [&](const char* key, const char* text) {
    const Json done = one.page.answer(std::string(R"({"type":"set","id":3,"key":")") + key + R"(","text":")" + text + "\"}");
    EXPECT_EQ(*done.find("type")->string(), "done") << files::json_text(done);
  };
  set("objects.26.sphere.position", "[0.1, 0, 0]");
  const Scene3d moved = scene_of(one.page);
  EXPECT_FALSE(is_fresh(moved)) << "its own frame moves with it";
  EXPECT_NEAR(three(*moved.objects()[26].find("position"))[0], -0.1, 1e-12);
  set("camera.pose.position", "[0, 0, -0.1]");
  EXPECT_FALSE(is_fresh(scene_of(one.page)));
  set("objects.26.sphere.radius", "5 cm");
  const Scene3d larger = scene_of(one.page);
  ASSERT_TRUE(is_fresh(larger));
  EXPECT_EQ(larger.arrays.generation, 4u);
  EXPECT_NE(larger.arrays.arrays.at(1), first.arrays.arrays.at(1));
  EXPECT_EQ(larger.arrays.arrays.at(0), first.arrays.arrays.at(0));
  set("camera.lens.fx", "27 px");
  const Scene3d longer = scene_of(one.page);
  ASSERT_TRUE(is_fresh(longer));
  EXPECT_NE(longer.arrays.arrays.at(0), first.arrays.arrays.at(0));
  EXPECT_FALSE(is_fresh(scene_of(one.page)));
  // Another page has nothing yet, and side B is another scene.
  Greeted other(viewer);
  EXPECT_TRUE(is_fresh(scene_of(other.page)));
  one.page.answer(R"({"type":"other","id":4,"overrides":[],"scene":"card"})");
  const Scene3d b = scene_of(one.page, 5, R"(,"side":"b")");
  ASSERT_TRUE(is_fresh(b));
  EXPECT_EQ(b.arrays.channel, 3);
  EXPECT_EQ(*b.json.find("side")->string(), "b");
  EXPECT_NE(b.objects().size(), first.objects().size());
  EXPECT_FALSE(is_fresh(scene_of(one.page)));
  EXPECT_FALSE(is_fresh(scene_of(one.page, 5, R"(,"side":"b")")));
}

TEST(view3d, of_very_many_objects_names_those_that_a_page_can_take) {
  NEEDS_THE_VIEWER;
  const Folder folder;
  std::ofstream file(folder / "many.yaml");
  file << "camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000}\nobjects:\n";
  constexpr int count = 6000;
  for (int i = 0; i < count; ++i)
    file << "  - rectangle: {name: card " << i << ", center: [" << i % 100 << ", " << i / 100
         << ", 90], size: [0.5 m, 0.5 m], reflectivity: 0.5}\n";
  file.close();
  const Viewer viewer({(folder / "many.yaml").native()});
  Greeted one(viewer);
  const Scene3d scene = scene_of(one.page);
  ASSERT_TRUE(is_fresh(scene));
  EXPECT_LT(files::json_text(scene.json).size(), 900'000u);
  EXPECT_GT(number_in(scene.json, "left_out"), 0);
  EXPECT_EQ(static_cast<double>(scene.objects().size()) + number_in(scene.json, "left_out"), count);
  EXPECT_EQ(numbers_of<std::uint32_t>(scene.arrays.arrays.at(2)).size(), 2u * count) << "all are drawn";
}

// A page that takes nothing for a while: each text has its arrays right behind it, or a later one's come in their place.
TEST(view3d, of_a_slow_page_keeps_texts_and_arrays_together) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"demo"}, false);
  Greeted one(viewer), quick(viewer);
  const int small = 65536;
  ::setsockopt(one.page.line().file(), SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
  constexpr int questions = 25;  // 1.7 MB each: more than what lies in sockets
  for (int k = 1; k <= questions; ++k) {
    quick.page.answer(R"({"type":"set","id":900,"key":"objects.26.sphere.radius","text":")" + std::to_string(4 + 0.01 * k) + " cm\"}");
    one.page.send(R"({"type":"view3d","id":)" + std::to_string(k) + "}");
    std::this_thread::sleep_for(milliseconds(5));
    quick.page.answer(R"({"type":"camera","id":901,"position":[0,0,0],"rotation":null})", "camera");  // … has been answered
  }
  int texts = 0, arrays = 0, last = 0;
  double behind = -1;  // the answer that has just come
  while (last < questions || behind >= 0) {
    const WsMessage message = one.page.next();
    ASSERT_GE(message.opcode, 0);
    if (message.opcode == 2) {
      EXPECT_EQ(wire_frame(message.payload).sequence, behind) << "right behind their answer";
      ++arrays, behind = -1;
      continue;
    }
    behind = -1;
    const Json json = message.json();
    if (*json.find("type")->string() != "view3d") continue;
    last = static_cast<int>(number_in(json, "id"));
    if (*json.find("static")->boolean()) ++texts, behind = last;
  }
  EXPECT_GT(arrays, 0);
  EXPECT_LT(arrays, texts) << "the page was not slow enough, or all its arrays waited";
}

}  // namespace
}  // namespace tofray::test
