// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

/// Bytes packed as zip and zlib have them (RFC 1951, RFC 1950), by libdeflate. One version of it gives the same bytes each time.
namespace tofray::files {

/// Appends the two pieces as one deflated stream.
void append_deflated(std::string& to, std::string_view head, std::string_view body);

/// A zlib stream, as web pages unpack it.
[[nodiscard]] std::string zlib_stream(std::string_view bytes);

}  // namespace tofray::files
