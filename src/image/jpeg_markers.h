// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace tofray::image {

/// What a JPEG file's frame says.
struct JpegHeader {
  std::uint32_t width = 0, height = 0;
  int components = 0;  ///< 1: grey, 3: YCbCr or RGB
};

/// Looks at a file that begins with jpeg_signature before libjpeg does: it is of a kind that is read and within the limits, its segments
/// end within the file, it has its end, scans of each component, and as many bytes as its blocks need at least.
/// @throws Error (bad_input) or (limit)
JpegHeader check_jpeg(std::string_view bytes, const std::string& file);

}  // namespace tofray::image
