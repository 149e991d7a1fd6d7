// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// States as lists of --set: set as a whole, told as controls, saved as a file, two beside each other.
#include <algorithm>
#include <fstream>

#include "files/npz.h"
#include "load/load.h"
#include "tofray/load.h"
#include "tofray/simulator.h"
#include "view/viewer.h"

namespace tofray::test {
namespace {

using files::Json;

std::string text_in(const Json& json, const char* name) {
  const Json* found = json.find(name);
  return found == nullptr || !found->is_string() ? "(none)" : *found->string();
}

/// KEY=TEXT, in order.
std::string overrides_of(const Json& state) {
  std::string out;
  for (const Json& one : *state.find("overrides")->items()) out += text_in(one, "key") + "=" + text_in(one, "text") + " ";
  return out;
}

/// What --set has beyond the small sensor's keys.
std::string own_overrides(const Json& state) {
  std::string out = overrides_of(state);
  const std::size_t last = out.find("pixel_pitch=96 um ");
  return last == std::string::npos ? out : out.substr(last + 18);
}

const Json small_overrides = [] {
  Json all = Json::array();
  const Arguments words = with_small_sensor({});
  for (std::size_t i = 1; i < words.size(); i += 2) {
    const std::size_t equal = words[i].find('=');
    all.push(Json::object().set("key", words[i].substr(0, equal)).set("text", words[i].substr(equal + 1)));
  }
  return all;
}();

/// {"key":…,"text":…} of the small sensor and these.
std::string list_with(const std::vector<std::pair<std::string, std::string>>& more) {
  Json all = small_overrides;
  for (const auto& [key, text] : more) all.push(Json::object().set("key", key).set("text", text));
  return files::json_text(all);
}

/// Runs a command that the page shows, in the viewer's folder.
void run_command(const Viewer& viewer, const std::string& command, const std::string& output) {
  const std::string line = "cd " + viewer.folder().path().native() + " && export PATH=" + fs::path(TOFRAY_TOOL).parent_path().native() +
                           ":$PATH && " + command + " -o " + output + " --emit npz -q";
  ASSERT_EQ(std::system(line.c_str()), 0) << line;
}

TEST(states, are_set_as_a_whole_or_not_at_all) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  Json done = one.page.answer(R"({"type":"state","id":1,"seed":7,"overrides":)" +
                              list_with({{"ambient.level", "1 %"}, {"camera.lens.f_number", "1.8"}}) + "}");
  ASSERT_EQ(text_in(done, "type"), "done");
  EXPECT_EQ(number_in(done, "id"), 1);
  EXPECT_EQ(number_in(done, "generation"), 2);
  Json fault = one.page.answer(R"({"type":"state","id":2,"seed":8,"overrides":)" +
                               list_with({{"ambient.level", "2 %"}, {"camera.lens.f_number", "banana"}}) + "}");
  ASSERT_EQ(text_in(fault, "type"), "fault");
  EXPECT_EQ(number_in(fault, "id"), 2);
  EXPECT_EQ(text_in(fault, "key"), "camera.lens.f_number");
  Greeted late(viewer);
  EXPECT_EQ(own_overrides(late.hello), "ambient.level=1 % camera.lens.f_number=1.8 ");
  EXPECT_EQ(number_in(late.hello, "seed"), 7);
  EXPECT_EQ(number_in(late.hello, "generation"), 2);
}

TEST(states, keep_the_place_of_a_key_that_is_set_again) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  for (const char* set : {R"("ambient.level","text":"1 %")", R"("camera.lens.f_number","text":"1.8")", R"("ambient.level","text":"2 %")"})
    EXPECT_EQ(text_in(one.page.answer(std::string(R"({"type":"set","id":1,"key":)") + set + "}"), "type"), "done");
  EXPECT_EQ(own_overrides(Greeted(viewer).hello), "ambient.level=2 % camera.lens.f_number=1.8 ");
}

