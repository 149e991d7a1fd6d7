// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dataset/schema.h"

#include <nlohmann/json.hpp>

#include "dataset/forms.h"
#include "dataset/set_file.h"
#include "load/load.h"
#include "yaml/near_misses.h"

namespace tofray::dataset {

namespace {

using Json = nlohmann::ordered_json;

Json reference_to(const std::string& name) { return {{"$ref", "#/$defs/" + name}}; }

Json object_schema(Json properties, const std::vector<std::string>& required) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"required", required}, {"additionalProperties", false}};
}

/// Of these keys, each with any value.
Json object_of_keys(const std::vector<std::string>& keys, const std::vector<std::string>& required) {
  Json properties = Json::object();
  for (const std::string& key : keys) properties[key] = true;
  return object_schema(std::move(properties), required);
}

Json list_schema(std::size_t least, std::size_t most) { return {{"type", "array"}, {"minItems", least}, {"maxItems", most}}; }

/// What stands behind a form's name.
Json argument_of(const std::string& form) {
  constexpr std::size_t most = 10'000;
  const Json word{{"type", "string"}}, share{{"type", {"string", "number"}}};
  if (form == "choice") return {{"anyOf", Json::array({list_schema(1, most), {{"type", "object"}, {"minProperties", 1}}})}};
  if (form == "grid") return {{"anyOf", Json::array({list_schema(1, most), object_of_keys({"from", "to", "n"}, {"from", "to", "n"})})}};
  if (form == "cap") return object_schema({{"around", list_schema(3, 3)}, {"within", share}}, {"around", "within"});
  if (form == "chance") return share;
  if (form == "files" || form == "table") return word;
  return list_schema(2, 2);
}

/// A form: a map with its name, and what may stand beside it.
Json form_schema() {
  const Json expression{{"type", "string"}, {"pattern", "^="}, {"description", "an expression, as in \"= wall - 30 cm\""}};
  Json all = Json::array({expression});
  for (const std::string& name : yaml::forms_of_sets()) {
    if (name == "table") continue;  // below let alone
    Json keys{{name, argument_of(name)}, {"per", {{"enum", {"set", "device", "scene", "view", "frame"}}}}};
    if (name == "normal") keys["within"] = list_schema(2, 2);
    if (name == "choice" || name == "files") keys["weights"] = list_schema(1, 10'000);
    all.push_back(object_schema(std::move(keys), {name}));
  }
  return {{"anyOf", std::move(all)}};
}

/// The schema of a plain scene becomes that of one in a set.
class OpenScene {
 public:
  explicit OpenScene(Json plain) : scene_(std::move(plain)), definitions_(std::move(scene_["$defs"])) {
    for (const char* key : {"$schema", "$defs", "title"}) scene_.erase(key);
    rename(scene_), rename(definitions_);
    let_scatter();
    open(scene_);
    for (auto& one : definitions_) open(one);
  }

  [[nodiscard]] const Json& scene() const { return scene_; }
  /// Each under the name that refers to it.
  void give_definitions(Json& into) const {
    for (const auto& [name, one] : definitions_.items()) into["scene-" + name] = one;
  }

 private:
  static Json or_form(Json plain) { return {{"anyOf", Json::array({std::move(plain), reference_to("form")})}}; }

  static void rename(Json& at) {
    if (at.is_object() && at.contains("$ref")) {
      std::string to = at["$ref"];
      at["$ref"] = to.insert(std::string("#/$defs/").size(), "scene-");
    }
    if (at.is_structured())
      for (auto& one : at) rename(one);
  }

  /// `scatter` is one more kind of object.
  void let_scatter() {
    Json* objects = &scene_["properties"]["objects"]["allOf"][0];
    const std::string there = std::string("#/$defs/") + "scene-";
    while (objects->contains("$ref")) objects = &definitions_.at(std::string((*objects)["$ref"]).substr(there.size()));
    (*objects)["items"]["properties"]["scatter"] = object_of_keys(scatter_keys(), {"name", "count", "of"});
  }

  /// A form may stand wherever a value stands in it.
  static void open(Json& schema) {
    if (!schema.is_object()) return;
    for (const char* several : {"anyOf", "allOf"})
      if (schema.contains(several))
        for (auto& one : schema[several]) open(one);
    if (schema.contains("properties"))
      for (auto one = schema["properties"].begin(); one != schema["properties"].end(); ++one) open_property(one.key(), one.value());
    for (const char* inner : {"items", "additionalProperties"})
      if (schema.contains(inner) && schema[inner].is_object()) open(schema[inner]), schema[inner] = or_form(std::move(schema[inner]));
  }

  static void open_property(const std::string& name, Json& one) {
    if (!one.is_object()) return;
    open(one);
    if (one.contains("const")) return;  // what kind of thing its map is
    Json description = one.contains("description") ? one["description"] : Json();
    one = or_form(std::move(one));
    if (name == "rotation") one["anyOf"].push_back({{"const", "any"}});
    if (name == "pose") one["anyOf"].push_back(object_schema({{"look", object_of_keys(look_keys(), {"at", "radius"})}}, {"look"}));
    if (!description.is_null()) one["description"] = std::move(description);  // where editors look for it
  }

  Json scene_, definitions_;
};

}  // namespace

std::string schema_json() {
  Json set = Json::parse(load::schema_of(set_form()));
  const OpenScene scene(Json::parse(load::schema_json("scene")));
  set["properties"]["scene"]["allOf"] = Json::array({scene.scene()});
  const Json table =
      object_schema({{"table", argument_of("table")}, {"per", {{"enum", {"set", "device", "scene", "view", "frame"}}}}}, {"table"});
  const Json named{{"anyOf", Json::array({reference_to("form"), table, {{"type", {"string", "number"}}}})}};
  set["properties"]["let"]["allOf"][0] = {{"type", "object"}, {"additionalProperties", named}};
  set["properties"]["set"]["allOf"][0] = {{"type", "object"}};
  set["$defs"]["form"] = form_schema();
  scene.give_definitions(set["$defs"]);
  return set.dump(1) + "\n";
}

}  // namespace tofray::dataset
