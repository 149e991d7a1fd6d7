// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "base/text.h"
#include "base/units.h"
#include "files/text_file.h"
#include "input_kind.h"
#include "load/builtin.h"
#include "load/gltf_load.h"
#include "load/load.h"
#include "load/mesh_piece.h"
#include "load/obj_load.h"
#include "mesh_scene.h"
#include "profile_tables.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

bool is_builtin_source(const std::string& source) { return source.starts_with("<"); }

/// The camera that the scene asks for, out of the texts of its profile and of the profile's tables.
Camera camera_of_texts(const Scene& scene, const results::InputFile& profile, const std::vector<results::InputFile>& files,
                       const std::string& mode) {
  CameraOptions wanted;
  wanted.mode = mode.empty() ? scene.camera.mode : mode;
  return load::camera_from_text(profile_with_tables(profile, scene.camera.overrides, files), profile.name, "", wanted);
}

/// Reads the scene; a file that is something else is refused as that.
Scene scene_of_text(const std::string& text, const std::string& name, const Options& options) {
  try {
    return load::scene_from_text(text, name, options.set, {options.root, {}});
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::bad_input) refuse_other_document(text, name);
    throw;
  }
}

/// Its meshes and keyframes by name and SHA-256, each once; not meshes that tofray has itself.
void add_files(const Scene& scene, std::vector<results::InputFile>& files) {
  for (const Object& object : scene.objects) {
    const auto* mesh = std::get_if<Mesh>(&object.shape);
    const auto is_it = [mesh](const results::InputFile& file) { return file.role == "mesh" && file.name == mesh->file; };
    if (mesh != nullptr && !mesh->sha256.empty() && std::none_of(files.begin(), files.end(), is_it))
      files.push_back({"mesh", mesh->file, "", mesh->sha256});
  }
  for (const SceneFile& one : scene.files) files.push_back({"keyframes", one.file, "", one.sha256});
}

/// The files that --from takes for meshes and keyframes: those of the manifest, unchanged.
load::MeshFiles files_of(const results::Manifest& manifest, const Options& options) {
  load::MeshFiles out{options.root, std::map<std::string, std::string>{}};
  for (const results::InputFile& file : manifest.inputs)
    if (file.role == "mesh" || file.role == "keyframes") (*out.expected)[file.name] = file.sha256;
  return out;
}

double longest_lit(const Camera& camera) {
  double longest = 0;
  for (const RawFrame& one : camera.mode.sequence) longest = one.lit ? std::max(longest, one.integration_time_s) : longest;
  return longest;
}

/// Longest lit exposure of the mode as its camera has it, where the scene sets camera.integration_time; otherwise 0.
/// @param load  the camera that a scene asks for
template <class Load>
double mode_integration_time(Scene scene, const Load& load) {
  const auto sets_time = [](const Override& one) { return one.key == "integration_time"; };
  if (std::erase_if(scene.camera.overrides, sets_time) == 0) return 0;
  try {
    return longest_lit(load(scene));
  } catch (const Error&) {
    return 0;  // the mode is good with the scene's time alone: there is nothing to compare with
  }
}

/// What a file had to lose: all objects that show a part of it counted, each part once.
std::string left_out_of(const Scene& scene) {
  struct File {
    std::size_t left_out = 0, all = 0;
    std::set<const TriangleMesh*> counted;
  };
  std::map<std::tuple<std::string, double, Mesh::Up, std::optional<double>>, File> files;
  for (const Object& object : scene.objects) {
    const auto* mesh = std::get_if<Mesh>(&object.shape);
    if (mesh == nullptr) continue;
    File& file = files[{mesh->file, mesh->scale, mesh->up, mesh->time_s}];
    if (!file.counted.insert(mesh->triangles.get()).second) continue;
    const auto left_out = static_cast<std::size_t>(mesh->left_out);
    file.left_out += left_out, file.all += left_out + mesh->triangles->triangles.size();
  }
  std::string text;
  for (const auto& [key, file] : files)
    if (file.left_out > 0)
      text += fmt::format(
          "warning: {} of the {} triangles of {} are left out\n  they have a corner that is no finite number, or beyond 1e5 m; "
          "gt_triangle_id counts the others\n",
          file.left_out, file.all, base::in_quotes(std::get<0>(key)));
  return text;
}

constexpr std::size_t most_notices = 5;  // of one file

std::string notices_of(const Mesh& mesh) {
  const std::string file = base::in_quotes(mesh.file);
  std::string text;
  for (std::size_t i = 0; i < std::min(mesh.notices.size(), most_notices); ++i)
    text += fmt::format("warning: {}: {}\n", file, base::printable(mesh.notices[i]));
  if (mesh.notices.size() > most_notices) text += fmt::format("warning: {}: and {} more\n", file, mesh.notices.size() - most_notices);
  return text;
}

/// Where a file could say how much infrared light its materials reflect: only where it has any.
/// @param has_materials  besides colours of vertices
std::string where_to_say(const std::string& file, bool has_materials) {
  const bool is_obj = load::is_obj(file);
  if (!has_materials || (!is_obj && !load::is_gltf(file))) return "reflectivity or material at the object says it";
  return (is_obj ? "a line #!nir_reflectivity 0.6 below newmtl" : "nir_reflectivity in a material's extras") +
         std::string(" says it, or materials or reflectivity at the object");
}

