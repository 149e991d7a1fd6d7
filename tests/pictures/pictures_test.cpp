// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "pictures/canvas.h"
#include "pictures/color_map.h"
#include "pictures/figure.h"
#include "pictures/picture_scale.h"
#include "pictures/pictures.h"
#include "pictures/png_file.h"
#include "pictures/read_png.h"
#include "pictures/terminal_picture.h"
#include "results/ply.h"
#include "support/samples.h"

using namespace tofray;
using namespace tofray::pictures;
using out_test::Python;
using out_test::read_back;
using out_test::ReadBack;
using out_test::TemporaryFolder;
using tofray::results::cloud_ply;

TEST(png_file, all_codes_come_back_exactly) {
  std::vector<std::uint8_t> eight;
  for (int i = 0; i < 256; ++i) eight.push_back(static_cast<std::uint8_t>(i));
  const ReadBack grey8 = read_back(png_grey8(32, 8, eight));
  EXPECT_EQ(grey8.bits, 8);
  EXPECT_EQ(grey8.color_type, PNG_COLOR_TYPE_GRAY);
  EXPECT_TRUE(std::equal(eight.begin(), eight.end(), grey8.bytes.begin()));
  std::vector<std::uint16_t> sixteen;
  for (int i = 0; i < 65536; ++i) sixteen.push_back(static_cast<std::uint16_t>(i));
  const ReadBack grey16 = read_back(png_grey16(256, 256, sixteen));
  EXPECT_EQ(grey16.bits, 16);
  EXPECT_FALSE(grey16.extra_chunks);
  for (std::size_t i = 0; i < sixteen.size(); ++i) ASSERT_EQ(grey16.bytes[2 * i] << 8 | grey16.bytes[2 * i + 1], sixteen[i]);
  const ReadBack rgb = read_back(png_rgb8(2, 1, {1, 2, 3, 253, 254, 255}));
  EXPECT_EQ(rgb.color_type, PNG_COLOR_TYPE_RGB);
  EXPECT_EQ(rgb.bytes, (std::vector<unsigned char>{1, 2, 3, 253, 254, 255}));
}

TEST(png_file, pixels_that_do_not_fit_the_size_are_a_fault_of_ours) {
  EXPECT_EQ(out_test::error_of([] { (void)png_grey8(3, 3, std::vector<std::uint8_t>(8)); }).kind(), ErrorKind::bug);
}

TEST(depth_png, holds_z_in_millimetres_and_0_where_there_is_none) {
  Depth depth;
  depth.width = 8;
  depth.height = 1;
  depth.z_m = {1.0F, 1.2344F, 1.2346F, out_test::nan_f, 65.535F, 65.6F, 0.0004F, -1.F};
  const ReadBack back = read_back(depth_png(depth));
  const std::vector<int> expected = {1000, 1234, 1235, 0, 65535, 0, 0, 0};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(back.bytes[2 * i] << 8 | back.bytes[2 * i + 1], expected[i]) << i;
}

TEST(depth_png, agrees_with_pillow) {
  const Python python;
  if (!python.there() || !python.has("PIL")) GTEST_SKIP() << "no /usr/bin/python3 with numpy and PIL";
  TemporaryFolder folder;
  const Frame frame = out_test::sample_frame(48, 32);
  out_test::write_file(folder.file("depth.png"), depth_png(frame.depth));
  out_test::write_file(folder.file("z.bin"), {reinterpret_cast<const char*>(frame.depth.z_m.data()), 4 * frame.depth.z_m.size()});
  out_test::write_file(folder.file("preview.png"), preview_png(frame.depth, frame.truth, frame.raw, "caption"));
  EXPECT_EQ(python.run(R"py(
import sys, numpy as np
from PIL import Image
z = np.fromfile(sys.argv[1] + '/z.bin', 'f4').reshape(32, 48)
image = Image.open(sys.argv[1] + '/depth.png')
assert image.size == (48, 32) and image.mode.startswith('I')
expected = np.where(np.isnan(z), 0, np.floor(np.nan_to_num(z).astype('f8') * 1000 + 0.5))
assert np.array_equal(np.array(image).astype('f8'), expected)
assert Image.open(sys.argv[1] + '/preview.png').mode == 'RGB'
)py",
                       folder.path().string()),
            0);
}

