// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dataset/forms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/text.h"
#include "num/setup_math.h"
#include "yaml/near_misses.h"

namespace tofray::dataset {

namespace {

using base::in_quotes;
using yaml::Node;

constexpr double two_pi = 6.283185307179586;

Node scalar(std::string text, const base::Place& place) {
  Node node;
  node.kind = Node::Kind::scalar, node.text = std::move(text), node.place = place;
  return node;
}

Node list_of(std::vector<Node> items, const base::Place& place) {
  Node node;
  node.kind = Node::Kind::list, node.items = std::move(items), node.place = place, node.height = 1;
  return node;
}

bool is_one_of(const std::string& word, const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_expression(const Node& node) { return node.kind == Node::Kind::scalar && node.text.starts_with('='); }

/// Both ends in one unit.
void join(Amount& a, Amount& b, const base::Place& place) {
  if (a.unit == b.unit) return;
  if (a.unit.empty() && a.number == 0) return void(a.unit = b.unit);
  if (b.unit.empty() && b.number == 0) return void(b.unit = a.unit);
  if (a.dimensions() != b.dimensions())
    base::fail(place, "the numbers of a form are of different kinds",
               "got " + in_quotes(a.text()) + " and " + in_quotes(b.text()) + ", expected both with a unit of one kind");
  a = *amount_of(a.si(), a.dimensions()), b = *amount_of(b.si(), b.dimensions());
}

[[noreturn]] void wrong(const Node& node, const std::string& form, const std::string& expected) {
  base::fail(node.place, "the form " + form + " is not what belongs here", "got " + yaml::describe(node) + ", expected " + expected);
}

}  // namespace

/// A map that is a form, taken apart.
struct Sample::Form {
  const Node* node = nullptr;
  std::string name;
  const Node* argument = nullptr;
  const Node *within = nullptr, *weights = nullptr;
  Per per = Per::scene;
};

namespace {

Per per_of(const Node& node) {
  const std::pair<const char*, Per> names[] = {
      {"set", Per::set}, {"device", Per::device}, {"scene", Per::scene}, {"view", Per::view}, {"frame", Per::view}};
  for (const auto& [name, per] : names)
    if (node.kind == Node::Kind::scalar && node.text == name) return per;
  base::fail(node.place, "`per` is not what belongs here",
             "got " + yaml::describe(node) + ", expected set, device, scene, view or frame: what the value is drawn anew for");
}

/// The form's key; npos where the map is none. @throws Error where something else stands beside a form
std::size_t form_key(const Node& node) {
  if (node.kind != Node::Kind::map) return std::string::npos;
  static const std::vector<std::string> beside{"within", "per", "weights"};
  std::size_t found = std::string::npos;
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    if (!is_one_of(node.keys[i].text, yaml::forms_of_sets())) continue;
    if (found != std::string::npos && node.keys[i].text != "normal" && node.keys[found].text != "normal")
      base::fail(node.keys[i].place, "two forms stand in one map: " + node.keys[found].text + " and " + node.keys[i].text,
                 "expected one of them");
    if (found == std::string::npos || node.keys[found].text == "normal") found = i;
  }
  if (found == std::string::npos) return found;
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    if (i == found || is_one_of(node.keys[i].text, beside)) continue;
    if (node.keys[found].text == "normal") return std::string::npos;  // a plane's normal, beside its other keys
    base::fail(node.keys[i].place,
               "beside the form " + node.keys[found].text + " stands the unknown key " + in_quotes(node.keys[i].text) +
                   base::did_you_mean(node.keys[i].text, beside),
               "expected the form alone, or with within, per or weights");
  }
  return found;
}

}  // namespace

Sample::Sample(const SetFile& set, const Fixed& fixed, std::uint64_t sample, std::uint64_t view, std::uint32_t attempt)
    : set_(set), fixed_(fixed), sample_(sample), view_(view), attempt_(attempt) {
  for (std::size_t i = 0; i < set_.let.keys.size(); ++i) {
    if (!is_name(set_.let.keys[i].text))
      base::fail(set_.let.keys[i].place, in_quotes(set_.let.keys[i].text) + " is no name for an expression",
                 "expected letters, digits and _, beginning with a letter; not min, max or sqrt");
    know(set_.let.keys[i].text, set_.let.keys[i].place);
  }
}