TEST(states, of_two_pages_that_set_at_once_have_what_both_said_and_each_page_has_its_answers) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer), two(viewer);
  for (int i = 0; i < 30; ++i) {
    one.page.send(R"({"type":"set","id":)" + std::to_string(100 + i) + R"(,"key":"camera.lens.f_number","text":")" + std::to_string(2 + i) +
                  "\"}");
    // Every third is wrong; it must not take away what the other page says of the same key.
    two.page.send(R"({"type":"set","id":)" + std::to_string(200 + i) +
                  (i % 3 == 0 ? R"(,"key":"camera.lens.f_number","text":"banana"})"
                              : R"(,"key":"ambient.level","text":")" + std::to_string(i) + " %\"}"));
  }
  const auto answers = [](Page& page, int first) {
    std::map<int, std::string> all;
    while (all.size() < 30) {
      const WsMessage message = page.next();
      if (message.opcode < 0) break;
      if (message.opcode != 1) continue;
      const Json json = message.json();
      const std::string type = text_in(json, "type");
      if (type != "done" && type != "fault") continue;
      const int id = static_cast<int>(number_in(json, "id")) - first;
      EXPECT_TRUE(all.emplace(id, type).second) << id;
    }
    return all;
  };
  const auto of_one = answers(one.page, 100), of_two = answers(two.page, 200);
  ASSERT_EQ(of_one.size(), 30u);
  ASSERT_EQ(of_two.size(), 30u);
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(of_one.at(i), "done") << i;
    EXPECT_EQ(of_two.at(i), i % 3 == 0 ? "fault" : "done") << i;
  }
  const std::string all = own_overrides(Greeted(viewer).hello);
  EXPECT_TRUE(has(all, "camera.lens.f_number=31") && has(all, "ambient.level=29 %")) << all;
}

TEST(controls_of_a_page, are_those_of_the_command_line) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"room"}, false);
  Greeted one(viewer);
  const Json here = one.page.answer(R"({"type":"controls","id":6})", "controls");
  EXPECT_EQ(number_in(here, "id"), 6);
  EXPECT_EQ(text_in(here, "side"), "a");
  const Json there = files::parse_json(run({"list", "controls", "room", "--json"}).out, "list");
  EXPECT_TRUE(files::json_text(*here.find("controls")) == files::json_text(*there.find("controls")));
  one.page.answer(R"({"type":"set","id":7,"key":"camera.lens.f_number","text":"2.2"})");
  const Json later = one.page.answer(R"({"type":"controls","id":8})", "controls");
  EXPECT_EQ(number_in(later, "generation"), 2);
  for (const Json& row : *later.find("controls")->items())
    if (text_in(row, "key") == "camera.lens.f_number") {
      EXPECT_EQ(text_in(row, "text"), "2.2");
      EXPECT_TRUE(*row.find("changed")->boolean());
    }
}

// Each key's example, or another choice: the page's frame, or its fault, is that of --set.
TEST(controls_of_a_page, set_to_their_examples_give_what_set_gives) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  one.page.answer(R"({"type":"pause"})", "state");
  one.page.want("\"raw\",\"z_m\"");
  const Json controls = one.page.answer(R"({"type":"controls","id":1})", "controls");
  const int raw = number_of(one.hello, "raw"), z = number_of(one.hello, "z_m");
  int done = 0, faults = 0;
  for (const Json& row : *controls.find("controls")->items()) {
    const Json* example = row.find("example");
    const Json* choices = row.find("choices");
    if (example == nullptr && choices == nullptr) continue;
    const std::string key = text_in(row, "key"), text = choices != nullptr ? *choices->items()->back().string() : *example->string();
    const Json answer = one.page.answer(R"({"type":"state","id":2,"overrides":)" + list_with({{key, text}}) + "}");
    if (!*row.find("settable")->boolean() && key.starts_with("transport.")) {  // of light that bounces, and none does
      EXPECT_EQ(text_in(answer, "type"), "fault") << key;
      continue;
    }
    load::Settings set;
    for (const Json& small : *small_overrides.items()) set.emplace_back(text_in(small, "key"), text_in(small, "text"));
    set.emplace_back(key, text);
    std::string fault;
    try {
      const Scene scene = load::load_scene("demo", set);
      SimulatorOptions options;
      options.threads = 1;
      const Frame frame = Simulator(scene, load_camera(scene), options).frame(0);
      ASSERT_EQ(text_in(answer, "type"), "done") << key << "=" << text << ": " << text_in(answer, "text");
      const double generation = number_in(answer, "generation");
      const auto shown = one.page.frame_with([&](const WireFrame& is) { return is.generation == generation && !is.draft; });
      ASSERT_TRUE(shown) << key;
      EXPECT_TRUE(shown->arrays.at(raw) ==
                  std::string(reinterpret_cast<const char*>(frame.raw.raw.data()), frame.raw.raw.size() * sizeof(frame.raw.raw[0])))
          << key;
      EXPECT_TRUE(shown->arrays.at(z) == std::string(reinterpret_cast<const char*>(frame.depth.z_m.data()), frame.depth.z_m.size() * 4))
          << key;
      ++done;
    } catch (const Error& error) {
      fault = error.what();
      EXPECT_EQ(text_in(answer, "text"), fault.substr(0, fault.find('\n'))) << key << "=" << text;
      ++faults;
    }
  }
  EXPECT_GT(done, 250);
  EXPECT_GT(faults, 10);
}

