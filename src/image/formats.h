// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "image/read_image.h"

/// One function for each format; read() chooses.
namespace tofray::image {

/// The signature of PNG, and the first two bytes of JPEG.
inline constexpr std::string_view png_signature("\x89PNG\r\n\x1A\n", 8);
inline constexpr std::string_view jpeg_signature("\xFF\xD8", 2);

Image read_png(std::string_view bytes, const std::string& file);
Image read_jpeg(std::string_view bytes, const std::string& file);

/// What a header says of the size, checked before anything is done about it.
/// @throws Error (bad_input) where there are no pixels; (limit) beyond image_side or image_pixels
void check_image_size(std::uint64_t width, std::uint64_t height, const std::string& file);

/// The file is broken: `what` says how.
[[noreturn]] void broken_image(const std::string& file, const std::string& what, const std::string& more = {});

/// What libpng or libjpeg said of a broken file.
[[noreturn]] void broken_image_data(const std::string& file, const char* format, const char* message);

}  // namespace tofray::image