Address Sample::address(Per per) const {
  switch (per) {
    case Per::set: return {set_.seed, 0, 0, 0};
    case Per::device: return {set_.seed, sample_ % set_.devices, 0, 0};
    case Per::scene: return {set_.seed, sample_, 0, attempt_};
    case Per::view: return {set_.seed, sample_, static_cast<std::uint32_t>(view_), attempt_};
  }
  return {};
}

Sample::Index Sample::index(Per per) const {
  switch (per) {
    case Per::set: return {0, 1};
    case Per::device: return {sample_ % set_.devices, set_.devices};
    case Per::scene: return {sample_, set_.samples};
    case Per::view: return {sample_ * set_.views + view_, set_.samples * set_.views};
  }
  return {0, 1};
}

std::uint64_t Sample::bits(Per per, const std::string& path) const { return random_bits(address(per), path); }

std::uint64_t Sample::seed(Per per, std::string_view path) const { return random_bits(address(per), path) >> 11; }

void Sample::claim(const std::string& path, const base::Place& place) {
  if (!claimed_.insert(path).second)
    base::fail(place, "two values have one path, " + in_quotes(path) + ", and would be drawn alike",
               "expected another name for one of the objects");
}

void Sample::note(const Form& form, const std::string& path, std::string text, double value) {
  drawn_.push_back({path, form.name, std::move(text), value});
}

bool Sample::is_drawn_here(Per per) const {
  switch (per) {
    case Per::set: return false;
    case Per::device: return sample_ < set_.devices && view_ == 0;
    case Per::scene: return view_ == 0;
    case Per::view: return true;
  }
  return false;
}

void Sample::locate(Per per, const std::string& path, const std::string& form, const std::optional<Portion>& where) {
  if (where && is_drawn_here(per)) placed_.push_back({path, form, *where, unit_number(bits(per, path + "#place"))});
}

void Sample::judge(Judgement& into) const {
  for (const Placed& one : placed_) {
    std::string path = one.path;
    // Objects of one scatter are drawn by one law.
    for (const Scatter& scatter : scatters_)
      if (path.starts_with(scatter.path + "[")) path = scatter.path + "[*" + path.substr(path.find(']', scatter.path.size()));
    DrawCounts& counts = into[path];
    counts.form = one.form, counts.add(one.where, one.spread);
  }
}

void Sample::draw_row(const Node& node, const Node& table, const std::string& name) {
  const auto read = fixed_.tables.find(&table);
  const Node* per = node.find("per");
  if (read == fixed_.tables.end() || node.keys.size() != (per == nullptr ? 1U : 2U))
    wrong(node, "table", "a CSV file's name, as in {table: lamps.csv}, and per alone beside it");
  const std::string path = "let/" + name;
  claim(path, node.place);
  const Per anew = per == nullptr ? Per::scene : per_of(*per);
  const auto row = static_cast<std::size_t>(integer(1, static_cast<std::int64_t>(read->second.size()) - 1, bits(anew, path)));
  locate(anew, path, "table", place_among(static_cast<double>(row - 1), static_cast<double>(read->second.size() - 1)));
  for (std::size_t i = 0; i < read->second[0].size(); ++i) rows_[name][read->second[0][i]] = read->second[row][i];
  drawn_.push_back({path, "table", base::listed(read->second[row], "and"), static_cast<double>(row - 1)});
}

void Sample::know(const std::string& name, const base::Place& place) {
  if (known_.contains(name) || rows_.contains(name)) return;
  const Node* node = set_.let.find(name);
  if (node == nullptr) {
    std::vector<std::string> names;
    for (const auto& key : set_.let.keys) names.push_back(key.text);
    base::fail(place, in_quotes(name) + " is no name of `let`" + base::did_you_mean(name, names),
               names.empty() ? "the set has no `let`" : "it has " + base::listed(names, "and"));
  }
  if (is_one_of(name, asked_))
    base::fail(node->place, in_quotes(name) + " of `let` is made of itself", "expected names that do not go in a circle");
  asked_.push_back(name);
  if (const Node* table = node->kind == Node::Kind::map ? node->find("table") : nullptr) {
    draw_row(*node, *table, name);
  } else {
    Node value;
    if (!resolve(*node, "let/" + name, value) || value.kind != Node::Kind::scalar)
      base::fail(node->place, in_quotes(name) + " of `let` is no single value",
                 "got " + yaml::describe(value) + ", expected a number, a word, or a form that makes one");
    std::string why;
    const auto amount = value.quoted ? std::nullopt : parse_amount(value.text, why);
    known_.emplace(name, amount ? Named(*amount) : Named(value.text));
  }
  asked_.pop_back();
}

