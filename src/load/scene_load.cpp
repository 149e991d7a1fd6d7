// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <map>

#include "base/limits.h"
#include "base/text.h"
#include "base/vec.h"
#include "files/text_file.h"
#include "load/builtin.h"
#include "load/convert.h"
#include "load/fill.h"
#include "load/gltf_load.h"
#include "load/load.h"
#include "load/material_library.h"
#include "load/mesh_load.h"
#include "load/obj_load.h"
#include "yaml/settings.h"

namespace tofray::load {

using yaml::flattened;
using yaml::Node;
using yaml::parse_tree;
using yaml::parse_value;
using yaml::read;
using yaml::refuse_too_many;
using yaml::set_key;
using yaml::Value;

namespace {

using base::Faults;
using base::in_quotes;

/// An object that is a mesh, and what its file holds.
struct MeshOfScene {
  std::size_t object;
  const Value* value;
  bool by_material;
  const MeshReader::Known* known;
};

class SceneReader {
 public:
  SceneReader(const std::string& source, const MeshFiles& meshes, Faults& faults)
      : faults_(faults), filler_("", faults), meshes_(source, meshes) {}

  Scene scene(const Value& root) {
    Scene out;
    filler_.fill(root, out);
    camera(root["camera"], out.camera);
    ambient(root["ambient"], out.ambient);
    const Value &materials = root["materials"], &objects = root["objects"];
    // Where they are filled they stay: faults are told by their addresses.
    out.materials.reserve(materials.items.size() + objects.items.size());
    out.objects.reserve(objects.items.size());
    for (std::size_t i = 0; i < materials.items.size(); ++i) {
      filler_.fill(materials.items[i], out.materials.emplace_back());
      out.materials.back().name = materials.names[i];
    }
    for (const auto& entry : objects.items)
      if (entry.good && !entry.items.empty()) object(entry, out);
    read_meshes(out);
    filler_.check(out);
    if (faults_.empty()) apart_by_material(out);
    return out;
  }

 private:
  void camera(const Value& value, CameraChoice& out) {
    if (!value.is_map()) return;
    if (value["profile"]) out.profile_where = base::to_string(value["profile"].place());
    if (value["mode"]) out.mode_where = base::to_string(value["mode"].place());
    overrides(*value.node, out);
  }

  void overrides(const Node& camera, CameraChoice& out) {
    std::vector<std::string> known = {"profile", "mode", "pose"};
    out.overrides = flattened(camera, known);
    refuse_too_many(out.overrides.size(), camera.place);
    std::vector<std::string> names;
    for (const auto& key : model::camera_form().root.keys) names.push_back(key.name);
    known.insert(known.end(), names.begin(), names.end());
    for (const auto& key : camera.keys) {
      const std::string first = key.text.substr(0, key.text.find('.'));
      if (std::find(known.begin(), known.end(), first) == known.end())
        faults_.add(key.place, "unknown key " + in_quotes(key.text) + " in camera" + base::did_you_mean(first, known),
                    "expected profile, mode, pose, or a key of a camera profile that overrides its value: " + base::listed(names, "and"));
    }
  }

  void ambient(const Value& value, const Ambient& out) {
    const Value& spectrum = value["spectrum"];
    if (!value || !spectrum.good) return;
    const bool amount = value["level"] || value["illuminance"] || value["band_irradiance"];
    if (!amount && out.spectrum != Ambient::Spectrum::none)
      faults_.add(value.place(), "ambient does not say how much light",
                  "expected level: 5 %, illuminance: 5 klx, or band_irradiance: 0.4 W/m2");
    if (out.amount > 0 && out.spectrum == Ambient::Spectrum::none)
      faults_.add(spectrum ? spectrum.place() : value.place(), "ambient has an amount, but its spectrum is none",
                  "expected a spectrum such as sun_am15, or no amount");
  }

  int material_of(const Value& object, Scene& scene) {
    const Value& chosen = object["material"];
    if (chosen && chosen.either == 0) return named_material(chosen, scene);
    Material& one = scene.materials.emplace_back();
    if (chosen)
      filler_.fill(chosen, one);
    else
      one.diffuse = object["reflectivity"].number;
    return static_cast<int>(scene.materials.size()) - 1;
  }