TEST(amplitude_png, square_root_of_the_share_of_the_brightest) {
  Depth depth;
  depth.width = 400;
  depth.height = 1;
  depth.amplitude_e.assign(400, 100.F);
  depth.amplitude_e[0] = 25.F;
  depth.amplitude_e[1] = 0.F;
  depth.amplitude_e[2] = 1e6F;  // one pixel of glare does not darken the rest
  depth.amplitude_e[3] = out_test::nan_f;
  const ReadBack back = read_back(amplitude_png(depth));
  EXPECT_EQ(back.bytes[0], 128);
  EXPECT_EQ(back.bytes[1], 0);
  EXPECT_EQ(back.bytes[2], 255);
  EXPECT_EQ(back.bytes[3], 0);
  EXPECT_EQ(back.bytes[4], 255);
}

TEST(pictures, have_the_same_bytes_each_time_and_survive_empty_frames) {
  const Frame frame = out_test::sample_frame(48, 32);
  EXPECT_EQ(preview_png(frame.depth, frame.truth, frame.raw, "a"), preview_png(frame.depth, frame.truth, frame.raw, "a"));
  EXPECT_NE(preview_png(frame.depth, frame.truth, frame.raw, "a"), preview_png(frame.depth, frame.truth, frame.raw, "b"));
  EXPECT_NE(preview_png(frame.depth, {}, frame.raw, "a"), preview_png(frame.depth, frame.truth, frame.raw, "a"));
  Frame dark = frame;
  for (auto* map : {&dark.depth.z_m, &dark.depth.noise_m}) map->assign(map->size(), out_test::nan_f);
  dark.depth.amplitude_e.assign(dark.depth.amplitude_e.size(), 0.F);
  EXPECT_GT(read_back(preview_png(dark.depth, dark.truth, dark.raw, "")).width, 1000U);
  EXPECT_GT(read_back(preview_png(dark.depth, {}, dark.raw, "")).width, 1000U);
  // taps only, one pixel only
  Frame one = out_test::sample_frame(1, 1);
  one.raw.raw.clear();
  EXPECT_GT(read_back(raw_png(one.raw)).height, 3U);
  EXPECT_GT(read_back(preview_png(one.depth, one.truth, one.raw, "")).width, 3U);
}

TEST(preview, shows_each_image_s_pixels_as_squares_in_the_map_s_colour) {
  // a wall of two depths: the picture holds both colours in the right share
  Frame frame = out_test::sample_frame(64, 48);
  for (std::size_t i = 0; i < frame.depth.z_m.size(); ++i) frame.depth.z_m[i] = i % 64 < 16 ? 1.F : i % 64 < 32 ? out_test::nan_f : 2.F;
  std::fill(frame.depth.flags.begin(), frame.depth.flags.end(), std::uint16_t{0});  // of no reason that a legend would name
  const ReadBack back = read_back(preview_png(frame.depth, frame.truth, frame.raw, ""));
  std::size_t near = 0, far = 0, invalid = 0;
  for (std::size_t i = 0; i + 2 < back.bytes.size(); i += 3) {
    const Rgb color{back.bytes[i], back.bytes[i + 1], back.bytes[i + 2]};
    near += color == depth_color(0) ? 1 : 0;
    far += color == depth_color(1) ? 1 : 0;
    invalid += color == invalid_color ? 1 : 0;
  }
  // scale 7; the bar adds a few pixels of its ends' colours, labels' edges a few of any
  const std::size_t quarter = 16 * 48 * 49;
  EXPECT_NEAR(static_cast<double>(near), static_cast<double>(quarter), 60);
  EXPECT_NEAR(static_cast<double>(far), static_cast<double>(2 * quarter), 60);
  std::size_t none = 0;  // in z, and in the error map, where the truth's own gap comes on top
  for (std::size_t i = 0; i < frame.depth.z_m.size(); ++i)
    none += (std::isnan(frame.depth.z_m[i]) ? 1U : 0U) + (std::isnan(frame.depth.z_m[i] - frame.truth.z_m[i]) ? 1U : 0U);
  EXPECT_NEAR(static_cast<double>(invalid), static_cast<double>(49 * none), 60);
}