Named Sample::named(std::string_view written, const base::Place& place) {
  const std::size_t dot = written.find('.');
  const std::string name(written.substr(0, dot)), column = dot == std::string_view::npos ? "" : std::string(written.substr(dot + 1));
  know(name, place);
  const auto row = rows_.find(name);
  if (row == rows_.end()) {
    if (!column.empty()) base::fail(place, in_quotes(name) + " of `let` is no table and has no columns", "expected its name alone");
    return known_.find(name)->second;
  }
  const auto cell = row->second.find(column);
  if (cell == row->second.end()) {
    std::vector<std::string> columns;
    for (const auto& [one, text] : row->second) columns.push_back(one);
    base::fail(place,
               column.empty() ? in_quotes(name) + " of `let` is a row of a table"
                              : in_quotes(name) + " has no column " + in_quotes(column) + base::did_you_mean(column, columns),
               "expected " + name + "." + base::listed(columns));
  }
  std::string why;
  if (const auto amount = parse_amount(cell->second, why)) return *amount;
  return cell->second;
}

Node Sample::scene() {
  Node out;
  resolve_items(set_.scene, "", out);
  // Seeds that must differ from sample to sample, or from device to device, where nothing is said of them.
  if (Node* transport = out.find("transport"); transport != nullptr && transport->kind == Node::Kind::map &&
                                               transport->find("bounces") != nullptr && transport->find("seed") == nullptr) {
    transport->keys.push_back({"seed", transport->place});
    transport->items.push_back(scalar(std::to_string(seed(Per::view, "transport/seed")), transport->place));
  }
  return out;
}

std::vector<std::pair<std::string, std::string>> Sample::settings() {
  std::vector<std::pair<std::string, std::string>> out;
  constexpr const char* pattern = "camera.pixel.patterns.seed";
  if (set_.devices > 1 && set_.set.find(pattern) == nullptr)
    out.emplace_back(pattern, std::to_string(seed(Per::device, "set/camera.pixel.patterns.seed")));
  for (std::size_t i = 0; i < set_.set.keys.size(); ++i) {
    Node value;
    if (resolve(set_.set.items[i], "set/" + set_.set.keys[i].text, value)) out.emplace_back(set_.set.keys[i].text, yaml::flow_text(value));
  }
  return out;
}

void Sample::resolve_items(const Node& node, const std::string& path, Node& into) {
  into = Node();
  into.kind = node.kind, into.place = node.place;
  const bool map = node.kind == Node::Kind::map;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const Node& item = node.items[i];
    Node value;
    if (map) {
      const std::string& key = node.keys[i].text;
      const std::string below = path.empty() ? key : path + "/" + key;
      if (path == "camera" && key == "pose" && item.kind == Node::Kind::map && item.find("look") != nullptr) {
        see_look(item);
        continue;
      }
      if (key == "rotation" && item.kind == Node::Kind::scalar && item.text == "any")
        draw_rotation(item, below, value);
      else if (!resolve(item, below, value))
        continue;
      into.keys.push_back(node.keys[i]);
    } else if (path == "objects" && item.kind == Node::Kind::map && item.keys.size() == 1 && item.keys[0].text == "scatter") {
      scatter(item.items[0], path, into);
      continue;
    } else {
      // - sphere: {name: ball, …} goes by its name.
      const bool object = item.kind == Node::Kind::map && item.keys.size() == 1 && item.items[0].kind == Node::Kind::map &&
                          form_key(item) == std::string::npos && form_key(item.items[0]) == std::string::npos;
      const Node* name = object ? item.items[0].find("name") : nullptr;
      const bool named = name != nullptr && name->kind == Node::Kind::scalar && !is_expression(*name);
      if (object) {
        value.kind = Node::Kind::map, value.place = item.place, value.keys = item.keys, value.items.resize(1);
        resolve_items(item.items[0], named ? path + "/" + name->text : path + "[" + std::to_string(i) + "]", value.items[0]);
        value.height = value.items[0].height + 1;
      } else if (!resolve(item, path + "[" + std::to_string(i) + "]", value)) {
        base::fail(item.place, "a chance stands in a list, where nothing can be left out", "expected it as the value of a key");
      }
    }
    into.height = std::max(into.height, value.height + 1);
    into.items.push_back(std::move(value));
  }
}

