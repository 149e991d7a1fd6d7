// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Controls are the keys with what is in force: typed back as they say it, nothing changes.
#include "load/controls.h"

#include <gtest/gtest.h>

#include <set>

#include "load/builtin.h"
#include "model/lines.h"
#include "results/frame_file.h"
#include "results/meta.h"
#include "support/text.h"
#include "tofray/simulator.h"

namespace tofray::test {
namespace {

using load::Control;
using load::Settings;

struct Start {
  std::string scene;
  Settings set;
};

std::vector<Control> controls_of(const Start& start, const std::string& mode = {}) {
  const Scene scene = load::load_scene(start.scene, start.set);
  return load::controls_of(scene, load::builtin_scene_text(start.scene), start.set, {mode, {}, {}});
}

const Control* find(const std::vector<Control>& all, const std::string& key) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Control& one) { return one.key == key; });
  return found == all.end() ? nullptr : &*found;
}

/// All numbers of scene and camera; with a frame, all bytes of its file.
std::string bytes_of(const Start& start, bool with_frame) {
  const Scene scene = load::load_scene(start.scene, start.set);
  const Camera camera = load_camera(scene);
  SimulatorOptions options;
  options.threads = 1;
  const std::string meta = results::frame_meta(scene, camera, options, 0) + std::to_string(scene.materials.size());
  if (!with_frame) return meta;
  return results::frame_npz_bytes(Simulator(scene, camera, options).frame(0), camera, camera_pose(scene, 0), meta);
}

constexpr std::pair<const char*, const char*> small[] = {
    {"camera.sensor.width", "28"}, {"camera.sensor.height", "22"}, {"camera.lens.fx", "26.5 px"},         {"camera.lens.fy", "26.5 px"},
    {"camera.lens.cx", "13.5 px"}, {"camera.lens.cy", "10.5 px"},  {"camera.sensor.pixel_pitch", "96 um"}};

/// Each text that is in force, set as it is said. @return how many there were
std::size_t set_their_own(const Start& start, bool with_frame) {
  const std::string before = bytes_of(start, with_frame);
  std::size_t count = 0;
  for (const Control& one : controls_of(start)) {
    if (!one.text) continue;
    Start again = start;
    again.set.emplace_back(one.key, *one.text);
    try {
      EXPECT_TRUE(bytes_of(again, with_frame) == before) << start.scene << ": " << one.key << " = " << *one.text;
    } catch (const std::exception& error) {
      ADD_FAILURE() << start.scene << ": " << one.key << " = " << *one.text << ": " << error.what();
    }
    ++count;
  }
  return count;
}

TEST(controls, set_to_their_own_text_leave_every_byte_of_the_demo) {
  EXPECT_GT(set_their_own({"demo", {std::begin(small), std::end(small)}}, true), 300u);
}

TEST(controls, set_to_their_own_text_leave_every_number_of_every_scene_and_camera) {
  for (const load::Builtin& one : load::builtin_scenes()) EXPECT_GT(set_their_own({one.name, {}}, false), 50u) << one.name;
  for (const load::Builtin& one : load::builtin_profiles()) {
    const Camera camera = load_camera(one.name);
    for (const std::string& mode : one.name == "pico-flexx" ? camera.mode_names : std::vector<std::string>{camera.mode.name})
      EXPECT_GT(set_their_own({"step-and-rod", {{"camera.profile", one.name}, {"camera.mode", mode}}}, false), 50u) << one.name;
  }
}

TEST(controls, set_to_their_own_text_leave_what_was_changed_before) {
  const Settings changed = {{"world_up", "z"},
                            {"camera.pose.position", "[1, 2, 0]"},
                            {"camera.illumination.0.illumination_wavelength", "940 nm"},
                            {"camera.lens.vignetting", "cos4"},
                            {"camera.decoding.filter", "{kind: median}"},
                            {"camera.illumination.0.area", "{kind: disk, radius: 2 mm}"},
                            {"transport", "{bounces: 2, transient: {bins: 10}}"},
                            {"ambient", "{illuminance: 5 klx, spectrum: equal_energy}"},
                            {"objects.0.plane.rotation", "{euler: {yaw: 3 deg}}"},
                            {"objects.1.plane.velocity", "[0, 1 m/s, 0]"},
                            {"camera.pixel.contrast_by_wavelength", "{wavelength: [800 nm, 900 nm, 1000 nm], factor: [0.9, 0.8, 0.7]}"}};
  EXPECT_GT(set_their_own({"demo", changed}, false), 300u);
}

