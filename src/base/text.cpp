// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/text.h"

#include <algorithm>
#include <charconv>

namespace tofray::base {

std::string printable(std::string_view text) {
  constexpr char digits[] = "0123456789abcdef";
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    // C0 and C1 control characters could steer a terminal.
    const bool c1 = byte == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0;
    if (byte < 0x20 || byte == 0x7F || c1) {
      const auto code = c1 ? static_cast<unsigned char>(text[++i]) : byte;
      out += {'\\', 'x', digits[code >> 4], digits[code & 15]};
    } else {
      out += static_cast<char>(byte);
    }
  }
  return out;
}

std::string in_quotes(std::string_view text, std::size_t longest) {
  const bool cut = text.size() > longest;
  if (cut) {
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not inside a UTF-8 character
    text = text.substr(0, end);
  }
  return "\"" + printable(text) + (cut ? "…\"" : "\"");
}

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

namespace {
std::string folded(std::string_view word) {
  std::string out;
  for (char c : word) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    out += c == '-' || c == ' ' ? '_' : c;
  }
  return out;
}
}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  if (word.empty() || word.size() > 100) return {};
  const std::string wanted = folded(word);
  std::string best;
  int best_distance = 0;
  for (const auto& name : known) {
    const std::string candidate = folded(name);
    int distance = edit_distance(wanted, candidate);
    // A word cut short ("mod" for "modulation_frequency") is near, too.
    if (wanted.size() >= 3 && candidate.starts_with(wanted)) distance = std::min(distance, 2);
    if (best.empty() || distance < best_distance) {
      best = name;
      best_distance = distance;
    }
  }
  const int allowed = std::max(1, static_cast<int>(wanted.size()) / 3);
  const bool prefix = wanted.size() >= 3 && folded(best).starts_with(wanted);
  return best_distance <= allowed || prefix ? best : std::string();
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::string name = nearest(word, known);
  return name.empty() ? std::string() : "; did you mean " + in_quotes(name) + "?";
}

std::string listed(const std::vector<std::string>& words, std::string_view last) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) out += i + 1 == words.size() ? " " + std::string(last) + " " : ", ";
    out += words[i];
  }
  return out;
}

std::string number_text(double value) {
  char fixed[400], short_form[40];
  const auto fixed_end = std::to_chars(fixed, fixed + sizeof fixed, value, std::chars_format::fixed);
  const auto short_end = std::to_chars(short_form, short_form + sizeof short_form, value);
  const bool readable = fixed_end.ec == std::errc() && fixed_end.ptr - fixed <= 10;  // 0.0001 rather than 1e-04
  return readable ? std::string(fixed, fixed_end.ptr) : std::string(short_form, short_end.ptr);
}

}  // namespace tofray::base
