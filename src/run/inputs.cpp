// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/inputs.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <variant>

#include "base/text.h"
#include "files/text_file.h"
#include "load/builtin.h"
#include "load/load.h"
#include "run/input_kind.h"
#include "run/input_remarks.h"
#include "run/mesh_scene.h"
#include "run/profile_tables.h"
#include "tofray/error.h"
#include "tofray/load.h"

namespace tofray::run {

namespace {

bool is_builtin_source(const std::string& source) { return source.starts_with("<"); }

/// The camera that the scene asks for, out of the texts of its profile and of the profile's tables.
Camera camera_of_texts(const Scene& scene, const InputFile& profile, const std::vector<InputFile>& files, const std::string& mode) {
  CameraOptions wanted;
  wanted.mode = mode.empty() ? scene.camera.mode : mode;
  return load::camera_from_text(profile_with_tables(profile, scene.camera.overrides, files), profile.name, "", wanted);
}

/// Reads the scene; a file that is something else is refused as that.
Scene scene_of_text(const std::string& text, const std::string& name, const InputRequest& request) {
  try {
    return load::scene_from_text(text, name, request.set, {request.root, {}});
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::bad_input) refuse_other_document(text, name);
    throw;
  }
}

/// Its meshes and keyframes by name and SHA-256, each once; not meshes that tofray has itself.
void add_files(const Scene& scene, std::vector<InputFile>& files) {
  for (const Object& object : scene.objects) {
    const auto* mesh = std::get_if<Mesh>(&object.shape);
    const auto is_it = [mesh](const InputFile& file) { return file.role == "mesh" && file.name == mesh->file; };
    if (mesh != nullptr && !mesh->sha256.empty() && std::none_of(files.begin(), files.end(), is_it))
      files.push_back({"mesh", mesh->file, "", mesh->sha256});
  }
  for (const SceneFile& one : scene.files) files.push_back({"keyframes", one.file, "", one.sha256});
}

/// The files that --from takes for meshes and keyframes: those of the manifest, unchanged.
assets::MeshFiles files_of(const results::Manifest& manifest, const std::string& root) {
  assets::MeshFiles out{root, std::map<std::string, std::string>{}};
  for (const InputFile& file : manifest.inputs)
    if (file.role == "mesh" || file.role == "keyframes") (*out.expected)[file.name] = file.sha256;
  return out;
}

/// Longest lit exposure of the mode as its camera has it, where the scene sets camera.integration_time; otherwise 0.
/// @param camera_for  the camera that a scene asks for
template <class Load>
double mode_integration_time(Scene scene, const Load& camera_for) {
  const auto sets_time = [](const Override& one) { return one.key == "integration_time"; };
  if (std::erase_if(scene.camera.overrides, sets_time) == 0) return 0;
  try {
    return longest_lit(camera_for(scene));
  } catch (const Error&) {
    return 0;  // the mode is good with the scene's time alone: there is nothing to compare with
  }
}

/// Says the mesh where a message says a place in the text that stands for its scene: that is nowhere.
std::string without_places_in(const std::string& text, const std::string& name, const std::string& mesh) {
  std::string out;
  for (std::size_t from = 0; from < text.size();) {
    std::size_t end = std::min(text.find('\n', from), text.size() - 1) + 1;
    std::string_view line = std::string_view(text).substr(from, end - from);
    from = end;
    if (line.starts_with(name + ":")) {
      line.remove_prefix(name.size());
      const std::size_t behind = std::min(line.find_first_not_of(":0123456789"), line.size());
      out += mesh + ":";
      line.remove_prefix(std::max<std::size_t>(behind, 1));
    }
    out += line;
  }
  return out;
}

/// A mesh that is given in place of a scene.
Loaded mesh_alone(const std::string& file, const InputRequest& request) {
  const std::string name = scene_name_of_mesh(file);
  try {
    Loaded in;
    MeshScene of_mesh = scene_of_mesh(file, name, request);
    in.scene = load::scene_from_text(of_mesh.text, name, request.set, {request.root, {}});
    for (Object& object : in.scene.objects) object.where = file;
    in.remarks = std::move(of_mesh.remarks), in.told_size = of_mesh.told_size;
    in.files.push_back({"scene", name, std::move(of_mesh.text)});
    return in;
  } catch (const Error& error) {
    throw Error(error.kind(), without_places_in(error.what(), name, file));
  }
}

void add(std::vector<Remark>& all, std::vector<Remark> more) { all.insert(all.end(), more.begin(), more.end()); }

/// Once scene and camera are there. @param transport  what is told of light paths
void add_remarks(Loaded& in, std::vector<Remark> transport, double mode_integration_time_s) {
  std::vector<Remark> of_mesh = std::move(in.remarks);
  in.remarks = object_remarks(in.scene);
  add(in.remarks, std::move(of_mesh)), add(in.remarks, mesh_remarks(in.scene)), add(in.remarks, std::move(transport));
  add(in.remarks, exposure_remarks(in.camera, mode_integration_time_s)), add(in.remarks, camera_remarks(in.camera, "camera."));
}

}  // namespace

