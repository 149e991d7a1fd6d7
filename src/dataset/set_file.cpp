// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dataset/set_file.h"

#include <algorithm>

#include "files/text_file.h"
#include "yaml/reader.h"

namespace tofray::dataset {

namespace {

constexpr double most_samples = 1e12, most_views = 256, most_devices = 1e9, most_seed = 9007199254740991.0, most_attempts = 65536;

model::ValueForm rule_form() {
  model::ValueForm rule =
      model::map({model::absent("valid", model::number(base::Dimension::fraction, {0, 1}, "60 %"),
                                "the share of the pixels that have a depth, at least"),
                  model::absent("seen", model::text("the name of an object, or of a scatter", "clutter"), "what is seen"),
                  model::absent("pixels", model::integer({1, 1e9}, "200"), "by so many pixels, at least")});
  rule.exactly_one = {"valid", "seen"};
  return rule;
}

model::ValueForm split_form() {
  const auto share = [](const char* example) { return model::number(base::Dimension::fraction, {0, 1}, example); };
  return model::map({model::required("by", model::choice({"scene", "asset"}), "what no two splits have in common"),
                     model::absent("test", share("10 %"), "the share of the samples that are for testing"),
                     model::absent("validation", share("5 %"), "the share of those that are for validation")});
}

SplitShares split_shares(const yaml::Value& value, base::Faults& faults) {
  SplitShares out;
  if (!value || !value.good) return out;
  out.by = value["by"].text == "asset" ? SplitShares::By::asset : SplitShares::By::scene, out.place = value.place();
  out.test = value["test"] ? value["test"].number : 0, out.validation = value["validation"] ? value["validation"].number : 0;
  if (!(out.test + out.validation > 0 && out.test + out.validation < 1))
    faults.add(out.place, "split leaves a part without samples",
               "expected test, validation or both above 0 %, and less than 100 % together: {by: scene, test: 10 %, validation: 5 %}");
  return out;
}

/// Whether a map below has `unplaced: again`.
bool places_again(const yaml::Node& node) {
  const yaml::Node* unplaced = node.kind == yaml::Node::Kind::map ? node.find("unplaced") : nullptr;
  return (unplaced != nullptr && unplaced->text == "again") || std::any_of(node.items.begin(), node.items.end(), places_again);
}

void need_map(const yaml::Node& node, const char* key, base::Faults& faults) {
  if (node.kind != yaml::Node::Kind::map && node.kind != yaml::Node::Kind::null)
    faults.add(node.place, std::string(key) + " is not what belongs here", "got " + yaml::describe(node) + ", expected a map");
}

}  // namespace

const model::FileForm& set_form() {
  using namespace model;
  static const FileForm form{
      .kind = "set",
      .title = "a data set of tofray",
      .root = map({
          required("name", text("a name", "corners-1"), "what the set is called"),
          absent("license", text("a licence by its SPDX name", "CC-BY-4.0"), "what others may do with it"),
          required("samples", model::integer({1, most_samples}, "1000"), "how many scenes are drawn"),
          absent("seed", model::integer({0, most_seed}, "7"), "another one: other draws throughout"),
          absent("views", model::integer({1, most_views}, "4"), "poses of the camera for each scene"),
          absent("devices", model::integer({1, most_devices}, "16"), "specimens of the camera that take turns"),
          absent("let", model::ValueForm{}, "numbers by name, for expressions"),
          absent("arrays", model::list(model::text("the name of an array, or a pattern", "gt_*"), 1, 64), "what is stored of each sample"),
          absent("as", quantised_form(), "arrays of floats that are stored as whole numbers"),
          absent("accept", model::list(rule_form(), 1, 16), "what a sample has to show, or it is drawn again"),
          absent("attempts", model::integer({1, most_attempts}, "50"), "how often a sample is drawn until accept takes it"),
          absent("holes", model::number(base::Dimension::fraction, {0, 1}, "0.1 %"), "the share of samples that may fail"),
          absent("split", split_form(), "which samples are for training, validation and testing"),
          required("scene", model::ValueForm{}, "a scene in which any value may be a form"),
          absent("set", model::ValueForm{}, "keys and values as --set takes them; of the camera, too"),
      }),
  };
  return form;
}

SetFile parse_set(std::string_view text, const std::string& source) {
  const yaml::Node root = yaml::parse_tree(text, source);
  if (root.kind == yaml::Node::Kind::map && root.find("scene") == nullptr && root.find("objects") != nullptr)
    base::fail(
        root.place, "this is a scene, not a data set",
        "expected name, samples, and the scene below the key `scene`, in which any value may be a form such as {uniform: [1 m, 3 m]}");
  base::Faults faults;
  const yaml::Value value = yaml::read(set_form(), root, faults);
  SetFile out;
  out.source = source, out.folder = files::folder_of(source);
  out.name = value["name"].text, out.license = value["license"].text;
  const auto whole = [&](const char* key, std::uint64_t& into) {
    if (value[key] && value[key].good) into = static_cast<std::uint64_t>(value[key].number);
  };
  whole("samples", out.samples), whole("seed", out.seed), whole("views", out.views), whole("devices", out.devices);
  if (value["arrays"]) out.arrays = stored_arrays(value["arrays"], faults);
  if (value["as"] && faults.empty()) out.as = quantised_arrays(value["as"], choice_of(out.arrays), faults);
  whole("attempts", out.attempts);
  if (value["accept"])
    for (const yaml::Value& one : value["accept"].items) {
      if (!one.good) continue;
      AcceptRule rule{one.place(), one["seen"].text, 1, one["valid"].number};
      if (one["pixels"]) {
        rule.pixels = static_cast<std::uint64_t>(one["pixels"].number);
        if (rule.seen.empty())
          faults.add(one["pixels"].place(), "`pixels` stands beside valid", "expected it beside seen: {seen: clutter, pixels: 200}");
      }
      out.accept.push_back(std::move(rule));
    }
  if (value["holes"] && value["holes"].good) out.holes = value["holes"].number;
  out.split = split_shares(value["split"], faults);
  if (const yaml::Node* let = root.find("let")) out.let = *let;
  if (const yaml::Node* scene = root.find("scene")) out.scene = *scene;
  if (const yaml::Node* set = root.find("set")) out.set = *set;
  out.again = places_again(out.scene);
  need_map(out.let, "let", faults), need_map(out.set, "set", faults);
  if (root.find("scene") != nullptr && out.scene.kind != yaml::Node::Kind::map)
    faults.add(out.scene.place, "scene is not what belongs here",
               "got " + yaml::describe(out.scene) + ", expected a map with the keys of a scene");
  faults.raise();
  out.text = text;
  yaml::Node laws = root;
  const auto samples = static_cast<std::ptrdiff_t>(root.find("samples") - root.items.data());
  laws.keys.erase(laws.keys.begin() + samples), laws.items.erase(laws.items.begin() + samples);
  out.laws = yaml::flow_text(laws);
  return out;
}

}  // namespace tofray::dataset
