// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Which stages look at a key, by the tables: no cell of a sweep is made of a stage that is stale, whichever key varies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "base/text.h"
#include "load/controls.h"
#include "model/key_stage.h"
#include "support/files.h"
#include "support/tool.h"
#include "tofray/error.h"
#include "tofray/kept.h"
#include "tofray/sweep.h"

namespace tofray {
namespace {

using test::Folder;

/// A camera of few pixels, in front of something that has edges, slopes and light of its own colour.
const char* const objects = R"(
ambient: {spectrum: sun_am15, level: 1 %}
objects:
  - plane:  {point: [0, 0, 1.6], normal: [0.2, 0, -1], reflectivity: 0.6, name: wall}
  - sphere: {center: [0.02, 0.01, 0.9], radius: 6 cm, reflectivity: 40 %, name: ball}
)";

std::string scene_text(const std::string& camera, const std::string& more = "") {
  return "camera:\n  profile: pico-flexx\n  readout: {region: {left: 96, top: 70, width: 32, height: 24}}\n" + camera + objects + more;
}

/// Everything that is none by default.
const char* const rich = R"(  lens: {scatter: {kind: gaussians, share: 3 %, sigma: [2 px]}}
  pixel:
    crosstalk: {left_right: 1 %, up_down: 1 %}
    patterns: {prnu: 1 %, dsnu: 2 DN, delay: 20 ps, phase_offset: 0.01 rad}
    suppression: {threshold: 2000 e, budget: 50000 e}
    taps: {gain_mismatch: 1 %, offset_mismatch: 20 e}
    column_noise: 5 e
    row_noise: 5 e
    reset_noise: {sigma: 10 e}
    dark_current: 2000 e/s
    dark_current_doubling: 8 K
    nonlinearity: {charge: [0 e, 20000 e, 100000 e], read: [0 e, 19900 e, 99000 e]}
  temperature: {actual: 35 degC, drift: 0.2 mm/K}
  interference: {share: 2 %, frequency_difference: 30 Hz}
  calibration: {range_offset: 5 mm}
  decoding: {filter: {kind: bilateral, sigma: 1 px, range: 20 mm}, asymmetry: {limit: 50 e, reject: true}}
)";

std::vector<std::string> all_arrays() {
  std::vector<std::string> out;
#define TOFRAY_NAME(name, ...) out.emplace_back(#name);
  TOFRAY_IMAGE_ARRAYS(TOFRAY_NAME)
#undef TOFRAY_NAME
  return out;
}

/// The bytes of each array of a frame, by name.
std::map<std::string, std::pair<Stage, std::string>> bytes_of(const Frame& frame) {
  std::map<std::string, std::pair<Stage, std::string>> out;
#define TOFRAY_BYTES(name, part, member, element, shape, stage, ...) \
  out[#name] = {Stage::stage,                                        \
                std::string(reinterpret_cast<const char*>(frame.part.member.data()), frame.part.member.size() * sizeof(element))};
  TOFRAY_IMAGE_ARRAYS(TOFRAY_BYTES)
#undef TOFRAY_BYTES
  return out;
}

std::vector<std::string> differing(const Frame& a, const Frame& b, Stage before = Stage::depth, bool all = true) {
  std::vector<std::string> out;
  const auto of_a = bytes_of(a), of_b = bytes_of(b);
  for (const auto& [name, one] : of_a)
    if ((all || one.first < before) && one.second != of_b.at(name).second) out.push_back(name);
  return out;
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& one : names) out += one + " ";
  return out;
}

