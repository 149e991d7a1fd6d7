// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/crc32.h"

#include <libdeflate.h>

namespace tofray::files {

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  if (bytes.empty()) return before;  // of no bytes nowhere libdeflate begins anew
  return libdeflate_crc32(before, bytes.data(), bytes.size());
}

}  // namespace tofray::files
