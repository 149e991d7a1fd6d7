// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <sys/stat.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "assets/material_library.h"
#include "base/constants.h"
#include "load/builtin.h"
#include "load/fields_finite.h"
#include "load/load.h"
#include "load/provenance.h"
#include "support/text.h"
#include "tofray/tofray.h"
#include "yaml/tree.h"

namespace {

using namespace tofray;
using test::has;
namespace fs = std::filesystem;

std::string refusal(const std::string& text, const load::Settings& settings = {}) {
  try {
    load::scene_from_text(text, "s.yaml", settings);
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

const std::string one_of_each = R"(
camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000, pose: {position: [0, 0, 0], look_at: [0, 0, 1]}}
ambient: {spectrum: sun_am15, level: 5 %}
materials:
  paper: {brdf: lambert, reflectivity: 0.85}
  paint: {brdf: phong, diffuse: 0.4, specular: 0.3, exponent: 20}
objects:
  - plane:    {point: [0, 0, 2.0], normal: [0, 0, -1], material: paper}
  - sphere:   {center: [0.1, 0, 1.3], radius: 25 cm, material: paint, velocity: [0, 0, -1 m/s]}
  - box:      {min: [-0.6, -0.1, 1.2], max: [-0.3, 0.3, 1.5], rotation: {axis: [0, 1, 0], angle: 30 deg}, reflectivity: 0.5}
  - triangle: {vertices: [[0.4, 0.3, 1.6], [0.8, 0.3, 1.6], [0.6, -0.2, 170 cm]], reflectivity: 30 %, name: sail}
)";

TEST(scene, decimal_commas_are_called_so) {
  const std::string quoted = refusal("objects: [{sphere: {center: [0, 0, 1], radius: \"1,5 m\", reflectivity: 0.5}}]");
  EXPECT_TRUE(has(quoted, "s.yaml:1:48: error: radius has a decimal comma\n  got \"1,5 m\", expected a decimal point: \"1.5 m\""))
      << quoted;
  const std::string in_map = refusal("objects: [{sphere: {center: [0, 0, 1], radius: 1 m, reflectivity: 0,5}}]");
  EXPECT_TRUE(has(in_map, "error: reflectivity has a decimal comma")) << in_map;
  EXPECT_TRUE(has(in_map, "expected a decimal point: \"reflectivity: 0.5\"")) << in_map;
  const std::string in_list = refusal("objects: [{sphere: {center: [0, 0, 1,5], radius: 1 m, reflectivity: 0.5}}]");
  EXPECT_TRUE(has(in_list, "write 1.5, not 1,5")) << in_list;
  const std::string set = refusal(one_of_each, {{"objects.1.sphere.radius", "1,5 m"}});
  EXPECT_TRUE(has(set, "has a decimal comma")) << set;
  for (const char* other : {"1,000,5 m", "a,5 m", "1, m", ",5 m"})
    EXPECT_FALSE(has(refusal(one_of_each, {{"objects.1.sphere.radius", other}}), "decimal comma")) << other;
}

TEST(scene, keys_beside_a_shape_s_name_are_one_fault_that_says_how_to_indent) {
  const std::string text = refusal("objects:\n  - plane:\n    point: [0, 0, 2]\n    reflectivity: 0.5\n");
  EXPECT_TRUE(text.starts_with("s.yaml:2:5: error: the keys of plane stand beside it, not below\n")) << text;
  EXPECT_TRUE(has(text, "\"point\" and \"reflectivity\" stand as far to the left as \"plane:\"")) << text;
  EXPECT_TRUE(has(text, "indent them by two spaces more")) << text;
  EXPECT_EQ(text.find("error:"), text.rfind("error:"));
  // What is none of the shape's is not named among them.
  const std::string other = refusal("objects:\n  - plane:\n    point: [0, 0, 2]\n    radius: 3\n");
  EXPECT_TRUE(has(other, "\n  \"point\" stands as far to the left as \"plane:\"")) << other;
  // One key that went astray is named with the shape that it belongs to.
  const std::string one = refusal("objects:\n  - plane: {point: [0, 0, 2]}\n    reflectivity: 0.5\n");
  EXPECT_TRUE(has(one, "as in \"plane: {…, reflectivity: …}\"")) << one;
}

TEST(scene, keys_that_people_try_are_led_to_the_right_ones) {
  for (const auto& [tried, meant] : {std::pair{"lights", "camera.illumination"},
                                     {"illumination", "camera.illumination"},
                                     {"sun", "ambient"},
                                     {"lens", "camera.lens"},
                                     {"spheres", "objects"},
                                     {"modes", "camera.modes"}}) {
    const std::string text = refusal(std::string(tried) + ": []\nobjects: []\n");
    EXPECT_TRUE(has(text, "in the scene; did you mean \"" + std::string(meant) + "\"?")) << text;
  }
}

TEST(scene, index_beyond_a_list_says_how_many_there_are) {
  const std::string text = refusal(one_of_each, {{"objects.7.sphere.radius", "1 m"}});
  EXPECT_TRUE(has(text, "no such element: \"7\" in \"objects\", which has 4\n  they are counted from 0: expected objects.0 … objects.3"))
      << text;
}

TEST(scene, reads_every_kind_of_object_in_si_units) {
  const Scene scene = load::scene_from_text(one_of_each, "box.yaml");
  EXPECT_EQ(scene.name, "box");
  EXPECT_EQ(scene.camera.mode, "MODE_9_5FPS_2000");
  EXPECT_EQ(scene.ambient.spectrum, Ambient::Spectrum::sun_am15);
  EXPECT_EQ(scene.ambient.amount, 0.05);
  ASSERT_EQ(scene.objects.size(), 4U);
  const auto& sphere = std::get<Sphere>(scene.objects[1].shape);
  EXPECT_EQ(sphere.radius, 0.25);
  EXPECT_EQ(sphere.center, (Vec3{0.1, 0, 1.3}));
  EXPECT_EQ(scene.objects[1].velocity_m_per_s, (Vec3{0, 0, -1}));
  EXPECT_EQ(scene.materials[static_cast<std::size_t>(scene.objects[1].material)].exponent, 20);
  EXPECT_EQ(std::get<Plane>(scene.objects[0].shape).normal, (Vec3{0, 0, -1}));
  EXPECT_NEAR(scene.objects[2].rotation.angle_rad, base::pi / 6, 1e-15);
  EXPECT_EQ(scene.materials[static_cast<std::size_t>(scene.objects[2].material)].diffuse, 0.5);
  EXPECT_EQ(std::get<Triangle>(scene.objects[3].shape).vertices[2], (Vec3{0.6, -0.2, 1.7}));
  EXPECT_EQ(scene.objects[3].name, "sail");
}

TEST(scene, reads_cylinders) {
  const Scene scene = load::scene_from_text(
      "objects: [cylinder: {center: [0, 0, 1], axis: [0, 2, 0], radius: 5 cm, height: 20 cm, reflectivity: 0.5}]", "s.yaml");
  const auto& cylinder = std::get<Cylinder>(scene.objects[0].shape);
  EXPECT_EQ(cylinder.center, (Vec3{0, 0, 1}));
  EXPECT_EQ(cylinder.axis, (Vec3{0, 2, 0}));
  EXPECT_EQ(cylinder.radius, 0.05);
  EXPECT_EQ(cylinder.height, 0.2);
  EXPECT_TRUE(has(refusal("objects: [cylinder: {center: [0, 0, 1], axis: [0, 0, 0], radius: 1 m, height: 1 m, reflectivity: 0.5}]"),
                  "axis has no length"));
  EXPECT_TRUE(has(refusal("objects: [cylinder: {center: [0, 0, 1], axis: [0, 1, 0], radius: 1 m, reflectivity: 0.5}]"), "height"));
}

TEST(scene, reads_rectangles_and_disks) {
  const Scene scene = load::scene_from_text(
      "objects: [rectangle: {center: [0, 10 cm, 1], size: [40 cm, 0.2], rotation: {axis: [0, 1, 0], angle: 30 deg}, reflectivity: 0.5},"
      " disk: {center: [0, 0, 2], normal: [0, 3, 0], radius: 15 cm, reflectivity: 0.5}]",
      "s.yaml");
  const auto& rectangle = std::get<Rectangle>(scene.objects[0].shape);
  EXPECT_EQ(rectangle.center, (Vec3{0, 0.1, 1}));
  EXPECT_EQ(rectangle.size, (std::array<double, 2>{0.4, 0.2}));
  EXPECT_NEAR(scene.objects[0].rotation.angle_rad, base::pi / 6, 1e-15);
  const auto& disk = std::get<Disk>(scene.objects[1].shape);
  EXPECT_EQ(disk.center, (Vec3{0, 0, 2}));
  EXPECT_EQ(disk.normal, (Vec3{0, 3, 0}));
  EXPECT_EQ(disk.radius, 0.15);
  const auto refused = [](const std::string& shape) { return refusal("objects: [" + shape + ", reflectivity: 0.5}]"); };
  EXPECT_TRUE(has(refused("rectangle: {center: [0, 0, 1], size: [1, 2, 3]"), "size"));
  EXPECT_TRUE(has(refused("rectangle: {center: [0, 0, 1], size: 1"), "size"));
  EXPECT_TRUE(has(refused("rectangle: {center: [0, 0, 1], size: [1, 0]"), "size"));
  EXPECT_TRUE(has(refused("rectangle: {center: [0, 0, 1]"), "size"));
  EXPECT_TRUE(has(refused("disk: {center: [0, 0, 1], normal: [0, 0, 0], radius: 1 m"), "normal has no length"));
  EXPECT_TRUE(has(refused("disk: {center: [0, 0, 1], normal: [0, 0, 1]"), "radius"));
}

TEST(scene, reads_capsules_and_cones) {
  const Scene scene = load::scene_from_text(
      "objects: [capsule: {start: [0, 0, 1], end: [0, 20 cm, 1], radius: 5 cm, reflectivity: 0.5},"
      " cone: {base: [0, 0, 2], axis: [0, -2, 0], radius: 10 cm, height: 0.3 m, reflectivity: 0.5}]",
      "s.yaml");
  const auto& capsule = std::get<Capsule>(scene.objects[0].shape);
  EXPECT_EQ(capsule.start, (Vec3{0, 0, 1}));
  EXPECT_EQ(capsule.end, (Vec3{0, 0.2, 1}));
  EXPECT_EQ(capsule.radius, 0.05);
  const auto& cone = std::get<Cone>(scene.objects[1].shape);
  EXPECT_EQ(cone.base, (Vec3{0, 0, 2}));
  EXPECT_EQ(cone.axis, (Vec3{0, -2, 0}));
  EXPECT_EQ(cone.radius, 0.1);
  EXPECT_EQ(cone.height, 0.3);
  const auto refused = [](const std::string& shape) { return refusal("objects: [" + shape + ", reflectivity: 0.5}]"); };
  EXPECT_TRUE(has(refused("capsule: {start: [0, 0, 1], end: [0, 0, 1], radius: 1 m"), "the capsule ends where it starts"));
  EXPECT_TRUE(has(refused("capsule: {start: [0, 0, 1], end: [0, 0, 2]"), "radius"));
  EXPECT_TRUE(has(refused("cone: {base: [0, 0, 1], axis: [0, 0, 0], radius: 1 m, height: 1 m"), "axis has no length"));
  EXPECT_TRUE(has(refused("cone: {base: [0, 0, 1], axis: [0, 1, 0], radius: 1 m"), "height"));
}

TEST(scene, reads_rough_materials) {
  const std::string around = "objects: [sphere: {center: [0, 0, 1], radius: 1 m, material: {brdf: oren_nayar, reflectivity: 0.5";
  const Material one = load::scene_from_text(around + ", roughness: 30 deg}}]", "s.yaml").materials[0];
  EXPECT_EQ(one.brdf, Material::Brdf::oren_nayar);
  EXPECT_EQ(one.diffuse, 0.5);
  EXPECT_NEAR(one.roughness_rad, 0.5235987756, 1e-9);
  EXPECT_TRUE(has(refusal(around + "}}]"), "roughness"));
  EXPECT_TRUE(has(refusal(around + ", roughness: 100 deg}}]"), "roughness is out of range"));
}

TEST(scene, reads_small_mirrors_and_retro_reflectors) {
  const std::string around = "objects: [sphere: {center: [0, 0, 1], radius: 1 m, material: {brdf: ";
  const Material metal = load::scene_from_text(around + "ggx, specular: 0.9, alpha: 0.1}}]", "s.yaml").materials[0];
  EXPECT_EQ(metal.brdf, Material::Brdf::ggx);
  EXPECT_EQ(metal.diffuse, 0);
  EXPECT_EQ(metal.specular, 0.9);
  EXPECT_EQ(metal.alpha, 0.1);
  // Light that the mirrors reflect does not reach the ground: both may be white.
  EXPECT_EQ(load::scene_from_text(around + "ggx, specular: 1, diffuse: 1, alpha: 1}}]", "s.yaml").materials[0].diffuse, 1);
  const Material sheet = load::scene_from_text(around + "retro, diffuse: 0.1, retro: 0.3, spread: 0.5 deg}}]", "s.yaml").materials[0];
  EXPECT_EQ(sheet.brdf, Material::Brdf::retro);
  EXPECT_EQ(sheet.diffuse, 0.1);
  EXPECT_EQ(sheet.retro, 0.3);
  EXPECT_NEAR(sheet.spread_rad, 0.0087266463, 1e-9);
  EXPECT_TRUE(has(refusal(around + "ggx, specular: 0.9}}]"), "alpha"));
  EXPECT_TRUE(has(refusal(around + "ggx, specular: 0.9, alpha: 0.0009}}]"), "alpha is out of range"));
  EXPECT_TRUE(has(refusal(around + "ggx, specular: 0.9, alpha: 0.5, exponent: 3}}]"), "exponent"));
  EXPECT_TRUE(has(refusal(around + "retro, diffuse: 0.8, retro: 0.3, spread: 1 deg}}]"), "diffuse + retro is more than 1"));
  EXPECT_TRUE(has(refusal(around + "retro, retro: 0.3, spread: 50 deg}}]"), "spread is out of range"));
}

TEST(scene, names_materials_of_the_library) {
  const Scene scene = load::scene_from_text(
      "materials: {skin: {reflectivity: 0.1}}\nobjects: [sphere: {center: [0, 0, 1], radius: 1 m, material: wood}, sphere: {center: [0, 0, "
      "3], "
      "radius: 1 m, material: skin}, sphere: {center: [0, 0, 5], radius: 1 m, material: wood}]",
      "s.yaml");
  ASSERT_EQ(scene.materials.size(), 2U);  // once, however often it is named
  EXPECT_EQ(scene.materials[1].name, "wood");
  EXPECT_EQ(scene.materials[1].diffuse, 0.634);
  EXPECT_EQ(scene.objects[0].material, 1);
  EXPECT_EQ(scene.objects[1].material, 0);  // the scene's own comes first
  EXPECT_EQ(scene.objects[2].material, 1);
  const std::string said = refusal("objects: [sphere: {center: [0, 0, 1], radius: 1 m, material: skim}]");
  EXPECT_TRUE(has(said, "did you mean \"skin\"?")) << said;
  EXPECT_TRUE(has(said, "`tofray list materials`")) << said;
}

TEST(material_library, is_in_order_and_sound) {
  const auto& library = assets::material_library();
  ASSERT_GT(library.size(), 20U);
  for (std::size_t i = 0; i < library.size(); ++i) {
    const assets::LibraryMaterial& one = library[i];
    if (i > 0) {
      EXPECT_LT(library[i - 1].material.name, one.material.name);
    }
    EXPECT_FALSE(one.what.empty() || one.source.empty()) << one.material.name;
    const std::string object = "objects: [sphere: {center: [0, 0, 1], radius: 1 m, material: " + one.material.name + "}]";
    EXPECT_EQ(load::scene_from_text(object, "s.yaml").materials[0].name, one.material.name);
  }
  std::ostringstream committed;
  committed << std::ifstream(TOFRAY_SOURCE_DIR "/docs/reference/materials.md").rdbuf();
  EXPECT_EQ(committed.str(), assets::material_page()) << "write it anew: tofray list materials > docs/reference/materials.md";
}

// The sheets send back what the standard asks for at both angles: R_A = f_r·cosθ_l·cosθ_v, perpendicularly.
TEST(material_library, sheets_have_their_coefficients) {
  const auto coefficient = [](const char* name, double degrees) {
    const Material& one = assets::find_library_material(name)->material;
    const auto squared = [](double angle) { return 4 * std::pow(std::sin(angle / 2), 2); };
    const double width = squared(one.spread_rad) / (std::sqrt(2.0) - 1), fall = 1 + squared(degrees * base::pi / 180) / width;
    return one.retro / (base::pi * width * fall * fall);
  };
  EXPECT_NEAR(coefficient("retro-sheet", 0.2), 250, 2);
  EXPECT_NEAR(coefficient("retro-sheet", 0.5), 95, 1);
  EXPECT_NEAR(coefficient("retro-sheet-simple", 0.2), 70, 1);
  EXPECT_NEAR(coefficient("retro-sheet-simple", 0.5), 30, 0.5);
}

TEST(scene, may_be_empty) {
  EXPECT_EQ(load::scene_from_text("objects: []", "s.yaml").objects.size(), 0U);
  EXPECT_TRUE(has(refusal("{}"), "lacks the key \"objects\""));
  EXPECT_TRUE(has(refusal(""), "there is nothing in it"));
  EXPECT_FALSE(has(refusal(""), "tofray init")) << "there is no such command";
  EXPECT_TRUE(has(refusal(""), "objects")) << "a scene's least";
}

TEST(scene, reports_all_faults_at_once_in_order) {
  const std::string what =
      refusal("camera: {itegration_time: 1 ms}\nobjects:\n  - sphere: {center: [0, 0], radius: -1 m, reflectivity: 2}\n  - ball: {}\n");
  const char* in_order[] = {"s.yaml:1:10: error: unknown key \"itegration_time\" in camera; did you mean \"integration_time\"?",
                            "s.yaml:3:22: error: center has the wrong number of elements", "s.yaml:3:38: error: radius is out of range",
                            "s.yaml:3:58: error: reflectivity is out of range", "s.yaml:4:5: error: unknown key \"ball\""};
  std::size_t at = 0;
  for (const char* line : in_order) {
    const std::size_t found = what.find(line, at);
    EXPECT_NE(found, std::string::npos) << line << "\n not in order in\n" << what;
    at = found == std::string::npos ? at : found;
  }
}

TEST(scene, refuses_what_is_degenerate) {
  const std::pair<const char*, const char*> cases[] = {
      {"plane: {point: [0,0,1], normal: [0,0,0], reflectivity: 0.5}", "normal has no length"},
      {"plane: {point: [0,0,1], normal: [1e-13,-2e-13,3e-13], reflectivity: 0.5}",
       "normal has no length\n  got [1e-13, -2e-13, 3e-13], expected a direction"},
      {"plane: {point: [0,0,1], normal: [0,0,1e-9], reflectivity: 0.5}", "normal has no length"},
      {"sphere: {center: [0,0,1], radius: 0, reflectivity: 0.5}", "radius is out of range"},
      {"box: {min: [0,0,1], max: [1,0,2], reflectivity: 0.5}", "min is not below its max in y"},
      {"box: {min: [0,0,3], max: [1,1,2], reflectivity: 0.5}", "min is not below its max in z"},
      {"triangle: {vertices: [[0,0,1],[1,0,1],[2,0,1]], reflectivity: 0.5}", "no area"},
      {"triangle: {vertices: [[0,0,1],[0,0,1],[2,0,1]], reflectivity: 0.5}", "no area"},
      {"triangle: {vertices: [[0,0,1],[1e5,1e5,1],[5e4,5e4,1]], reflectivity: 0.5}", "no area"},
      {"sphere: {center: [0,0,1], radius: 1 m, rotation: {axis: [0,0,0], angle: 1 deg}, reflectivity: 0.5}", "axis has no length"},
      {"sphere: {center: [0,0,1], radius: 1 m, material: {brdf: phong_original, diffuse: 0.5, specular: 0.3, exponent: 2}}",
       "phong_original"},
      {"sphere: {center: [0,0,1], radius: 1 m, material: {brdf: phong, diffuse: 0.8, specular: 0.3, exponent: 2}}",
       "diffuse + specular is more than 1"},
      {"sphere: {center: [0,0,1], radius: 1 m, material: nope}", "no material \"nope\""},
      {"sphere: {center: [0,0,1], radius: 1 m}", "lacks a key"},
      {"sphere: {center: [0,0,1], radius: 1 m, material: a, reflectivity: 0.5}", "say the same thing"},
      {"sphere: {center: [0,0,1 s], radius: 1 m, reflectivity: 0.5}", "is a time"},
  };
  for (const auto& [object, expected] : cases)
    EXPECT_TRUE(has(refusal("objects: [" + std::string(object) + "]"), expected)) << object << "\n"
                                                                                  << refusal("objects: [" + std::string(object) + "]");
  EXPECT_TRUE(has(refusal("objects: []\ncamera: {pose: {position: [0,0,1], look_at: [0,0,1]}}"), "looks at the point where it stands"));
  EXPECT_TRUE(has(refusal("objects: []\ncamera: {pose: {look_at: [0,-3,0]}}"), "up is its direction of view"));
  EXPECT_TRUE(has(refusal("objects: []\nambient: {spectrum: sun_am15}"), "how much light"));
  EXPECT_TRUE(has(refusal("objects: []\nambient: {spectrum: none, level: 1}"), "its spectrum is none"));
  EXPECT_TRUE(has(refusal("objects: []\nambient: {spectrum: sun_am15, level: 1, direction: [0,0,0]}"), "direction has no length"));
  EXPECT_TRUE(has(refusal("objects: []\nambient: {spectrum: sun_am15, level: 1, illuminance: 1 lx}"), "say the same thing"));
  EXPECT_TRUE(
      has(refusal("objects: []\nambient: {spectrum: {wavelength: [800 nm, 700 nm], irradiance: [0, 0]}, level: 1}"), "does not ascend"));
}

// 5 klx and 0.4 W/m2 are said of daylight, as a rule: what else it may be, one says.
TEST(scene, ambient_light_is_the_suns_unless_it_says_otherwise) {
  for (const char* amount : {"level: 5 %", "illuminance: 5 klx", "band_irradiance: 0.4 W/m2"}) {
    const Scene scene = load::scene_from_text("objects: []\nambient: {" + std::string(amount) + "}\n", "s.yaml");
    EXPECT_EQ(scene.ambient.spectrum, Ambient::Spectrum::sun_am15) << amount;
    EXPECT_GT(scene.ambient.amount, 0) << amount;
  }
  EXPECT_TRUE(has(refusal("objects: []\nambient: {}"), "how much light"));
}

TEST(scene, takes_an_edge_at_full_reflection) {
  EXPECT_EQ(refusal("objects: [sphere: {center: [0,0,1], radius: 1 m, material: {brdf: phong, diffuse: 0.7, specular: 0.3, exponent: 2}}]"),
            "");
}

TEST(scene, settings_change_any_key_before_it_is_read) {
  const Scene scene = load::scene_from_text(one_of_each, "s.yaml",
                                            {{"ambient.level", "20 %"},
                                             {"objects.1.sphere.radius", "20 cm"},
                                             {"objects.0.plane.point", "[0, 0, 3]"},
                                             {"materials.paper.reflectivity", "0.1"},
                                             {"camera.lens.f_number", "1.2"}});
  EXPECT_EQ(scene.ambient.amount, 0.2);
  EXPECT_EQ(std::get<Sphere>(scene.objects[1].shape).radius, 0.2);
  EXPECT_EQ(std::get<Plane>(scene.objects[0].shape).point[2], 3);
  EXPECT_EQ(scene.materials[0].diffuse, 0.1);
  EXPECT_EQ(load_camera(scene).lens.f_number, 1.2);
  EXPECT_TRUE(has(refusal(one_of_each, {{"ambient.levle", "5 %"}}),
                  "--set ambient.levle: error: unknown key \"levle\" in ambient; did you mean \"level\"?"));
  EXPECT_TRUE(has(refusal(one_of_each, {{"objects.4.sphere.radius", "1"}}), "no such element: \"4\""));
  EXPECT_TRUE(has(refusal(one_of_each, {{"ambient..level", "1"}}), "empty part"));
  EXPECT_TRUE(has(refusal(one_of_each, {{"ambient.level", "[1"}}), "--set ambient.level: error: "));
}

TEST(built_in_scenes, load_with_their_cameras_and_say_what_they_are) {
  EXPECT_EQ(load::builtin_scenes().size(), 20U);
  for (const auto& builtin : load::builtin_scenes()) {
    const Scene scene = load_scene(builtin.name);
    EXPECT_EQ(scene.name, builtin.name);
    EXPECT_TRUE(test::finite(scene));
    EXPECT_TRUE(test::finite(load_camera(scene)));
    EXPECT_GT(builtin.description.size(), 20U);
  }
  const Scene bench = load_scene("bench-primitives");
  int count[4] = {};
  for (const auto& object : bench.objects) ++count[object.shape.index()];
  EXPECT_EQ(count[0], 3);   // planes
  EXPECT_EQ(count[1], 4);   // spheres
  EXPECT_EQ(count[2], 2);   // boxes
  EXPECT_EQ(count[3], 20);  // triangles
  EXPECT_EQ(bench.ambient.amount, 0.05);
}

TEST(built_in_profiles, say_where_every_number_comes_from) {
  EXPECT_FALSE(load::builtin_profiles().empty());
  for (const auto& builtin : load::builtin_profiles())
    for (const auto& number : load::unsourced_numbers(yaml::parse_tree(builtin.text, builtin.name + ".yaml"))) ADD_FAILURE() << number;
  EXPECT_EQ(load::unsourced_numbers(yaml::parse_tree("a: {b: 1, source: x}\nc: 2\nd: {value: 3, assumed: y}", "f")).size(), 1U);
}

TEST(names, of_no_scene_suggest_the_nearest) {
  try {
    load_scene("dmeo");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::io);
    EXPECT_TRUE(has(e.what(), "did you mean \"demo\"?")) << e.what();
  }
}

