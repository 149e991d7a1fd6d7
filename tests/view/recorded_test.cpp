// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Frames that lie in files, played by the viewer.
#include <gtest/gtest.h>

#include "support/text.h"
#include "view/viewer.h"

namespace tofray::test {
namespace {

using files::Json;

const std::string& text_of(const Json& json, const char* name) {
  static const std::string none;
  const Json* found = json.find(name);
  return found != nullptr && found->is_string() ? *found->string() : none;
}

std::string at_frame(std::uint64_t frame) { return R"({"type":"seek","frame":)" + std::to_string(frame) + "}"; }

/// Frames of `render` in a folder.
struct Rendered {
  explicit Rendered(const Arguments& more = {}, int frames = 3) {
    Arguments words = {"render", "demo", "-o", "out", "--frames", std::to_string(frames), "-q", "--emit", "npz"};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = run(with_small_sensor(words), in_folder(folder.path()));
    EXPECT_EQ(result.code, 0) << result.err;
  }
  [[nodiscard]] std::string file(std::uint64_t frame) const {
    return (folder / ("out/frame_000" + std::to_string(frame) + ".npz")).native();
  }
  [[nodiscard]] std::string bytes(std::uint64_t frame, const char* array) const {
    return files::read_npz(file(frame), {array}).at(0).array.bytes;
  }
  Folder folder;
};

WireFrame shown(Greeted& one, std::uint64_t frame, const std::string& arrays, std::uint32_t generation = 1) {
  one.page.send(R"({"type":"pause"})");
  one.page.send(at_frame(frame));
  one.page.want(arrays);
  return one.page.frame_with([&](const WireFrame& each) { return each.frame == frame && each.generation == generation; })
      .value_or(WireFrame());
}

TEST(recorded, frames_are_those_of_the_files_in_order) {
  NEEDS_THE_VIEWER;
  const Rendered rendered;
  for (const std::string& path : {(rendered.folder / "out").native(), rendered.file(1)}) {
    const bool is_folder = path.ends_with("out");
    const Viewer viewer({path}, false);
    Greeted one(viewer);
    EXPECT_EQ(number_in(one.hello, "frames"), is_folder ? 3 : 1);
    EXPECT_EQ(text_of(*one.hello.find("source"), "kind"), "files");
    EXPECT_EQ(*one.hello.find("source")->find("raw")->boolean(), true);
    EXPECT_EQ(one.hello.find("absent")->items()->size(), 0u);
    EXPECT_EQ(number_in(one.hello, "width"), 28);
    for (std::uint64_t i = 0; i < (is_folder ? 3u : 1u); ++i) {
      const WireFrame frame = shown(one, i, R"("z_m","raw","flags","gt_z_m","lit","gt_multipath_m")");
      for (const char* name : {"z_m", "raw", "flags", "gt_z_m"})
        EXPECT_TRUE(frame.arrays.at(number_of(one.hello, name)) == rendered.bytes(is_folder ? i : 1, name)) << name << " " << i;
    }
    // Beyond the last one there is none.
    one.page.send(at_frame(70));
    const auto state = one.page.text("state");
    ASSERT_TRUE(state);
    EXPECT_EQ(number_in(*state, "frame"), is_folder ? 2 : 0);
  }
}

TEST(recorded, frames_begin_anew_at_their_end) {
  NEEDS_THE_VIEWER;
  const Rendered rendered;
  const Viewer viewer({(rendered.folder / "out").native()}, false);
  Greeted one(viewer);
  one.page.want("\"z_m\"");
  std::vector<std::uint64_t> seen;
  while (seen.size() < 7) {
    const auto frame = one.page.frame();
    ASSERT_TRUE(frame);
    one.page.acknowledge(*frame);
    seen.push_back(frame->frame);
  }
  EXPECT_EQ(seen, (std::vector<std::uint64_t>{0, 1, 2, 0, 1, 2, 0}));
}

TEST(recorded, raw_frames_are_decoded_by_keys_as_process_decodes_them) {
  NEEDS_THE_VIEWER;
  const Rendered rendered;
  const Viewer viewer({(rendered.folder / "out").native()}, false);
  Greeted one(viewer);
  const Json controls = one.page.answer(R"({"type":"controls","id":1})", "controls");
  std::size_t filters = 0;
  for (const Json& row : *controls.find("controls")->items()) {
    EXPECT_TRUE(text_of(row, "key").starts_with("camera.decoding.")) << text_of(row, "key");
    if (text_of(row, "key") == "camera.decoding.noise_threshold") ++filters;
  }
  EXPECT_EQ(filters, 1u);
  const Json done = one.page.answer(R"({"type":"set","id":2,"key":"camera.decoding.filter","text":"{kind: median}"})");
  ASSERT_EQ(text_of(done, "type"), "done") << files::json_text(done);
  const WireFrame frame = shown(one, 2, "\"z_m\"", 2);
  const std::string command = text_of(Greeted(viewer).hello, "command");
  EXPECT_TRUE(command.starts_with("tofray process ")) << command;
  const std::string line =
      "cd '" + viewer.folder().path().native() + "' && " + std::string(TOFRAY_TOOL) + command.substr(6) + " -q -o made";
  ASSERT_EQ(std::system(line.c_str()), 0) << line;
  const std::string made = files::read_npz(viewer.folder() / "made/frame.npz", {"z_m"}).at(0).array.bytes;
  EXPECT_TRUE(frame.arrays.at(number_of(one.hello, "z_m")) == made);
  EXPECT_FALSE(made == rendered.bytes(2, "z_m"));
  // A list with the seed in force, as undo sends it; another seed would be one of a simulation.
  EXPECT_EQ(text_of(one.page.answer(R"({"type":"state","id":4,"overrides":[],"seed":0})"), "type"), "done");
  EXPECT_TRUE(has(text_of(one.page.answer(R"({"type":"state","id":5,"overrides":[],"seed":1})"), "text"), "no scene is known"));
  // A key that is none, in the command line's words.
  const Json wrong = one.page.answer(R"({"type":"set","id":3,"key":"camera.decoding.filtr","text":"1"})");
  EXPECT_TRUE(has(text_of(wrong, "text"), R"(unknown key "filtr" in decoding; did you mean "filter"?)")) << files::json_text(wrong);
  EXPECT_EQ(text_of(wrong, "key"), "camera.decoding.filtr");
}

TEST(recorded, frames_stand_beside_another_decoding_and_beside_a_simulation) {
  NEEDS_THE_VIEWER;
  const Rendered rendered;
  const Viewer viewer({(rendered.folder / "out").native()}, false);
  Greeted one(viewer);
  one.page.send(R"({"type":"pause"})");
  one.page.want("\"z_m\"");
  const auto of_b = [&](const std::string& message) {
    const Json done = one.page.answer(message);
    EXPECT_EQ(text_of(done, "type"), "done") << files::json_text(done);
    const auto frame = one.page.frame_with([&](const WireFrame& each) {
      return each.channel == 1 && each.generation == static_cast<std::uint32_t>(number_in(done, "generation"));
    });
    return frame ? frame->arrays.at(number_of(one.hello, "z_m")) : std::string();
  };
  EXPECT_TRUE(of_b(R"({"type":"other","id":1,"overrides":[]})") == rendered.bytes(0, "z_m"));
  EXPECT_FALSE(of_b(R"({"type":"other","id":2,"overrides":[{"key":"camera.decoding.filter","text":"{kind: median}"}]})") ==
               rendered.bytes(0, "z_m"));
  EXPECT_EQ(of_b(R"({"type":"other","id":3,"overrides":[],"scene":"demo"})").size(), 4u * 224 * 172);
}

TEST(recorded, frames_stand_beside_their_own_scene_from_the_start) {
  NEEDS_THE_VIEWER;
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  write(folder / "s.yaml",
        "camera: {profile: pico-flexx}\nobjects: [{plane: {point: [0, 0, 1], normal: [0, 0, -1], reflectivity: 0.8}}]\n");
  ASSERT_EQ(run({"render", "s.yaml", "-o", "out", "--frames", "2", "-q", "--emit", "npz"}, here).code, 0);
  const Viewer viewer({"out", "--beside", "s.yaml", "--set", "camera.decoding.filter=median"}, false, here);
  Greeted one(viewer);
  const Json* other = one.hello.find("other");
  ASSERT_TRUE(other != nullptr && other->is_object());
  EXPECT_EQ(text_of(*other, "command"), "tofray render s.yaml");
  EXPECT_EQ(other->find("overrides")->items()->size(), 0u);
  one.page.send(R"({"type":"pause"})");
  one.page.send(at_frame(1));
  one.page.want("\"z_m\"");
  const auto of_side = [&](int channel) {
    const auto frame = one.page.frame_with([&](const WireFrame& each) { return each.frame == 1 && each.channel == channel; });
    return frame ? frame->arrays.at(number_of(one.hello, "z_m")) : std::string();
  };
  const std::string of_a = of_side(0), of_b = of_side(1);
  const std::string made = files::read_npz(folder / "out/frame_0001.npz", {"z_m"}).at(0).array.bytes;
  EXPECT_TRUE(of_b == made);
  EXPECT_FALSE(of_a == made) << "side A has the filter";
  const Result wrong = run({"view", "out", "--beside", "nothing.yaml", "--test-hooks"}, here);
  EXPECT_TRUE(has(wrong.err, "nothing.yaml")) << wrong.err;
}

TEST(recorded, frames_beside_a_simulation_become_no_page_in_a_file) {
  NEEDS_THE_VIEWER;
  const Rendered rendered;
  const Result made = run({"view", "out", "--beside", "demo", "--export", "a.html"}, in_folder(rendered.folder.path()));
  if (has(made.err, "npm was not there")) GTEST_SKIP() << "built without npm";
  EXPECT_TRUE(has(made.err, "of one side")) << made.err;
}

TEST(recorded, pixels_have_their_way_from_raw_frames) {
  NEEDS_THE_VIEWER;
  const Rendered rendered;
  const Viewer viewer({rendered.file(1)}, false);
  Greeted one(viewer);
  shown(one, 0, "\"z_m\"");
  const Json answer = one.page.answer(R"({"type":"pixel","id":1,"u":13,"v":10})", "pixel");
  ASSERT_EQ(text_of(answer, "type"), "pixel") << files::json_text(answer);
  const Result inspected = run({"inspect", rendered.file(1), "--pixel", "13,10", "--json"});
  const Json report = files::parse_json(inspected.out, "inspect");
  for (const char* part : {"raw_frames", "phases", "depth"}) {
    const Json *told = answer.find("report")->find(part), *expected = report.find(part);
    ASSERT_TRUE((told == nullptr) == (expected == nullptr)) << part;
    if (told != nullptr) {
      EXPECT_EQ(files::json_text(*told), files::json_text(*expected)) << part;
    }
  }
  EXPECT_GT(answer.find("flow")->items()->size(), 5u);
  const Json outside = one.page.answer(R"({"type":"pixel","id":2,"u":28,"v":0})", "pixel");
  EXPECT_TRUE(has(text_of(outside, "text"), "pixel 28,0 is outside the image"));
}

TEST(recorded, frames_say_what_they_cannot_and_refuse_it) {
  NEEDS_THE_VIEWER;
  const Rendered rendered({"--arrays", "z_m,flags"});
  const Viewer viewer({(rendered.folder / "out").native()}, false);
  Greeted one(viewer);
  EXPECT_TRUE(shown(one, 1, R"("z_m","gt_z_m")").arrays.at(number_of(one.hello, "z_m")) == rendered.bytes(1, "z_m"));
  const Json& cannot = *one.hello.find("cannot");
  const std::pair<const char*, const char*> messages[] = {{"seed", R"(,"seed":3)"},
                                                          {"set", R"(,"key":"camera.decoding.filter","text":"median")"},
                                                          {"why", R"(,"u":3,"v":3)"},
                                                          {"drag", R"(,"object":1,"from":[3,3],"to":[4,4],"how":"parallel")"},
                                                          {"place", R"(,"object":1,"position":[0,0,1],"rotation":null)"},
                                                          {"camera", R"(,"position":[0,0,1],"rotation":null)"},
                                                          {"temporal", R"(,"frames":5)"},
                                                          {"screenshot", ""},
                                                          {"restore", R"(,"text":"{}")"},
                                                          {"record", R"(,"first":0,"frames":2)"},
                                                          {"save", ""},
                                                          {"measure", R"(,"a":[3,3],"b":[4,4])"},
                                                          {"region", R"(,"region":[3,3,5,5])"}};
  for (const auto& [type, more] : messages) {
    EXPECT_FALSE(text_of(cannot, type).empty()) << type;
    const Json answer = one.page.answer(std::string(R"({"type":")") + type + R"(","id":1)" + more + "}", "none");
    EXPECT_EQ(text_of(answer, "type"), "fault") << type;
    EXPECT_TRUE(has(text_of(answer, "text"), text_of(cannot, type).substr(1))) << files::json_text(answer);
  }
  // What they can is not among it: the camera is known.
  EXPECT_EQ(cannot.find("view3d"), nullptr);
  EXPECT_EQ(text_of(one.page.answer(R"({"type":"view3d","id":9})", "view3d"), "type"), "view3d");
  // Panes without arrays have a reason.
  std::map<std::string, std::string> absent;
  for (const Json& pane : *one.hello.find("absent")->items()) absent[text_of(pane, "array")] = text_of(pane, "why");
  EXPECT_EQ(absent["z_error_m"], "The files have no ground truth for it");
  EXPECT_EQ(absent["amplitude_e"], "The files have no amplitude_e");
  EXPECT_EQ(absent.count("z_m"), 0u);
  const Json pixel = one.page.answer(R"({"type":"pixel","id":1,"u":13,"v":10})", "pixel");
  EXPECT_EQ(text_of(pixel, "type"), "pixel");
  EXPECT_EQ(pixel.find("report")->members()->size(), 0u);
}

/// Raw frames as a camera's recorder leaves them: no truth, and nobody says which camera it was.
std::string measured(const Rendered& from, const Folder& into) {
  std::vector<files::NpyView> views;
  const auto arrays = files::read_npz(from.file(0), {"raw", "modulation_frequency_hz", "reference_phase_rad", "integration_time_s", "lit"});
  for (const auto& [name, array] : arrays) views.push_back({name, array.type, array.shape, array.bytes});
  write(into / "measured.npz", files::npz_bytes(views));
  return (into / "measured.npz").native();
}

TEST(recorded, raw_frames_of_a_camera_that_is_named_become_depth_without_truth) {
  NEEDS_THE_VIEWER;
  const Rendered rendered;
  const Folder folder;
  const std::string file = measured(rendered, folder);
  {
    const Viewer viewer({file}, false);
    Greeted one(viewer);
    const Json& cannot = *one.hello.find("cannot");
    EXPECT_TRUE(has(text_of(cannot, "set"), "`tofray view --camera PROFILE`")) << text_of(cannot, "set");
    EXPECT_EQ(one.hello.find("panes")->items()->size(), 0u);
    EXPECT_TRUE(shown(one, 0, "\"raw\"").arrays.at(number_of(one.hello, "raw")) == rendered.bytes(0, "raw"));
  }
  const Viewer viewer({file, "--camera", "pico-flexx", "--mode", "MODE_9_5FPS_2000"});
  Greeted one(viewer);
  const Result processed = run(
      with_small_sensor({"process", file, "--camera", "pico-flexx", "--mode", "MODE_9_5FPS_2000", "-q", "-o", (folder / "made").native()}));
  ASSERT_EQ(processed.code, 0) << processed.err;
  const std::string made = files::read_npz(folder / "made/frame.npz", {"z_m"}).at(0).array.bytes;
  EXPECT_TRUE(shown(one, 0, "\"z_m\"").arrays.at(number_of(one.hello, "z_m")) == made);
  std::map<std::string, std::string> absent;
  for (const Json& pane : *one.hello.find("absent")->items()) absent[text_of(pane, "array")] = text_of(pane, "why");
  EXPECT_EQ(absent["gt_z_m"], "The files have no ground truth for it");
  for (const char* asked : {R"({"type":"measure","id":1,"a":[3,3],"b":[12,10]})", R"({"type":"region","id":1,"region":[3,3,15,15]})"}) {
    const Json answer = one.page.answer(asked, has(asked, "measure") ? "measure" : "region");
    EXPECT_NE(text_of(answer, "type"), "fault") << files::json_text(answer);
  }
}

TEST(recorded, files_that_are_none_are_refused_with_the_way_out) {
  NEEDS_THE_VIEWER;
  const Rendered rendered;
  const Folder folder;
  fs::create_directory(folder / "empty");
  write(folder / "broken.npz", "PK\x03\x04 nothing");
  fs::create_directory(folder / "mixed");
  fs::copy_file(rendered.file(0), folder / "mixed/a.npz");
  ASSERT_EQ(run({"render", "demo", "-q", "--emit", "npz", "-o", (folder / "mixed").native()}).code, 0);
  const auto said = [&](const Arguments& words) {
    Arguments all = {"view", "--port", "0", "--test-hooks"};
    all.insert(all.end(), words.begin(), words.end());
    const Result result = run(all, in_folder(folder.path()));
    EXPECT_NE(result.code, 0);
    return result.err;
  };
  EXPECT_TRUE(has(said({"empty"}), "empty: error: the folder has no .npz files"));
  EXPECT_TRUE(has(said({"none.npz"}), "none.npz: error: there is no such file"));
  EXPECT_TRUE(has(said({"broken.npz"}), "broken.npz: error: "));
  EXPECT_TRUE(has(said({rendered.file(0), "--seed", "3"}), "--set changes how depth is computed of raw frames"));
  EXPECT_TRUE(has(said({"demo", "--camera", "pico-flexx"}), "--camera is of files with raw frames"));
  // A frame of another size is told when its turn comes, and the others stay.
  const Viewer viewer({(folder / "mixed").native()}, false);
  Greeted one(viewer);
  one.page.send(R"({"type":"pause"})");
  one.page.want("\"z_m\"");
  one.page.send(at_frame(1));
  const auto fault = one.page.text("fault");
  ASSERT_TRUE(fault);
  EXPECT_TRUE(has(text_of(*fault, "text"), "its images have 224 x 172 pixels")) << files::json_text(*fault);
  EXPECT_TRUE(shown(one, 0, "\"z_m\"").arrays.at(number_of(one.hello, "z_m")) == rendered.bytes(0, "z_m"));
}

TEST(recorded, folder_of_a_scene_s_name_leaves_the_scene_to_its_name) {
  NEEDS_THE_VIEWER;
  const Rendered rendered;
  fs::rename(rendered.folder / "out", rendered.folder / "demo");
  for (const char* word : {"demo", "./demo"}) {
    const Viewer viewer({word}, *word == 'd', in_folder(rendered.folder.path()));
    EXPECT_EQ(Greeted(viewer).hello.find("source") != nullptr, *word == '.') << word;
  }
}

TEST(recorded, frames_become_a_page_in_a_file) {
  NEEDS_THE_VIEWER;
  const Rendered rendered;
  const Result made = run({"view", "out", "--export", "a.html"}, in_folder(rendered.folder.path()));
  if (has(made.err, "npm was not there")) GTEST_SKIP() << "built without npm";
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(has(made.err, "a.html: 3 frames in a page of ")) << made.err;
  const Result beyond = run({"view", "out", "--export", "a.html", "--frames", "5"}, in_folder(rendered.folder.path()));
  EXPECT_TRUE(has(beyond.err, "frames 0 to 4 were asked for, and there are those from 0 to 2")) << beyond.err;
}

}  // namespace
}  // namespace tofray::test