  int named_material(const Value& chosen, Scene& scene) {
    if (index_.empty())
      for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (!scene.materials[i].name.empty()) index_.emplace(scene.materials[i].name, static_cast<int>(i));
    const auto found = index_.find(chosen.text);
    if (found != index_.end()) return found->second;
    if (const LibraryMaterial* known = find_library_material(chosen.text)) {
      index_.emplace(chosen.text, static_cast<int>(scene.materials.size()));
      scene.materials.push_back(known->material);
    } else {
      no_material(chosen);
      scene.materials.emplace_back();
    }
    return static_cast<int>(scene.materials.size()) - 1;
  }

  void no_material(const Value& chosen) {
    std::vector<std::string> names;
    for (const auto& [name, i] : index_) names.push_back(name);
    const bool none = names.empty(), many = names.size() > 20;
    std::vector<std::string> near = names;
    for (const LibraryMaterial& one : material_library()) near.push_back(one.material.name);
    faults_.add(chosen.place(), "no material " + in_quotes(chosen.text) + base::did_you_mean(chosen.text, near),
                (none   ? "the scene has no materials: section"
                 : many ? "expected one out of the scene's materials: section"
                        : "materials of this scene: " + base::listed(names, "and")) +
                    std::string("; `tofray list materials` names those that are built in; or write reflectivity: 0.5 instead"));
  }

  void object(const Value& entry, Scene& scene) {
    const Value& value = entry.items[0];
    Object& out = scene.objects.emplace_back();
    out.material = material_of(value, scene);
    filler_.fill(value, out);
    const model::Slot shape = model::slot_of(out.shape);
    const auto& one = std::get<model::VariantSlot>(shape);
    const auto which = static_cast<std::size_t>(entry.alternative);
    one.emplace(one.at, which);
    filler_.fill(value, one.tables[which](), one.held(one.at));
    if (const auto* triangle = std::get_if<Triangle>(&out.shape)) area(value, *triangle);
    if (std::holds_alternative<Mesh>(out.shape)) mesh(value, std::get<Mesh>(out.shape), static_cast<int>(scene.objects.size()) - 1);
  }

  void mesh(const Value& value, const Mesh& out, int object) {
    const bool has_material = value["material"] || value["reflectivity"];
    meshes_of_scene_.push_back({static_cast<std::size_t>(object), &value, !has_material, nullptr});
    if (!value["file"].good || is_gltf(out.file)) return;
    if (!has_material && is_obj(out.file))
      meshes_.want_materials(out.file);
    else if (!has_material)
      faults_.add(value.place(), "mesh lacks a key", lacks_material);
    if (out.time_s) faults_.add(value["time"].place(), "time is for glTF files", "an OBJ, PLY or STL file stands still");
  }

  /// Once all else that was read is good: a file may be long.
  void read_meshes(Scene& scene) {
    for (MeshOfScene& one : meshes_of_scene_) {
      Mesh& mesh = std::get<Mesh>(scene.objects[one.object].shape);
      if (faults_.empty()) {
        const Value& time = (*one.value)["time"];
        one.known =
            &meshes_.read({one.value->place(), (*one.value)["file"].place(), (time ? time : *one.value).place()}, mesh, one.by_material);
        one.known->show(0, mesh);
      } else {
        mesh.triangles = std::make_shared<const TriangleMesh>();  // what is wrong is told already
      }
    }
  }

  /// An object that has no material becomes one for each of its file's.
  void apart_by_material(Scene& scene) {
    std::vector<Object> objects;
    auto next = meshes_of_scene_.begin();
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      const bool is_mesh = next != meshes_of_scene_.end() && next->object == i;
      if (is_mesh && next->by_material)
        add_pieces(*next, scene.objects[i], scene.objects.size() - i - 1, scene.materials, objects);
      else
        objects.push_back(std::move(scene.objects[i]));
      if (is_mesh) ++next;
    }
    scene.objects = std::move(objects);
  }