// A folder with a scene, profiles beside, below and outside it.
class profile_of_a_scene : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "tofray_in_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    top_ = name;
    fs::create_directories(top_ / "inside/below");
    profile(top_ / "inside/mine.yaml", "beside");
    profile(top_ / "inside/below/mine.yaml", "below");
    profile(top_ / "outside.yaml", "outside");
    fs::create_directories(top_ / "inside-too");
    profile(top_ / "inside-too/mine.yaml", "in a folder whose name begins alike");
    fs::create_symlink("../outside.yaml", top_ / "inside/link.yaml");
    fs::create_symlink("..", top_ / "inside/up");
    fs::create_symlink("mine.yaml", top_ / "inside/good-link.yaml");
    ASSERT_EQ(mkfifo((top_ / "inside/pipe.yaml").c_str(), 0600), 0);
  }
  void TearDown() override { fs::remove_all(top_); }

  static void profile(const fs::path& path, const std::string& name) {
    std::string text(load::find_builtin(load::builtin_profiles(), "pico-flexx")->text);
    text.replace(text.find("name: pico-flexx"), 16, "name: " + name);
    std::ofstream(path) << text;
  }

  // The name of the profile that was read, or the message.
  std::string load(const std::string& profile, const std::string& root = {}) {
    std::ofstream(top_ / "inside/scene.yaml") << "objects: []\ncamera: {profile: \"" << profile << "\"}\n";
    CameraOptions options;
    options.root = root;
    try {
      return load_camera(load_scene((top_ / "inside/scene.yaml").string()), options).name;
    } catch (const Error& e) {
      return e.what();
    }
  }

  fs::path top_;
};

