// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/text.h"
#include "base/units.h"
#include "io/form.h"
#include "io/load.h"

/// JSON Schema, draft 2020-12, from the same tables that reading goes by.
namespace tofray::io {

namespace {

using base::number_text;
using Kind = Form::Kind;

std::string in_json(const std::string& text) {
  constexpr char digits[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') out += '\\';
    if (byte < 0x20)
      out += {'\\', 'u', '0', '0', digits[byte >> 4], digits[byte & 15]};
    else
      out += c;
  }
  return out + "\"";
}

std::string joined(const std::vector<std::string>& parts) {
  std::string out;
  for (const auto& part : parts) out += (out.empty() ? "" : ",") + part;
  return out;
}

std::string string_list(const std::vector<std::string>& words) {
  std::vector<std::string> out;
  for (const auto& word : words) out.push_back(in_json(word));
  return "[" + joined(out) + "]";
}

class Writer {
 public:
  using Definitions = std::vector<std::pair<std::string, std::string>>;
  Writer(bool provenance, Definitions& definitions) : provenance_(provenance), definitions_(&definitions) {}

  /// @param lax   a part of the whole: nothing is required (a scene's overrides of a profile)
  std::string schema(const Form& form, bool lax = false) const {
    switch (form.kind) {
      case Kind::number: return wrapped(number(form));
      case Kind::integer:
        return wrapped(R"({"type":"integer","minimum":)" + number_text(form.low) + R"(,"maximum":)" + number_text(form.high) + "}");
      case Kind::boolean: return wrapped(R"({"type":"boolean"})");
      case Kind::text:
        return wrapped(R"({"type":["string","number","boolean"],"description":)" + in_json(form.what) + R"(,"examples":[)" +
                       in_json(form.example) + "]}");
      case Kind::choice: return wrapped(R"({"enum":)" + string_list(form.names) + "}");
      case Kind::list: return wrapped(list(form, lax));
      case Kind::map: return map(form, {}, {}, lax);
      case Kind::dictionary: return dictionary(form, lax);
      case Kind::tagged: return tagged(form, lax);
      case Kind::variant: return variant(form, lax);
      case Kind::either: {
        std::vector<std::string> all;
        for (const auto& one : form.forms) all.push_back(schema(one, lax));
        return R"({"anyOf":[)" + joined(all) + "]}";
      }
      case Kind::anything: break;
    }
    return "true";
  }

  /// The properties of a map, without the braces.
  std::string properties(const Form& form, bool lax) const {
    std::vector<std::string> out;
    for (const auto& key : form.keys) {
      std::string one = R"({"description":)" + in_json(key.doc) + ",";
      if (!key.fallback.empty() && key.fallback != "{}") one += R"("default":)" + fallback(key) + ",";
      out.push_back(in_json(key.name) + ":" + one + R"("allOf":[)" + schema(key.form, lax) + "]}");
    }
    if (provenance_) out.push_back(provenance_properties(""));
    return joined(out);
  }

 private:
  // "source": …, "assumed": …, "note": …
  static std::string provenance_properties(std::string before) {
    std::string out;
    for (const auto& name : provenance_keys()) {
      out += before + in_json(name) + R"(:{"type":["string","number","boolean"],"description":"where the numbers here come from"})";
      before = ",";
    }
    return out;
  }

  // {value: …, source: …}
  std::string wrapped(const std::string& plain) const {
    if (!provenance_) return defined(plain);
    const std::string once = defined(plain);
    return defined(R"({"anyOf":[)" + once + R"(,{"type":"object","required":["value"],"properties":{"value":)" + once +
                   provenance_properties(",") + R"(},"additionalProperties":false}]})");
  }

  // What is long and comes again is written once.
  std::string defined(const std::string& schema) const {
    if (schema.size() < 60) return schema;
    auto found = std::find_if(definitions_->begin(), definitions_->end(), [&](const auto& one) { return one.second == schema; });
    if (found == definitions_->end()) {
      definitions_->emplace_back("value" + std::to_string(definitions_->size() + 1), schema);
      found = definitions_->end() - 1;
    }
    return R"({"$ref":"#/$defs/)" + found->first + "\"}";
  }

