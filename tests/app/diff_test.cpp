// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "files/json.h"
#include "files/npz.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

std::string file_of(const std::vector<float>& z, const std::vector<std::uint16_t>& raw) {
  return files::npz_bytes({files::npy_view("z_m", {z.size()}, z), files::npy_view("raw", {raw.size()}, raw)});
}

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(diff, of_a_file_and_itself_is_nothing_and_ends_with_0) {
  const Folder folder;
  write(folder / "a.npz", file_of({1, nan, 0.F}, {7, 8}));
  write(folder / "b.npz", file_of({1, -nan, -0.F}, {7, 8}));  // other bytes, the same values
  for (const char* other : {"a.npz", "b.npz"}) {
    const Result result = run({"diff", "a.npz", other}, in_folder(folder.path()));
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.out, std::string("a.npz, ") + other + ": same\n  z_m                      same\n  raw                      same\n");
  }
}

TEST(diff, counts_values_that_differ_and_names_the_largest_difference) {
  const Folder folder;
  write(folder / "a.npz", file_of({1, 2, 3, nan}, {7, 65535}));
  write(folder / "b.npz", file_of({1, 2.5F, 2, 4}, {7, 0}));
  const Result result = run({"diff", "a.npz", "b.npz"}, in_folder(folder.path()));
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(has(result.out, "a.npz, b.npz: different\n")) << result.out;
  EXPECT_TRUE(has(result.out, "z_m                      3 of 4 differ, by up to 1 m, 1 of them NaN or infinite in one of the two\n"))
      << result.out;
  EXPECT_TRUE(has(result.out, "raw                      1 of 2 differ, by up to 65535 DN\n")) << result.out;
  const Result asked = run({"diff", "a.npz", "b.npz", "--json"}, in_folder(folder.path()));
  EXPECT_EQ(asked.code, 1);
  const files::Json json = files::parse_json(asked.out, "stdout");
  EXPECT_EQ(files::json_text(*json.find("same")), "false");
  const files::Json z = (*(*json.find("files")->items())[0].find("arrays")->items())[0];
  EXPECT_EQ(files::json_text(z), R"({"name":"z_m","same":false,"values":4,"differ":3,"largest_difference":1.0,"not_finite":1,"unit":"m"})");
}

TEST(diff, tells_whole_numbers_apart_that_a_double_does_not) {
  const Folder folder;
  const std::vector<std::uint64_t> a = {(1ULL << 53) + 1}, b = {1ULL << 53};
  write(folder / "a.npz", files::npz_bytes({files::npy_view("n", {1}, a)}));
  write(folder / "b.npz", files::npz_bytes({files::npy_view("n", {1}, b)}));
  EXPECT_TRUE(has(run({"diff", "a.npz", "b.npz"}, in_folder(folder.path())).out, "1 of 1 differ"));
}

TEST(diff, names_arrays_that_cannot_be_compared_or_are_missing) {
  const Folder folder;
  const std::vector<float> four(4), six(6);
  const std::vector<std::uint16_t> codes(4);
  write(folder / "a.npz",
        files::npz_bytes({files::npy_view("x", {4}, four), files::npy_view("y", {6}, six), files::npy_view("only_a", {4}, four)}));
  write(folder / "b.npz",
        files::npz_bytes({files::npy_view("x", {4}, codes), files::npy_view("y", {2, 3}, six), files::npy_view("only_b", {4}, four)}));
  const Result result = run({"diff", "a.npz", "b.npz"}, in_folder(folder.path()));
  EXPECT_EQ(result.code, 1);
  for (const char* part : {"float32, then uint16", "(6,), then (2, 3)", "only_a                   only in the first",
                           "only_b                   only in the second"})
    EXPECT_TRUE(has(result.out, part)) << result.out;
}

TEST(diff, of_folders_compares_files_by_name) {
  const Folder folder;
  fs::create_directory(folder / "a"), fs::create_directory(folder / "b");
  for (const char* one : {"a", "b"}) write(folder / one / "frame.npz", file_of({1}, {2}));
  write(folder / "b" / "preview.png", "no array");
  EXPECT_EQ(run({"diff", "a", "b"}, in_folder(folder.path())).code, 0);
  EXPECT_EQ(run({"diff", "a", "b/frame.npz"}, in_folder(folder.path())).code, 0);  // a folder means its frame.npz
  write(folder / "a" / "frame_0001.npz", file_of({1}, {2}));
  const Result result = run({"diff", "a", "b"}, in_folder(folder.path()));
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(has(result.out, "frame_0001.npz: only in the first folder\n")) << result.out;
}

TEST(diff, of_runs_says_what_a_seed_changes) {
  const Folder folder;
  for (const auto& [out, seed] : {std::pair{"one", "1"}, {"again", "1"}, {"other", "2"}})
    ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", out, "--seed", seed, "--emit", "npz"}), in_folder(folder.path())).code, 0);
  EXPECT_EQ(run({"diff", "one", "again"}, in_folder(folder.path())).code, 0);
  const Result result = run({"diff", "one", "other"}, in_folder(folder.path()));
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(has(result.out, "  gt_z_m                   same\n")) << result.out;
  EXPECT_TRUE(has(result.out, "  meta                     another text\n")) << result.out;
  EXPECT_TRUE(has(result.out, " differ, by up to ")) << result.out;
}

TEST(diff, of_what_holds_no_arrays_is_refused) {
  const Folder folder;
  fs::create_directory(folder / "a"), fs::create_directory(folder / "b");
  write(folder / "scene.yaml", "objects: []\n");
  write(folder / "a.npz", file_of({1}, {2}));
  struct Case {
    Arguments words;
    int code;
    const char* says;
  };
  for (const Case& one : {Case{{"diff", "a", "b"}, 2, "a: error: there are no arrays in this folder"},
                          Case{{"diff", "a.npz", "scene.yaml"}, 2, "scene.yaml: error: "},
                          Case{{"diff", "a.npz", "none.npz"}, 3, "none.npz: error: "}, Case{{"diff", "a.npz"}, 2, "needs A B"}}) {
    const Result result = run(one.words, in_folder(folder.path()));
    EXPECT_EQ(result.code, one.code) << result.err;
    EXPECT_TRUE(has(result.err, one.says)) << result.err;
    EXPECT_EQ(result.out, "");
  }
}

}  // namespace
}  // namespace tofray::test
