// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/text.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>

#include "base/limits.h"

namespace tofray::base {

std::size_t utf8_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0U; };
  const auto more = [&](std::size_t k) { return (byte(k) & 0xC0U) == 0x80U; };
  const unsigned b = byte(0);
  if (b < 0x80) return 1;
  if (b >= 0xC2 && b <= 0xDF) return more(1) ? 2 : 0;
  if (b >= 0xE0 && b <= 0xEF) return more(1) && more(2) && (b != 0xE0 || byte(1) >= 0xA0) && (b != 0xED || byte(1) < 0xA0) ? 3 : 0;
  if (b >= 0xF0 && b <= 0xF4)
    return more(1) && more(2) && more(3) && (b != 0xF0 || byte(1) >= 0x90) && (b != 0xF4 || byte(1) < 0x90) ? 4 : 0;
  return 0;
}

namespace {

// Delete and C1, then what turns the direction of writing or ends a line: marks, embeddings, isolates.
bool steers(std::uint32_t code) {
  return (code >= 0x7F && code < 0xA0) || (code >= 0x200E && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

// At most `longest` bytes, without a part of a character at the end.
std::string_view front(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return text;
  while (longest > 0 && (static_cast<unsigned char>(text[longest]) & 0xC0) == 0x80) --longest;
  return text.substr(0, longest);
}

std::string_view back(std::string_view text, std::size_t longest) {
  std::size_t from = text.size() - std::min(longest, text.size());
  while (from < text.size() && (static_cast<unsigned char>(text[from]) & 0xC0) == 0x80) ++from;
  return text.substr(from);
}

}  // namespace

std::string printable(std::string_view text) {
  constexpr char digits[] = "0123456789abcdef";
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i + k])); };
    const std::size_t length = utf8_length(text, i);
    const std::uint32_t b = byte(0);
    const std::uint32_t code = length == 2   ? (b & 31) << 6 | (byte(1) & 63)
                               : length == 3 ? (b & 15) << 12 | (byte(1) & 63) << 6 | (byte(2) & 63)
                                             : b;
    if (length == 0 || code < 0x20)
      out += {'\\', 'x', digits[b >> 4], digits[b & 15]};
    else if (length < 4 && steers(code))
      out += {'\\', 'u', digits[code >> 12 & 15], digits[code >> 8 & 15], digits[code >> 4 & 15], digits[code & 15]};
    else
      out += text.substr(i, length);
    i += std::max<std::size_t>(length, 1);
  }
  return out;
}

std::string printable_lines(std::string_view text) {
  std::string out;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t stop = std::min(text.find_first_of("\n\t", from), text.size());
    out += printable(text.substr(from, stop - from));
    if (stop < text.size()) out += text[stop];
    from = stop + 1;
  }
  return out;
}

std::string message(std::string_view text) {
  constexpr auto longest_line = static_cast<std::size_t>(limit::message_line_bytes.value);
  constexpr auto longest = static_cast<std::size_t>(limit::message_bytes.value);
  constexpr std::string_view gap = " … ", end = "\n…";
  std::string out;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t stop = std::min(text.find('\n', from), text.size());
    const std::string line = printable(text.substr(from, stop - from));
    const bool cut = line.size() > longest_line;
    // The beginning says where, the end what.
    const std::string shown =
        cut ? std::string(front(line, longest_line / 2)) + std::string(gap) + std::string(back(line, longest_line / 2 - gap.size())) : line;
    if (out.size() + 1 + shown.size() + end.size() > longest) return out + std::string(end);
    out += (from > 0 ? "\n" : "") + shown;
    from = stop + 1;
  }
  return out;
}

std::string in_quotes(std::string_view text, std::size_t longest) {
  return "\"" + printable(front(text, longest)) + (text.size() > longest ? "…\"" : "\"");
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
  const int allowed = std::max(1, static_cast<int>(wanted.size()) / 3);
  std::string best;
  int best_distance = 0;
  bool best_left_out = false;
  std::size_t work = 0;  // of comparing: long lists of long names are not searched to their end
  for (const auto& name : known) {
    const std::string candidate = folded(name);
    const auto difference = static_cast<std::ptrdiff_t>(candidate.size()) - static_cast<std::ptrdiff_t>(wanted.size());
    if (std::abs(difference) > allowed && !candidate.starts_with(wanted)) continue;
    if ((work += wanted.size() * std::min(candidate.size(), wanted.size() + 1)) > 1'000'000) break;
    int distance = edit_distance(wanted, candidate);
    // A word cut short ("mod" for "modulation_frequency") is near, too.
    if (wanted.size() >= 3 && candidate.starts_with(wanted)) distance = std::min(distance, 2);
    // A letter that was left out ("sed" for "seed") is likelier than one that is another ("set").
    const bool left_out = distance == difference;
    if (best.empty() || distance < best_distance || (distance == best_distance && left_out && !best_left_out)) {
      best_left_out = left_out;
      best = name;
      best_distance = distance;
    }
  }
  const bool prefix = wanted.size() >= 3 && folded(best).starts_with(wanted);
  return !best.empty() && (best_distance <= allowed || prefix) ? best : std::string();
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
