// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What pages get, when, and that it is what `tofray render` makes.
#include <set>

#include "files/npz.h"
#include "view/viewer.h"

namespace tofray::test {
namespace {

TEST(stream, has_the_arrays_of_render_bit_by_bit_of_any_frame) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"demo", "--seed", "5"});
  const Prepare here = in_folder(viewer.folder().path());
  ASSERT_EQ(run(with_small_sensor({"render", "demo", "--seed", "5", "-o", "r", "--frames", "4", "--emit", "npz"}), here).code, 0);
  Greeted one(viewer);
  one.page.send(R"({"type":"pause"})");
  one.page.text("state");
  std::string all;
  for (const files::Json& array : *one.hello.find("arrays")->items())
    all += (all.empty() ? "\"" : ",\"") + *array.find("name")->string() + "\"";
  one.page.want(all);
  std::set<std::uint32_t> sequences;
  for (const int index : {0, 3, 1, 0}) {
    one.page.send(R"({"type":"seek","frame":)" + std::to_string(index) + "}");
    std::optional<WireFrame> frame;
    do {
      frame = one.page.frame();
      ASSERT_TRUE(frame);
      one.page.acknowledge(frame->sequence);
    } while (frame->frame != static_cast<std::uint64_t>(index));
    EXPECT_TRUE(sequences.insert(frame->sequence).second);
    std::size_t compared = 0;
    for (const files::NamedArray& array : files::read_npz(viewer.folder() / ("r/frame_000" + std::to_string(index) + ".npz"))) {
      const int number = number_of(one.hello, array.name);
      if (number < 0) continue;
      ASSERT_TRUE(frame->arrays.count(number)) << array.name;
      EXPECT_TRUE(frame->arrays.at(number) == array.array.bytes) << array.name << " of frame " << index;
      ++compared;
    }
    EXPECT_GT(compared, 30u);
  }
}

TEST(stream, pixel_is_what_inspect_says) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"room", "--seed", "2", "--bounces", "2", "--samples", "4"});
  const Prepare here = in_folder(viewer.folder().path());
  ASSERT_EQ(
      run(with_small_sensor({"render", "room", "--seed", "2", "--bounces", "2", "--samples", "4", "-o", "r", "--emit", "npz"}), here).code,
      0);
  Greeted one(viewer);
  one.page.send(R"({"type":"pause"})");
  one.page.text("state");
  int id = 0;
  for (const auto& [u, v] : {std::pair{0, 0}, {27, 0}, {0, 21}, {27, 21}, {13, 10}, {5, 17}}) {
    one.page.send(R"({"type":"pixel","id":)" + std::to_string(++id) + R"(,"u":)" + std::to_string(u) + R"(,"v":)" + std::to_string(v) +
                  "}");
    const auto answer = one.page.text("pixel");
    ASSERT_TRUE(answer);
    EXPECT_EQ(number_in(*answer, "id"), id);
    const Result said = run({"inspect", "r/frame.npz", "--pixel", std::to_string(u) + "," + std::to_string(v), "--json"}, here);
    const files::Json expected = files::parse_json(said.out, "inspect");
    // All but the name of what was looked at.
    for (const auto& [key, value] : *expected.members()) {
      if (key == "file") continue;
      ASSERT_NE(answer->find("report")->find(key), nullptr) << key;
      EXPECT_EQ(files::json_text(*answer->find("report")->find(key)), files::json_text(value)) << key;
    }
    EXPECT_EQ(answer->find("report")->members()->size(), expected.members()->size());
    for (const files::Json& value : *answer->find("values")->items())
      if (*value.find("name")->string() == "z_m") {
        EXPECT_EQ(files::json_text(*value.find("value")), files::json_text(*expected.find("depth")->find("z_m")));
      }
    EXPECT_EQ(answer->find("why")->string()->empty(), !expected.find("depth")->find("z_m")->is_null());
  }
  one.page.send(R"({"type":"pixel","id":99,"u":28,"v":0})");
  const auto fault = one.page.text("fault");
  ASSERT_TRUE(fault);
  EXPECT_EQ(number_in(*fault, "id"), 99);
}

