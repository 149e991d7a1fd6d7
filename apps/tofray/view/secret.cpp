// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/secret.h"

#include <sys/random.h>

#include <array>
#include <cerrno>
#include <cstddef>

#include "tofray/error.h"

namespace tofray::view {

std::string new_token() {
  std::array<unsigned char, 32> bits{};
  for (std::size_t have = 0; have < bits.size();) {
    const ssize_t got = ::getrandom(bits.data() + have, bits.size() - have, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw Error(ErrorKind::io, "error: the system has no random numbers for the viewer's token");
    have += static_cast<std::size_t>(got);
  }
  std::string text;
  for (const unsigned char byte : bits) text += {"0123456789abcdef"[byte >> 4], "0123456789abcdef"[byte & 15]};
  return text;
}

bool same_secret(std::string_view secret, std::string_view given) {
  if (secret.empty()) return false;
  unsigned different = secret.size() == given.size() ? 0u : 1u;
  for (std::size_t i = 0; i < given.size(); ++i)
    different |= static_cast<unsigned>(static_cast<unsigned char>(given[i])) ^ static_cast<unsigned char>(secret[i % secret.size()]);
  return different == 0;
}

}  // namespace tofray::view