std::string guesses_of(const Mesh& mesh, bool has_materials) {
  if (mesh.guessed == 0) return {};
  return fmt::format("warning: {} of {} reflect{} as much infrared as visible light: a guess from the base colour\n  {}\n",
                     mesh.guessed == 1 ? "1 material" : fmt::format("{} materials", mesh.guessed), base::in_quotes(mesh.file),
                     mesh.guessed == 1 ? "s" : "", where_to_say(mesh.file, has_materials));
}

/// Files of which an object shows a material of theirs, not what has none.
std::set<std::string> files_with_materials(const Scene& scene) {
  std::set<std::string> out;
  for (const Object& object : scene.objects)
    if (const auto* mesh = std::get_if<Mesh>(&object.shape);
        mesh != nullptr && !object.name.ends_with(std::string("/") + load::no_material))
      out.insert(mesh->file);
  return out;
}

/// Each warning once, though several objects may show a file.
std::string mesh_warnings(const Scene& scene) {
  std::string text = left_out_of(scene);
  std::set<std::string> said;
  const std::set<std::string> with_materials = files_with_materials(scene);
  for (const Object& object : scene.objects)
    if (const auto* mesh = std::get_if<Mesh>(&object.shape))
      for (const std::string& one : {guesses_of(*mesh, with_materials.contains(mesh->file)), notices_of(*mesh)})
        if (said.insert(one).second) text += one;
  return text;
}

/// Ways of light without light that bounces: what is typed so is refused, what a scene's file says so is told.
/// @return what to tell
std::string idle_transport(const Scene& scene, const Options& options) {
  const auto typed = [&](const char* key) {
    return std::any_of(options.set.begin(), options.set.end(), [key](const auto& one) { return one.first == key; });
  };
  // Who types --bounces 0 compares with and without.
  if (scene.transport.bounces > 0 || typed("transport.bounces")) return {};
  const Transport fresh, &is = scene.transport;
  const std::pair<const char*, bool> said[] = {{"samples", is.samples != fresh.samples},
                                               {"max_samples", is.max_samples != fresh.max_samples},
                                               {"path_noise", is.path_noise_m != fresh.path_noise_m},
                                               {"smooth", is.smooth != fresh.smooth}};
  for (const auto& [key, differs] : said) {
    const std::string name = std::string("transport.") + key;
    if (typed(name.c_str()))
      throw Error(ErrorKind::bad_input,
                  fmt::format("error: {} ({}) is of light that bounces, and none does in the scene {}\n  expected "
                              "--bounces N with it, as in --bounces 4 --samples 64, or neither",
                              name == "transport.samples" ? "--samples" : "--set", name, base::in_quotes(scene.name)));
  }
  for (const auto& [key, differs] : said)
    if (differs)
      return fmt::format(
          "warning: transport.{} is given, but no light bounces: transport.bounces is 0\n  nothing comes of it without bounces, as in "
          "transport: {{bounces: 4, samples: 64}}\n",
          key);
  return {};
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
Inputs mesh_alone(const std::string& file, const Options& options) {
  const std::string name = scene_name_of_mesh(file);
  try {
    Inputs in;
    MeshScene of_mesh = scene_of_mesh(file, name, options);
    in.scene = load::scene_from_text(of_mesh.text, name, options.set, {options.root, {}});
    for (Object& object : in.scene.objects) object.where = file;
    in.mesh_alone = std::move(of_mesh.warnings), in.told_size = of_mesh.told_size;
    in.files.push_back({"scene", name, std::move(of_mesh.text)});
    return in;
  } catch (const Error& error) {
    throw Error(error.kind(), without_places_in(error.what(), name, file));
  }
}

}  // namespace

std::vector<SceneFinding> findings_of(SceneReport report, const Inputs& in) {
  using Kind = SceneFinding::Kind;
  constexpr Kind about_size[] = {Kind::mesh_size, Kind::millimetres, Kind::nothing_in_view, Kind::beyond_reach};
  if (in.told_size)
    std::erase_if(report.findings, [&](const SceneFinding& one) {
      return std::find(std::begin(about_size), std::end(about_size), one.kind) != std::end(about_size);
    });
  return std::move(report.findings);
}

