// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

/// Small helpers for texts that people read.
namespace tofray::base {

/// The text with control characters as \xNN.
std::string printable(std::string_view text);

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
