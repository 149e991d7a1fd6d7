// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "model/form.h"
#include "yaml/tree.h"

/// Documents and fields out of the readers' own tables, so that a new key is tested the day it is added.
namespace tofray::test {

using model::FileForm;
using model::ValueForm;
using yaml::Node;
using yaml::parse_value;

/// One value of a document: how to get there, and its form.
struct Field {
  std::vector<std::size_t> steps;
  std::string name;  ///< the key it belongs to
  const ValueForm* form;
};

inline Node scalar(const std::string& text) { return parse_value(text, base::whole("sample")); }

/// A valid value of the form with every key that can stand together; `v` chooses between alternatives, `k` moves numbers apart.
inline Node sample(const ValueForm& form, std::size_t v, int k = 0, const std::string& key = {}) {
  static const std::map<std::string, std::string> fixed = {
      {"sequence",
       "[{lit: true, modulation_frequency: 80.32 MHz, reference_phase: [0 deg, 90 deg, 180 deg, 270 deg], integration_time: 2000 us}]"},
      {"gain", "4"},
      {"gains", "[4]"},
      {"nonlinearity", "{charge: [0 e, 50000 e], read: [0 e, 48000 e]}"},
      {"phases",
       "[0 deg, 20 deg, 40 deg, 60 deg, 80 deg, 100 deg, 120 deg, 140 deg, 160 deg, 180 deg, 200 deg, 220 deg, 240 deg, 260 deg, 280 deg, "
       "300 deg]"},
      {"valid_max", "3750"},
      {"quaternion", "[0, 0.6, 0, 0.8]"},
      {"matrix", "[[0, -1, 0], [1, 0, 0], [0, 0, 1]]"}};
  if (const auto found = fixed.find(key); found != fixed.end()) return scalar(found->second);
  Node node;
  const auto map_of = [&](const ValueForm& map, Node& into) {
    into.kind = Node::Kind::map;
    const bool has_keyframes = std::any_of(map.keys.begin(), map.keys.end(), [](const auto& row) { return row.name == "keyframes"; });
    static const std::set<std::string> placed = {"pose", "position", "rotation", "velocity", "angular_velocity"};
    for (const auto& row : map.keys) {
      // Keyframes stand in the place of all these.
      if (has_keyframes && (v % 2 == 0 ? row.name == "keyframes" : placed.count(row.name) > 0)) continue;
      if (row.name == "file" && !row.required) continue;  // one of two ways to say numbers
      if (row.name == "pixel_phase") continue;            // a file that would have to be there
      const auto one_of = [&](const std::vector<std::string>& group) {
        const auto at = std::find(group.begin(), group.end(), row.name);
        const std::size_t count = group.size() - (std::count(group.begin(), group.end(), "file") > 0 ? 1 : 0);
        return at == group.end() || static_cast<std::size_t>(at - group.begin()) == v % count;
      };
      if (!one_of(map.exactly_one) || !one_of(map.at_most_one)) continue;
      // Keys that go with one way of saying a rotation.
      const auto has = [&](const char* name) {
        return std::any_of(map.keys.begin(), map.keys.end(), [&](const auto& other) { return other.name == name; });
      };
      const bool first_way = v % 4 == 0;
      if ((row.name == "up" && has("look_at") && !first_way) || (row.name == "axes" && ((has("look_at") && first_way) || has("mount"))) ||
          (row.name == "angle" && has("axis") && has("euler") && !first_way))
        continue;
      into.keys.push_back({row.name, {}});
      into.items.push_back(sample(row.form, v, k + (row.name == "max" || row.name == "end" || row.name == "look_at" ? 5 : 0), row.name));
    }
  };
  switch (form.kind) {
    case ValueForm::Kind::number: {
      const auto quantity = base::parse_quantity(form.example, form.dimension);
      const std::string number = std::to_string(std::stod(form.example) * (1 + 0.1 * k));
      return scalar(number + (quantity.unit.empty() ? "" : " " + quantity.unit));
    }
    case ValueForm::Kind::integer:
    case ValueForm::Kind::boolean:
    case ValueForm::Kind::text: return scalar(form.example);
    case ValueForm::Kind::choice: {
      const std::size_t first = form.names.front() == "none" ? 1 : 0;  // an amount of no light is refused
      return scalar(form.names[first + v % (form.names.size() - first)]);
    }
    case ValueForm::Kind::list: {
      node.kind = Node::Kind::list;
      const int count = form.min_items == 4 ? 16 : std::max(1, form.min_items);
      // Three points get coordinates that do not lie on a line.
      const bool points = form.min_items == 3 && form.forms[0].kind == ValueForm::Kind::list;
      for (int i = 0; i < count; ++i) {
        node.items.push_back(sample(form.forms[0], v, form.min_items == 4 ? 0 : k + i));
        for (int j = 0; points && j < 3; ++j)
          node.items.back().items[static_cast<std::size_t>(j)] = scalar(std::to_string(0.5 + 0.05 * ((i * 7 + j * j * 3 * i) % 11)));
      }
      return node;
    }
    case ValueForm::Kind::map: map_of(form, node); return node;
    case ValueForm::Kind::dictionary:
      node.kind = Node::Kind::map;
      node.keys.push_back({form.forms[0].kind == ValueForm::Kind::tagged ? "paper" : "MODE_9_5FPS_2000", {}});
      node.items.push_back(sample(form.forms[0], v));
      return node;
    case ValueForm::Kind::tagged:
      map_of(form.forms[v % form.forms.size()], node);
      node.keys.insert(node.keys.begin(), {form.tag, {}});
      node.items.insert(node.items.begin(), scalar(form.names[v % form.names.size()]));
      return node;
    case ValueForm::Kind::variant:
      node.kind = Node::Kind::map;
      node.keys.push_back({form.names[v % form.names.size()], {}});
      node.items.push_back(sample(form.forms[v % form.forms.size()], v / 2));
      return node;
    case ValueForm::Kind::either: return sample(form.forms[v % form.forms.size()], v / form.forms.size(), k);
    case ValueForm::Kind::anything: break;
  }
  return node;
}

/// All fields of a sample document, the root left out.
inline void collect(const ValueForm& form, const Node& node, Field at, std::vector<Field>& out) {
  at.form = &form;
  if (!at.steps.empty()) out.push_back(at);
  const auto step = [&](std::size_t i, const ValueForm& below, const std::string& name) {
    Field next = at;
    next.steps.push_back(i);
    next.name = name;
    collect(below, node.items[i], next, out);
  };
  switch (form.kind) {
    case ValueForm::Kind::list:
      for (std::size_t i = 0; i < node.items.size() && i < 3; ++i) step(i, form.forms[0], at.name);
      break;
    case ValueForm::Kind::dictionary:
      for (std::size_t i = 0; i < node.items.size(); ++i) step(i, form.forms[0], node.keys[i].text);
      break;
    case ValueForm::Kind::map:
      for (const auto& key : form.keys)
        for (std::size_t i = 0; i < node.keys.size(); ++i)
          if (node.keys[i].text == key.name) step(i, key.form, key.name);
      break;
    case ValueForm::Kind::tagged: {
      const Node* tag = node.find(form.tag);
      const auto which = std::find(form.names.begin(), form.names.end(), tag->text) - form.names.begin();
      const ValueForm& chosen = form.forms[static_cast<std::size_t>(which)];
      for (const auto& key : chosen.keys)
        for (std::size_t i = 0; i < node.keys.size(); ++i)
          if (node.keys[i].text == key.name) step(i, key.form, key.name);
      break;
    }
    case ValueForm::Kind::variant:
      for (std::size_t i = 0; i < form.names.size(); ++i)
        if (node.keys[0].text == form.names[i]) step(0, form.forms[i], form.names[i]);
      break;
    case ValueForm::Kind::either:
      for (const auto& one : form.forms) {
        const bool list = one.kind == ValueForm::Kind::list, map = one.kind == ValueForm::Kind::map || one.kind == ValueForm::Kind::tagged;
        if (list == (node.kind == Node::Kind::list) && map == (node.kind == Node::Kind::map)) {
          out.pop_back();
          collect(one, node, at, out);
        }
      }
      break;
    default: break;
  }
}

inline std::vector<Field> fields(const FileForm& file, const Node& document) {
  std::vector<Field> out;
  collect(file.root, document, {}, out);
  return out;
}

/// The document as text with one field's value replaced by another YAML text.
inline std::string with(Node document, const Field& field, const std::string& text) {
  Node* here = &document;
  for (const std::size_t step : field.steps) here = &here->items[step];
  Node replacement = scalar(text);
  *here = replacement;
  return flow_text(document);
}

inline constexpr std::size_t sample_variants = 20;

/// Calls `check(document, field)` for every field of every sample, each once.
template <class Check>
void for_each_field(const FileForm& file, const Check& check) {
  std::set<std::pair<const ValueForm*, std::vector<std::size_t>>> seen;
  for (std::size_t v = 0; v < sample_variants; ++v) {
    const Node document = sample(file.root, v);
    for (const Field& field : fields(file, document))
      if (seen.insert({field.form, field.steps}).second) check(document, field);
  }
}

}  // namespace tofray::test
