// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Data files of somebody who means harm.
#include <algorithm>
#include <cmath>

#include "attack.h"
#include "files/npz.h"

namespace tofray::test {
namespace {

/// A frame of 4 by 3 pixels whose `meta` says what it is told.
std::vector<files::NpyView> small_frame(const std::string& meta_bytes, const std::vector<std::uint16_t>& codes) {
  return {files::npy_view("raw", {1, 3, 4}, codes), {"meta", {'U', static_cast<int>(meta_bytes.size())}, {}, meta_bytes}};
}

TEST(hostile_npz, the_camera_of_meta_has_to_be_that_of_the_arrays) {
  const Folder folder;
  ASSERT_EQ(attack(folder, with_small_sensor({"render", "card", "-o", "out", "--emit", "npz"})).code, 0);
  auto arrays = files::read_npz((folder / "out" / "frame.npz").native());
  const auto meta = std::find_if(arrays.begin(), arrays.end(), [](const files::NamedArray& one) { return one.name == "meta"; });
  ASSERT_NE(meta, arrays.end());
  std::string text = meta->array.text();
  for (const char* key : {"\"width\":28", "\"height\":22"}) {
    ASSERT_TRUE(has(text, key));
    text = changed(text, key, has(key, "width") ? "\"width\":2" : "\"height\":2");
  }
  meta->array.bytes = files::utf32_of(text);
  std::vector<files::NpyView> views;
  for (const auto& one : arrays) {
    files::NpyType type = one.array.type;
    if (one.name == "meta") type.size = static_cast<int>(one.array.bytes.size());
    views.push_back({one.name, type, one.array.shape, one.array.bytes});
  }
  write(folder / "small.npz", files::npz_bytes(views));
  expect_refused(attack(folder, {"inspect", "small.npz", "--pixel", "27,21"}), 2, "got an image of 2 x 2 pixels with");
  EXPECT_EQ(attack(folder, {"inspect", "out/frame.npz", "--pixel", "27,21"}).code, 0);
}

TEST(hostile_npz, raw_frames_that_are_fewer_than_the_camera_s_are_bad_input_for_inspect) {
  const Folder folder;
  ASSERT_EQ(attack(folder, with_small_sensor({"demo", "-o", "out"})).code, 0);
  std::vector<files::NamedArray> arrays = files::parse_npz(content(folder / "out" / "frame.npz"), "frame.npz");
  std::vector<files::NpyView> views;
  for (auto& one : arrays) {
    if (!one.array.shape.empty() && one.array.shape[0] == 9) {
      one.array.bytes.resize(one.array.bytes.size() / 9 * 8);
      one.array.shape[0] = 8;
    }
    views.push_back({one.name, one.array.type, one.array.shape, one.array.bytes});
  }
  write(folder / "eight.npz", files::npz_bytes(views));
  expect_refused(attack(folder, {"inspect", "eight.npz", "--pixel", "7,5"}), 2, "with 9 raw frames, and arrays of 28 x 22 pixels with 8");
}

TEST(hostile_npz, flags_of_another_kind_are_bad_input) {
  const Folder folder;
  const std::vector<std::uint16_t> codes(12, 7);
  const std::string words = files::utf32_of("abc");
  const std::vector<double> numbers(12, -1e300);
  const std::vector<std::int64_t> negative(12, -5);
  write(folder / "text.npz", files::npz_bytes({files::npy_view("raw", {1, 3, 4}, codes), {"flags", {'U', 12}, {}, words}}));
  write(folder / "float.npz", files::npz_bytes({files::npy_view("raw", {1, 3, 4}, codes), files::npy_view("flags", {3, 4}, numbers)}));
  write(folder / "negative.npz", files::npz_bytes({files::npy_view("raw", {1, 3, 4}, codes), files::npy_view("flags", {3, 4}, negative)}));
  for (const char* name : {"text.npz", "float.npz"}) {
    expect_refused(attack(folder, {"inspect", name}), 2, "array \"flags\" has the wrong type");
    expect_refused(attack(folder, {"inspect", name, "--json"}), 2, "array \"flags\" has the wrong type");
    expect_refused(attack(folder, {"inspect", name, "--pixel", "1,1"}), 2, "array \"flags\" has the wrong type");
  }
  EXPECT_EQ(attack(folder, {"inspect", "negative.npz"}).code, 0);
  EXPECT_EQ(attack(folder, {"inspect", "negative.npz", "--pixel", "1,1"}).code, 0);
}

TEST(hostile_npz, raw_frames_that_no_camera_has_get_no_phases) {
  const Folder folder;
  const std::vector<std::uint16_t> codes(4 * 12, 7);
  const double nan = std::nan("");
  for (const double hz : {0.0, -80e6, 5e-324, 1e300, nan, static_cast<double>(INFINITY)}) {
    for (const double reference : {0.0, 1e300, nan}) {
      const std::vector<double> modulation(4, hz), phase(4, reference), time(4, hz);
      const std::vector<std::uint8_t> yes(4, 1);
      write(folder / "odd.npz",
            files::npz_bytes({files::npy_view("raw", {4, 3, 4}, codes), files::npy_view("lit", {4}, yes),
                              files::npy_view("modulation_frequency_hz", {4}, modulation),
                              files::npy_view("reference_phase_rad", {4}, phase), files::npy_view("integration_time_s", {4}, time)}));
      const Attack result = attack(folder, {"inspect", "odd.npz", "--pixel", "1,1"});
      EXPECT_EQ(result.code, 0) << hz << " Hz, reference phase " << reference << ": " << result.err;
      EXPECT_FALSE(has(result.out, "phase  ")) << result.out;
    }
  }
}

TEST(hostile_npz, statistics_take_no_eight_bytes_for_each) {
  const Folder folder;
  const std::vector<std::uint8_t> grey(64 << 20, 3);
  write(folder / "grey.npz", files::npz_bytes({files::npy_view("grey", {8192, 8192}, grey)}));
  const Attack result = attack(folder, {"inspect", "grey.npz"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has(result.out, "uint8"));
  // The file, its entry, the array, the statistics: four times; 12 times with a double for each.
  EXPECT_LT(result.peak_bytes, most_memory(6 * (64L << 20)));
}

// Zeros pack a thousandfold: 400 kB that would be 400 MB.
TEST(hostile_npz, that_unpacks_to_more_than_the_limit_takes_no_memory_for_it) {
  const Folder folder;
  {
    const std::vector<std::uint8_t> zeros(400'000'000);
    write(folder / "bomb.npz", files::npz_bytes({files::npy_view("raw", {20000, 20000}, zeros)}, files::Packing::deflated));
  }
  ASSERT_LT(fs::file_size(folder / "bomb.npz"), 4'000'000U);
  const Attack result = attack(folder, {"inspect", "bomb.npz"});
  expect_refused(result, 4, "unpack to more than");
  EXPECT_LT(result.peak_bytes, most_memory(static_cast<long>(base::limit::unpacked_bytes.value) + (64L << 20)));
}

TEST(hostile_npz, many_keys_in_meta_end_soon) {
  const Folder folder;
  const std::string meta = "{" + repeated(100'000, [](int i) { return "\"key" + std::to_string(i) + "\":1,"; }) + "\"end\":1}";
  write(folder / "meta.npz", files::npz_bytes(small_frame(files::utf32_of(meta), std::vector<std::uint16_t>(12, 7))));
  for (const Arguments& arguments : {Arguments{"inspect", "meta.npz"}, Arguments{"inspect", "meta.npz", "--json"}})
    EXPECT_EQ(attack(folder, arguments).code, 0);
  expect_refused(attack(folder, {"process", "meta.npz"}), 2, "meta does not say which camera made it");
}

TEST(hostile_npz, text_of_meta_steers_no_terminal) {
  const Folder folder;
  const std::string meta =
      R"({"tofray": "\u001b[2J", "seed": 1, "noise": "\u001b]0;owned\u0007", "frame": 0, "units": {"raw": "\u001b[31m"},
      "scene": {"name": "a\nb\u202e", "objects": [{"name": "\u009b31m"}]}, "camera": {"name": "\u001b[1m", "mode": {"name": "\r"}}})";
  const std::vector<std::int32_t> ids(12, 0);
  const std::vector<double> ranges(12, 1);
  const std::string bytes = files::utf32_of(meta);
  const std::vector<std::uint16_t> codes(12, 7);
  std::vector<files::NpyView> views = small_frame(bytes, codes);
  views.push_back(files::npy_view("gt_object_id", {3, 4}, ids));
  views.push_back(files::npy_view("gt_range_m", {3, 4}, ranges));
  views.push_back(files::npy_view("naXme", {3, 4}, ids));
  std::string archive = files::npz_bytes(views);
  for (std::size_t at = archive.find("naXme"); at != std::string::npos; at = archive.find("naXme", at)) archive[at + 2] = '\x1b';
  write(folder / "m\x1b[5meta.npz", archive);
  for (const Arguments& arguments : {Arguments{"inspect", "m\x1b[5meta.npz"}, Arguments{"inspect", "m\x1b[5meta.npz", "--pixel", "1,1"},
                                     Arguments{"process", "m\x1b[5meta.npz"}, Arguments{"inspect", "m\x1b[5meta.npz", "--json"}}) {
    const Attack result = attack(folder, arguments);
    EXPECT_TRUE(is_printable(result.out)) << result.out;
    EXPECT_TRUE(is_printable(result.err)) << result.err;
  }
}

}  // namespace
}  // namespace tofray::test
