// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "files/json.h"
#include "files/npz.h"
#include "files/sha256.h"
#include "load/builtin.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

const std::vector<std::string> all_files = {"amplitude.png", "cloud.ply", "depth.png", "frame.npz", "preview.png", "raw.png"};

std::vector<std::string> names_of(const std::map<std::string, std::string>& files) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : files) names.push_back(name);
  return names;
}

TEST(demo, writes_all_files_and_draws_a_picture) {
  const Folder folder;
  const Result result = run({"demo"}, in_folder(folder.path()));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(names_of(files_of(folder / "tofray-demo")), all_files);
  EXPECT_GT(std::count(result.out.begin(), result.out.end(), '\n'), 30);
  EXPECT_FALSE(has(result.out, "\x1b["));  // no colours where stdout is no terminal
  EXPECT_TRUE(has(result.out, "pixels have a depth"));
  EXPECT_EQ(result.err, "");
}

TEST(demo, manifest_lists_every_file_with_its_hash) {
  const Folder folder;
  ASSERT_EQ(run(with_small_sensor({"demo", "-o", "out", "--quiet"}), in_folder(folder.path())).code, 0);
  const files::Json manifest = files::parse_json(content(folder / "out" / "manifest.json"), "manifest.json");
  std::map<std::string, std::string> hashes, listed;
  for (const auto& [name, bytes] : files_of(folder / "out")) hashes[name] = files::sha256_hex(bytes);
  for (const files::Json& file : *manifest.find("files")->items()) listed[*file.find("name")->string()] = *file.find("sha256")->string();
  EXPECT_EQ(hashes, listed);
}

class render_of : public testing::TestWithParam<std::string> {};

TEST_P(render_of, a_builtin_scene_works) {
  const Folder folder;
  const Result result = run({"render", GetParam(), "--emit", "npz"}, in_folder(folder.path()));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_FALSE(has(result.err, "warning")) << result.err;
  const auto arrays = files::read_npz(folder / GetParam() / "frame.npz", {"flags"});
  ASSERT_EQ(arrays.size(), 1u);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < arrays[0].array.count(); ++i) valid += (static_cast<unsigned>(arrays[0].array.number(i)) & 31u) == 0 ? 1 : 0;
  EXPECT_GT(valid, 0u);
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const load::Builtin& one : load::builtin_scenes()) names.push_back(one.name);
  return names;
}

std::string test_name(const testing::TestParamInfo<std::string>& scene) {
  std::string name = scene.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(every, render_of, testing::ValuesIn(scene_names()), test_name);

TEST(render, gives_the_same_bytes_with_any_number_of_threads) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  for (const char* threads : {"1", "2", "7"}) ASSERT_EQ(run({"render", "flying-ball", "-o", threads, "--threads", threads}, here).code, 0);
  EXPECT_EQ(names_of(files_of(folder / "1")), all_files);
  EXPECT_EQ(files_of(folder / "1"), files_of(folder / "2"));
  EXPECT_EQ(files_of(folder / "1"), files_of(folder / "7"));
}

TEST(render, seed_and_noise_change_the_bytes) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  const std::vector<Arguments> all = {{}, {"--seed", "1"}, {"--noise", "off"}};
  std::vector<std::string> bytes;
  for (Arguments more : all) {
    more.insert(more.begin(), {"render", "card", "-o", "out"});
    ASSERT_EQ(run(with_small_sensor(more), here).code, 0);
    bytes.push_back(content(folder / "out" / "frame.npz"));
    for (std::size_t i = 0; i + 1 < bytes.size(); ++i) EXPECT_NE(bytes[i], bytes.back());
  }
}

