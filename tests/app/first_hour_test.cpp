// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Small things of the first hour: which file to look at, which of two names counts, what was meant by a word.
#include <gtest/gtest.h>

#include <sstream>

#include "files/json.h"
#include "load/builtin.h"
#include "rows.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

constexpr const char* lone_ball = "objects:\n  - sphere: {center: [0.1, 0, 1.3], radius: 25 cm, reflectivity: 40 %}\n";

class first_hour : public testing::Test {
 protected:
  [[nodiscard]] Result tool(const Arguments& arguments) const { return run(arguments, in_folder(folder_.path())); }
  void save(const std::string& name, const std::string& text) const { write(folder_ / name, text); }
  /// A refusal whose text has these words.
  void expect_refused(const Arguments& arguments, const std::string& words) const {
    const Result result = tool(arguments);
    EXPECT_NE(result.code, 0) << words;
    EXPECT_TRUE(has(result.err, words)) << words << " in " << result.err;
  }

  Folder folder_;
};

std::string end_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  return end == std::string::npos ? "" : text.substr(text.rfind('\n', end) + 1, end - text.rfind('\n', end));
}

}  // namespace

TEST_F(first_hour, ends_with_the_picture_to_open) {
  save("ball.yaml", lone_ball);
  const std::string named = "   # the picture; depth.png is for programs: 16-bit mm, black in viewers";
  EXPECT_EQ(end_line(tool({"render", "ball.yaml", "-o", "out"}).err), "open out/preview.png" + named);
  EXPECT_EQ(end_line(tool({"demo", "-o", "shown"}).out), "open shown/preview.png" + named);
  EXPECT_EQ(end_line(tool({"render", "ball.yaml", "-o", "film", "--frames", "2", "--emit", "png"}).err),
            "open film/preview_0000.png" + named);
  EXPECT_FALSE(has(tool({"render", "ball.yaml", "-o", "data", "--emit", "npz"}).err, "open "));
}

TEST_F(first_hour, the_first_frame_of_a_series_has_its_number_in_the_picture) {
  save("ball.yaml", lone_ball);
  ASSERT_EQ(tool({"render", "ball.yaml", "-o", "alone", "--emit", "png"}).code, 0);
  ASSERT_EQ(tool({"render", "ball.yaml", "-o", "series", "--emit", "png", "--frames", "1"}).code, 0);
  EXPECT_EQ(content(folder_ / "alone/depth.png"), content(folder_ / "series/depth_0000.png"));
  EXPECT_NE(content(folder_ / "alone/preview.png"), content(folder_ / "series/preview_0000.png"));
}

TEST_F(first_hour, a_file_here_is_taken_before_what_is_built_in) {
  save("room.yaml", lone_ball);
  const std::string note = "note: room.yaml of this folder is taken, not the built-in scene room";
  for (const Arguments& command : {Arguments{"check", "room"}, Arguments{"render", "room", "-o", "out", "--emit", "npz"},
                                   Arguments{"inspect", "room", "--pixel", "112,86"}}) {
    const Result result = tool(command);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(has(result.err, note)) << result.err;
  }
  EXPECT_TRUE(has(tool({"check", "room"}).out, "room.yaml: good: scene with 1 object,"));
  EXPECT_TRUE(has(tool({"check", "room", "--json"}).out, "room.yaml of this folder is taken, not the built-in scene room"));
  save("card", lone_ball);
  EXPECT_TRUE(has(tool({"check", "card"}).out, "./card: good: scene with 1 object,"));
  // What is typed in full is no choice, and the demo is the demo.
  EXPECT_FALSE(has(tool({"check", "room.yaml"}).err, "built-in"));
  save("demo.yaml", lone_ball);
  const Result demo = tool({"demo", "-o", "shown"});
  EXPECT_FALSE(has(demo.out, " 1 objects,")) << demo.out;
  EXPECT_FALSE(has(demo.err, "note")) << demo.err;
  save("pico-flexx.yaml", lone_ball);
  EXPECT_TRUE(has(tool({"check", "pico-flexx"}).err, "note: pico-flexx.yaml of this folder is taken, not the built-in camera pico-flexx"));
}