TEST(controls, say_what_a_slider_needs) {
  const auto all = controls_of({"demo", {{"objects.2.sphere.radius", "12 cm"}}});
  const Control& f = *find(all, "camera.lens.f_number");
  EXPECT_EQ(f.text, "1.6");
  EXPECT_EQ(f.value, std::vector<double>{1.6});
  EXPECT_EQ(f.slider_low, 0.3);  // the key's own end: a tenth would be less
  EXPECT_EQ(f.slider_high, 16);
  EXPECT_TRUE(f.logarithmic && f.assumed && !f.changed);
  EXPECT_EQ(f.source, "known only in the product above");
  const Control& exposure = *find(all, "camera.integration_time");
  EXPECT_EQ(exposure.text, "2000 us");  // of the mode's lit raw frames
  EXPECT_EQ(exposure.unit, "us");
  EXPECT_EQ(exposure.value, std::vector<double>{2000});
  EXPECT_EQ(exposure.slider_low, 200);
  EXPECT_EQ(find(all, "camera.frame_rate")->text, "5 Hz");
  const Control& level = *find(all, "ambient.level");
  EXPECT_EQ(level.unit, "%");
  EXPECT_EQ(level.value, std::vector<double>{0.3});
  EXPECT_EQ(level.slider_high, 3);
  const Control& radius = *find(all, "objects.2.sphere.radius");
  EXPECT_TRUE(radius.changed);
  EXPECT_EQ(radius.text, "12 cm");
  EXPECT_EQ(radius.label, "belly");
  EXPECT_EQ(radius.part + "|" + radius.group + "|" + radius.name, "objects|2|sphere.radius");
  const Control& bounces = *find(all, "transport.bounces");
  EXPECT_EQ(bounces.text, "0");
  EXPECT_EQ(bounces.slider_low, 0);
  EXPECT_FALSE(bounces.logarithmic);
  const Control& point = *find(all, "objects.0.plane.point");
  EXPECT_EQ(point.kind, Control::Kind::vector);
  EXPECT_EQ(point.value, (std::vector<double>{0, 0, 1.2}));
  EXPECT_EQ(point.slider_low, -2.4);
  EXPECT_FALSE(find(all, "objects.0.plane.material")->settable);  // it has a reflectivity
  EXPECT_FALSE(find(all, "objects.0.plane.material")->text);
  EXPECT_EQ(find(all, "camera.mode")->choices, load_camera("pico-flexx").mode_names);
  EXPECT_EQ(find(all, "objects.0.sphere.radius"), nullptr);  // it is a plane
}

TEST(controls, of_changed_numbers_are_no_longer_what_the_profile_says) {
  const auto all = controls_of({"demo", {{"camera.lens.f_number", "2"}}});
  EXPECT_EQ(find(all, "camera.lens.f_number")->source, "");
  EXPECT_FALSE(find(all, "camera.lens.f_number")->assumed);
  EXPECT_TRUE(find(all, "camera.lens.transmission")->assumed);
}

TEST(controls, are_each_once_and_their_sliders_within_their_ranges) {
  for (const char* scene : {"demo", "room", "bench-mesh", "flying-ball"}) {
    std::set<std::string> seen;
    for (const Control& one : controls_of({scene, {}})) {
      EXPECT_TRUE(seen.insert(one.key).second) << one.key;
      EXPECT_FALSE(one.what.empty()) << one.key;
      if (!one.slider_low) continue;
      const files::Json json = load::json_of(one);
      double low = 0, high = 0;
      ASSERT_TRUE(json.find("low")->number(low) && json.find("high")->number(high)) << one.key;
      EXPECT_LT(*one.slider_low, *one.slider_high) << one.key;
      EXPECT_GE(*one.slider_low, low) << one.key;
      EXPECT_LE(*one.slider_high, high) << one.key;
      for (const double value : one.value) {
        EXPECT_GE(value, *one.slider_low) << one.key;
        EXPECT_LE(value, *one.slider_high) << one.key;
      }
    }
  }
}

/// objects.12.sphere.radius is objects.0.sphere.radius in the list of keys.
std::string as_listed(const std::string& key) {
  std::string out;
  for (std::size_t from = 0; from < key.size();) {
    const std::size_t dot = std::min(key.find('.', from), key.size());
    std::string word = key.substr(from, dot - from);
    const bool number = word.find_first_not_of("0123456789") == std::string::npos;
    if (out == "materials" || out == "camera.modes") word = "NAME";
    out += (out.empty() ? "" : ".") + (number ? "0" : word);
    from = dot + 1;
  }
  return out;
}