TEST(saved, is_a_file_that_check_takes_and_that_renders_to_the_same_bytes) {
  NEEDS_THE_VIEWER;
  for (const char* scene : {"demo", "room", "bench-mesh", "sun-outdoors"}) {
    const Viewer viewer({scene});
    const Prepare here = in_folder(viewer.folder().path());
    Greeted one(viewer);
    for (const char* set :
         {R"("camera.lens.f_number","text":"1.8")", R"("camera.illumination.0.power","text":"0.3 W")",
          R"("camera.decoding.filter","text":"{kind: median}")", R"("transport.bounces","text":"1")",
          R"("materials.quoted","text":"{reflectivity: 0.5, brdf: \"lambert\"}")", R"("camera.pixel.patterns.prnu","text":"1 %")"})
      EXPECT_EQ(text_in(one.page.answer(std::string(R"({"type":"set","id":1,"key":)") + set + "}"), "type"), "done") << set;
    EXPECT_EQ(text_in(one.page.answer(R"({"type":"seed","id":2,"seed":12})"), "type"), "done");
    const Json state = Greeted(viewer).hello, saved = one.page.answer(R"({"type":"save","id":3})", "saved");
    ASSERT_EQ(text_in(saved, "type"), "saved") << text_in(saved, "text");
    EXPECT_EQ(text_in(saved, "name"), std::string(scene) + ".yaml");
    fs::create_directory(viewer.folder() / "s");
    std::ofstream(viewer.folder() / ("s/" + text_in(saved, "name"))) << text_in(saved, "text");
    const Result check = run({"check", "s/" + text_in(saved, "name")}, here);
    EXPECT_EQ(check.code, 0) << check.err;
    EXPECT_FALSE(has(check.err, "error")) << check.err;
    run_command(viewer, text_in(state, "command"), "by_command");
    run_command(viewer, "cd s && " + text_in(saved, "command"), "by_file");
    EXPECT_TRUE(content(viewer.folder() / "by_command/frame.npz") == content(viewer.folder() / "s/by_file/frame.npz")) << scene;
  }
}

TEST(sides, show_the_same_frame_and_equal_states_the_same_bytes) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  one.page.want("\"raw\"");
  ASSERT_EQ(text_in(one.page.answer(R"({"type":"other","id":1,"overrides":)" + list_with({}) + "}"), "type"), "done");
  // In play, and both sides' frames of a number after each other.
  std::map<std::uint64_t, std::string> of_a;
  std::optional<WireFrame> before;
  int pairs = 0;
  while (pairs < 20) {
    const auto frame = one.page.frame();
    ASSERT_TRUE(frame);
    one.page.acknowledge(*frame);
    if (frame->channel == 0) of_a[frame->frame] = frame->arrays.begin()->second;
    if (frame->channel == 1) {
      // The first one is of the frame that was there before side B.
      if (pairs > 0) {
        ASSERT_TRUE(before && before->channel == 0);
        EXPECT_EQ(before->frame, frame->frame);
        ASSERT_TRUE(of_a.contains(frame->frame));
        EXPECT_TRUE(of_a[frame->frame] == frame->arrays.begin()->second);
      }
      ++pairs;
    }
    before = frame;
  }
  EXPECT_GT(of_a.size(), 10u);
}

TEST(sides, that_are_opened_in_play_never_send_an_earlier_frame_behind_a_later_one) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  one.page.want("\"raw\"");
  std::uint64_t last = 0;
  int frames = 0;
  for (int i = 0; i < 60; ++i) {
    one.page.send(R"({"type":"other","id":1,"overrides":)" + list_with({}) + "}");
    for (bool done = false, shown = false; !shown;) {
      const WsMessage message = one.page.next();
      ASSERT_GE(message.opcode, 0);
      done = done || (message.opcode == 1 && text_in(message.json(), "type") == "done");
      if (message.opcode != 2) continue;
      const WireFrame frame = wire_frame(message.payload);
      one.page.acknowledge(frame);
      EXPECT_GE(frame.frame, last) << i;
      last = frame.frame, ++frames;
      shown = done && frame.channel == 1;
    }
  }
  EXPECT_GE(frames, 60);
}

