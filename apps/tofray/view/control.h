// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "tofray/scene.h"

/// What a page tells the viewer, as text messages.
namespace tofray::view {

/// How many frames a second: the camera's own rate, as many as are drawn, or a number.
struct Rate {
  enum class Kind { own, most, number } kind = Kind::own;
  double hz = 0;
  bool operator==(const Rate&) const = default;
};

/// Two states may be looked at beside each other.
enum class Side : std::uint8_t { a, b };

struct Want {
  std::vector<std::uint16_t> arrays;  ///< each once, in order
  std::optional<Rate> rate;
};
struct Visible {
  bool visible = true;
};
struct Acknowledge {
  std::uint32_t sequence = 0;
  Side side = Side::a;
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
  Side side = Side::a;
};
/// Why are these pixels wrong, both corners included.
struct WhyQuestion {
  std::uint64_t id = 0;
  int u0 = 0, v0 = 0, u1 = 0, v1 = 0;
  bool region = false;  ///< asked for as one
  Side side = Side::a;
};
struct Fit {
  std::string array;
};
/// Key and value as of --set.
using Overrides = std::vector<std::pair<std::string, std::string>>;
/// A change of a side's state.
struct Edit {
  enum class Kind : std::uint8_t {
    set,
    unset,  ///< takes the key out of the list of --set
    seed,
    state,  ///< list and seed at once
    open,   ///< side B, with this list
    close,
  } kind = Kind::set;
  std::uint64_t id = 0;
  Side side = Side::a;
  std::string key, text;
  std::optional<std::uint64_t> seed;
  Overrides overrides;
  std::string scene;  ///< of `open`: a built-in scene's or profile's name; empty: side A's scene
};
/// What is told once, to who asks.
struct Query {
  enum class Kind : std::uint8_t { controls, save } kind = Kind::controls;
  std::uint64_t id = 0;
  Side side = Side::a;
};
/// The scene as it stands, in three dimensions.
struct SceneQuestion {
  std::uint64_t id = 0;
  Side side = Side::a;
};
/// An object pulled from pixel to pixel.
struct Drag {
  enum class How : std::uint8_t {
    parallel,  ///< to the image: what was under the cursor stays there
    along,     ///< the ray of the first pixel
    turn,
    scale,
  } how = How::parallel;
  std::uint64_t id = 0;
  Side side = Side::a;
  int object = 0;                     ///< index in Scene::objects
  int from_u = 0, from_v = 0;         ///< where it was taken
  double to_u = 0, to_v = 0;          ///< the cursor; may be beside the image
  std::optional<std::uint32_t> base;  ///< generation of the state that it was taken in; none: that in force
};
/// An object's place or the camera's pose in the world.
struct Place {
  std::uint64_t id = 0;
  Side side = Side::a;
  std::optional<int> object;  ///< index in Scene::objects; none: the camera
  std::optional<Vec3> position;
  std::optional<std::array<Vec3, 3>> rotation;  ///< rows
  std::optional<std::uint32_t> base;
};
/// From pixel to pixel.
struct Measure {
  std::uint64_t id = 0;
  Side side = Side::a;
  int u[2] = {}, v[2] = {};
};
/// How good depth is in a region, both corners included.
struct RegionQuestion {
  std::uint64_t id = 0;
  Side side = Side::a;
  int u0 = 0, v0 = 0, u1 = 0, v1 = 0;
};
/// Noise over frames of a scene that stands still.
struct Temporal {
  std::uint64_t id = 0;
  Side side = Side::a;
  int frames = 200;
};
/// The frame as a picture, with the state in it.
struct Screenshot {
  std::uint64_t id = 0;
  Side side = Side::a;
};
/// Which state the text of such a picture is of.
struct Restore {
  std::uint64_t id = 0;
  Side side = Side::a;
  std::string text;
};
/// What is asked of a page's newest frame; of each kind the newest question of a page counts.
using Inquiry = std::variant<SceneQuestion, Drag, Place, Measure, RegionQuestion, Temporal, Screenshot, Restore>;
/// Files of frames, written while the view goes on.
struct Order {
  enum class Kind : std::uint8_t {
    record,  ///< as `tofray render` writes them
    page,    ///< a page that needs no server
    stop,    ///< gives up what the page ordered
  } kind = Kind::record;
  std::uint64_t id = 0;
  Side side = Side::a;
  std::uint64_t first = 0, frames = 1;
};

/// A message that is none of these: what to answer.
struct Refused {
  std::optional<std::uint64_t> id;
  std::string text, more;
};

using Control = std::variant<Refused, Want, Visible, Acknowledge, Play, Seek, PixelQuestion, WhyQuestion, Fit, Edit, Query, Inquiry, Order>;

/// Reads one message. Throws nothing but for a lack of memory.
Control parse_control(std::string_view text);

/// "own", "max" or a number of 0.01 to 1000; nothing for others.
std::optional<Rate> parse_rate(std::string_view text);

}  // namespace tofray::view
