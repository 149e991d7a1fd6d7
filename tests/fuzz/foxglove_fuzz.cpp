// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Any text as a message of a stream's reader: what it asks for, or what is wrong with it, which can be told as JSON.
#include <cstdint>
#include <string_view>

#include "files/json.h"
#include "foxglove/protocol.h"
#include "tofray/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tofray;
  try {
    const foxglove::Asked asked = foxglove::asked_by({reinterpret_cast<const char*>(data), size});
    if (const auto* other = std::get_if<foxglove::Other>(&asked))
      (void)files::parse_json(foxglove::status(foxglove::Level::warning, other->op), "a status");
  } catch (const Error& error) {
    (void)files::parse_json(foxglove::status(foxglove::Level::error, error.what()), "a status");
  }
  return 0;
}