TEST(sides, are_changed_apart_and_each_is_what_its_command_renders) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  one.page.answer(R"({"type":"pause"})", "state");
  one.page.want("\"raw\"");
  one.page.answer(R"({"type":"other","id":1,"seed":3,"overrides":)" + list_with({{"camera.lens.f_number", "2"}}) + "}");
  ASSERT_TRUE(one.page.frame_with([](const WireFrame& is) { return is.channel == 1; }));
  const Json done = one.page.answer(R"({"type":"set","id":2,"side":"b","key":"ambient.level","text":"2 %"})");
  const double generation = number_in(done, "generation");
  EXPECT_TRUE(one.page.frame_with([&](const WireFrame& is) { return is.channel == 1 && is.generation == generation; }));
  one.page.send(R"({"type":"seek","frame":2})");
  std::map<int, std::string> shown;
  while (shown.size() < 2) {
    const auto frame = one.page.frame();
    ASSERT_TRUE(frame);
    one.page.acknowledge(*frame);
    if (frame->frame == 2) shown[frame->channel] = frame->arrays.begin()->second;
  }
  const Json hello = Greeted(viewer).hello, &other = *hello.find("other");
  EXPECT_EQ(own_overrides(hello), "");
  EXPECT_EQ(own_overrides(other), "camera.lens.f_number=2 ambient.level=2 % ");
  EXPECT_EQ(number_in(other, "seed"), 3);
  run_command(viewer, text_in(hello, "command"), "a");
  run_command(viewer, text_in(other, "command"), "b");
  for (const int side : {0, 1})
    EXPECT_TRUE(shown[side] ==
                files::read_npz(viewer.folder() / (side == 0 ? "a/frame_0002.npz" : "b/frame_0002.npz"), {"raw"}).at(0).array.bytes);
  EXPECT_FALSE(shown[0] == shown[1]);
}

TEST(sides, that_are_sought_backward_give_the_earlier_bytes) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"flying-ball"});
  Greeted one(viewer);
  one.page.answer(R"({"type":"pause"})", "state");
  one.page.want("\"raw\",\"z_m\"");
  one.page.answer(R"({"type":"other","id":1,"overrides":)" + list_with({{"camera.lens.f_number", "2"}}) + "}");
  std::map<std::pair<int, std::uint64_t>, std::map<int, std::string>> seen;
  for (const std::uint64_t index : {1u, 5u, 3u, 1u, 3u, 5u}) {
    one.page.send(R"({"type":"seek","frame":)" + std::to_string(index) + "}");
    for (int side = 0; side < 2; ++side) {
      const auto frame = one.page.frame_with([&](const WireFrame& is) { return is.frame == index && is.channel == side; });
      ASSERT_TRUE(frame);
      const auto [found, is_new] = seen.try_emplace({side, index}, frame->arrays);
      EXPECT_TRUE(is_new || found->second == frame->arrays) << index;
    }
  }
  EXPECT_EQ(seen.size(), 6u);
  EXPECT_FALSE((seen[{0, 1}]) == (seen[{0, 5}]));
}