/// Another value than the one in force, if there is one that is sure to be good by itself.
std::optional<std::string> other_value(const load::Control& control) {
  using Kind = load::Control::Kind;
  if (!control.settable || !control.text) return std::nullopt;
  if (control.kind == Kind::boolean) return *control.text == "true" ? "false" : "true";
  if (control.kind == Kind::choice) {
    for (const std::string& one : control.choices)
      if (one != *control.text && one != "table" && one != "kernel" && one != "measured" && one != "emission") return one;
    return std::nullopt;
  }
  if (control.value.size() != 1) return std::nullopt;
  const double value = control.value[0];
  if (control.kind == Kind::integer) return std::to_string(static_cast<long long>(value) + (value > 1 ? -1 : 1));
  if (control.kind != Kind::number) return std::nullopt;
  return base::number_text(value == 0 ? (control.slider_high ? *control.slider_high / 20 : 1) : value * 0.97) + " " + control.unit;
}

struct Setting {
  std::string key, old_value, new_value;
};

/// Keys of a scene that can be set, with two values each that both can be simulated.
std::vector<Setting> settings_of(const std::string& file, const std::string& text) {
  const Inputs in = load_inputs({file, {}, "", "", {}});
  std::vector<Setting> out;
  std::set<std::string> done;
  for (const load::Control& one : load::controls_of(in.scene, text, {}, {})) {
    const std::optional<std::string> other = other_value(one);
    if (!other || !done.insert(one.key).second) continue;
    try {
      const Inputs changed = load_inputs({file, {{one.key, *other}}, "", "", {}}),
                   same = load_inputs({file, {{one.key, *one.text}}, "", "", {}});
      SimulatorOptions options;
      options.backend = Backend::cpu, options.threads = 1;
      Simulator(changed.scene, changed.camera, options), Simulator(same.scene, same.camera, options);
      out.push_back({one.key, *one.text, *other});
    } catch (const Error&) {
      continue;  // does not go with the others
    }
  }
  return out;
}

Stage stage_of(const std::string& key) {
  const auto of_scene = model::known_key(model::scene_form(), key);
  const auto of_camera = key.starts_with("camera.") ? model::known_key(model::camera_form(), key.substr(7)) : std::nullopt;
  EXPECT_TRUE(of_scene || of_camera) << key;
  return of_camera ? of_camera->stage : of_scene ? of_scene->stage : Stage::trace;
}

struct Case {
  const char* name;
  std::string text;
  Noise noise;
};

class stages : public testing::TestWithParam<int> {
 protected:
  static Case of(int i) {
    const Case all[] = {{"plain", scene_text(""), Noise::exact},
                        {"plain_without_noise", scene_text(""), Noise::off},
                        {"rich", scene_text(rich), Noise::exact},
                        {"rich_without_noise", scene_text(rich), Noise::off}};
    return all[i];
  }
};

TEST_P(stages, that_come_before_a_key_do_not_see_it) {
  const Case one = of(GetParam());
  const Folder folder;
  const std::string file = (folder / "scene.yaml").native();
  test::write(file, one.text);
  SimulatorOptions options;
  options.backend = Backend::cpu, options.noise = one.noise, options.threads = 1;
  const auto frame = [&](const load::Settings& set) {
    const Inputs in = load_inputs({file, set, "", "", {}});
    return Simulator(in.scene, in.camera, options).frame(0);
  };
  const Frame before = frame({});
  std::map<Stage, int> counted;
  for (const Setting& key : settings_of(file, one.text)) {
    const Stage stage = stage_of(key.key);
    ++counted[stage];
    if (stage == Stage::trace) continue;
    EXPECT_EQ(listed(differing(before, frame({{key.key, key.new_value}}), stage, false)), "") << key.key << " = " << key.new_value;
  }
  EXPECT_GT(counted[Stage::trace], 20);
  EXPECT_GT(counted[Stage::power], 15);
  EXPECT_GT(counted[Stage::raw], 15);
  EXPECT_GT(counted[Stage::depth], 15);
}

