// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "results/array_table.h"
#include "results/frame_file.h"
#include "support/samples.h"

using namespace tofray;
using namespace tofray::files;
using namespace tofray::results;
using out_test::error_of;

namespace {

std::vector<std::string> names_in(const std::string& file) {
  std::vector<std::string> names;
  for (const NamedArray& one : parse_npz(file, "memory")) names.push_back(one.name);
  return names;
}

std::string file_of(const std::string& words) {
  FrameFileOptions options;
  if (!words.empty()) options.arrays = ArrayChoice(words);
  return frame_npz_bytes(out_test::sample_frame(6, 4), out_test::sample_camera(6, 4), {}, "{}", options);
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

TEST(array_table, is_what_a_frame_file_holds_in_its_order_and_types) {
  const std::vector<NamedArray> arrays = parse_npz(file_of(""), "memory");
  const std::vector<ArrayRow>& table = array_table();
  ASSERT_EQ(arrays.size(), table.size() + 1);
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(arrays[i].name, table[i].name);
    EXPECT_EQ(arrays[i].array.type, table[i].type) << table[i].name;
    const auto commas = std::count(table[i].shape.begin(), table[i].shape.end(), ',');
    EXPECT_EQ(arrays[i].array.shape.size(), table[i].shape == "[]" ? 0U : static_cast<std::size_t>(commas + 1)) << table[i].name;
    EXPECT_FALSE(table[i].unit.empty() || table[i].what.empty()) << table[i].name;
  }
  EXPECT_EQ(arrays.back().name, "meta");
}

TEST(array_table, is_the_reference_page) {
  EXPECT_EQ(out_test::read_file(TOFRAY_SOURCE_DIR "/docs/reference/arrays.md"), array_reference())
      << "tofray list arrays > docs/reference/arrays.md";
}

TEST(array_choice, leaves_out_what_was_not_asked_for_and_nothing_that_explains_the_rest) {
  EXPECT_EQ(names_in(file_of("raw,z_m")),
            (std::vector<std::string>{"raw", "modulation_frequency_hz", "reference_phase_rad", "integration_time_s", "start_time_s", "lit",
                                      "z_m", "camera_matrix", "distortion", "camera_pose", "meta"}));
}

TEST(array_choice, takes_patterns) {
  const std::vector<std::string> truth = names_in(file_of("gt_*,transient_*"));
  for (const ArrayRow& row : array_table()) EXPECT_EQ(contains(truth, row.name), row.is_truth() || !row.is_image()) << row.name;
  const std::vector<std::string> metres = names_in(file_of("*_m"));
  EXPECT_TRUE(contains(metres, "z_m") && contains(metres, "gt_z_m") && contains(metres, "noise_m") && contains(metres, "gt_time_s"));
  EXPECT_FALSE(contains(metres, "raw") || contains(metres, "gt_normal"));
  EXPECT_EQ(names_in(file_of("*")), names_in(file_of("")));
  EXPECT_EQ(names_in(file_of("tap_*")), names_in(file_of("tap_b,tap_a")));
}

TEST(array_choice, knows_whether_the_truth_is_wanted) {
  EXPECT_TRUE(ArrayChoice().has_truth());
  EXPECT_TRUE(ArrayChoice("raw,gt_normal").has_truth());
  EXPECT_TRUE(ArrayChoice("raw,transient_e_per_s").has_truth());
  EXPECT_FALSE(ArrayChoice("raw,z_m,flags").has_truth());
}

TEST(array_choice, of_an_unknown_name_suggests_the_nearest) {
  const auto message = [](const std::string& words) {
    const Error error = error_of([&] { ArrayChoice choice(words); });
    EXPECT_EQ(error.kind(), ErrorKind::bad_input);
    return std::string(error.what());
  };
  EXPECT_NE(message("raw,rnage_m").find("there is no array \"rnage_m\"; did you mean \"range_m\"?"), std::string::npos);
  EXPECT_NE(message("gx_*").find("there is no array \"gx_*\""), std::string::npos);
  EXPECT_NE(message("raw,").find("there is no array \"\""), std::string::npos);
  EXPECT_NE(message("").find("there is no array \"\""), std::string::npos);
}
