// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "pictures/figure.h"
#include "pictures/pictures.h"
#include "pictures/read_png.h"
#include "support/samples.h"

using namespace tofray;
using namespace tofray::pictures;
using out_test::read_back;
using out_test::ReadBack;

namespace {

/// How many pixels of a picture have a colour.
std::size_t count_of(const std::string& png, Rgb color) {
  const ReadBack back = read_back(png);
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < back.bytes.size(); i += 3)
    count += Rgb{back.bytes[i], back.bytes[i + 1], back.bytes[i + 2]} == color ? 1 : 0;
  return count;
}

/// A frame whose errors are +2 mm, but for this share of wrong cycles.
Frame with_wrong_cycles(double share) {
  Frame frame = out_test::sample_frame(100, 50);
  for (std::size_t i = 0; i < frame.depth.z_m.size(); ++i) {
    frame.truth.z_m[i] = 1.F;
    frame.depth.z_m[i] = static_cast<double>(i) < share * 5000 ? 3.4F : 1.002F;
  }
  return frame;
}

}  // namespace

TEST(preview, wrong_cycles_do_not_set_the_scale_of_errors) {
  // 3 * 2 mm is the scale's end (round_scale: 6 mm), so that 2 mm is a third of the way to red, whatever a few pixels do.
  // 5 is the enlargement of 100 columns, hence 25 pixels for each.
  for (const double share : {0.01, 0.03, 0.2}) {
    const std::size_t good = static_cast<std::size_t>((1 - share) * 5000) * 25;
    const std::size_t expected = share < 0.02 ? 0 : good;  // of 1 % the 98th percentile tells nothing: its end is 2 mm
    const Frame frame = with_wrong_cycles(share);
    EXPECT_NEAR(static_cast<double>(count_of(preview_png(frame.depth, frame.truth, frame.raw, ""), error_color(2.0 / 6))),
                static_cast<double>(expected), 60);
  }
}

TEST(preview, says_how_many_pixels_are_beyond_the_scale_of_errors) {
  // Wrong cycles are red to the end, be they 10 or 20 % of the image: only the lines below it, which end 52 + 250 + 40 pixels down, say which.
  const auto writing = [](double share) {
    const Frame frame = with_wrong_cycles(share);
    const ReadBack back = read_back(preview_png(frame.depth, frame.truth, frame.raw, ""));
    const std::size_t row = 3 * back.width;
    return std::vector<unsigned char>(back.bytes.begin() + static_cast<std::ptrdiff_t>(308 * row),
                                      back.bytes.begin() + static_cast<std::ptrdiff_t>(342 * row));
  };
  const std::vector<unsigned char> ten = writing(0.1), twenty = writing(0.2);
  ASSERT_EQ(ten.size(), twenty.size());
  std::size_t other = 0;
  for (std::size_t i = 0; i < ten.size(); i += 3) other += ten[i] != twenty[i] ? 1 : 0;
  EXPECT_GT(other, 10U);
  EXPECT_LT(other, 300U) << "a digit";
}

TEST(preview, and_the_sheet_of_raw_frames_keep_a_margin_all_round) {
  const Frame frame = out_test::sample_frame(64, 48);
  const auto written = [](const std::string& png, int border, int right) {  // what is written within the margin
    const ReadBack back = read_back(png);
    const auto width = static_cast<int>(back.width), height = static_cast<int>(back.height);
    int count = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (x >= border && x < width - right && y >= border && y < height - border) continue;
        const std::size_t at = 3 * static_cast<std::size_t>(y * width + x);
        count += back.bytes[at] != back.bytes[0] || back.bytes[at + 1] != back.bytes[1] || back.bytes[at + 2] != back.bytes[2] ? 1 : 0;
      }
    return count;
  };
  EXPECT_EQ(written(preview_png(frame.depth, frame.truth, frame.raw, "Scene of a ball"), 8, 8), 0);
  EXPECT_EQ(written(raw_png(frame.raw), 8, 24), 0);
}

TEST(preview, has_a_caption_as_long_as_the_picture_is_wide) {
  const Frame frame = out_test::sample_frame(700, 4);  // three images side by side, wider than any ordinary caption
  const std::string caption(110, 'm');
  const double needed = Canvas::text_width(figure::title_size, caption);
  const ReadBack back = read_back(preview_png(frame.depth, frame.truth, frame.raw, caption));
  ASSERT_GT(needed, 1600);
  ASSERT_LT(needed, back.width);
  std::size_t last = 0;  // column that something is written in, in the caption's line
  for (std::size_t y = 26; y < 40; ++y)
    for (std::size_t x = 0; x < back.width; ++x)
      if (back.bytes[3 * (y * back.width + x)] != back.bytes[0]) last = std::max(last, x);
  EXPECT_NEAR(static_cast<double>(last), figure::margin + needed, 10);
}

