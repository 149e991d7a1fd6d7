// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Which arrays are written, how, and while what.
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <algorithm>

#include "files/json.h"
#include "files/npz.h"
#include "results/array_table.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

std::map<std::string, std::string> arrays_of(const fs::path& file) {
  std::map<std::string, std::string> arrays;
  for (files::NamedArray& one : files::read_npz(file)) {
    if (one.name != "meta") arrays[one.name] = one.array.bytes;
  }
  return arrays;
}

TEST(arrays, chosen_are_those_of_the_whole_file) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run(with_small_sensor({"render", "demo", "-o", "all", "--emit", "npz"}), here).code, 0);
  ASSERT_EQ(run(with_small_sensor({"render", "demo", "-o", "some", "--emit", "npz", "--arrays", "raw,z_m,flags"}), here).code, 0);
  const auto all = arrays_of(folder / "all/frame.npz"), some = arrays_of(folder / "some/frame.npz");
  EXPECT_EQ(some.size(), 3u + 5u + 3u);  // by raw frame: five, of the camera: three
  for (const auto& [name, bytes] : some) EXPECT_EQ(bytes, all.at(name)) << name;
  for (const char* name : {"raw", "z_m", "flags"}) EXPECT_TRUE(some.count(name)) << name;
}

TEST(arrays, compressed_are_the_same_in_fewer_bytes_that_are_the_same_each_run) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  for (const char* out : {"packed", "again"}) ASSERT_EQ(run({"render", "card", "-o", out, "--emit", "npz", "--compress"}, here).code, 0);
  ASSERT_EQ(run({"render", "card", "-o", "stored", "--emit", "npz"}, here).code, 0);
  EXPECT_EQ(content(folder / "packed/frame.npz"), content(folder / "again/frame.npz"));
  EXPECT_LT(fs::file_size(folder / "packed/frame.npz"), fs::file_size(folder / "stored/frame.npz") * 2 / 3);
  EXPECT_EQ(arrays_of(folder / "packed/frame.npz"), arrays_of(folder / "stored/frame.npz"));
}

TEST(arrays, and_compression_are_remembered_by_the_manifest) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "out", "--frames", "3", "--arrays", "gt_*,raw", "--compress"}), here).code, 0);
  const Result again = run({"render", "--from", "out/manifest.json", "-o", "again"}, here);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(files_of(folder / "out"), files_of(folder / "again"));
  EXPECT_EQ(files_of(folder / "out").size(), 3u);
  EXPECT_EQ(run({"render", "--from", "out/manifest.json", "--arrays", "raw"}, here).code, 2);
  EXPECT_EQ(run({"render", "--from", "out/manifest.json", "--compress"}, here).code, 2);
}

TEST(arrays, that_process_needs_are_raw_alone) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run({"render", "card", "-o", "all"}, here).code, 0);
  ASSERT_EQ(run({"render", "card", "-o", "raw", "--emit", "npz", "--arrays", "raw"}, here).code, 0);
  for (const char* from : {"all", "raw"})
    ASSERT_EQ(run({"process", std::string(from) + "/frame.npz", "-o", std::string(from) + "-again"}, here).code, 0) << from;
  EXPECT_EQ(content(folder / "all/depth.png"), content(folder / "raw-again/depth.png"));
  ASSERT_EQ(run({"process", "raw/frame.npz", "-o", "small", "--emit", "npz", "--arrays", "range_m"}, here).code, 0);
  EXPECT_EQ(arrays_of(folder / "small/frame.npz").at("range_m"), arrays_of(folder / "all/frame.npz").at("range_m"));
  EXPECT_FALSE(arrays_of(folder / "small/frame.npz").count("raw"));
}

TEST(arrays, that_are_missing_are_named) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "depth", "--emit", "npz", "--arrays", "z_m"}), here).code, 0);
  const Result processed = run({"process", "depth/frame.npz"}, here);
  EXPECT_EQ(processed.code, 2);
  EXPECT_TRUE(has(processed.err, "array \"raw\" is missing")) << processed.err;
  ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "raw", "--emit", "npz", "--arrays", "raw"}), here).code, 0);
  const Result wanted = run({"process", "raw/frame.npz", "--arrays", "z_m,tap_a,gt_z_m"}, here);
  EXPECT_EQ(wanted.code, 2);
  EXPECT_TRUE(has(wanted.err, "--arrays asks for tap_a and gt_z_m, and there are none")) << wanted.err;
}

