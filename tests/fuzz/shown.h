// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "base/limits.h"
#include "base/text.h"
#include "tofray/error.h"

namespace tofray::fuzz {

/// Whether an error's text is short and steers no terminal, whatever the input was that it quotes.
inline bool may_be_shown(const Error& error) {
  const std::string text = error.what();
  return base::printable_lines(text) == text && text.find('\t') == std::string::npos &&
         text.size() <= static_cast<std::size_t>(base::limit::message_bytes.value);
}

}  // namespace tofray::fuzz
