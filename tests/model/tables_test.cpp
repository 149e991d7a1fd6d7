// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "load/reference.h"
#include "model/lines.h"
#include "results/meta.h"
#include "support/members.h"
#include "support/meshes.h"
#include "tofray/tofray.h"

namespace {

using namespace tofray;
using model::Row;
using model::Slot;
using model::Table;
using test::each_member;

/// A camera whose lists and curves hold something.
Camera full_camera(Pattern::Kind pattern = Pattern::Kind::table, Waveform::Kind waveform = Waveform::Kind::measured) {
  Camera camera = load_camera("pico-flexx");
  const Curve share{{840e-9, 850e-9, 860e-9}, {0.1, 0.3, 0.2}};
  camera.lens.vignetting = Lens::Vignetting::table, camera.lens.vignetting_table = {{0.1, 0.5, 1}, {1, 0.8, 0.3}};
  camera.filter.table = camera.pixel.quantum_efficiency = share, camera.pixel.contrast = {{20e6, 100e6}, {0.9, 0.7}};
  Illumination& light = camera.illumination[0];
  light.pattern.kind = pattern, light.pattern.rows = 2, light.pattern.columns = 3, light.pattern.samples = {1, 2, 3, 4, 5, 6};
  light.pattern.half_angle_rad = 0.5;
  light.waveform.kind = waveform, light.waveform.harmonics = 2, light.waveform.correlation = {1, 0.7, 0, -0.7, -1, -0.7, 0, 0.7};
  return camera;
}

Scene full_scene() {
  Scene scene = load_scene("bench-primitives");
  scene.objects.resize(12);
  scene.ambient = {Ambient::Spectrum::table, Ambient::Quantity::level, 0.3, {800e-9, 900e-9}, {1e9, 2e9}, Vec3{0.1, 0.7, 0.2}};
  scene.objects.push_back({"ball", test::shared(test::single(test::icosphere(0))), 0, {}, {}, {}});
  scene.objects.push_back({"sail", Triangle{{{{0, 0, 1}, {1, 0, 1}, {0, 1, 1.5}}}}, 0, {}, {{0, 1, 0}, 0.3}, {0, 0, 1}});
  scene.objects.push_back({"card", Rectangle{{0, 0, 1}, {0.3, 0.2}}, 0, {}, {}, {}});
  return scene;
}

std::string meta(const Scene& scene, const Camera& camera) { return results::frame_meta(scene, camera, {.seed = 1}, 0); }

/// Another value for a member; false where it holds none of its own.
bool change(const Row& row, const Slot& slot) {
  bool done = false;
  test::each_real(slot, [&](double& number) { done = true, number += number == 0 ? 1e-3 : 1e-3 * number; });
  if (auto* const* whole = std::get_if<int*>(&slot)) **whole += 1, done = true;
  if (auto* const* seed = std::get_if<unsigned long long*>(&slot)) **seed += 1, done = true;
  if (auto* const* flag = std::get_if<bool*>(&slot)) **flag = !**flag, done = true;
  if (auto* const* text = std::get_if<std::string*>(&slot)) **text += "x", done = true;
  if (const auto* choice = std::get_if<model::ChoiceSlot>(&slot)) {
    const auto count = static_cast<int>(row.form.names.size());
    choice->set(choice->at, (choice->get(choice->at) + 1) % count), done = true;
  }
  return done;
}

/// Calls act(record, row, slot, path) with a fresh copy for each member.
template <class T, class Act>
void for_each_changed(const T& original, const Act& act) {
  std::size_t count = 0, at = 0;
  T counted = original;
  each_member(counted, [&](const Row&, const Slot&, const std::string&) { ++count; });
  ASSERT_GT(count, 50U);
  for (std::size_t wanted = 0; wanted < count; ++wanted) {
    T copy = original;
    at = 0;
    each_member(copy, [&](const Row& row, const Slot& slot, const std::string& path) {
      if (at++ == wanted) act(copy, row, slot, path);
    });
  }
}

}  // namespace

TEST(meta, tells_any_two_cameras_apart) {
  const Camera original = full_camera();
  const std::string before = meta({}, original);
  std::set<std::string> told;
  for_each_changed(original, [&](const Camera& camera, const Row& row, const Slot& slot, const std::string& path) {
    if (!change(row, slot)) return;
    EXPECT_NE(meta({}, camera), before) << path;
    told.insert(row.member);
  });
  EXPECT_GE(told.size(), 70U);
}

TEST(meta, tells_any_two_scenes_apart) {
  const Scene original = full_scene();
  const std::string before = meta(original, {});
  std::set<std::string> told;
  for_each_changed(original, [&](const Scene& scene, const Row& row, const Slot& slot, const std::string& path) {
    const bool of_the_camera = path.starts_with("camera.") && !path.starts_with("camera.pose.");  // `camera` tells what came of it
    if (of_the_camera || !change(row, slot)) return;
    EXPECT_NE(meta(scene, {}), before) << path;
    told.insert(row.member);
  });
  EXPECT_GE(told.size(), 25U);
}

TEST(meta, tells_how_far_a_flat_top_reaches) {
  const Camera near = load_camera("pico-flexx", {{}, {{"illumination.0.pattern.half_range_x", "40 deg"}}, {}});
  const Camera cells = load_camera("pico-flexx", {{}, {{"illumination.0.pattern.columns", "17"}}, {}});
  EXPECT_NE(meta({}, near), meta({}, load_camera("pico-flexx")));
  EXPECT_NE(meta({}, cells), meta({}, load_camera("pico-flexx")));
}

