// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// What JSON has and YAML has not.
namespace tofray::yaml {

/// Whether a text begins as JSON does: with a bracket or a double quote.
bool looks_like_json(std::string_view text);

/// A text whose surrogate pairs, as JSON escapes what is beyond U+FFFF (\ud83d\ude00), are each one escape of YAML's (\U0001F600).
struct JoinedSurrogates {
  std::string text;
  std::vector<std::size_t> behind;  ///< where in the text each of those escapes ends; it was two bytes longer
};
/// @param json  looks_like_json(): strings are all in double quotes, and a backslash begins an escape
JoinedSurrogates join_surrogates(std::string_view json);

}  // namespace tofray::yaml