TEST_F(profile_of_a_scene, lies_beside_it_or_below) {
  EXPECT_EQ(load("mine.yaml"), "beside");
  EXPECT_EQ(load("./mine.yaml"), "beside");
  EXPECT_EQ(load("below/mine.yaml"), "below");
  EXPECT_EQ(load("good-link.yaml"), "beside");
  EXPECT_EQ(load("pico-flexx"), "pico-flexx");
}

TEST_F(profile_of_a_scene, is_never_read_from_elsewhere) {
  std::vector<std::string> escapes = {"../outside.yaml",
                                      "below/../../outside.yaml",
                                      "link.yaml",
                                      "up/outside.yaml",
                                      "up/inside/mine.yaml",
                                      (top_ / "outside.yaml").string(),
                                      (top_ / "inside/mine.yaml").string(),
                                      "/etc/passwd",
                                      "/dev/zero",
                                      "/dev/stdin",
                                      "/proc/self/environ",
                                      "/proc/self/fd/0",
                                      "..",
                                      ".",
                                      "below",
                                      "pipe.yaml",
                                      "",
                                      "mine.yaml/",
                                      "mine.yaml\\0",
                                      "mine.yaml\\0.yaml"};
  for (const char* prefix : {"file:",        "file://",          "http://",         "//server/", "\\\\\\\\server\\\\",
                             "~/",           "$HOME/",           "`pwd`/",          "%2e%2e/",   "%2e%2e%2f",
                             "..%2f",        "....//",           "..\\\\",          "./../",     "below/./../../",
                             "\\x2e\\x2e/",  "/proc/self/root/", "/proc/self/cwd/", "${PWD}/",   "$(pwd)/",
                             "../inside/../"})
    for (const char* file : {"outside.yaml", "../outside.yaml"}) escapes.push_back(std::string(prefix) + file);
  escapes.push_back("../inside-too/mine.yaml");
  escapes.push_back((top_ / "inside-too/mine.yaml").string());
  EXPECT_GE(escapes.size(), 60U);
  for (const auto& path : escapes) {
    const std::string what = load(path);
    EXPECT_TRUE(has(what, "error: ")) << path << " -> " << what;
    EXPECT_TRUE(has(what, "scene.yaml:2:")) << path << " -> " << what;
  }
}

