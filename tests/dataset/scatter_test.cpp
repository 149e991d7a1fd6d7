// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Scattered objects: where they come to lie, what they keep clear of, what changes no draw, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "dataset/solids.h"
#include "files/sha256.h"
#include "support/samples.h"
#include "support/text.h"
#include "tofray/tofray.h"

namespace {

using namespace tofray;
using out_test::write_file;
using test::has;

class ScatterSet {
 public:
  explicit ScatterSet(const std::string& objects, const std::string& scene = "") {
    write_file(folder_.file("set.yaml"), "name: trial\nsamples: 1000\nseed: 3\nscene:\n" + scene + "  objects:\n" + objects);
  }
  [[nodiscard]] Dataset get() const { return Dataset(folder_.file("set.yaml")); }

 private:
  out_test::TemporaryFolder folder_;
};

const std::string table = "    - box: {name: table, min: [-50 cm, 10 cm, 70 cm], max: [50 cm, 14 cm, 1.3 m], reflectivity: 0.4}\n";
std::string scatter(const std::string& where, const std::string& more = "",
                    const std::string& of = "{sphere: {center: [0, 0, 0], radius: {uniform: [2 cm, 9 cm]}, reflectivity: 0.5}}") {
  return "    - scatter: {name: clutter, count: {integer: [3, 9]}, of: " + of + ", " + where + more + "}\n";
}

std::vector<const Object*> scattered(const Scene& scene) {
  std::vector<const Object*> out;
  for (const Object& one : scene.objects)
    if (one.name.starts_with("clutter[")) out.push_back(&one);
  return out;
}

double radius(const Object& ball) { return std::get<Sphere>(ball.shape).radius; }
double distance(const Object& a, const Object& b) {
  return std::hypot(a.position[0] - b.position[0], a.position[1] - b.position[1], a.position[2] - b.position[2]);
}

TEST(scatter, puts_balls_on_the_table_apart_from_each_other_and_from_what_stands_there) {
  const ScatterSet file(table + "    - sphere: {name: lamp, center: [0, 0, 1 m], radius: 10 cm, reflectivity: 0.9}\n" +
                        scatter("surface: table", ", gap: 5 mm"));
  const Dataset set = file.get();
  std::size_t count = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Scene scene = set.scene(i);
    const auto balls = scattered(scene);
    count += balls.size();
    for (const Object* ball : balls) {
      const double r = radius(*ball);
      EXPECT_NEAR(ball->position[1], 0.1 - r, 1e-9) << "it touches the table, whose upper side is at y = 0.1";
      EXPECT_LE(std::abs(ball->position[0]) + r, 0.5);
      EXPECT_GE(ball->position[2] - r, 0.7);
      EXPECT_LE(ball->position[2] + r, 1.3);
      EXPECT_GE(std::hypot(ball->position[0], ball->position[1], ball->position[2] - 1), 0.1 + r + 0.005);
      for (const Object* other : balls)
        if (other != ball) {
          EXPECT_GE(distance(*ball, *other), r + radius(*other) + 0.005 - 1e-12);
        }
    }
  }
  EXPECT_GT(count, 400U);
}

TEST(scatter, draws_its_count_and_places_evenly) {
  const ScatterSet file(table +
                        scatter("surface: table", ", tries: 1000", "{sphere: {center: [0, 0, 0], radius: 1 mm, reflectivity: 0.5}}"));
  const Dataset set = file.get();
  std::map<std::size_t, int> counts;
  double left = 0, near = 0, all = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Scene scene = set.scene(i);
    const auto balls = scattered(scene);
    ++counts[balls.size()];
    for (const Object* ball : balls) ++all, left += ball->position[0] < 0 ? 1 : 0, near += ball->position[2] < 1 ? 1 : 0;
  }
  EXPECT_EQ(counts.begin()->first, 3U);
  EXPECT_EQ(counts.rbegin()->first, 9U);
  EXPECT_EQ(counts.size(), 7U);
  EXPECT_NEAR(left / all, 0.5, 4.5 * 0.5 / std::sqrt(all));
  EXPECT_NEAR(near / all, 0.5, 4.5 * 0.5 / std::sqrt(all));
}

