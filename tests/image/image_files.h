// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// PNG and JPEG files for tests: PNG made by hand with zlib alone, and both by the libraries that everybody writes them with.
#pragma once
#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>
// (libjpeg's header needs what cstdio declares)
#include <jpeglib.h>

#include "image/read_image.h"
#include "support/random.h"
#include "support/text.h"
#include "support/told.h"

namespace tofray::image_test {

using image::Image;
using Samples = std::vector<int>;

inline std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

inline std::string bytes_of(std::initializer_list<int> values) {
  std::string bytes;
  for (const int value : values) bytes += static_cast<char>(value);
  return bytes;
}

inline std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

inline std::string chunk(const std::string& name, const std::string& data = {}) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + name + data + big_endian(crc_of(name + data));
}

inline std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  EXPECT_EQ(compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                      static_cast<uLong>(bytes.size()), 9),
            Z_OK);
  out.resize(size);
  return out;
}

inline const std::string signature("\x89PNG\r\n\x1A\n", 8);
inline const std::string iend = chunk("IEND");

enum ColorType { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgba = 6 };

inline std::string ihdr(std::uint32_t width, std::uint32_t height, int bits, int color_type, int interlace = 0) {
  return chunk("IHDR", big_endian(width) + big_endian(height) + bytes_of({bits, color_type, 0, 0, interlace}));
}

/// A PNG file by hand. @param rows  as they are packed: a byte for the filter, then the row, again and again
inline std::string hand_png(std::uint32_t width, std::uint32_t height, int bits, int color_type, const std::string& rows,
                            const std::string& before = {}, int interlace = 0) {
  return signature + ihdr(width, height, bits, color_type, interlace) + before + chunk("IDAT", deflated(rows)) + iend;
}

inline int channels_of(int color_type) { return color_type == rgb ? 3 : color_type == grey_alpha ? 2 : color_type == rgba ? 4 : 1; }

/// Samples of a row side by side, packed from the high bits on.
inline std::string packed_row(const Samples& samples, std::size_t from, std::size_t count, int bits) {
  std::string bytes;
  int room = 0;
  for (std::size_t i = from; i < from + count; ++i) {
    if (bits == 16) bytes += static_cast<char>(samples[i] >> 8);
    if (bits >= 8) {
      bytes += static_cast<char>(samples[i] & 255);
      continue;
    }
    if (room == 0) {
      bytes += '\0';
      room = 8;
    }
    room -= bits;
    bytes.back() = static_cast<char>(static_cast<unsigned char>(bytes.back()) | (samples[i] << room));
  }
  return bytes;
}

struct Png {
  int width, height, bits, color_type;
  bool interlaced = false;
  std::vector<png_color> palette_colors = {};
  std::string transparent = {};  ///< what tRNS has
};

/// A PNG file by libpng.
inline std::string libpng_png(const Png& png, const Samples& samples) {
  std::string file;
  png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(writer);
  png_set_write_fn(
      writer, &file,
      [](png_structp p, png_bytep bytes, png_size_t count) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<const char*>(bytes), count);
      },
      [](png_structp) {});
  png_set_IHDR(writer, info, static_cast<png_uint_32>(png.width), static_cast<png_uint_32>(png.height), png.bits, png.color_type,
               png.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!png.palette_colors.empty()) png_set_PLTE(writer, info, png.palette_colors.data(), static_cast<int>(png.palette_colors.size()));
  const auto* alphas = reinterpret_cast<const png_byte*>(png.transparent.data());
  if (png.color_type == palette && !png.transparent.empty())
    png_set_tRNS(writer, info, alphas, static_cast<int>(png.transparent.size()), nullptr);
  png_write_info(writer, info);
  const std::size_t count = static_cast<std::size_t>(png.width * channels_of(png.color_type));
  std::vector<std::string> rows;
  std::vector<png_bytep> pointers;
  for (int y = 0; y < png.height; ++y) rows.push_back(packed_row(samples, static_cast<std::size_t>(y) * count, count, png.bits));
  for (std::string& row : rows) pointers.push_back(reinterpret_cast<png_bytep>(row.data()));
  png_write_image(writer, pointers.data());
  png_write_end(writer, nullptr);
  png_destroy_write_struct(&writer, &info);
  return file;
}