TEST(sides, are_not_computed_while_nobody_looks_nor_beyond_what_is_drawn_of_each) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  one.page.want("\"z_m\"");
  one.page.answer(R"({"type":"other","id":1,"overrides":)" + list_with({}) + "}");
  // Of side B nothing is drawn: after two frames of it, neither side goes on.
  std::uint32_t last_of_a = 0, first_of_b = 0, last_of_b = 0;
  int frames = 0;
  while (const auto frame = one.page.frame(milliseconds(400))) {
    ASSERT_LT(++frames, 50);
    if (frame->channel == 0) one.page.acknowledge(last_of_a = frame->sequence);
    if (frame->channel == 1) first_of_b = first_of_b == 0 ? frame->sequence : first_of_b, last_of_b = frame->sequence;
    ASSERT_LT(last_of_b - first_of_b, 3u);
  }
  EXPECT_EQ(last_of_b - first_of_b, 1u);
  one.page.send(R"({"type":"visible","visible":false})");
  one.page.acknowledge(last_of_b, 1);
  std::this_thread::sleep_for(milliseconds(500));
  one.page.send(R"({"type":"visible","visible":true})");
  const auto back = one.page.frame_with([](const WireFrame& is) { return is.channel == 1; });
  ASSERT_TRUE(back);
  EXPECT_LE(back->sequence, last_of_b + 3);
}

TEST(sides, open_with_built_in_scenes_and_cameras_and_no_files) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  std::ofstream(viewer.folder() / "mine.yaml") << "camera: {profile: pico-flexx}\nobjects: []\n";
  for (const char* name :
       {"mine", "mine.yaml", "./mine.yaml", "../room", "/etc/passwd", "romm", "-", "<demo>", "room/", "room\\u0000", "chair.obj"}) {
    const Json fault = one.page.answer(std::string(R"({"type":"other","id":1,"overrides":[],"scene":")") + name + "\"}");
    EXPECT_EQ(text_in(fault, "type"), "fault") << name;
    EXPECT_TRUE(has(text_in(fault, "text"), "no built-in scene or camera is called")) << text_in(fault, "text");
  }
  EXPECT_TRUE(Greeted(viewer).hello.find("other")->is_null());
  EXPECT_EQ(text_in(one.page.answer(R"({"type":"other","id":2,"overrides":[],"scene":"room"})"), "type"), "done");
  EXPECT_EQ(text_in(*Greeted(viewer).hello.find("other"), "scene"), "room");
  EXPECT_EQ(text_in(one.page.answer(R"({"type":"other","id":3,"overrides":[],"scene":"imx556"})"), "type"), "done");
  const Json hello = Greeted(viewer).hello, &other = *hello.find("other");
  EXPECT_EQ(text_in(other, "scene"), "demo");
  EXPECT_EQ(text_in(other, "camera"), "imx556");
  EXPECT_EQ(number_in(other, "width"), 640);
  EXPECT_EQ(text_in(one.page.answer(R"({"type":"other","id":4,"overrides":null})"), "type"), "done");
  EXPECT_TRUE(Greeted(viewer).hello.find("other")->is_null());
}

