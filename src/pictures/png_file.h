// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

/// PNG files in memory. Nothing but the pixels is in them: no time, no text, no gamma.
namespace tofray::pictures {

/// Grey, 8 bits. @param pixels [height][width]
std::string png_grey8(int width, int height, const std::vector<std::uint8_t>& pixels);

/// Grey, 16 bits. @param pixels [height][width]
std::string png_grey16(int width, int height, const std::vector<std::uint16_t>& pixels);

/// Colour, 8 bits per channel. @param pixels [height][width][3] red, green, blue
std::string png_rgb8(int width, int height, const std::vector<std::uint8_t>& pixels);

}  // namespace tofray::pictures