std::vector<Remark> findings_of(const SceneReport& report, bool told_size, bool notes) {
  using Kind = SceneFinding::Kind;
  constexpr Kind about_size[] = {Kind::mesh_size, Kind::millimetres, Kind::nothing_in_view, Kind::beyond_reach};
  std::vector<Remark> out;
  for (const SceneFinding& one : report.findings) {
    if (one.kind == Kind::no_objects || (!one.warning && !notes)) continue;
    if (told_size && std::find(std::begin(about_size), std::end(about_size), one.kind) != std::end(about_size)) continue;
    out.push_back({one.warning, one.where, one.what, one.more});
  }
  return out;
}

Loaded load(const InputRequest& request) {
  if (!request.manifest.empty()) return load_of_manifest(results::read_manifest(request.manifest), request);
  Loaded in;
  const std::string& scene = request.scene;
  if (load::find_builtin(load::builtin_scenes(), scene) != nullptr) {
    in.scene = load::load_scene(scene, request.set);
    in.files.push_back({"scene", scene, {}});
  } else if (is_called_like_a_mesh(scene)) {
    in = mesh_alone(scene, request);
  } else {
    // Read once, so that a pipe is good, too, and the manifest holds what was simulated.
    refuse_folder(scene, "render");
    refuse_other_mesh(scene);
    const NamedText read = named_text(scene);
    refuse_data(read.text, read.name);
    in.scene = scene_of_text(read.text, read.name, request);
    in.files.push_back({"scene", read.name, read.text});
  }
  std::vector<Remark> transport = transport_remarks(in.scene, request);
  add_files(in.scene, in.files);
  const auto camera_for = [&](const Scene& seen) { return load_camera(seen, {request.mode, {}, request.root}); };
  in.camera = camera_for(in.scene);
  add_remarks(in, std::move(transport), mode_integration_time(in.scene, camera_for));
  if (is_builtin_source(in.camera.source)) return in;
  in.files.push_back({"profile", in.camera.source, files::read_text(in.camera.source)});
  const auto tables = profile_tables(in.files.back(), files::folder_of(in.camera.source), in.scene.camera.overrides);
  in.files.insert(in.files.end(), tables.begin(), tables.end());
  return in;
}

Loaded load_of_manifest(const results::Manifest& manifest, const InputRequest& request) {
  const std::string& file = request.manifest;
  if (manifest.inputs.empty() || manifest.inputs[0].role != "scene")
    throw Error(ErrorKind::bad_input, file + ": error: inputs has no scene\n  expected the manifest.json of a `tofray render`");
  const InputFile& first = manifest.inputs[0];
  // A stranger's manifest reads no files of ours: what is not in it has to be built in. (Meshes and keyframes are read if their SHA-256 is the one in it.)
  if (first.text.empty() && load::find_builtin(load::builtin_scenes(), first.name) == nullptr)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: it does not hold the text of the scene {}\n  expected the scene's file in it, or the "
                            "name of a built-in one",
                            base::printable(file), base::in_quotes(first.name)));
  Loaded in;
  in.files = manifest.inputs;
  in.scene = first.text.empty() ? load::load_scene(first.name, request.set)
                                : load::scene_from_text(first.text, first.name, request.set, files_of(manifest, request.root));
  const auto profile = std::find_if(in.files.begin(), in.files.end(), [](const InputFile& one) { return one.role == "profile"; });
  const std::string& named = in.scene.camera.profile;
  if (profile == in.files.end() && load::find_builtin(load::builtin_profiles(), named) == nullptr)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: it does not hold the text of the camera profile {}\n  expected the profile's file in it, "
                            "or the name of a built-in one",
                            base::printable(file), base::in_quotes(named)));
  const auto camera_for = [&](const Scene& seen) {
    return profile == in.files.end() ? load_camera(seen, {request.mode, {}, {}}) : camera_of_texts(seen, *profile, in.files, request.mode);
  };
  in.camera = camera_for(in.scene);
  add_remarks(in, {}, mode_integration_time(in.scene, camera_for));
  return in;
}

}  // namespace tofray::run

namespace tofray {

Inputs load_inputs(const InputRequest& request) { return run::load(request); }

std::string Remark::text() const {
  return fmt::format("{}{}: {}\n{}", where.empty() ? "" : where + ": ", warning ? "warning" : "note", what,
                     more.empty() ? "" : "  " + more + "\n");
}

}  // namespace tofray
