// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "base/units.h"
#include "load/load.h"
#include "model/form.h"
#include "yaml/tree.h"

/// JSON Schema, draft 2020-12, from the same tables that reading goes by.
namespace tofray::load {

using yaml::flow_text;
using yaml::Node;
using yaml::parse_value;

namespace {

using Json = nlohmann::ordered_json;
using model::Key;
using model::ValueForm;
using Kind = ValueForm::Kind;

Json words(const std::vector<std::string>& names) { return Json(names); }

/// A range's end: whole numbers without a point.
Json end_of_range(double value) { return Json::parse(base::number_text(value)); }

Json range(const ValueForm& form, const char* type) {
  return {{"type", type}, {"minimum", end_of_range(form.low)}, {"maximum", end_of_range(form.high)}};
}

/// A default as JSON: a number, true or false, a list; else a text.
Json fallback(const std::string& text) {
  const Node node = parse_value(text, base::whole("default"));
  if (node.kind == Node::Kind::list) {
    Json list = Json::array();
    for (const Node& item : node.items) list.push_back(fallback(flow_text(item)));
    return list;
  }
  const bool bare = text.find_first_not_of("0123456789.+-eE") == std::string::npos;
  return bare || text == "true" || text == "false" ? Json::parse(text) : Json(text);
}

class Writer {
 public:
  Writer(bool provenance, Json& definitions) : provenance_(provenance), definitions_(definitions) {}

  /// @param lax   a part of the whole: nothing is required (a scene's overrides of a profile)
  Json schema(const ValueForm& form, bool lax = false) {
    switch (form.kind) {
      case Kind::number: return wrapped(number(form));
      case Kind::integer: return wrapped(range(form, "integer"));
      case Kind::boolean: return wrapped({{"type", "boolean"}});
      case Kind::text:
        return wrapped({{"type", {"string", "number", "boolean"}}, {"description", form.what}, {"examples", words({form.example})}});
      case Kind::choice: return wrapped({{"enum", form.names}});
      case Kind::list: return wrapped(list(form, lax));
      case Kind::map: return map(form, lax);
      case Kind::dictionary: return dictionary(form, lax);
      case Kind::tagged: return tagged(form, lax);
      case Kind::variant: return variant(form, lax);
      case Kind::either: return {{"anyOf", all_of(form.forms, lax)}};
      case Kind::anything: break;
    }
    return true;
  }

  Json properties(const ValueForm& form, bool lax) {
    Json out = Json::object();
    for (const Key& key : form.keys) {
      Json one{{"description", key.doc}};
      if (!key.fallback.empty()) one["default"] = fallback(key.fallback);
      one["allOf"] = Json::array({schema(key.form, lax)});
      out[key.name] = std::move(one);
    }
    if (provenance_) out.update(provenance_properties());
    return out;
  }

 private:
  static Json provenance_properties() {
    Json out = Json::object();
    for (const auto& name : model::provenance_keys())
      out[name] = {{"type", {"string", "number", "boolean"}}, {"description", "where the numbers here come from"}};
    return out;
  }

  Json all_of(const std::vector<ValueForm>& forms, bool lax) {
    Json all = Json::array();
    for (const ValueForm& one : forms) all.push_back(schema(one, lax));
    return all;
  }

  // {value: …, source: …}
  Json wrapped(const Json& plain) {
    const Json once = defined(plain);
    if (!provenance_) return once;
    Json properties{{"value", once}};
    properties.update(provenance_properties());
    const Json object{{"type", "object"}, {"required", words({"value"})}, {"properties", properties}, {"additionalProperties", false}};
    return defined({{"anyOf", Json::array({once, object})}});
  }

  // What is long and comes again is written once.
  Json defined(const Json& schema) {
    const std::string text = schema.dump();
    if (text.size() < 60) return schema;
    const auto [found, is_new] = names_.try_emplace(text, "value" + std::to_string(definitions_.size() + 1));
    if (is_new) definitions_[found->second] = schema;
    return {{"$ref", "#/$defs/" + found->second}};
  }

  static Json number(const ValueForm& form) {
    const auto units = base::unit_names(form.dimension);
    const Json bare = form.bare ? range(form, "number") : Json{{"const", 0}};
    if (units.empty()) return bare;
    std::string names;
    for (const auto& unit : units) {
      names += names.empty() ? "" : "|";
      for (const char c : unit) names += std::string_view("()^").find(c) != std::string_view::npos ? std::string{'\\', c} : std::string{c};
    }
    const std::string ends = "from " + base::quantity_text(form.low, form.example) + " to " + base::quantity_text(form.high, form.example);
    const Json text{{"type", "string"},
                    {"pattern", "^[ ]*[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?[ ]*(" + names + ")[ ]*$"},
                    {"description", ends},
                    {"examples", words({form.example})}};
    return {{"anyOf", Json::array({text, bare})}};
  }