TEST(scale_bar, has_a_mark_and_a_label_at_each_tick) {
  const Look& look = look_of(Theme::dark);
  const PictureScale scale = round_scale(1.0, 2.0, 0.1);
  const ValueColors colors{scale, [&](double z) { return depth_color(scale.at(z)); }, [&](double z) { return scale.at(z); }};
  CanvasPainter painter(150, 340, look.background);
  draw_scale_bar(painter, 20, 20, 300, colors, look);
  const Canvas& canvas = painter.canvas();
  const auto color = [&](int x, int y) {
    const std::size_t at = 3 * static_cast<std::size_t>(150 * y + x);
    return Rgb{canvas.pixels()[at], canvas.pixels()[at + 1], canvas.pixels()[at + 2]};
  };
  ASSERT_GE(scale.ticks().size(), 3U);
  for (const double tick : scale.ticks()) {
    const int line = std::clamp(static_cast<int>(20 + 300 * (1 - scale.at(tick))), 20, 319);
    EXPECT_EQ(color(20 + figure::bar_width, line), look.faint_ink) << tick;
    int written = 0;  // as high as the label's letters, behind the mark
    for (int y = line - 6; y <= line + 6; ++y)
      for (int x = 20 + figure::bar_width + 8; x < 130; ++x) written += color(x, y) == look.background ? 0 : 1;
    EXPECT_GT(written, 20) << tick;
  }
  EXPECT_EQ(color(25, 20), depth_color(scale.at(scale.high - (scale.high - scale.low) * 0.5 / 300)));
  EXPECT_EQ(color(25, 319), depth_color(scale.at(scale.low + (scale.high - scale.low) * 0.5 / 300)));
}

TEST(picture_scale, steps_by_1_2_or_5_of_the_power_below_a_fifth) {
  for (const auto& [span, step] : {std::pair(5.0, 1.0),
                                   {7.4, 1.0},
                                   {7.6, 2.0},
                                   {15.9, 2.0},
                                   {16.1, 5.0},
                                   {34.9, 5.0},
                                   {35.1, 10.0},
                                   {50.0, 10.0},
                                   {54.0, 10.0},
                                   {75.1, 20.0},
                                   {0.5, 0.1},
                                   {0.054, 0.01},
                                   {5e5, 1e5},
                                   {5.2e5, 1e5}})
    EXPECT_NEAR(round_scale(0, span, 1e-9).step, step, 1e-9 * step) << span;
}

