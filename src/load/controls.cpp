// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/controls.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <set>

#include "base/text.h"
#include "base/units.h"
#include "load/builtin.h"
#include "load/trees.h"
#include "model/tables.h"
#include "yaml/settings.h"

namespace tofray::load {

namespace {

using model::Key;
using model::ValueForm;
using yaml::Node;
using FormKind = ValueForm::Kind;

constexpr std::size_t longest_text = 4000, longest_vector = 4;

bool contains(const std::vector<std::string>& all, const std::string& one) { return std::find(all.begin(), all.end(), one) != all.end(); }

bool is_provenance(const std::string& key) { return contains(model::provenance_keys(), key); }

/// {value: …, source: …}: the value; anything else: itself.
const Node& plain(const Node& node) {
  const Node* inner = node.find("value");
  if (inner == nullptr) return node;
  const bool wrapper =
      std::all_of(node.keys.begin(), node.keys.end(), [](const Node::Key& key) { return key.text == "value" || is_provenance(key.text); });
  return wrapper ? *inner : node;
}

double size_of(const std::string& unit) {
  const base::Unit* found = base::find_unit(unit);
  return found == nullptr ? 1 : std::pow(10, found->exponent) * found->factor;
}

std::string unit_of_example(const ValueForm& form) { return base::parse_quantity(form.example, form.dimension).unit; }

std::string name_of(base::Dimension dimension) {
  if (dimension == base::Dimension::none) return "none";
  const std::string_view both = base::article_and_name(dimension);
  return std::string(both.substr(both.find(' ') + 1));
}

/// Refused by the command line where no light bounces.
const std::vector<std::string> of_bounces = {"transport.samples", "transport.max_samples", "transport.path_noise", "transport.smooth"};

/// What holds for a key and all below it.
struct Scope {
  std::string path;
  std::string source;
  bool assumed = false;
  bool settable = true;
  bool in_force = true;  ///< false: what the table says of absent keys is not what holds
};

class Rows {
 public:
  Rows(const Settings& settings, std::vector<Control>& out) : out_(out) {
    for (const auto& [key, text] : settings) changed_.insert(key);
  }
  /// Numbers of another source than this one have no provenance.
  void set_profile(const std::string& source) { profile_ = source; }
  void set_label(const std::string& label) { label_ = label; }

  /// @param map  null where it is absent
  void keys(const ValueForm& form, const Node* map, const Scope& scope) {
    const bool absent_map = map == nullptr || map->kind != Node::Kind::map;
    for (const Key& key : form.keys) {
      Scope here = scope;
      here.path += (here.path.empty() ? "" : ".") + key.name;
      const Node* node = absent_map ? nullptr : map->find(key.name);
      for (const auto* group : {&form.exactly_one, &form.at_most_one}) {
        if (node != nullptr || !contains(*group, key.name)) continue;
        here.in_force = false;
        const auto is_there = [&](const std::string& other) { return !absent_map && map->find(other) != nullptr; };
        here.settable = here.settable && std::none_of(group->begin(), group->end(), is_there);
      }
      if (node == nullptr && excluded(form, map, key.name)) here.settable = here.in_force = false;
      const auto is_missing = [&](const Key& other) {
        return &other != &key && other.required && (absent_map || map->find(other.name) == nullptr);
      };
      if (node == nullptr && std::any_of(form.keys.begin(), form.keys.end(), is_missing))
        here.settable = here.settable && !absent_map, here.in_force = false;
      // A list called `value` cannot be told from {value: …, source: …} by itself.
      if (is_curve(form) && key.name == "value") here.settable = here.in_force = false;
      if (node == nullptr && !up_is_usual_ && (key.name == "look_at" || key.name == "up")) here.in_force = false;
      value(key, key.form, node, here);
    }
  }

