// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pictures/png_file.h"

#include <png.h>

#include <csetjmp>

#include "tofray/error.h"

namespace tofray::pictures {
namespace {

/// The image as libpng wants it: 16-bit samples with the high byte first.
struct Image {
  int width, height, bits, color_type, channels;
  const unsigned char* bytes;
};

void append(png_structp png, png_bytep bytes, png_size_t count) {
  // an exception must not pass through libpng
  try {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), count);
  } catch (...) {
    png_error(png, "out of memory");
  }
}

void ignore_flush(png_structp) {}

void ignore_warning(png_structp, png_const_charp) {}

/// Writes the file; false on any failure. No object with a destructor may live here: libpng leaves by longjmp.
bool encode(const Image& image, std::string& file) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, ignore_warning);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, &file, append, ignore_flush);
  // unfiltered and at level 3: a third of the time of the defaults for about the same size, as squares of one colour repeat themselves
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_set_compression_level(png, 3);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), image.bits, image.color_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  const std::size_t row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels * image.bits / 8);
  for (int v = 0; v < image.height; ++v) png_write_row(png, image.bytes + static_cast<std::size_t>(v) * row);
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

std::string encoded(const Image& image, std::size_t bytes) {
  const std::size_t expected = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                               static_cast<std::size_t>(image.channels * image.bits / 8);
  if (image.width <= 0 || image.height <= 0 || bytes != expected)
    throw Error(ErrorKind::bug, "error: a picture's pixels do not have its size");
  std::string file;
  if (!encode(image, file)) throw Error(ErrorKind::limit, "error: out of memory while a PNG was written");
  return file;
}

}  // namespace

std::string png_grey8(int width, int height, const std::vector<std::uint8_t>& pixels) {
  return encoded({width, height, 8, PNG_COLOR_TYPE_GRAY, 1, pixels.data()}, pixels.size());
}

std::string png_grey16(int width, int height, const std::vector<std::uint16_t>& pixels) {
  std::vector<unsigned char> bytes;
  bytes.reserve(2 * pixels.size());
  for (const std::uint16_t pixel : pixels) {
    bytes.push_back(static_cast<unsigned char>(pixel >> 8));
    bytes.push_back(static_cast<unsigned char>(pixel & 255));
  }
  return encoded({width, height, 16, PNG_COLOR_TYPE_GRAY, 1, bytes.data()}, bytes.size());
}

std::string png_rgb8(int width, int height, const std::vector<std::uint8_t>& pixels) {
  return encoded({width, height, 8, PNG_COLOR_TYPE_RGB, 3, pixels.data()}, pixels.size());
}

}  // namespace tofray::pictures
