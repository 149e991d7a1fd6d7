// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What leaves the viewer as files: recordings, pictures that restore their state.
#include <gtest/gtest.h>
#include <zlib.h>

#include "files/sha256.h"
#include "support/text.h"
#include "view/viewer.h"

namespace tofray::test {
namespace {

using files::Json;

const std::string& told_in(const Json& json, const char* name) {
  static const std::string none;
  const Json* found = json.find(name);
  return found != nullptr && found->is_string() ? *found->string() : none;
}

/// What answers an order in the end, past its progress.
Json end_of(Page& page, const std::string& json, const std::string& type, const char* last) {
  Json answer = page.answer(json, type);
  while (told_in(answer, "type") == type && answer.find(last) == nullptr) {
    EXPECT_LE(number_in(answer, "done"), number_in(answer, "frames"));
    const auto next = page.text(type, milliseconds(30'000));
    if (!next) return answer;
    answer = *next;
  }
  return answer;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> out;
  for (const auto& one : fs::directory_iterator(folder)) out.push_back(one.path().filename().native());
  std::sort(out.begin(), out.end());
  return out;
}

std::string shell_words(std::string command) {
  const std::string tool = "tofray ";
  return command.replace(0, tool.size(), std::string(TOFRAY_TOOL) + " ");
}

int run_shell(const fs::path& in, const std::string& command) {
  return std::system(("cd '" + in.native() + "' && " + shell_words(command) + " -q >/dev/null 2>&1").c_str());
}

// ---- recordings ----

TEST(recording, has_the_names_and_bytes_of_render) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"demo", "--seed", "3", "-o", "made/here"});
  Greeted one(viewer);
  ASSERT_EQ(told_in(one.page.answer(R"({"type":"set","id":1,"key":"camera.lens.f_number","text":"2.8"})"), "type"), "done");
  const std::pair<int, int> all[] = {{4, 1}, {4, 3}, {0, 1}};
  for (const auto& [first, frames] : all) {
    const std::string count = std::to_string(frames), number = std::to_string(first);
    const Json answer =
        end_of(one.page, R"({"type":"record","id":2,"first":)" + number + R"(,"frames":)" + count + "}", "record", "folder");
    ASSERT_EQ(told_in(answer, "type"), "record") << files::json_text(answer);
    EXPECT_EQ(number_in(answer, "done"), frames);
    const fs::path folder = told_in(answer, "folder");
    const fs::path by_command = viewer.folder() / ("by_command" + number + count);
    ASSERT_EQ(run_shell(viewer.folder().path(), told_in(answer, "command") + " -o " + by_command.native()), 0)
        << told_in(answer, "command");
    EXPECT_EQ(folder.parent_path(), viewer.folder() / "made/here");
    EXPECT_TRUE(files_of(folder) == files_of(by_command)) << files::json_text(answer);
    EXPECT_EQ(files_of(folder).count(frames == 3 ? "frame_0006.npz" : "preview_000" + number + ".png"), 1u);
    // What the answer lists is what lies there.
    std::map<std::string, std::string> told, there;
    for (const Json& file : *answer.find("files")->items()) {
      told[told_in(file, "name")] = told_in(file, "sha256");
      EXPECT_EQ(number_in(file, "bytes"), static_cast<double>(fs::file_size(folder / told_in(file, "name"))));
    }
    for (const std::string& name : names_in(folder)) there[name] = files::sha256_hex(content(folder / name));
    EXPECT_EQ(told, there);
  }
  EXPECT_EQ(names_in(viewer.folder() / "made/here"), (std::vector<std::string>{"recording_0001", "recording_0002", "recording_0003"}));
}

TEST(recording, is_of_the_side_that_is_named_and_leaves_time_alone) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"demo", "-o", "."});
  Greeted one(viewer);
  one.page.send(R"({"type":"pause"})");
  ASSERT_EQ(told_in(one.page.answer(
                        R"({"type":"other","id":1,"overrides":)" +
                        files::json_text(*one.hello.find("overrides")).insert(1, R"({"key":"camera.lens.f_number","text":"4"},)") + "}"),
                    "type"),
            "done");
  const Json a = end_of(one.page, R"({"type":"record","id":2,"first":0,"frames":1})", "record", "folder");
  const Json b = end_of(one.page, R"({"type":"record","id":3,"first":0,"frames":1,"side":"b"})", "record", "folder");
  EXPECT_TRUE(has(told_in(b, "command"), "f_number=4")) << told_in(b, "command");
  EXPECT_FALSE(has(told_in(a, "command"), "f_number=4"));
  EXPECT_NE(files_of(told_in(a, "folder"))["frame_0000.npz"], files_of(told_in(b, "folder"))["frame_0000.npz"]);
  EXPECT_EQ(number_in(Greeted(viewer).hello, "frame"), number_in(one.hello, "frame"));
}

