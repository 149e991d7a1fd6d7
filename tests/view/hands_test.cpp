// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Objects and the camera moved by hand: what comes back as keys, and what the next frame then shows.
#include <algorithm>
#include <charconv>
#include <fstream>

#include "support/pi.h"
#include "support/text.h"
#include "view/viewer.h"

namespace tofray::test {
namespace {

using files::Json;
using Row = std::array<double, 3>;
using Matrix = std::array<Row, 3>;

Row operator*(const Matrix& m, const Row& a) {
  Row out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * a[0] + m[i][1] * a[1] + m[i][2] * a[2];
  return out;
}
Matrix transposed(const Matrix& m) {
  Matrix out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) out[i][k] = m[k][i];
  return out;
}
Matrix product(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 3; ++j) out[i][k] += a[i][j] * b[j][k];
  return out;
}

void expect_near(const Matrix& a, const Matrix& b, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[i][k], b[i][k], tolerance) << i << k;
}

/// All numbers of a text.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> out;
  for (std::size_t at = 0; at < text.size();) {
    double number = 0;
    const auto read = std::from_chars(text.data() + at, text.data() + text.size(), number);
    if (read.ec == std::errc())
      out.push_back(number), at = static_cast<std::size_t>(read.ptr - text.data());
    else
      ++at;
  }
  return out;
}

/// A page that shows the truth of a state that stands still, and moves things in it.
class Hands {
 public:
  explicit Hands(const Arguments& words, std::uint64_t frame = 0) : viewer_(words, false), one_(viewer_) {
    one_.page.send(R"({"type":"pause"})");
    one_.page.send(R"({"type":"seek","frame":)" + std::to_string(frame) + "}");
    for (const Json& each : *one_.hello.find("overrides")->items())
      list_.emplace_back(*each.find("key")->string(), *each.find("text")->string());
    one_.page.want("\"gt_object_id\",\"gt_z_m\",\"gt_range_m\"");
    take(1, frame);
  }
  Page& page() { return one_.page; }
  [[nodiscard]] std::uint32_t generation() const { return shown_.generation; }
  [[nodiscard]] int width() const { return static_cast<int>(shown_.width); }
  [[nodiscard]] int height() const { return static_cast<int>(shown_.height); }
  [[nodiscard]] int object(int u, int v) const { return little<std::int32_t>(array("gt_object_id"), 4 * at(u, v)); }
  [[nodiscard]] double z(int u, int v) const { return static_cast<double>(little<float>(array("gt_z_m"), 4 * at(u, v))); }
  [[nodiscard]] double range(int u, int v) const { return static_cast<double>(little<float>(array("gt_range_m"), 4 * at(u, v))); }
  /// The mean of an object's pixels.
  [[nodiscard]] std::pair<double, double> middle_of(int of) const {
    double u_sum = 0, v_sum = 0, count = 0;
    for (int v = 0; v < height(); ++v)
      for (int u = 0; u < width(); ++u)
        if (object(u, v) == of) u_sum += u, v_sum += v, ++count;
    EXPECT_GT(count, 0) << "object " << of << " is not in the picture";
    return {u_sum / count, v_sum / count};
  }
  /// The answer to a message of hands, with the frame's generation as its base.
  Json ask(const std::string& type, const std::string& rest) {
    return one_.page.answer(R"({"type":")" + type + R"(","id":5,"base":)" + std::to_string(shown_.generation) + "," + rest + "}", type);
  }
  Json drag(int object, int u, int v, double du, double dv, const std::string& how) {
    return ask("drag", R"("object":)" + std::to_string(object) + R"(,"from":[)" + std::to_string(u) + "," + std::to_string(v) +
                           R"(],"to":[)" + std::to_string(u + du) + "," + std::to_string(v + dv) + R"(],"how":")" + how + "\"");
  }
  /// Makes it so, as the page does, and waits for the frame.
  void apply(const Json& answer) {
    ASSERT_EQ(*answer.find("type")->string() == "fault", false) << files::json_text(answer);
    for (const Json& key : *answer.find("unsets")->items())
      std::erase_if(list_, [&](const auto& one) { return one.first == *key.string(); });
    for (const Json& each : *answer.find("sets")->items()) {
      const std::string &key = *each.find("key")->string(), &text = *each.find("text")->string();
      const auto found = std::find_if(list_.begin(), list_.end(), [&](const auto& one) { return one.first == key; });
      if (found != list_.end())
        found->second = text;
      else
        list_.emplace_back(key, text);
    }
    Json all = Json::array();
    for (const auto& [key, text] : list_) all.push(Json::object().set("key", key).set("text", text));
    const Json done = one_.page.answer(R"({"type":"state","id":6,"overrides":)" + files::json_text(all) + "}");
    ASSERT_EQ(*done.find("type")->string(), "done") << files::json_text(done);
    take(static_cast<std::uint32_t>(number_in(done, "generation")), shown_.frame);
  }
  Json scene() { return one_.page.answer(R"({"type":"view3d","id":7})", "view3d"); }
  Json object_in_scene(int number) { return (*scene().find("objects")->items())[static_cast<std::size_t>(number)]; }
  Json fault(const Json& answer) {
    EXPECT_EQ(*answer.find("type")->string(), "fault") << files::json_text(answer);
    return answer;
  }

 private:
  void take(std::uint32_t generation, std::uint64_t frame) {
    const auto shown = one_.page.frame_with([&](const WireFrame& one) { return one.generation == generation && one.frame == frame; });
    ASSERT_TRUE(shown);
    shown_ = *shown;
  }
  [[nodiscard]] const std::string& array(const char* name) const { return shown_.arrays.at(number_of(one_.hello, name)); }
  [[nodiscard]] std::size_t at(int u, int v) const { return static_cast<std::size_t>(v) * shown_.width + static_cast<std::size_t>(u); }

  Viewer viewer_;
  Greeted one_;
  WireFrame shown_;
  std::vector<std::pair<std::string, std::string>> list_;
};

