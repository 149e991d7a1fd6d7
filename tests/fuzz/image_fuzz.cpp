// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Any bytes as an image, and the same once more with the checksums of PNG made right, without which chance finds nothing behind them: an
// Error, or as many samples as the size says.
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "fuzz/shown.h"
#include "image/read_image.h"

namespace {

/// Pixels beyond which an input is not looked at: more would be slow, not different.
constexpr std::uint64_t most_pixels = 1 << 20;

std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = at; i < at + count && i < bytes.size(); ++i) value = 256 * value + static_cast<unsigned char>(bytes[i]);
  return value;
}

/// Whether a header within the limits asks for more than is worth reading.
bool is_large(std::string_view bytes) {
  const auto large = [](std::uint64_t width, std::uint64_t height) {
    return width <= 16384 && height <= 16384 && width * height > most_pixels;
  };
  if (bytes.starts_with("\x89PNG")) return large(number_at(bytes, 16, 4), number_at(bytes, 20, 4));
  for (std::size_t at = 0; at + 9 < bytes.size(); ++at)
    if (bytes[at] == '\xFF' && bytes[at + 1] >= '\xC0' && bytes[at + 1] <= '\xC2' &&
        large(number_at(bytes, at + 5, 2), number_at(bytes, at + 7, 2)))
      return true;
  return false;
}

std::string with_right_sums(std::string file) {
  for (std::size_t at = 8; at + 12 <= file.size();) {
    const std::uint64_t length = number_at(file, at, 4);
    if (length > file.size() - at - 12) break;
    const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(file.data() + at + 4), static_cast<uInt>(4 + length));
    for (std::size_t i = 0; i < 4; ++i) file[at + 8 + length + i] = static_cast<char>(sum >> (24 - 8 * i) & 255);
    at += 12 + length;
  }
  return file;
}

void try_image(std::string_view bytes) {
  try {
    const tofray::image::Image image = tofray::image::read(bytes, "<fuzz>");
    if (image.width <= 0 || image.height <= 0 || image.channels < 1 || image.channels > 4) std::abort();
    if (image.bits != 1 && image.bits != 2 && image.bits != 4 && image.bits != 8 && image.bits != 16) std::abort();
    if (image.samples.size() !=
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * static_cast<std::size_t>(image.channels))
      std::abort();
  } catch (const tofray::Error& error) {
    if (error.kind() != tofray::ErrorKind::bad_input && error.kind() != tofray::ErrorKind::limit) std::abort();
    if (std::string(error.what()).find(": error: ") == std::string::npos || !tofray::fuzz::may_be_shown(error)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (is_large(bytes)) return 0;
  try_image(bytes);
  if (bytes.starts_with("\x89PNG")) try_image(with_right_sums(std::string(bytes)));
  return 0;
}
