// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A mesh in place of a scene: of whatever unit and shape it is seen, or the scale that it lacks is told.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/text.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

using Corner = std::array<double, 3>;

struct Shape {
  std::vector<Corner> corners;
  std::vector<std::vector<std::size_t>> faces;
  [[nodiscard]] std::string obj(double unit = 1) const {
    std::string text;
    for (const Corner& p : corners) {
      text += "v";
      for (const double x : p) text += " " + base::number_text(unit * x);
      text += "\n";
    }
    for (const auto& face : faces) {
      text += "f";
      for (const std::size_t i : face) text += " " + std::to_string(i + 1);
      text += "\n";
    }
    return text;
  }
};

Shape brick(double x, double y, double z) {
  Shape out;
  for (int i = 0; i < 8; ++i) out.corners.push_back({(i & 4 ? x : -x) / 2, (i & 2 ? y : -y) / 2, (i & 1 ? z : -z) / 2});
  out.faces = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  return out;
}

Shape sheet(std::size_t across) {
  Shape out;
  for (const auto& [a, b] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    Corner& p = out.corners.emplace_back();
    p[(across + 1) % 3] = a, p[(across + 2) % 3] = b;
  }
  out.faces = {{0, 1, 2, 3}};
  return out;
}

Shape round_shape() {
  constexpr std::size_t rows = 16, columns = 32;
  Shape out;
  for (std::size_t i = 0; i <= rows; ++i)
    for (std::size_t k = 0; k < columns; ++k) {
      const double down = std::numbers::pi * static_cast<double>(i) / rows, round = 2 * std::numbers::pi * static_cast<double>(k) / columns;
      out.corners.push_back({0.5 * std::sin(down) * std::cos(round), 0.5 * std::cos(down), 0.5 * std::sin(down) * std::sin(round)});
    }
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t k = 0; k < columns; ++k) {
      const std::size_t next = (k + 1) % columns;
      out.faces.push_back({i * columns + k, i * columns + next, (i + 1) * columns + next, (i + 1) * columns + k});
    }
  return out;
}

const std::pair<const char*, Shape> shapes[] = {{"cube", brick(1, 1, 1)},     {"rod", brick(1, 0.02, 0.02)}, {"ball", round_shape()},
                                                {"sheet across x", sheet(0)}, {"sheet across y", sheet(1)},  {"sheet across z", sheet(2)}};

struct Seen {
  std::size_t outline = 0;  ///< pixels whose ray hits the mesh
  std::size_t valid = 0;    ///< of those, with depth
};

class mesh_alone : public testing::Test {
 protected:
  [[nodiscard]] Result tool(const Arguments& arguments) const { return run(arguments, in_folder(folder_.path())); }
  void save(const std::string& name, const std::string& text) const { write(folder_ / name, text); }

  Seen see(const std::string& file, Result& result, const Arguments& more = {}) const {
    Arguments words = {"render", file, "-o", "out", "--emit", "npz", "--arrays", "z_m,gt_object_id"};
    words.insert(words.end(), more.begin(), more.end());
    result = tool(words);
    EXPECT_EQ(result.code, 0) << result.err;
    Seen out;
    const std::vector<double> z = numbers_of(folder_ / "out/frame.npz", "z_m"),
                              object = numbers_of(folder_ / "out/frame.npz", "gt_object_id");
    for (std::size_t i = 0; i < z.size(); ++i) {
      out.outline += object[i] == 0 ? 1 : 0;
      out.valid += object[i] == 0 && std::isfinite(z[i]) ? 1 : 0;
    }
    return out;
  }

  Folder folder_;
};

/// The words behind "--set" in a text, up to a blank.
std::string setting_in(const std::string& text) {
  const std::size_t at = text.find("--set objects.0.mesh.scale=");
  if (at == std::string::npos) return {};
  return text.substr(at + 6, text.find(' ', at + 6) - at - 6);
}

}  // namespace

TEST_F(mesh_alone, that_is_flat_is_seen_in_all_of_its_outline_not_the_floor) {
  for (const auto& [name, shape] : shapes) {
    SCOPED_TRACE(name);
    save("shape.obj", shape.obj());
    Result result;
    const Seen on_floor = see("shape.obj", result, {"--noise", "off"});
    const Seen without = see("shape.obj", result, {"--noise", "off", "--set", "objects.1.plane.point=[0, 90, 0]"});
    EXPECT_EQ(on_floor.outline, without.outline);
    EXPECT_GT(on_floor.outline, 500U);
  }
}

TEST_F(mesh_alone, that_has_a_flat_ground_of_its_own_shows_it) {
  Shape shape = brick(0.3, 0.3, 0.3);
  const std::size_t first = shape.corners.size();
  for (const Corner& p : sheet(1).corners) shape.corners.push_back({p[0], -0.15, p[2]});
  shape.faces.push_back({first, first + 1, first + 2, first + 3});
  save("shape.obj", shape.obj());
  Result result;
  EXPECT_EQ(see("shape.obj", result).outline, see("shape.obj", result, {"--set", "objects.1.plane.point=[0, 90, 0]"}).outline);
}