/// KEY of each of `sets`, in order.
std::string keys_of(const Json& answer) {
  std::string out;
  if (answer.find("sets") == nullptr) return files::json_text(answer);
  for (const Json& one : *answer.find("sets")->items()) out += *one.find("key")->string() + " ";
  return out;
}
std::string first_text(const Json& answer) {
  return answer.find("sets") == nullptr ? "" : *(*answer.find("sets")->items())[0].find("text")->string();
}
/// What a fault says; nothing where it is none.
std::string text_of(const Json& fault) {
  const Json *text = fault.find("text"), *more = fault.find("more");
  return text == nullptr || more == nullptr ? "" : *text->string() + " " + *more->string();
}

constexpr int gift = 25, ball = 26;

TEST(drag, parallel_by_20_pixels_puts_the_object_under_the_new_pixel) {
  NEEDS_THE_VIEWER;
  Hands hands({"demo"});
  const auto [middle_u, middle_v] = hands.middle_of(ball);
  const int u = static_cast<int>(std::lround(middle_u)), v = static_cast<int>(std::lround(middle_v));
  ASSERT_EQ(hands.object(u, v), ball);
  const double z = hands.z(u, v);
  const Json answer = hands.drag(ball, u, v, 20, -30, "parallel");
  EXPECT_EQ(keys_of(answer), "objects.26.sphere.position ");
  EXPECT_EQ(answer.find("unsets")->items()->size(), 0u);
  EXPECT_EQ(number_in(answer, "id"), 5);
  EXPECT_EQ(number_in(answer, "base"), 1);
  const std::vector<double> shift = numbers_in(first_text(answer));
  ASSERT_EQ(shift.size(), 3u);
  EXPECT_EQ(shift[2], 0) << "it stays in its plane";
  EXPECT_TRUE(has(*answer.find("what")->string(), "position ")) << *answer.find("what")->string();
  hands.apply(answer);
  ASSERT_EQ(hands.object(u + 20, v - 30), ball);
  EXPECT_NEAR(hands.z(u + 20, v - 30), z, 1e-5) << "the point that was taken stays under the cursor";
  const auto [new_u, new_v] = hands.middle_of(ball);
  EXPECT_NEAR(new_u, middle_u + 20, 4);
  EXPECT_NEAR(new_v, middle_v - 30, 4);
}

