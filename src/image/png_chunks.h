// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace tofray::image {

/// What a PNG file's first chunk says.
struct PngHeader {
  std::uint32_t width = 0, height = 0;
  int bits = 0, color_type = 0;
  bool interlaced = false;
};

/// Looks at a file that begins with png_signature before libpng does: its header is within the limits, its chunks end within the file,
/// and it has as many bytes as its pixels need at least.
/// @throws Error (bad_input) or (limit)
PngHeader check_png(std::string_view bytes, const std::string& file);

}  // namespace tofray::image