TEST(recording, overwrites_nothing_that_is_there) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  fs::create_directory(viewer.folder() / "recording_0001");
  write(viewer.folder() / "recording_0001/mine", "mine");
  write(viewer.folder() / "recording_0002", "a file");
  fs::create_symlink("nowhere", viewer.folder() / "recording_0003");
  fs::create_directory(viewer.folder() / "recording_0004.part");
  Greeted one(viewer);
  const Json answer = end_of(one.page, R"({"type":"record","id":2,"first":0,"frames":2})", "record", "folder");
  EXPECT_EQ(told_in(answer, "folder"), (viewer.folder() / "recording_0005").native());
  EXPECT_EQ(names_in(viewer.folder() / "recording_0001"), std::vector<std::string>{"mine"});
  EXPECT_EQ(content(viewer.folder() / "recording_0002"), "a file");
}

TEST(recording, that_is_given_up_leaves_nothing) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"demo", "-o", "made"});
  {
    Greeted one(viewer);
    one.page.send(R"({"type":"record","id":2,"first":0,"frames":10000})");
    ASSERT_TRUE(one.page.text("record"));  // it is on its way
    EXPECT_EQ(names_in(viewer.folder() / "made"), std::vector<std::string>{"recording_0001.part"});
    Greeted two(viewer);
    const Json busy = two.page.answer(R"({"type":"record","id":1,"first":0,"frames":1})", "record");
    EXPECT_TRUE(has(told_in(busy, "text"), "another page's frames are being written")) << files::json_text(busy);
    one.page.send(R"({"type":"record_stop","id":3})");
    const auto stopped = one.page.text("fault");
    ASSERT_TRUE(stopped);
    EXPECT_EQ(number_in(*stopped, "id"), 2);
    EXPECT_TRUE(has(told_in(*stopped, "text"), "it was given up"));
    EXPECT_EQ(names_in(viewer.folder() / "made"), std::vector<std::string>{});
    // Another order comes in the place of the first one.
    one.page.send(R"({"type":"record","id":4,"first":0,"frames":10000})");
    ASSERT_TRUE(one.page.text("record"));
    one.page.send(R"({"type":"record","id":5,"first":0,"frames":1})");
    const auto first = one.page.text("fault");
    ASSERT_TRUE(first);
    EXPECT_EQ(number_in(*first, "id"), 4);
    ASSERT_TRUE(one.page.text("record"));
    EXPECT_EQ(names_in(viewer.folder() / "made"), std::vector<std::string>{"recording_0001"});
    one.page.send(R"({"type":"record","id":6,"first":0,"frames":10000})");
    ASSERT_TRUE(one.page.text("record"));
  }
  // A page that leaves takes its order with it.
  for (int i = 0; i < 1000 && names_in(viewer.folder() / "made").size() > 1; ++i) std::this_thread::sleep_for(milliseconds(10));
  EXPECT_EQ(names_in(viewer.folder() / "made"), std::vector<std::string>{"recording_0001"});
}