TEST(drag, goes_on_from_where_it_began_whatever_was_set_on_the_way) {
  NEEDS_THE_VIEWER;
  Hands hands({"demo"});
  const auto [middle_u, middle_v] = hands.middle_of(ball);
  const int u = static_cast<int>(middle_u), v = static_cast<int>(middle_v);
  const Json once = hands.drag(ball, u, v, 24, 0, "parallel");
  hands.apply(hands.drag(ball, u, v, 12, 0, "parallel"));
  ASSERT_EQ(hands.generation(), 2u);
  // One more drag, whose base is the state before.
  const Json on =
      hands.page().answer(R"({"type":"drag","id":8,"object":26,"from":[)" + std::to_string(u) + "," + std::to_string(v) + R"(],"to":[)" +
                              std::to_string(u + 24) + "," + std::to_string(v) + R"(],"how":"parallel","base":1})",
                          "drag");
  ASSERT_EQ(*on.find("type")->string(), "drag") << files::json_text(on);
  EXPECT_EQ(files::json_text(*on.find("sets")), files::json_text(*once.find("sets")));
  hands.apply(on);
  EXPECT_EQ(hands.object(u + 24, v), ball);
  const Json late =
      hands.page().answer(R"({"type":"drag","id":8,"object":25,"from":[160,140],"to":[160,141],"how":"parallel","base":7})", "drag");
  EXPECT_TRUE(has(text_of(hands.fault(late)), "has changed since")) << text_of(late);
}

TEST(drag, along_the_ray_goes_away_by_one_percent_for_each_pixel_upwards) {
  NEEDS_THE_VIEWER;
  Hands hands({"demo"});
  const auto [middle_u, middle_v] = hands.middle_of(gift);
  const int u = static_cast<int>(middle_u), v = static_cast<int>(middle_v);
  const double range = hands.range(u, v);
  const Json nearer = hands.drag(gift, u, v, 3, 20, "along");
  EXPECT_EQ(keys_of(nearer), "objects.25.box.position ");
  hands.apply(nearer);
  ASSERT_EQ(hands.object(u, v), gift);
  EXPECT_NEAR(hands.range(u, v), range * std::exp(-0.2), 1e-5);
  hands.apply(hands.drag(gift, u, v, 0, -10, "along"));
  EXPECT_NEAR(hands.range(u, v), range * std::exp(-0.1), 1e-5);
}

