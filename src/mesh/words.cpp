// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/words.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace tofray::mesh {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }

int to_place(std::size_t number) { return static_cast<int>(std::min<std::size_t>(number, std::numeric_limits<int>::max())); }

}  // namespace

bool equals_in_any_case(std::string_view word, std::string_view small) {
  return std::equal(word.begin(), word.end(), small.begin(), small.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b; });
}

Words::Words(std::string_view text, const std::string& name, Style style, std::size_t from, std::size_t line)
    : text_(text), name_(name), obj_(style != Style::plain), mtl_(style == Style::mtl), at_(from), line_(line), line_start_(from) {
  if (from == 0 && text.starts_with("\xEF\xBB\xBF")) at_ = line_start_ = 3;
  word_start_ = line_start_of_word_ = at_;
  word_line_ = line_;
}

bool Words::line_goes_on() const { return obj_ && text_[at_] == '\\' && at_ + 1 < text_.size() && is_line_end(text_[at_ + 1]); }

// Not within a word: 1.#INF is a number, m#1 a name.
bool Words::comment_begins() const {
  if (!obj_ || text_[at_] != '#' || !(at_ == line_start_ || is_blank(text_[at_ - 1]))) return false;
  const std::string_view before = text_.substr(line_start_, at_ - line_start_);
  return !(mtl_ && text_.substr(at_).starts_with("#!") && std::all_of(before.begin(), before.end(), is_blank));
}

void Words::pass_line_end() {
  at_ += text_.substr(at_).starts_with("\r\n") ? 2 : 1;
  ++line_;
  line_start_ = at_;
}

void Words::pass_blanks() {
  while (at_ < text_.size()) {
    const bool goes_on = line_goes_on();
    if (!goes_on && !is_blank(text_[at_])) break;
    ++at_;
    if (goes_on) pass_line_end();
  }
}

bool Words::in_line(std::string_view& word) {
  pass_blanks();
  word_start_ = at_;
  word_line_ = line_;
  line_start_of_word_ = line_start_;
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (is_blank(c) || is_line_end(c) || comment_begins() || line_goes_on()) break;
  }
  word = text_.substr(word_start_, at_ - word_start_);
  return !word.empty();
}

std::string Words::rest_of_line() {
  std::string out;
  for (std::string_view word; in_line(word);) {
    if (!out.empty()) out += ' ';
    out += word;
  }
  return out;
}

bool Words::next_line() {
  bool comment = false;
  for (; at_ < text_.size(); ++at_) {
    if (is_line_end(text_[at_])) {
      pass_line_end();
      return true;
    }
    comment = comment || comment_begins();
    if (comment || !line_goes_on()) continue;
    ++at_;
    pass_line_end();
    --at_;  // the loop goes on with the next line's first byte
  }
  return false;
}

bool Words::next(std::string_view& word) {
  while (!in_line(word))
    if (!next_line()) return false;
  return true;
}

base::Place Words::place(const Mark& mark, std::shared_ptr<const std::string> file) {
  return {std::move(file), to_place(mark.line), to_place(mark.column)};
}

void Words::fail(const Mark& mark, const std::string& what, const std::string& more, ErrorKind kind) const {
  base::fail(place(mark, std::make_shared<const std::string>(name_)), what, more, kind);
}

void Words::fail(const std::string& what, const std::string& more, ErrorKind kind) const { fail(mark(), what, more, kind); }

}  // namespace tofray::mesh
