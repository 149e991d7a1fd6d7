// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "files/npz.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

std::vector<float> floats_of(const files::NpyArray& array) {
  std::vector<float> out;
  for (std::size_t i = 0; i < array.count(); ++i) out.push_back(static_cast<float>(array.number(i)));
  return out;
}

files::NpyArray array_of(const std::filesystem::path& file, const std::string& name) {
  for (files::NamedArray& one : files::read_npz(file.native(), {name})) return std::move(one.array);
  ADD_FAILURE() << file << " has no " << name;
  return {};
}

void write_npy(const std::filesystem::path& file, const files::NpyShape& shape, const std::vector<float>& values) {
  const std::string head = files::npy_header(files::npy_type_of<float>(), shape);
  std::ofstream(file, std::ios::binary) << head << std::string_view(reinterpret_cast<const char*>(values.data()), 4 * values.size());
}

/// Large pixels, which would be saturated.
std::vector<std::string> dark_of(std::vector<std::string> words) {
  words = with_small_sensor(std::move(words));
  words.insert(words.end(), {"--set", "camera.lens.f_number=8"});
  return words;
}

std::vector<std::string> with_bins(std::vector<std::string> words, const std::string& bins, const std::string& width) {
  words = dark_of(std::move(words));
  for (const std::string& one : {"transport.transient.bins=" + bins, "transport.transient.width=" + width})
    words.insert(words.end(), {"--set", one});
  return words;
}

/// The arrays of two files are the same but for rounding and for what bins of `width` do to phasors.
void expect_near(const std::filesystem::path& one, const std::filesystem::path& other, const std::string& name, float most) {
  const std::vector<float> a = floats_of(array_of(one, name)), b = floats_of(array_of(other, name));
  ASSERT_EQ(a.size(), b.size());
  float worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(std::isnan(a[i]), std::isnan(b[i])) << name << " " << i;
    if (!std::isnan(a[i])) worst = std::max(worst, std::abs(a[i] - b[i]));
  }
  EXPECT_LT(worst, most) << name;
}