Inputs load_inputs(const std::string& scene, const Options& options) {
  Inputs in;
  if (load::find_builtin(load::builtin_scenes(), scene) != nullptr) {
    in.scene = load::load_scene(scene, options.set);
    in.files.push_back({"scene", scene, {}});
  } else if (is_called_like_a_mesh(scene)) {
    in = mesh_alone(scene, options);
  } else {
    // Read once, so that a pipe is good, too, and the manifest holds what was simulated.
    refuse_folder(scene, "render");
    refuse_other_mesh(scene);
    const NamedText read = named_text(scene);
    refuse_data(read.text, read.name);
    in.scene = scene_of_text(read.text, read.name, options);
    in.files.push_back({"scene", read.name, read.text});
  }
  in.idle_transport = idle_transport(in.scene, options);
  add_files(in.scene, in.files);
  const auto load = [&](const Scene& seen) { return load_camera(seen, {options.mode, {}, options.root}); };
  in.camera = load(in.scene);
  in.mode_integration_time_s = mode_integration_time(in.scene, load);
  if (is_builtin_source(in.camera.source)) return in;
  in.files.push_back({"profile", in.camera.source, files::read_text(in.camera.source)});
  const auto tables = profile_tables(in.files.back(), files::folder_of(in.camera.source), in.scene.camera.overrides);
  in.files.insert(in.files.end(), tables.begin(), tables.end());
  return in;
}

Inputs inputs_of(const results::Manifest& manifest, const Options& options) {
  if (manifest.inputs.empty() || manifest.inputs[0].role != "scene")
    throw Error(ErrorKind::bad_input, options.from + ": error: inputs has no scene\n  expected the manifest.json of a `tofray render`");
  const results::InputFile& first = manifest.inputs[0];
  // A stranger's manifest reads no files of ours: what is not in it has to be built in. (Meshes and keyframes are read if their SHA-256 is the one in it.)
  if (first.text.empty() && load::find_builtin(load::builtin_scenes(), first.name) == nullptr)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: it does not hold the text of the scene {}\n  expected the scene's file in it, or the "
                            "name of a built-in one",
                            base::printable(options.from), base::in_quotes(first.name)));
  Inputs in;
  in.files = manifest.inputs;
  in.scene = first.text.empty() ? load::load_scene(first.name, options.set)
                                : load::scene_from_text(first.text, first.name, options.set, files_of(manifest, options));
  const auto profile =
      std::find_if(in.files.begin(), in.files.end(), [](const results::InputFile& file) { return file.role == "profile"; });
  const std::string& named = in.scene.camera.profile;
  if (profile == in.files.end() && load::find_builtin(load::builtin_profiles(), named) == nullptr)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: it does not hold the text of the camera profile {}\n  expected the profile's file in it, "
                            "or the name of a built-in one",
                            base::printable(options.from), base::in_quotes(named)));
  const auto load = [&](const Scene& seen) {
    return profile == in.files.end() ? load_camera(seen, {options.mode, {}, {}}) : camera_of_texts(seen, *profile, in.files, options.mode);
  };
  in.camera = load(in.scene);
  in.mode_integration_time_s = mode_integration_time(in.scene, load);
  return in;
}

std::string warnings(const Inputs& in) {
  std::string text;
  if (in.scene.objects.empty())
    text += "warning: the scene has no objects: objects is []\n  no pixel gets any light back: what depth there is, is noise\n";
  text += in.mesh_alone + mesh_warnings(in.scene) + in.idle_transport;
  const double now = longest_lit(in.camera), modes = in.mode_integration_time_s;
  if (modes > 0 && now > modes)
    text += fmt::format(
        "warning: camera.integration_time is {}, longer than the {} of the mode {}\n  a mode's own time is what its camera is made for: "
        "its "
        "light, heat and safety to eyes\n",
        base::quantity_text(now, "1 us"), base::quantity_text(modes, "1 us"), in.camera.mode.name);
  return text + warnings(in.camera, "camera.");
}

std::string warnings(const Camera& camera, const std::string& before) {
  const auto& lights = camera.illumination;
  const auto& sequence = camera.mode.sequence;
  const char* const effect = "\n  no light comes back: what depth there is, is noise\n";
  std::string text;
  if (lights.empty()) {
    text += fmt::format("warning: the camera has no light source: {}illumination is []{}", before, effect);
  } else if (std::none_of(lights.begin(), lights.end(), [](const Illumination& one) { return one.power_w > 0; })) {
    std::vector<std::string> powers;
    for (std::size_t i = 0; i < lights.size(); ++i) powers.push_back(fmt::format("{}illumination.{}.power is 0 W", before, i));
    text += fmt::format("warning: the camera's light sources have no power: {}{}", base::listed(powers, "and"), effect);
  }
  if (std::none_of(sequence.begin(), sequence.end(), [](const RawFrame& one) { return one.lit; }))
    text += fmt::format("warning: the mode {0} has no lit raw frame: {1}modes.{0}.sequence says lit: false throughout{2}", camera.mode.name,
                        before, effect);
  return text;
}

std::vector<std::pair<std::string, std::string>> camera_settings(const Options& options) {
  auto settings = options.set;
  for (auto& [key, value] : settings)
    if (key.starts_with("camera.")) key.erase(0, 7);
  return settings;
}

SimulatorOptions simulator_options(const Options& options) {
  SimulatorOptions out;
  out.seed = options.seed.value_or(0);
  out.noise = options.noise.value_or(Noise::exact);
  out.exposure_samples = options.exposure_samples.value_or(1);
  out.subpixel = options.subpixel.value_or(1);
  out.threads = options.threads;
  out.backend = options.backend.value_or(Backend::automatic);
  out.device = options.device;
  return out;
}

}  // namespace tofray::app