bool Sample::resolve(const Node& node, const std::string& path, Node& into) {
  if (is_expression(node)) {
    const Named value =
        evaluate(std::string_view(node.text).substr(1), node.place, [&](std::string_view name) { return named(name, node.place); });
    const auto* text = std::get_if<std::string>(&value);
    into = scalar(text != nullptr ? *text : std::get<Amount>(value).text(), node.place);
    return true;
  }
  const std::size_t key = form_key(node);
  if (key == std::string::npos) {
    if (node.kind != Node::Kind::map && node.kind != Node::Kind::list) return into = node, true;
    resolve_items(node, path, into);
    return true;
  }
  Form form;
  form.node = &node, form.name = node.keys[key].text, form.argument = &node.items[key];
  form.within = node.find("within"), form.weights = node.find("weights");
  const Node* per = node.find("per");
  form.per = per != nullptr ? per_of(*per) : path.starts_with("camera/pose") ? Per::view : Per::scene;
  if (form.within != nullptr && form.name != "normal")
    base::fail(form.within->place, "`within` stands beside " + form.name, "expected it beside normal alone");
  if (form.weights != nullptr && form.name != "choice" && form.name != "files")
    base::fail(form.weights->place, "`weights` stands beside " + form.name, "expected it beside choice or files");
  claim(path, node.place);
  return resolve_form(form, path, into);
}

Amount Sample::amount(const Node& node, const std::string& form) {
  if (node.kind != Node::Kind::scalar) wrong(node, form, "a number");
  if (is_expression(node)) {
    const Named value =
        evaluate(std::string_view(node.text).substr(1), node.place, [&](std::string_view name) { return named(name, node.place); });
    if (const auto* amount = std::get_if<Amount>(&value)) return *amount;
    wrong(node, form, "a number");
  }
  std::string why;
  const auto amount = parse_amount(node.text, why);
  if (!amount) base::fail(node.place, why, "expected a number with its unit, such as \"0.5 m\"");
  return *amount;
}

std::vector<Amount> Sample::amounts(const Node& list, std::size_t count, const std::string& form) {
  if (list.kind != Node::Kind::list || list.items.size() != count)
    wrong(list, form, "a list of " + std::to_string(count) + " numbers, as in {" + form + ": [1 m, 3 m]}");
  std::vector<Amount> out;
  for (const Node& one : list.items) out.push_back(amount(one, form));
  for (Amount& one : out) join(out[0], one, list.place);
  for (Amount& one : out) join(out[0], one, list.place);  // the first may have got its unit from the last
  return out;
}

std::vector<double> Sample::weights(const Form& form, std::size_t count) const {
  std::vector<double> out;
  const auto add = [&](const Node& node) {
    std::string why;
    const auto weight = node.kind == Node::Kind::scalar ? parse_amount(node.text, why) : std::nullopt;
    if (!weight || !weight->dimensions().bare() || !(weight->si() >= 0) || weight->si() > 1e100)
      wrong(node, form.name, "a weight, such as 3 or 30 %");
    out.push_back(weight->si());
  };
  if (form.weights != nullptr) {
    if (form.weights->kind != Node::Kind::list || form.weights->items.size() != count)
      wrong(*form.weights, form.name, "weights: a list of " + std::to_string(count));
    for (const Node& one : form.weights->items) add(one);
  } else if (form.argument->kind == Node::Kind::map) {
    for (const Node& one : form.argument->items) add(one);
  } else {
    out.assign(count, 1);
  }
  if (std::all_of(out.begin(), out.end(), [](double one) { return one == 0; })) wrong(*form.node, form.name, "a weight that is not 0");
  return out;
}

