// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// JPEG files of the kinds that are read.
#include <algorithm>
#include <array>
#include <cmath>

#include "image_files.h"
#include "jpeg_by_hand.h"

using namespace tofray;
using namespace tofray::image_test;

namespace {

constexpr int jpeg_sizes[][2] = {{1, 1}, {8, 8}, {7, 9}, {16, 16}, {17, 33}, {65, 3}};

std::vector<unsigned char> constant(int pixels, const std::vector<int>& color) {
  std::vector<unsigned char> samples;
  for (int i = 0; i < pixels; ++i)
    for (const int c : color) samples.push_back(static_cast<unsigned char>(c));
  return samples;
}

/// Rises to the right in the first component, downward in the second, falls to the right in the third.
std::vector<unsigned char> gradient(int width, int height, int components) {
  std::vector<unsigned char> samples;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int values[] = {255 * x / width, 255 * y / height, 255 - 255 * x / width};
      for (int c = 0; c < components; ++c) samples.push_back(static_cast<unsigned char>(values[c]));
    }
  return samples;
}

/// The largest difference, in steps of 8 bits.
double furthest(const Image& image, const std::vector<unsigned char>& expected) {
  double most = image.samples.size() == expected.size() ? 0 : 1e9;
  for (std::size_t i = 0; i < std::min(image.samples.size(), expected.size()); ++i)
    most = std::max(most, std::abs(image.samples[i] / 257.0 - expected[i]));
  return most;
}

void expect_near(const Jpeg& jpeg, const std::vector<unsigned char>& samples, double most) {
  SCOPED_TRACE(testing::Message() << jpeg.width << " " << jpeg.height << " " << jpeg.components << " " << jpeg.progressive << " "
                                  << jpeg.sampling << " " << jpeg.restart);
  const Image image = image::read(libjpeg_jpeg(jpeg, samples), "j");
  EXPECT_EQ(image.width, jpeg.width);
  EXPECT_EQ(image.height, jpeg.height);
  EXPECT_EQ(image.channels, jpeg.components);
  EXPECT_EQ(image.bits, 8);
  EXPECT_LE(furthest(image, samples), most);
}

}  // namespace

TEST(jpeg, of_one_colour_has_it) {
  // Quality 100 rounds a block's mean to an eighth; then grey is rounded once (1 at most). Y, Cb and Cr are rounded before and after:
  // each is off by 1 at most, so red, green and blue by 1 + 1.772 and one half for their own rounding.
  for (const auto& [width, height] : jpeg_sizes)
    for (const bool progressive : {false, true}) {
      for (const int value : {0, 1, 127, 128, 200, 255}) expect_near({width, height, 1, progressive}, constant(width * height, {value}), 1);
      for (const int sampling : {1, 2})
        for (const auto& color :
             std::vector<std::vector<int>>{{0, 0, 0}, {255, 255, 255}, {200, 30, 90}, {10, 250, 120}, {255, 0, 0}, {0, 0, 255}})
          expect_near({width, height, 3, progressive, sampling}, constant(width * height, color), 3.3);
    }
}

TEST(jpeg, of_a_gradient_has_it) {
  // Quality 100 rounds each of 64 coefficients: the norm of the errors is 4 at most (64 times one half squared), so is each; with the
  // sample's own rounding 4.5. Through Y, Cb and Cr: 4.5 + 1.772 (4.5 + 0.5) + 0.5 = 13.9.
  for (const auto& [width, height] : jpeg_sizes)
    for (const bool progressive : {false, true})
      for (const int restart : {0, 1}) {
        Jpeg jpeg{width, height, 1, progressive};
        jpeg.restart = restart;
        expect_near(jpeg, gradient(width, height, 1), 4.5);
        jpeg.components = 3;
        expect_near(jpeg, gradient(width, height, 3), 13.9);
        jpeg.one_by_one = !progressive;
        expect_near(jpeg, gradient(width, height, 3), 13.9);
        jpeg.as_rgb = true;
        expect_near(jpeg, gradient(width, height, 3), 4.5);
      }
}

TEST(jpeg, has_the_samples_that_its_bits_say) {
  // one block: its mean alone, 5 steps of 8 / 8 above 128
  const Image image = image::read(HandJpeg().file(), "j");
  expect_image(image, 8, 8, 1, 8, std::vector<std::uint16_t>(64, 133 * 257));
  // red, green, blue by their letters
  HandJpeg letters;
  letters.components = {{'R', 0x11}, {'G', 0x11}, {'B', 0x11}};
  letters.data = hand_data({5, 0, -7});
  const Image color = image::read(letters.file(), "j");
  EXPECT_EQ(color.channels, 3);
  EXPECT_EQ(color.at(3, 4, 0), 133 * 257);
  EXPECT_EQ(color.at(3, 4, 1), 128 * 257);
  EXPECT_EQ(color.at(3, 4, 2), 121 * 257);
  // Y, Cb, Cr: 133, 128, 121 is R = Y + 1.402 (Cr - 128), G = Y - 0.344136 (Cb - 128) - 0.714136 (Cr - 128), B = Y + 1.772 (Cb - 128)
  letters.components = {{1, 0x11}, {2, 0x11}, {3, 0x11}};
  const Image converted = image::read(letters.file(), "j");
  EXPECT_EQ(converted.at(0, 0, 0), 123 * 257);
  EXPECT_EQ(converted.at(0, 0, 1), 138 * 257);
  EXPECT_EQ(converted.at(0, 0, 2), 133 * 257);
}

TEST(jpeg, is_what_is_stored_whatever_else_there_is) {
  const std::string exif =
      "Exif" + bytes_of({0, 0}) + "MM" + bytes_of({0, 42, 0, 0, 0, 8, 0, 1, 1, 0x12, 0, 3, 0, 0, 0, 1, 0, 6, 0, 0, 0, 0, 0, 0});
  HandJpeg jpeg;
  jpeg.height = 5;
  jpeg.before = hand_segment(0xE1, exif) + hand_segment(0xE2, "ICC_PROFILE" + bytes_of({0, 1, 1}) + "none") +
                hand_segment(0xFE, "a comment") + bytes_of({0xFF, 0xFF});
  const std::vector<std::uint16_t> expected(40, 133 * 257);
  expect_image(image::read(jpeg.file(), "j"), 8, 5, 1, 8, expected);
  expect_image(image::read(jpeg.file() + "what another program put behind it", "j"), 8, 5, 1, 8, expected);
}

TEST(jpeg, of_a_newer_jfif_is_read) {
  HandJpeg jpeg;
  jpeg.before = hand_segment(0xE0, "JFIF" + bytes_of({0, 7, 1, 0, 0, 1, 0, 1, 0, 0}));
  EXPECT_EQ(image::read(jpeg.file(), "j").at(0, 0, 0), 133 * 257);
}

TEST(jpeg, is_known_by_its_bytes_and_not_by_its_name) { EXPECT_EQ(image::read(HandJpeg().file(), "a.png").channels, 1); }
