// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "yaml/near_misses.h"

#include <algorithm>

#include "base/text.h"

namespace tofray::yaml {

using model::Key;

namespace {

using base::in_quotes;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool knows(const ValueForm& map, const std::string& name) {
  return std::any_of(map.keys.begin(), map.keys.end(), [&](const Key& key) { return key.name == name; });
}

}  // namespace

bool has_decimal_comma(const Node& scalar, const std::string& label, base::Faults& faults) {
  std::string mended = scalar.text;
  const std::size_t at = mended.find(',');
  // One comma, and between two digits.
  if (at == std::string::npos || at == 0 || at + 1 == mended.size() || mended.find(',', at + 1) != std::string::npos) return false;
  if (!is_digit(mended[at - 1]) || !is_digit(mended[at + 1])) return false;
  mended[at] = '.';
  faults.add(scalar.place, label + " has a decimal comma",
             "got " + in_quotes(scalar.text) + ", expected a decimal point: " + in_quotes(mended));
  return true;
}

bool comma_made_key(const Node& map, std::size_t i, base::Faults& faults) {
  if (i == 0 || map.items[i].kind != Node::Kind::null || map.items[i - 1].kind != Node::Kind::scalar) return false;
  const std::string &name = map.keys[i - 1].text, &before = map.items[i - 1].text, &behind = map.keys[i].text;
  if (before.empty() || behind.empty() || !is_digit(before.back()) || !is_digit(behind.front())) return false;
  faults.add(map.keys[i].place, name + " has a decimal comma",
             "got " + in_quotes(name + ": " + before + "," + behind) +
                 ", expected a decimal point: " + in_quotes(name + ": " + before + "." + behind));
  return true;
}

bool keys_stand_beside(const ValueForm& form, const Node& map, base::Faults& faults) {
  const Node::Key* shape = nullptr;
  const ValueForm* inner = nullptr;
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    const auto found = std::find(form.names.begin(), form.names.end(), map.keys[i].text);
    if (found == form.names.end()) continue;
    if (shape != nullptr || map.items[i].kind != Node::Kind::null) return false;
    shape = &map.keys[i];
    inner = &form.forms[static_cast<std::size_t>(found - form.names.begin())];
  }
  std::vector<std::string> beside;
  for (const Node::Key& key : map.keys)
    if (inner != nullptr && knows(*inner, key.text)) beside.push_back(in_quotes(key.text));
  if (beside.empty()) return false;
  const bool many = beside.size() > 1;
  faults.add(shape->place, "the keys of " + shape->text + " stand beside it, not below",
             base::listed(beside, "and") + (many ? " stand" : " stands") + " as far to the left as " + in_quotes(shape->text + ":") +
                 "\nindent " + (many ? "them" : "it") + " by two spaces more, or write - " + shape->text + ": {…}");
  return true;
}

const std::vector<std::string>& forms_of_sets() {
  static const std::vector<std::string> names{"uniform", "log_uniform", "normal", "integer", "chance", "choice",
                                              "grid",    "even",        "files",  "table",   "cap"};
  return names;
}

bool is_form_of_a_set(const Node& node, const std::string& label, base::Faults& faults) {
  const bool expression = node.kind == Node::Kind::scalar && node.text.starts_with('=');
  const bool form = node.kind == Node::Kind::map && !node.keys.empty() &&
                    std::find(forms_of_sets().begin(), forms_of_sets().end(), node.keys[0].text) != forms_of_sets().end();
  if (!expression && !form) return false;
  faults.add(node.place, label + " is drawn by chance, which a plain scene does not do",
             "got " + (expression ? in_quotes(node.text) : "the form " + in_quotes(node.keys[0].text)) +
                 ", expected a value; in the file of a data set it is good: see `tofray dataset --help`");
  return true;
}

}  // namespace tofray::yaml
