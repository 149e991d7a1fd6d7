// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The chunks of a PNG file: length, name, data, checksum. What is in them libpng reads.
#include "image/png_chunks.h"

#include <fmt/core.h>

#include "base/bytes.h"
#include "base/text.h"
#include "image/formats.h"

namespace tofray::image {
namespace {

constexpr std::size_t chunk_frame = 12;             // bytes of a chunk beside its data
constexpr std::uint64_t best_deflate_ratio = 1032;  // 258 bytes by 2 bits

std::uint32_t big_endian_32(const char* at) { return base::read_bytes_as<std::uint32_t>(at, true); }

/// Channels of a colour type; 0 where there is no such type.
int channels_of_color_type(int type) {
  switch (type) {
    case 0:
    case 3: return 1;
    case 4: return 2;
    case 2: return 3;
    case 6: return 4;
    default: return 0;
  }
}

bool has_bits(int color_type, int bits) {
  const bool small = bits == 1 || bits == 2 || bits == 4;
  if (color_type == 0) return small || bits == 8 || bits == 16;
  if (color_type == 3) return small || bits == 8;
  return bits == 8 || bits == 16;
}

class PngChunks {
 public:
  PngChunks(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  PngHeader check() {
    const PngHeader header = read_header();
    const std::uint64_t packed = bytes_of_pixels();
    const auto bits_of_pixel =
        static_cast<std::uint64_t>(header.bits) * static_cast<std::uint64_t>(channels_of_color_type(header.color_type));
    const std::uint64_t needed = (std::uint64_t{header.width} * header.height * bits_of_pixel + 7) / 8;
    if (needed > best_deflate_ratio * packed)
      broken_image(file_, "the PNG file is too short for its pixels",
                   fmt::format("its {} by {} pixels cannot be packed into {} bytes", header.width, header.height, packed));
    return header;
  }

 private:
  /// The first chunk, which has the size: checked before anything else is looked at.
  PngHeader read_header() const {
    const std::size_t at = png_signature.size();
    if (bytes_.size() < at + chunk_frame + 13) cut_short("it ends in its header");
    const char* data = bytes_.data() + at;
    if (bytes_.substr(at + 4, 4) != "IHDR" || big_endian_32(data) != 13)
      broken_image(
          file_, "the PNG file does not begin with its header",
          fmt::format("got a chunk {} of {} bytes, expected IHDR of 13", base::in_quotes(bytes_.substr(at + 4, 4)), big_endian_32(data)));
    data += 8;
    check_image_size(big_endian_32(data), big_endian_32(data + 4), file_);
    const auto byte = [&](int i) { return static_cast<int>(static_cast<unsigned char>(data[i])); };
    const PngHeader header{big_endian_32(data), big_endian_32(data + 4), byte(8), byte(9), byte(12) == 1};
    if (channels_of_color_type(header.color_type) == 0)
      broken_image(file_, fmt::format("PNG has no colour type {}", header.color_type), "expected 0, 2, 3, 4 or 6");
    if (!has_bits(header.color_type, header.bits))
      broken_image(file_, fmt::format("PNG has no samples of {} bits for colour type {}", header.bits, header.color_type),
                   "expected 1, 2, 4, 8 or 16 for grey, 1, 2, 4 or 8 for a palette, 8 or 16 for others");
    if (byte(10) != 0) broken_image(file_, fmt::format("PNG has no compression method {}", byte(10)), "expected 0");
    if (byte(11) != 0) broken_image(file_, fmt::format("PNG has no filter method {}", byte(11)), "expected 0");
    if (byte(12) > 1) broken_image(file_, fmt::format("PNG has no interlace method {}", byte(12)), "expected 0 or 1");
    return header;
  }

  /// Goes through all chunks. @return the bytes of pixels, packed as they are
  std::uint64_t bytes_of_pixels() const {
    std::uint64_t packed = 0;
    bool has_pixels = false, last_has_pixels = false;
    for (std::size_t at = png_signature.size();;) {
      if (bytes_.size() - at < chunk_frame) cut_short(fmt::format("it ends without IEND in the chunk that begins at byte {}", at));
      const std::string_view name = bytes_.substr(at + 4, 4);
      const std::size_t length = big_endian_32(bytes_.data() + at);
      if (bytes_.size() - at - chunk_frame < length)
        cut_short(fmt::format("its chunk {} at byte {} says that it has {} bytes, and {} are left", base::in_quotes(name), at, length,
                              bytes_.size() - at - chunk_frame));
      const bool pixels = name == "IDAT";
      if (pixels && has_pixels && !last_has_pixels)
        broken_image(file_, "the PNG file has pixels in two places", fmt::format("there is another chunk before that at byte {}", at));
      if (pixels) packed += length;
      has_pixels |= pixels;
      last_has_pixels = pixels;
      if (name == "IEND") break;
      at += chunk_frame + length;
    }
    if (!has_pixels) broken_image(file_, "the PNG file has no pixels", "it has no chunk IDAT");
    return packed;
  }

  [[noreturn]] void cut_short(const std::string& more) const { broken_image(file_, "the PNG file is cut short", more); }

  std::string_view bytes_;
  const std::string& file_;
};

}  // namespace

PngHeader check_png(std::string_view bytes, const std::string& file) { return PngChunks(bytes, file).check(); }

}  // namespace tofray::image