  static std::string number(const Form& form) {
    const auto units = base::unit_names(form.dimension);
    const std::string range = "from " + base::quantity_text(form.low, form.example) + " to " + base::quantity_text(form.high, form.example);
    std::string bare = form.bare
                           ? R"({"type":"number","minimum":)" + number_text(form.low) + R"(,"maximum":)" + number_text(form.high) + "}"
                           : R"({"const":0})";
    if (units.empty()) return bare;
    std::string names;
    for (const auto& unit : units) {
      std::string escaped;
      for (const char c : unit) {
        if (std::string_view("()^").find(c) != std::string_view::npos) escaped += '\\';
        escaped += c;
      }
      names += (names.empty() ? "" : "|") + escaped;
    }
    const std::string pattern = "^[ ]*[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?[ ]*(" + names + ")[ ]*$";
    return R"({"anyOf":[{"type":"string","pattern":)" + in_json(pattern) + R"(,"description":)" + in_json(range) + R"(,"examples":[)" +
           in_json(form.example) + "]}," + bare + "]}";
  }

  std::string list(const Form& form, bool lax) const {
    return R"({"type":"array","items":)" + schema(form.forms[0], lax) + R"(,"minItems":)" + std::to_string(form.min_items) +
           R"(,"maxItems":)" + std::to_string(form.max_items) + "}";
  }

  std::string map(const Form& form, const std::string& tag, const std::string& tag_schema, bool lax) const {
    std::vector<std::string> required;
    if (!tag.empty() && !tag_schema.starts_with("?")) required.push_back(tag);
    for (const auto& key : form.keys)
      if (key.required && !lax) required.push_back(key.name);
    std::string inside = properties(form, lax);
    if (!tag.empty())
      inside = in_json(tag) + ":" + tag_schema.substr(tag_schema.starts_with("?") ? 1 : 0) + (inside.empty() ? "" : ",") + inside;
    std::string out = R"({"type":"object","properties":{)" + inside + "}";
    if (form.open) out += R"(,"patternProperties":{"^[a-z_]+[.]":true})";  // overrides with dotted keys
    out += R"(,"additionalProperties":false)";
    if (!required.empty()) out += R"(,"required":)" + string_list(required);
    if (!form.exactly_one.empty() && !lax) out += R"(,"oneOf":[)" + each_required(form.exactly_one) + "]";
    if (!form.at_most_one.empty()) {
      std::vector<std::string> pairs;
      for (std::size_t i = 0; i < form.at_most_one.size(); ++i)
        for (std::size_t j = i + 1; j < form.at_most_one.size(); ++j)
          pairs.push_back(R"({"required":)" + string_list({form.at_most_one[i], form.at_most_one[j]}) + "}");
      out += R"(,"not":{"anyOf":[)" + joined(pairs) + "]}";
    }
    return out + "}";
  }

  static std::string each_required(const std::vector<std::string>& names) {
    std::vector<std::string> out;
    for (const auto& name : names) out.push_back(R"({"required":)" + string_list({name}) + "}");
    return joined(out);
  }

  std::string dictionary(const Form& form, bool lax) const {
    return R"({"type":"object","properties":{)" + (provenance_ ? provenance_properties("") : "") + R"(},"additionalProperties":)" +
           schema(form.forms[0], lax) + R"(,"maxProperties":)" + std::to_string(form.max_items) +
           (lax ? "" : R"(,"minProperties":)" + std::to_string(form.min_items)) + "}";
  }

