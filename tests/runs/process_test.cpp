// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "files/npz.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

TEST(process, keeps_ground_truth_pose_and_arrays_of_one_s_own) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "out", "--set", "camera.pose.position=[0, 0, -1]"}), here).code, 0);
  auto arrays = files::read_npz(folder / "out" / "frame.npz");
  arrays.push_back({"labels", {{'U', 12}, {2}, files::utf32_of("abcdef")}});
  std::vector<files::NpyView> views;
  for (const files::NamedArray& one : arrays) views.push_back({one.name, one.array.type, one.array.shape, one.array.bytes});
  std::ofstream(folder / "labelled.npz", std::ios::binary) << files::npz_bytes(views);
  ASSERT_EQ(run({"process", "labelled.npz", "-o", "again", "--set", "camera.decoding.filter.kind=median"}, here).code, 0);
  std::map<std::string, files::NpyArray> after;
  for (files::NamedArray& one : files::read_npz(folder / "again" / "frame.npz")) after[one.name] = std::move(one.array);
  int kept = 0;
  for (const files::NamedArray& one : arrays) {
    ASSERT_TRUE(after.contains(one.name)) << one.name;
    if (!one.name.starts_with("gt_") && one.name != "labels" && one.name != "camera_pose") continue;
    EXPECT_EQ(after[one.name].bytes, one.array.bytes) << one.name;
    EXPECT_EQ(after[one.name].shape, one.array.shape) << one.name;
    ++kept;
  }
  EXPECT_EQ(kept, 19);  // seventeen arrays of ground truth
  // The first run's depth is not kept in the place of the new one.
  const auto before = std::find_if(arrays.begin(), arrays.end(), [](const files::NamedArray& one) { return one.name == "z_m"; });
  EXPECT_NE(after["z_m"].bytes, before->array.bytes);
}

/// A frame's file whose truth lies so much farther in every second pixel, without some of its arrays. @return how many those are
std::size_t write_with_truth_moved(const fs::path& from, const fs::path& to, const std::vector<std::string>& without, float farther) {
  std::size_t moved = 0;
  std::vector<files::NamedArray> arrays = files::read_npz(from);
  std::erase_if(arrays, [&](const files::NamedArray& one) { return std::find(without.begin(), without.end(), one.name) != without.end(); });
  std::vector<files::NpyView> views;
  for (files::NamedArray& one : arrays) {
    if (one.name == "gt_range_m" || one.name == "gt_z_m") {
      std::vector<float> values(one.array.count());
      std::memcpy(values.data(), one.array.bytes.data(), one.array.bytes.size());
      for (std::size_t i = 0; i < values.size(); i += 2) values[i] += farther;
      moved = (values.size() + 1) / 2;
      one.array.bytes.assign(reinterpret_cast<const char*>(values.data()), 4 * values.size());
    }
    views.push_back({one.name, one.array.type, one.array.shape, one.array.bytes});
  }
  std::ofstream(to, std::ios::binary) << files::npz_bytes(views);
  return moved;
}

// Truth on another cycle, and beyond the ambiguity range; without gt_object_id, and with gt_z_m alone, it still knows.
TEST(process, does_not_tell_a_depth_that_is_whole_cycles_off_as_right) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(
      run(with_small_sensor({"render", "card", "-o", "out", "--noise", "off", "--set", "camera.illumination.0.power=1 mW"}), here).code, 0);
  const auto told = [&](const std::vector<std::string>& without, float farther, std::size_t* moved) {
    *moved = write_with_truth_moved(folder / "out" / "frame.npz", folder / "moved.npz", without, farther);
    const Result result = run({"process", "moved.npz", "-o", "again"}, here);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.out + result.err;
  };
  std::size_t moved = 0;
  EXPECT_TRUE(has(told({}, 0, &moved), "616 of 616 pixels have a depth\n")) << told({}, 0, &moved);
  for (const std::vector<std::string>& without : {std::vector<std::string>{}, {"gt_object_id"}, {"gt_object_id", "gt_range_m"}}) {
    for (const float farther : {1.5F, 50.0F}) {
      const std::string text = told(without, farther, &moved);
      EXPECT_EQ(moved, 308U);
      EXPECT_TRUE(has(text, "308 of 616 pixels have a depth that is right, 308 one that is whole cycles off\n")) << text;
    }
  }
}

TEST(theme, light_changes_figures_only_and_comes_back_from_a_manifest) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "dark"}), here).code, 0);
  ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "light", "--theme", "light"}), here).code, 0);
  const auto dark = files_of(folder / "dark"), light = files_of(folder / "light");
  EXPECT_EQ(dark.size(), 6u);
  for (const auto& [name, bytes] : dark) EXPECT_EQ(bytes == light.at(name), name != "preview.png" && name != "raw.png") << name;
  ASSERT_EQ(run({"render", "--from", "light/manifest.json", "-o", "again"}, here).code, 0);
  EXPECT_EQ(files_of(folder / "again"), light);
  ASSERT_EQ(run({"process", "light/frame.npz", "-o", "processed", "--theme=light"}, here).code, 0);
  EXPECT_EQ(content(folder / "processed" / "raw.png"), light.at("raw.png"));
}

}  // namespace
}  // namespace tofray::test
