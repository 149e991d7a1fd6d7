// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "dataset/forms.h"

/// `look` in a camera's pose: at what, from where.
namespace tofray::dataset {

namespace {

using base::in_quotes;
using yaml::Node;

constexpr double pi = 3.141592653589793;
constexpr const char* look_example = "{look: {at: ball, radius: [0.8 m, 2 m], elevation: [-10 deg, 50 deg]}}";

}  // namespace

const std::vector<std::string>& look_keys() {
  static const std::vector<std::string> keys{"at", "radius", "elevation", "azimuth", "roll", "clear", "tries"};
  return keys;
}

void Sample::see_look(const Node& pose) {
  const Node& look = *pose.find("look");
  if (pose.keys.size() != 1)
    base::fail(pose.place, "beside look stands another key of a pose", std::string("expected it alone, as in ") + look_example);
  const std::vector<std::string>& known = look_keys();
  if (look.kind != Node::Kind::map)
    base::fail(look.place, "look is not what belongs here", std::string("expected a map, as in ") + look_example);
  for (const Node::Key& key : look.keys)
    if (std::find(known.begin(), known.end(), key.text) == known.end())
      base::fail(key.place, "unknown key " + in_quotes(key.text) + " in look" + base::did_you_mean(key.text, known),
                 "known keys: " + base::listed(known, "and"));
  for (const char* needed : {"at", "radius"})
    if (look.find(needed) == nullptr)
      base::fail(look.place, std::string("look lacks the key ") + needed, std::string("expected something like ") + look_example);
  look_ = &look;
}

/// A number, or evenly between the two of a list; anew in each view and try.
double Sample::look_value(const char* key, int attempt, double low, double high, base::Dimension dimension) {
  const std::string path = std::string("camera/pose/look/") + key;
  const std::string kind =
      dimension == base::Dimension::length ? "a length, or two, as in [0.8 m, 2 m]" : "an angle, or two, as in [-10 deg, 50 deg]";
  if (const Node* node = look_->find(key)) {
    if (node->kind == Node::Kind::list) {
      if (node->items.size() != 2)
        base::fail(node->place, std::string(key) + " of look is not what belongs here",
                   "got " + yaml::describe(*node) + ", expected " + kind);
      low = quantity(node->items[0], path + "[0]", dimension, kind.c_str()),
      high = quantity(node->items[1], path + "[1]", dimension, kind.c_str());
      if (low > high) base::fail(node->place, std::string(key) + " of look ends before it begins", "expected the lower end first");
    } else {
      claimed_.erase(path);  // the same form in each try
      low = high = quantity(*node, path, dimension, kind.c_str());
    }
  }
  return low + (high - low) * unit_number(bits(Per::view, path + "/" + std::to_string(attempt)));
}

Look Sample::draw_look(int attempt) {
  Look out;
  out.place = look_->place;
  const Node& at = *look_->find("at");
  claimed_.erase("camera/pose/look/at");
  if (at.kind == Node::Kind::list) {
    if (at.items.size() != 3)
      base::fail(at.place, "at of look is no point", "got " + yaml::describe(at) + ", expected three lengths or a name");
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string path = "camera/pose/look/at[" + std::to_string(i) + "]";
      claimed_.erase(path);
      out.at_m.push_back(quantity(at.items[i], path, base::Dimension::length, "a length such as 0.5 m"));
    }
  } else {
    Node value;
    if (!resolve(at, "camera/pose/look/at", value) || value.kind != Node::Kind::scalar)
      base::fail(at.place, "at of look is no name", "got " + yaml::describe(at) + ", expected the name of an object, or [x, y, z]");
    out.at_name = value.text;
  }
  out.radius_m = look_value("radius", attempt, 1, 1, base::Dimension::length);
  if (!(out.radius_m > 0))
    base::fail(look_->find("radius")->place, "radius of look is not above 0", "expected a length, or two, as in [0.8 m, 2 m]");
  out.elevation_rad = look_value("elevation", attempt, 0, 0, base::Dimension::angle);
  if (!(std::abs(out.elevation_rad) <= 0.5 * pi + 1e-12))
    base::fail(look_->find("elevation")->place, "elevation of look is beyond straight up or down", "expected -90 deg to 90 deg");
  out.azimuth_rad = look_value("azimuth", attempt, -pi, pi, base::Dimension::angle),
  out.roll_rad = look_value("roll", attempt, 0, 0, base::Dimension::angle);
  return out;
}

double Sample::look_clear() {
  constexpr double usual_m = 0.05;
  const Node* node = look_->find("clear");
  return node == nullptr ? usual_m : quantity(*node, "camera/pose/look/clear", base::Dimension::length, "a length such as 15 cm");
}

int Sample::look_tries() {
  const Node* node = look_->find("tries");
  if (node == nullptr) return 100;
  constexpr double most = 65536;
  const double tries = quantity(*node, "camera/pose/look/tries", base::Dimension::none, "a whole number of 1 to 65536");
  if (!(tries >= 1 && tries <= most) || tries != std::floor(tries))
    base::fail(node->place, "tries of look are not what belongs here", "expected a whole number of 1 to 65536");
  return static_cast<int>(tries);
}

}  // namespace tofray::dataset
