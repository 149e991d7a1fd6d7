// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "yaml/reader.h"

#include <algorithm>
#include <charconv>

#include "base/limits.h"
#include "base/text.h"
#include "yaml/near_misses.h"

namespace tofray::yaml {

const Value& Value::operator[](std::string_view key) const {
  static const Value none;
  for (std::size_t i = 0; i < names.size() && i < items.size(); ++i)
    if (names[i] == key) return items[i];
  return none;
}

const base::Place& Value::place_of(std::string_view key) const {
  const Node* written = node->find(key);
  return written != nullptr ? written->place : node->place;
}

namespace {

using base::did_you_mean;
using base::Dimension;
using base::in_quotes;
using base::listed;
using model::is_scalar;
using model::Key;
using model::provenance_keys;
using Kind = ValueForm::Kind;

bool contains(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::vector<std::string> key_names(const ValueForm& form) {
  std::vector<std::string> names;
  for (const auto& key : form.keys) names.push_back(key.name);
  return names;
}

// "a length such as \"0.5 m\""
std::string expected(const ValueForm& form) {
  switch (form.kind) {
    case Kind::number: return std::string(base::article_and_name(form.dimension)) + " such as " + in_quotes(form.example);
    case Kind::integer: return "a whole number such as " + form.example;
    case Kind::boolean: return "true or false";
    case Kind::text: return form.what + " such as " + in_quotes(form.example);
    case Kind::choice: return (form.names.size() > 1 ? "one of " : "") + listed(form.names);
    case Kind::list: return "a list [..]" + (form.min_items == form.max_items ? " of " + std::to_string(form.min_items) : std::string());
    case Kind::map: return "a map with " + listed(key_names(form), "and");
    case Kind::dictionary: return "a map of names";
    case Kind::tagged: return "a map with " + form.tag + ": " + listed(form.names);
    case Kind::variant: return "a map with one of " + listed(form.names);
    case Kind::either: {
      std::vector<std::string> all;
      for (const auto& one : form.forms) all.push_back(expected(one));
      return listed(all);
    }
    case Kind::anything: break;
  }
  return "a value";
}

// "wavelength" for "illumination_wavelength", where no other key ends so.
std::string longer_name(const std::string& word, const std::vector<std::string>& names) {
  const auto ends_so = [&](const std::string& name) { return name.ends_with("_" + word); };
  const auto found = std::find_if(names.begin(), names.end(), ends_so);
  if (word.empty() || found == names.end() || std::any_of(found + 1, names.end(), ends_so)) return {};
  return "; did you mean " + in_quotes(*found) + "?";
}

// Where in the file a key of that name belongs, as a dotted path.
std::string home_below(const ValueForm& form, const std::string& name, const std::string& path) {
  for (const auto& key : form.keys) {
    const std::string here = path.empty() ? key.name : path + "." + key.name;
    if (key.name == name) return here;
    if (const auto below = home_below(key.form, name, here); !below.empty()) return below;
  }
  for (std::size_t i = 0; i < form.forms.size(); ++i) {
    std::string here = path;
    if (form.kind == Kind::list) here += "[]";
    if (form.kind == Kind::dictionary) here += ".NAME";
    if (form.kind == Kind::variant) here += "." + form.names[i];
    if (const auto below = home_below(form.forms[i], name, here); !below.empty()) return below;
  }
  return {};
}

class Reader {
 public:
  Reader(const FileForm& file, base::Faults& faults) : file_(file), faults_(faults) {}

  Value read(const ValueForm& form, const Node& written, const std::string& label) {
    const Node& node = unwrapped(form, written);
    Value value;
    value.node = &node;
    const std::size_t before = faults_.size();
    switch (form.kind) {
      case Kind::number: read_number(form, node, label, value); break;
      case Kind::integer: read_integer(form, node, label, value); break;
      case Kind::boolean: read_boolean(form, node, label, value); break;
      case Kind::text: read_text(form, node, label, value); break;
      case Kind::choice: read_choice(form, node, label, value); break;
      case Kind::list: read_list(form, node, label, value); break;
      case Kind::map: read_map(form, node, label, value); break;
      case Kind::dictionary: read_dictionary(form, node, label, value); break;
      case Kind::tagged: read_tagged(form, node, label, value); break;
      case Kind::variant: read_variant(form, node, label, value); break;
      case Kind::either: return read_either(form, node, label);
      case Kind::anything: break;
    }
    value.good = faults_.size() == before;
    return value;
  }

 private:
  void wrong(const ValueForm& form, const Node& node, const std::string& label, const std::string& why = {}) {
    if (is_form_of_a_set(node, label, faults_)) return;
    const std::string what =
        why.empty() ? (node.kind == Node::Kind::null ? label + " has no value" : label + " is not what belongs here") : why;
    faults_.add(node.place, what, "got " + describe(node) + ", expected " + expected(form));
  }

  // {value: 12 um, assumed: why}  →  12 um
  const Node& unwrapped(const ValueForm& form, const Node& node) {
    const bool may = file_.provenance && (is_scalar(form) || form.kind == Kind::list || form.kind == Kind::either);
    if (!may || node.kind != Node::Kind::map) return node;
    const Node* inner = node.find("value");
    if (inner == nullptr) return node;
    for (const auto& key : node.keys)
      if (key.text != "value" && !contains(provenance_keys(), key.text)) return node;
    read_provenance(node);
    return *inner;
  }

  void read_provenance(const Node& node) {
    static const ValueForm words = model::text("a text", "data sheet, page 3");
    for (std::size_t i = 0; i < node.keys.size(); ++i)
      if (contains(provenance_keys(), node.keys[i].text)) read(words, node.items[i], node.keys[i].text);
  }

  void read_number(const ValueForm& form, const Node& node, const std::string& label, Value& value) {
    if (node.kind != Node::Kind::scalar) return wrong(form, node, label);
    if (has_decimal_comma(node, label, faults_)) return;
    using enum base::Quantity::Status;
    const auto quantity = base::parse_quantity(node.text, form.dimension);
    value.number = quantity.value;
    const auto units = base::unit_names(form.dimension);
    const std::string got = "got " + in_quotes(node.text) + ", expected " + expected(form);
    const std::string fitting = units.empty() ? "" : " (units: " + listed(units, "and") + ")";
    switch (quantity.status) {
      case good: break;
      case not_a_number: return wrong(form, node, label, label + " is not a number");
      case not_finite: return faults_.add(node.place, label + " is not finite", got);
      case out_of_range: return faults_.add(node.place, label + " is too large or too small for a number", got + ", " + range(form));
      case bare:
        if (form.bare) break;
        return faults_.add(node.place, label + " has no unit", got + fitting);
      case unknown_unit:
        return faults_.add(node.place, label + " has the unknown unit " + in_quotes(quantity.unit) + did_you_mean(quantity.unit, units),
                           got + fitting);
      case other_dimension:
        return faults_.add(node.place,
                           label + (form.dimension == Dimension::none
                                        ? " takes no unit"
                                        : std::string(" is ") + base::article_and_name(base::find_unit(quantity.unit)->dimension) +
                                              ", not " + base::article_and_name(form.dimension)),
                           got + fitting);
    }
    if (!(value.number >= form.low && value.number <= form.high))
      faults_.add(node.place, label + " is out of range", got + ", " + range(form));
  }

  static std::string range(const ValueForm& form) {
    return base::quantity_text(form.low, form.example) + " to " + base::quantity_text(form.high, form.example);
  }

  void read_integer(const ValueForm& form, const Node& node, const std::string& label, Value& value) {
    if (node.kind != Node::Kind::scalar) return wrong(form, node, label);
    const char* end = node.text.data() + node.text.size();
    long long whole = 0;
    const auto read = std::from_chars(node.text.data(), end, whole);
    if (read.ec == std::errc::invalid_argument || read.ptr != end) return wrong(form, node, label, label + " is not a whole number");
    const bool inside = read.ec == std::errc() && static_cast<double>(whole) >= form.low && static_cast<double>(whole) <= form.high;
    if (!inside)
      faults_.add(node.place, label + " is out of range",
                  "got " + in_quotes(node.text) + ", expected " + expected(form) + ", " + range(form));
    value.number = inside ? static_cast<double>(whole) : 0;
  }

  void read_boolean(const ValueForm& form, const Node& node, const std::string& label, Value& value) {
    const bool good = node.kind == Node::Kind::scalar && !node.quoted && (node.text == "true" || node.text == "false");
    if (!good) return wrong(form, node, label, label + " is neither true nor false");
    value.flag = node.text == "true";
  }

  void read_text(const ValueForm& form, const Node& node, const std::string& label, Value& value) {
    if (node.kind != Node::Kind::scalar || node.text.empty()) return wrong(form, node, label, label + " is not a text");
    if (static_cast<long long>(node.text.size()) > base::limit::text_bytes.value) too_long(node.place, label, node.text.size());
    value.text = node.text;
  }

  void too_long(const base::Place& place, const std::string& label, std::size_t bytes) {
    faults_.add(place, label + " is too long",
                "got " + std::to_string(bytes) + " bytes, at most " + std::to_string(base::limit::text_bytes.value), ErrorKind::limit);
  }

  void read_choice(const ValueForm& form, const Node& node, const std::string& label, Value& value) {
    if (node.kind != Node::Kind::scalar) return wrong(form, node, label);
    if (!contains(form.names, node.text))
      return wrong(form, node, label, label + " is unknown: " + in_quotes(node.text) + did_you_mean(node.text, form.names));
    value.text = node.text;
  }

  bool count_fits(const ValueForm& form, const Node& node, const std::string& label, const char* noun) {
    const auto size = static_cast<long long>(node.items.size());
    if (size > form.max_items && form.max_items != form.min_items) {
      faults_.add(node.place, label + " has too many " + noun,
                  "got " + std::to_string(size) + ", at most " + std::to_string(form.max_items), ErrorKind::limit);
      return false;
    }
    if (size >= form.min_items && size <= form.max_items) return true;
    const std::string count =
        form.min_items == form.max_items ? std::to_string(form.min_items) : "at least " + std::to_string(form.min_items);
    const bool numbers = form.kind == Kind::list && form.forms[0].kind == Kind::number && size > form.max_items;
    faults_.add(
        node.place, label + " has the wrong number of " + noun,
        "got " + std::to_string(size) + ", expected " + count + (numbers ? "\na decimal comma makes two of one: write 1.5, not 1,5" : ""));
    return false;
  }

  void read_list(const ValueForm& form, const Node& node, const std::string& label, Value& value) {
    if (node.kind != Node::Kind::list) return wrong(form, node, label, label + " is not a list");
    if (!count_fits(form, node, label, "elements")) return;
    value.items.reserve(node.items.size());
    for (std::size_t i = 0; i < node.items.size(); ++i)
      value.items.push_back(read(form.forms[0], node.items[i], label + "[" + std::to_string(i) + "]"));
  }

  void read_dictionary(const ValueForm& form, const Node& node, const std::string& label, Value& value) {
    if (node.kind != Node::Kind::map) return wrong(form, node, label, label + " is not a map of names");
    if (!count_fits(form, node, label, "entries")) return;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      if (file_.provenance && contains(provenance_keys(), node.keys[i].text)) continue;
      if (node.keys[i].text.empty()) faults_.add(node.keys[i].place, "an empty name in " + label, "expected a name such as \"first\"");
      if (static_cast<long long>(node.keys[i].text.size()) > base::limit::text_bytes.value)
        too_long(node.keys[i].place, "a name in " + label, node.keys[i].text.size());
      value.names.push_back(node.keys[i].text);
      value.key_places.push_back(node.keys[i].place);
      value.items.push_back(read(form.forms[0], node.items[i], label + "." + node.keys[i].text));
    }
    if (file_.provenance) read_provenance(node);
  }

  void read_map(const ValueForm& form, const Node& node, const std::string& label, Value& value, const std::string& tag = {}) {
    if (node.kind != Node::Kind::map) return wrong(form, node, label, label + " is not a map");
    for (std::size_t i = 0; i < node.keys.size(); ++i) {
      const auto& key = node.keys[i];
      const bool known = std::any_of(form.keys.begin(), form.keys.end(), [&](const Key& k) { return k.name == key.text; });
      if (known || key.text == tag || (file_.provenance && contains(provenance_keys(), key.text))) continue;
      if (form.open) continue;
      if (!comma_made_key(node, i, faults_)) unknown_key(form, key, label, tag);
    }
    if (file_.provenance) read_provenance(node);
    for (const auto& key : form.keys) {
      value.names.push_back(key.name);
      const Node* given = node.find(key.name);
      value.items.push_back(given != nullptr ? read(key.form, *given, key.name) : Value());
      if (given == nullptr && key.required)
        faults_.add(node.place, label + " lacks the key " + in_quotes(key.name),
                    key.name + ": " + key.doc + "\nexpected " + expected(key.form));
    }
    check_groups(form, node, label);
  }

  void check_groups(const ValueForm& form, const Node& node, const std::string& label) {
    for (const auto* group : {&form.exactly_one, &form.at_most_one}) {
      std::vector<std::string> found;
      for (const auto& name : *group)
        if (node.find(name) != nullptr) found.push_back(in_quotes(name));
      if (found.size() > 1)
        faults_.add(node.place, label + " has " + listed(found, "and"), "these keys say the same thing; keep one of them");
      if (found.empty() && group == &form.exactly_one && !group->empty())
        faults_.add(node.place, label + " lacks a key", "expected one of " + listed(*group));
    }
  }

  void unknown_key(const ValueForm& form, const Node::Key& key, const std::string& label, const std::string& tag) {
    auto names = key_names(form);
    if (!tag.empty()) names.push_back(tag);
    const auto meant = std::find_if(form.meant.begin(), form.meant.end(), [&](const auto& pair) { return pair.first == key.text; });
    std::string hint = meant == form.meant.end()         ? did_you_mean(key.text, names)
                       : meant->second.starts_with("--") ? "; did you mean the option " + meant->second + "?"
                                                         : "; did you mean " + in_quotes(meant->second) + "?";
    if (hint.empty()) hint = longer_name(key.text, names);
    std::string elsewhere = hint.empty() ? home_below(file_.root, key.text, "") : "";
    if (elsewhere == key.text)
      elsewhere = "at the top level";
    else if (!elsewhere.empty())
      elsewhere = "as " + elsewhere;
    faults_.add(key.place, "unknown key " + in_quotes(key.text) + " in " + label + hint,
                (elsewhere.empty() ? "" : in_quotes(key.text) + " stands elsewhere: " + elsewhere + "\n") +
                    (names.empty() ? "no keys are known here" : "known keys: " + listed(names, "and")));
  }

  void read_tagged(const ValueForm& form, const Node& node, const std::string& label, Value& value) {
    // "pattern: lambertian" is short for "pattern: {kind: lambertian}".
    const bool brief = node.kind == Node::Kind::scalar;
    if (!brief && node.kind != Node::Kind::map) return wrong(form, node, label);
    const Node* tag = brief ? &node : node.find(form.tag);
    std::string name = form.default_tag;
    if (tag != nullptr) {
      const ValueForm tags = model::choice(form.names);
      name = read(tags, *tag, brief ? label : form.tag).text;
    } else if (name.empty()) {
      faults_.add(node.place, label + " lacks the key " + in_quotes(form.tag), "expected " + form.tag + ": " + listed(form.names));
    }
    if (name.empty()) return;
    value.text = name;
    value.alternative = static_cast<int>(std::find(form.names.begin(), form.names.end(), name) - form.names.begin());
    static const Node empty_map = parse_value("{}", base::whole("default"));
    const ValueForm& chosen = form.forms[static_cast<std::size_t>(value.alternative)];
    if (brief) {
      const bool complete = std::none_of(chosen.keys.begin(), chosen.keys.end(), [](const Key& key) { return key.required; });
      if (!complete) return wrong(form, node, label, label + " " + in_quotes(name) + " needs more than its name");
      return read_map(chosen, empty_map, label, value, form.tag);
    }
    read_map(chosen, node, label, value, form.tag);
  }

  void read_variant(const ValueForm& form, const Node& node, const std::string& label, Value& value) {
    if (node.kind != Node::Kind::map || node.keys.empty()) return wrong(form, node, label);
    if (keys_stand_beside(form, node, faults_)) return;
    int found = -1;
    for (std::size_t i = 0; i < node.keys.size(); ++i) {
      const auto& key = node.keys[i];
      const auto name = std::find(form.names.begin(), form.names.end(), key.text);
      if (name != form.names.end()) {
        if (found >= 0)
          faults_.add(key.place, label + " has " + in_quotes(form.names[static_cast<std::size_t>(found)]) + " and " + in_quotes(key.text),
                      "expected one of them; start a new entry with \"-\"");
        found = static_cast<int>(name - form.names.begin());
        value.alternative = found;
        value.items.clear();
        value.items.push_back(read(form.forms[static_cast<std::size_t>(found)], node.items[i], key.text));
        continue;
      }
      std::string inner;
      for (std::size_t k = form.forms.size(); k-- > 0;)
        for (const auto& known : form.forms[k].keys)
          if (known.name == key.text && (inner.empty() || found < 0 || static_cast<std::size_t>(found) == k))
            inner = "put " + in_quotes(key.text) + " inside, as in \"" + form.names[k] + ": {…, " + key.text + ": …}\"\n";
      faults_.add(key.place,
                  "unknown key " + in_quotes(key.text) + " in " + label + (inner.empty() ? did_you_mean(key.text, form.names) : ""),
                  inner + "known here: " + listed(form.names));
      if (found < 0) value.alternative = -1;
    }
    if (found < 0) value.items.clear();
  }

  Value read_either(const ValueForm& form, const Node& node, const std::string& label) {
    for (std::size_t i = 0; i < form.forms.size(); ++i) {
      const ValueForm& one = form.forms[i];
      const bool map = one.kind == Kind::map || one.kind == Kind::tagged || one.kind == Kind::dictionary || one.kind == Kind::variant;
      const bool fits = (map && node.kind == Node::Kind::map) || (one.kind == Kind::list && node.kind == Node::Kind::list) ||
                        (is_scalar(one) && node.kind == Node::Kind::scalar);
      if (!fits) continue;
      Value value = read(one, node, label);
      value.either = static_cast<int>(i);
      return value;
    }
    Value value;
    value.node = &node;
    value.good = false;
    wrong(form, node, label);
    return value;
  }

  const FileForm& file_;
  base::Faults& faults_;
};

}  // namespace

Value read(const FileForm& file, const Node& root, base::Faults& faults) {
  Reader reader(file, faults);
  if (root.kind == Node::Kind::null) {
    std::vector<std::string> least;
    for (const Key& key : file.root.keys)
      if (key.required) least.push_back(key.name);
    faults.add(root.place, "there is nothing in it", "expected a " + file.kind + "; it has at least " + base::listed(least, "and"));
    Value value;
    value.node = &root;
    value.good = false;
    return value;
  }
  return reader.read(file.root, root, "the " + file.kind);
}

std::string home_of(const ValueForm& root, const std::string& name) { return home_below(root, name, ""); }

}  // namespace tofray::yaml
