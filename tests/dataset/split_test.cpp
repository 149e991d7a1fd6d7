// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Splits: which samples are for what, and that no file is in two of them.
#include "dataset/split.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>

#include "support/samples.h"
#include "support/text.h"
#include "tofray/tofray.h"

namespace {

using namespace tofray;
using out_test::write_file;
using test::has;

std::string text_of(const std::string& split, const std::string& samples = "2000") {
  return "name: parts\nsamples: " + samples + "\nseed: 3\n" + split +
         "scene:\n  objects:\n    - plane: {name: wall, point: [0, 0, {uniform: [1 m, 3 m]}], reflectivity: 0.5}\n"
         "    - mesh: {name: chair, file: {files: \"chairs/*.obj\"}, reflectivity: 0.5}\n"
         "    - mesh: {name: lamp, file: {files: \"lamps/*.obj\"}, reflectivity: 0.5}\n";
}

/// A set beside ten chairs and four lamps, of which one is a chair's file by another name.
class Parted {
 public:
  Parted() {
    for (const char* name : {"chairs", "lamps"}) std::filesystem::create_directory(folder_.file(name));
    for (int i = 0; i < 10; ++i) put("chairs/" + std::to_string(i), i);
    for (int i = 9; i < 13; ++i) put("lamps/" + std::to_string(i), i);
  }
  [[nodiscard]] Dataset set(const std::string& text) const {
    write_file(folder_.file("set.yaml"), text);
    return Dataset(folder_.file("set.yaml"));
  }
  [[nodiscard]] std::string fault(const std::string& text) const {
    try {
      (void)set(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  }

 private:
  void put(const std::string& name, int number) const {
    write_file(folder_.file(name + ".obj"), "v 0 0 " + std::to_string(number + 1) + "\nv 1 0 1\nv 0 1 1\nf 1 2 3\n");
  }
  out_test::TemporaryFolder folder_;
};

constexpr const char* by_asset = "split: {by: asset, test: 20 %, validation: 10 %}\n";

TEST(split, by_asset_shares_no_file) {
  const Dataset set = Parted().set(text_of(by_asset));
  std::map<std::string, std::set<std::string>> files;
  std::map<std::string, int> samples;
  for (std::uint64_t i = 0; i < set.samples(); ++i) {
    ++samples[set.split(i)];
    for (const Drawn& one : set.drawn(i))
      if (one.form == "files") files[set.split(i)].insert(one.text == "lamps/9.obj" ? "chairs/9.obj" : one.text);
  }
  EXPECT_NEAR(samples["test"], 400, 60);
  EXPECT_NEAR(samples["validation"], 200, 45);
  std::set<std::string> all;
  std::size_t count = 0;
  for (const auto& [split, names] : files) all.insert(names.begin(), names.end()), count += names.size();
  EXPECT_EQ(files.size(), 3U);
  EXPECT_EQ(count, 13U) << "each file is in one split";
  EXPECT_EQ(all.size(), 13U) << "and each is drawn";
}

TEST(split, of_a_sample_changes_with_nothing_but_the_seed) {
  const Parted files;
  const Dataset set = files.set(text_of(by_asset)), more = files.set(text_of(by_asset, "3000")),
                other = files.set(text_of("split: {by: scene, test: 20 %, validation: 10 %}\n")), plain = files.set(text_of(""));
  for (std::uint64_t i = 0; i < 500; ++i) {
    EXPECT_EQ(set.split(i), more.split(i));
    EXPECT_EQ(set.split(i), other.split(i));
    EXPECT_EQ(plain.split(i), "train");
    EXPECT_EQ(plain.drawn(i).front().value, set.drawn(i).front().value) << "no other draw depends on it";
  }
  EXPECT_THROW((void)set.split(2000), Error);
}

TEST(split, that_leaves_a_part_empty_is_refused_where_it_stands) {
  const Parted files;
  EXPECT_TRUE(has(files.fault(text_of("split: {by: scene}\n")), "set.yaml:4:8: error: split leaves a part without samples"));
  EXPECT_TRUE(has(files.fault(text_of("split: {by: scene, test: 60 %, validation: 40 %}\n")), "split leaves a part without samples"));
  EXPECT_TRUE(has(files.fault(text_of("split: {by: view, test: 10 %}\n")), "scene"));
  EXPECT_TRUE(has(files.fault("name: a\nsamples: 9\nsplit: {by: asset, test: 10 %}\nscene: {objects: []}\n"), "the set draws no files"));
  EXPECT_TRUE(has(files.fault(text_of(by_asset) + "    - mesh: {name: one, file: {files: \"chairs/1.obj\"}, reflectivity: 0.5}\n"),
                  "none of the files is for"));
}

}  // namespace
