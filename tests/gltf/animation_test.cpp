// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Animations: what channels say between keyframes, before and behind them.
#include "gltf_files.h"
#include "support/pi.h"

using namespace tofray;
using namespace tofray::gltf_test;

namespace {

/// One channel that moves the node of a triangle.
struct Moving {
  File file = triangle_file();
  Moving(const std::string& path, const std::string& type, const std::vector<float>& times, const std::vector<float>& values,
         const std::string& interpolation = "LINEAR") {
    add(path, file.floats(times, "SCALAR"), file.floats(values, type), interpolation);
  }
  void add(const std::string& path, int times, int values, const std::string& interpolation) {
    file.add("animations", {{"samplers", {{{"input", times}, {"output", values}, {"interpolation", interpolation}}}},
                            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
  }
  [[nodiscard]] gltf::Matrix world(double time_s) const { return gltf::at(model_of(file), 0, time_s).world[0]; }
  [[nodiscard]] double x(double time_s) const { return world(time_s)[0][3]; }
};

std::array<double, 4> unit(std::array<double, 4> q) {
  double sum = 0;
  for (const double v : q) sum += v * v;
  for (double& v : q) v /= std::sqrt(sum);
  return q;
}

/// q · p · q*, by the product of quaternions.
std::array<double, 3> turned(const std::array<double, 4>& q, const std::array<double, 3>& p) {
  const auto times = [](const std::array<double, 4>& a, const std::array<double, 4>& b) {
    return std::array<double, 4>{
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
  };
  const auto out = times(times(q, {p[0], p[1], p[2], 0}), {-q[0], -q[1], -q[2], q[3]});
  return {out[0], out[1], out[2]};
}

void expect_turn(const gltf::Matrix& world, const std::array<double, 4>& rotation) {
  for (std::size_t column = 0; column < 3; ++column) {
    std::array<double, 3> axis{0, 0, 0};
    axis[column] = 1;
    const auto expected = turned(unit(rotation), axis);
    for (std::size_t row = 0; row < 3; ++row)
      EXPECT_NEAR(world[row][column], expected[row], 1e-7) << row << " " << column;  // float keyframes
  }
}

}  // namespace

TEST(animation, is_linear_between_keyframes) {
  const Moving moving("translation", "VEC3", {1, 2, 4}, {0, 0, 0, 10, 0, 0, 20, 0, 0});
  EXPECT_EQ(moving.x(1.5), 5);
  EXPECT_EQ(moving.x(2), 10);
  EXPECT_EQ(moving.x(2.5), 12.5);
  EXPECT_NEAR(moving.x(3.9), 19.5, 1e-12);
}

TEST(animation, keeps_its_ends) {
  for (const char* interpolation : {"LINEAR", "STEP"}) {
    const Moving moving("translation", "VEC3", {1, 2}, {3, 0, 0, 10, 0, 0}, interpolation);
    for (const double before : {-1e300, 0.0, 1.0}) EXPECT_EQ(moving.x(before), 3);
    for (const double after : {2.0, 2.0001, 1e300}) EXPECT_EQ(moving.x(after), 10);
  }
}

TEST(animation, by_steps_jumps_at_each_keyframe) {
  const Moving moving("translation", "VEC3", {0, 1, 2}, {1, 0, 0, 5, 0, 0, 7, 0, 0}, "STEP");
  EXPECT_EQ(moving.x(0.999), 1);
  EXPECT_EQ(moving.x(1), 5);
  EXPECT_EQ(moving.x(1.999), 5);
  EXPECT_EQ(moving.x(2), 7);
}

TEST(animation, of_one_keyframe_is_constant) {
  const Moving moving("scale", "VEC3", {1}, {2, 3, 4});
  for (const double time : {0.0, 1.0, 2.0}) EXPECT_EQ(moving.world(time)[1][1], 3);
}

TEST(animation, by_cubic_splines_is_hermite_s) {
  // Keyframes at 1 and 3: in-tangent, value, out-tangent each; tangents are per second.
  const std::vector<float> values = {99, 0, 0, 2, 0, 0, 4, 0, 0, -3, 0, 0, 7, 0, 0, 99, 0, 0};
  const Moving moving("translation", "VEC3", {1, 3}, values, "CUBICSPLINE");
  for (const double share : {0.0, 0.125, 0.25, 0.5, 0.75, 0.9}) {
    // The cubic with value 2 and slope 4 · 2 at 0, value 7 and slope −3 · 2 at 1, by its power series.
    const double a = 2, b = 8, end = 7, slope = -6, c = 3 * (end - a) - 2 * b - slope, d = 2 * (a - end) + b + slope;
    EXPECT_NEAR(moving.x(1 + 2 * share), a + share * (b + share * (c + share * d)), 1e-12) << share;
  }
  EXPECT_EQ(moving.x(0), 2);
  EXPECT_EQ(moving.x(3), 7);
  EXPECT_EQ(moving.x(9), 7);
}

TEST(animation, by_cubic_splines_of_rotations_is_scaled_to_unit_length) {
  const std::vector<float> values = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0};
  const Moving moving("rotation", "VEC4", {0, 1}, values, "CUBICSPLINE");
  expect_turn(moving.world(0.5), {0.5, 0, 0, 0.5});
  expect_turn(moving.world(0.25), {0.15625, 0, 0, 0.84375});  // 3/16 − 2/64 and the rest, as the tangents are 0
}

TEST(animation, turns_at_constant_speed) {
  const auto about_z = [](double degrees) {
    const double half = degrees / 360 * test::pi;
    return std::array<double, 4>{0, 0, std::sin(half), std::cos(half)};
  };
  const auto with = [](const std::array<double, 4>& a, const std::array<double, 4>& b) {
    std::vector<float> values;
    for (const auto& q : {a, b})
      for (const double v : q) values.push_back(static_cast<float>(v));
    return Moving("rotation", "VEC4", {0, 2}, values);
  };
  const Moving wide = with(about_z(0), about_z(160));
  for (const double time : {0.0, 0.25, 0.5, 1.0, 1.75}) expect_turn(wide.world(time), about_z(80 * time));
  const Moving narrow = with(about_z(10), about_z(10.001));
  expect_turn(narrow.world(1), about_z(10.0005));
  // The shorter way: from 10° to 350° is by −20°, also where the quaternion has the other sign.
  const Moving back = with(about_z(10), about_z(350));
  expect_turn(back.world(1), about_z(0));
  expect_turn(back.world(0.5), about_z(5));
  // About different axes, by the classical formula.
  const auto a = unit({0.1, 0.2, 0.3, 0.9}), b = unit({-0.4, 0.1, 0.6, 0.5});
  const double angle = std::acos(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]), share = 0.3;
  std::array<double, 4> expected{};
  for (std::size_t k = 0; k < 4; ++k)
    expected[k] = (std::sin((1 - share) * angle) * a[k] + std::sin(share * angle) * b[k]) / std::sin(angle);
  expect_turn(with(a, b).world(0.6), expected);
}

TEST(animation, turns_by_normalized_numbers) {
  Moving moving("scale", "VEC3", {0, 1}, {1, 1, 1, 1, 1, 1});
  moving.file.json.erase("animations");
  const int times = moving.file.floats({0, 1}, "SCALAR");
  const int turns = moving.file.accessor<std::int16_t>({0, 0, 0, 32767, 0, 23170, 0, 23170}, "VEC4", true);
  moving.add("rotation", times, turns, "LINEAR");
  const double s = std::sin(test::pi / 8), c = std::cos(test::pi / 8);
  expect_turn(moving.world(0.5), {0, s, 0, c});
}

TEST(animation, moves_weights_of_morph_targets) {
  File file = triangle_file();
  const int up = file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3"), right = file.floats({1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3");
  file.primitive(0)["targets"] = {{{"POSITION", up}}, {{"POSITION", right}}};
  file.add("animations", {{"samplers", {{{"input", file.floats({0, 1}, "SCALAR")}, {"output", file.floats({0, 4, 2, 8}, "SCALAR")}}}},
                          {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
  const Model model = model_of(file);
  EXPECT_EQ(gltf::at(model, 0, 0.5).weights[0], (std::vector<double>{1, 6}));
  EXPECT_EQ(parts_at(model, 0.25)[0].mesh.vertices[0], (std::array<float, 3>{5, 0, 0.5F}));
  EXPECT_EQ(parts_at(model, 7)[0].mesh.vertices[2], (std::array<float, 3>{8, 1, 2}));
}

TEST(animation, of_weights_by_cubic_splines_has_three_of_all_at_each_keyframe) {
  File file = triangle_file();
  const int up = file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  file.primitive(0)["targets"] = {{{"POSITION", up}}, {{"POSITION", up}}};
  const int values = file.floats({0, 0, 1, 10, 0, 0, 0, 0, 3, 20, 0, 0}, "SCALAR");
  file.add("animations", {{"samplers", {{{"input", file.floats({0, 1}, "SCALAR")}, {"output", values}, {"interpolation", "CUBICSPLINE"}}}},
                          {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
  EXPECT_EQ(gltf::at(model_of(file), 0, 0.5).weights[0], (std::vector<double>{2, 15}));
}

TEST(animation, leaves_what_it_does_not_move_as_the_node_says) {
  Moving moving("translation", "VEC3", {0, 1}, {0, 0, 0, 1, 0, 0});
  moving.file.json["nodes"][0]["scale"] = {5, 6, 7};
  moving.file.json["nodes"][0]["translation"] = {0, 50, 0};
  const Model model = model_of(moving.file);
  EXPECT_EQ(gltf::at(model, 0, 1).world[0], (gltf::Matrix{{{5, 0, 0, 1}, {0, 6, 0, 0}, {0, 0, 7, 0}}}));
  EXPECT_EQ(gltf::at(model, gltf::none, 1).world[0], (gltf::Matrix{{{5, 0, 0, 0}, {0, 6, 0, 50}, {0, 0, 7, 0}}}));
}

TEST(animation, moves_joints) {
  File file = triangle_file();
  Document& attributes = file.primitive(0)["attributes"];
  attributes["JOINTS_0"] = file.accessor<std::uint8_t>(std::vector<std::uint8_t>(12, 0), "VEC4");
  attributes["WEIGHTS_0"] = file.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}, Document::object()};
  file.add("skins", {{"joints", {1}}});
  file.add("animations", {{"samplers", {{{"input", file.floats({0, 2}, "SCALAR")}, {"output", file.floats({0, 0, 0, 0, 0, 8}, "VEC3")}}}},
                          {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
  EXPECT_EQ(parts_at(model_of(file), 0.5)[0].mesh.vertices[1], (std::array<float, 3>{1, 0, 2}));
}

TEST(animation, says_when_it_begins_and_ends) {
  File file = Moving("translation", "VEC3", {1, 2.5F}, {0, 0, 0, 1, 0, 0}).file;
  Document& animation = file.json["animations"][0];
  animation["name"] = "walk";
  animation["samplers"].push_back({{"input", file.floats({0.5F, 1}, "SCALAR")}, {"output", file.floats({1, 1, 1, 1, 1, 1}, "VEC3")}});
  animation["channels"].push_back({{"sampler", 1}, {"target", {{"node", 0}, {"path", "scale"}}}});
  const Model model = model_of(file);
  EXPECT_EQ(model.animations[0].name, "walk");
  EXPECT_EQ(model.animations[0].start_s, 0.5);
  EXPECT_EQ(model.animations[0].end_s, 2.5);
}

TEST(animation, leaves_out_channels_that_move_nothing_it_knows) {
  File file = Moving("translation", "VEC3", {0, 1}, {0, 0, 0, 1, 0, 0}).file;
  Document& target = file.json["animations"][0]["channels"][0]["target"];
  target.erase("node");
  EXPECT_TRUE(has_notice(model_of(file), "channels that move no node are left out"));
  target["path"] = "pointer";
  EXPECT_TRUE(has_notice(model_of(file), "KHR_animation_pointer"));
  EXPECT_TRUE(model_of(file).animations[0].channels.empty());
}

TEST(animation, needs_times_that_rise_of_each_channel) {
  // Three lists of times in a row; any of them may be the wrong one, whichever is read first.
  for (const std::size_t wrong : {0U, 1U, 2U})
    for (const std::size_t first : {0U, 1U, 2U}) {
      File file = triangle_file();
      int lists[3];
      for (std::size_t i = 0; i < 3; ++i)
        lists[i] = file.floats(i == wrong ? std::vector<float>{1, 2, 2} : std::vector<float>{1, 2, 3}, "SCALAR");
      const int vectors = file.floats({1, 0, 0, 1, 0, 0, 2, 0, 0}, "VEC3"),
                turns = file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
      Document samplers = Document::array(), channels = Document::array();
      for (std::size_t k = 0; k < 3; ++k) {
        samplers.push_back({{"input", lists[(first + k) % 3]}, {"output", k == 2 ? turns : vectors}});
        channels.push_back({{"sampler", k}, {"target", {{"node", 0}, {"path", k == 0 ? "translation" : k == 1 ? "scale" : "rotation"}}}});
      }
      file.add("animations", {{"samplers", samplers}, {"channels", channels}});
      expect_fault(file.glb(), "has keyframes whose times do not rise\n  got 2 behind 2 as number 2");
    }
}

TEST(animation, of_too_many_keyframes_is_refused) {
  File file = triangle_file();
  const int view = file.view(std::string(4 * 10'000'001ULL, '\0'));
  const int times = file.accessor(view, 5126, "SCALAR", 10'000'001), values = file.floats({0, 0, 0}, "VEC3");
  file.add("animations", {{"samplers", {{{"input", times}, {"output", values}}}},
                          {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}}});
  expect_fault(file.glb(), "animations[0].samplers[0].input has too many keyframes", ErrorKind::limit);
}
