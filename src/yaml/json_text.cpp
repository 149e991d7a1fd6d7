// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "yaml/json_text.h"

#include <charconv>

namespace tofray::yaml {

namespace {

constexpr std::size_t escape_size = 6;  // \ud83d

/// The code of an escape \uXXXX that begins there; 0 where none does.
unsigned code_at(std::string_view text, std::size_t at) {
  if (text.substr(at, 2) != "\\u" || text.size() - at < escape_size) return 0;
  unsigned code = 0;
  const char* const end = text.data() + at + escape_size;
  return std::from_chars(text.data() + at + 2, end, code, 16).ptr == end ? code : 0;
}

}  // namespace

bool looks_like_json(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && std::string_view("{[\"").find(text[first]) != std::string_view::npos;
}

JoinedSurrogates join_surrogates(std::string_view json) {
  JoinedSurrogates out;
  out.text.reserve(json.size());
  for (std::size_t i = 0; i < json.size();) {
    if (json[i] != '\\') {
      out.text += json[i++];
      continue;
    }
    const unsigned high = code_at(json, i), low = high >= 0xD800 && high < 0xDC00 ? code_at(json, i + escape_size) : 0;
    if (low >= 0xDC00 && low < 0xE000) {
      constexpr char digits[] = "0123456789ABCDEF";
      const unsigned code = 0x10000 + ((high - 0xD800) << 10) + (low - 0xDC00);
      out.text += "\\U00";
      for (int shift = 20; shift >= 0; shift -= 4) out.text += digits[code >> shift & 15];
      out.behind.push_back(out.text.size());
      i += 2 * escape_size;
    } else {  // the escape's backslash and its letter, which may be a backslash, too
      out.text += json.substr(i, 2);
      i += 2;
    }
  }
  return out;
}

}  // namespace tofray::yaml