  std::string tagged(const Form& form, bool lax) const {
    std::vector<std::string> all, brief;
    for (std::size_t i = 0; i < form.forms.size(); ++i) {
      const bool may_lack = lax || form.names[i] == form.default_tag;
      all.push_back(map(form.forms[i], form.tag, (may_lack ? "?" : "") + (R"({"const":)" + in_json(form.names[i]) + "}"), lax));
      const auto& keys = form.forms[i].keys;
      if (std::none_of(keys.begin(), keys.end(), [](const Key& key) { return key.required; }) && form.forms[i].exactly_one.empty())
        brief.push_back(form.names[i]);
    }
    if (!brief.empty()) all.push_back(R"({"enum":)" + string_list(brief) + "}");
    return R"({"anyOf":[)" + joined(all) + "]}";
  }

  std::string variant(const Form& form, bool lax) const {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < form.forms.size(); ++i) all.push_back(in_json(form.names[i]) + ":" + schema(form.forms[i], lax));
    return R"({"type":"object","minProperties":1,"maxProperties":1,"additionalProperties":false,"properties":{)" + joined(all) + "}}";
  }

  static std::string fallback(const Key& key) { return json(*key.fallback_node); }

  static std::string json(const Node& node) {
    if (node.kind == Node::Kind::list) {
      std::vector<std::string> items;
      for (const auto& item : node.items) items.push_back(json(item));
      return "[" + joined(items) + "]";
    }
    const bool bare = node.text.find_first_not_of("0123456789.+-eE") == std::string::npos;
    return bare || node.text == "true" || node.text == "false" ? node.text : in_json(node.text);
  }

  bool provenance_;
  Definitions* definitions_;
};

// One key a line: schemas are read by people, too.
std::string indented(const std::string& json) {
  std::string out, margin;
  bool text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (text) {
      out += c;
      if (c == '\\')
        out += json[++i];
      else if (c == '"')
        text = false;
      continue;
    }
    if (c == '"') text = true;
    if (c == '{' || c == '[') {
      margin += " ";
      out += c;
      if (i + 1 < json.size() && json[i + 1] != '}' && json[i + 1] != ']') out += "\n" + margin;
    } else if (c == '}' || c == ']') {
      margin.pop_back();
      const bool empty = i > 0 && (json[i - 1] == '{' || json[i - 1] == '[');
      out += (empty ? "" : "\n" + margin) + c;
    } else if (c == ',') {
      out += ",\n" + margin;
    } else {
      out += c;
      if (c == ':') out += ' ';
    }
  }
  return out + "\n";
}

// A scene's camera section takes the profile's keys, too, and dotted ones.
std::string with_overrides(const std::string& scene, Writer::Definitions& definitions) {
  const std::string mark = R"("camera":{)";
  const std::size_t at = scene.find(R"("properties":{)", scene.find(mark)) + std::string(R"("properties":{)").size();
  const Form& profile = camera_form().root;
  Form rest = profile;
  std::erase_if(rest.keys, [](const Key& key) { return key.name == "mode"; });
  const std::string more = Writer(true, definitions).properties(rest, true);
  std::string out = scene;
  out.insert(at, more + ",");
  return out;
}

}  // namespace

std::vector<std::string> schema_kinds() { return {"scene", "camera"}; }

std::string schema_json(const std::string& kind) {
  const auto kinds = schema_kinds();
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    base::fail(base::whole("schema"), "no schema of that kind: " + base::in_quotes(kind) + base::did_you_mean(kind, kinds),
               "expected one of " + base::listed(kinds));
  const FileForm& file = kind == "scene" ? scene_form() : camera_form();
  Writer::Definitions definitions;
  std::string body = Writer(file.provenance, definitions).schema(file.root);
  if (kind == "scene") body = with_overrides(body, definitions);
  std::vector<std::string> shared;
  for (const auto& [name, schema] : definitions) shared.push_back(in_json(name) + ":" + schema);
  return indented(R"({"$schema":"https://json-schema.org/draft/2020-12/schema","title":)" + in_json(file.title) + "," +
                  body.substr(1, body.size() - 2) + R"(,"$defs":{)" + joined(shared) + "}}");
}

}  // namespace tofray::io