TEST(recording, under_way_goes_with_the_viewer) {
  NEEDS_THE_VIEWER;
  Viewer viewer({"demo", "-o", "made"});
  Greeted one(viewer);
  one.page.send(R"({"type":"record","id":2,"first":0,"frames":10000})");
  ASSERT_TRUE(one.page.text("record"));
  viewer.process().send(SIGINT);
  EXPECT_EQ(viewer.process().finish(), 0);
  EXPECT_EQ(names_in(viewer.folder() / "made"), std::vector<std::string>{});
}

TEST(recording, on_a_disk_that_fills_says_so_and_leaves_nothing) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"demo", "-o", "made"}, true, [] {
    const rlimit limit{50'000, 50'000};  // of a file; a write beyond it fails, as on a full disk
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
  });
  Greeted one(viewer);
  const Json answer = end_of(one.page, R"({"type":"record","id":2,"first":0,"frames":2})", "record", "folder");
  EXPECT_EQ(told_in(answer, "type"), "fault");
  EXPECT_TRUE(has(told_in(answer, "text"), "cannot write")) << files::json_text(answer);
  EXPECT_TRUE(has(told_in(answer, "text"), "File too large")) << files::json_text(answer);
  EXPECT_EQ(names_in(viewer.folder() / "made"), std::vector<std::string>{});
  // The view goes on.
  one.page.want("\"z_m\"");
  EXPECT_TRUE(one.page.frame());
}

TEST(recording, where_no_folder_can_be_made_says_the_way_out) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"demo", "-o", "taken/here"});
  write(viewer.folder() / "taken", "a file");
  Greeted one(viewer);
  const Json answer = end_of(one.page, R"({"type":"record","id":2,"first":0,"frames":2})", "record", "folder");
  EXPECT_TRUE(has(told_in(answer, "text"), "taken/here cannot be made: Not a directory")) << files::json_text(answer);
  EXPECT_TRUE(has(told_in(answer, "more"), "-o FOLDER")) << files::json_text(answer);
}

// ---- pictures ----

/// A PNG without its chunk of text, and that text.
std::pair<std::string, std::string> taken_apart(const std::string& png) {
  std::string rest = png.substr(0, 8), text;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) size = size << 8 | static_cast<unsigned char>(png[at + i]);
    const std::string chunk = png.substr(at + 4, 4 + size), whole = png.substr(at, 12 + size);
    std::uint32_t told = 0;
    for (std::size_t i = 0; i < 4; ++i) told = told << 8 | static_cast<unsigned char>(png[at + 8 + size + i]);
    EXPECT_EQ(told, crc32_z(0, reinterpret_cast<const unsigned char*>(chunk.data()), chunk.size()));
    if (chunk.starts_with("iTXt")) {
      EXPECT_EQ(chunk.substr(4, 11), std::string("tofray\0\0\0\0\0", 11));
      text = chunk.substr(15);
    } else {
      rest += whole;
    }
    at += 12 + size;
  }
  return {rest, text};
}

struct Picture {
  Json answer;
  std::string png;
};
Picture taken(Page& page) {
  Picture out{page.answer(R"({"type":"screenshot","id":77})", "screenshot"), {}};
  for (;;) {
    const WsMessage one = page.next();
    if (one.opcode < 0) return out;
    if (one.opcode != 2) continue;
    const WireFrame frame = wire_frame(one.payload);
    if (frame.channel < 2) {
      page.acknowledge(frame);
      continue;
    }
    EXPECT_EQ(frame.sequence, 77u);
    out.png = frame.arrays.at(0);
    return out;
  }
}

std::string restored(const std::string& text) {
  return files::json_text(Json::object().set("type", "restore").set("id", 9).set("text", text));
}