TEST(preview, wrong_cycles_do_not_set_the_scale_of_z) {
  // Of 100 columns a tenth is a cycle off; the others run from 1 to 2 m, whose middle is the middle of all colours.
  Frame frame = out_test::sample_frame(100, 50);
  ASSERT_GT(*std::max_element(frame.raw.modulation_frequency_hz.begin(), frame.raw.modulation_frequency_hz.end()), 5e7);
  for (std::size_t i = 0; i < frame.depth.z_m.size(); ++i) {
    frame.truth.z_m[i] = i % 100 == 50 ? 1.5F : i % 2 == 0 ? 1.F : 2.F;
    frame.depth.z_m[i] = i % 100 < 10 ? 9.F : frame.truth.z_m[i];
  }
  const auto middle = [&](const Truth& truth) { return count_of(preview_png(frame.depth, truth, frame.raw, ""), depth_color(0.5)); };
  EXPECT_NEAR(static_cast<double>(middle(frame.truth)), 50 * 25, 60);
  EXPECT_LT(middle({}), 100U);  // without truth nobody knows
}

TEST(preview, has_room_for_long_numbers_beside_its_bars) {
  Frame frame = out_test::sample_frame(64, 48);
  for (float& amplitude : frame.depth.amplitude_e) amplitude *= 1e6F;
  frame.truth = {};
  frame.depth.noise_m.assign(frame.depth.noise_m.size(), 1e6F);  // the last panel's numbers stand at the picture's edge
  frame.depth.noise_m[0] = 0;
  const ReadBack back = read_back(preview_png(frame.depth, frame.truth, frame.raw, ""));
  int written = 0;
  for (std::size_t y = 0; y < back.height; ++y)
    for (std::size_t x = back.width - 8; x < back.width; ++x) {
      const std::size_t at = 3 * (y * back.width + x);
      written += back.bytes[at] != back.bytes[0] || back.bytes[at + 1] != back.bytes[1] ? 1 : 0;
    }
  EXPECT_EQ(written, 0);
}

TEST(preview, no_two_reasons_look_alike) {
  // Differences summed over the channels. 163 and 120 between the greys of "low signal" and "no return" were too little for a reader.
  const auto apart = [](Rgb a, Rgb b) { return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue); };
  for (const Theme theme : {Theme::dark, Theme::light}) {
    const auto color = [&](std::uint16_t flag) { return color_of_reason(*invalid_reason(flag | flag_rejected), theme); };
    const std::uint16_t reasons[] = {flag_saturated,
                                     flag_low_signal,
                                     flag_flying_pixel,
                                     flag_no_return,
                                     flag_outside_lens,
                                     flag_inconsistent_phases,
                                     flag_inconsistent_frequencies};
    for (const std::uint16_t a : reasons)
      for (const std::uint16_t b : reasons)
        if (a != b) EXPECT_GE(apart(color(a), color(b)), 60) << a << " " << b;
    EXPECT_GE(apart(color(flag_low_signal), color(flag_no_return)), 200);
    EXPECT_GE(apart(color(flag_no_return), color(flag_outside_lens)), 120);
  }
}

TEST(preview, and_raw_frames_have_as_many_times_the_pixels_as_asked_for) {
  const Frame frame = out_test::sample_frame(64, 48);
  const auto size = [](const std::string& png) { return std::pair(read_back(png).width, read_back(png).height); };
  const auto one = size(preview_png(frame.depth, frame.truth, frame.raw, "x")),
             two = size(preview_png(frame.depth, frame.truth, frame.raw, "x", Theme::dark, 2));
  EXPECT_EQ(two, std::pair(2 * one.first, 2 * one.second));
  const auto raw = size(raw_png(frame.raw)), three = size(raw_png(frame.raw, Theme::dark, 3));
  EXPECT_EQ(three, std::pair(3 * raw.first, 3 * raw.second));
  // Each pixel of the images is four now.
  const auto painted = [&](int scale) {
    const Frame wrong = with_wrong_cycles(0.2);
    return static_cast<double>(count_of(preview_png(wrong.depth, wrong.truth, wrong.raw, "", Theme::dark, scale), error_color(2.0 / 6)));
  };
  EXPECT_GT(painted(1), 1e5 - 100);
  EXPECT_NEAR(painted(2), 4 * painted(1), 400);
}

