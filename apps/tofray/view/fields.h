// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/text.h"
#include "files/json.h"
#include "view/control.h"

/// Reads what messages of a page hold.
namespace tofray::view::fields {

using files::Json;

constexpr std::uint64_t most_pixel = 16384;

struct Fault {
  std::string text, more;
};

inline const Json& member(const Json& message, const char* name) {
  const Json* found = message.find(name);
  if (found == nullptr) throw Fault{std::string("the message has no ") + base::in_quotes(name), ""};
  return *found;
}

inline std::string text_of(const Json& message, const char* name) {
  const Json& found = member(message, name);
  if (!found.is_string()) throw Fault{base::in_quotes(name) + " is no text", ""};
  return *found.string();
}

inline std::uint64_t whole(const Json& message, const char* name, std::uint64_t most) {
  std::uint64_t number = 0;
  if (!member(message, name).unsigned_integer(number) || number > most)
    throw Fault{base::in_quotes(name) + " is no whole number of 0 to " + std::to_string(most), ""};
  return number;
}

inline bool truth_of(const Json& message, const char* name) {
  const bool* found = member(message, name).boolean();
  if (found == nullptr) throw Fault{base::in_quotes(name) + " is neither true nor false", ""};
  return *found;
}

inline std::uint64_t id_of(const Json& message) { return whole(message, "id", UINT64_MAX); }

inline Side side_of(const Json& message) {
  const Json* found = message.find("side");
  if (found == nullptr) return Side::a;
  if (found->is_string() && *found->string() == "a") return Side::a;
  if (found->is_string() && *found->string() == "b") return Side::b;
  throw Fault{"\"side\" is neither a nor b", ""};
}

/// Two corners of a region, both in it, the smaller one first.
inline std::array<int, 4> corners_of(const Json& region) {
  const Fault wrong{"\"region\" is no list of two corners",
                    "expected [u0, v0, u1, v1], whole numbers of 0 to 16384, the smaller one first"};
  if (!region.is_array() || region.items()->size() != 4) throw wrong;
  std::array<int, 4> out{};
  for (std::size_t i = 0; i < 4; ++i) {
    std::uint64_t number = 0;
    if (!(*region.items())[i].unsigned_integer(number) || number > most_pixel) throw wrong;
    out[i] = static_cast<int>(number);
  }
  if (out[2] < out[0] || out[3] < out[1]) throw wrong;
  return out;
}

/// What is asked of a page's newest frame (inquiries.cpp); nothing where the type is another.
std::optional<Inquiry> inquiry_of(std::string_view type, const Json& message);

}  // namespace tofray::view::fields