TEST(render, many_frames_are_numbered_and_a_part_is_the_same) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run(with_small_sensor({"render", "flying-ball", "-o", "all", "--frames", "4"}), here).code, 0);
  ASSERT_EQ(run(with_small_sensor({"render", "flying-ball", "-o", "part", "--frames", "2", "--first-frame", "2"}), here).code, 0);
  const auto all = files_of(folder / "all"), part = files_of(folder / "part");
  EXPECT_EQ(names_of(all), (std::vector<std::string>{"frame_0000.npz", "frame_0001.npz", "frame_0002.npz", "frame_0003.npz"}));
  EXPECT_EQ(names_of(part), (std::vector<std::string>{"frame_0002.npz", "frame_0003.npz"}));
  for (const auto& [name, bytes] : part) EXPECT_EQ(bytes, all.at(name)) << name;
  EXPECT_NE(all.at("frame_0000.npz"), all.at("frame_0001.npz"));
}

TEST(render, replaces_files_of_the_same_name_and_leaves_others_alone) {
  const Folder folder;
  fs::create_directory(folder / "out");
  std::ofstream(folder / "out" / "frame.npz") << "old";
  std::ofstream(folder / "out" / "notes.txt") << "mine";
  ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "out"}), in_folder(folder.path())).code, 0);
  EXPECT_GT(content(folder / "out" / "frame.npz").size(), 1000u);
  EXPECT_EQ(content(folder / "out" / "notes.txt"), "mine");
}

/// Writes a profile of one's own with a measured light pattern and correlation in files beside it, and a scene that takes it.
void write_own_camera(const fs::path& folder) {
  fs::create_directories(folder / "tables");
  std::string profile(load::find_builtin(load::builtin_profiles(), "pico-flexx")->text);
  std::ofstream(folder / "mycam.yaml") << profile;
  std::ofstream(folder / "tables" / "pattern.csv") << "# measured\n1, 2.5, 1 # rim\n2, 4, 2\n\n1; 2.25; 1\n";
  std::ofstream(folder / "correlation.txt") << "0.7 0.5 0\n-0.5\n-0.7 -0.5 0 0.5\n";
  std::ofstream(folder / "scene.yaml")
      << "camera:\n"
         "  profile: mycam.yaml\n"
         "  illumination.0.pattern: {kind: table, file: tables/pattern.csv, half_range_x: 35 deg, half_range_y: 30 deg}\n"
         "  illumination.0.waveform: {kind: measured, file: correlation.txt, harmonics: 1}\n"
         "objects:\n"
         "  - plane: {point: [0, 0, 1.2], normal: [0, 0, -1], reflectivity: 0.7}\n";
}

TEST(render, from_a_manifest_makes_the_same_bytes_without_the_files) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  write_own_camera(folder.path());
  const Arguments told = {"render",
                          "scene.yaml",
                          "-o",
                          "out",
                          "--seed",
                          "9",
                          "--noise",
                          "off",
                          "--mode",
                          "MODE_9_25FPS_450",
                          "--frames",
                          "2",
                          "--emit",
                          "npz,png",
                          "--first-frame",
                          "1",
                          "--set",
                          "objects.0.plane.reflectivity=0.6"};
  const Result first = run(with_small_sensor(told), here);
  ASSERT_EQ(first.code, 0) << first.err;
  for (const char* gone : {"scene.yaml", "mycam.yaml", "tables/pattern.csv", "correlation.txt"}) fs::remove(folder / gone);
  const Result again = run({"render", "--from", "out/manifest.json", "-o", "again", "--threads", "1"}, here);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(files_of(folder / "out").size(), 10u);
  EXPECT_EQ(files_of(folder / "out"), files_of(folder / "again"));
}

// Without any font, too: pictures have the plain letters of cairo then.
TEST(render, from_a_manifest_of_a_machine_with_other_fonts_differs_in_figures_alone) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "out"}), here).code, 0);
  std::ofstream(folder / "no-fonts.conf") << "<?xml version=\"1.0\"?>\n<fontconfig></fontconfig>\n";
  const Result again = run({"render", "--from", "out/manifest.json", "-o", "again"}, [&] {
    here();
    ::setenv("FONTCONFIG_FILE", (folder / "no-fonts.conf").c_str(), 1);
  });
  EXPECT_EQ(again.code, 0) << again.err;
  const auto before = files_of(folder / "out"), after = files_of(folder / "again");
  for (const char* name : {"frame.npz", "depth.png", "amplitude.png", "cloud.ply"}) EXPECT_EQ(before.at(name), after.at(name)) << name;
  EXPECT_TRUE(after.at("preview.png").starts_with("\x89PNG"));
  if (before.at("preview.png") == after.at("preview.png")) GTEST_SKIP() << "this machine has no font";
  EXPECT_TRUE(has(again.err, " have letters of other fonts than out/manifest.json lists")) << again.err;
}