TEST_F(mesh_alone, of_any_unit_is_seen_or_told_with_the_scale_that_helps) {
  int seen_at_once = 0, told = 0;
  for (const auto& [name, shape] : shapes)
    for (const double unit : {1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.3, 1.0, 1.5, 2.0, 3.0, 10.0, 100.0, 1000.0}) {
      SCOPED_TRACE(std::string(name) + " of " + base::number_text(unit) + " m");
      save("shape.obj", shape.obj(unit));
      Result result;
      const Seen seen = see("shape.obj", result);
      const std::string setting = setting_in(result.err);
      if (setting.empty()) {
        EXPECT_GE(2 * seen.valid, seen.outline);
        EXPECT_GT(seen.outline, 15U);
        ++seen_at_once;
        continue;
      }
      ++told;
      EXPECT_TRUE(has(result.err, "shape.obj: warning: it measures ")) << result.err;
      EXPECT_FALSE(has(result.err, "objects.0 (shape.obj) measures")) << "told twice: " << result.err;
      Result helped;
      const Seen better = see("shape.obj", helped, {"--set", setting});
      EXPECT_GE(2 * better.valid, better.outline) << setting;
      EXPECT_GT(better.outline, 15U) << setting;
      EXPECT_EQ(setting_in(helped.err), "") << setting << "\n" << helped.err;
    }
  EXPECT_GT(seen_at_once, 15);
  EXPECT_GT(told, 15);
}

TEST_F(mesh_alone, in_millimetres_is_told_so) {
  save("cube.obj", brick(400, 250, 300).obj());
  const Result result = tool({"check", "cube.obj"});
  EXPECT_EQ(result.code, 0);
  EXPECT_TRUE(has(result.err, "cube.obj: warning: it measures 400 x 250 x 300 m, and is seen whole from ")) << result.err;
  EXPECT_TRUE(has(result.err, "\n  are its numbers millimetres? --set objects.0.mesh.scale=0.001 makes it 0.40 x 0.25 x 0.30 m\n"))
      << result.err;
}

TEST_F(mesh_alone, that_is_small_is_seen_from_where_the_camera_does_not_saturate) {
  save("cube.obj", brick(0.02, 0.02, 0.02).obj());
  Result result;
  const Seen seen = see("cube.obj", result);
  // 2 cm from the distance at which a pixel sees 1.4 mm: about 14 × 14 pixels, and more for what the cube's other sides add.
  EXPECT_GT(seen.valid, 150U);
  EXPECT_EQ(seen.valid, seen.outline);
}

TEST_F(mesh_alone, beyond_the_world_is_told_with_the_scale_that_helps) {
  save("cube.obj", brick(3e5, 3e5, 3e5).obj());
  const Result result = tool({"render", "cube.obj"});
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err.rfind("cube.obj: error: no triangle of \"cube.obj\" is in the world\n", 0), 0U) << result.err;
  EXPECT_EQ(setting_in(result.err), "objects.0.mesh.scale=0.000001)\n") << result.err;
  EXPECT_EQ(tool({"check", "cube.obj", "--set", "objects.0.mesh.scale=0.000001"}).code, 0);
}

TEST_F(mesh_alone, of_a_name_that_is_no_utf8_is_told_so) {
  save("caf\xE9.obj", brick(1, 1, 1).obj());
  const Result result = tool({"render", "caf\xE9.obj"});
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err.rfind("caf\\xe9.obj: error: the file's name is not UTF-8\n", 0), 0U) << result.err;
  save("caf\xC3\xA9.obj", brick(1, 1, 1).obj());
  EXPECT_EQ(tool({"check", "caf\xC3\xA9.obj"}).code, 0);
}

TEST_F(mesh_alone, whose_triangles_have_no_area_is_an_error) {
  save("line.obj", "v 0 0 0\nv 0.1 0.2 0.3\nv 0.3 0.6 0.9\nv 0.1 0.2 0.3\nf 1 2 3\nf 2 4 2\n");
  const Result result = tool({"render", "line.obj"});
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err.rfind("line.obj: error: no triangle of \"line.obj\" has an area\n", 0), 0U) << result.err;
  save("scene.yaml", "objects:\n  - mesh: {file: line.obj, reflectivity: 0.5}\n");
  EXPECT_TRUE(has(tool({"check", "scene.yaml"}).err, "scene.yaml:2:18: error: no triangle of \"line.obj\" has an area"));
  save("thin.obj", "v 0 0 0\nv 1 0 0\nv 1 1e-5 0\nf 1 2 3\n");
  EXPECT_EQ(tool({"check", "thin.obj"}).code, 0);
}

TEST(depth_png, says_where_it_cannot_hold_a_depth) {
  const Folder folder;
  // One slow modulation frequency (0.5 MHz, 300 m), much light: a wall at 70 m has a depth.
  const auto err_of = [&](const char* z) {
    write(folder / "wall.yaml", std::string("camera: {profile: pico-flexx}\nobjects:\n  - plane: {point: [0, 0, ") + z +
                                    "], normal: [0, 0, -1], reflectivity: 1}\n");
    const Result made =
        run(with_small_sensor(
                {"render", "wall.yaml", "-o", "out", "--noise", "off", "--set", "camera.illumination.0.power=50 W", "--set",
                 "camera.modes.MODE_9_5FPS_2000.sequence=[{modulation_frequency: 500 kHz, reference_phase: 0 deg, integration_time: 1 ms}, "
                 "{modulation_frequency: 500 kHz, reference_phase: 90 deg, integration_time: 1 ms}, "
                 "{modulation_frequency: 500 kHz, reference_phase: 180 deg, integration_time: 1 ms}, "
                 "{modulation_frequency: 500 kHz, reference_phase: 270 deg, integration_time: 1 ms}]"}),
            in_folder(folder.path()));
    EXPECT_EQ(made.code, 0) << made.err;
    return made.err;
  };
  const std::string far = err_of("70");
  EXPECT_TRUE(has(far, "warning: depth.png is 0 in 616 pixels whose z is beyond 65.535 m")) << far;
  EXPECT_FALSE(has(err_of("60"), "depth.png is 0 in"));
}

}  // namespace tofray::test