struct Jpeg {
  int width, height, components;
  bool progressive = false;
  int sampling = 1;  ///< of the first component, both ways
  int quality = 100;
  bool as_rgb = false;  ///< three components that are RGB themselves
  int restart = 0;      ///< blocks between restart markers
  bool arithmetic = false;
  bool one_by_one = false;  ///< a scan for each component
};

/// A JPEG file by libjpeg; of 4 components: CMYK.
inline std::string libjpeg_jpeg(const Jpeg& jpeg, const std::vector<unsigned char>& samples) {
  jpeg_compress_struct writer{};
  jpeg_error_mgr errors{};
  writer.err = jpeg_std_error(&errors);
  jpeg_create_compress(&writer);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&writer, &memory, &size);
  writer.image_width = static_cast<JDIMENSION>(jpeg.width);
  writer.image_height = static_cast<JDIMENSION>(jpeg.height);
  writer.input_components = jpeg.components;
  writer.in_color_space = jpeg.components == 1 ? JCS_GRAYSCALE : jpeg.components == 3 ? JCS_RGB : JCS_CMYK;
  jpeg_set_defaults(&writer);
  if (jpeg.as_rgb) jpeg_set_colorspace(&writer, JCS_RGB);
  jpeg_set_quality(&writer, jpeg.quality, TRUE);
  writer.comp_info[0].h_samp_factor = writer.comp_info[0].v_samp_factor = jpeg.sampling;
  writer.restart_interval = static_cast<unsigned>(jpeg.restart);
  writer.arith_code = jpeg.arithmetic ? TRUE : FALSE;
  std::vector<jpeg_scan_info> scans;
  for (int i = 0; i < jpeg.components; ++i) scans.push_back({1, {i, 0, 0, 0}, 0, 63, 0, 0});
  if (jpeg.one_by_one) {
    writer.scan_info = scans.data();
    writer.num_scans = jpeg.components;
  }
  if (jpeg.progressive) jpeg_simple_progression(&writer);
  jpeg_start_compress(&writer, TRUE);
  while (writer.next_scanline < writer.image_height) {
    auto* row = const_cast<JSAMPROW>(samples.data()) + writer.next_scanline * static_cast<std::size_t>(jpeg.width * jpeg.components);
    jpeg_write_scanlines(&writer, &row, 1);
  }
  jpeg_finish_compress(&writer);
  jpeg_destroy_compress(&writer);
  std::string file(reinterpret_cast<const char*>(memory), size);
  std::free(memory);
  return file;
}

/// Random samples of so many bits.
inline Samples random_samples(std::size_t count, int bits, std::uint64_t seed) {
  test::Random random(seed);
  Samples samples(count);
  for (int& sample : samples) sample = random.below(1 << bits);
  return samples;
}

/// As an image has them: 0 to 65535.
inline std::uint16_t share(int sample, int bits) { return static_cast<std::uint16_t>(sample * (65535 / ((1 << bits) - 1))); }

inline void expect_image(const Image& image, int width, int height, int channels, int bits, const std::vector<std::uint16_t>& samples) {
  EXPECT_EQ(image.width, width);
  EXPECT_EQ(image.height, height);
  EXPECT_EQ(image.channels, channels);
  EXPECT_EQ(image.bits, bits);
  EXPECT_EQ(image.samples, samples);
}

/// Whether bytes give an image, whose samples then are as many as it says; else an error that may be shown and names the file.
inline bool is_taken(std::string_view bytes) {
  try {
    const Image image = image::read(bytes, "hostile");
    EXPECT_GT(image.width, 0);
    EXPECT_GT(image.height, 0);
    EXPECT_GE(image.channels, 1);
    EXPECT_LE(image.channels, 4);
    EXPECT_TRUE(image.bits == 1 || image.bits == 2 || image.bits == 4 || image.bits == 8 || image.bits == 16);
    EXPECT_EQ(image.samples.size(),
              static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * static_cast<std::size_t>(image.channels));
    return true;
  } catch (const Error& error) {
    test::expect_told(error, "hostile");
    return false;
  }
}

}  // namespace tofray::image_test
