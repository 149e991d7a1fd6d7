// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// PNG files of all kinds: their samples as they are stored.
#include "image_files.h"

using namespace tofray;
using namespace tofray::image_test;

namespace {

std::vector<std::uint16_t> shares(const Samples& samples, int bits) {
  std::vector<std::uint16_t> out;
  for (const int sample : samples) out.push_back(share(sample, bits));
  return out;
}

struct Kind {
  int color_type, bits;
};
constexpr Kind png_kinds[] = {{grey, 1}, {grey, 2},       {grey, 4},        {grey, 8}, {grey, 16}, {rgb, 8},
                              {rgb, 16}, {grey_alpha, 8}, {grey_alpha, 16}, {rgba, 8}, {rgba, 16}};
constexpr int png_sizes[][2] = {{1, 1}, {2, 1}, {1, 9}, {3, 5}, {8, 8}, {17, 4}, {33, 31}};

std::vector<png_color> colors(int count) {
  std::vector<png_color> out;
  for (int i = 0; i < count; ++i)
    out.push_back({static_cast<png_byte>(i * 37 + 1), static_cast<png_byte>(255 - i), static_cast<png_byte>(i * i + 3)});
  return out;
}

/// Where the pixels of Adam7's passes begin and how far apart they are.
struct Pass {
  int x, y, dx, dy;
};
constexpr Pass adam7[] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};

/// Rows without filter, in the order of the passes.
std::string interlaced_rows(int width, int height, int bits, int channels, const Samples& samples) {
  std::string rows;
  for (const Pass& pass : adam7)
    for (int y = pass.y; y < height; y += pass.dy) {
      Samples row;
      for (int x = pass.x; x < width; x += pass.dx)
        for (int c = 0; c < channels; ++c) row.push_back(samples[static_cast<std::size_t>((y * width + x) * channels + c)]);
      if (!row.empty()) rows += '\0' + packed_row(row, 0, row.size(), bits);
    }
  return rows;
}

std::string plain_rows(int width, int height, int bits, int channels, const Samples& samples) {
  std::string rows;
  const auto count = static_cast<std::size_t>(width * channels);
  for (int y = 0; y < height; ++y) rows += '\0' + packed_row(samples, static_cast<std::size_t>(y) * count, count, bits);
  return rows;
}

}  // namespace

TEST(png, of_every_kind_and_size_by_libpng_has_its_samples) {
  for (const Kind& kind : png_kinds)
    for (const auto& [width, height] : png_sizes)
      for (const bool interlaced : {false, true}) {
        SCOPED_TRACE(testing::Message() << kind.color_type << " " << kind.bits << " " << width << " " << height << " " << interlaced);
        const int channels = channels_of(kind.color_type);
        const Samples samples = random_samples(static_cast<std::size_t>(width * height * channels), kind.bits, 1);
        const std::string file = libpng_png({width, height, kind.bits, kind.color_type, interlaced}, samples);
        expect_image(image::read(file, "p"), width, height, channels, kind.bits, shares(samples, kind.bits));
      }
}

TEST(png, of_every_kind_and_size_by_hand_has_its_samples) {
  for (const Kind& kind : png_kinds)
    for (const auto& [width, height] : png_sizes)
      for (const int interlace : {0, 1}) {
        SCOPED_TRACE(testing::Message() << kind.color_type << " " << kind.bits << " " << width << " " << height << " " << interlace);
        const int channels = channels_of(kind.color_type);
        const Samples samples = random_samples(static_cast<std::size_t>(width * height * channels), kind.bits, 2);
        const std::string rows = interlace ? interlaced_rows(width, height, kind.bits, channels, samples)
                                           : plain_rows(width, height, kind.bits, channels, samples);
        const std::string file = hand_png(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), kind.bits, kind.color_type,
                                          rows, {}, interlace);
        expect_image(image::read(file, "p"), width, height, channels, kind.bits, shares(samples, kind.bits));
      }
}

