// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

/// Small helpers for texts that people read.
namespace tofray::base {

/// Length of the UTF-8 character at i, 0 where the bytes are none (overlong forms, surrogates and more than U+10FFFF are none).
std::size_t utf8_length(std::string_view text, std::size_t i);

/// The text with the control characters of ASCII and bytes that are not UTF-8 as \xNN, and with other control characters and those that
/// turn the direction of writing or end a line as \uNNNN: what comes from outside cannot steer a terminal, nor look like what it is not.
/// JSON, whose strings hold neither of the former, stays JSON.
std::string printable(std::string_view text);
/// printable() of a text that keeps its ends of lines and tabs.
std::string printable_lines(std::string_view text);

/// A message of several lines as it may be shown: each line printable() and at most limit::message_line_bytes (the middle of a longer one
/// is cut out), all of it at most limit::message_bytes.
std::string message(std::string_view text);

/// The text in double quotes for an error message: printable, cut after `longest` bytes.
std::string in_quotes(std::string_view text, std::size_t longest = 60);

/// Edits (insert, delete, replace, swap neighbours) that turn one word into the other.
int edit_distance(std::string_view a, std::string_view b);

/// The known word that a mistyped one most likely means; empty where none is near. Case and '-' against '_' count little.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

/// `; did you mean "…"?`, or nothing where no known word is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

/// "a", "a or b", "a, b or c".
std::string listed(const std::vector<std::string>& words, std::string_view last = "or");

/// A number in the fewest digits that read back to the same double, independent of the locale.
std::string number_text(double value);

}  // namespace tofray::base