TEST_F(first_hour, a_file_here_is_taken_by_bench_list_and_process_too) {
  save("card.yaml", "materials: {mine: {reflectivity: 0.3}}\nobjects: [sphere: {center: [0, 0, 1], radius: 20 cm, material: mine}]\n");
  const std::string note = "note: card.yaml of this folder is taken, not the built-in scene card";
  for (const Arguments& more :
       {Arguments{}, Arguments{"--compare"}, Arguments{"--batch", "2"}, Arguments{"--stage", "trace", "--backend", "cpu"}}) {
    Arguments arguments = with_small_sensor({"bench", "card", "--frames", "1", "--warmup", "0"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = tool(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(has(result.err, note)) << result.err;
    EXPECT_EQ(result.err.find(note), result.err.rfind(note)) << "once";
  }
  const Result list = tool({"list", "materials", "card"});
  EXPECT_TRUE(has(list.err, note)) << list.err;
  EXPECT_TRUE(has(list.out, "mine")) << list.out;
  ASSERT_EQ(tool({"render", "card", "-o", "out", "--emit", "npz"}).code, 0);
  EXPECT_FALSE(has(tool({"process", "out/frame.npz", "--camera", "pico-flexx", "--mode", "MODE_9_5FPS_2000", "-o", "depth"}).err, "note"));
  save("pico-flexx.yaml", lone_ball);
  const Result process =
      tool({"process", "out/frame.npz", "--camera", "pico-flexx", "--mode", "MODE_9_5FPS_2000", "-o", "depth", "--json"});
  EXPECT_EQ(process.code, 2) << "it is no profile";
  EXPECT_TRUE(has(process.err, "note: pico-flexx.yaml of this folder is taken, not the built-in camera pico-flexx")) << process.err;
  EXPECT_TRUE(has(process.err, "pico-flexx.yaml:")) << process.err;
}

TEST_F(first_hour, a_folder_here_is_inspected_before_what_is_built_in) {
  ASSERT_EQ(tool(with_small_sensor({"render", "card", "--emit", "npz"})).code, 0);
  const std::string note = "note: card/frame.npz is taken, not the built-in scene card";
  const Result inspected = tool({"inspect", "card"}), shown = tool({"preview", "card"});
  EXPECT_TRUE(has(inspected.err, note)) << inspected.err;
  EXPECT_TRUE(has(inspected.out, "(22, 28)")) << inspected.out;
  EXPECT_TRUE(has(shown.err, note)) << shown.err;
  EXPECT_FALSE(has(tool({"inspect", "card/frame.npz"}).err, "note"));
}

TEST_F(first_hour, a_scene_may_come_on_stdin) {
  save("ball.yaml", lone_ball);
  fs::create_directories(folder_ / "elsewhere");
  const auto piped = [&](const char* file, const Arguments& arguments) {
    return run(arguments, [this, file] {
      ::dup2(::open((folder_ / file).c_str(), O_RDONLY), 0);
      if (::chdir((folder_ / "elsewhere").c_str()) != 0) ::_exit(126);
    });
  };
  const Result checked = piped("ball.yaml", {"check", "-"});
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_TRUE(checked.out.starts_with("<stdin>: good: scene with 1 object,")) << checked.out;
  ASSERT_EQ(piped("ball.yaml", {"render", "-", "--emit", "npz", "--seed", "2"}).code, 0);
  ASSERT_TRUE(fs::exists(folder_ / "elsewhere/stdin/frame.npz")) << "called after where it comes from";
  ASSERT_EQ(tool({"render", "ball.yaml", "-o", "file", "--emit", "npz", "--seed", "2"}).code, 0);
  EXPECT_EQ(numbers_of(folder_ / "elsewhere/stdin/frame.npz", "raw"), numbers_of(folder_ / "file/frame.npz", "raw"));
  EXPECT_EQ(tool({"render", "--from", "elsewhere/stdin/manifest.json", "-o", "again"}).code, 0) << "the manifest has it";
  EXPECT_EQ(content(folder_ / "again/frame.npz"), content(folder_ / "elsewhere/stdin/frame.npz"));
  save("bad.yaml", "objects:\n  - sphere: {center: [0, 0, 1], radius: 25 kg, reflectivity: 0.5}\n");
  const Result bad = piped("bad.yaml", {"render", "-"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_TRUE(bad.err.starts_with("<stdin>:2:41: error: radius")) << bad.err;
  fs::copy_file(fs::path(TOFRAY_SOURCE_DIR) / "profiles/imx556.yaml", folder_ / "camera.yaml");
  EXPECT_TRUE(has(piped("camera.yaml", {"check", "-"}).out, "<stdin>: good: camera imx556")) << "a profile, too";
  EXPECT_EQ(tool({"check", "-"}).code, 2) << "nothing came";
}

/// What the first line of a refusal says to add, as words of a command line.
Arguments root_said_in(const std::string& err) {
  const std::string line = err.substr(0, err.find('\n')), before = "if this one is yours, add ";
  const std::size_t at = line.find(before);
  if (at == std::string::npos) return {};
  const std::string option = line.substr(at + before.size());
  const std::size_t blank = option.find(' ');
  std::string folder = option.substr(blank + 1);
  if (folder.size() > 2 && folder.front() == '"' && folder.back() == '"') folder = folder.substr(1, folder.size() - 2);
  return {option.substr(0, blank), folder};
}

TEST_F(first_hour, a_file_outside_of_the_scenes_folder_is_refused_with_the_option_that_lets_it) {
  const std::string corner = "v -1 -1 2\nv 1 -1 2\nv 0 1 2\nf 1 2 3\n";
  for (const char* folder : {"scenes", "robot", "my robot", "robot/parts", "deep/in/it"}) fs::create_directories(folder_ / folder);
  for (const char* file : {"robot/a.obj", "my robot/a.obj", "robot/parts/a.obj", "deep/in/it/a.obj", "deep/in/a.obj"}) save(file, corner);
  for (const std::string& file :
       Arguments{"../robot/a.obj", "../my robot/a.obj", "../robot/parts/../a.obj", "../deep/in/it/a.obj", folder_ / "robot/parts/a.obj"}) {
    save("scenes/s.yaml", "objects: [mesh: {file: \"" + file + "\", reflectivity: 0.5, up: none}]\n");
    const Result refused = tool({"check", "scenes/s.yaml"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_TRUE(has(refused.err, "scenes/s.yaml:1:24: error: \"")) << refused.err;
    EXPECT_TRUE(has(refused.err.substr(0, refused.err.find('\n')),
                    "\" leads out of the folder of this file, and a stranger's scene shall not read your files: if this one is yours, add "
                    "--root "))
        << refused.err;
    EXPECT_EQ(has(file, "my robot"), has(refused.err, "add --root \"my robot\"\n")) << refused.err;
    const Arguments root = root_said_in(refused.err);
    ASSERT_EQ(root.size(), 2U);
    EXPECT_EQ(root[0], "--root");
    EXPECT_TRUE(fs::exists(folder_.path() / root[1] / "a.obj")) << root[1] << ": the file's own folder, and no more";
    const Result taken = tool({"check", "scenes/s.yaml", root[0], root[1]});
    EXPECT_EQ(taken.code, 0) << taken.err;
  }
  // Two of them: the second refusal says the folder that holds both.
  save("scenes/s.yaml",
       "objects:\n  - mesh: {file: ../robot/a.obj, reflectivity: 0.5, up: none}\n"
       "  - mesh: {file: ../deep/in/a.obj, reflectivity: 0.5, up: none}\n");
  const Arguments first = root_said_in(tool({"check", "scenes/s.yaml"}).err);
  EXPECT_EQ(first, (Arguments{"--root", "robot"}));
  const Result again = tool({"check", "scenes/s.yaml", "--root", "robot"});
  EXPECT_TRUE(has(again.err, "leads out of the folder of this file and of that of --root, and a stranger's")) << again.err;
  EXPECT_EQ(root_said_in(again.err), (Arguments{"--root", "."})) << again.err;
  EXPECT_EQ(tool({"check", "scenes/s.yaml", "--root", "."}).code, 0);
}

TEST_F(first_hour, a_link_out_of_the_scenes_folder_is_refused_with_what_to_name) {
  fs::create_directories(folder_ / "scenes");
  save("a.obj", "v -1 -1 2\nv 1 -1 2\nv 0 1 2\nf 1 2 3\n");
  fs::create_symlink(folder_ / "a.obj", folder_ / "scenes/link.obj");
  save("scenes/s.yaml", "objects: [mesh: {file: link.obj, reflectivity: 0.5, up: none}]\n");
  const Result refused = tool({"check", "scenes/s.yaml", "--root", "."});
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(has(refused.err, "s.yaml:1:24: error: \"link.obj\" leads out of the folder by a link, and a stranger's scene"))
      << refused.err;
  EXPECT_TRUE(has(refused.err, "/a.obj\", and add --root .\n")) << refused.err;
  save("scenes/s.yaml", "objects: [mesh: {file: \"" + fs::canonical(folder_ / "a.obj").string() + "\", reflectivity: 0.5, up: none}]\n");
  EXPECT_EQ(tool({"check", "scenes/s.yaml", "--root", "."}).code, 0);
}

TEST_F(first_hour, no_refusal_says_to_open_all_of_the_disk) {
  save("s.yaml", "objects: [mesh: {file: /a.obj, reflectivity: 0.5}]\n");
  EXPECT_FALSE(has(tool({"check", "s.yaml"}).err, "add --root /")) << tool({"check", "s.yaml"}).err;
  save("s.yaml", "objects: [mesh: {file: /usr/a.obj, reflectivity: 0.5}]\n");
  EXPECT_TRUE(has(tool({"check", "s.yaml"}).err, "add --root /usr\n")) << tool({"check", "s.yaml"}).err;
  EXPECT_FALSE(has(tool({"check", "s.yaml", "--root", "/etc"}).err, "add --root")) << "of /etc and /usr there is nothing but all";
}

TEST_F(first_hour, keys_of_a_profile_may_begin_with_camera) {
  const auto noise_of = [&](const Arguments& more) {
    Arguments arguments{"check", "pico-flexx", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = tool(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.out;
  };
  const std::string without = noise_of({"--set", "illumination.0.power=0.1 W"});
  EXPECT_EQ(noise_of({"--set", "camera.illumination.0.power=0.1 W"}), without);
  EXPECT_NE(noise_of({}), without);
}

TEST_F(first_hour, a_map_that_is_set_takes_the_place_of_the_files) {
  save("lit.yaml", "ambient: {illuminance: 5 klx}\n" + std::string(lone_ball));
  EXPECT_EQ(tool({"check", "lit.yaml", "--set", "ambient={spectrum: sun_am15, level: 5 %}"}).code, 0);
  // What is wrong with it is wrong with the option, and is one thing.
  for (const char* scene : {"lit.yaml", "card"}) {
    const Result result = tool({"check", scene, "--set", "ambient={level: 5 %, illuminance: 5 klx}"});
    EXPECT_EQ(result.err,
              "--set ambient: error: ambient has \"level\" and \"illuminance\"\n  these keys say the same thing; keep one of them\n");
  }
}

TEST_F(first_hour, an_invalid_pixel_has_its_noise) {
  save("dark.yaml", "ambient: {illuminance: 5 klx}\nobjects:\n  - plane: {point: [0, 0, 2.5], normal: [0, 0, -1], reflectivity: 0.1}\n");
  const Result text = tool({"inspect", "dark.yaml", "--pixel", "10,10"}),
               json = tool({"inspect", "dark.yaml", "--pixel", "10,10", "--json"});
  const std::string before = "depth       none: low signal\n            noise ";
  ASSERT_TRUE(has(text.out, before)) << text.out;
  EXPECT_TRUE(has(text.out, " mm (1 sigma), above camera.decoding.noise_threshold: 70 mm\n")) << text.out;
  double noise_m = 0;
  ASSERT_TRUE(files::parse_json(json.out, "stdout").find("depth")->find("noise_m")->number(noise_m));
  EXPECT_NEAR(std::stod(text.out.substr(text.out.find(before) + before.size())), 1e3 * noise_m, 0.0051);
}

TEST_F(first_hour, numbers_without_a_source_are_counted) {
  std::string profile(load::find_builtin(load::builtin_profiles(), "pico-flexx")->text);
  save("own.yaml", profile + "\nrefractive_index: 1.0003\n");
  const std::string one = "warning: refractive_index is 1.0003, and does not say where that comes from\n  expected source: or assumed: ";
  EXPECT_TRUE(has(tool({"check", "own.yaml"}).err, one));  // one is no more lines than a count
  const std::string source = "  source: the paper; the device's SDK";
  ASSERT_TRUE(has(profile, source));
  profile.replace(profile.find(source), source.size(), "  note: x");
  save("own.yaml", profile + "\nrefractive_index: 1.0003\n");
  const std::string each = tool({"check", "own.yaml", "--sources"}).err, counted = tool({"check", "own.yaml"}).err;
  std::size_t lines = 0;
  for (std::size_t at = each.find("does not say where"); at != std::string::npos; at = each.find("does not say where", at + 1)) ++lines;
  EXPECT_GT(lines, 1U);
  EXPECT_TRUE(has(each, "warning: refractive_index is 1.0003, and does not say where")) << each;
  EXPECT_EQ(counted, "own.yaml: warning: " + std::to_string(lines) +
                         " numbers do not say where they come from\n  expected source: or assumed: beside it, or for its group; --sources "
                         "names each\n");
}

TEST_F(first_hour, words_that_are_meant_otherwise) {
  save("ball.yaml", lone_ball);
  const auto set = [](const char* text) { return Arguments{"check", "ball.yaml", "--set", text}; };
  expect_refused(set("seed=3"), "unknown key \"seed\" in the scene; did you mean the option --seed?");
  expect_refused(set("camera.f_number=1.2"), "unknown key \"f_number\" in camera; did you mean \"camera.lens.f_number\"?");
  for (const char* key : {"wavelength", "camera.wavelength"})
    expect_refused(set((key + std::string("=940 nm")).c_str()), "did you mean \"camera.illumination.0.illumination_wavelength\"?");
  expect_refused(set("camera.illumination.0.wavelength=940 nm"),
                 "unknown key \"wavelength\" in illumination[0]; did you mean \"illumination_wavelength\"?");
  expect_refused({"check", "pico-flexx", "--set", "wavelength=940 nm"}, "did you mean \"illumination.0.illumination_wavelength\"?");
  expect_refused({"render", "ball.yaml", "--sed", "3"}, "unknown option \"--sed\"; did you mean \"--seed\"?");
  expect_refused({"render", "ball.yaml", "--sat", "x=3"}, "unknown option \"--sat\"; did you mean \"--set\"?");
}

TEST_F(first_hour, a_frame_that_is_not_there_is_told_with_those_that_are) {
  save("ball.yaml", lone_ball);
  ASSERT_EQ(tool({"render", "ball.yaml", "-o", "out", "--frames", "3"}).code, 0);
  for (const char* command : {"inspect", "process"}) {
    const Result result = tool({command, "out/frame.npz"});
    EXPECT_EQ(result.code, 3);
    EXPECT_EQ(result.err,
              "out/frame.npz: error: there is no such file\n  the folder \"out\" holds frame_0000.npz … frame_0002.npz (3 files)\n");
  }
  expect_refused({"inspect", "frame.npz"}, "this folder holds no .npz file");
}

TEST_F(first_hour, help_is_as_wide_as_the_terminal_and_in_groups) {
  for (const int columns : {60, 80, 100}) {
    const auto narrow = [&] {
      in_folder(folder_.path())();
      ::setenv("COLUMNS", std::to_string(columns).c_str(), 1);
    };
    for (const char* command : {"demo", "render", "process", "inspect", "preview", "diff", "check", "list", "schema", "calibration",
                                "doctor", "bench", "completion", ""}) {
      const Result help = run(*command == '\0' ? Arguments{"--help"} : Arguments{command, "--help"}, narrow);
      std::istringstream lines(help.out);
      for (std::string line; std::getline(lines, line);)
        // A command that is longer stands as it is typed; none is longer than an ordinary terminal.
        EXPECT_TRUE(line.size() <= static_cast<std::size_t>(columns) + 4 || (columns < 80 && line.starts_with("  tofray ")))
            << columns << ": " << line;
    }
  }
  const std::string help = tool({"render", "--help"}).out;
  std::size_t at = 0;
  for (const char* group : {"\nScene and camera:\n", "\nSimulation:\n", "\nFrames:\n", "\nOutput:\n", "\nMachine:\n"}) {
    EXPECT_GT(help.find(group, at), at) << group;
    at = help.find(group, at);
    ASSERT_NE(at, std::string::npos) << group;
  }
  EXPECT_FALSE(has(help, "\n\n\n"));
}

TEST_F(first_hour, a_mesh_alone_is_seen_from_as_near_as_the_view_allows) {
  save("small.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.5 0.5 0.4\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const auto seen_share = [&](const Arguments& more) {
    Arguments arguments{"check", "small.obj", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = tool(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    const files::Json json = files::parse_json(result.out, "stdout");
    return number(json.find("scene_report")->find("objects")->items()->at(0), "share_of_pixels");
  };
  const double near = seen_share({});
  EXPECT_GT(near, 0.1);  // from the distance of the ball round it they are 0.08
  // A camera that sees half the angle stands twice as far away and has as many pixels on the mesh.
  EXPECT_NEAR(seen_share({"--set", "camera.lens.fx=420 px", "--set", "camera.lens.fy=420 px"}) / near, 1, 0.35);
}

TEST_F(first_hour, says_which_passes_a_frame_takes) {
  const Result plan = tool({"inspect", "room", "--subpixel", "2", "--plan"});
  EXPECT_EQ(plan.code, 0) << plan.err;
  for (const char* words : {"from_rays        light, sample 4 of 4", "from_arrays      from the light image", "154 tiles"})
    EXPECT_TRUE(has(plan.out, words)) << words << " in\n" << plan.out;
  const Result told = tool({"inspect", "card", "--plan", "--json"});
  EXPECT_EQ(files::parse_json(told.out, "plan").find("plan")->items()->front().find("name")->string()->compare("from_rays"), 0) << told.out;
  expect_refused({"inspect", "card", "--plan", "--pixel", "1,1"}, "--plan computes nothing");
  EXPECT_EQ(tool({"render", "card", "--emit", "npz", "--quiet", "-o", "out"}).code, 0);
  expect_refused({"inspect", "out/frame.npz", "--plan"}, "this file is finished");
}

}  // namespace tofray::test