  void value(const Key& key, const ValueForm& form, const Node* node, Scope scope) {
    if (node != nullptr) {
      provenance(*node, scope);
      node = &plain(*node);
    }
    switch (form.kind) {
      case FormKind::list: return list(key, form, node, scope);
      case FormKind::map:
        if (is_curve(form)) whole(key, node, scope);
        return keys(form, node, scope);
      case FormKind::dictionary:
        if (node == nullptr || node->kind != Node::Kind::map) return;
        for (std::size_t i = 0; i < node->items.size(); ++i) {
          if (is_provenance(node->keys[i].text)) continue;
          Scope here = scope;
          here.path += "." + node->keys[i].text;
          here.settable = here.settable && node->keys[i].text.find_first_of(".=") == std::string::npos;
          value(key, form.forms[0], &node->items[i], here);
        }
        return;
      case FormKind::tagged: return tagged(key, form, node, scope);
      case FormKind::variant:
        for (std::size_t i = 0; node != nullptr && i < form.names.size(); ++i)
          if (const Node* held = node->find(form.names[i])) {
            Scope here = scope;
            here.path += "." + form.names[i];
            const Node* name = held->find("name");
            label_ = name == nullptr ? "" : name->text;
            value(key, form.forms[i], held, here);
            label_.clear();
          }
        return;
      case FormKind::either: return value(key, chosen(form, node), node, scope);
      case FormKind::anything: return;
      default: return scalar(key, form, node, scope);
    }
  }

  /// Keys that go with some ways to say a thing alone.
  static bool excluded(const ValueForm& form, const Node* map, const std::string& key) {
    const auto is_there = [&](const char* other) { return map != nullptr && map->find(other) != nullptr; };
    const auto has_key = [&](const char* name) {
      return std::any_of(form.keys.begin(), form.keys.end(), [&](const Key& one) { return one.name == name; });
    };
    if (key == "axes" && has_key("quaternion")) return !is_there("quaternion") && !is_there("matrix") && !is_there("euler");
    if (contains({"p1", "p2", "k5", "k6"}, key) && is_there("model")) return plain(*map->find("model")).text == "fisheye";
    return false;
  }

  Control& row(const Scope& scope, const std::string& what, Control::Kind kind) {
    Control& one = out_.emplace_back();
    one.key = scope.path, one.what = what, one.kind = kind, one.label = label_, one.settable = scope.settable;
    const std::size_t first = one.key.find('.'), second = first == std::string::npos ? first : one.key.find('.', first + 1);
    one.part = first == std::string::npos ? "scene" : one.key.substr(0, first);
    if (second != std::string::npos) one.group = one.key.substr(first + 1, second - first - 1);
    one.name = first == std::string::npos ? one.key : one.key.substr((second != std::string::npos ? second : first) + 1);
    one.source = scope.source, one.assumed = scope.assumed;
    for (const std::string& key : changed_)
      one.changed = one.changed || key == one.key || one.key.starts_with(key + ".") || key.starts_with(one.key + ".");
    return one;
  }

  /// Of a number or a whole one: its value and its slider.
  static void measure(Control& one, const ValueForm& form, const std::vector<std::string>& texts) {
    one.form = &form;
    std::vector<double> numbers;
    for (const std::string& text : texts) {
      const base::Quantity read = base::parse_quantity(text, form.dimension);
      using Status = base::Quantity::Status;
      if (read.status != Status::good && !(read.status == Status::bare && form.bare)) break;
      if (one.unit.empty()) one.unit = read.unit;
      numbers.push_back(read.value);
    }
    if (one.unit.empty()) one.unit = form.bare ? base::si_unit(form.dimension) : unit_of_example(form);
    if (numbers.size() == texts.size())
      for (const double number : numbers) one.value.push_back(in_unit(number, one.unit));
    slide(one, form);
  }

  /// A tenth to ten times the value, within what the key may be.
  static void slide(Control& one, const ValueForm& form) {
    const double low = in_unit(form.low, one.unit), high = in_unit(form.high, one.unit);
    const double usual = std::abs(in_unit(base::parse_quantity(form.example, form.dimension).value, one.unit));
    double most = 0;
    for (const double value : one.value) most = std::max(most, std::abs(value));
    if (low < 0) {
      const double reach = 2 * std::max(most, usual);
      one.slider_low = std::max(low, -reach), one.slider_high = std::min(high, reach);
    } else if (most > 0) {
      one.slider_low = std::max(low, most / 10), one.slider_high = std::min(high, most * 10);
      one.logarithmic = *one.slider_low > 0;
    } else {
      one.slider_low = low, one.slider_high = std::min(high, usual > 0 ? usual * 10 : high);
    }
    if (form.kind == FormKind::integer) {
      one.slider_low = std::floor(*one.slider_low), one.slider_high = std::ceil(*one.slider_high);
      one.logarithmic = one.logarithmic && *one.slider_low >= 1 && *one.slider_high >= 100;
    }
    for (auto* end : {&one.slider_low, &one.slider_high}) *end = std::strtod(fmt::format("{:.12g}", **end).c_str(), nullptr);
  }

  void set_up_is_usual(bool usual) { up_is_usual_ = usual; }