TEST(drag, turn_follows_the_cursor_about_the_origin_and_changes_no_other_key) {
  NEEDS_THE_VIEWER;
  Hands hands({"demo", "--set", "camera.pose={position: [0.3, -0.2, -0.1], look_at: [0.1, 0.1, 0.8]}"});
  const auto [middle_u, middle_v] = hands.middle_of(gift);
  const int u = static_cast<int>(middle_u), v = static_cast<int>(middle_v);
  const Matrix camera = rows_of(*hands.scene().find("camera")->find("rotation"));
  const Json before = hands.object_in_scene(gift);
  const Json answer = hands.drag(gift, u, v, 30, 40, "turn");
  EXPECT_EQ(keys_of(answer), "objects.25.box.rotation ");
  hands.apply(answer);
  const Json after = hands.object_in_scene(gift);
  EXPECT_EQ(three(*after.find("position")), three(*before.find("position")));
  // Seen by the camera: the turn that took place.
  const Matrix turn = product(transposed(camera),
                              product(product(rows_of(*after.find("rotation")), transposed(rows_of(*before.find("rotation")))), camera));
  const double angle = std::acos((turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2);
  EXPECT_NEAR(angle, pi * 50 / hands.height(), 1e-6);
  const Row nearest = turn * Row{0, 0, -1};
  EXPECT_NEAR(nearest[0], std::sin(angle) * 0.6, 1e-6) << "what faces the camera goes with the cursor: right";
  EXPECT_NEAR(nearest[1], std::sin(angle) * 0.8, 1e-6) << "and down";
}

TEST(drag, scale_changes_the_sizes_of_each_shape_about_its_origin) {
  NEEDS_THE_VIEWER;
  const Folder folder;
  std::ofstream(folder / "all.yaml") << R"(camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000}
objects:
  - plane: {point: [0, 0, 3], normal: [0, 0, -1], reflectivity: 0.5}
  - sphere: {center: [-0.6, -0.4, 2], radius: 0.2 m, reflectivity: 0.5}
  - box: {min: [-0.2, -0.5, 1.9], max: [0.2, -0.2, 2.2], position: [0, 0.1, 0], rotation: {axis: [0, 1, 0], angle: 20 deg}, reflectivity: 0.5}
  - triangle: {vertices: [[0.4, -0.5, 2], [0.8, -0.5, 2.1], [0.6, -0.1, 2]], reflectivity: 0.5}
  - cylinder: {center: [-0.6, 0.3, 2], axis: [1, 1, 0], radius: 0.1 m, height: 0.3 m, reflectivity: 0.5}
  - rectangle: {center: [0, 0.3, 2], size: [0.3 m, 0.2 m], rotation: {axis: [0, 1, 0], angle: 30 deg}, reflectivity: 0.5}
  - disk: {center: [0.5, 0.3, 2], normal: [0.2, 0, -1], radius: 0.1 m, reflectivity: 0.5}
  - capsule: {start: [-0.3, 0.6, 2], end: [0, 0.65, 2.1], radius: 0.06 m, reflectivity: 0.5}
  - cone: {base: [0.3, 0.7, 2], axis: [0, -1, 0.1], radius: 0.1 m, height: 0.2 m, reflectivity: 0.5}
  - mesh: {file: "tofray:bumpy-ball", scale: 0.3, position: [0.9, 0.5, 2], reflectivity: 0.5}
)";
  Hands hands({(folder / "all.yaml").native()});
  const char* const keys[] = {"",
                              "objects.1.sphere.radius ",
                              "objects.2.box.min objects.2.box.max ",
                              "objects.3.triangle.vertices ",
                              "objects.4.cylinder.radius objects.4.cylinder.height ",
                              "objects.5.rectangle.size ",
                              "objects.6.disk.radius ",
                              "objects.7.capsule.start objects.7.capsule.end objects.7.capsule.radius ",
                              "objects.8.cone.radius objects.8.cone.height ",
                              "objects.9.mesh.scale "};
  const auto bounds_of = [](const Json& object) {
    std::vector<double> out;
    for (const Json& one : *object.find("bounds")->items()) out.push_back(0), one.number(out.back());
    return out;
  };
  for (int k = 1; k < 10; ++k) {
    const Json before = hands.object_in_scene(k);
    const Json answer = hands.drag(k, 5, 5, 0, -40, "scale");
    ASSERT_EQ(*answer.find("type")->string(), "drag") << files::json_text(answer);
    EXPECT_EQ(keys_of(answer), keys[k]);
    EXPECT_FALSE(answer.find("what")->string()->empty());
    hands.apply(answer);
    const Json after = hands.object_in_scene(k);
    const Row origin = three(*before.find("position"));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(three(*after.find("position"))[i], origin[i], 2e-6) << k;
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(bounds_of(after)[i] - origin[i % 3], std::exp(0.4) * (bounds_of(before)[i] - origin[i % 3]), 5e-6) << k << " " << i;
  }
  EXPECT_TRUE(has(text_of(hands.fault(hands.drag(0, 5, 5, 0, -40, "scale"))), "it has no size"));
}