TEST(scatter, stands_upright_on_a_tilted_surface_and_turns_about_its_normal) {
  const ScatterSet file(
      "    - rectangle: {name: ramp, center: [0, 0, 1 m], size: [1 m, 1 m], rotation: {axis: [1, 0, 0], angle: 60 deg}, reflectivity: "
      "0.5}\n" +
      scatter("surface: ramp", ", turn: {uniform: [-30 deg, 30 deg]}",
              "{box: {min: [-1 cm, -4 cm, -2 cm], max: [1 cm, 4 cm, 2 cm], reflectivity: 0.5}}"));
  const Dataset set = file.get();
  const double c = 0.5, s = std::sqrt(0.75);
  // Half a metre square, turned by 60 degrees about x: its normal that points up (−y) is (0, −sin 60°…): z × of the rectangle.
  const Vec3 normal{0, -s, c};
  for (std::uint64_t i = 0; i < 50; ++i) {
    const Scene scene = set.scene(i);
    for (const Object* box : scattered(scene)) {
      const auto own = dataset::own_box(*box);
      ASSERT_TRUE(own);
      // Height of each corner over the surface: four touch it.
      const dataset::Mat turn = dataset::matrix_of(box->rotation);
      std::vector<double> heights;
      for (int k = 0; k < 8; ++k) {
        const dataset::Vec p = turn * dataset::Vec{(k & 1) != 0 ? 0.01 : -0.01, (k & 2) != 0 ? 0.04 : -0.04, (k & 4) != 0 ? 0.02 : -0.02} +
                               dataset::vec(box->position);
        heights.push_back(std::abs(p.x * normal[0] + p.y * normal[1] + (p.z - 1) * normal[2]));
      }
      std::sort(heights.begin(), heights.end());
      EXPECT_LT(heights[3], 1e-9);
      EXPECT_NEAR(heights[4], 0.08, 1e-9);
    }
  }
}

TEST(scatter, floats_in_a_box_or_in_what_the_camera_sees_on_the_cameras_side_of_walls) {
  const std::string wall = "    - plane: {name: wall, point: [0, 0, 2 m], reflectivity: 0.5}\n";
  const ScatterSet in_box(wall + scatter("box: [[-10 cm, -20 cm, 1 m], [30 cm, 20 cm, 1.5 m]]"));
  const ScatterSet in_view(wall + scatter("view: [0.5 m, 4 m]"));
  const Dataset boxes = in_box.get(), views = in_view.get();
  double seen = 0, all = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Scene a = boxes.scene(i), b = views.scene(i);
    for (const Object* ball : scattered(a))
      for (int k = 0; k < 3; ++k) {
        const double low[] = {-0.1, -0.2, 1}, high[] = {0.3, 0.2, 1.5};
        EXPECT_GE(ball->position[static_cast<std::size_t>(k)], low[k]);
        EXPECT_LE(ball->position[static_cast<std::size_t>(k)], high[k]);
      }
    for (const Object* ball : scattered(b)) {
      EXPECT_LE(ball->position[2] + radius(*ball), 2 + 1e-12);
      EXPECT_GE(ball->position[2], 0.5);
      // The middle of the ball is in the image of pico-flexx's pinhole: 224 x 172 pixels at 212 px.
      const double u = 212 * ball->position[0] / ball->position[2] + 111.5, v = 212 * ball->position[1] / ball->position[2] + 85.5;
      ++all, seen += u >= -0.5 && u <= 223.5 && v >= -0.5 && v <= 171.5 ? 1 : 0;
    }
  }
  EXPECT_EQ(seen, all);
}

TEST(scatter, of_another_name_or_count_changes_no_draw_of_others) {
  const auto others = [](const std::string& more) {
    const ScatterSet file(table + scatter("surface: table") +
                          "    - sphere: {name: lamp, center: [{uniform: [-1 m, 1 m]}, -1 m, 2 m], radius: 10 cm, reflectivity: 0.9}\n" +
                          more);
    std::map<std::string, std::string> out;
    for (const Drawn& one : file.get().drawn(7))
      if (!one.path.starts_with("objects/more")) out[one.path] = one.text;
    return out;
  };
  const std::string more =
      "    - scatter: {name: more, count: 4, of: {sphere: {center: [0, 0, 0], radius: 1 cm, reflectivity: 1}}, box: [[2 m, 2 m, 2 m], [3 "
      "m, 3 m, 3 m]]}\n";
  EXPECT_EQ(others(""), others(more));
  const ScatterSet few(
      table +
      "    - scatter: {name: clutter, count: 3, of: {sphere: {center: [0, 0, 0], radius: {uniform: [2 cm, 9 cm]}, reflectivity: "
      "0.5}}, surface: table}\n");
  const ScatterSet many(
      table +
      "    - scatter: {name: clutter, count: 6, of: {sphere: {center: [0, 0, 0], radius: {uniform: [2 cm, 9 cm]}, reflectivity: "
      "0.5}}, surface: table}\n");
  const Scene a = few.get().scene(1), b = many.get().scene(1);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(scattered(a)[k]->position, scattered(b)[k]->position) << "those before come first";
}