 private:
  /// Two lists, one over the other.
  static bool is_curve(const ValueForm& form) {
    return form.keys.size() == 2 &&
           std::all_of(form.keys.begin(), form.keys.end(), [](const Key& key) { return key.form.kind == FormKind::list && key.required; });
  }

  /// Both of them in one text.
  void whole(const Key& key, const Node* node, const Scope& scope) {
    Control& one = row(scope, key.doc, Control::Kind::list);
    if (node != nullptr) set_text(one, yaml::flow_text(*node));
  }

  void provenance(const Node& node, Scope& scope) const {
    // What was changed is no longer what the profile's source says.
    const bool of_profile = !profile_.empty() && node.place.source != nullptr && *node.place.source == profile_;
    if (!of_profile) scope.source.clear(), scope.assumed = false;
    const Node *source = node.find("source"), *assumed = node.find("assumed");
    if (!of_profile || (source == nullptr && assumed == nullptr)) return;
    scope.assumed = source == nullptr;
    scope.source = (source != nullptr ? source : assumed)->text;
  }

  static const ValueForm& chosen(const ValueForm& form, const Node* node) {
    const auto fits = [&](const ValueForm& one) {
      if (node == nullptr || node->kind == Node::Kind::scalar || node->kind == Node::Kind::null) return model::is_scalar(one);
      if (node->kind == Node::Kind::list) return one.kind == FormKind::list;
      return !model::is_scalar(one) && one.kind != FormKind::list;
    };
    const auto found = std::find_if(form.forms.begin(), form.forms.end(), fits);
    return found == form.forms.end() ? form.forms[0] : *found;
  }

  void scalar(const Key& key, const ValueForm& form, const Node* node, const Scope& scope) {
    using Kind = Control::Kind;
    const Kind kind = form.kind == FormKind::number    ? Kind::number
                      : form.kind == FormKind::integer ? Kind::integer
                      : form.kind == FormKind::boolean ? Kind::boolean
                      : form.kind == FormKind::choice  ? Kind::choice
                                                       : Kind::text;
    Control& one = row(scope, key.doc, kind);
    one.form = &form, one.fallback = key.fallback, one.choices = form.names;
    if (node != nullptr)
      set_text(one, yaml::flow_text(*node));
    else if (!key.fallback.empty() && scope.in_force && scope.settable)
      one.text = key.fallback;
    if (kind != Kind::number && kind != Kind::integer) return;
    std::vector<std::string> texts;
    if (node != nullptr)
      texts.push_back(node->text);
    else if (one.text)
      texts.push_back(*one.text);
    measure(one, form, texts);
  }

  static void set_text(Control& one, std::string text) {
    if (one.settable && text.size() <= longest_text) one.text = std::move(text);
  }

  void list(const Key& key, const ValueForm& form, const Node* node, const Scope& scope) {
    const ValueForm& item = form.forms[0];
    const bool of_values = model::is_scalar(item) || item.kind == FormKind::list;
    if (!of_values && node != nullptr && !node->items.empty()) {
      for (std::size_t i = 0; i < node->items.size(); ++i) {
        Scope here = scope;
        here.path += "." + std::to_string(i);
        value(key, item, &node->items[i], here);
      }
      return;
    }
    const bool vector =
        model::is_scalar(item) && form.min_items == form.max_items && static_cast<std::size_t>(form.max_items) <= longest_vector;
    Control& one = row(scope, key.doc, vector ? Control::Kind::vector : Control::Kind::list);
    one.form = &item, one.fallback = key.fallback;
    if (node != nullptr)
      set_text(one, yaml::flow_text(*node));
    else if (!key.fallback.empty() && scope.in_force && scope.settable)
      one.text = key.fallback;
    if (!vector) return;
    std::vector<std::string> texts;
    if (node != nullptr)
      for (const Node& each : node->items) texts.push_back(each.text);
    else if (one.text)
      for (const Node& each : yaml::parse_value(*one.text, base::whole("default")).items) texts.push_back(each.text);
    measure(one, item, texts);
  }