// The count is static_assert'ed; that no row stands for two members is seen here.
TEST(tables, have_each_member_once) {
  Camera camera = full_camera();
  Scene scene = full_scene();
  std::set<const Table*> seen;
  const auto look = [&](const Table& table) {
    if (!seen.insert(&table).second) return;
    std::set<std::string> members(table.without_row.begin(), table.without_row.end());
    for (const Row& row : table.rows) {
      members.insert(row.member);
      if (!row.second.empty()) members.insert(row.second);
    }
    EXPECT_EQ(members.size(), static_cast<std::size_t>(table.member_count)) << *members.begin();
  };
  const auto below = [&](const Row&, const Slot& slot, const std::string&) {
    if (const auto* one = std::get_if<model::RecordSlot>(&slot)) look(one->table());
    if (const auto* list = std::get_if<model::ListSlot>(&slot)) look(list->table());
    if (const auto* one = std::get_if<model::VariantSlot>(&slot))
      for (const auto& table : one->tables) look(table());
  };
  look(model::table_of<Camera>()), look(model::table_of<Scene>());
  each_member(camera, below), each_member(scene, below);
  EXPECT_EQ(seen.size(), 45U);
}

// Whatever kind a struct is of: a number that means nothing is refused by the name of its member.
TEST(checks_in_code, name_any_number_that_is_none) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  int cases = 0;
  const auto refused = [&](const auto& record, const std::string& path) {
    ++cases;
    try {
      model::check_in_code(record);
      ADD_FAILURE() << path << " passed";
    } catch (const Error& error) {
      const std::string what = error.what();
      EXPECT_EQ(error.kind(), ErrorKind::bad_input);
      EXPECT_EQ(what.find("error: " + path.substr(0, path.rfind('.'))), 0U) << what;
      EXPECT_NE(what.find(path.substr(path.rfind('.') + 1)), std::string::npos) << what;
    }
  };
  const auto spoil = [&](const auto& record, const Row& row, const Slot& slot, const std::string& path) {
    std::vector<double*> numbers;
    test::each_real(slot, [&](double& number) { numbers.push_back(&number); });
    for (double* number : numbers) {
      const double good = *number;
      *number = none;
      refused(record, row.second.empty() ? path : path.substr(0, path.rfind('.')) + ".table_");
      *number = good;
    }
  };
  for (int kind = 0; kind < 5; ++kind) {
    const Camera camera = full_camera(static_cast<Pattern::Kind>(kind), static_cast<Waveform::Kind>(kind % 3));
    EXPECT_NO_THROW(model::check_in_code(camera));
    for_each_changed(camera, spoil);
  }
  EXPECT_NO_THROW(model::check_in_code(full_scene()));
  for_each_changed(full_scene(), spoil);
  EXPECT_GE(cases, 600);
}

TEST(checks_in_code, keep_every_number_within_the_range_of_its_row) {
  int cases = 0;
  for_each_changed(full_camera(), [&](const Camera& camera, const Row& row, const Slot& slot, const std::string& path) {
    auto* const* number = std::get_if<double*>(&slot);
    if (number == nullptr) return;
    const model::ValueForm& form = row.form.forms.empty() ? row.form : row.form.forms[0];
    for (const double value : {std::nextafter(form.high, 2e30), std::nextafter(form.low, -2e30)}) {
      **number = value;
      EXPECT_THROW(model::check_in_code(camera), Error) << path << " " << value;
      ++cases;
    }
  });
  EXPECT_GE(cases, 100);
}

TEST(checks_in_code, name_a_member_as_code_does_and_its_element_alone_where_one_is_wrong) {
  const auto said = [](const auto& record) {
    try {
      model::check_in_code(record);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Scene scene = full_scene();
  scene.objects[2].shape = Plane{{0, 0, 1}, {1e-13, 0, -2e-13}};
  EXPECT_EQ(said(scene), "error: objects[2].shape.normal has no length\n  got [1e-13, 0, -2e-13], expected a direction such as [0, 0, 1]");
  scene = full_scene(), scene.objects[1].position[2] = 2e5;
  EXPECT_EQ(said(scene), "error: objects[1].position[2] is out of range\n  got 200000, expected -100000 to 100000");
  Camera camera = full_camera();
  camera.lens.vignetting_table.x[1] = 0.1;
  EXPECT_EQ(said(camera), "error: lens.vignetting_table.x[1]: angle does not ascend\n  got 0.1 after 0.1");
  camera = full_camera(), camera.illumination[0].pattern.samples[4] = -1;
  EXPECT_EQ(said(camera), "error: illumination[0].pattern.samples[4] is out of range\n  got -1, expected 0 to 1e+12");
  camera = full_camera(), camera.illumination[0].pattern.kind = static_cast<Pattern::Kind>(99);
  EXPECT_EQ(
      said(camera),
      "error: illumination[0].pattern.kind is none of its values\n  got 99, expected cone, lambertian, cosine_lobe, flat_top or table");
  camera = full_camera(), camera.mode.sequence.clear();
  EXPECT_EQ(said(camera), "error: mode.sequence has too few elements\n  got 0, expected at least 1");
}

TEST(reference_page, is_what_the_tables_say) {
  std::stringstream committed;
  committed << std::ifstream(TOFRAY_SOURCE_DIR "/docs/reference/keys.md").rdbuf();
  EXPECT_EQ(committed.str(), load::reference_page()) << "write it anew: tofray list keys > docs/reference/keys.md";
}

TEST(every_row, has_a_line_an_example_and_a_member) {
  for (const model::FileForm* file : {&model::camera_form(), &model::scene_form()}) {
    const std::vector<model::Line> lines = model::lines_of(*file);
    EXPECT_GE(lines.size(), 35U);
    for (const model::Line& line : lines) {
      EXPECT_FALSE(line.doc.empty()) << line.key;
      EXPECT_FALSE(line.value.empty()) << line.key;
    }
  }
}
