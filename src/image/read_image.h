// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tofray/error.h"

/// Pictures that surfaces wear (reflectivities, normals) out of files: PNG and JPEG.
namespace tofray::image {

/// Samples as the file stores them: neither gamma, nor a colour profile, nor the turning that EXIF asks for is applied. Whoever uses
/// them knows what they mean.
struct Image {
  int width = 0, height = 0;
  int channels = 0;  ///< 1: grey; 2: grey, alpha; 3: red, green, blue; 4: red, green, blue, alpha (of a palette: 3 or 4)
  int bits = 0;      ///< of a sample in the file: 1, 2, 4, 8 or 16 (of a palette: 8, those of its colours)
  /// Channels of a pixel side by side, pixels from the left, rows from the top. 0 to 65535, whatever `bits` is: an 8-bit v stands as
  /// 257 v, so that v / 255 and 257 v / 65535 are the same share.
  std::vector<std::uint16_t> samples;

  [[nodiscard]] std::uint16_t at(int x, int y, int channel) const {
    return samples[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
                       static_cast<std::size_t>(channels) +
                   static_cast<std::size_t>(channel)];
  }
};

/// Reads an image. Its first bytes say what it is: PNG of any kind (of an animated one the first picture), or JPEG with 8 bits in grey,
/// YCbCr or RGB, baseline or progressive. What is behind its end is not looked at.
///
/// Takes 2 bytes a sample, and a progressive JPEG 2 more while it is read. Nothing is taken before the header was seen to be within the
/// limits, and before there are as many bytes as so many pixels need at least.
/// @param bytes  the whole file
/// @param file   its name for messages
/// @throws Error (bad_input) where it is of another kind or any of it is broken or missing, be it a checksum; (limit) beyond
///         limit::image_bytes, image_side, image_pixels or image_scans
Image read(std::string_view bytes, const std::string& file);

}  // namespace tofray::image