TEST(render, from_a_manifest_that_lists_other_bytes_is_a_check_not_met) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "out"}), here).code, 0);
  std::string text = content(folder / "out" / "manifest.json");
  text.replace(text.find("\"seed\": 0"), 9, "\"seed\": 1");
  std::ofstream(folder / "out" / "manifest.json") << text;
  const Result result = run({"render", "--from", "out/manifest.json", "-o", "again"}, here);
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(has(result.err, "frame.npz"));
  EXPECT_EQ(run({"render", "--from", "out/manifest.json", "--seed", "3"}, here).code, 2);
  EXPECT_EQ(run({"render", "card", "--from", "out/manifest.json"}, here).code, 2);
}

TEST(process, makes_the_same_bytes_from_the_file_alone) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run({"render", "step-and-rod", "-o", "out", "--seed", "4"}, here).code, 0);
  const Result result = run({"process", "out/frame.npz", "-o", "again"}, here);
  ASSERT_EQ(result.code, 0) << result.err;
  for (const char* name : {"depth.png", "amplitude.png", "raw.png", "cloud.ply"})
    EXPECT_EQ(content(folder / "out" / name), content(folder / "again" / name)) << name;
}

TEST(process, makes_the_same_depth_of_expected_values) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run({"render", "step-and-rod", "-o", "out", "--noise", "off"}, here).code, 0);
  ASSERT_EQ(run({"process", "out/frame.npz", "-o", "again"}, here).code, 0);
  const files::NpyArray before = files::read_npz(folder / "out" / "frame.npz", {"range_m"})[0].array;
  const files::NpyArray after = files::read_npz(folder / "again" / "frame.npz", {"range_m"})[0].array;
  ASSERT_EQ(before.count(), after.count());
  for (std::size_t i = 0; i < before.count(); ++i) {
    ASSERT_EQ(std::isnan(before.number(i)), std::isnan(after.number(i)));
    // The taps in the file are rounded to float: some 1e-3 e of a difference of 1e3 e, hence 1e-6 rad and 1 um.
    if (std::isnan(before.number(i))) continue;
    ASSERT_NEAR(before.number(i), after.number(i), 3e-6);
  }
}

// A recording as the tutorial describes it: no start times. Then each exposure begins when the one before has been read out,
// which for the pico flexx (0.2 ms, then 2 ms each; 3.5 ms to read out) is what a simulated frame says, too.
TEST(process, takes_a_recording_without_start_times) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run({"render", "card", "-o", "out"}, here).code, 0);
  const std::vector<std::string> recorded = {"raw", "modulation_frequency_hz", "reference_phase_rad", "integration_time_s", "lit"};
  std::vector<files::NpyView> views;
  const std::vector<files::NamedArray> arrays = files::read_npz(folder / "out/frame.npz", recorded);
  for (const files::NamedArray& one : arrays) views.push_back({one.name, one.array.type, one.array.shape, one.array.bytes});
  std::ofstream(folder / "recording.npz", std::ios::binary) << files::npz_bytes(views);
  const Result result = run({"process", "recording.npz", "--camera", "pico-flexx", "-o", "again"}, here);
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(content(folder / "out/depth.png"), content(folder / "again/depth.png"));
  const files::NpyArray start = files::read_npz(folder / "again/frame.npz", {"start_time_s"})[0].array;
  ASSERT_EQ(start.count(), 9U);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(start.number(k), k == 0 ? 0 : 3.7e-3 + 5.5e-3 * (static_cast<double>(k) - 1), 1e-15) << k;
}

