// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "image/read_image.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/faults.h"
#include "base/limits.h"
#include "base/text.h"
#include "image/formats.h"

namespace tofray::image {
namespace {

using namespace std::string_view_literals;

/// Images that are known and not read, by bytes from `at` on.
struct OtherFormat {
  std::size_t at;
  std::string_view bytes;
  const char* name;
};
constexpr OtherFormat other_formats[] = {
    {0, "\x89PNG"sv, "a PNG file whose first bytes are damaged, as by a transfer as text"},
    {8, "WEBP"sv, "WebP"},
    {0, "GIF8"sv, "GIF"},
    {0, "BM"sv, "BMP"},
    {0, "\xABKTX 20"sv, "KTX 2"},
    {0, "\xABKTX 11"sv, "KTX"},
    {0, "DDS "sv, "DDS"},
    {0, "\x76\x2F\x31\x01"sv, "OpenEXR"},
    {0, "#?R"sv, "Radiance HDR"},
    {0, "II*\0"sv, "TIFF"},
    {0, "MM\0*"sv, "TIFF"},
    {0, "8BPS"sv, "Photoshop"},
    {4, "ftypavi"sv, "AVIF"},
    {4, "ftyphei"sv, "HEIF"},
    {4, "ftypmif1"sv, "HEIF or AVIF"},
    {0, "\xFF\x0A"sv, "JPEG XL"},
    {4, "JXL "sv, "JPEG XL"},
    {4, "jP  "sv, "JPEG 2000"},
    {0, "\xFF\x4F\xFF\x51"sv, "JPEG 2000"},
    {0, "<svg"sv, "SVG"},
    {0, "<?xml"sv, "XML, perhaps SVG"},
    {0, "%PDF"sv, "PDF"},
};

[[noreturn]] void refuse_format(std::string_view bytes, const std::string& file) {
  constexpr const char* way_out = "expected PNG or JPEG: convert it to PNG, which loses nothing";
  const auto here = base::whole(file);
  if (bytes.empty()) base::fail(here, "the image file is empty", "expected PNG or JPEG");
  for (const OtherFormat& other : other_formats)
    if (bytes.substr(std::min(other.at, bytes.size()), other.bytes.size()) == other.bytes)
      base::fail(here, "this kind of image is not read", fmt::format("it looks like {}; {}", other.name, way_out));
  if (bytes[0] == 'P' && bytes.size() > 2 && bytes[1] >= '1' && bytes[1] <= '7' && (bytes[2] == '\n' || bytes[2] == ' '))
    base::fail(here, "this kind of image is not read", fmt::format("it looks like PNM; {}", way_out));
  base::fail(here, "this is no image that can be read",
             fmt::format("got {} at its beginning, expected PNG or JPEG", base::in_quotes(bytes.substr(0, 12))));
}

}  // namespace

void check_image_size(std::uint64_t width, std::uint64_t height, const std::string& file) {
  const auto most_side = static_cast<std::uint64_t>(base::limit::image_side.value);
  const auto most_pixels = static_cast<std::uint64_t>(base::limit::image_pixels.value);
  const auto here = base::whole(file);
  if (width == 0 || height == 0) base::fail(here, "the image has no pixels", fmt::format("its header says {} by {}", width, height));
  if (width > most_side || height > most_side)
    base::fail(
        here, fmt::format("the image has more than {} pixels along a side", most_side),
        fmt::format("its header says {} by {}: make it smaller (`tofray --limits`), or mend its header if that is wrong", width, height),
        ErrorKind::limit);
  if (width * height > most_pixels)
    base::fail(
        here, fmt::format("the image has more than {} pixels", most_pixels),
        fmt::format("its header says {} by {}: make it smaller (`tofray --limits`), or mend its header if that is wrong", width, height),
        ErrorKind::limit);
}

void broken_image(const std::string& file, const std::string& what, const std::string& more) { base::fail(base::whole(file), what, more); }

void broken_image_data(const std::string& file, const char* format, const char* message) {
  base::fail(base::whole(file), fmt::format("the {} file is broken: {}", format, message), "expected a whole file: save or copy it anew");
}

Image read(std::string_view bytes, const std::string& file) {
  if (bytes.size() > static_cast<std::size_t>(base::limit::image_bytes.value))
    base::fail(base::whole(file), fmt::format("the image file has more than {} bytes", base::limit::image_bytes.value),
               fmt::format("got {}: make it smaller (`tofray --limits`)", bytes.size()), ErrorKind::limit);
  if (bytes.starts_with(png_signature)) return read_png(bytes, file);
  // JPEG XL begins with FF 0A, JPEG 2000's bare stream with FF 4F
  if (bytes.starts_with(jpeg_signature)) return read_jpeg(bytes, file);
  if (!bytes.empty() && png_signature.starts_with(bytes)) broken_image(file, "the PNG file is cut short", "it ends in its first 8 bytes");
  refuse_format(bytes, file);
}

}  // namespace tofray::image
