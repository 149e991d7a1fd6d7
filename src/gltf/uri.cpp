// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "gltf/uri.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "base/limits.h"
#include "base/text.h"

namespace tofray::gltf {
namespace {

constexpr int no_digit = -1;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (is_digit(c)) return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : no_digit;
}

int hexadecimal_digit(char c) {
  if (is_digit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : no_digit;
}

[[noreturn]] void too_long(const Item& item, std::size_t most) {
  item.fail_at("uri", "has too many bytes", fmt::format("at most {} are left for it (`tofray --limits`)", most), ErrorKind::limit);
}

std::string decode_base64(const Item& item, std::string_view text, std::size_t most) {
  for (int padding = 0; padding < 2 && text.ends_with('='); ++padding) text.remove_suffix(1);
  const std::size_t size = text.size() / 4 * 3 + (text.size() % 4 + 1) / 2;  // 4 digits: 3 bytes; 3: 2, 2: 1
  if (size > most) too_long(item, most);
  if (text.size() % 4 == 1) item.fail_at("uri", "has broken base64", fmt::format("got {} digits, which make no whole bytes", text.size()));
  std::string out;
  out.reserve(size);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit == no_digit)
      item.fail_at("uri", "has broken base64", fmt::format("got {} as a digit", base::in_quotes(std::string_view(&c, 1))));
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      out.push_back(static_cast<char>(bits >> count & 0xFF));
    }
  }
  return out;
}

std::string of_data_uri(const Item& item, std::string_view uri, std::size_t most, std::string& mime_type) {
  const std::size_t comma = uri.find(',');
  constexpr std::string_view scheme = "data:", base64 = ";base64";
  const std::string_view kind = uri.substr(0, comma);
  if (comma == std::string_view::npos || !kind.ends_with(base64))
    item.fail_at("uri", "is a data URI without base64",
                 "got " + base::in_quotes(uri) + ", expected data:application/octet-stream;base64,…");
  const std::string_view type = kind.substr(scheme.size(), kind.size() - scheme.size() - base64.size());
  mime_type = std::string(type.substr(0, type.find(';')));
  return decode_base64(item, uri.substr(comma + 1), most);
}

/// "http" of "http://…"; empty where there is none.
std::string_view scheme_of(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string_view::npos || colon == 0 || !is_letter(uri[0])) return {};
  const auto may_be = [](char c) { return is_letter(c) || is_digit(c) || c == '+' || c == '-' || c == '.'; };
  return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), may_be) ? uri.substr(0, colon) : std::string_view();
}

std::string decode_percent(const Item& item, std::string_view uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      out.push_back(uri[i]);
      continue;
    }
    const int high = i + 2 < uri.size() ? hexadecimal_digit(uri[i + 1]) : no_digit;
    const int low = i + 2 < uri.size() ? hexadecimal_digit(uri[i + 2]) : no_digit;
    if (high == no_digit || low == no_digit)
      item.fail_at("uri", "has a percent sign without two hexadecimal digits", "got " + base::in_quotes(uri));
    out.push_back(static_cast<char>(high * 16 + low));
    i += 2;
  }
  return out;
}

/// A path beside the file or below, else an error.
void check_path(const Item& item, const std::string& path) {
  const std::string got = "got " + base::in_quotes(path) + ", expected a file beside the glTF file or below";
  if (path.empty()) item.fail_at("uri", "is empty", "expected a file beside the glTF file, or a data URI");
  if (path.find('\0') != std::string::npos) item.fail_at("uri", "has a byte 0", got);
  if (path.front() == '/') item.fail_at("uri", "is an absolute path", got);
  if (path.find('\\') != std::string::npos) item.fail_at("uri", "has a backslash", got + "; folders end with /");
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t end = std::min(path.find('/', from), path.size());
    if (path.compare(from, end - from, "..") == 0) item.fail_at("uri", "leads out of its folder", got);
    from = end + 1;
  }
}

}  // namespace

std::string bytes_of_uri(const Item& item, const Resources& other_files, std::size_t most, std::string& mime_type) {
  const std::string_view uri = item.required_text("uri");
  if (uri.starts_with("data:")) return of_data_uri(item, uri, most, mime_type);
  if (const std::string_view scheme = scheme_of(uri); !scheme.empty())
    item.fail_at("uri", "has the scheme " + base::in_quotes(scheme), "expected a file beside the glTF file, or a data URI");
  if (uri.size() > static_cast<std::size_t>(base::limit::text_bytes.value))
    item.fail_at("uri", "is too long",
                 fmt::format("got {} bytes, at most {} (`tofray --limits`)", uri.size(), base::limit::text_bytes.value), ErrorKind::limit);
  const std::string path = decode_percent(item, uri);
  check_path(item, path);
  if (!other_files) item.fail_at("uri", "is a file of its own", "got " + base::in_quotes(path) + ", and only this one can be read");
  std::string bytes = other_files(path, most);
  if (bytes.size() > most) too_long(item, most);
  return bytes;
}

}  // namespace tofray::gltf