TEST(stream, pixel_after_a_change_is_of_the_new_state) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  one.page.want("\"z_m\"");
  one.page.send(R"({"type":"pause"})");
  one.page.text("state");
  one.page.send(R"({"type":"seek","frame":0})");
  one.page.text("state");
  one.page.send(R"({"type":"pixel","id":1,"u":13,"v":10})");
  ASSERT_TRUE(one.page.text("pixel"));
  one.page.send(R"({"type":"set","id":2,"key":"camera.lens.f_number","text":"1.8"})");
  ASSERT_TRUE(one.page.text("state"));
  one.page.send(R"({"type":"pixel","id":3,"u":13,"v":10})");
  const auto answer = one.page.text("pixel");
  ASSERT_TRUE(answer);
  const Result said = run(with_small_sensor({"inspect", "demo", "--set", "camera.lens.f_number=1.8", "--pixel", "13,10", "--json"}));
  EXPECT_EQ(files::json_text(*answer->find("report")->find("raw_frames")),
            files::json_text(*files::parse_json(said.out, "inspect").find("raw_frames")));
}

TEST(stream, sends_no_third_frame_before_one_was_drawn_and_then_the_newest) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted slow(viewer);
  slow.page.want("\"z_m\"");
  const auto first = slow.page.frame(), second = slow.page.frame();
  ASSERT_TRUE(first && second);
  EXPECT_FALSE(slow.page.frame(milliseconds(300)));
  Greeted fast(viewer);
  fast.page.want("\"z_m\"");
  std::uint32_t last = 0;
  for (int i = 0; i < 50; ++i) {
    const auto frame = fast.page.frame();
    ASSERT_TRUE(frame);
    fast.page.acknowledge(last = frame->sequence);
  }
  EXPECT_FALSE(slow.page.frame(milliseconds(100)));
  fast.page.send(R"({"type":"visible","visible":false})");
  std::this_thread::sleep_for(milliseconds(200));
  slow.page.acknowledge(first->sequence);
  const auto third = slow.page.frame();
  ASSERT_TRUE(third);
  EXPECT_GE(third->sequence, last);
}

TEST(stream, computes_nothing_while_nobody_looks) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  one.page.want("\"z_m\"");
  for (int i = 0; i < 10; ++i) {
    const auto frame = one.page.frame();
    ASSERT_TRUE(frame);
    one.page.acknowledge(frame->sequence);
  }
  one.page.send(R"({"type":"visible","visible":false})");
  std::uint32_t last = 0;
  int more = 0;
  while (const auto frame = one.page.frame(milliseconds(300))) {
    ASSERT_LT(++more, 50);
    one.page.acknowledge(last = frame->sequence);
  }
  std::this_thread::sleep_for(milliseconds(500));
  one.page.send(R"({"type":"visible","visible":true})");
  const auto back = one.page.frame();
  ASSERT_TRUE(back);
  // Sequences count frames that were computed: one may have been under way when the tab was hidden.
  EXPECT_LE(back->sequence, last + 2);
}

TEST(stream, of_pages_at_the_cameras_own_rate_is_no_faster) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted own(viewer), most(viewer);
  own.page.want("\"z_m\"", "\"own\"");
  most.page.want("\"z_m\",\"flags\"");
  const Clock::time_point begin = Clock::now();
  int frames_of_most = 0;
  while (Clock::now() - begin < milliseconds(2000)) {
    const auto frame = most.page.frame();
    ASSERT_TRUE(frame);
    most.page.acknowledge(frame->sequence);
    ++frames_of_most;
  }
  int frames_of_own = 0;
  while (const auto frame = own.page.frame(milliseconds(50))) {
    own.page.acknowledge(frame->sequence);
    if (++frames_of_own > 100) break;
  }
  EXPECT_GT(frames_of_most, 100);
  EXPECT_LE(frames_of_own, 14);  // 5 a second, two of them waiting
  EXPECT_GE(frames_of_own, 2);
}

TEST(state, is_changed_by_set_and_told_to_all_pages) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  const Prepare here = in_folder(viewer.folder().path());
  Greeted one(viewer), other(viewer);
  for (Page* page : {&one.page, &other.page}) page->want("\"raw\",\"z_m\"");
  one.page.send(R"({"type":"set","id":1,"key":"camera.lens.f_number","text":"1.8"})");
  for (Page* page : {&one.page, &other.page}) {
    const auto state = page->text("state");
    ASSERT_TRUE(state);
    EXPECT_EQ(number_in(*state, "generation"), 2);
    EXPECT_TRUE(has(*state->find("command")->string(), "--set camera.lens.f_number=1.8"));
  }
  one.page.send(R"({"type":"seed","id":2,"seed":77})");
  ASSERT_TRUE(one.page.text("state"));
  one.page.send(R"({"type":"pause"})");
  ASSERT_TRUE(one.page.text("state"));
  one.page.send(R"({"type":"seek","frame":900})");
  const auto state = one.page.text("state");
  ASSERT_TRUE(state);
  const std::string command = *state->find("command")->string();
  EXPECT_TRUE(has(command, "--seed 77") && has(command, "--first-frame 900")) << command;
  std::optional<WireFrame> frame;
  do {
    frame = one.page.frame();
    ASSERT_TRUE(frame);
    one.page.acknowledge(frame->sequence);
  } while (frame->frame != 900 || frame->generation != 3);
  // What a shell makes of the copied command has the same bytes.
  const std::string folder = viewer.folder().path().native();
  ASSERT_EQ(std::system(
                ("cd " + folder + " && PATH=" + fs::path(TOFRAY_TOOL).parent_path().native() + ":$PATH " + command + " -o c --emit npz -q")
                    .c_str()),
            0)
      << command;
  const auto arrays = files::read_npz(viewer.folder() / "c/frame_0900.npz", {"raw"});
  EXPECT_TRUE(frame->arrays.at(number_of(one.hello, "raw")) == arrays.at(0).array.bytes);
}

