// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string_view>

namespace tofray::files {

/// The CRC-32 of zip, PNG and MCAP. By libdeflate, which multiplies without carry where the processor can: 10 GB/s, zlib's tables 1.2.
/// @param before  the sum of what stands before these bytes
[[nodiscard]] std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

}  // namespace tofray::files