TEST(scatter, that_finds_no_room_is_dropped_and_told_or_fails) {
  const std::string of = "{box: {min: [-20 cm, -5 cm, -20 cm], max: [20 cm, 5 cm, 20 cm], reflectivity: 0.5}}";
  const ScatterSet dropped(table + "    - scatter: {name: clutter, count: 5, of: " + of + ", surface: table, tries: 20}\n");
  const Scene scene = dropped.get().scene(0);
  const auto drawn = dropped.get().drawn(0);
  const auto without =
      std::count_if(drawn.begin(), drawn.end(), [](const Drawn& one) { return one.form == "scatter" && one.text.empty(); });
  EXPECT_GE(without, 3) << "no more than two of 40 x 40 cm on 100 x 60 cm";
  EXPECT_EQ(static_cast<std::ptrdiff_t>(scattered(scene).size()), 5 - without);
  const ScatterSet failing(table + "    - scatter: {name: clutter, count: 5, of: " + of + ", surface: table, tries: 20, unplaced: fail}\n");
  const Error error = out_test::error_of([&] { (void)failing.get().scene_yaml(0); });
  EXPECT_TRUE(has(error.what(), "set.yaml:7:") && has(error.what(), "of 5 finds no room in 20 tries")) << error.what();
}

TEST(scatter, that_finds_no_room_draws_the_sample_again_where_it_is_told) {
  const std::string of = "{box: {min: [-6 cm, -5 cm, -6 cm], max: [6 cm, 5 cm, 6 cm], reflectivity: 0.5}}";
  const auto again = [&](const char* count) {
    return ScatterSet(table + "    - scatter: {name: clutter, count: " + count + ", of: " + of +
                      ", surface: table, tries: 1, unplaced: again}\n");
  };
  const ScatterSet two = again("2");
  std::set<double> attempts;
  for (std::uint64_t i = 0; i < 10; ++i) {
    EXPECT_EQ(scattered(two.get().scene(i)).size(), 2U) << "all of them, or another attempt";
    attempts.insert(two.get().drawn(i).back().value);
  }
  EXPECT_GT(attempts.size(), 2U) << "some find room at once, others do not";
  const ScatterSet five = again("60");
  const Error error = out_test::error_of([&] { (void)five.get().scene_yaml(0); });
  EXPECT_TRUE(has(error.what(), "set.yaml:7:") && has(error.what(), "find no room in sample 0") &&
              has(error.what(), "in 50 of 50 attempts"))
      << error.what();
}

TEST(scatter, that_makes_no_sense_is_refused_where_it_stands) {
  const std::string ball = "{sphere: {center: [0, 0, 0], radius: 5 cm, reflectivity: 0.5}}";
  const std::string plane =
      "    - plane: {name: floor, point: [0, 1 m, 0], normal: [0, -1, 0], reflectivity: 0.5}\n    - sphere: {name: globe, center: [0, 0, "
      "1], radius: 5 cm, reflectivity: 0.5}\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"{name: a, count: 2, of: " + ball + "}", "scatter does not say where"},
      {"{name: a, count: 2, of: " + ball + ", surface: floor, view: [1 m, 2 m]}", "scatter does not say where"},
      {"{name: a, count: 2, of: " + ball + ", surface: flour}",
       "there is no object \"flour\" for things to lie on; did you mean \"floor\""},
      {"{name: a, count: 2, of: " + ball + ", surface: floor}", "\"floor\" has no end"},
      {"{name: a, count: 2, of: " + ball + ", surface: \"a[0]\"}", "the scene has floor and globe"},
      {"{name: a, count: 2, of: " + ball + ", surface: globe}", "\"globe\" has no flat side"},
      {"{name: a, count: 2, of: " + ball + ", surface: floor, within: 0 m}", "`within` is not above 0"},
      {"{name: a, count: 2, of: " + ball + ", view: [1 m, 2 m], within: 1 m}", "`within` stands beside something else"},
      {"{name: a, count: 1001, of: " + ball + ", view: [1 m, 2 m]}", "count"},
      {"{name: a, count: 1e9, of: " + ball + ", view: [1 m, 2 m]}", "count"},
      {"{name: a, count: 2.5, of: " + ball + ", view: [1 m, 2 m]}", "count"},
      {"{name: a, count: 2 m, of: " + ball + ", view: [1 m, 2 m]}", "expected a whole number"},
      {"{name: a, count: 2, of: " + ball + ", view: [2 m, 1 m]}", "the nearer one first"},
      {"{name: a, count: 2, of: " + ball + ", view: [-1 m, 1 m]}", "the nearer one first"},
      {"{name: a, count: 2, of: " + ball + ", view: 1 m}", "wrong length"},
      {"{name: a, count: 2, of: " + ball + ", box: [[0, 0, 0], [1 m, -1 m, 1 m]]}", "box ends before it begins"},
      {"{name: a, count: 2, of: " + ball + ", view: [1 m, 2 m], gap: -1 mm}", "gap is below 0"},
      {"{name: a, count: 2, of: " + ball + ", view: [1 m, 2 m], tries: 0}", "tries"},
      {"{name: a, count: 2, of: " + ball + ", view: [1 m, 2 m], unplaced: perhaps}", "expected drop, again or fail"},
      {"{name: a, count: 2, of: " + ball + ", view: [1 m, 2 m], turns: 3}", "unknown key \"turns\" in scatter; did you mean \"turn\""},
      {"{count: 2, of: " + ball + ", view: [1 m, 2 m]}", "scatter lacks the key name"},
      {"{name: a, of: " + ball + ", view: [1 m, 2 m]}", "scatter lacks the key count"},
      {"{name: a, count: 2, view: [1 m, 2 m]}", "scatter lacks the key of"},
      {"{name: a, count: 2, of: 5, view: [1 m, 2 m]}", "`of` is no object"},
      {"{name: a, count: 2, of: {sphere: {center: [0, 0, 0], radius: 5 cm, reflectivity: 0.5, name: b}}, view: [1 m, 2 m]}",
       "a name of its own"},
      {"{name: a, count: 2, of: {sphere: {center: [0, 0, 0], radius: 5 cm, reflectivity: 0.5, position: [0, 0, 1]}}, view: [1 m, 2 m]}",
       "a position of its own"},
      {"{name: a, count: 2, of: {plane: {point: [0, 0, 1], reflectivity: 0.5}}, view: [1 m, 2 m]}", "a plane has no end"},
      {"5", "scatter is not what belongs here"},
  };
  for (const auto& [what, message] : cases) {
    const ScatterSet file(plane + "    - scatter: " + what + "\n");
    const Error error = out_test::error_of([&] { (void)file.get().scene_yaml(0); });
    EXPECT_TRUE(has(error.what(), message)) << what << "\n" << error.what();
    EXPECT_TRUE(has(error.what(), "set.yaml:8:")) << error.what();
  }
}