TEST(state, stays_where_a_set_is_wrong_and_says_it_in_the_command_lines_words) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  one.page.send(R"({"type":"set","id":9,"key":"camera.lens.f_nmber","text":"1.8"})");
  auto fault = one.page.text("fault");
  ASSERT_TRUE(fault);
  EXPECT_EQ(number_in(*fault, "id"), 9);
  const Result said = run({"render", "demo", "--set", "camera.lens.f_nmber=1.8"}, in_folder(viewer.folder().path()));
  EXPECT_TRUE(said.err.starts_with(*fault->find("text")->string() + "\n")) << said.err << *fault->find("text")->string();
  // Good by itself, and it does not go with the rest.
  for (const char* wrong : {R"({"type":"set","id":10,"key":"camera.sensor.width","text":"99999"})",
                            R"({"type":"set","id":11,"key":"camera.lens.f_number","text":"banana"})",
                            R"({"type":"set","id":12,"key":"objects.99.sphere.radius","text":"1 m"})",
                            R"({"type":"set","id":13,"key":"camera.profile","text":"/etc/passwd"})"}) {
    one.page.send(wrong);
    EXPECT_TRUE(one.page.text("fault")) << wrong;
  }
  one.page.want("\"z_m\"");
  const auto frame = one.page.frame();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->generation, 1u);
}

TEST(state, forgets_a_key_by_unset_and_its_frames_are_the_first_ones_again) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  one.page.send(R"({"type":"pause"})");
  one.page.text("state");
  one.page.want("\"raw\"");
  const auto before = one.page.frame();
  ASSERT_TRUE(before);
  one.page.acknowledge(before->sequence);
  one.page.send(R"({"type":"set","id":1,"key":"camera.lens.f_number","text":"1.8"})");
  const auto changed = one.page.frame();
  ASSERT_TRUE(changed);
  one.page.acknowledge(changed->sequence);
  one.page.send(R"({"type":"unset","id":2,"key":"camera.lens.f_number"})");
  const auto after = one.page.frame();
  ASSERT_TRUE(after);
  EXPECT_EQ(before->generation, 1u);
  EXPECT_EQ(changed->generation, 2u);
  EXPECT_EQ(after->generation, 3u);
  EXPECT_TRUE(before->arrays == after->arrays);
  EXPECT_FALSE(before->arrays == changed->arrays);
}

TEST(state, of_a_hundred_quick_changes_ends_with_the_last) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  one.page.want("\"z_m\"");
  for (int i = 0; i < 100; ++i)
    one.page.send(R"({"type":"set","id":)" + std::to_string(i) + R"(,"key":"camera.lens.f_number","text":")" +
                  std::to_string(1 + 0.01 * (i + 1)) + "\"}");
  std::uint32_t generation = 0, newest = 0;
  bool last = false;
  const Clock::time_point end = Clock::now() + std::chrono::seconds(20);
  while (Clock::now() < end && !(last && generation == newest)) {
    const WsMessage message = one.page.next();
    ASSERT_GE(message.opcode, 0);
    if (message.opcode == 2) {
      const WireFrame frame = wire_frame(message.payload);
      EXPECT_GE(frame.generation, generation);
      generation = frame.generation;
      one.page.acknowledge(frame.sequence);
    } else if (message.opcode == 1 && *message.json().find("type")->string() == "state") {
      newest = static_cast<std::uint32_t>(number_in(message.json(), "generation"));
      last = last || has(message.payload, "f_number=2.000000");
    }
  }
  EXPECT_TRUE(last);
  EXPECT_EQ(generation, newest);
}