TEST(process, takes_other_settings) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run({"render", "card", "-o", "out"}, here).code, 0);
  ASSERT_EQ(run({"process", "out/frame.npz", "-o", "same", "--camera", "pico-flexx"}, here).code, 0);
  ASSERT_EQ(run({"process", "out/frame.npz", "-o", "median", "--set", "camera.decoding.filter.kind=median"}, here).code, 0);
  ASSERT_EQ(run({"process", "out/frame.npz", "-o", "median2", "--set", "decoding.filter.kind=median", "--camera", "pico-flexx"}, here).code,
            0);
  EXPECT_EQ(content(folder / "out/depth.png"), content(folder / "same/depth.png"));
  EXPECT_NE(content(folder / "out/depth.png"), content(folder / "median/depth.png"));
  EXPECT_EQ(content(folder / "median/depth.png"), content(folder / "median2/depth.png"));
  EXPECT_EQ(run({"process", "out/frame.npz", "--set", "camera.decoding.filtre.kind=median"}, here).code, 2);
}

struct Dark {
  std::string name;
  Arguments arguments;
  std::string warning;
};

void expect_all_invalid(const fs::path& file) {
  std::map<std::string, files::NpyArray> arrays;
  for (files::NamedArray& one : files::read_npz(file)) arrays[one.name] = std::move(one.array);
  for (std::size_t i = 0; i < arrays.at("flags").count(); ++i) {
    ASSERT_NE(static_cast<unsigned>(arrays.at("flags").number(i)) & 31u, 0u) << "pixel " << i;
    ASSERT_EQ(arrays.at("confidence").number(i), 0);
    for (const char* name : {"z_m", "range_m"}) ASSERT_TRUE(std::isnan(arrays.at(name).number(i))) << name << " of pixel " << i;
    for (const char* name : {"amplitude_e", "ambient_e"})
      ASSERT_TRUE(std::isfinite(arrays.at(name).number(i))) << name << " of pixel " << i;
  }
}

const std::string grey_mode =
    "camera.modes.GREY={frame_rate: 5 Hz, sequence: [{lit: false, integration_time: 1 ms}, {lit: false, integration_time: 3 ms}]}";

class nothing_to_see : public testing::TestWithParam<Dark> {};

TEST_P(nothing_to_see, is_valid_output_with_a_warning) {
  const Folder folder;
  std::ofstream(folder / "empty.yaml") << "objects: []\n";
  Arguments arguments = GetParam().arguments;
  arguments.insert(arguments.end(), {"-o", "out"});
  const Result result = run(with_small_sensor(arguments), in_folder(folder.path()));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has(result.err, "warning: " + GetParam().warning)) << result.err;
  EXPECT_EQ(names_of(files_of(folder / "out")), all_files);
  expect_all_invalid(folder / "out" / "frame.npz");
  // What was written is good to go on with.
  EXPECT_EQ(run({"inspect", "out/frame.npz", "--pixel", "9,9"}, in_folder(folder.path())).code, 0);
  const Result processed = run({"process", "out/frame.npz", "-o", "again"}, in_folder(folder.path()));
  EXPECT_EQ(processed.code, 0) << processed.err;
  EXPECT_TRUE(has(processed.err, "warning: no pixel has a valid depth")) << processed.err;
  expect_all_invalid(folder / "again" / "frame.npz");
}