  void tagged(const Key& key, const ValueForm& form, const Node* node, const Scope& scope) {
    const Node* said = node == nullptr ? nullptr : node->kind == Node::Kind::scalar ? node : node->find(form.tag);
    const bool is_map = node != nullptr && node->kind == Node::Kind::map && !node->items.empty();
    if (said != nullptr) said = &plain(*said);
    const std::string usual = key.fallback.empty() ? form.default_tag : key.fallback;
    const std::string tag = said != nullptr ? said->text : is_map || usual.empty() ? form.default_tag : usual;
    Scope of_tag = scope;
    of_tag.path += "." + form.tag;
    Control& one = row(of_tag, key.doc, Control::Kind::choice);
    one.fallback = usual, one.choices = form.names;
    // A kind that is written where none was takes all other keys of the map with it.
    if (scope.settable && !tag.empty() && (said != nullptr || (!is_map && scope.in_force))) one.text = tag;
    const auto which = std::find(form.names.begin(), form.names.end(), tag);
    if (which == form.names.end()) return;
    Scope below = scope;
    below.settable = below.settable && (is_map || form.default_tag == tag);
    below.in_force = below.in_force && below.settable;
    keys(form.forms[static_cast<std::size_t>(which - form.names.begin())], is_map ? node : nullptr, below);
  }