TEST(preview, invalid_pixels_have_the_colour_of_their_reason) {
  Frame frame = out_test::sample_frame(100, 50);
  std::fill(frame.depth.flags.begin(), frame.depth.flags.end(), std::uint16_t{0});
  const std::uint16_t flags[] = {flag_saturated | flag_low_signal,
                                 flag_low_signal | flag_flying_pixel,
                                 flag_flying_pixel,
                                 flag_no_return | flag_low_signal,
                                 flag_outside_lens | flag_saturated,
                                 flag_rejected | flag_inconsistent_phases,
                                 flag_rejected | flag_inconsistent_frequencies};
  for (std::size_t i = 0; i < frame.depth.z_m.size(); ++i) {
    frame.depth.z_m[i] = 1.F;
    if (i / 100 >= 7) continue;
    frame.depth.z_m[i] = out_test::nan_f;
    frame.depth.flags[i] = flags[i / 100];
  }
  frame.truth = {};
  frame.depth.noise_m.assign(frame.depth.noise_m.size(), 0.001F);
  for (const Theme theme : {Theme::dark, Theme::light}) {
    std::string legend = preview_png(frame.depth, frame.truth, frame.raw, "", theme);
    // 100 pixels of each reason, 5 times enlarged, and the legend's square of 11 x 11 with what letters' edges add
    for (const std::uint16_t one : flags) {
      const Rgb reason = color_of_reason(*invalid_reason(one), theme);
      EXPECT_NEAR(static_cast<double>(count_of(legend, reason)), 100 * 25 + 121, 60) << static_cast<int>(reason.red);
    }
    Depth valid = frame.depth;
    std::fill(valid.flags.begin(), valid.flags.end(), std::uint16_t{0});
    EXPECT_LT(read_back(preview_png(valid, {}, {}, "", theme)).height, read_back(legend).height);  // no legend where nothing is to tell
  }
}

TEST(preview, shows_multipath_beside_the_error_where_light_bounced) {
  Frame frame = with_wrong_cycles(0);
  frame.depth.z_m = frame.truth.z_m;  // no other error
  frame.truth.multipath_m.clear();
  const std::size_t pixels = frame.depth.z_m.size(), raw_frames = frame.raw.lit.size();
  const auto width = read_back(preview_png(frame.depth, frame.truth, frame.raw, "")).width;
  frame.truth.multipath_m.assign(pixels * raw_frames, out_test::nan_f);
  // Of the first lit raw frame: +10 mm at the left, -5 mm at the right. Others, of another modulation frequency, do not count.
  const auto first = static_cast<std::size_t>(std::find(frame.raw.lit.begin(), frame.raw.lit.end(), 1) - frame.raw.lit.begin());
  ASSERT_GT(first, 0U);
  for (std::size_t k = first; k < raw_frames; ++k)
    for (std::size_t i = 0; i < pixels; ++i) frame.truth.multipath_m[k * pixels + i] = k > first ? 0.1F : i % 100 < 50 ? 0.01F : -0.005F;
  const std::string with = preview_png(frame.depth, frame.truth, frame.raw, "");
  EXPECT_EQ(3 * (read_back(with).width - figure::margin), 4 * (width - figure::margin));
  // 5 is the enlargement, and 10 mm the scale's end. (The bar shows its colours, too.)
  EXPECT_NEAR(static_cast<double>(count_of(with, error_color(1))), 2500 * 25, 200);
  EXPECT_NEAR(static_cast<double>(count_of(with, error_color(-0.5))), 2500 * 25, 200);
  // Without any light nothing is known, and of another sequence nothing is shown.
  frame.raw.lit.assign(raw_frames, 0);
  EXPECT_EQ(read_back(preview_png(frame.depth, frame.truth, frame.raw, "")).width, read_back(with).width);
  frame.raw.lit.pop_back();
  EXPECT_EQ(read_back(preview_png(frame.depth, frame.truth, frame.raw, "")).width, width);
}

TEST(preview, light_theme_is_dark_on_white) {
  const Frame frame = out_test::sample_frame(48, 32);
  for (const std::string& png : {preview_png(frame.depth, frame.truth, frame.raw, "x", Theme::light), raw_png(frame.raw, Theme::light)}) {
    const ReadBack back = read_back(png);
    EXPECT_EQ(back.bytes[0], 255);
    EXPECT_EQ(count_of(png, figure::background), 0U);
    EXPECT_GT(count_of(png, {255, 255, 255}), back.bytes.size() / 3 / 4);
  }
}

TEST(raw_sheet, sunlight_in_the_unlit_frame_does_not_blacken_the_lit_ones) {
  Frame frame = out_test::sample_frame(60, 40);
  const std::size_t pixels = 60 * 40;
  for (std::size_t i = 0; i < frame.raw.raw.size(); ++i)
    frame.raw.raw[i] = static_cast<std::uint16_t>(i < pixels ? 3400 + i % 60 : 2000 + i % 60);
  // The lit frames' 2000 … 2059 go from dark to white: 2059 is nearly white in each of the eight, 25 pixels for one.
  const ReadBack back = read_back(raw_png(frame.raw));
  std::size_t bright = 0;
  for (std::size_t i = 0; i + 2 < back.bytes.size(); i += 3) bright += back.bytes[i] > 190 && back.bytes[i] == back.bytes[i + 1] ? 1 : 0;
  EXPECT_GT(bright, 8U * pixels * 25 / 6);
}

TEST(pictures, of_any_shape_have_room_for_their_scale_bars) {
  for (const auto& [width, height] : {std::pair{16, 12}, {4, 4}, {512, 2}, {3, 200}}) {
    const Frame frame = out_test::sample_frame(width, height);
    EXPECT_GT(read_back(preview_png(frame.depth, frame.truth, frame.raw, "x")).height, 190U) << width;
    EXPECT_GT(read_back(raw_png(frame.raw)).height, 130U) << width;
  }
}