  /// @param behind  objects that are still to come
  static void add_pieces(const MeshOfScene& of, const Object& whole, std::size_t behind, std::vector<Material>& materials,
                         std::vector<Object>& objects) {
    constexpr auto most = static_cast<std::size_t>(base::limit::objects.value);
    const std::vector<MeshReader::Piece>& pieces = of.known->pieces;
    if (objects.size() + pieces.size() + behind > most)
      base::fail((*of.value)["file"].place(), "the scene has too many objects",
                 "at most " + std::to_string(most) +
                     " (`tofray --limits`); a file's materials without a reflectivity of the object's are one each",
                 ErrorKind::limit);
    const std::string& file = std::get<Mesh>(whole.shape).file;
    const std::string name = whole.name.empty() ? std::filesystem::path(file).stem().string() : whole.name;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      Object& one = objects.emplace_back(whole);
      one.name = name + "/" + pieces[k].material;
      of.known->show(k, std::get<Mesh>(one.shape));
      if (k > 0) std::get<Mesh>(one.shape).guessed = 0, std::get<Mesh>(one.shape).notices.clear();
      if (k > 0) one.material = static_cast<int>(materials.size()), materials.emplace_back();
      Material& material = materials[static_cast<std::size_t>(one.material)];
      material.diffuse = pieces[k].reflectivity, material.map = pieces[k].map;
    }
  }

  void area(const Value& value, const Triangle& triangle) {
    using base::operator-;
    const Vec3 a = triangle.vertices[1] - triangle.vertices[0], b = triangle.vertices[2] - triangle.vertices[0];
    const double longest = std::max({base::length(a), base::length(b), base::length(a - b)});
    // Height over the longest side; the second bound is what rounding of the coordinates leaves of three points on a line.
    const double height = longest > 0 ? base::length(base::cross(a, b)) / longest : 0;
    if (!(height >= base::shortest_m && height >= 1e-9 * longest))
      faults_.add(value["vertices"].place(), "the triangle has no area",
                  "its three corners lie on a line or in one point; expected a height of at least 1 um");
  }

  Faults& faults_;
  Filler filler_;
  std::map<std::string, int> index_;
  MeshReader meshes_;
  std::vector<MeshOfScene> meshes_of_scene_;
};

Scene interpret(const Node& root, const std::string& source, const MeshFiles& meshes) {
  Faults faults;
  const Value value = read(model::scene_form(), root, faults);
  Scene out = SceneReader(source, meshes, faults).scene(value);
  faults.raise();
  return out;
}

void apply(Node& root, const Settings& settings) {
  refuse_too_many(settings.size(), base::whole("--set"));
  for (const auto& [key, text] : settings) {
    const base::Place place = base::whole("--set " + key);
    set_key(root, key, parse_value(text, place), place);
  }
}

}  // namespace

Scene scene_from_text(const std::string& text, const std::string& source, const Settings& settings, const MeshFiles& meshes) {
  Node root = parse_tree(text, source);
  apply(root, settings);
  Scene scene = interpret(root, source, meshes);
  scene.source = source;
  const std::string stem = std::filesystem::path(source).stem().string();
  // The name becomes a folder's: "." and ".." are folders that have one.
  scene.name = stem.empty() || stem == "." || stem == ".." ? "scene" : stem;
  return scene;
}

Scene load_scene(const std::string& file_or_name, const Settings& settings, const MeshFiles& meshes) {
  if (const Builtin* builtin = find_builtin(builtin_scenes(), file_or_name)) {
    Scene scene = scene_from_text(std::string(builtin->text), "<" + builtin->name + ">", settings, meshes);
    scene.name = builtin->name;
    return scene;
  }
  return scene_from_text(read_named("scene", file_or_name, builtin_scenes()), file_or_name, settings, meshes);
}

}  // namespace tofray::load

namespace tofray {

Scene load_scene(const std::string& file_or_name) { return load::load_scene(file_or_name, {}); }

}  // namespace tofray