TEST(state, has_colours_locked_until_a_fit_is_asked_for) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  one.page.send(R"({"type":"set","id":1,"key":"objects.0.plane.point","text":"[0, 0, 5]"})");
  one.page.want("\"z_m\"");
  while (const auto frame = one.page.frame()) {
    one.page.acknowledge(frame->sequence);
    if (frame->generation == 2) break;
  }
  Greeted late(viewer);
  const auto depth_of = [](const files::Json& hello) { return files::json_text(*(*hello.find("panes")->items())[0].find("scale")); };
  EXPECT_EQ(depth_of(late.hello), depth_of(one.hello));
  one.page.send(R"({"type":"fit","array":"z_m"})");
  const auto scale = one.page.text("scale");
  ASSERT_TRUE(scale);
  EXPECT_EQ(*scale->find("array")->string(), "z_m");
  one.page.send(R"({"type":"fit","array":"gt_object_id"})");
  EXPECT_TRUE(one.page.text("fault"));
}

// 240 who hinder, as many at once as are let in: heads byte by byte, pages that never read, that draw two seconds late, that are hidden.
// Whoever was there first keeps its frames.
TEST(load, of_240_slow_connections_leaves_a_good_page_its_frames) {
  NEEDS_THE_VIEWER;
  Viewer viewer({"demo"}, false);
  Greeted good(viewer);
  good.page.want("\"z_m\",\"flags\"", "60");
  const auto frames_in = [&](milliseconds time, const std::function<void()>& meanwhile) {
    int frames = 0;
    for (const Clock::time_point end = Clock::now() + time; Clock::now() < end;) {
      const auto frame = good.page.frame(milliseconds(1000));
      if (!frame) break;
      good.page.acknowledge(frame->sequence);
      ++frames;
      meanwhile();
    }
    return frames;
  };
  const milliseconds round(1500);
  // How many frames it gets alone, and then among the others.
  const auto alone_and_among = [&](const char* kind) {
    const int alone = frames_in(round, [] {});
    std::vector<Line> lines;
    std::vector<std::unique_ptr<Greeted>> pages;
    for (int i = 0; i < 60; ++i) {
      if (kind == std::string("bytes")) {
        lines.emplace_back(viewer.port);
        EXPECT_TRUE(lines.back().send("G"));
      } else {
        pages.push_back(std::make_unique<Greeted>(viewer));  // which sees to it that it was let in
        if (kind == std::string("hidden")) pages.back()->page.send(R"({"type":"visible","visible":false})");
        pages.back()->page.want(kind == std::string("unread") ? R"("z_m","raw")" : R"("z_m","flags")");
      }
    }
    std::size_t sent = 1;
    const std::string head = "ET / HTTP/1.1\r\n";
    Clock::time_point next = Clock::now() + milliseconds(500);
    const int among = frames_in(round, [&] {
      if (Clock::now() < next) return;
      next += milliseconds(500);
      for (const Line& line : lines) line.send(head.substr(sent - 1, 1));
      ++sent;
      if (kind != std::string("late")) return;
      for (const auto& page : pages)
        if (const auto frame = page->page.frame(milliseconds(1))) page->page.acknowledge(frame->sequence);
    });
    for (const Line& line : lines) EXPECT_TRUE(line.open());
    lines.clear(), pages.clear();
    // Those that left make room for the next.
    for (int tries = 0; tries < 100 && status_of(asked(viewer.port, "GET / HTTP/1.1\r\nHost: " + viewer.host() + "\r\n\r\n")) == 503;
         ++tries)
      std::this_thread::sleep_for(milliseconds(20));
    std::this_thread::sleep_for(milliseconds(200));
    return std::pair(alone, among);
  };
  for (const char* kind : {"bytes", "unread", "late", "hidden"}) {
    std::pair<int, int> got;
    for (int tries = 0; tries < 4; ++tries) {  // the machine does other work, too, and not always as much of it
      got = alone_and_among(kind);
      if (got.first > 0 && got.second >= got.first * 9 / 10) break;
    }
    EXPECT_GT(got.first, 0);
    EXPECT_GE(got.second, got.first * 9 / 10) << kind;
  }
  std::istringstream status(
      content("/proc/" + std::to_string(static_cast<int>(number_in(files::parse_json(viewer.out(), "stdout"), "pid"))) + "/status"));
  std::string line;
  while (std::getline(status, line))
    if (line.starts_with("VmRSS:")) {
      EXPECT_LT(std::atol(line.c_str() + 6), 300'000) << line;
    }
}

}  // namespace
}  // namespace tofray::test
