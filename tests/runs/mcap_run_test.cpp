// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Films are written by several threads while frames are computed: in the frames' order, and no thread waits for ever where one fails.
#include <gtest/gtest.h>

#include "mcap/reader.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

/// The frames that a film's raw/meta tell of, in the file's order, and whether it has its end.
std::pair<std::vector<int>, bool> frames_of(const fs::path& file) {
  std::vector<int> out;
  mcap::Reading reading;
  reading.message = [&](const mcap::SeenMessage& one) {
    const std::string_view mark = "{\"frame\":";
    if (one.channel.topic.ends_with("/raw/meta"))
      out.push_back(std::atoi(std::string(one.data.substr(one.data.find(mark) + mark.size())).c_str()));
  };
  const auto source = mcap::open_file(file.native());
  const bool complete = mcap::read(*source, file.native(), reading).complete;
  return {out, complete};
}

std::vector<int> numbers(int first, int count) {
  std::vector<int> out;
  for (int i = 0; i < count; ++i) out.push_back(first + i);
  return out;
}

TEST(film, of_several_writers_has_its_frames_in_order) {
  const Folder folder;
  for (const char* emit : {"mcap", "npz,mcap,png"}) {
    const Result result =
        run(with_small_sensor({"render", "flying-ball", "-o", "out", "--frames", "60", "--first-frame", "5", "--emit", emit}),
            in_folder(folder.path()));
    ASSERT_EQ(result.code, 0) << result.err;
    const auto [frames, complete] = frames_of(folder / "out/run_0005.mcap");
    EXPECT_TRUE(complete);
    EXPECT_EQ(frames, numbers(5, 60)) << emit;
  }
}

TEST(film, beside_files_that_cannot_be_written_ends_with_3_and_keeps_what_it_has) {
  const Folder folder;
  fs::create_directories(folder / "out/frame_0007.npz");  // in the place of a file
  const Result result =
      run(with_small_sensor({"render", "flying-ball", "-o", "out", "--frames", "200", "--emit", "npz,mcap"}), in_folder(folder.path()));
  EXPECT_EQ(result.code, 3);
  EXPECT_TRUE(has(result.err, "frame_0007.npz")) << result.err;
  EXPECT_FALSE(fs::exists(folder / "out/run.mcap"));
  const auto [frames, complete] = frames_of(folder / "out/run.part.mcap");
  EXPECT_FALSE(complete);
  EXPECT_EQ(frames, numbers(0, static_cast<int>(frames.size())));
  EXPECT_LE(frames.size(), 7U);
}

TEST(film, that_is_interrupted_has_its_end) {
  const Folder folder;
  const Arguments arguments = with_small_sensor({"render", "flying-ball", "-o", "out", "--frames", "1000000", "--emit", "mcap"});
  const pid_t child = start(arguments, folder / "out.txt", folder / "err.txt", in_folder(folder.path()));
  std::error_code ignored;
  for (int i = 0; i < 600 && !(fs::file_size(folder / "out/run.part.mcap", ignored) > 100'000 && !ignored); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ::kill(child, SIGINT);
  EXPECT_EQ(finish(child), 128 + SIGINT) << content(folder / "err.txt");
  const auto [frames, complete] = frames_of(folder / "out/run.mcap");
  EXPECT_TRUE(complete);
  EXPECT_GT(frames.size(), 0U);
  EXPECT_EQ(frames, numbers(0, static_cast<int>(frames.size())));
  EXPECT_TRUE(has(content(folder / "err.txt"), "interrupted: " + std::to_string(frames.size()) + " of 1000000 frames are complete"));
}

}  // namespace
}  // namespace tofray::test
