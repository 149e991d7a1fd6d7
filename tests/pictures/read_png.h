// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <png.h>

#include <cstring>
#include <string>
#include <vector>

namespace out_test {

/// What libpng's reader says: header and rows as they are in the file.
struct ReadBack {
  png_uint_32 width = 0, height = 0;
  int bits = 0, color_type = 0;
  std::vector<unsigned char> bytes;
  bool extra_chunks = false;
};

struct Cursor {
  const std::string* file;
  std::size_t at;
};

inline ReadBack read_back(const std::string& file) {
  ReadBack result;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  Cursor cursor{&file, 0};
  png_set_read_fn(png, &cursor, [](png_structp p, png_bytep out, png_size_t count) {
    auto* from = static_cast<Cursor*>(png_get_io_ptr(p));
    if (from->at + count > from->file->size()) png_error(p, "cut short");
    std::memcpy(out, from->file->data() + from->at, count);
    from->at += count;
  });
  png_read_info(png, info);
  png_get_IHDR(png, info, &result.width, &result.height, &result.bits, &result.color_type, nullptr, nullptr, nullptr);
  const std::size_t row = png_get_rowbytes(png, info);
  result.bytes.resize(row * result.height);
  for (png_uint_32 v = 0; v < result.height; ++v) png_read_row(png, result.bytes.data() + v * row, nullptr);
  png_read_end(png, info);
  result.extra_chunks = png_get_valid(png, info, PNG_INFO_gAMA | PNG_INFO_tIME | PNG_INFO_sRGB | PNG_INFO_tRNS) != 0;
  png_destroy_read_struct(&png, &info, nullptr);
  return result;
}

}  // namespace out_test