/// uniform, log_uniform, normal, integer, even: between two numbers, or in a box between two lists of them.
Node Sample::drawn_number(const Form& form, const Node& ends, const std::string& path) {
  const std::string& name = form.name;
  if (name != "normal" && name != "integer" && ends.kind == Node::Kind::list && ends.items.size() == 2 &&
      ends.items[0].kind == Node::Kind::list && ends.items[1].kind == Node::Kind::list) {
    if (ends.items[0].items.size() != ends.items[1].items.size() || ends.items[0].items.empty())
      wrong(ends, name, "two corners with as many numbers");
    std::vector<Node> items;
    for (std::size_t i = 0; i < ends.items[0].items.size(); ++i)
      items.push_back(
          drawn_number(form, list_of({ends.items[0].items[i], ends.items[1].items[i]}, ends.place), path + "[" + std::to_string(i) + "]"));
    return list_of(std::move(items), form.node->place);
  }
  std::vector<Amount> of = amounts(ends, 2, name);
  Amount low{-std::numeric_limits<double>::infinity(), of[0].unit}, high{std::numeric_limits<double>::infinity(), of[0].unit};
  if (form.within != nullptr) {
    std::vector<Amount> within = amounts(*form.within, 2, "normal");
    for (Amount& one : within) {
      Amount mean = of[0], sigma = of[1];
      join(mean, one, form.within->place), join(sigma, one, form.within->place);
      if (mean.unit != of[0].unit) of = {mean, sigma};
    }
    for (Amount& one : within) join(of[0], one, form.within->place);
    low = within[0], high = within[1];
    if (!(low.number < high.number)) wrong(*form.within, "normal", "within: the lower end first, then a higher one");
  }
  const double a = of[0].number, b = of[1].number;
  if (name == "normal" && !(b >= 0)) wrong(ends, name, "a mean and a sigma that is not below 0");
  if (name != "normal" && !(a <= b)) wrong(ends, name, "the lower end first");
  if (name == "log_uniform" && !(a > 0)) wrong(ends, name, "ends above 0");
  const std::uint64_t random = bits(form.per, path);
  Amount value{0, of[0].unit};
  if (name == "uniform") value.number = uniform(a, b, random);
  if (name == "log_uniform") value.number = log_uniform(a, b, random);
  if (name == "normal") value.number = normal(a, b, low.number, high.number, random);
  if (name == "integer") {
    constexpr double most = 0x1p53;
    if (!of[0].unit.empty() || a != std::floor(a) || b != std::floor(b) || std::abs(a) > most || std::abs(b) > most)
      wrong(ends, name, "whole numbers without a unit, as in {integer: [3, 12]}");
    value.number = static_cast<double>(integer(static_cast<std::int64_t>(a), static_cast<std::int64_t>(b), random));
  }
  if (name == "even") {
    const Index at = index(form.per);
    const double stratum = static_cast<double>(permuted(at.at, at.count, set_.seed, path));
    const double u = (stratum + unit_number(random)) / static_cast<double>(at.count);
    value.number = std::clamp(a + (b - a) * u, a, b);
  }
  value.number += 0.0;
  note(form, path, value.text(), value.number);
  const double x = value.number;
  if (name == "uniform" || name == "even") locate(form.per, path, name, uniform_place(x, a, b));
  if (name == "log_uniform") locate(form.per, path, name, log_uniform_place(x, a, b));
  if (name == "normal") locate(form.per, path, name, normal_place(x, a, b, low.number, high.number));
  if (name == "integer") locate(form.per, path, name, place_among(x - a, b - a + 1));
  return scalar(value.text(), form.node->place);
}

bool Sample::one_of(const Form& form, std::size_t chosen, const std::string& path, Node& into) {
  const Node& argument = *form.argument;
  Node item = argument.kind == Node::Kind::map ? scalar(argument.keys[chosen].text, argument.keys[chosen].place) : argument.items[chosen];
  const std::size_t place = drawn_.size();
  note(form, path, "", static_cast<double>(chosen));
  const bool there = resolve(item, path + "[" + std::to_string(chosen) + "]", into);
  drawn_[place].text = there ? yaml::flow_text(into) : "";
  return there;
}