TEST_F(profile_of_a_scene, may_lie_below_a_root_that_the_user_gives) {
  EXPECT_EQ(load("../outside.yaml", top_.string()), "outside");
  EXPECT_EQ(load((top_ / "outside.yaml").string(), top_.string()), "outside");
  EXPECT_EQ(load("mine.yaml", top_.string()), "beside");
  EXPECT_TRUE(has(load("../../etc/passwd", top_.string()), "leads out"));
  EXPECT_TRUE(has(load("../outside.yaml", (top_ / "inside").string()), "leads out"));
  EXPECT_TRUE(has(load("../inside-too/mine.yaml", (top_ / "inside").string()), "leads out"));
}

TEST(overrides, of_the_profile_name_the_scene_where_they_are_wrong) {
  const auto camera_error = [](const std::string& camera) {
    try {
      load_camera(load::scene_from_text("objects: []\ncamera:\n  profile: pico-flexx\n" + camera, "s.yaml"));
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(camera_error("  integration_time: 500 us\n  lens: {f_number: 1.2, distortion: {k1: 0}}\n  illumination.0.power: 0.4 W\n"), "");
  EXPECT_TRUE(
      has(camera_error("  lens: {f_nubmer: 1.2}\n"), "s.yaml:4:10: error: unknown key \"f_nubmer\" in lens; did you mean \"f_number\"?"));
  EXPECT_TRUE(has(camera_error("  integration_time: 80\n"), "s.yaml:4:3: error: integration_time has no unit"));
  EXPECT_TRUE(
      has(camera_error("  mode: MODE_9_5FPS_200\n"), "s.yaml:4:9: error: no mode \"MODE_9_5FPS_200\"; did you mean \"MODE_9_5FPS_2000\"?"));
  EXPECT_TRUE(has(camera_error("  illumination: [{power: 0.4 W}]\n"), "lacks the key \"pattern\""));
}

}  // namespace
