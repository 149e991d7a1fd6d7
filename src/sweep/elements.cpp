// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/elements.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/text.h"
#include "load/controls.h"
#include "load/trees.h"
#include "tofray/error.h"

namespace tofray::sweeps {

namespace {

/// @param rest  what of the key is below the node; before: what is above
void walk(const yaml::Node& node, const std::string& rest, const std::string& before, std::vector<std::string>& out) {
  const std::size_t dot = std::min(rest.find('.'), rest.size());
  const std::string part = rest.substr(0, dot), below = dot < rest.size() ? rest.substr(dot + 1) : "";
  const auto go = [&](const yaml::Node* to, const std::string& name) {
    const std::string here = before.empty() ? name : before + "." + name;
    if (below.empty()) return out.push_back(here);
    if (below.find('*') == std::string::npos) {
      // An element that is another kind of thing, as a plane where spheres are asked for, is not meant.
      const std::string next = below.substr(0, below.find('.'));
      if (part == "*" && to->kind == yaml::Node::Kind::map && before == "objects" && to->find(next) == nullptr) return;
      return out.push_back(here + "." + below);
    }
    if (to != nullptr) walk(*to, below, here, out);
  };
  if (part != "*") {
    const bool number = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
    if (node.kind == yaml::Node::Kind::list && number && std::stoul(part) < node.items.size())
      return go(&node.items[std::stoul(part)], part);
    if (const yaml::Node* found = node.find(part)) go(found, part);
    return;
  }
  if (node.kind != yaml::Node::Kind::list) return;
  for (std::size_t i = 0; i < node.items.size(); ++i) go(&node.items[i], std::to_string(i));
}

}  // namespace

std::vector<std::string> elements_of(const std::string& key, const InputRequest& inputs, const Inputs& loaded) {
  if (key.find('*') == std::string::npos) return {key};
  std::vector<std::string> out;
  if (key.starts_with("camera.")) {
    std::string source;
    walk(load::camera_tree(loaded.scene, {inputs.mode, {}, inputs.root}, source), key.substr(7), "", out);
    for (std::string& one : out) one = "camera." + one;
  } else {
    const InputFile& first = loaded.files.front();
    const std::string text = first.text.empty() ? std::string(load::builtin_scene_text(first.name)) : first.text;
    walk(load::scene_tree(text, loaded.scene.source, inputs.set), key, "", out);
  }
  if (out.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("error: --vary {}: * means no element of this scene\n  expected a list with an element that has "
                            "such a key, as in illumination.*.power",
                            base::in_quotes(key)));
  return out;
}

}  // namespace tofray::sweeps