// Of kinds that no scene has, each key comes where its kind is set.
TEST(controls, have_every_key_of_the_tables) {
  std::set<std::string> seen;
  const auto see = [&](const Start& start) {
    for (const Control& one : controls_of(start)) seen.insert(as_listed(one.key));
  };
  for (const load::Builtin& one : load::builtin_scenes()) see({one.name, {}});
  const Settings of_camera[] = {
      {{"camera.sensor.mask", "{kind: table, samples: [[0, 1], [1, 1]]}"}, {"camera.sensor.fill_factor", "100 %"}},
      {{"camera.lens.scatter", "{kind: kernel, kernel: [[0, 0, 0], [0, 1, 0], [0, 0, 0]]}"}},
      {{"camera.illumination.0.pattern", "{kind: cosine_lobe, exponent: 2}"}},
      {{"camera.illumination.0.waveform", "{kind: gaussian, duty: 0.3, sigma: 1 ns}"}},
      {{"camera.illumination.0.waveform", "{kind: sine}"}},
      {{"camera.illumination.0.waveform", "{kind: trapezoid, duty: 0.3, rise_time: 1 ns, fall_time: 1 ns}"}},
      {{"camera.illumination.0.waveform", "{kind: measured, correlation: [0, 0.3, 0.5, 0.3, 0, -0.3, -0.5, -0.3], harmonics: 1}"}},
      {{"camera.illumination.0.waveform", "{kind: emission, emission: [1, 1, 1, 0, 0, 0, 0, 1], harmonics: 1}"}},
      {{"camera.illumination.0.pattern", "{kind: cone, half_angle: 40 deg}"}},
      {{"camera.illumination.0.pattern", "{kind: table, half_range_x: 40 deg, half_range_y: 30 deg, samples: [[1, 1], [1, 1]]}"}},
      {{"camera.illumination.0.area", "{kind: rectangle, width: 3 mm, height: 3 mm}"}},
      {{"camera.lens.vignetting", "{angle: [0 deg, 30 deg, 60 deg], factor: [1, 0.9, 0.7]}"}},
      {{"camera.pixel.contrast", "{modulation_frequency: [10 MHz, 50 MHz, 100 MHz], value: [0.8, 0.7, 0.6]}"}},
      {{"camera.decoding.filter", "{kind: bilateral}"}},
      {{"camera.decoding.filter", "{kind: gaussian}"}},
      {{"camera.decoding.calibration",
        "{kind: specimen, frequencies: [{modulation_frequency: 80.32 MHz}, {modulation_frequency: 60.24 MHz}]}"}},
      {{"camera.calibration.phase_offset", "{modulation_frequency: [10 MHz, 100 MHz], value: [0 rad, 0.1 rad]}"}},
      {{"camera.pixel.quantum_efficiency", "{wavelength: [800 nm, 900 nm], value: [0.4, 0.3]}"}}};
  for (const Settings& set : of_camera) {
    try {
      see({"demo", set});
    } catch (const std::exception& error) {
      ADD_FAILURE() << set[0].first << ": " << error.what();
    }
  }
  std::string missing;
  for (const model::Line& line : model::lines_of(model::camera_form()))
    if (!line.key.starts_with("modes.NAME.decoding") && !line.key.starts_with("modes.NAME.readout") &&
        !line.key.starts_with("modes.NAME.auto_exposure") && !seen.contains("camera." + line.key))
      missing += line.key + "\n";
  EXPECT_EQ(missing, "");
}

TEST(scene_yaml, keeps_every_text_and_number_however_it_is_written) {
  const std::string text =
      "camera: {profile: pico-flexx, 'lens.f_number': 1.8}\n"
      "materials:\n"
      "  \"a: b # c\": {reflectivity: 0.5}\n"
      "  'it''s': {reflectivity: 40 %}\n"
      "  \"true\": {brdf: \"lambert\", reflectivity: .25}\n"
      "  näher: {reflectivity: 1e-1}\n"
      "objects:\n"
      "  - sphere: {name: \"- \\\"x\\\" [y], {z}\\tand a text that is longer than a line of the file, so that the list of its keys is "
      "broken, "
      "too\", center: [0, 0, 1], radius: 10 cm, material: \"a: b # c\"}\n"
      "  - sphere: {name: \"12\", center: [0.5, 0, 1], radius: 10 cm, material: \"it's\"}\n"
      "  - sphere: {name: \" blank \", center: [0, 0.5, 1], radius: 10 cm, material: \"true\"}\n"
      "  - sphere: {name: \"null\", center: [0, 0.5, 2], radius: 10 cm, material: näher}\n";
  const auto numbers_of = [](const Scene& scene) {
    std::string out = results::frame_meta(scene, load_camera(scene), {}, 0);
    for (const Material& one : scene.materials) out += "|" + one.name;
    for (const Object& one : scene.objects) out += "|" + one.name;
    return out;
  };
  const Settings set = {{"objects.0.sphere.radius", "11 cm"}, {"camera.modes.MODE_9_5FPS_2000.sequence.0.integration_time", "100 us"}};
  const std::string saved = load::scene_yaml(text, "x.yaml", set);
  EXPECT_EQ(numbers_of(load::scene_from_text(saved, "x.yaml")), numbers_of(load::scene_from_text(text, "x.yaml", set)));
  EXPECT_NE(numbers_of(load::scene_from_text(saved, "x.yaml")), numbers_of(load::scene_from_text(text, "x.yaml")));
  EXPECT_EQ(load::scene_yaml(saved, "x.yaml", {}), saved);
}

}  // namespace
}  // namespace tofray::test