TEST(drag, of_what_moves_evenly_keeps_its_velocity) {
  NEEDS_THE_VIEWER;
  Hands hands({"flying-ball"}, 4);
  const auto [middle_u, middle_v] = hands.middle_of(1);
  const int u = static_cast<int>(middle_u), v = static_cast<int>(middle_v);
  const double z = hands.z(u, v);
  const Json answer = hands.drag(1, u, v, -25, 10, "parallel");
  EXPECT_EQ(keys_of(answer), "objects.1.sphere.position ");
  hands.apply(answer);
  ASSERT_EQ(hands.object(u - 25, v + 10), 1);
  EXPECT_NEAR(hands.z(u - 25, v + 10), z, 1e-5);
}

TEST(drag, of_a_piece_of_a_mesh_moves_all_of_it) {
  NEEDS_THE_VIEWER;
  const Folder folder;
  std::ofstream(folder / "two.mtl") << "newmtl left\n#!nir_reflectivity 0.5\nnewmtl right\n#!nir_reflectivity 0.7\n";
  std::ofstream(folder / "two.obj") << "mtllib two.mtl\nv -0.3 -0.2 0\nv 0 -0.2 0\nv 0 0.2 0\nv -0.3 0.2 0\nv 0.3 -0.2 0\nv 0.3 0.2 0\n"
                                       "usemtl left\nf 1 2 3 4\nusemtl right\nf 2 5 6 3\n";
  std::ofstream(folder / "two.yaml") << "camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000}\nobjects:\n"
                                        "  - mesh: {file: two.obj, name: card, up: none, position: [0, 0, 1]}\n";
  Hands hands({(folder / "two.yaml").native()});
  const auto [left_u, left_v] = hands.middle_of(0);
  const auto [right_u, right_v] = hands.middle_of(1);
  const int u = static_cast<int>(right_u), v = static_cast<int>(right_v);
  ASSERT_EQ(hands.object(u, v), 1);
  const Json answer = hands.drag(0, u, v, 10, 5, "parallel");  // taken at the other piece
  EXPECT_EQ(keys_of(answer), "objects.0.mesh.position ");
  hands.apply(answer);
  EXPECT_NEAR(hands.middle_of(0).first, left_u + 10, 1);
  EXPECT_NEAR(hands.middle_of(1).first, right_u + 10, 1);
  EXPECT_NEAR(hands.middle_of(1).second, right_v + 5, 1);
}

TEST(place, makes_exactly_the_pose_that_was_asked_for) {
  NEEDS_THE_VIEWER;
  Hands hands({"bench-mesh"});
  // A turn about an odd axis, and numbers that need all their digits.
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Matrix turn = product({{{c, 0, s}, {0, 1, 0}, {-s, 0, c}}}, {{{1, 0, 0}, {0, 0.8, -0.6}, {0, 0.6, 0.8}}});
  const Row place{0.1 + 0.2, -1.0 / 3, 1.2345678901234567};
  Json rows = Json::array();
  for (const Row& row : turn) rows.push(Json::list(row));
  const std::string where = R"("position":)" + files::json_text(Json::list(place)) + R"(,"rotation":)" + files::json_text(rows);
  const Json answer = hands.ask("place", R"("object":0,)" + where);
  EXPECT_EQ(keys_of(answer), "objects.0.mesh.position objects.0.mesh.rotation ");
  EXPECT_EQ(numbers_in(first_text(answer)), (std::vector<double>{place[0], place[1], place[2]}));
  hands.apply(answer);
  const Json object = hands.object_in_scene(0);
  EXPECT_EQ(three(*object.find("position")), place);
  expect_near(rows_of(*object.find("rotation")), turn, 1e-15);
  // The camera's pose is one key.
  const Json camera = hands.ask("camera", where);
  EXPECT_EQ(keys_of(camera), "camera.pose ");
  hands.apply(camera);
  const Json scene = hands.scene();
  EXPECT_EQ(three(*scene.find("camera")->find("position")), place);
  expect_near(rows_of(*scene.find("camera")->find("rotation")), turn, 1e-15);
  // Once more what is there already: the same text, to the last digit.
  EXPECT_EQ(files::json_text(*hands.ask("camera", where).find("sets")), files::json_text(*camera.find("sets")));
}

