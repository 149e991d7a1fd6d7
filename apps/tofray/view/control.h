// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// What a page tells the viewer, as text messages.
namespace tofray::view {

/// How many frames a second: the camera's own rate, as many as are drawn, or a number.
struct Rate {
  enum class Kind { own, most, number } kind = Kind::own;
  double hz = 0;
  bool operator==(const Rate&) const = default;
};

struct Want {
  std::vector<std::uint16_t> arrays;  ///< each once, in order
  std::optional<Rate> rate;
};
struct Visible {
  bool visible = true;
};
struct Acknowledge {
  std::uint32_t sequence = 0;
};
struct Play {
  bool playing = true;
};
struct Seek {
  std::uint64_t frame = 0;
};
struct PixelQuestion {
  std::uint64_t id = 0;
  int u = 0, v = 0;
};
struct Fit {
  std::string array;
};
/// A change of the state. What has no text takes the key out of the list of --set.
struct Edit {
  std::uint64_t id = 0;
  std::string key;  ///< empty: the seed
  std::optional<std::string> text;
  std::uint64_t seed = 0;
};
/// A message that is none of these: what to answer.
struct Refused {
  std::optional<std::uint64_t> id;
  std::string text, more;
};

using Control = std::variant<Refused, Want, Visible, Acknowledge, Play, Seek, PixelQuestion, Fit, Edit>;

/// Reads one message. Throws nothing but for a lack of memory.
Control parse_control(std::string_view text);

/// "own", "max" or a number of 0.01 to 1000; nothing for others.
std::optional<Rate> parse_rate(std::string_view text);

}  // namespace tofray::view