INSTANTIATE_TEST_SUITE_P(
    all, nothing_to_see,
    testing::Values(
        Dark{"empty", {"render", "empty.yaml", "--noise", "off"}, "the scene has no objects"},
        Dark{"empty_in_the_sun",
             {"render", "empty.yaml", "--noise", "off", "--set", "ambient={spectrum: sun_am15, level: 50 %}"},
             "no pixel has a valid depth"},
        Dark{"no_power",
             {"render", "card", "--noise", "off", "--set", "camera.illumination.0.power=0 W"},
             "the camera's light sources have no power"},
        Dark{"no_light", {"render", "card", "--set", "camera.illumination=[]"}, "the camera has no light source"},
        Dark{"no_light_in_the_sun", {"render", "sun-outdoors", "--set", "camera.illumination=[]"}, "the camera has no light source"},
        Dark{"no_lit_raw_frame", {"render", "card", "--set", grey_mode, "--mode", "GREY"}, "the mode GREY has no lit raw frame"},
        Dark{"no_lit_raw_frame_in_the_sun",
             {"render", "sun-outdoors", "--noise", "off", "--set", grey_mode, "--mode", "GREY"},
             "the mode GREY has no lit raw frame"},
        Dark{"no_light_at_all",
             {"render", "flying-ball", "--set", grey_mode, "--mode", "GREY", "--set", "camera.illumination=[]"},
             "the mode GREY has no lit raw frame"},
        Dark{"no_camera_and_no_objects", {"render", "empty.yaml", "--noise", "off"}, "no pixel has a valid depth"},
        Dark{"small_wells", {"render", "card", "--set", "camera.pixel.full_well=1 e"}, "no pixel has a valid depth"},
        Dark{"outside_the_lens_model",
             {"render", "card", "--set", "camera.lens.distortion={k1: -10}", "--set", "camera.lens.cx=500 px"},
             "no pixel has a valid depth"},
        Dark{"far_away", {"render", "card", "--noise", "off", "--set", "objects.0.plane.point=[0, 0, 900]"}, "no pixel has a valid depth"},
        Dark{"behind", {"render", "card", "--noise", "off", "--set", "objects.0.plane.point=[0, 0, -1]"}, "no pixel has a valid depth"},
        Dark{"saturated", {"render", "card", "--set", "camera.illumination.0.power=10 kW"}, "no pixel has a valid depth"},
        Dark{"black", {"render", "card", "--noise", "off", "--set", "objects.0.plane.reflectivity=0"}, "no pixel has a valid depth"},
        Dark{"all_noise", {"render", "card", "--set", "camera.pixel.read_noise=100 ke"}, "no pixel has a valid depth"},
        Dark{"strict", {"render", "card", "--set", "camera.decoding.noise_threshold=1 um"}, "no pixel has a valid depth"}),
    [](const testing::TestParamInfo<Dark>& one) { return one.param.name; });

TEST(check, warns_of_a_camera_without_light) {
  const Folder folder;
  const Result scene = run({"check", "card", "--set", "camera.illumination=[]"});
  EXPECT_EQ(scene.code, 0);
  EXPECT_TRUE(has(scene.err, "warning: the camera has no light source")) << scene.err;
  const Result profile = run({"check", "pico-flexx", "--set", grey_mode.substr(7)});
  EXPECT_EQ(profile.code, 0) << profile.err;
  EXPECT_TRUE(has(profile.err, "warning: the mode GREY has no lit raw frame")) << profile.err;
}

TEST(check, names_every_fault_with_its_place) {
  const Folder folder;
  std::ofstream(folder / "scene.yaml")
      << "objects:\n  - sphere: {center: [0, 0, 1], raduis: 25 cm}\n  - plane: {point: [0, 0, 2 kg], normal: [0, 0, -1]}\n";
  const Result result = run({"check", "scene.yaml"}, in_folder(folder.path()));
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(has(result.err, "scene.yaml:2:")) << result.err;
  EXPECT_TRUE(has(result.err, "scene.yaml:3:")) << result.err;
  EXPECT_TRUE(has(result.err, "did you mean \"radius\"?")) << result.err;
  EXPECT_EQ(run({"check", "demo"}).code, 0);
}

TEST(check, of_a_profile_names_numbers_without_a_source) {
  const Folder folder;
  write_own_camera(folder.path());
  EXPECT_EQ(run({"check", "mycam.yaml"}, in_folder(folder.path())).err, "");
  std::string text = content(folder / "mycam.yaml");
  const std::string with_source = "pixel_pitch: {value: 12 um, assumed: usual for a pixel of this kind}";
  ASSERT_TRUE(has(text, with_source));
  text.replace(text.find("  source: the paper; the device's SDK"), 2, "  note: x\n  #");
  std::ofstream(folder / "mycam.yaml") << text;
  const Result result = run({"check", "mycam.yaml", "--sources"}, in_folder(folder.path()));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has(result.err, "warning: sensor.width is 224, and does not say where that comes from")) << result.err;
}

}  // namespace
}  // namespace tofray::test