TEST(sides, that_are_not_open_are_told_and_an_opened_one_answers_for_itself) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  for (const char* message :
       {R"({"type":"set","id":1,"side":"b","key":"ambient.level","text":"1 %"})",
        R"({"type":"unset","id":1,"side":"b","key":"ambient.level"})", R"({"type":"seed","id":1,"side":"b","seed":1})",
        R"({"type":"state","id":1,"side":"b","overrides":[]})", R"({"type":"controls","id":1,"side":"b"})",
        R"({"type":"save","id":1,"side":"b"})", R"({"type":"pixel","id":1,"u":1,"v":1,"side":"b"})"}) {
    const Json fault = one.page.answer(message);
    EXPECT_EQ(text_in(fault, "type"), "fault") << message;
    EXPECT_EQ(number_in(fault, "id"), 1);
    EXPECT_TRUE(has(text_in(fault, "text"), "no side B")) << text_in(fault, "text");
  }
  one.page.answer(R"({"type":"pause"})", "state");
  one.page.answer(R"({"type":"other","id":1,"overrides":)" + list_with({{"camera.lens.f_number", "2"}}) + "}");
  const auto value_of = [&](const char* side) {
    const Json answer = one.page.answer(std::string(R"({"type":"pixel","id":2,"u":13,"v":10,"side":")") + side + "\"}", "pixel");
    EXPECT_EQ(text_in(answer, "side"), side);
    return files::json_text(*answer.find("report")->find("raw_frames"));
  };
  const std::string a = value_of("a"), b = value_of("b");
  EXPECT_NE(a, b);
  const Json frame = *one.page.answer(R"({"type":"seek","frame":0})", "state").find("frame");
  const Result said = run(with_small_sensor({"inspect", "demo", "--pixel", "13,10", "--json"}));
  one.page.answer(R"({"type":"state","id":3,"side":"b","overrides":)" + list_with({}) + "}");
  EXPECT_EQ(value_of("b"), files::json_text(*files::parse_json(said.out, "inspect").find("raw_frames")));
}

// What is long: a draft first, and what is no longer wanted is given up.
TEST(drafts, come_before_a_long_frame_and_the_frame_itself_is_that_of_render) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"room", "--bounces", "7", "--samples", "2048"});
  Greeted one(viewer);
  one.page.answer(R"({"type":"pause"})", "state");
  one.page.want("\"raw\"");
  const auto draft = one.page.frame(milliseconds(60'000));
  ASSERT_TRUE(draft);
  one.page.acknowledge(*draft);
  EXPECT_TRUE(draft->draft);
  const auto whole = one.page.frame(milliseconds(60'000));
  ASSERT_TRUE(whole);
  one.page.acknowledge(*whole);
  EXPECT_FALSE(whole->draft);
  EXPECT_EQ(whole->generation, draft->generation);
  EXPECT_EQ(whole->frame, draft->frame);
  EXPECT_EQ(whole->sequence, draft->sequence + 1);
  EXPECT_FALSE(whole->arrays == draft->arrays);
  run_command(viewer, text_in(Greeted(viewer).hello, "command"), "r");
  const fs::path file =
      whole->frame == 0 ? viewer.folder() / "r/frame.npz" : viewer.folder() / ("r/frame_000" + std::to_string(whole->frame) + ".npz");
  EXPECT_TRUE(whole->arrays.begin()->second == files::read_npz(file, {"raw"}).at(0).array.bytes);
}

TEST(drafts, of_changes_in_a_row_are_all_seen_and_the_long_frames_between_given_up) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"room", "--bounces", "8", "--samples", "2048"}, false);  // a frame takes a minute
  Greeted one(viewer);
  one.page.answer(R"({"type":"pause"})", "state");
  one.page.want("\"raw\"");
  int whole = 0;
  for (int i = 0; i < 8; ++i) {
    const Json done = one.page.answer(R"({"type":"set","id":1,"key":"camera.lens.f_number","text":")" + std::to_string(2 + i) + "\"}");
    ASSERT_EQ(text_in(done, "type"), "done");
    const double generation = number_in(done, "generation");
    const auto draft = one.page.frame_with([&](const WireFrame& is) {
      whole += is.draft ? 0 : 1;
      return is.generation == generation;
    });
    ASSERT_TRUE(draft);
    EXPECT_TRUE(draft->draft);
  }
  one.page.answer(R"({"type":"set","id":2,"key":"transport.bounces","text":"0"})");
  const auto last = one.page.frame_with([](const WireFrame& is) { return is.generation == 10; });
  ASSERT_TRUE(last);
  EXPECT_FALSE(last->draft);
  EXPECT_EQ(whole, 0);
}

}  // namespace
}  // namespace tofray::test