TEST(arrays, that_are_missing_leave_one_pixel_with_what_there_is) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  for (const char* words : {"gt_*", "raw", "z_m", "flags", "tap_a,tap_b", "points_m", "gt_normal"}) {
    ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "out", "--emit", "npz", "--arrays", words}), here).code, 0);
    const Result pixel = run({"inspect", "out/frame.npz", "--pixel", "14,11"}, here);
    EXPECT_EQ(pixel.code, 0) << words << ": " << pixel.err;
    EXPECT_TRUE(has(pixel.out, "\nnot in this file: ")) << words << ": " << pixel.out;
    EXPECT_FALSE(has(pixel.out, "nan")) << words << ": " << pixel.out;
    EXPECT_EQ(run({"inspect", "out/frame.npz", "--pixel", "28,11"}, here).code, 2) << words;
    const Result table = run({"inspect", "out/frame.npz"}, here);
    EXPECT_EQ(table.code, 0) << words << ": " << table.err;
  }
}

TEST(arrays, asked_for_without_npz_files_are_an_error) {
  for (const Arguments& more : {Arguments{"--arrays", "raw"}, Arguments{"--compress"}}) {
    Arguments all = {"render", "card", "--emit", "png"};
    all.insert(all.end(), more.begin(), more.end());
    const Folder folder;
    const Result result = run(all, in_folder(folder.path()));
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(has(result.err, "--emit leaves these out")) << result.err;
  }
}

TEST(arrays, are_listed_with_their_meaning) {
  const Result listed = run({"list", "arrays"});
  ASSERT_EQ(listed.code, 0);
  const files::Json json = files::parse_json(run({"list", "arrays", "--json"}).out, "stdout");
  ASSERT_EQ(json.find("arrays")->items()->size(), results::array_table().size());
  for (const results::ArrayRow& row : results::array_table())
    EXPECT_TRUE(has(listed.out, "`" + row.name + "`") && has(listed.out, row.what)) << row.name;
}

TEST(sequence, has_the_bytes_of_single_frames_and_its_files_in_order) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run(with_small_sensor({"render", "flying-ball", "-o", "all", "--frames", "40", "--threads", "1"}), here).code, 0);
  ASSERT_EQ(run(with_small_sensor({"render", "flying-ball", "-o", "more", "--frames", "40", "--threads", "7"}), here).code, 0);
  EXPECT_EQ(files_of(folder / "all"), files_of(folder / "more"));
  ASSERT_EQ(run(with_small_sensor({"render", "flying-ball", "-o", "one", "--first-frame", "23", "--emit", "npz"}), here).code, 0);
  EXPECT_EQ(content(folder / "one/frame_0023.npz"), content(folder / "all/frame_0023.npz"));
  const files::Json manifest = files::parse_json(content(folder / "all/manifest.json"), "manifest.json");
  std::vector<std::string> names;
  for (const files::Json& file : *manifest.find("files")->items()) names.push_back(*file.find("name")->string());
  EXPECT_EQ(names.size(), 40u);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
}

TEST(sequence, says_how_fast_it_was_computed_and_how_fast_written) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  const Result text = run(with_small_sensor({"render", "card", "-o", "out", "--frames", "4"}), here);
  EXPECT_TRUE(has(text.err, " frames/s computed, ") && has(text.err, " written")) << text.err;
  const files::Json json =
      files::parse_json(run(with_small_sensor({"render", "card", "-o", "out", "--frames", "4", "--json"}), here).out, "stdout");
  double computed = 0, written = 0;
  ASSERT_TRUE(json.find("computed_frames_per_s")->number(computed) && json.find("written_frames_per_s")->number(written));
  EXPECT_GT(written, 0);
  EXPECT_GE(computed, written);
}

// A frame of which there is no room for several is computed and written in turn.
TEST(sequence, of_frames_that_do_not_fit_ends_with_3_and_whole_files) {
  const Folder folder;
  const auto limited = [&] {
    in_folder(folder.path())();
    const rlimit limit{20'000, 20'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  };
  fs::create_directory(folder / "out");
  std::ofstream(folder / "out" / "frame_0003.npz") << "old";
  const Result result = run(with_small_sensor({"render", "card", "-o", "out", "--frames", "30"}), limited);
  EXPECT_EQ(result.code, 3);
  EXPECT_TRUE(has(result.err, "frame_0000.npz: error: cannot write it")) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(files_of(folder / "out"), (std::map<std::string, std::string>{{"frame_0003.npz", "old"}}));
  EXPECT_FALSE(fs::exists(folder / "out" / "manifest.json"));
}

}  // namespace
}  // namespace tofray::test