TEST(transient, is_written_and_comes_back_as_raw_frames_and_depth) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  const auto rendered = run(with_bins({"render", "card", "-o", "out", "--noise", "off"}, "800", "1cm"), here);
  ASSERT_EQ(rendered.code, 0) << rendered.err;
  EXPECT_FALSE(has(rendered.err, "paths that are shorter or longer")) << rendered.err;
  const files::NpyArray light = array_of(folder / "out" / "frame.npz", "transient_e_per_s");
  const files::NpyShape image = array_of(folder / "out" / "frame.npz", "z_m").shape;
  EXPECT_EQ(light.shape, (files::NpyShape{800, image[0], image[1]}));
  const auto back = run({"process", "--transient", "out/frame.npz", "-o", "back", "--noise", "off"}, here);
  ASSERT_EQ(back.code, 0) << back.err;
  expect_near(folder / "out" / "frame.npz", folder / "back" / "frame.npz", "z_m", 1e-3f);
  expect_near(folder / "out" / "frame.npz", folder / "back" / "frame.npz", "raw", 2);
  EXPECT_EQ(array_of(folder / "back" / "frame.npz", "gt_z_m").bytes, array_of(folder / "out" / "frame.npz", "gt_z_m").bytes);
  EXPECT_EQ(array_of(folder / "back" / "frame.npz", "transient_e_per_s").bytes, light.bytes);
  // What was processed says what its bins are, too.
  ASSERT_EQ(run({"process", "--transient", "out/frame.npz", "--first", "0.5m", "-o", "shifted", "--noise", "off"}, here).code, 0);
  for (const std::string from : {"back/frame.npz", "shifted/frame.npz"}) {
    ASSERT_EQ(run({"process", "--transient", from, "-o", "twice", "--noise", "off"}, here).code, 0);
    EXPECT_EQ(array_of(folder / "twice" / "frame.npz", "z_m").bytes, array_of(folder / from, "z_m").bytes) << from;
  }
  ASSERT_EQ(run({"process", "out/frame.npz", "-o", "plain"}, here).code, 0);
  ASSERT_EQ(run({"process", "--transient", "plain/frame.npz", "-o", "twice", "--noise", "off"}, here).code, 0);
  EXPECT_EQ(array_of(folder / "twice" / "frame.npz", "raw").bytes, array_of(folder / "back" / "frame.npz", "raw").bytes);
  // With noise, which has a seed.
  for (const char* seed : {"1", "2", "1"})
    ASSERT_EQ(run({"process", "--transient", "out/frame.npz", "-o", std::string("noisy") + seed, "--seed", seed}, here).code, 0);
  EXPECT_NE(array_of(folder / "noisy1" / "frame.npz", "raw").bytes, array_of(folder / "noisy2" / "frame.npz", "raw").bytes);

  // Light as other renderers write it: the bins last, with a channel or without, in another unit, and nothing that says what they are.
  std::vector<float> turned(light.count());
  const std::size_t pixels = image[0] * image[1];
  for (std::size_t i = 0; i < turned.size(); ++i) turned[i % pixels * 800 + i / pixels] = static_cast<float>(light.number(i) / 4);
  write_npy(folder / "last.npy", {image[0], image[1], 800}, turned);
  write_npy(folder / "channel.npy", {image[0], image[1], 800, 1}, turned);
  std::vector<float> quarter = floats_of(light);
  for (float& one : quarter) one /= 4;
  write_npy(folder / "first.npy", light.shape, quarter);
  for (const char* name : {"last", "channel", "first"}) {
    const auto other = run(dark_of({"process", "--transient", std::string(name) + ".npy", "--camera", "pico-flexx", "--width", "1cm",
                                    "--factor", "4", "-o", name, "--noise", "off", "--emit", "npz"}),
                           here);
    ASSERT_EQ(other.code, 0) << other.err;
    EXPECT_EQ(array_of(folder / name / "frame.npz", "raw").bytes, array_of(folder / "back" / "frame.npz", "raw").bytes) << name;
  }
  // Half a metre more on the way is half of that more range.
  ASSERT_EQ(run({"process", "--transient", "out/frame.npz", "--first", "0.5m", "-o", "later", "--noise", "off"}, here).code, 0);
  const std::size_t middle = pixels / 2 + image[1] / 2;
  EXPECT_NEAR(array_of(folder / "later" / "frame.npz", "range_m").number(middle) -
                  array_of(folder / "back" / "frame.npz", "range_m").number(middle),
              0.25, 2e-3);
}

TEST(transient, that_is_lost_is_told_and_what_no_file_shows_is_not_computed) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  const auto few = run(with_bins({"render", "card", "-o", "out", "--emit", "npz"}, "10", "1cm"), here);
  EXPECT_EQ(few.code, 0);
  EXPECT_TRUE(has(few.err, "warning: 100 % of the light took paths that are shorter or longer than all bins of transient_e_per_s\n"))
      << few.err;
  const auto none = run(with_bins({"render", "card", "-o", "none", "--emit", "npz", "--arrays", "raw,gt_z_m"}, "10", "1cm"), here);
  EXPECT_EQ(none.code, 0);
  EXPECT_FALSE(has(none.err, "warning")) << none.err;
  const auto lost =
      run(with_bins({"render", "card", "-o", "lost", "--emit", "npz", "--arrays", "transient_lost_e_per_s"}, "10", "1cm"), here);
  EXPECT_TRUE(has(lost.err, "warning: 100 %")) << lost.err;
  EXPECT_EQ(array_of(folder / "lost" / "frame.npz", "transient_lost_e_per_s").bytes,
            array_of(folder / "out" / "frame.npz", "transient_lost_e_per_s").bytes);
  EXPECT_TRUE(has(run(with_bins({"render", "card"}, "1000000", "1cm"), here).err, "the histograms of light by path length are too large"));
  EXPECT_TRUE(has(run(with_bins({"render", "card"}, "10", "-1cm"), here).err, "transport.transient.width"));
}