TEST(picture_scale, ends_and_ticks_are_round) {
  const PictureScale room = round_scale(1.031, 2.351, 0.1);
  EXPECT_DOUBLE_EQ(room.low, 1.0);
  EXPECT_DOUBLE_EQ(room.high, 2.4);
  EXPECT_DOUBLE_EQ(room.step, 0.2);
  EXPECT_EQ(room.label(1.2), "1.2");
  EXPECT_EQ(room.ticks().size(), 8U);
  const PictureScale wall = round_scale(1.0, 1.0, 0.1);
  EXPECT_DOUBLE_EQ(wall.low, 0.95);
  EXPECT_DOUBLE_EQ(wall.high, 1.05);
  EXPECT_EQ(wall.label(-0.02),
            "\xE2\x88\x92"
            "0.02");
  EXPECT_EQ(wall.label(-0.0), "0.00");
  EXPECT_EQ(round_scale(0, 150'000, 1).label(150'000), "150 000");
  EXPECT_EQ(round_scale(0, 15'000, 1).label(-1000),
            "\xE2\x88\x92"
            "1 000");
  for (double span = 1e-6; span < 1e7; span *= 1.7) {
    const PictureScale scale = round_scale(-0.3 * span, 0.7 * span, 0);
    EXPECT_LE(scale.low, -0.3 * span * (1 - 1e-6));
    EXPECT_GE(scale.high, 0.7 * span * (1 - 1e-6));
    EXPECT_LE(scale.high - scale.low, 1.5 * span);
    EXPECT_GE(scale.ticks().size(), 3U) << span;
    EXPECT_LE(scale.ticks().size(), 9U) << span;
    std::set<std::string> labels;
    for (const double tick : scale.ticks()) labels.insert(scale.label(tick));
    EXPECT_EQ(labels.size(), scale.ticks().size()) << span;
  }
}

TEST(picture_scale, percentile_leaves_out_what_is_not_finite) {
  EXPECT_EQ(percentile({5, std::nan(""), 1, 3, 2, 4, INFINITY}, 0.5, -1), 3);
  EXPECT_EQ(percentile({std::nan("")}, 0.5, -1), -1);
  EXPECT_EQ(percentile({1, 2, 3}, 1, 0), 3);
}

TEST(color_map, is_ever_darker_with_distance_and_symmetrical_in_the_error) {
  const auto luma = [](Rgb c) { return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue; };
  for (int i = 1; i <= 200; ++i) EXPECT_LE(luma(depth_color(i / 200.0)), luma(depth_color((i - 1) / 200.0)) + 0.6) << i;
  for (int i = 0; i <= 20; ++i) EXPECT_NEAR(luma(error_color(i / 20.0)), luma(error_color(-i / 20.0)), 22) << i;
  EXPECT_EQ(depth_color(-5), depth_color(0));
  EXPECT_EQ(depth_color(NAN), depth_color(0));
  EXPECT_EQ(depth_color(7), depth_color(1));
  EXPECT_EQ(error_color(0), (Rgb{239, 239, 239}));
}

namespace {

/// How many pixels of a part of a canvas are not its background, which is black.
std::size_t drawn(const Canvas& canvas, int left, int top, int right, int bottom) {
  std::size_t count = 0;
  for (int v = top; v < bottom; ++v)
    for (int u = left; u < right; ++u) {
      const std::size_t at = 3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(canvas.width()) + static_cast<std::size_t>(u));
      count += canvas.pixels()[at] != 0 || canvas.pixels()[at + 1] != 0 || canvas.pixels()[at + 2] != 0 ? 1 : 0;
    }
  return count;
}

}  // namespace

TEST(canvas, writes_from_the_left_edge_on_and_above_the_baseline) {
  const char* const text = "80 MHz";
  const double width = Canvas::text_width(12, text);
  EXPECT_GT(width, 6 * 12 * 0.4);
  EXPECT_LT(width, 6 * 12 * 2.0);
  EXPECT_GT(Canvas::text_width(24, text), 1.9 * width);
  EXPECT_GT(Canvas::text_width(12, "80 MHz and more"), width);
  EXPECT_EQ(Canvas::text_width(12, ""), 0);
  Canvas canvas(200, 60, {0, 0, 0});
  canvas.text(50, 40, 12, {255, 200, 100}, text);
  const int end = 50 + static_cast<int>(width) + 2;
  EXPECT_GT(drawn(canvas, 50, 26, end, 41), 60U);
  // A pixel of room for edges; nothing elsewhere.
  EXPECT_EQ(drawn(canvas, 0, 0, 200, 60), drawn(canvas, 49, 26, end, 41));
}

TEST(canvas, writes_any_bytes) {
  for (const char* text : {"\xC2\xB5\xFF\xE2\x88", "a\nb\tc\x01", "\xE6\x9D\xB1", "\xF0\x9F\x98\x80"}) {
    Canvas canvas(200, 40, {0, 0, 0});
    canvas.text(10, 30, 12, {255, 255, 255}, text);
    EXPECT_GT(drawn(canvas, 0, 0, 200, 40), 0U) << text;
    EXPECT_GT(Canvas::text_width(12, text), 0) << text;
  }
}