  Json list(const ValueForm& form, bool lax) {
    return {{"type", "array"}, {"items", schema(form.forms[0], lax)}, {"minItems", form.min_items}, {"maxItems", form.max_items}};
  }

  /// @param tag   the value that the key form.tag has to have, where it has one
  Json map(const ValueForm& form, bool lax, const std::string& tag = {}, const std::string& value = {}, bool tag_may_lack = false) {
    Json properties = Json::object(), required = Json::array();
    if (!tag.empty()) properties[tag] = {{"const", value}};
    if (!tag.empty() && !tag_may_lack) required.push_back(tag);
    for (const Key& key : form.keys)
      if (key.required && !lax) required.push_back(key.name);
    properties.update(this->properties(form, lax));
    Json out{{"type", "object"}, {"properties", std::move(properties)}};
    if (form.open) out["patternProperties"] = {{"^[a-z_]+[.]", true}};  // overrides with dotted keys
    out["additionalProperties"] = false;
    if (!required.empty()) out["required"] = std::move(required);
    if (!form.exactly_one.empty() && !lax)
      for (const auto& name : form.exactly_one) out["oneOf"].push_back({{"required", words({name})}});
    for (std::size_t i = 0; i < form.at_most_one.size(); ++i)
      for (std::size_t j = i + 1; j < form.at_most_one.size(); ++j)
        out["not"]["anyOf"].push_back({{"required", words({form.at_most_one[i], form.at_most_one[j]})}});
    return out;
  }

  Json dictionary(const ValueForm& form, bool lax) {
    Json out{{"type", "object"},
             {"properties", provenance_ ? provenance_properties() : Json::object()},
             {"additionalProperties", schema(form.forms[0], lax)},
             {"maxProperties", form.max_items}};
    if (!lax) out["minProperties"] = form.min_items;
    return out;
  }

  Json tagged(const ValueForm& form, bool lax) {
    Json all = Json::array(), brief = Json::array();
    for (std::size_t i = 0; i < form.forms.size(); ++i) {
      const ValueForm& one = form.forms[i];
      all.push_back(map(one, lax, form.tag, form.names[i], lax || form.names[i] == form.default_tag));
      const bool needs_more = std::any_of(one.keys.begin(), one.keys.end(), [](const Key& key) { return key.required; });
      if (!needs_more && one.exactly_one.empty()) brief.push_back(form.names[i]);
    }
    if (!brief.empty()) all.push_back({{"enum", std::move(brief)}});
    if (!form.what.empty()) all.push_back({{"type", "string"}, {"description", form.what}});
    return {{"anyOf", std::move(all)}};
  }

  Json variant(const ValueForm& form, bool lax) {
    Json properties = Json::object();
    for (std::size_t i = 0; i < form.names.size(); ++i) properties[form.names[i]] = schema(form.forms[i], lax);
    return {{"type", "object"},
            {"minProperties", 1},
            {"maxProperties", 1},
            {"additionalProperties", false},
            {"properties", std::move(properties)}};
  }

  bool provenance_;
  Json& definitions_;
  std::map<std::string, std::string> names_;  ///< of the definitions, by what they say
};

/// A scene's camera section takes the profile's keys, too.
Json overrides(Json& definitions) {
  ValueForm rest = model::camera_form().root;
  std::erase_if(rest.keys, [](const Key& key) { return key.name == "mode"; });
  return Writer(true, definitions).properties(rest, true);
}

}  // namespace

std::vector<std::string> schema_kinds() { return {"scene", "camera"}; }

std::string schema_json(const std::string& kind) {
  const auto kinds = schema_kinds();
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    base::fail(base::whole("schema"), "no schema of that kind: " + base::in_quotes(kind) + base::did_you_mean(kind, kinds),
               "expected one of " + base::listed(kinds));
  return kind == "scene" ? schema_of(model::scene_form()) : schema_of(model::camera_form());
}

std::string schema_of(const model::FileForm& file) {
  Json definitions = Json::object();
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", file.title}};
  schema.update(Writer(file.provenance, definitions).schema(file.root));
  if (&file == &model::scene_form()) schema["properties"]["camera"]["allOf"][0]["properties"].update(overrides(definitions));
  schema["$defs"] = std::move(definitions);
  return schema.dump(1) + "\n";
}

}  // namespace tofray::load
