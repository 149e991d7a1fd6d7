// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/input_remarks.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <variant>

#include "assets/gltf_load.h"
#include "assets/mesh_piece.h"
#include "assets/obj_load.h"
#include "base/text.h"
#include "base/units.h"
#include "tofray/error.h"

namespace tofray::run {

namespace {

/// What a file had to lose: all objects that show a part of it counted, each part once.
std::vector<Remark> left_out_of(const Scene& scene) {
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
  std::vector<Remark> out;
  for (const auto& [key, file] : files)
    if (file.left_out > 0)
      out.push_back({true, "",
                     fmt::format("{} of the {} triangles of {} are left out", file.left_out, file.all, base::in_quotes(std::get<0>(key))),
                     "they have a corner that is no finite number, or beyond 1e5 m; gt_triangle_id counts the others"});
  return out;
}

constexpr std::size_t most_notices = 5;  // of one file

std::vector<Remark> notices_of(const Mesh& mesh) {
  const std::string file = base::in_quotes(mesh.file);
  std::vector<Remark> out;
  for (std::size_t i = 0; i < std::min(mesh.notices.size(), most_notices); ++i)
    out.push_back({true, "", fmt::format("{}: {}", file, base::printable(mesh.notices[i])), ""});
  if (mesh.notices.size() > most_notices)
    out.push_back({true, "", fmt::format("{}: and {} more", file, mesh.notices.size() - most_notices), ""});
  return out;
}

/// Where a file could say how much infrared light its materials reflect: only where it has any.
/// @param has_materials  besides colours of vertices
std::string where_to_say(const std::string& file, bool has_materials) {
  const bool is_obj = assets::is_obj(file);
  if (!has_materials || (!is_obj && !assets::is_gltf(file))) return "reflectivity or material at the object says it";
  return (is_obj ? "a line #!nir_reflectivity 0.6 below newmtl" : "nir_reflectivity in a material's extras") +
         std::string(" says it, or materials or reflectivity at the object");
}

std::vector<Remark> guesses_of(const Mesh& mesh, bool has_materials) {
  if (mesh.guessed == 0) return {};
  return {{true, "",
           fmt::format("{} of {} reflect{} as much infrared as visible light: a guess from the base colour",
                       mesh.guessed == 1 ? "1 material" : fmt::format("{} materials", mesh.guessed), base::in_quotes(mesh.file),
                       mesh.guessed == 1 ? "s" : ""),
           where_to_say(mesh.file, has_materials)}};
}

/// Files of which an object shows a material of theirs, not what has none.
std::set<std::string> files_with_materials(const Scene& scene) {
  std::set<std::string> out;
  for (const Object& object : scene.objects)
    if (const auto* mesh = std::get_if<Mesh>(&object.shape);
        mesh != nullptr && !object.name.ends_with(std::string("/") + assets::no_material))
      out.insert(mesh->file);
  return out;
}

}  // namespace

std::vector<Remark> object_remarks(const Scene& scene) {
  if (!scene.objects.empty()) return {};
  return {{true, "", "the scene has no objects: objects is []", "no pixel gets any light back: what depth there is, is noise"}};
}

std::vector<Remark> mesh_remarks(const Scene& scene) {
  std::vector<Remark> out = left_out_of(scene);
  std::set<std::string> said;  // each once, though several objects may show a file
  const std::set<std::string> with_materials = files_with_materials(scene);
  for (const Object& object : scene.objects)
    if (const auto* mesh = std::get_if<Mesh>(&object.shape))
      for (const std::vector<Remark>& some : {guesses_of(*mesh, with_materials.contains(mesh->file)), notices_of(*mesh)}) {
        std::string text;
        for (const Remark& one : some) text += one.text();
        if (said.insert(text).second) out.insert(out.end(), some.begin(), some.end());
      }
  return out;
}

std::vector<Remark> transport_remarks(const Scene& scene, const InputRequest& request) {
  const auto typed = [&](const char* key) {
    return std::any_of(request.set.begin(), request.set.end(), [key](const auto& one) { return one.first == key; });
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
      return {{true, "", fmt::format("transport.{} is given, but no light bounces: transport.bounces is 0", key),
               "nothing comes of it without bounces, as in transport: {bounces: 4, samples: 64}"}};
  return {};
}

double longest_lit(const Camera& camera) {
  double longest = 0;
  for (const RawFrame& one : camera.mode.sequence) longest = one.lit ? std::max(longest, one.integration_time_s) : longest;
  return longest;
}

std::vector<Remark> exposure_remarks(const Camera& camera, double mode_integration_time_s) {
  const double now = longest_lit(camera);
  if (!(mode_integration_time_s > 0 && now > mode_integration_time_s)) return {};
  return {{true, "",
           fmt::format("camera.integration_time is {}, longer than the {} of the mode {}", base::quantity_text(now, "1 us"),
                       base::quantity_text(mode_integration_time_s, "1 us"), camera.mode.name),
           "a mode's own time is what its camera is made for: its light, heat and safety to eyes"}};
}

std::vector<Remark> camera_remarks(const Camera& camera, const std::string& before) {
  const auto& lights = camera.illumination;
  const auto& sequence = camera.mode.sequence;
  const char* const effect = "no light comes back: what depth there is, is noise";
  std::vector<Remark> out;
  if (lights.empty()) {
    out.push_back({true, "", fmt::format("the camera has no light source: {}illumination is []", before), effect});
  } else if (std::none_of(lights.begin(), lights.end(), [](const Illumination& one) { return one.power_w > 0; })) {
    std::vector<std::string> powers;
    for (std::size_t i = 0; i < lights.size(); ++i) powers.push_back(fmt::format("{}illumination.{}.power is 0 W", before, i));
    out.push_back({true, "", "the camera's light sources have no power: " + base::listed(powers, "and"), effect});
  }
  if (std::none_of(sequence.begin(), sequence.end(), [](const RawFrame& one) { return one.lit; }))
    out.push_back(
        {true, "",
         fmt::format("the mode {0} has no lit raw frame: {1}modes.{0}.sequence says lit: false throughout", camera.mode.name, before),
         effect});
  return out;
}

}  // namespace tofray::run