bool Sample::draw_choice(const Form& form, const std::string& path, Node& into) {
  const Node& argument = *form.argument;
  if ((argument.kind != Node::Kind::list && argument.kind != Node::Kind::map) || argument.items.empty() ||
      (argument.kind == Node::Kind::map && form.weights != nullptr))
    wrong(argument, "choice",
          "a list [a, b], with `weights` beside it where these are not alike, or a map {a: 3, b: 1} of words and weights");
  const std::vector<double> shares = weights(form, argument.items.size());
  const std::size_t chosen = weighted(shares, bits(form.per, path));
  locate(form.per, path, form.name, place_by_weight(chosen, shares));
  return one_of(form, chosen, path, into);
}

bool Sample::draw_grid(const Form& form, const std::string& path, Node& into) {
  const Node& argument = *form.argument;
  if (form.node->find("per") != nullptr)
    base::fail(form.node->find("per")->place, "`per` stands beside grid", "expected a grid alone: sample i has its value number i");
  const auto& grid = fixed_.grids.at(&argument);
  const std::uint64_t digit = sample_ % fixed_.combinations / grid.below % grid.size;
  if (argument.kind == Node::Kind::list) return one_of(form, static_cast<std::size_t>(digit), path, into);
  const Node *from = argument.find("from"), *to = argument.find("to");
  if (from == nullptr || to == nullptr || argument.keys.size() != 3) wrong(argument, "grid", "{from: 1 m, to: 3 m, n: 5}");
  Amount a = amount(*from, "grid"), b = amount(*to, "grid");
  join(a, b, argument.place);
  const double share = grid.size == 1 ? 0 : static_cast<double>(digit) / static_cast<double>(grid.size - 1);
  const Amount value{digit + 1 == grid.size && grid.size > 1 ? b.number : a.number + (b.number - a.number) * share, a.unit};
  note(form, path, value.text(), static_cast<double>(digit));
  into = scalar(value.text(), form.node->place);
  return true;
}

void Sample::draw_cap(const Form& form, const std::string& path, Node& into) {
  const Node& argument = *form.argument;
  const Node *around = argument.find("around"), *within = argument.find("within");
  if (argument.kind != Node::Kind::map || around == nullptr || within == nullptr || argument.keys.size() != 2)
    wrong(argument, "cap", "{around: [0, 0, 1], within: 20 deg}");
  const std::vector<Amount> axis = amounts(*around, 3, "cap");
  const Amount angle = amount(*within, "cap");
  double x[3], length = 0;
  for (int i = 0; i < 3; ++i) x[i] = axis[static_cast<std::size_t>(i)].number, length = num::setup::hypot(length, x[i]);
  const double widest = angle.si();
  if (!(length > 0) || angle.dimensions() != dimensions_of(base::Dimension::angle) || !(widest >= 0) || widest > two_pi / 2)
    wrong(argument, "cap", "a direction that is not 0 and an angle from 0 to 180 deg");
  for (double& one : x) one /= length;
  // 1 − cos θ is uniform from 0 to 1 − cos of the widest angle = 2 sin²(widest/2).
  const double half = num::setup::sin(0.5 * widest);
  const double down = 2 * half * half * unit_number(bits(form.per, path + "[0]")),
               turn = two_pi * unit_number(bits(form.per, path + "[1]"));
  const double sine = std::sqrt(std::max(0.0, down * (2 - down)));
  // Two directions at right angles to the axis and to each other: of the axis' smallest component's unit vector what is at right angles, and their cross product.
  const int k = std::abs(x[0]) <= std::abs(x[1]) && std::abs(x[0]) <= std::abs(x[2]) ? 0 : std::abs(x[1]) <= std::abs(x[2]) ? 1 : 2;
  double p[3], norm = 0;
  for (int i = 0; i < 3; ++i) p[i] = (i == k ? 1.0 : 0.0) - x[k] * x[i], norm = num::setup::hypot(norm, p[i]);
  for (double& one : p) one /= norm;
  const double q[3] = {x[1] * p[2] - x[2] * p[1], x[2] * p[0] - x[0] * p[2], x[0] * p[1] - x[1] * p[0]};
  std::vector<Node> items;
  const double c = sine * num::setup::cos(turn), s = sine * num::setup::sin(turn);
  for (int i = 0; i < 3; ++i) items.push_back(scalar(base::number_text((1 - down) * x[i] + c * p[i] + s * q[i] + 0.0), form.node->place));
  into = list_of(std::move(items), form.node->place);
  note(form, path, yaml::flow_text(into), down);
  locate(form.per, path, form.name, uniform_place(down, 0, 2 * half * half));
}