TEST(canvas, may_be_wider_than_what_cairo_draws_on) {
  Canvas canvas(40'000, 20, {0, 0, 0});
  canvas.text(39'900, 15, 9, {255, 255, 255}, "right");
  canvas.stroke({{39'990, 10}, {39'999, 10}}, 2, {255, 255, 255});
  EXPECT_GT(drawn(canvas, 39'900, 0, 39'980, 20), 20U);
  EXPECT_GT(drawn(canvas, 39'985, 0, 40'000, 20), 10U);
  EXPECT_EQ(drawn(canvas, 0, 0, 39'890, 20), 0U);
}

TEST(canvas, draws_nothing_outside_itself) {
  Canvas canvas(20, 10, {1, 2, 3});
  canvas.fill(-5, -5, 3, 3, {255, 0, 0});
  canvas.fill(18, 8, 10, 10, {255, 0, 0});
  canvas.text(-300, 40, 12, {255, 0, 0}, "far away");
  canvas.disc({-9, 5}, 3, {255, 0, 0});
  canvas.stroke({{5, 30}, {50, 40}}, 3, {255, 0, 0});
  std::size_t red = 0;
  for (std::size_t i = 0; i < canvas.pixels().size(); i += 3) red += canvas.pixels()[i] == 255 ? 1 : 0;
  EXPECT_EQ(red, 4U);
}

TEST(ply, holds_the_valid_points_and_projects_back_to_their_pixels) {
  const Frame frame = out_test::sample_frame(48, 32);
  const Camera camera = out_test::sample_camera(48, 32);
  const std::string file = cloud_ply(frame.depth);
  const std::size_t data = file.find("end_header\n") + 11;
  ASSERT_NE(file.find("comment tofray: the valid points of 48 x 32 pixels"), std::string::npos);
  std::size_t at = data, vertex = 0;
  for (std::size_t i = 0; i < frame.depth.z_m.size(); ++i) {
    if (!std::isfinite(frame.depth.z_m[i])) continue;
    float v[4];
    ASSERT_LE(at + 17, file.size());
    std::memcpy(v, file.data() + at, 16);
    EXPECT_EQ(v[2], frame.depth.z_m[i]);
    EXPECT_EQ(v[3], frame.depth.amplitude_e[i]);
    EXPECT_EQ(static_cast<std::uint8_t>(file[at + 16]), frame.depth.confidence[i]);
    // the sample's points lie on the pinhole's rays; float32 keeps 24 bits, so 48 pixels are good to 48 / 2^23 px
    EXPECT_NEAR(camera.lens.fx_px * static_cast<double>(v[0]) / static_cast<double>(v[2]) + camera.lens.cx_px, static_cast<double>(i % 48),
                1e-4);
    EXPECT_NEAR(camera.lens.fy_px * static_cast<double>(v[1]) / static_cast<double>(v[2]) + camera.lens.cy_px, static_cast<double>(i / 48),
                1e-4);
    at += 17;
    ++vertex;
  }
  EXPECT_EQ(at, file.size());
  EXPECT_NE(file.find("element vertex " + std::to_string(vertex) + "\n"), std::string::npos);
}

TEST(ply, is_read_by_a_reader_that_is_not_ours) {
  const Python python;
  if (!python.there()) GTEST_SKIP() << "no /usr/bin/python3 with numpy";
  TemporaryFolder folder;
  const Frame frame = out_test::sample_frame(48, 32);
  out_test::write_file(folder.file("cloud.ply"), cloud_ply(frame.depth));
  out_test::write_file(folder.file("z.bin"), {reinterpret_cast<const char*>(frame.depth.z_m.data()), 4 * frame.depth.z_m.size()});
  EXPECT_EQ(python.run(R"py(
import sys, numpy as np
data = open(sys.argv[1] + '/cloud.ply', 'rb').read()
header, body = data.split(b'end_header\n', 1)
lines = header.decode('ascii').splitlines()
assert lines[:2] == ['ply', 'format binary_little_endian 1.0']
types = dict(float='<f4', uchar='u1')
dtype = [(l.split()[2], types[l.split()[1]]) for l in lines if l.startswith('property')]
count = int([l for l in lines if l.startswith('element')][0].split()[2])
v = np.frombuffer(body, dtype)
z = np.fromfile(sys.argv[1] + '/z.bin', 'f4')
assert len(v) == count and list(v.dtype.names) == ['x', 'y', 'z', 'amplitude', 'confidence']
assert np.array_equal(v['z'], z[~np.isnan(z)])
)py",
                       folder.path().string()),
            0);
}

TEST(terminal_picture, fits_the_terminal_and_resets_its_colours) {
  const Frame frame = out_test::sample_frame(64, 48);
  for (const int columns : {1, 7, 40, 64, 500}) {
    const std::string text = terminal_picture(frame.depth, columns, TerminalColors::full);
    const int width = std::min(columns, 64);
    std::size_t lines = 0, at = 0;
    while (at < text.size()) {
      const std::string line = text.substr(at, text.find('\n', at) - at);
      at += line.size() + 1;
      std::size_t blocks = 0;
      for (std::size_t i = line.find("\xE2\x96\x80"); i != std::string::npos; i = line.find("\xE2\x96\x80", i + 3)) ++blocks;
      if (at < text.size()) {
        EXPECT_EQ(blocks, static_cast<std::size_t>(width));
        EXPECT_EQ(line.substr(line.size() - 4), "\x1b[0m");
        ++lines;
      }
    }
    EXPECT_NEAR(static_cast<double>(lines), 0.5 * width * 48 / 64, 1);
  }
}

TEST(terminal_picture, has_each_cell_s_colour_above_and_below) {
  // Columns of either depth, wider ones in every other row, as a terminal shows them: a colour holds until the next one.
  Depth depth;
  depth.width = 12, depth.height = 12;
  for (int i = 0; i < 144; ++i) depth.z_m.push_back((i % 12) / (i / 12 % 2 == 0 ? 2 : 3) % 2 == 0 ? 1.0F : 2.0F);
  const std::string text = terminal_picture(depth, 12, TerminalColors::full);
  std::string ground[2];  // of a half block: its upper half, what is behind it
  std::size_t cell = 0;
  const auto code = [&](float z) {
    const Rgb c = depth_color(z > 1.5F ? 1 : 0);
    return std::to_string(c.red) + ";" + std::to_string(c.green) + ";" + std::to_string(c.blue);
  };
  for (std::size_t at = 0; at < text.size() && cell < 72;) {
    if (text.compare(at, 7, "\x1b[38;2;") == 0 || text.compare(at, 7, "\x1b[48;2;") == 0) {
      const std::size_t end = text.find('m', at);
      ground[text[at + 2] == '3' ? 0 : 1] = text.substr(at + 7, end - at - 7);
      at = end + 1;
    } else if (text.compare(at, 3, "\xE2\x96\x80") == 0) {
      const std::size_t upper = 24 * (cell / 12) + cell % 12;
      EXPECT_EQ(ground[0], code(depth.z_m[upper])) << cell;
      EXPECT_EQ(ground[1], code(depth.z_m[upper + 12])) << cell;
      ++cell, at += 3;
    } else {
      ++at;
    }
  }
  EXPECT_EQ(cell, 72U);
}

TEST(terminal_picture, shows_a_cell_where_most_of_its_pixels_are_valid) {
  Depth depth;
  depth.width = 40, depth.height = 4;
  depth.z_m.assign(160, 1.0F);
  for (const std::size_t i : {0U, 1U, 40U, 41U, 2U, 42U, 82U})
    depth.z_m[i] = out_test::nan_f;  // of 2 x 4: four of the first cell, three of the second
  const std::string text = terminal_picture(depth, 20, TerminalColors::none);
  EXPECT_EQ(text[0], ' ') << "half";
  EXPECT_NE(text[1], ' ') << "five of eight";
}

TEST(terminal_picture, without_colours_is_plain_ascii_with_the_near_dense_and_the_invalid_blank) {
  const Frame frame = out_test::sample_frame(64, 48);
  const std::string text = terminal_picture(frame.depth, 64, TerminalColors::none);
  for (const char c : text) EXPECT_TRUE(c == '\n' || (c >= 32 && c < 127));
  EXPECT_EQ(text[0], ' ');             // the corner without return
  EXPECT_EQ(text[12 * 65 + 38], '@');  // the ball
  EXPECT_EQ(text[12 * 65 + 63], '.');  // the far end of the wall
  EXPECT_NE(text.find("1.00 m @"), std::string::npos);
  EXPECT_NE(text.find(". 2.40 m\n"), std::string::npos);
}