TEST(picture, is_the_preview_of_render_with_the_state_in_it) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"demo", "--seed", "3"});
  Greeted one(viewer);
  ASSERT_EQ(told_in(one.page.answer(R"({"type":"set","id":1,"key":"camera.lens.f_number","text":"2.8"})"), "type"), "done");
  one.page.send(R"({"type":"pause"})");
  one.page.send(R"({"type":"seek","frame":5})");
  one.page.want("\"z_m\"");
  ASSERT_TRUE(one.page.frame_with([](const WireFrame& each) { return each.frame == 5; }));
  const Picture picture = taken(one.page);
  ASSERT_EQ(told_in(picture.answer, "type"), "screenshot") << files::json_text(picture.answer);
  EXPECT_EQ(told_in(picture.answer, "name"), "demo_0005.png");
  const std::string command = told_in(Greeted(viewer).hello, "command");
  ASSERT_EQ(run_shell(viewer.folder().path(), command + " -o rendered"), 0) << command;
  const auto [rest, text] = taken_apart(picture.png);
  EXPECT_TRUE(rest == content(viewer.folder() / "rendered/preview_0005.png"));
  // Another viewer of the scene has all that it takes to show the frame.
  const Viewer other({"demo"}, false);
  Greeted two(other);
  const Json answer = two.page.answer(restored(text), "restore");
  ASSERT_EQ(told_in(answer, "type"), "restore") << files::json_text(answer);
  EXPECT_EQ(number_in(answer, "frame"), 5);
  EXPECT_EQ(number_in(answer, "seed"), 3);
  EXPECT_EQ(answer.find("note"), nullptr);
  const std::string state = files::json_text(
      Json::object().set("type", "state").set("id", 2).set("overrides", *answer.find("overrides")).set("seed", *answer.find("seed")));
  ASSERT_EQ(told_in(two.page.answer(state), "type"), "done");
  two.page.send(R"({"type":"pause"})");
  two.page.send(R"({"type":"seek","frame":5})");
  two.page.want("\"z_m\"");
  ASSERT_TRUE(two.page.frame_with([](const WireFrame& each) { return each.frame == 5; }));
  EXPECT_TRUE(taken(two.page).png == picture.png);
}

TEST(picture, of_another_scene_or_other_settings_says_which_command_opens_it) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"demo"});
  Greeted one(viewer);
  const std::string before = R"({"tofray":"1","scene":"room","scene_sha256":"","overrides":[{"key":"transport.bounces","text":"1"}],)"
                             R"("seed":7,"frame":3,"noise":"exact","exposure_samples":1,"subpixel":1})";
  const Json other = one.page.answer(restored(before), "restore");
  EXPECT_TRUE(has(told_in(other, "text"), R"(the picture is of the scene "room", and this viewer has "demo")")) << files::json_text(other);
  EXPECT_TRUE(has(told_in(other, "more"), "`tofray view room --seed 7 --set transport.bounces=1` opens it")) << files::json_text(other);
  std::string quiet = before;
  quiet.replace(quiet.find("room"), 4, "demo").replace(quiet.find("exact"), 5, "off");
  const Json settings = one.page.answer(restored(quiet), "restore");
  EXPECT_TRUE(has(told_in(settings, "more"), "`tofray view demo --seed 7 --noise off --set")) << files::json_text(settings);
}

TEST(picture, of_a_file_that_has_changed_since_says_so) {
  NEEDS_THE_VIEWER;
  const Folder folder;
  const std::string scene =
      "camera: {profile: pico-flexx}\nobjects: [{plane: {point: [0, 0, 1], normal: [0, 0, -1], reflectivity: 0.8}}]\n";
  write(folder / "my scene.yaml", scene);
  std::string text;
  for (const char* more : {"", "# changed\n"}) {
    write(folder / "my scene.yaml", scene + more);
    const Viewer viewer({(folder / "my scene.yaml").native()});
    Greeted one(viewer);
    one.page.want("\"z_m\"");
    ASSERT_TRUE(one.page.frame_with([](const WireFrame&) { return true; })) << viewer.err();
    if (text.empty()) {
      text = taken_apart(taken(one.page).png).second;
      EXPECT_FALSE(has(text, folder.path().native())) << "the place of a file is nobody's business";
    }
    const Json answer = one.page.answer(restored(text), "restore");
    ASSERT_EQ(told_in(answer, "type"), "restore") << files::json_text(answer);
    EXPECT_EQ(told_in(answer, "note"), *more == 0 ? "" : "my scene.yaml has changed since the picture was taken");
  }
}