  std::set<std::string> changed_;
  std::string profile_, label_;
  bool up_is_usual_ = true;
  std::vector<Control>& out_;
};

const Key& key_of(const ValueForm& form, const std::string& name) {
  return *std::find_if(form.keys.begin(), form.keys.end(), [&](const Key& key) { return key.name == name; });
}

/// The exposure of all lit raw frames, if it is one and the same; otherwise the longest of them, by itself no text that can be set.
const Node* exposure_of(const Node& mode, bool& same) {
  const Node *sequence = mode.find("sequence"), *longest = nullptr;
  same = true;
  double most = -1;
  for (std::size_t i = 0; sequence != nullptr && i < sequence->items.size(); ++i) {
    const Node& raw = sequence->items[i];
    const Node *lit = raw.find("lit"), *time = raw.find("integration_time");
    if ((lit != nullptr && plain(*lit).text == "false") || time == nullptr) continue;
    const double value = base::parse_quantity(plain(*time).text, base::Dimension::time).value;
    same = same && (longest == nullptr || value == most);
    if (value > most) most = value, longest = time;
  }
  return longest;
}

/// A mode's keys; of what modes may have otherwise than the profile, what it has.
void mode_rows(Rows& rows, const ValueForm& form, const Node& mode, const Scope& scope) {
  for (const Key& key : form.keys) {
    Scope here = scope;
    here.path += "." + key.name;
    const Node* node = mode.find(key.name);
    if (key.form.kind == FormKind::map) {
      here.in_force = false;
      if (node == nullptr) continue;
    }
    rows.value(key, key.form, node, here);
  }
}

/// The profile's keys as a camera has them. @param root  the profile with all changes
void camera_rows(Rows& rows, Node root, const std::string& source, std::vector<Control>& out) {
  rows.set_profile(source);
  Node* modes = root.find("modes");
  const Node* named = root.find("mode");
  Node mode;
  std::string name;
  std::vector<std::string> names;
  for (std::size_t i = 0; modes != nullptr && i < modes->items.size(); ++i) {
    if (is_provenance(modes->keys[i].text)) continue;
    names.push_back(modes->keys[i].text);
    if (named == nullptr ? name.empty() : names.back() == plain(*named).text) name = names.back(), mode = modes->items[i];
  }
  static const std::vector<std::string> of_mode = {"decoding", "readout", "auto_exposure"};
  const base::Place place = base::whole(source);
  const Node* decoding = root.find("decoding");
  const bool filter_of_mode = decoding == nullptr || decoding->find("filter") == nullptr;
  // What a mode says counts more than what the profile does.
  for (const std::string& section : of_mode)
    if (const Node* own = mode.find(section)) yaml::set_key(root, section, *own, place);
  const ValueForm& form = model::camera_form().root;
  Scope top{"camera", {}, false, true, true};
  Control& which = rows.row({"camera.mode", {}, false, true, true}, key_of(form, "mode").doc, Control::Kind::choice);
  which.text = name, which.choices = names;
  for (const Key& key : form.keys) {
    if (key.name == "mode") continue;
    Scope here = top;
    here.path += "." + key.name;
    const Node* node = root.find(key.name);
    if (key.name == "modes") {
      here.path += "." + name;
      here.settable = name.find_first_of(".=") == std::string::npos;
      mode_rows(rows, key.form.forms[0], mode, here);
    } else if (key.name == "frame_rate" && node == nullptr) {
      rows.value(key, key.form, mode.find("frame_rate"), here);
    } else if (key.name == "integration_time" && node == nullptr) {
      bool same = true;
      rows.value(key, key.form, exposure_of(mode, same), here);
      if (!same) out.back().text.reset();
    } else {
      const std::size_t before = out.size();
      rows.value(key, key.form, node, here);
      // The mode's own filter has a kind; the profile's would have none.
      for (std::size_t i = before; filter_of_mode && i < out.size(); ++i)
        if (out[i].key.starts_with("camera.decoding.filter.") && !out[i].key.ends_with(".kind"))
          out[i].settable = false, out[i].text.reset();
    }
  }
  rows.set_profile({});
}

}  // namespace

double in_unit(double si, const std::string& unit) { return std::strtod(fmt::format("{:.15g}", si / size_of(unit)).c_str(), nullptr); }

std::vector<Control> controls_of(const Scene& scene, std::string_view text, const Settings& settings, const CameraOptions& camera) {
  std::vector<Control> out;
  Rows rows(settings, out);
  const Node root = scene_tree(text, scene.source, settings);
  const ValueForm& form = model::scene_form().root;
  const Node *of_camera = root.find("camera"), *world_up = root.find("world_up");
  rows.set_up_is_usual(world_up == nullptr || world_up->text == "-y");
  const ValueForm& choice = key_of(form, "camera").form;
  Scope top{"camera", {}, false, true, true};
  for (const Key& key : choice.keys) {
    if (key.name == "mode") continue;
    Scope here = top;
    here.path += "." + key.name;
    rows.value(key, key.form, of_camera == nullptr ? nullptr : of_camera->find(key.name), here);
    if (key.name == "profile")
      for (const Builtin& one : builtin_profiles()) out.back().choices.push_back(one.name);
  }
  std::string source;
  Node profile = camera_tree(scene, camera, source);
  camera_rows(rows, std::move(profile), source, out);
  for (const Key& key : form.keys) {
    if (key.name == "camera") continue;
    rows.value(key, key.form, root.find(key.name), {key.name, {}, false, true, true});
  }
  if (scene.transport.bounces == 0)
    for (Control& one : out)
      if (contains(of_bounces, one.key)) one.settable = false, one.text.reset();
  return out;
}

std::vector<Control> camera_controls_of(const std::string& profile, const std::string& source, const CameraOptions& camera) {
  std::vector<Control> out;
  Settings settings;
  for (const auto& [key, text] : camera.set) settings.emplace_back("camera." + key, text);
  Rows rows(settings, out);
  camera_rows(rows, camera_tree(profile, source, camera), source, out);
  return out;
}

files::Json json_of(const Control& control) {
  using files::Json;
  using Kind = Control::Kind;
  static const char* const kinds[] = {"number", "integer", "switch", "choice", "text", "vector", "list"};
  Json out = Json::object();
  out.set("key", control.key).set("part", control.part).set("group", control.group).set("name", control.name);
  if (!control.label.empty()) out.set("label", control.label);
  out.set("kind", kinds[static_cast<int>(control.kind)]);
  const ValueForm* form = control.form;
  if (form != nullptr && (form->kind == FormKind::number || form->kind == FormKind::integer)) {
    const std::string unit = control.unit.empty() && control.kind == Kind::list && !form->bare ? unit_of_example(*form) : control.unit;
    out.set("unit", unit).set("dimension", name_of(form->dimension));
    if (const auto units = base::unit_names(form->dimension); !units.empty()) out.set("units", Json::list(units));
    out.set("low", in_unit(form->low, unit)).set("high", in_unit(form->high, unit));
  }
  if (!control.choices.empty()) out.set("choices", Json::list(control.choices));
  out.set("what", control.what);
  if (control.text) out.set("text", *control.text);
  if (!control.value.empty()) out.set("value", control.kind == Kind::vector ? Json::list(control.value) : Json(control.value[0]));
  if (!control.fallback.empty()) out.set("default", control.fallback);
  if (form != nullptr && !form->example.empty() && control.kind != Kind::vector && control.kind != Kind::list)
    out.set("example", form->example);
  if (!control.source.empty()) out.set("source", control.source);
  if (control.assumed) out.set("assumed", true);
  if (control.slider_low && control.kind != Kind::list) {
    if (control.logarithmic) out.set("log", true);
    out.set("slider", Json::array().push(*control.slider_low).push(*control.slider_high));
  }
  return out.set("settable", control.settable).set("changed", control.changed), out;
}

std::string_view builtin_scene_text(const std::string& name) {
  const Builtin* found = find_builtin(builtin_scenes(), name);
  return found == nullptr ? std::string_view() : found->text;
}

}  // namespace tofray::load