TEST(png, of_a_palette_has_its_colours) {
  for (const int bits : {1, 2, 4, 8})
    for (const auto& [width, height] : png_sizes)
      for (const bool interlaced : {false, true})
        for (const int alphas : {0, 1, 2}) {
          SCOPED_TRACE(testing::Message() << bits << " " << width << " " << height << " " << interlaced << " " << alphas);
          const std::vector<png_color> palette_colors = colors(1 << bits);
          const Samples indices = random_samples(static_cast<std::size_t>(width * height), bits, 3);
          const std::string transparent = std::string("\x00\x80", 2).substr(0, static_cast<std::size_t>(alphas));
          std::vector<std::uint16_t> expected;
          for (const int index : indices) {
            const png_color& color = palette_colors[static_cast<std::size_t>(index)];
            for (const int c : {color.red, color.green, color.blue}) expected.push_back(share(c, 8));
            if (alphas > 0) expected.push_back(share(index >= alphas ? 255 : index == 0 ? 0 : 128, 8));
          }
          const std::string by_libpng = libpng_png({width, height, bits, palette, interlaced, palette_colors, transparent}, indices);
          std::string before;
          for (const png_color& color : palette_colors) before += bytes_of({color.red, color.green, color.blue});
          before = chunk("PLTE", before) + (alphas > 0 ? chunk("tRNS", transparent) : "");
          const std::string by_hand =
              hand_png(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), bits, palette,
                       interlaced ? interlaced_rows(width, height, bits, 1, indices) : plain_rows(width, height, bits, 1, indices), before,
                       interlaced);
          for (const std::string& file : {by_libpng, by_hand})
            expect_image(image::read(file, "p"), width, height, alphas ? 4 : 3, 8, expected);
        }
}

TEST(png, of_one_transparent_colour_has_alpha) {
  for (const int bits : {1, 2, 4, 8, 16}) {
    const Samples samples = random_samples(64, bits, 4);
    const int out = samples[5];
    std::vector<std::uint16_t> expected;
    for (const int sample : samples) {
      expected.push_back(share(sample, bits));
      expected.push_back(sample == out ? 0 : 65535);
    }
    const std::string file = hand_png(16, 4, bits, grey, plain_rows(16, 4, bits, 1, samples), chunk("tRNS", bytes_of({out >> 8, out})));
    expect_image(image::read(file, "p"), 16, 4, 2, bits, expected);
  }
  for (const int bits : {8, 16}) {
    const Samples samples = {7, 8, 9, 7, 8, 10};
    const std::string file = hand_png(2, 1, bits, rgb, plain_rows(2, 1, bits, 3, samples), chunk("tRNS", bytes_of({0, 7, 0, 8, 0, 10})));
    std::vector<std::uint16_t> expected = shares(samples, bits);
    expected.insert(expected.begin() + 3, 65535);
    expected.push_back(0);
    expect_image(image::read(file, "p"), 2, 1, 4, bits, expected);
  }
}

TEST(png, has_the_samples_that_its_bits_say) {
  expect_image(image::read(hand_png(5, 1, 1, grey, bytes_of({0, 0b10110000})), "p"), 5, 1, 1, 1, {65535, 0, 65535, 65535, 0});
  expect_image(image::read(hand_png(4, 1, 2, grey, bytes_of({0, 0b00011011})), "p"), 4, 1, 1, 2, {0, 21845, 43690, 65535});
  expect_image(image::read(hand_png(3, 1, 4, grey, bytes_of({0, 0x1A, 0xF0})), "p"), 3, 1, 1, 4, {4369, 43690, 65535});
  expect_image(image::read(hand_png(3, 1, 8, grey, bytes_of({0, 1, 128, 255})), "p"), 3, 1, 1, 8, {257, 32896, 65535});
  expect_image(image::read(hand_png(2, 1, 16, grey, bytes_of({0, 0x12, 0x34, 0xFF, 0xFE})), "p"), 2, 1, 1, 16, {0x1234, 0xFFFE});
  const Image image = image::read(hand_png(2, 2, 8, rgb, bytes_of({0, 1, 2, 3, 4, 5, 6, 0, 7, 8, 9, 10, 11, 12})), "p");
  EXPECT_EQ(image.at(0, 0, 2), 3 * 257);
  EXPECT_EQ(image.at(1, 0, 0), 4 * 257);
  EXPECT_EQ(image.at(0, 1, 1), 8 * 257);
  EXPECT_EQ(image.at(1, 1, 2), 12 * 257);
}

