// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/profile_file.h"

#include "load/builtin.h"
#include "load/controls.h"
#include "load/convert.h"
#include "load/trees.h"
#include "model/form.h"
#include "yaml/tree.h"

namespace tofray {

namespace load {

namespace {

void add_places(const yaml::Node& node, const std::string& path, std::vector<ProfilePlace>& out) {
  if (!path.empty()) out.push_back({path, node.place.line, node.place.column});
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const std::string name = node.kind == yaml::Node::Kind::map ? node.keys[i].text : std::to_string(i);
    add_places(node.items[i], path.empty() ? name : path + "." + name, out);
  }
}

}  // namespace

}  // namespace load

ProfileFile profile_file(const std::string& file_or_name, const CameraOptions& options) {
  (void)load_camera(file_or_name, options);  // what is wrong with it is said here
  ProfileFile out;
  if (const load::Builtin* builtin = load::find_builtin(load::builtin_profiles(), file_or_name))
    out.source = "<" + builtin->name + ">", out.text = builtin->text;
  else
    out.source = file_or_name, out.text = load::read_named("camera", file_or_name, load::builtin_profiles());
  load::add_places(yaml::parse_tree(out.text, out.source), "", out.places);
  Scene scene;
  scene.camera.profile = file_or_name;
  const std::string prefix = "camera.";
  for (const load::Control& one : load::controls_of(scene, "camera: {}\n", {}, options)) {
    const bool whole = one.kind == load::Control::Kind::integer;
    if (!one.key.starts_with(prefix) || !one.settable || one.value.size() != 1 || !(whole || one.kind == load::Control::Kind::number))
      continue;
    out.numbers.push_back({one.key.substr(prefix.size()), one.unit, one.value[0], load::in_unit(one.form->low, one.unit),
                           load::in_unit(one.form->high, one.unit), whole, one.assumed});
  }
  return out;
}

}  // namespace tofray