/// Each key varies beside one that only raw frames see and one that only depth sees: light and raw frames are kept, and have to be made anew.
TEST_P(stages, are_computed_anew_for_each_cell_that_needs_it) {
  const Case one = of(GetParam());
  const Folder folder;
  const std::string file = (folder / "scene.yaml").native();
  test::write(file, one.text);
  const InputRequest inputs{file, {}, "", "", {}};
  std::uint64_t traced = 0, from_light = 0, from_raw = 0;
  for (const Setting& key : settings_of(file, one.text)) {
    const std::string late = key.key == "camera.pixel.read_noise" ? "camera.adc.step" : "camera.pixel.read_noise",
                      last = key.key == "camera.decoding.noise_threshold" ? "camera.decoding.amplitude_threshold"
                                                                          : "camera.decoding.noise_threshold";
    SweepRequest request;
    request.inputs = inputs;
    request.axes = {
        sweep_axis(key.key, {key.old_value, key.new_value}, inputs),
        sweep_axis(late, late.ends_with("step") ? std::vector<std::string>{"20 e/DN", "25 e/DN"} : std::vector<std::string>{"30 e", "60 e"},
                   inputs),
        sweep_axis(
            last,
            last.ends_with("amplitude_threshold") ? std::vector<std::string>{"0 e", "90 e"} : std::vector<std::string>{"70 mm", "9 mm"},
            inputs)};
    request.simulator.noise = one.noise, request.simulator.threads = 1, request.simulator.arrays = all_arrays(), request.metrics = {"fill"};
    SweepWatch watch;
    std::set<std::uint64_t> seen;
    watch.frame = [&](std::uint64_t cell, const Frame& got) {
      EXPECT_TRUE(seen.insert(cell).second);
      load::Settings set;
      for (std::size_t axis = 0; axis < 3; ++axis)
        set.emplace_back(request.axes[axis].key == "mode" ? "camera.mode" : request.axes[axis].key,
                         request.axes[axis].values[cell >> (2 - axis) & 1]);
      const Inputs in = load_inputs({file, set, "", "", {}});
      SimulatorOptions options = request.simulator;
      options.backend = Backend::cpu, options.arrays = all_arrays();
      EXPECT_EQ(listed(differing(got, Simulator(in.scene, in.camera, options).frame(0))), "") << key.key << ", cell " << cell;
    };
    const Sweep found = sweep(request, watch);
    EXPECT_EQ(seen.size(), 8U) << key.key;
    traced += found.traced, from_light += found.from_light, from_raw += found.from_raw;
  }
  // Or it would be no test.
  EXPECT_GT(from_light, traced / 2);
  if (one.noise != Noise::off) {
    EXPECT_GT(from_raw, traced);
  }
}

std::string name_of_case(const testing::TestParamInfo<int>& of) {
  static const std::vector<std::string> names = {"plain", "plain_without_noise", "rich", "rich_without_noise"};
  return names[static_cast<std::size_t>(of.param)];
}
INSTANTIATE_TEST_SUITE_P(of, stages, testing::Range(0, 4), name_of_case);

TEST(stages_of_keys, are_those_of_what_they_are_a_part_of) {
  const auto stage = [](const char* key) { return model::known_key(model::camera_form(), key).value().stage; };
  EXPECT_EQ(stage("lens.fx"), Stage::trace);
  EXPECT_EQ(stage("lens.f_number"), Stage::power);
  EXPECT_EQ(stage("illumination.0.pattern.half_angle"), Stage::power);
  EXPECT_EQ(stage("illumination.*.power"), Stage::power);
  EXPECT_EQ(stage("pixel.contrast"), Stage::power);
  EXPECT_EQ(stage("pixel.patterns.prnu"), Stage::raw);
  EXPECT_EQ(stage("integration_time"), Stage::raw);
  EXPECT_EQ(stage("modes.MODE.sequence.0.integration_time"), Stage::raw);
  EXPECT_EQ(stage("modes.MODE.sequence.0.modulation_frequency"), Stage::power);
  EXPECT_EQ(stage("modes.MODE.decoding.filter.radius"), Stage::depth);
  EXPECT_EQ(stage("decoding.filter.kind"), Stage::depth);
  EXPECT_FALSE(model::known_key(model::camera_form(), "lens.f_numbr"));
  EXPECT_FALSE(model::known_key(model::camera_form(), "illumination.power"));
  EXPECT_EQ(model::known_key(model::scene_form(), "objects.0.sphere.radius").value().stage, Stage::trace);
  EXPECT_EQ(model::known_key(model::scene_form(), "ambient.level").value().stage, Stage::power);
}

