// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Sets: what their forms make of a scene, what changes no draw, and what is refused.
#include "tofray/dataset.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <map>

#include "files/sha256.h"
#include "support/samples.h"
#include "support/text.h"
#include "tofray/tofray.h"

namespace {

using namespace tofray;
using out_test::write_file;
using test::has;

/// A set's file in a folder of its own.
class Written {
 public:
  explicit Written(const std::string& text) { write_file(folder_.file("set.yaml"), text); }
  [[nodiscard]] Dataset set() const { return Dataset(folder_.file("set.yaml")); }
  [[nodiscard]] const out_test::TemporaryFolder& folder() const { return folder_; }

 private:
  out_test::TemporaryFolder folder_;
};

std::string set_of(const std::string& objects, const std::string& more = "") {
  return "name: trial\nsamples: 400\nseed: 3\n" + more + "scene:\n  objects:\n" + objects;
}
const char* const ball =
    "    - sphere: {name: ball, center: [{uniform: [-30 cm, 30 cm]}, 0, 2 m], radius: {uniform: [5 cm, 15 cm]}, reflectivity: 0.5}\n";

std::map<std::string, Drawn> drawn(const Dataset& set, std::uint64_t sample, std::uint64_t view = 0) {
  std::map<std::string, Drawn> out;
  for (const Drawn& one : set.drawn(sample, view)) EXPECT_TRUE(out.emplace(one.path, one).second) << one.path;
  return out;
}

std::string fault_of(const std::string& text, std::uint64_t sample = 0) {
  try {
    (void)Written(text).set().scene_yaml(sample);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(set, writes_a_scene_whose_values_are_those_drawn) {
  const Written file(set_of(ball, "let: {wall: {uniform: [1 m, 3 m]}}\n") +
                     "    - plane: {point: [0, 0, \"= wall + 50 cm\"], reflectivity: {choice: {20 %: 1, 60 %: 3}}}\n");
  const Dataset set = file.set();
  EXPECT_EQ(set.samples(), 400U);
  for (const std::uint64_t sample : {0, 1, 399}) {
    const auto values = drawn(set, sample);
    const Scene scene = set.scene(sample);
    const auto& sphere = std::get<Sphere>(scene.objects.at(0).shape);
    EXPECT_DOUBLE_EQ(sphere.center[0], values.at("objects/ball/center[0]").value / 100);
    EXPECT_DOUBLE_EQ(sphere.radius, values.at("objects/ball/radius").value / 100);
    EXPECT_DOUBLE_EQ(std::get<Plane>(scene.objects.at(1).shape).point[2], values.at("let/wall").value + 0.5);
    EXPECT_EQ(values.at("objects[1]/reflectivity").text, values.at("objects[1]/reflectivity").value == 0 ? "20 %" : "60 %");
    // What it writes is read as the same scene, and needs no set.
    write_file(file.folder().file("one.yaml"), set.scene_yaml(sample));
    const Scene again = load_scene(file.folder().file("one.yaml"));
    EXPECT_EQ(std::get<Sphere>(again.objects.at(0).shape).radius, sphere.radius);
  }
}

TEST(set, draws_the_same_whatever_else_is_in_its_file) {
  const auto before = drawn(Written(set_of(ball)).set(), 17);
  const std::string other =
      "    - sphere: {name: other, center: [{uniform: [0, 1 m]}, 0, 3 m], radius: 10 cm, reflectivity: {uniform: [0, 1]}}\n";
  const auto behind = drawn(Written(set_of(ball + other)).set(), 17), in_front = drawn(Written(set_of(other + ball)).set(), 17);
  const auto more = drawn(Written(set_of(ball, "let: {a: {uniform: [0, 1]}}\nset: {camera.lens.f_number: {uniform: [1, 2]}}\n")).set(), 17);
  EXPECT_EQ(before.size(), 2U);
  EXPECT_EQ(behind.size(), 4U);
  for (const auto* one : {&behind, &in_front, &more})
    for (const auto& [path, value] : before) EXPECT_EQ(one->at(path).text, value.text) << path;
  // Another seed, sample or name draws another value.
  EXPECT_NE(drawn(Written(set_of(ball)).set(), 18).at("objects/ball/radius").text, before.at("objects/ball/radius").text);
  std::string renamed = set_of(ball);
  renamed.replace(renamed.find("name: ball"), 10, "name: pall");
  EXPECT_NE(drawn(Written(renamed).set(), 17).at("objects/pall/radius").text, before.at("objects/ball/radius").text);
}

TEST(set, draws_anew_for_what_per_says) {
  const std::string text = set_of(ball,
                                  "views: 3\ndevices: 4\nset:\n  camera.lens.fx: {uniform: [209 px, 215 px], per: device}\n  "
                                  "ambient.level: {uniform: [1 %, 5 %], per: set}\n"
                                  "  camera.lens.f_number: {uniform: [1, 2], per: view}\n") +
                           "  camera: {pose: {position: {uniform: [[0, 0, 0], [1 cm, 1 cm, 1 cm]]}}}\n";
  const Dataset set = Written(text).set();
  const auto a = drawn(set, 5, 0), b = drawn(set, 5, 1), c = drawn(set, 9, 0), d = drawn(set, 6, 0);
  const auto same = [](const auto& x, const auto& y, const char* path) { return x.at(path).text == y.at(path).text; };
  EXPECT_TRUE(same(a, b, "set/camera.lens.fx") && same(a, c, "set/camera.lens.fx") && !same(a, d, "set/camera.lens.fx"));
  EXPECT_TRUE(same(a, b, "set/ambient.level") && same(a, c, "set/ambient.level") && same(a, d, "set/ambient.level"));
  EXPECT_TRUE(!same(a, b, "set/camera.lens.f_number") && !same(a, c, "set/camera.lens.f_number"));
  EXPECT_TRUE(same(a, b, "objects/ball/radius") && !same(a, c, "objects/ball/radius"));
  EXPECT_FALSE(same(a, b, "camera/pose/position[0]"));
  // Specimens have fixed patterns of their own; noise is another one in each view.
  const std::string one = set.scene_yaml(5, 0), other = set.scene_yaml(6, 0), again = set.scene_yaml(9, 2);
  const auto seed = [](const std::string& yaml) { return yaml.substr(yaml.find("patterns:"), 40); };
  EXPECT_NE(seed(one), seed(other));
  EXPECT_EQ(seed(one), seed(again));
  std::string by_frame = text;
  by_frame.replace(by_frame.find("per: view"), 9, "per: frame");  // a view has one
  EXPECT_EQ(Written(by_frame).set().scene_yaml(5, 1), set.scene_yaml(5, 1));
  EXPECT_NE(set.noise_seed(5, 0), set.noise_seed(5, 1));
  EXPECT_NE(set.noise_seed(5, 0), set.noise_seed(6, 0));
}

TEST(set, of_grids_has_each_combination_once) {
  const Dataset set = Written(set_of("    - sphere: {name: a, center: [0, 0, {grid: {from: 1 m, to: 3 m, n: 5}}], radius: {grid: [10 cm, "
                                     "20 cm, 30 cm]}, reflectivity: {grid: [10 %, 90 %]}}\n"))
                          .set();
  EXPECT_EQ(set.combinations(), 30U);
  std::map<std::string, int> seen;
  for (std::uint64_t i = 0; i < 30; ++i) {
    std::string all;
    for (const auto& [path, one] : drawn(set, i)) all += one.text + "|";
    ++seen[all];
  }
  EXPECT_EQ(seen.size(), 30U);
  EXPECT_EQ(set.scene_yaml(7), set.scene_yaml(37));
  EXPECT_EQ(drawn(set, 0).at("objects/a/center[2]").text, "1 m");
  EXPECT_EQ(drawn(set, 29).at("objects/a/center[2]").text, "3 m");
}

TEST(set, draws_evenly_over_all_samples) {
  const Dataset set =
      Written(set_of("    - sphere: {name: a, center: [0, 0, {even: [1 m, 5 m]}], radius: 10 cm, reflectivity: 0.5}\n")).set();
  std::vector<int> strata(400);
  for (std::uint64_t i = 0; i < 400; ++i)
    strata.at(static_cast<std::size_t>((drawn(set, i).at("objects/a/center[2]").value - 1) * 100)) += 1;
  EXPECT_EQ(std::count(strata.begin(), strata.end(), 1), 400);
}

TEST(set, draws_rows_of_a_table_and_files) {
  const Written file(
      set_of("    - sphere: {name: a, center: [0, 0, 2 m], radius: \"= thing.radius\", material: \"= thing.material\"}\n    - mesh: {name: "
             "m, file: {files: \"parts/*.obj\"}, reflectivity: 0.5}\n",
             "let:\n  wall: {uniform: [1 m, 2 m]}\n  thing: {table: things.csv}\n"));
  write_file(file.folder().file("things.csv"), "radius, material\n5 cm, wood\n20 cm, paper\n# a remark\n");
  std::filesystem::create_directory(file.folder().file("parts"));
  write_file(file.folder().file("parts/b.obj"), "v 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n");
  write_file(file.folder().file("parts/a.obj"), "v 0 0 2\nv 1 0 2\nv 0 1 2\nf 1 2 3\n");
  write_file(file.folder().file("parts/c.txt"), "none");
  const Dataset set = file.set();
  std::map<std::string, int> rows, meshes;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const std::string yaml = set.scene_yaml(i);
    EXPECT_TRUE((has(yaml, "radius: 0.05 m") && has(yaml, "material: wood")) ||
                (has(yaml, "radius: 0.2 m") && has(yaml, "material: paper")))
        << yaml;
    ++rows[drawn(set, i).at("let/thing").text], ++meshes[drawn(set, i).at("objects/m/file").text];
  }
  EXPECT_EQ(rows.size(), 2U);
  EXPECT_EQ(meshes, (std::map<std::string, int>{{"parts/a.obj", 200}, {"parts/b.obj", 200}}));
  // The order is of contents, not of names: the same files by other names are drawn alike.
  const auto before = set.drawn(3);
  const Scene scene = set.scene(3);
  std::filesystem::rename(file.folder().file("parts/a.obj"), file.folder().file("parts/z.obj"));
  const auto after = file.set().drawn(3);
  EXPECT_EQ(before.back().value, after.back().value);
  EXPECT_EQ(std::get<Mesh>(scene.objects.at(1).shape).triangles->vertices.size(), 3U);
}

TEST(set, turns_and_points_evenly) {
  const Dataset set =
      Written(
          "name: t\nsamples: 20000\nscene:\n  ambient: {illuminance: 1 klx, direction: {cap: {around: [1, 2, -2], within: 60 deg}}}\n  "
          "objects:\n    - rectangle: {name: r, center: [0, 0, 2], size: [1, 1], rotation: any, reflectivity: 0.5}\n")
          .set();
  // On a cap cos θ is even from cos 60° to 1; of rotations the mean of each entry of the matrix is 0 and of its square 1/3.
  double mean = 0, entry = 0, square = 0;
  constexpr int count = 4000;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Scene scene = set.scene(i);
    const Vec3 d = *scene.ambient.direction;
    const double cosine = (d[0] + 2 * d[1] - 2 * d[2]) / 3 / std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    EXPECT_GE(cosine, 0.5 - 1e-12);
    mean += cosine / count;
    const Quaternion q = scene.objects.at(0).rotation.quaternion.value();
    const double zz = 1 - 2 * (q[0] * q[0] + q[1] * q[1]);
    entry += zz / count, square += zz * zz / count;
  }
  EXPECT_NEAR(mean, 0.75, 5 * 0.25 / std::sqrt(3.0 * count));
  EXPECT_NEAR(entry, 0, 5 / std::sqrt(3.0 * count));
  EXPECT_NEAR(square, 1.0 / 3, 5 * 0.3 / std::sqrt(1.0 * count));
}

TEST(set, leaves_a_key_out_by_chance) {
  const Dataset set = Written(set_of("    - sphere: {name: a, center: [0, 0, 2 m], radius: 10 cm, reflectivity: 0.5}\n",
                                     "set: {camera.sensor.global_shutter: {chance: 30 %}}\n"))
                          .set();
  int there = 0;
  for (std::uint64_t i = 0; i < 400; ++i) there += drawn(set, i).at("set/camera.sensor.global_shutter").text == "true" ? 1 : 0;
  EXPECT_NEAR(there, 120, 5 * std::sqrt(400 * 0.21));
}

TEST(set, computes_with_units) {
  const std::string let = "let: {a: 2 m, b: 30 cm, n: 4, v: 3 m/s, word: paper}\n";
  const auto ball_of = [&](const std::string& expression) {
    return set_of("    - sphere: {name: a, center: [0, 0, 200 m], radius: \"=" + expression + "\", reflectivity: 0.5}\n", let);
  };
  const auto fault = [&](const std::string& expression) { return fault_of(ball_of(expression)); };
  const auto radius = [&](const std::string& expression) {
    return std::get<Sphere>(Written(ball_of(expression)).set().scene(0).objects.at(0).shape).radius;
  };
  EXPECT_DOUBLE_EQ(radius(" a - b"), 1.7);
  EXPECT_DOUBLE_EQ(radius("a-b*2 + 10cm"), 1.5);
  EXPECT_DOUBLE_EQ(radius("min(a, b, 5 m) / (n - 1)"), 0.1);
  EXPECT_DOUBLE_EQ(radius("sqrt(a*a + b*b)"), std::sqrt(4.09));
  EXPECT_DOUBLE_EQ(radius("v * 20 ms + max(0, -a)"), 0.06);
  EXPECT_DOUBLE_EQ(radius("a * 50 %"), 1.0);
  EXPECT_DOUBLE_EQ(radius("- - 1.5e-1 m"), 0.15);
  EXPECT_TRUE(has(fault("a + n"), "a sum of a length and a bare number"));
  EXPECT_TRUE(has(fault("a * b"), "length^2"));
  EXPECT_TRUE(has(fault("sqrt(a)"), "a square root of a length"));
  EXPECT_TRUE(has(fault("c + 1 m"), "\"c\" is no name of `let`")) << fault("c + 1 m");
  EXPECT_TRUE(has(fault("word + 1 m"), "\"paper\" is no number"));
  EXPECT_TRUE(has(fault("a / (n - 4)"), "divides by 0"));
  EXPECT_TRUE(has(fault("a -"), "ends too early"));
  EXPECT_TRUE(has(fault("(a"), "\")\" is missing"));
  EXPECT_TRUE(has(fault("a; b"), "\";\" is not what belongs there"));
  EXPECT_TRUE(has(fault(std::string(200, '(')), "nested too deeply"));
}

TEST(set, that_is_wrong_is_refused_with_its_line_and_column) {
  const auto in_scene = [](const std::string& radius, const std::string& more = "") {
    return fault_of(set_of("    - sphere: {name: a, center: [0, 0, 2 m], radius: " + radius + ", reflectivity: 0.5}\n", more));
  };
  const std::pair<std::string, std::string> faults[] = {
      {in_scene("{uniform: [3 cm, 1 cm]}"), "set.yaml:6:"},
      {in_scene("{uniform: [3 cm, 1 cm]}"), "the lower end first"},
      {in_scene("{uniform: [1 cm, 3 s]}"), "\"1 cm\" and \"3 s\""},
      {in_scene("{uniform: [1 cm]}"), "a list of 2 numbers"},
      {in_scene("{uniform: 1 cm}"), "a list of 2 numbers"},
      {in_scene("{uniform: [1 cm, 3 cmm]}"), "\"cmm\" is no unit"},
      {in_scene("{uniform: [1 cm, much]}"), "\"much\" is no number"},
      {in_scene("{uniform: [1 cm, 3 cm], pre: view}"), "did you mean \"per\""},
      {in_scene("{uniform: [1 cm, 3 cm], per: week}"), "expected set, device, scene, view or frame"},
      {in_scene("{uniform: [1 cm, 3 cm], within: [1 cm, 2 cm]}"), "`within` stands beside uniform"},
      {in_scene("{uniform: [1 cm, 3 cm], weights: [1, 2]}"), "`weights` stands beside uniform"},
      {in_scene("{uniform: [1 cm, 3 cm], even: [1 cm, 2 cm]}"), "two forms stand in one map"},
      {in_scene("{uniform: [1 s, 3 s]}"), "radius is a time, not a length"},
      {in_scene("{log_uniform: [0 cm, 3 cm]}"), "ends above 0"},
      {in_scene("{normal: [1 cm, -3 cm]}"), "a sigma that is not below 0"},
      {in_scene("{normal: [1 cm, 3 cm], within: [3 cm, 3 cm]}"), "the lower end first"},
      {in_scene("{integer: [1.5, 3]}"), "whole numbers"},
      {in_scene("{choice: []}"), "a list [a, b]"},
      {in_scene("{choice: [1 cm, 2 cm], weights: [1]}"), "weights: a list of 2"},
      {in_scene("{choice: [1 cm, 2 cm], weights: [0, 0]}"), "a weight that is not 0"},
      {in_scene("{choice: {1 cm: -1, 2 cm: 1}}"), "a weight, such as 3"},
      {in_scene("{chance: 130 %}"), "a share from 0 to 1"},
      {in_scene("{grid: []}"), "a grid has no values"},
      {in_scene("{grid: {from: 1 cm, to: 2 cm, n: 0}}"), "a grid has no values"},
      {in_scene("{choice: [{grid: [1 cm, 2 cm]}, 3 cm]}"), "a grid stands in a choice"},
      {in_scene("{table: none.csv}"), "none.csv"},
      {in_scene("{files: \"*.none\"}"), "no file matches"},
      {in_scene("{files: \"../*.obj\"}"), "beside the set's file or below"},
      {in_scene("\"= a\"", "let: {a: \"= b\", b: \"= a\"}\n"), "is made of itself"},
      {in_scene("\"= a\"", "let: {a: [1, 2]}\n"), "is no single value"},
      {in_scene("1 cm", "let: {min: 3}\n"), "is no name for an expression"},
      {in_scene("-1 cm"), "set.yaml:6:"},
      {fault_of(set_of(std::string(ball) + ball)), "two values have one path, \"objects/ball/center[0]\""},
      {fault_of(set_of("    - {chance: 30 %}\n")), "a chance stands in a list"},
      {fault_of("objects: []\n"), "this is a scene, not a data set"},
      {fault_of("name: a\nsamples: 0\nscene: {objects: []}\n"), "samples"},
      {fault_of("name: a\nsamples: 4\nviews: 1000\nscene: {objects: []}\n"), "views"},
      {fault_of("name: a\nsamples: 4\nscene: [1]\n"), "expected a map with the keys of a scene"},
      {fault_of("name: a\nsample: 4\nscene: {}\n"), "did you mean \"samples\""},
      {fault_of(set_of(ball), 400), "there is no sample 400"},
  };
  for (const auto& [fault, part] : faults) EXPECT_TRUE(has(fault, part)) << part << "\n" << fault;
}

TEST(set, form_in_a_plain_scene_is_refused_with_a_hint) {
  for (const char* value : {"{uniform: [1 cm, 3 cm]}", "{choice: [1 cm, 2 cm]}", "\"= wall\""}) {
    try {
      (void)load_scene_text(std::string("objects: [{sphere: {center: [0, 0, 1], radius: ") + value + ", reflectivity: 0.5}}]", "here.yaml");
      ADD_FAILURE() << value;
    } catch (const Error& error) {
      EXPECT_TRUE(has(error.what(), "tofray dataset")) << error.what();
    }
  }
}

// What of chance goes into scenes is one text on every machine and with every compiler.
TEST(set, writes_the_same_ten_thousand_scenes_everywhere) {
  const Dataset set =
      Written(
          "name: all\nsamples: 10000\nseed: 11\nviews: 2\ndevices: 3\nlet: {wall: {log_uniform: [0.5 m, 5 m]}, deep: {normal: [1 m, 30 "
          "cm], within: [50 cm, 2 m]}}\nscene:\n"
          "  camera: {pose: {position: {uniform: [[-1 m, -1 m, -1 m], [1 m, 1 m, 1 m]]}}}\n"
          "  ambient: {illuminance: {choice: [0 klx, {uniform: [1 klx, 90 klx]}], weights: [1, 2]}, direction: {cap: {around: [0, 1, 0.2], "
          "within: 40 deg}}}\n"
          "  objects:\n"
          "    - plane: {name: back, point: [0, 0, \"= wall + sqrt(deep * wall) / 3\"], reflectivity: {even: [5 %, 95 %]}}\n"
          "    - sphere: {name: ball, center: [0, 0, \"= max(wall - 20 cm, 0.3 m)\"], radius: {grid: {from: 3 cm, to: 30 cm, n: 7}}, "
          "rotation: any, reflectivity: {normal: [0.5, 0.2], within: [0.1, 0.9]}}\n"
          "    - box: {name: crate, min: [-0.1, -0.1, 1], max: [0.1, 0.1, {integer: [2, 9]}], rotation: {axis: [0, 0, 1], angle: {uniform: "
          "[0 deg, 360 deg]}}, reflectivity: 0.4}\n")
          .set();
  std::string all;
  for (std::uint64_t i = 0; i < 10000; ++i) all += files::sha256_hex(set.scene_yaml(i, i % 2));
  EXPECT_EQ(files::sha256_hex(all), "2c3cfe881bdb9d2d98a6b10f90d0cbd6c001236c54d0d7472887e62e01eaa8cc");
}

}  // namespace