TEST(png, undoes_each_filter) {
  // by the specification: none; left; above; half of left and above; Paeth's
  const std::string rows = bytes_of({0, 10, 20, 30, 1, 5, 5, 5, 2, 1, 2, 3, 3, 7, 0, 1, 4, 2, 1, 250});
  const Samples expected = {10, 20, 30, 5, 10, 15, 6, 12, 18, 10, 11, 15, 12, 13, 9};
  expect_image(image::read(hand_png(3, 5, 8, grey, rows), "p"), 3, 5, 1, 8, shares(expected, 8));
}

TEST(png, is_what_is_stored_whatever_else_there_is) {
  const std::string rows = bytes_of({0, 100, 200}), text(10'000, 'x');
  const std::vector<std::uint16_t> expected = {25700, 51400};
  const std::vector<std::string> others = {
      chunk("gAMA", big_endian(45455)),
      chunk("gAMA", big_endian(100000)),
      chunk("sRGB", bytes_of({0})),
      chunk("cHRM", std::string(32, '\1')),
      chunk("sBIT", bytes_of({3})),
      chunk("bKGD", bytes_of({0, 7})),
      chunk("tIME", bytes_of({7, 0xD0, 1, 1, 0, 0, 0})),
      chunk("pHYs", big_endian(1) + big_endian(9) + bytes_of({1})),
      chunk("zTXt", "a" + bytes_of({0, 0}) + deflated(text)),
      chunk("zTXt", "not what it should be"),
      chunk("iTXt", "XML" + bytes_of({0, 1, 0, 0, 0}) + deflated(text)),
      chunk("iCCP", "profile" + bytes_of({0, 0}) + deflated(text)),
      chunk("iCCP", "no profile"),
      chunk("eXIf", "MM" + bytes_of({0, 42, 0, 0, 0, 8, 0, 1, 1, 0x12, 0, 3, 0, 0, 0, 1, 0, 6, 0, 0, 0, 0, 0, 0})),
      chunk("acTL", big_endian(1) + big_endian(0)),
      chunk("abCd", text),
  };
  std::string all;
  for (const std::string& other : others) {
    SCOPED_TRACE(other.substr(4, 4));
    expect_image(image::read(hand_png(2, 1, 8, grey, rows, other), "p"), 2, 1, 1, 8, expected);
    all += other;
  }
  expect_image(image::read(hand_png(2, 1, 8, grey, rows, all), "p"), 2, 1, 1, 8, expected);
  const std::string file = hand_png(2, 1, 8, grey, rows);
  expect_image(image::read(file.substr(0, file.size() - iend.size()) + all + iend, "p"), 2, 1, 1, 8, expected);
  expect_image(image::read(file + "what another program put behind it", "p"), 2, 1, 1, 8, expected);
  // a palette that only suggests colours
  expect_image(image::read(hand_png(1, 1, 8, rgb, bytes_of({0, 1, 2, 3}), chunk("PLTE", "abc")), "p"), 1, 1, 3, 8, {257, 514, 771});
}

TEST(png, may_have_its_pixels_in_any_number_of_chunks) {
  const Samples samples = random_samples(40, 8, 5);
  const std::string packed = deflated(plain_rows(8, 5, 8, 1, samples));
  std::string file = signature + ihdr(8, 5, 8, grey) + chunk("IDAT");
  for (const char byte : packed) file += chunk("IDAT", std::string(1, byte));
  expect_image(image::read(file + chunk("IDAT") + iend, "p"), 8, 5, 1, 8, shares(samples, 8));
}

TEST(png, is_known_by_its_bytes_and_not_by_its_name) {
  EXPECT_EQ(image::read(hand_png(1, 1, 8, grey, bytes_of({0, 5})), "a.jpg").samples.at(0), 5 * 257);
}