TEST(kept_frames, keep_nothing_that_hangs_on_other_frames_or_on_depth) {
  const Folder folder;
  const auto frames = [&](const std::string& camera, const std::string& more = "") {
    const std::string file = (folder / "scene.yaml").native();
    test::write(file, scene_text(camera, more));
    const Inputs in = load_inputs({file, {}, "", "", {}});
    return KeptFrames(in.scene, in.camera, {});
  };
  EXPECT_TRUE(frames("").can_keep_light() && frames("").can_keep_raw());
  EXPECT_FALSE(frames("  auto_exposure: {speed: 50 %}\n").can_keep_light());
  EXPECT_FALSE(frames("  decoding: {temporal: {frames: 3}}\n").can_keep_light());
  EXPECT_FALSE(frames("", "transport: {bounces: 2, samples: 4, max_samples: 64}\n").can_keep_light());
  const KeptFrames bouncing = frames("", "transport: {bounces: 2, samples: 4}\n");
  EXPECT_TRUE(bouncing.can_keep_light());
  EXPECT_FALSE(bouncing.can_keep_raw());
  EXPECT_FALSE(frames("  pixel: {blooming: {share: 5 %, limit: 1000 e}}\n").can_keep_raw());
}

TEST(kept_frames, of_bounces_samples_and_motion_have_the_bytes_of_a_simulator) {
  const Folder folder;
  const std::string file = (folder / "scene.yaml").native();
  const char* const moving = "  - sphere: {center: [-0.05, 0, 1.1], radius: 4 cm, reflectivity: 0.3, velocity: [0.5, 0, 0]}\n";
  struct One {
    std::string more, key;
    std::vector<std::string> values;
    int subpixel, samples;
  };
  const One all[] = {{"transport: {bounces: 2, samples: 4}\n", "camera.pixel.read_noise", {"10 e", "60 e"}, 1, 1},
                     {"", "camera.pixel.read_noise", {"10 e", "60 e"}, 3, 1},
                     {moving, "camera.pixel.read_noise", {"10 e", "60 e"}, 1, 1},
                     {moving, "camera.pixel.read_noise", {"10 e", "60 e"}, 2, 3},
                     {moving, "camera.timing.readout_time", {"0.1 ms", "2 ms"}, 1, 1},
                     {moving, "camera.integration_time", {"100 us", "900 us"}, 1, 1},
                     {moving, "camera.decoding.noise_threshold", {"70 mm", "9 mm"}, 1, 1}};
  for (const One& one : all) {
    test::write(file, scene_text("", one.more));
    SweepRequest request;
    request.inputs = {file, {}, "", "", {}};
    request.axes = {sweep_axis(one.key, one.values, request.inputs)};
    request.simulator.subpixel = one.subpixel, request.simulator.exposure_samples = one.samples, request.simulator.arrays = all_arrays();
    request.repeat = one.more == moving ? 1 : 2, request.metrics = {"fill"};
    SweepWatch watch;
    watch.frame = [&](std::uint64_t cell, const Frame& got) {
      const Inputs in = load_inputs({file, {{one.key, one.values[cell]}}, "", "", {}});
      SimulatorOptions options = request.simulator;
      options.backend = Backend::cpu, options.arrays = all_arrays();
      EXPECT_EQ(listed(differing(got, Simulator(in.scene, in.camera, options).frame(got.index))), "")
          << one.key << one.more << " cell " << cell;
    };
    (void)sweep(request, watch);
  }
}

}  // namespace
}  // namespace tofray