TEST(scatter, gives_the_same_bytes_with_every_compiler_and_processor) {
  const ScatterSet file(
      table +
      "    - rectangle: {name: ramp, center: [0, 0, 2 m], size: [1 m, 1 m], rotation: {axis: [1, 0.3, 0], angle: 60 deg}, "
      "reflectivity: 0.5}\n" +
      scatter("surface: table", ", gap: 5 mm",
              "{choice: [{sphere: {center: [0, 0, 0], radius: {uniform: [2 cm, 9 cm]}, reflectivity: 0.5}}, {cylinder: {center: "
              "[0, 0, 0], axis: [0, 1, 0.2], height: 10 cm, radius: 3 cm, "
              "rotation: any, reflectivity: 0.5}}]}") +
      "    - scatter: {name: more, count: 3, of: {cone: {base: [0, 0, 0], axis: [0, -1, 0], height: 10 cm, radius: 4 cm, "
      "reflectivity: 0.5}}, surface: ramp}\n"
      "    - scatter: {name: flying, count: 3, of: {capsule: {start: [0, 0, 0], end: [0, 5 cm, 2 cm], radius: 2 cm, "
      "reflectivity: 0.5}}, view: [0.5 m, 3 m]}\n");
  const Dataset set = file.get();
  std::string all;
  for (std::uint64_t i = 0; i < 200; ++i) all += set.scene_yaml(i);
  EXPECT_EQ(files::sha256_hex(all), "d3fb2727f9f0a86e2e079f88eb653555c0ea123ff6c7f381d0be5035bac3f0a2");
}

TEST(solids, are_apart_where_an_axis_tells_them_apart) {
  using dataset::Solid;
  const Solid a{{0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {1, 1, 1}};
  Solid b{{2.5, 0, 0}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {1, 1, 1}};
  EXPECT_TRUE(dataset::apart(a, b, 0));
  EXPECT_TRUE(dataset::apart(a, b, 0.5));
  EXPECT_FALSE(dataset::apart(a, b, 0.51));
  // Turned by 45 degrees about two axes: only the cross product of two edges tells them apart.
  const double s = std::sqrt(0.5);
  b = {{2.2, 2.2, 0}, {{{s, s, 0}, {-s, s, 0}, {0, 0, 1}}}, {1, 1, 1}};
  EXPECT_TRUE(dataset::apart(a, b, 0));
  b.center = {1.6, 1.6, 0};
  EXPECT_FALSE(dataset::apart(a, b, 0));
  const Solid edge{{0, 0, 0}, {{{s, s, 0}, {-s, s, 0}, {0, 0, 1}}}, {1, 1, 5}};
  Solid across{{2.9, 0, 0}, {{{s, 0, s}, {0, 1, 0}, {-s, 0, s}}}, {1, 5, 1}};
  EXPECT_TRUE(dataset::apart(edge, across, 0)) << "their edges are 2.83 from each other's middle";
  across.center = {2.8, 0, 0};
  EXPECT_FALSE(dataset::apart(edge, across, 0));
}

}  // namespace