TEST(picture, whose_text_is_a_stranger_s_does_no_harm) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"demo"});
  Greeted one(viewer);
  const std::string good =
      R"({"tofray":"1","scene":"demo","scene_sha256":"","overrides":[],"seed":7,"frame":3,"noise":"exact","exposure_samples":1,"subpixel":1})";
  ASSERT_EQ(told_in(one.page.answer(restored(good), "restore"), "type"), "restore");
  const auto with = [&](const std::string& what, const std::string& by) {
    return std::string(good).replace(good.find(what), what.size(), by);
  };
  for (const std::string& text :
       {std::string(), std::string("x"), std::string("[]"), std::string("null"), std::string("{}"), std::string(60'000, '['),
        good.substr(0, 40), with("\"demo\"", "3"), with("\"demo\"", "\"\""), with("[]", "[1]"), with("[]", R"([{"key":"a=b","text":"1"}])"),
        with("[]", R"([{"key":"","text":"1"}])"), with("[]", R"([{"key":"a"}])"), with("7", "-1"), with("7", "1e30"),
        with("3", "1000000001"), with("\"exact\"", "null"), with("1,\"sub", "-1,\"sub")}) {
    const Json answer = one.page.answer(restored(text), "restore");
    EXPECT_EQ(told_in(answer, "type"), "fault") << text.substr(0, 200);
    EXPECT_FALSE(told_in(answer, "text").empty());
  }
  // A scene's name is shown as text, whatever it is.
  const Json odd = one.page.answer(restored(with("demo", "../../etc/passwd\\u001b[31m$(touch x)")), "restore");
  EXPECT_TRUE(has(told_in(odd, "more"), "`tofray view '../../etc/passwd\\x1b[31m$(touch x)' --seed 7` opens it")) << files::json_text(odd);
  EXPECT_EQ(names_in(viewer.folder().path()), (std::vector<std::string>{"err", "out"}));
}

// ---- a page in a file ----

std::string from_base64(const std::string& digits) {
  const std::string all = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : digits) {
    const std::size_t digit = all.find(c);
    if (digit == std::string::npos) break;
    bits = bits << 6 | static_cast<std::uint32_t>(digit), count += 6;
    if (count >= 8) count -= 8, out += static_cast<char>(bits >> count & 255U);
  }
  return out;
}

std::string inflated(const std::string& packed) {
  std::string out(100'000'000, '\0');
  uLongf size = out.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()), Z_OK);
  out.resize(size);
  return out;
}

/// What stands in elements that begin so.
std::vector<std::string> within(const std::string& page, const std::string& begin) {
  std::vector<std::string> out;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    out.push_back(page.substr(at, page.find("</script>", at) - at));
  }
  return out;
}

struct Exported {
  explicit Exported(const std::string& page) {
    const auto texts = within(page, R"(<script type="application/json" id="tofray-export">)");
    EXPECT_EQ(texts.size(), 1u);
    if (!texts.empty()) json = files::parse_json(texts[0], "page");
    for (const std::string& one : within(page, R"(<script type="application/octet-stream" class="tofray-frame">)"))
      frames.push_back(wire_frame(inflated(from_base64(one))));
    for (const std::string& one : within(page, R"(<script type="application/octet-stream" id="tofray-static">)"))
      statics.push_back(wire_frame(inflated(from_base64(one))));
  }
  [[nodiscard]] const Json& hello() const { return *json.find("hello"); }
  Json json;
  std::vector<WireFrame> frames, statics;
};

