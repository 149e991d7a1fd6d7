// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "base/faults.h"

namespace tofray::mesh {

/// Whether a word is a keyword but for the case of its letters. @param small  the keyword in small letters
bool equals_in_any_case(std::string_view word, std::string_view small);

/// Where a word stands; both count from 1.
struct Mark {
  std::size_t line = 1, column = 1;
};

/// The words of a text and where they stand. Lines end with LF, CR LF or CR; a byte order mark at the beginning is read past.
class Words {
 public:
  /// Of OBJ: a word that begins with '#' begins a comment, which lasts to the line's end; a backslash at a line's end joins the next line
  /// to it. Of MTL: likewise, but that "#!" at a line's beginning begins no comment.
  enum class Style { plain, obj, mtl };

  /// @param from  where in the text to begin
  /// @param line  which line that is
  Words(std::string_view text, const std::string& name, Style style = Style::plain, std::size_t from = 0, std::size_t line = 1);

  /// The next word of this line. @return false at its end
  bool in_line(std::string_view& word);
  /// The words that are left of this line, a blank between two.
  std::string rest_of_line();
  /// Goes behind this line's end. @return false where the text ends
  bool next_line();
  /// The next word of this line or of a later one. @return false where there is none
  bool next(std::string_view& word);

  /// Of the word that was read last; where there was none, of the place where it would have been.
  [[nodiscard]] Mark mark() const { return {word_line_, word_start_ - line_start_of_word_ + 1}; }
  /// @param file  the text's name
  static base::Place place(const Mark& mark, std::shared_ptr<const std::string> file);
  /// Bytes of the text that are read.
  [[nodiscard]] std::size_t position() const { return at_; }
  [[nodiscard]] std::size_t left() const { return text_.size() - at_; }

  /// @throws Error at the mark, or at that of the last word
  [[noreturn]] void fail(const Mark& mark, const std::string& what, const std::string& more, ErrorKind kind = ErrorKind::bad_input) const;
  [[noreturn]] void fail(const std::string& what, const std::string& more, ErrorKind kind = ErrorKind::bad_input) const;

 private:
  [[nodiscard]] bool line_goes_on() const;
  [[nodiscard]] bool comment_begins() const;
  void pass_line_end();
  void pass_blanks();

  std::string_view text_;
  const std::string& name_;
  bool obj_, mtl_;
  std::size_t at_, line_, line_start_;
  std::size_t word_start_, word_line_, line_start_of_word_;
};

}  // namespace tofray::mesh
