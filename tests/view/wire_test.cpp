// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/wire.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pictures/color_map.h"
#include "tofray/tofray.h"
#include "view/scales.h"
#include "view/viewer.h"

namespace tofray::test {
namespace {

/// Of known numbers: 3 x 2 pixels, 2 raw frames.
Frame small_frame() {
  Frame frame;
  frame.index = 0x1122334455667788;
  frame.raw.width = frame.depth.width = frame.truth.width = 3, frame.raw.height = frame.depth.height = frame.truth.height = 2;
  frame.raw.phases = frame.truth.phases = 2;
  frame.raw.raw = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  frame.raw.lit = {1, 0};
  frame.depth.z_m = {1.5f, NAN, 3, 4, 5, 6};
  frame.depth.confidence = {1, 2, 3, 4, 5, 255};
  frame.truth.z_m = {1.25f, 2, 3, 4, 5, 6};
  frame.truth.position_m.assign(18, 2.5f);
  return frame;
}

TEST(wire, has_head_rows_and_bytes_where_the_protocol_says) {
  const Frame frame = small_frame();
  std::vector<std::uint16_t> arrays;
  for (const char* name : {"z_m", "confidence", "raw", "lit", "gt_position_m", "flags"}) arrays.push_back(*view::find_wire_array(name));
  const std::string bytes = view::encoded({0, 0, 7, 9, 0.25, 1.5f}, frame, arrays);
  EXPECT_EQ(bytes.substr(0, 4), "TFV1");
  EXPECT_EQ(little<std::uint16_t>(bytes, 4), 64);
  EXPECT_EQ(little<std::uint32_t>(bytes, 8), 7u);
  EXPECT_EQ(little<std::uint32_t>(bytes, 12), 9u);
  EXPECT_EQ(little<std::uint64_t>(bytes, 16), frame.index);
  EXPECT_EQ(little<double>(bytes, 24), 0.25);
  EXPECT_EQ(little<std::uint32_t>(bytes, 32), 3u);
  EXPECT_EQ(little<std::uint32_t>(bytes, 36), 2u);
  EXPECT_EQ(little<std::uint16_t>(bytes, 40), 2);
  EXPECT_EQ(little<std::uint16_t>(bytes, 42), 1);
  EXPECT_EQ(little<std::uint16_t>(bytes, 44), 5);  // the frame has no flags
  EXPECT_EQ(little<float>(bytes, 48), 1.5f);
  struct Row {
    int type, rank;
    std::uint32_t bytes, extents[3];
  };
  const Row rows[] = {{5, 2, 24, {2, 3, 0}}, {1, 2, 6, {2, 3, 0}}, {2, 3, 24, {2, 2, 3}}, {1, 1, 2, {2, 0, 0}}, {5, 3, 72, {2, 3, 3}}};
  std::size_t before = 64 + 5 * 32;
  for (std::size_t i = 0; i < 5; ++i) {
    const std::size_t at = 64 + 32 * i;
    EXPECT_EQ(little<std::uint16_t>(bytes, at), arrays[i]);
    EXPECT_EQ(bytes[at + 2], rows[i].type);
    EXPECT_EQ(bytes[at + 3], rows[i].rank);
    const auto place = little<std::uint32_t>(bytes, at + 4);
    EXPECT_EQ(place % 8, 0u);
    EXPECT_GE(place, before);
    EXPECT_LT(place, before + 8);
    before = place + rows[i].bytes;
    EXPECT_EQ(little<std::uint32_t>(bytes, at + 8), rows[i].bytes);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(little<std::uint32_t>(bytes, at + 12 + 4 * k), rows[i].extents[k]) << i << " " << k;
    EXPECT_EQ(little<std::uint64_t>(bytes, at + 24), 0u);
  }
  EXPECT_EQ(bytes.size(), before);
  const WireFrame read = wire_frame(bytes);
  EXPECT_EQ(read.arrays.at(arrays[2]), std::string(reinterpret_cast<const char*>(frame.raw.raw.data()), 24));
}

TEST(wire, of_an_answer_numbers_its_arrays_from_zero) {
  const std::vector<float> rays{1, 2, 3, 4, 5, 6}, none;
  const std::vector<std::uint32_t> owners{7, 8, 9};
  const view::StaticArray arrays[] = {
      {5, {rays.data(), 24, 3, {1, 3, 2}}}, {5, {none.data(), 0, 3, {0, 3, 3}}}, {4, {owners.data(), 12, 1, {3}}}};
  const std::string bytes = view::encoded({3, 0, 7, 9, 0.25, 0}, 11, 3, 1, arrays);
  EXPECT_EQ(bytes[6], 3);
  EXPECT_EQ(little<std::uint32_t>(bytes, 8), 7u);
  EXPECT_EQ(little<std::uint32_t>(bytes, 12), 9u);
  EXPECT_EQ(little<std::uint64_t>(bytes, 16), 11u);
  EXPECT_EQ(little<std::uint32_t>(bytes, 32), 3u);
  EXPECT_EQ(little<std::uint32_t>(bytes, 36), 1u);
  EXPECT_EQ(little<std::uint16_t>(bytes, 40), 0);
  ASSERT_EQ(little<std::uint16_t>(bytes, 44), 3);
  for (std::uint16_t i = 0; i < 3; ++i) EXPECT_EQ(little<std::uint16_t>(bytes, 64 + 32u * i), i);
  EXPECT_EQ(bytes[64 + 2], 5);
  EXPECT_EQ(bytes[64 + 3], 3);
  EXPECT_EQ(little<std::uint32_t>(bytes, 64 + 16), 3u);
  EXPECT_EQ(bytes[64 + 64 + 2], 4);
  EXPECT_EQ(little<std::uint32_t>(bytes, 64 + 64 + 12), 3u);
  const WireFrame read = wire_frame(bytes);
  EXPECT_EQ(numbers_of<float>(read.arrays.at(0)), rays);
  EXPECT_EQ(read.arrays.at(1), "");
  EXPECT_EQ(numbers_of<std::uint32_t>(read.arrays.at(2)), owners);
}

TEST(wire, error_is_what_is_measured_less_what_is_true) {
  const Frame frame = small_frame();
  const std::uint16_t error = *view::find_wire_array("z_error_m");
  const WireFrame read = wire_frame(view::encoded({}, frame, std::vector<std::uint16_t>{error}));
  EXPECT_EQ(little<float>(read.arrays.at(error), 0), 0.25f);
  EXPECT_TRUE(std::isnan(little<float>(read.arrays.at(error), 4)));
  EXPECT_EQ(little<float>(read.arrays.at(error), 8), 0.0f);
  EXPECT_EQ(view::pixel_values(frame, error, 0), std::vector<double>{0.25});
  EXPECT_EQ(view::sources_of(std::vector<std::uint16_t>{error, *view::find_wire_array("z_m")}),
            (std::vector<std::string>{"z_m", "gt_z_m"}));
}

TEST(wire, pixel_has_all_its_values) {
  const Frame frame = small_frame();
  EXPECT_EQ(view::pixel_values(frame, *view::find_wire_array("raw"), 4), (std::vector<double>{5, 11}));
  EXPECT_EQ(view::pixel_values(frame, *view::find_wire_array("confidence"), 5), std::vector<double>{255});
  EXPECT_EQ(view::pixel_values(frame, *view::find_wire_array("gt_position_m"), 1), (std::vector<double>{2.5, 2.5, 2.5}));
  EXPECT_TRUE(view::pixel_values(frame, *view::find_wire_array("lit"), 0).empty());
  EXPECT_TRUE(view::pixel_values(frame, *view::find_wire_array("flags"), 0).empty());
}

/// The colour that a page makes of stops, as the protocol says it.
pictures::Rgb of_stops(const files::Json& stops, double t) {
  const auto& all = *stops.items();
  const double at = std::min(1.0, std::max(0.0, t)) * static_cast<double>(all.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), all.size() - 2);
  std::uint8_t channels[3];
  for (std::size_t k = 0; k < 3; ++k) {
    double x = 0, y = 0;
    (*all[i].items())[k].number(x), (*all[i + 1].items())[k].number(y);
    channels[k] = static_cast<std::uint8_t>(std::floor(x + (at - static_cast<double>(i)) * (y - x) + 0.5));
  }
  return {channels[0], channels[1], channels[2]};
}

TEST(palettes, are_those_of_the_pictures) {
  const files::Json all = view::palettes_json();
  for (int i = -20; i <= 1020; ++i) {
    const double t = i / 1000.0;
    EXPECT_EQ(of_stops(*all.find("depth"), t), pictures::depth_color(t)) << t;
    EXPECT_EQ(of_stops(*all.find("grey"), t), pictures::grey_color(t)) << t;
    if (t < 0) continue;
    EXPECT_EQ(of_stops(*all.find("error_far"), t), pictures::error_color(t)) << t;
    EXPECT_EQ(of_stops(*all.find("error_near"), t), pictures::error_color(-t)) << t;
  }
}

TEST(scales, hold_the_values_and_say_how) {
  const Frame frame = Simulator(load_scene("demo"), load_camera("pico-flexx"), {.seed = 1}).frame(0);
  for (const view::Pane& one : view::panes_of(frame)) {
    const auto scale = view::scale_json(frame, one.array);
    ASSERT_TRUE(scale) << one.array;
    if (std::string(one.array) == "flags") {
      EXPECT_TRUE(scale->is_null());
      continue;
    }
    const double low = number_in(*scale, "low"), high = number_in(*scale, "high"), factor = number_in(*scale, "factor");
    EXPECT_LT(low, high) << one.array;
    EXPECT_GE(scale->find("ticks")->items()->size(), 3u) << one.array;
    for (const files::Json& tick : *scale->find("ticks")->items()) {
      EXPECT_GE(number_in(tick, "at"), low - 1e-9 * (high - low));
      EXPECT_LE(number_in(tick, "at"), high + 1e-9 * (high - low));
    }
    EXPECT_EQ(*scale->find("unit")->string() == view::wire_arrays()[*view::find_wire_array(one.array)].unit, factor == 1) << one.array;
  }
  EXPECT_FALSE(view::scale_json(frame, "gt_object_id"));
  EXPECT_EQ(number_in(*view::scale_json(frame, "z_error_m"), "low"), -number_in(*view::scale_json(frame, "z_error_m"), "high"));
}

}  // namespace
}  // namespace tofray::test
