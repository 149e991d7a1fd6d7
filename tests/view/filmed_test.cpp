// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Films (MCAP files), played by the viewer: their raw frames are decoded as they come.
#include <gtest/gtest.h>

#include "support/text.h"
#include "view/viewer.h"

namespace tofray::test {
namespace {

using files::Json;

std::string said_in(const Json& json, const char* name) {
  const Json* found = json.find(name);
  return found != nullptr && found->is_string() ? *found->string() : std::string();
}

/// A frame, at which time stands still.
WireFrame played(Greeted& one, std::uint64_t frame, const std::string& arrays, std::uint32_t generation = 1) {
  one.page.send(R"({"type":"pause"})");
  one.page.send(R"({"type":"seek","frame":)" + std::to_string(frame) + "}");
  one.page.want(arrays);
  return one.page.frame_with([&](const WireFrame& each) { return each.frame == frame && each.generation == generation; })
      .value_or(WireFrame());
}

/// What `tofray render` writes as a film, and the same frames as files.
struct Filmed {
  explicit Filmed(const Arguments& more = {}, bool small = true) {
    Arguments words = {"render", "demo", "-o", "out", "--frames", "4", "--first-frame", "6", "-q", "--emit", "npz,mcap"};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = run(small ? with_small_sensor(words) : words, in_folder(folder.path()));
    EXPECT_EQ(result.code, 0) << result.err;
    file = (folder / "out/run_0006.mcap").native();
  }
  [[nodiscard]] std::string bytes(std::uint64_t frame, const char* array, const std::string& in = "out") const {
    return files::read_npz(folder / (in + "/frame_000" + std::to_string(6 + frame) + ".npz"), {array}).at(0).array.bytes;
  }
  Folder folder;
  std::string file;
};

// Many small frames in a chunk, and frames each in several chunks; packed and not.
TEST(recorded, films_are_played_frame_by_frame_in_any_order) {
  NEEDS_THE_VIEWER;
  for (const bool small : {true, false}) {
    const Filmed filmed(small ? Arguments{} : Arguments{"--mcap-compression", "none"}, small);
    ASSERT_EQ(run({"process", filmed.file, "-q", "-o", "made"}, in_folder(filmed.folder.path())).code, 0);
    const Viewer viewer({filmed.file}, false);
    Greeted one(viewer);
    EXPECT_EQ(number_in(one.hello, "frames"), 4);
    EXPECT_EQ(*one.hello.find("source")->find("raw")->boolean(), true);
    EXPECT_EQ(number_in(one.hello, "width"), small ? 28 : 224);
    EXPECT_GT(number_in(one.hello, "frame_rate_hz"), 0);
    for (const std::uint64_t i : {3u, 0u, 2u, 1u}) {
      const WireFrame frame = played(one, i, R"("z_m","raw","flags")");
      EXPECT_TRUE(frame.arrays.at(number_of(one.hello, "raw")) == filmed.bytes(i, "raw")) << i;
      for (const char* name : {"z_m", "flags"})  // of codes, as a film has them
        EXPECT_TRUE(frame.arrays.at(number_of(one.hello, name)) == filmed.bytes(i, name, "made")) << name << " " << i;
    }
  }
}

TEST(recorded, films_are_decoded_by_keys_and_by_the_command_that_is_shown) {
  NEEDS_THE_VIEWER;
  const Filmed filmed;
  const Viewer viewer({filmed.file}, false);
  Greeted one(viewer);
  const Json done = one.page.answer(R"({"type":"set","id":2,"key":"camera.decoding.filter","text":"{kind: median}"})");
  ASSERT_EQ(said_in(done, "type"), "done") << files::json_text(done);
  const WireFrame frame = played(one, 2, "\"z_m\"", 2);
  const std::string command = said_in(Greeted(viewer).hello, "command");
  const std::string line =
      "cd '" + viewer.folder().path().native() + "' && " + std::string(TOFRAY_TOOL) + command.substr(6) + " -q -o made";
  ASSERT_EQ(std::system(line.c_str()), 0) << line;
  const std::string made = files::read_npz(viewer.folder() / "made/frame_0008.npz", {"z_m"}).at(0).array.bytes;
  EXPECT_TRUE(frame.arrays.at(number_of(one.hello, "z_m")) == made);
  EXPECT_FALSE(made == filmed.bytes(2, "z_m"));
  const Json answer = one.page.answer(R"({"type":"pixel","id":1,"u":13,"v":10})", "pixel");
  ASSERT_EQ(said_in(answer, "type"), "pixel") << files::json_text(answer);
  EXPECT_GT(answer.find("flow")->items()->size(), 5u);
}

TEST(recorded, films_that_were_cut_are_played_up_to_there_and_others_are_refused) {
  NEEDS_THE_VIEWER;
  const Filmed filmed({}, false);
  fs::resize_file(filmed.file, fs::file_size(filmed.file) * 6 / 10);
  {
    const Viewer viewer({filmed.file}, false);
    Greeted one(viewer);
    const double count = number_in(one.hello, "frames");
    EXPECT_GE(count, 1);
    EXPECT_LT(count, 4);
    EXPECT_TRUE(played(one, 0, "\"raw\"").arrays.at(number_of(one.hello, "raw")) == filmed.bytes(0, "raw"));
    EXPECT_TRUE(has(viewer.err(), "run_0006.mcap: warning: the film ends early")) << viewer.err();
  }
  const Prepare here = in_folder(filmed.folder.path());
  write(filmed.folder / "other.mcap", "no film at all");
  EXPECT_TRUE(has(run({"view", "other.mcap", "--test-hooks"}, here).err, "other.mcap: error: this is no MCAP file"));
  EXPECT_TRUE(has(run({"view", "none.mcap", "--test-hooks"}, here).err, "none.mcap: error: there is no such file"));
  ASSERT_EQ(run(with_small_sensor({"render", "demo", "-o", "points", "-q", "--emit", "mcap", "--topics", "points"}), here).code, 0);
  EXPECT_TRUE(has(run({"view", "points/run.mcap", "--test-hooks"}, here).err, "there are no raw frames in it"));
  EXPECT_TRUE(has(run({"view", "points", "--test-hooks"}, here).err, "`tofray view points/run.mcap` plays the film"));
}

}  // namespace
}  // namespace tofray::test