/// Uniform on all rotations (Shoemake 1992).
void Sample::draw_rotation(const Node& node, const std::string& path, Node& into) {
  claim(path, node.place);
  const Per per = path.starts_with("camera/pose") ? Per::view : Per::scene;
  double u[3];
  for (int i = 0; i < 3; ++i) u[i] = unit_number(bits(per, path + "[" + std::to_string(i) + "]"));
  const double a = std::sqrt(1 - u[0]), b = std::sqrt(u[0]);
  const double q[4] = {a * num::setup::sin(two_pi * u[1]), a * num::setup::cos(two_pi * u[1]), b * num::setup::sin(two_pi * u[2]),
                       b * num::setup::cos(two_pi * u[2])};
  std::vector<Node> items;
  for (const double one : q) items.push_back(scalar(base::number_text(one + 0.0), node.place));
  Node list = list_of(std::move(items), node.place);
  drawn_.push_back({path, "any", yaml::flow_text(list), u[0]});
  locate(per, path, "any", Portion{q[2] * q[2] + q[3] * q[3], 0});
  into = Node();
  into.kind = Node::Kind::map, into.place = node.place, into.height = 2;
  into.keys.push_back({"quaternion", node.place}), into.items.push_back(std::move(list));
}

std::size_t Sample::draw_file(const Form& form, std::size_t count, const std::string& path) {
  std::vector<std::size_t> pool(count);
  std::iota(pool.begin(), pool.end(), std::size_t{0});
  if (const auto pools = fixed_.pools.find(form.argument); pools != fixed_.pools.end()) {
    if (form.per != Per::scene && form.per != Per::view)
      base::fail(form.node->find("per")->place, "`per` stands beside files of a set that is split by asset",
                 "expected scene or view: a sample has files of its own split alone");
    pool = pools->second[static_cast<std::size_t>(split_of(set_, sample_))];
  }
  if (form.weights == nullptr) {
    const Index at = index(form.per);
    const std::size_t chosen = static_cast<std::size_t>(permuted(at.at, at.count, set_.seed, path) % pool.size());
    locate(form.per, path, form.name, place_among(static_cast<double>(chosen), static_cast<double>(pool.size())));
    return pool[chosen];
  }
  std::vector<double> all = weights(form, count), shares;
  for (const std::size_t one : pool) shares.push_back(all[one]);
  if (std::all_of(shares.begin(), shares.end(), [](double one) { return one == 0; }))
    base::fail(form.weights->place, "no file of a split has a weight that is not 0", "expected one in each split of the set");
  const std::size_t chosen = weighted(shares, bits(form.per, path));
  locate(form.per, path, form.name, place_by_weight(chosen, shares));
  return pool[chosen];
}

bool Sample::resolve_form(const Form& form, const std::string& path, Node& into) {
  const std::string& name = form.name;
  if (name == "choice") return draw_choice(form, path, into);
  if (name == "grid") return draw_grid(form, path, into);
  if (name == "cap") return draw_cap(form, path, into), true;
  if (name == "table") wrong(*form.node, "table", "it below `let`, and its columns by expressions such as \"= lamp.power\"");
  if (name == "files") {
    const auto found = fixed_.files.find(form.argument);
    if (found == fixed_.files.end()) wrong(*form.argument, "files", "a pattern such as \"assets/*.glb\"");
    const std::size_t chosen = draw_file(form, found->second.size(), path);
    note(form, path, found->second[chosen], static_cast<double>(chosen));
    into = scalar(found->second[chosen], form.node->place), into.quoted = true;
    return true;
  }
  if (name == "chance") {
    const Amount share = amount(*form.argument, name);
    if (!share.dimensions().bare() || !(share.si() >= 0 && share.si() <= 1))
      wrong(*form.argument, name, "a share from 0 to 1, such as 30 %");
    const bool there = unit_number(bits(form.per, path)) < share.si();
    locate(form.per, path, name, there ? Portion{0, share.si()} : Portion{share.si(), 1 - share.si()});
    note(form, path, there ? "true" : "", there ? 1 : 0);
    into = scalar("true", form.node->place);
    return there;
  }
  into = drawn_number(form, *form.argument, path);
  return true;
}

}  // namespace tofray::dataset
