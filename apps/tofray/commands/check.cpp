// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <set>

#include "analysis/image_geometry.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/remarks.h"
#include "cli/requests.h"
#include "commands/camera_text.h"
#include "commands/scene_text.h"
#include "files/json.h"
#include "files/text_file.h"
#include "load/builtin.h"
#include "load/load.h"
#include "load/provenance.h"
#include "run/input_kind.h"
#include "run/input_remarks.h"
#include "run/mesh_scene.h"
#include "tofray/error.h"
#include "yaml/tree.h"

namespace tofray::app {

namespace {

/// Scene and camera are put together, and nothing is computed: no reason to wake a GPU.
SimulatorOptions on_processor(const Options& options) {
  SimulatorOptions out = simulator_options(options);
  out.backend = Backend::cpu;
  return out;
}

/// What is asked of the camera: by the options, else what stands there without them, and for a scene its ambient light, too.
CameraQuestion question_of(const Options& options, const Scene* scene) {
  CameraQuestion out;
  if (!options.at_m.empty()) out.distances_m = options.at_m;
  if (!options.reflectivities.empty()) out.reflectivities = options.reflectivities;
  out.ambients = options.ambients;
  if (!out.ambients.empty() || scene == nullptr || scene->ambient.spectrum == Ambient::Spectrum::none || !(scene->ambient.amount > 0))
    return out;
  AmbientCase own;
  own.name = "in scene's light", own.ambient = scene->ambient, own.pose = pose_from_matrix(camera_pose(*scene, 0));
  out.ambients = {AmbientCase(), own, full_sun()};
  return out;
}

/// What is odd about the design.
std::string design_warnings(const CameraReport& report, const std::string& name) {
  std::string out;
  for (const std::string& one : report.warnings) out += fmt::format("{}: warning: {}\n", name, one);
  return out;
}

struct Report {
  files::Json json = files::Json::object();
  std::string text, warnings;
  std::vector<Remark> odd;
};

/// Numbers that do not say where they come from: how many there are, or each.
std::string source_warnings(const std::vector<std::string>& unsourced, const std::string& name, bool each) {
  if (unsourced.empty()) return {};
  const std::string expected = "  expected source: or assumed: beside it, or for its group";
  if (!each && unsourced.size() > 1)
    return fmt::format("{}: warning: {} numbers do not say where they come from\n{}; --sources names each\n", name, unsourced.size(),
                       expected);
  std::string out;
  for (const std::string& one : unsourced)
    out += fmt::format("{}: warning: {}, and does not say where that comes from\n", one.substr(0, one.find(": ")),
                       one.substr(one.find(": ") + 2));
  return out + expected + "\n";
}

Report check_profile(const std::string& text, const std::string& name, const Options& options) {
  Report report;
  bool tables_seen = false;
  // A fault can be in any mode.
  const auto check_mode = [&](const Camera& in_mode) {
    Camera camera = analysis::image_camera(in_mode);
    // Sensor and lens are the same in all modes: their tables, by pixel, are made once.
    if (tables_seen) camera.sensor.width = camera.sensor.height = 1;
    tables_seen = true;
    Simulator(Scene(), camera, on_processor(options));
    const std::string more = texts(run::camera_remarks(in_mode, ""));
    if (report.warnings.find(more) == std::string::npos) report.warnings += more;
  };
  const Camera camera =
      load::camera_from_text(text, name, files::folder_of(name), {options.mode, camera_settings(options), {}}, check_mode);
  const std::vector<std::string> unsourced = load::unsourced_numbers(yaml::parse_tree(text, name));
  report.warnings += source_warnings(unsourced, name, options.sources);
  report.json.set("kind", "camera")
      .set("name", camera.name)
      .set("modes", files::Json::list(camera.mode_names))
      .set("unsourced_numbers", files::Json::list(unsourced));
  const CameraReport can = camera_report(camera, question_of(options, nullptr));
  report.warnings += design_warnings(can, name);
  report.json.set("mode", camera.mode.name).set("camera_report", report_json(can));
  report.text = fmt::format("{}: good: camera {}, {} x {} pixels, {} modes; in mode {}:\n{}", name, camera.name, can.width, can.height,
                            camera.mode_names.size(), camera.mode.name, report_text(can));
  return report;
}

/// Of all meshes; those that objects share count once.
std::size_t mesh_triangles(const Scene& scene) {
  std::set<const TriangleMesh*> seen;
  std::size_t count = 0;
  for (const Object& object : scene.objects)
    if (const auto* mesh = std::get_if<Mesh>(&object.shape); mesh != nullptr && seen.insert(mesh->triangles.get()).second)
      count += mesh->triangles->triangles.size();
  return count;
}

/// @param file  as run::load() takes it
Report check_scene(const std::string& file, const Options& options) {
  const run::Loaded in = run::load(input_request(file, options));
  const std::string& name = in.files[0].name;
  Simulator(in.scene, in.camera, on_processor(options));
  Report report;
  report.warnings = texts(in.remarks);
  report.json.set("kind", "scene")
      .set("name", in.scene.name)
      .set("objects", in.scene.objects.size())
      .set("materials", in.scene.materials.size())
      .set("mesh_triangles", mesh_triangles(in.scene));
  report.json.set("camera", in.camera.name).set("mode", in.camera.mode.name).set("raw_frames", in.camera.mode.sequence.size());
  const std::size_t triangles = mesh_triangles(in.scene);
  const std::string meshes = triangles == 0 ? "" : fmt::format(" ({} triangle{} in meshes)", triangles, triangles == 1 ? "" : "s");
  report.text =
      fmt::format("{}: good: scene with {} object{}{}, camera {} in mode {}, {} raw frames\n", name, in.scene.objects.size(),
                  in.scene.objects.size() == 1 ? "" : "s", meshes, in.camera.name, in.camera.mode.name, in.camera.mode.sequence.size());
  const CameraReport can = camera_report(in.camera, question_of(options, &in.scene));
  report.warnings += design_warnings(can, name);
  const SceneReport seen = scene_report(in.scene, in.camera);
  report.json.set("camera_report", report_json(can)).set("scene_report", scene_report_json(seen));
  report.text += report_text(can) + scene_report_text(seen);
  report.odd = run::findings_of(seen, in.told_size, true);
  return report;
}

/// @param name  a file, or what is built in
Report check(const std::string& name, const Options& options) {
  if (load::find_builtin(load::builtin_scenes(), name) != nullptr) return check_scene(name, options);
  if (const load::Builtin* profile = load::find_builtin(load::builtin_profiles(), name))
    return check_profile(std::string(profile->text), name, options);
  run::refuse_folder(name, "check");
  if (run::is_called_like_a_mesh(name)) return check_scene(name, options);
  run::refuse_other_mesh(name);
  const run::NamedText read = run::named_text(name);
  run::refuse_data(read.text, read.name);
  return run::looks_like_a_profile(read.text, read.name) ? check_profile(read.text, read.name, options) : check_scene(name, options);
}

}  // namespace

int run_check(const Options& options) {
  Remarks remarks;
  const NameChoice scene = choose_scene(options.words[0]), chosen = scene.note.empty() ? choose_camera(options.words[0]) : scene;
  remarks.tell(run::note_of(chosen));
  Report report = check(chosen.name, options);
  remarks.tell(report.warnings), remarks.tell(report.odd);
  if (options.json)
    print(files::json_text(remarks.put(report.json.set("good", true)), 2) + "\n");
  else if (!options.quiet)
    print(report.text);
  return 0;
}

}  // namespace tofray::app