TEST(transient, of_files_that_make_no_sense_is_refused) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  const auto told = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"process", "--camera", "pico-flexx", "--set", "sensor.width=3", "--set", "sensor.height=2"});
    const auto result = run(words, here);
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "light-depth"));
    return result.err;
  };
  const auto of = [&](const files::NpyShape& shape, const std::vector<float>& values) {
    write_npy(folder / "light.npy", shape, values);
    return told({"--transient", "light.npy", "--width", "1cm"});
  };
  std::vector<float> values(24, 1);
  EXPECT_TRUE(has(of({4, 3, 2}, values),
                  "light.npy: error: array \"array\" is not of the camera's size\n  got (4, 3, 2), expected (bins, 2, 3), (2, "
                  "3, bins) or (2, 3, bins, 1)\n"));
  EXPECT_TRUE(has(of({2, 3, 2, 2}, values), "array \"array\" has 2 channels\n")) << of({2, 3, 2, 2}, values);
  EXPECT_TRUE(has(of({24}, values), "is not of the camera's size"));
  EXPECT_TRUE(has(of({0, 2, 3}, {}), "array \"array\" has no bins\n  got (0, 2, 3)"));
  values[17] = std::nanf("");
  EXPECT_TRUE(
      has(of({4, 2, 3}, values), "array \"array\" has a value that makes no sense\n  got nan at [2, 1, 2], expected light of 0 to 1e+20"));
  values[17] = -1;
  EXPECT_TRUE(has(of({2, 3, 4}, values), "got -1 at [1, 1, 1]"));
  values[17] = 0;
  write_npy(folder / "light.npy", {4, 2, 3}, values);
  EXPECT_TRUE(
      has(told({"--transient", "light.npy"}), "light.npy: error: the file does not say how wide the bins are\n  say it by --width"));
  for (const char* width : {"0", "-1cm", "3kg", "x", "nan"})
    EXPECT_TRUE(has(told({"--transient", "light.npy", "--width", width}), "error: --width cannot be ")) << width;
  for (const char* factor : {"0", "-1", "2 e", "inf"})
    EXPECT_TRUE(has(told({"--transient", "light.npy", "--width", "1cm", "--factor", factor}), "error: --factor cannot be ")) << factor;
  EXPECT_TRUE(has(told({"light.npz", "--transient", "light.npy"}), "--transient takes the place of \"light.npz\""));
  EXPECT_TRUE(has(told({"light.npz", "--seed", "1"}), "go with --transient"));
  EXPECT_TRUE(has(told({}), "needs RAW "));
  std::ofstream(folder / "empty.npy");
  EXPECT_TRUE(has(told({"--transient", "empty.npy", "--width", "1cm"}), "empty.npy: error: "));
  std::ofstream(folder / "empty.npz");
  EXPECT_TRUE(has(told({"--transient", "empty.npz", "--width", "1cm"}), "empty.npz: error: "));
  const auto npz = [&](const std::vector<files::NpyView>& views) {
    std::ofstream(folder / "light.npz", std::ios::binary) << files::npz_bytes(views);
    return told({"--transient", "light.npz", "--width", "1cm"});
  };
  const std::vector<int> whole(24, 1);
  EXPECT_TRUE(
      has(npz({files::npy_view("x", {6}, std::vector<float>(6))}), "light.npz: error: there are no histograms of light by path length\n"));
  EXPECT_TRUE(
      has(npz({files::npy_view("a", {4, 2, 3}, values), files::npy_view("b", {4, 2, 3}, whole)}), "arrays \"a\" and \"b\" might both be"));
  EXPECT_TRUE(has(npz({{"a", {'b', 1}, {1, 2, 3}, std::string_view("\1\0\1\0\1\0", 6)}}), "array \"a\" has the wrong type\n  got bool"));
  std::ofstream(folder / "light.npz", std::ios::binary) << files::npz_bytes({files::npy_view("a", {4, 2, 3}, whole)});
  EXPECT_EQ(run({"process", "--camera", "pico-flexx", "--set", "sensor.width=3", "--set", "sensor.height=2", "--transient", "light.npz",
                 "--width", "1cm", "-o", "out"},
                here)
                .code,
            0)
      << "whole numbers are light, too";
}

}  // namespace
}  // namespace tofray::test
