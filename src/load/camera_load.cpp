// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <map>

#include "base/text.h"
#include "files/text_file.h"
#include "load/builtin.h"
#include "load/camera_modes.h"
#include "load/convert.h"
#include "load/fill.h"
#include "load/load.h"
#include "load/specimen.h"
#include "load/trees.h"
#include "yaml/settings.h"

namespace tofray::load {

using files::folder_of;
using files::read_reference;
using yaml::Node;
using yaml::parse_tree;
using yaml::parse_value;
using yaml::read;
using yaml::refuse_too_many;
using yaml::set_key;
using yaml::Value;

namespace {

// One change of the profile's tree: where it was written decides what messages name.
struct Change {
  std::string key;
  std::string text;
  base::Place place;
  NamedBy by;
};

std::vector<Change> changes_of(const CameraOptions& options) {
  std::vector<Change> changes;
  for (const auto& [key, text] : options.set) changes.push_back({key, text, base::whole("--set " + key), {".", {}, true}});
  return changes;
}

Node mode_node(const std::string& name, const base::Place& place) {
  Node node;
  node.kind = Node::Kind::scalar;
  node.text = name;
  node.place = place;
  return node;
}

struct Profile {
  std::string text;
  std::string source;     ///< for messages
  std::string folder;     ///< of its table files; empty: none
  std::string root = {};  ///< as of files::read_reference
};

/// What is set for a run counts more than what a mode says: where a mode has, say, a decoding of its own, it is changed as well.
void set_keys_of_modes(Node& root, const Change& change) {
  const std::string section = change.key.substr(0, change.key.find('.'));
  if (section != "decoding" && section != "readout" && section != "auto_exposure") return;
  Node* modes = root.find("modes");
  if (modes == nullptr) return;
  for (Node& mode : modes->items)
    if (mode.find(section) != nullptr) set_key(mode, change.key, parse_value(change.text, change.place), change.place);
}

/// What a camera is read from.
struct Choice {
  Profile profile;
  std::string mode;  ///< empty: as the profile says
  base::Place mode_place;
  std::vector<Change> changes;
};

/// @param folders  set to where what calibrations name lies
Node tree_of(const Choice& choice, std::map<std::string, std::string>& folders) {
  refuse_too_many(choice.changes.size(), base::whole(choice.profile.source));
  Node root = parse_tree(choice.profile.text, choice.profile.source);
  if (!choice.mode.empty()) set_key(root, "mode", mode_node(choice.mode, choice.mode_place), choice.mode_place);
  for (const auto& change : choice.changes) {
    set_key(root, change.key, parse_value(change.text, change.place), change.place);
    set_keys_of_modes(root, change);
  }
  std::map<std::string, NamedBy> who{{choice.profile.source, {choice.profile.folder, choice.profile.root}}};
  for (const auto& change : choice.changes) who.emplace(*change.place.source, change.by);
  folders = splice_calibrations(root, who);
  return root;
}

Camera interpret(const Choice& choice, const SeeCamera& see_each_mode = {}) {
  const Profile& profile = choice.profile;
  std::map<std::string, std::string> calibrations;
  const Node root = tree_of(choice, calibrations);
  base::Faults faults;
  const Value value = read(model::camera_form(), root, faults);
  Camera camera;
  Filler filler(profile.folder, faults);
  filler.set_calibration_folders(std::move(calibrations));
  filler.fill(value, camera);
  camera.source = profile.source;
  const Modes modes(value, faults);
  const auto choose = [&](std::size_t which) {
    modes.choose(which, camera, filler);
    filler.check(camera);
    faults.raise();
  };
  choose(modes.wanted());
  if (!see_each_mode) return camera;
  for (std::size_t i = 0; i < modes.count(); ++i) {
    choose(i);
    see_each_mode(camera);
  }
  choose(modes.wanted());
  return camera;
}

Profile builtin_profile(const Builtin& builtin) { return {std::string(builtin.text), "<" + builtin.name + ">", {}}; }

Profile named_profile(const std::string& file_or_name) {
  if (const Builtin* builtin = find_builtin(builtin_profiles(), file_or_name)) return builtin_profile(*builtin);
  return {read_named("camera", file_or_name, builtin_profiles()), file_or_name, folder_of(file_or_name)};
}

// A scene from a file may be a stranger's: its profile has to lie beside it or below.
Profile profile_of(const Scene& scene, const std::string& root) {
  const std::string& name = scene.camera.profile;
  if (const Builtin* builtin = find_builtin(builtin_profiles(), name)) return builtin_profile(*builtin);
  if (scene.source.empty()) return named_profile(name);
  const base::Place place = base::whole(scene.camera.profile_where.empty() ? scene.source : scene.camera.profile_where);
  if (name.find_first_of("/.") == std::string::npos) {
    std::vector<std::string> names;
    for (const auto& one : builtin_profiles()) names.push_back(one.name);
    base::fail(place, "no such camera: " + base::in_quotes(name) + base::did_you_mean(name, names),
               "built in: " + base::listed(names, "and") + "; a file's name ends in .yaml");
  }
  Profile out;
  const std::string folder = scene.source.starts_with("<") ? "." : folder_of(scene.source);
  out.text = read_reference(name, folder, root, place, out.source);
  out.folder = folder_of(out.source), out.root = root;
  return out;
}

Choice choice_of(const Scene& scene, const CameraOptions& options) {
  std::vector<Change> changes;
  const std::string folder = scene.source.starts_with("<") ? "." : folder_of(scene.source);
  for (const auto& one : scene.camera.overrides)
    changes.push_back({one.key, one.value, base::whole(one.where.empty() ? "camera." + one.key : one.where), {folder, options.root}});
  const bool ours = !options.mode.empty();
  const std::string& where = scene.camera.mode_where;
  const base::Place mode_place = base::whole(ours ? "--mode" : where.empty() ? "camera.mode" : where);
  for (auto& change : changes_of(options)) changes.push_back(std::move(change));
  return {profile_of(scene, options.root), ours ? options.mode : scene.camera.mode, mode_place, std::move(changes)};
}

}  // namespace

Camera camera_from_text(const std::string& text, const std::string& source, const std::string& folder, const CameraOptions& options,
                        const SeeCamera& see_each_mode) {
  return interpret({{text, source, folder}, options.mode, base::whole("--mode"), changes_of(options)}, see_each_mode);
}

Node camera_tree(const Scene& scene, const CameraOptions& options, std::string& source) {
  const Choice choice = choice_of(scene, options);
  source = choice.profile.source;
  std::map<std::string, std::string> folders;
  return tree_of(choice, folders);
}

Node camera_tree(const std::string& text, const std::string& source, const CameraOptions& options) {
  std::map<std::string, std::string> folders;
  return tree_of({{text, source, folder_of(source)}, options.mode, base::whole("--mode"), changes_of(options)}, folders);
}

}  // namespace tofray::load

namespace tofray {

Camera load_camera(const std::string& file_or_name, const CameraOptions& options) {
  return load::interpret({load::named_profile(file_or_name), options.mode, base::whole("--mode"), load::changes_of(options)});
}

Camera load_camera_text(const std::string& text, const std::string& source, const CameraOptions& options) {
  return load::camera_from_text(text, source, files::folder_of(source), options);
}

Camera load_camera(const Scene& scene, const CameraOptions& options) { return load::interpret(load::choice_of(scene, options)); }

}  // namespace tofray