#define NEEDS_THE_PAGE                                                                                               \
  NEEDS_THE_VIEWER;                                                                                                  \
  if (run({"view", "demo", "--export", "/nowhere/x.html", "-q"}).err.find("npm was not there") != std::string::npos) \
  GTEST_SKIP() << "built without npm"

TEST(page_in_a_file, has_the_arrays_of_render) {
  NEEDS_THE_PAGE;
  const Folder folder;
  const Arguments state = with_small_sensor({"demo", "--seed", "3", "--set", "camera.lens.f_number=2.8"});
  const auto with = [&](Arguments words, const Arguments& more) {
    words.insert(words.end(), state.begin(), state.end());
    words.insert(words.end(), more.begin(), more.end());
    return run(words, in_folder(folder.path()));
  };
  const Result made = with({"view"}, {"--export", "a.html", "--first-frame", "4", "--frames", "2"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(has(made.err, "a.html: 2 frames in a page of ")) << made.err;
  ASSERT_EQ(with({"render"}, {"-o", "out", "--first-frame", "4", "--frames", "2", "-q"}).code, 0);
  const Exported page(content(folder / "a.html"));
  ASSERT_EQ(page.frames.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(page.frames[i].frame, 4 + i);
    const auto arrays = files::read_npz(folder / ("out/frame_000" + std::to_string(4 + i) + ".npz"));
    int compared = 0;
    for (const auto& [name, array] : arrays) {
      const int number = number_of(page.hello(), name);
      if (number < 0 || !page.frames[i].arrays.contains(number)) continue;
      EXPECT_TRUE(page.frames[i].arrays.at(number) == std::string(array.bytes.begin(), array.bytes.end())) << name;
      ++compared;
    }
    EXPECT_GT(compared, 10);
    for (const char* name : {"z_m", "raw", "flags", "z_error_m", "lit"})
      EXPECT_TRUE(page.frames[i].arrays.contains(number_of(page.hello(), name))) << name;
  }
  // All that the page asks a server for at first.
  EXPECT_EQ(page.json.find("frames")->items()->size(), 2u);
  EXPECT_EQ(number_in(page.hello(), "frame"), 4);
  EXPECT_EQ(page.json.find("scales")->items()->size(), 2u);
  EXPECT_EQ(page.json.find("view3d")->items()->size(), 2u);
  EXPECT_EQ(page.statics.size(), 1u);
  EXPECT_EQ(told_in(*page.json.find("controls"), "type"), "controls");
  EXPECT_EQ(told_in(*page.json.find("saved"), "type"), "saved");
  EXPECT_TRUE(told_in(page.json, "live").starts_with("tofray view demo --seed 3 --set camera.lens.f_number=2.8"));
}

TEST(page_in_a_file, asks_nobody_for_anything) {
  NEEDS_THE_PAGE;
  const Folder folder;
  ASSERT_EQ(run(with_small_sensor({"view", "demo", "--export", "a.html"}), in_folder(folder.path())).code, 0);
  const std::string page = content(folder / "a.html");
  const std::string head = page.substr(0, page.find("</head>"));
  EXPECT_TRUE(has(head, "default-src 'none'")) << head.substr(0, 500);
  EXPECT_TRUE(has(head, "script-src 'sha256-")) << head.substr(0, 500);
  EXPECT_FALSE(has(head, "unsafe-inline"));
  EXPECT_FALSE(has(head, "connect-src"));
  for (const char* one : {" src=\"", "href=\"http", "href=\"//", "@import"}) EXPECT_FALSE(has(head, one)) << one;
  EXPECT_FALSE(has(page, "<!--tofray-data-->"));
}

TEST(page_in_a_file, holds_a_scene_s_words_as_words) {
  NEEDS_THE_PAGE;
  const Folder folder;
  const std::string name = "</script><img src=x onerror=alert(1)><!--";
  write(folder / "s.yaml", "camera: {profile: pico-flexx}\nobjects: [{plane: {name: \"" + name +
                               "\", point: [0, 0, 1], normal: [0, 0, -1], reflectivity: 0.8}}]\n");
  const Result made = run(with_small_sensor({"view", "s.yaml", "--export", "a.html"}), in_folder(folder.path()));
  ASSERT_EQ(made.code, 0) << made.err;
  const std::string page = content(folder / "a.html");
  EXPECT_FALSE(has(page, "<img src=x"));
  const Exported read(page);
  const Json& objects = *(*read.json.find("view3d")->items())[0].find("objects");
  EXPECT_EQ(told_in((*objects.items())[0], "name"), name);
}

TEST(page_in_a_file, that_a_page_orders_is_that_of_the_command) {
  NEEDS_THE_PAGE;
  const Viewer viewer({"demo", "-o", "made"});
  Greeted one(viewer);
  ASSERT_EQ(told_in(one.page.answer(R"({"type":"set","id":1,"key":"camera.lens.f_number","text":"2.8"})"), "type"), "done");
  const Json answer = end_of(one.page, R"({"type":"export","id":2,"first":1,"frames":3})", "export", "file");
  ASSERT_EQ(told_in(answer, "type"), "export") << files::json_text(answer);
  EXPECT_EQ(told_in(answer, "file"), (viewer.folder() / "made/view_0001.html").native());
  const std::string page = content(told_in(answer, "file"));
  EXPECT_EQ(number_in(answer, "bytes"), static_cast<double>(page.size()));
  EXPECT_EQ(told_in(answer, "sha256"), files::sha256_hex(page));
  ASSERT_EQ(run_shell(viewer.folder().path(), told_in(answer, "command")), 0) << told_in(answer, "command");
  EXPECT_TRUE(content(viewer.folder() / "view_0001.html") == page);
  EXPECT_EQ(names_in(viewer.folder() / "made"), std::vector<std::string>{"view_0001.html"});
}

TEST(page_in_a_file, too_large_for_browsers_is_refused_with_what_would_fit) {
  NEEDS_THE_PAGE;
  const Folder folder;
  const Result large = run({"view", "demo", "--export", "a.html", "--frames", "10000"}, in_folder(folder.path()));
  EXPECT_EQ(large.code, 4) << large.err;
  EXPECT_TRUE(has(large.err, "browsers open 200 MB well")) << large.err;
  EXPECT_TRUE(has(large.err, "expected --frames ")) << large.err;
  EXPECT_FALSE(fs::exists(folder / "a.html"));
  const Result few = run({"view", "demo", "--export", "a.html", "--frames", "2", "--arrays", "z_m", "--json"}, in_folder(folder.path()));
  ASSERT_EQ(few.code, 0) << few.err;
  const Exported page(content(folder / "a.html"));
  ASSERT_EQ(page.frames.size(), 2u);
  EXPECT_FALSE(page.frames[0].arrays.contains(number_of(page.hello(), "raw")));
  EXPECT_TRUE(page.frames[0].arrays.contains(number_of(page.hello(), "flags")));
  const Json said = files::parse_json(few.out, "stdout");
  EXPECT_EQ(told_in(said, "sha256"), files::sha256_hex(content(folder / "a.html")));
}

TEST(page_in_a_file, alone_has_frames_and_arrays_to_choose) {
  NEEDS_THE_VIEWER;
  const Result live = run({"view", "demo", "--frames", "3", "--test-hooks"});
  EXPECT_EQ(live.code, 2) << live.err;
  EXPECT_TRUE(has(live.err, "are of --export")) << live.err;
  EXPECT_EQ(run({"view", "demo", "--export", "a.png"}).code, 2);
}

}  // namespace
}  // namespace tofray::test
