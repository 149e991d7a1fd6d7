// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "dataset/forms.h"

/// `scatter` in a set's list of objects: how many of what, and where they may be put.
namespace tofray::dataset {

namespace {

using base::in_quotes;
using yaml::Node;

constexpr const char* scatter_example =
    "{name: clutter, count: 5, of: {sphere: {center: [0, 0, 0], radius: 5 cm, reflectivity: 50 %}}, surface: table}";

const Node& needed(const Node& map, const char* key) {
  const Node* found = map.find(key);
  if (found == nullptr)
    base::fail(map.place, std::string("scatter lacks the key ") + key, std::string("expected something like ") + scatter_example);
  return *found;
}

void refuse_unknown_keys(const Node& map) {
  const std::vector<std::string>& known = scatter_keys();
  if (map.kind != Node::Kind::map)
    base::fail(map.place, "scatter is not what belongs here", std::string("expected a map such as ") + scatter_example);
  for (const Node::Key& key : map.keys)
    if (std::find(known.begin(), known.end(), key.text) == known.end())
      base::fail(key.place, "unknown key " + in_quotes(key.text) + " in scatter" + base::did_you_mean(key.text, known),
                 "known keys: " + base::listed(known, "and"));
}

}  // namespace

const std::vector<std::string>& scatter_keys() {
  static const std::vector<std::string> keys{"name", "count", "of", "surface", "box", "view", "within", "turn", "gap", "tries", "unplaced"};
  return keys;
}

double Sample::quantity(const Node& node, const std::string& path, base::Dimension dimension, const char* expected) {
  Node value;
  std::string why;
  const auto amount = resolve(node, path, value) && value.kind == Node::Kind::scalar ? parse_amount(value.text, why) : std::nullopt;
  const bool zero = amount && amount->unit.empty() && amount->number == 0;
  if (!amount || (!zero && amount->dimensions() != dimensions_of(dimension)))
    base::fail(node.place, "a value of scatter is not what belongs here",
               "got " + yaml::describe(value.kind == Node::Kind::null ? node : value) + ", expected " + expected);
  return amount->si();
}

void Sample::scatter(const Node& map, const std::string& list_path, Node& into) {
  refuse_unknown_keys(map);
  const Node& name = needed(map, "name");
  if (name.kind != Node::Kind::scalar || name.text.empty())
    base::fail(name.place, "scatter's name is no word", "expected a name, by which its objects are drawn");
  Scatter out;
  out.path = list_path + "/" + name.text, out.place = map.place, out.first = into.items.size();
  claim(out.path, map.place);
  const double count = quantity(needed(map, "count"), out.path + "/count", base::Dimension::none, "a whole number of 0 to 1000");
  constexpr double most = 1000, most_tries = 65536;
  if (!(count >= 0 && count <= most) || count != std::floor(count))
    base::fail(map.find("count")->place, "scatter's count is not what belongs here", "expected a whole number of 0 to 1000");
  out.count = static_cast<std::size_t>(count);
  where(map, out);
  if (const Node* gap = map.find("gap")) out.gap_m = quantity(*gap, out.path + "/gap", base::Dimension::length, "a length such as 5 mm");
  if (const Node* tries = map.find("tries")) {
    const double number = quantity(*tries, out.path + "/tries", base::Dimension::none, "a whole number of 1 to 65536");
    if (!(number >= 1 && number <= most_tries) || number != std::floor(number))
      base::fail(tries->place, "scatter's tries are not what belongs here", "expected a whole number of 1 to 65536");
    out.tries = static_cast<int>(number);
  }
  if (!(out.gap_m >= 0)) base::fail(map.find("gap")->place, "scatter's gap is below 0", "expected a length such as 5 mm");
  if (const Node* unplaced = map.find("unplaced")) {
    if (unplaced->text != "drop" && unplaced->text != "again" && unplaced->text != "fail")
      base::fail(unplaced->place, "unplaced is not what belongs here",
                 "got " + yaml::describe(*unplaced) + ", expected drop, again or fail: what becomes of an object that finds no room");
    out.unplaced = unplaced->text == "fail"    ? Scatter::Unplaced::fail
                   : unplaced->text == "again" ? Scatter::Unplaced::again
                                               : Scatter::Unplaced::drop;
  }
  constexpr double two_pi = 6.283185307179586;
  for (std::size_t k = 0; k < out.count; ++k) {
    const std::string path = out.path + "[" + std::to_string(k) + "]";
    add_scattered(needed(map, "of"), path, name.text + "[" + std::to_string(k) + "]", into);
    const Node* turn = map.find("turn");
    out.turns_rad.push_back(
        turn != nullptr ? quantity(*turn, path + "/turn", base::Dimension::angle, "an angle such as 30 deg, or a form that draws one")
                        : two_pi * unit_number(bits(Per::scene, path + "/turn")));
  }
  scatters_.push_back(std::move(out));
}

void Sample::where(const Node& map, Scatter& out) {
  const Node *surface = map.find("surface"), *box = map.find("box"), *view = map.find("view"), *within = map.find("within");
  if ((surface != nullptr ? 1 : 0) + (box != nullptr ? 1 : 0) + (view != nullptr ? 1 : 0) != 1)
    base::fail(map.place, "scatter does not say where",
               "expected one of surface: NAME, box: [[x, y, z], [x, y, z]] and view: [0.5 m, 3 m]");
  if (surface != nullptr) {
    Node value;
    if (!resolve(*surface, out.path + "/surface", value) || value.kind != Node::Kind::scalar)
      base::fail(surface->place, "surface is no name", "expected the name of an object");
    out.surface = value.text;
  }
  const auto metres = [&](const Node& list, const std::string& path, std::size_t count) {
    std::vector<double> out_m;
    if (list.kind != Node::Kind::list || list.items.size() != count)
      base::fail(list.place, "a list of scatter has the wrong length",
                 "got " + yaml::describe(list) + ", expected " + std::to_string(count) + " lengths");
    for (std::size_t i = 0; i < count; ++i)
      out_m.push_back(quantity(list.items[i], path + "[" + std::to_string(i) + "]", base::Dimension::length, "a length such as 0.5 m"));
    return out_m;
  };
  if (box != nullptr) {
    if (box->kind != Node::Kind::list || box->items.size() != 2)
      base::fail(box->place, "box is not what belongs here", "expected two corners, as in [[-1 m, 0 m, 1 m], [1 m, 1 m, 2 m]]");
    for (std::size_t i = 0; i < 2; ++i)
      for (const double one : metres(box->items[i], out.path + "/box[" + std::to_string(i) + "]", 3)) out.box.push_back(one);
    for (std::size_t i = 0; i < 3; ++i)
      if (out.box[i] > out.box[i + 3])
        base::fail(box->place, "box ends before it begins", "expected the corner of the smaller x, y and z first");
  }
  if (view != nullptr) {
    const std::vector<double> ends = metres(*view, out.path + "/view", 2);
    out.near_m = ends[0], out.far_m = ends[1];
    if (!(out.near_m > 0 && out.near_m <= out.far_m))
      base::fail(view->place, "view is not what belongs here",
                 "expected two distances from the camera, the nearer one first, as in [0.5 m, 3 m]");
  }
  if (within != nullptr) {
    if (surface == nullptr)
      base::fail(within->place, "`within` stands beside something else than surface", "expected it with surface: how far from its middle");
    out.within_m = quantity(*within, out.path + "/within", base::Dimension::length, "a length such as 1 m");
    if (!(out.within_m > 0)) base::fail(within->place, "`within` is not above 0", "expected a length such as 1 m");
  }
}

void Sample::add_scattered(const Node& of, const std::string& path, const std::string& name, Node& into) {
  Node value;
  if (!resolve(of, path + "/of", value) || value.kind != Node::Kind::map || value.items.size() != 1 ||
      value.items[0].kind != Node::Kind::map)
    base::fail(of.place, "`of` is no object",
               "got " + yaml::describe(value.kind == Node::Kind::null ? of : value) +
                   ", expected one such as {sphere: {center: [0, 0, 0], radius: 5 cm, reflectivity: 50 %}}");
  Node& keys = value.items[0];
  for (const char* own : {"position", "keyframes", "name"})
    if (const Node* there = keys.find(own))
      base::fail(there->place, std::string("a scattered object has a ") + own + " of its own", "expected none: scatter gives it");
  Node called;
  called.kind = Node::Kind::scalar, called.text = name, called.place = of.place, called.quoted = true;
  keys.keys.push_back({"name", of.place}), keys.items.push_back(std::move(called));
  into.height = std::max(into.height, value.height + 1);
  into.items.push_back(std::move(value));
}

}  // namespace tofray::dataset