TEST(place, of_what_turns_and_flies_is_where_it_is_at_the_time_of_the_frame) {
  NEEDS_THE_VIEWER;
  Hands hands({"demo", "--set", "objects.25.box.velocity=[0.05 m/s, 0 m/s, -0.1 m/s]", "--set",
               "objects.25.box.angular_velocity=[0 deg/s, 30 deg/s, 10 deg/s]"},
              7);
  const Row place{0.2, 0.1, 0.9};
  const std::string where = R"("object":25,"position":[0.2,0.1,0.9],"rotation":[[0,-1,0],[1,0,0],[0,0,1]])";
  hands.apply(hands.ask("place", where));
  const Json object = hands.object_in_scene(gift);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(three(*object.find("position"))[i], place[i], 1e-12);
  expect_near(rows_of(*object.find("rotation")), {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}, 1e-12);
}

TEST(hands, set_keys_that_hold_whatever_the_list_had_before) {
  NEEDS_THE_VIEWER;
  Hands hands({"demo", "--set", "objects.25.box.rotation.angle=40 deg", "--set", "objects.26.sphere.position=[0.01, 0, 0]", "--set",
               "objects.26.sphere={center: [-0.2, 0.2, 0.7], radius: 4 cm, reflectivity: 0.4}", "--set",
               "camera.pose.position=[0, 0, -0.1]"});
  const auto unsets = [](const Json& answer) {
    std::string out;
    for (const Json& one : *answer.find("unsets")->items()) out += *one.string() + " ";
    return out;
  };
  const Json turned = hands.ask("place", R"("object":25,"position":null,"rotation":[[1,0,0],[0,1,0],[0,0,1]])");
  EXPECT_EQ(unsets(turned), "objects.25.box.rotation.angle ");
  EXPECT_EQ(keys_of(turned), "objects.25.box.rotation ");
  hands.apply(turned);
  expect_near(rows_of(*hands.object_in_scene(gift).find("rotation")), {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 0);
  const Json moved = hands.ask("place", R"("object":26,"position":[-0.1,0.2,0.7],"rotation":null)");
  EXPECT_EQ(unsets(moved), "objects.26.sphere.position ") << "it would be lost before objects.26.sphere";
  hands.apply(moved);
  EXPECT_NEAR(three(*hands.object_in_scene(ball).find("position"))[0], -0.1, 1e-15);
  const Json camera = hands.ask("camera", R"("position":[0,0,-0.2],"rotation":null)");
  EXPECT_EQ(unsets(camera), "camera.pose.position ");
  hands.apply(camera);
  EXPECT_EQ(three(*hands.scene().find("camera")->find("position")), (Row{0, 0, -0.2}));
}

TEST(hands, refuse_what_has_keyframes_in_plain_words) {
  NEEDS_THE_VIEWER;
  Hands hands({"demo", "--set", "objects.26.sphere.keyframes=[{time: 0 s, position: [0, 0, 0]}, {time: 9 s, position: [0.3, 0, 0]}]",
               "--set", "camera.keyframes=[{time: 0 s, pose: {position: [0, 0, 0]}}, {time: 90 s, pose: {position: [0, 0, -0.1]}}]"});
  const auto [u, v] = hands.middle_of(ball);
  for (const char* how : {"parallel", "along", "turn"}) {
    const std::string text = text_of(hands.fault(hands.drag(ball, static_cast<int>(u), static_cast<int>(v), 3, 3, how)));
    EXPECT_TRUE(has(text, "\"ball\" cannot be moved by hand")) << text;
    EXPECT_TRUE(has(text, "objects.26.sphere.keyframes")) << text;
  }
  const std::string placed = text_of(hands.fault(hands.ask("place", R"("object":26,"position":[0,0,1],"rotation":null)")));
  EXPECT_TRUE(has(placed, "keyframes")) << placed;
  const std::string camera = text_of(hands.fault(hands.ask("camera", R"("position":[0,0,1],"rotation":null)")));
  EXPECT_TRUE(has(camera, "the camera cannot be moved by hand")) << camera;
  EXPECT_TRUE(has(camera, "camera.keyframes")) << camera;
  const Json scene = hands.scene(), object = hands.object_in_scene(ball);
  EXPECT_FALSE(*object.find("movable")->boolean());
  EXPECT_TRUE(has(*object.find("why")->string(), "keyframes"));
  EXPECT_FALSE(*scene.find("camera")->find("movable")->boolean());
  EXPECT_TRUE(*hands.object_in_scene(gift).find("movable")->boolean());
}

TEST(hands, answer_what_cannot_be_with_a_fault_and_go_on) {
  NEEDS_THE_VIEWER;
  Hands hands({"demo"});
  struct Wrong {
    const char *message, *says;
  };
  for (const Wrong& one :
       {Wrong{R"({"type":"drag","id":5,"object":27,"from":[1,1],"to":[1,1],"how":"turn"})", "no object 27"},
        Wrong{R"({"type":"drag","id":5,"object":26,"from":[1,1],"to":[1,1],"how":"parallel"})", "does not show \"ball\""},
        Wrong{R"({"type":"drag","id":5,"object":26,"from":[224,1],"to":[1,1],"how":"along"})", "outside the image"},
        Wrong{R"({"type":"drag","id":5,"object":26,"from":[1,172],"to":[1,1],"how":"along"})", "outside the image"},
        Wrong{R"({"type":"place","id":5,"object":99,"position":[0,0,1],"rotation":null})", "no object 99"},
        Wrong{R"({"type":"drag","id":5,"side":"b","object":26,"from":[1,1],"to":[1,1],"how":"parallel"})", "no side B"},
        Wrong{R"({"type":"place","id":5,"object":26,"position":[0,0,1],"rotation":null,"base":9})", "has changed since"},
        Wrong{R"({"type":"view3d","id":5,"side":"b"})", "no side B"},
        Wrong{R"({"type":"measure","id":5,"a":[0,0],"b":[224,0]})", "outside the image"},
        Wrong{R"({"type":"measure","id":5,"a":[0,172],"b":[0,0]})", "outside the image"},
        Wrong{R"({"type":"region","id":5,"region":[0,0,224,1]})", "no part of the image"},
        Wrong{R"({"type":"region","id":5,"region":[0,0,1,172]})", "no part of the image"},
        Wrong{R"({"type":"temporal","id":5,"side":"b"})", "no side B"}, Wrong{R"({"type":"temporal","id":5,"frames":1})", "two frames"},
        Wrong{R"({"type":"place","id":5,"object":26,"position":[0,0,1]})", "has no \"rotation\""}}) {
    const Json answer = hands.page().answer(one.message, "none");
    EXPECT_TRUE(has(text_of(hands.fault(answer)), one.says)) << one.message << ": " << text_of(answer);
    EXPECT_EQ(number_in(answer, "id"), 5);
  }
  EXPECT_EQ(hands.object_in_scene(ball).find("name")->string()->substr(0, 4), "ball") << "the session goes on";
}

}  // namespace
}  // namespace tofray::test
