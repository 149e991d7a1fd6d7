// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <deque>
#include <filesystem>
#include <map>
#include <set>

#include "assets/gltf_load.h"
#include "assets/material_library.h"
#include "assets/mesh_load.h"
#include "assets/obj_load.h"
#include "base/limits.h"
#include "base/rotation.h"
#include "base/text.h"
#include "base/vec.h"
#include "files/sha256.h"
#include "files/text_file.h"
#include "load/builtin.h"
#include "load/convert.h"
#include "load/fill.h"
#include "load/load.h"
#include "load/rotation_load.h"
#include "load/trajectory.h"
#include "load/trees.h"
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
  const assets::MeshReader::Known* known;
  std::map<std::string, const Material*> own = {};  ///< what the scene says of the file's materials, by their names
};

class SceneReader {
 public:
  SceneReader(const std::string& source, const assets::MeshFiles& meshes, Faults& faults)
      : faults_(faults), filler_("", faults), source_(source), files_(meshes), meshes_(source, meshes) {}

  Scene scene(const Value& root) {
    Scene out;
    set_world_up(root, out);
    filler_.fill(root, out);
    camera(root["camera"], out.camera);
    ambient(root["ambient"], out.ambient);
    for (const Value& one : root["classes"].items) out.classes.push_back(one.text);
    const Value &materials = root["materials"], &objects = root["objects"];
    // Where they are filled they stay: faults are told by their addresses.
    out.materials.reserve(materials.items.size() + objects.items.size());
    out.objects.reserve(objects.items.size());
    for (std::size_t i = 0; i < materials.items.size(); ++i) {
      filler_.fill(materials.items[i], out.materials.emplace_back());
      out.materials.back().name = materials.names[i];
    }
    for (std::size_t i = 0; i < objects.items.size(); ++i)
      if (const Value& entry = objects.items[i]; entry.good && !entry.items.empty()) object(entry, i, out);
    read_keyframes(root, out);
    read_meshes(out);
    filler_.check(out);
    for (const Material& one : of_files_) filler_.check(one);
    if (faults_.empty()) name_own_materials();
    if (faults_.empty()) apart_by_material(out);
    return out;
  }

 private:
  /// Reads `world_up`, before any pose is read.
  void set_world_up(const Value& root, Scene& out) {
    const Value& said = root["world_up"];
    if (said.text == "z") out.world_up = Scene::Up::z;
    if (said.text == "y") out.world_up = Scene::Up::y;
    filler_.set_world_up(out.world_up);
    meshes_.set_world_up(out.world_up);
    if (!root["camera"]["keyframes"]) out.camera.pose = pose_in(out.world_up);
  }

  void camera(const Value& value, CameraChoice& out) {
    if (!value.is_map()) return;
    if (value["profile"]) out.profile_where = base::to_string(value["profile"].place());
    if (value["mode"]) out.mode_where = base::to_string(value["mode"].place());
    overrides(*value.node, out);
  }

  /// A key that stands deeper in a profile, or that people call otherwise.
  static std::string meant_in_camera(const std::string& key) {
    for (const auto& [word, path] : model::camera_form().root.meant)
      if (word == key) return path;
    return yaml::home_of(model::camera_form().root, key);
  }

  void overrides(const Node& camera, CameraChoice& out) {
    std::vector<std::string> known = {"profile", "mode", "pose", "keyframes"};
    out.overrides = flattened(camera, known);
    refuse_too_many(out.overrides.size(), camera.place);
    std::vector<std::string> names;
    for (const auto& key : model::camera_form().root.keys) names.push_back(key.name);
    known.insert(known.end(), names.begin(), names.end());
    for (const auto& key : camera.keys) {
      const std::string first = key.text.substr(0, key.text.find('.'));
      if (std::find(known.begin(), known.end(), first) != known.end()) continue;
      const std::string near = base::did_you_mean(first, known);
      const std::string home = near.empty() ? meant_in_camera(key.text) : "";
      faults_.add(
          key.place,
          "unknown key " + in_quotes(key.text) + " in camera" +
              (home.empty() ? near : "; did you mean " + in_quotes("camera." + home) + "?"),
          "expected profile, mode, pose, keyframes, or a key of a camera profile that overrides its value: " + base::listed(names, "and"));
    }
  }

  void ambient(const Value& value, const Ambient& out) {
    const Value& spectrum = value["spectrum"];
    if (!value || !spectrum.good) return;
    const bool amount = value["level"] || value["illuminance"] || value["band_irradiance"];
    if (!amount && out.spectrum != Ambient::Spectrum::none)
      faults_.add(value.place(), "ambient does not say how much light",
                  "expected level: 5 %, illuminance: 5 klx, or band_irradiance: 0.4 W/m2");
    if (value.good && out.amount > 0 && out.spectrum == Ambient::Spectrum::none)
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

  /// −1 where the scene has none of that name.
  int index_of(const std::string& name, const Scene& scene) {
    if (index_.empty())
      for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (!scene.materials[i].name.empty()) index_.emplace(scene.materials[i].name, static_cast<int>(i));
    const auto found = index_.find(name);
    return found == index_.end() ? -1 : found->second;
  }

  int named_material(const Value& chosen, Scene& scene) {
    if (const int known = index_of(chosen.text, scene); known >= 0) return known;
    if (const assets::LibraryMaterial* known = assets::find_library_material(chosen.text)) {
      index_.emplace(chosen.text, static_cast<int>(scene.materials.size()));
      scene.materials.push_back(known->material);
    } else {
      refuse_name(chosen);
      scene.materials.emplace_back();
    }
    return static_cast<int>(scene.materials.size()) - 1;
  }

  /// What the scene says in place of a material of a mesh's file.
  const Material& material_in_place(const Value& chosen, const Scene& scene) {
    Material& out = of_files_.emplace_back();
    if (chosen.either != 0) {
      filler_.fill(chosen, out);
    } else if (const int index = index_of(chosen.text, scene); index >= 0) {
      out = scene.materials[static_cast<std::size_t>(index)];
    } else if (const assets::LibraryMaterial* known = assets::find_library_material(chosen.text)) {
      out = known->material;
    } else {
      refuse_name(chosen);
    }
    return out;
  }

  void refuse_name(const Value& chosen) {
    std::vector<std::string> names;
    for (const auto& [name, i] : index_) names.push_back(name);
    const bool none = names.empty(), many = names.size() > 20;
    std::vector<std::string> near = names;
    for (const assets::LibraryMaterial& one : assets::material_library()) near.push_back(one.material.name);
    faults_.add(chosen.place(), "no material " + in_quotes(chosen.text) + base::did_you_mean(chosen.text, near),
                (none   ? "the scene has no materials: section"
                 : many ? "expected one out of the scene's materials: section"
                        : "materials of this scene: " + base::listed(names, "and")) +
                    std::string("; `tofray list materials` names those that are built in; or write reflectivity: 0.5 instead"));
  }

  void object(const Value& entry, std::size_t number, Scene& scene) {
    const Value& value = entry.items[0];
    Object& out = scene.objects.emplace_back();
    out.key = "objects." + std::to_string(number), out.where = base::to_string(entry.place());
    out.material = material_of(value, scene);
    filler_.fill(value, out);
    const model::Slot shape = model::slot_of(out.shape);
    const auto& one = std::get<model::VariantSlot>(shape);
    const auto which = static_cast<std::size_t>(entry.alternative);
    one.emplace(one.at, which);
    filler_.fill(value, one.tables[which](), one.held(one.at));
    if (value["keyframes"].is_map()) keyframes_of_objects_.emplace_back(&value["keyframes"], scene.objects.size() - 1);
    if (const auto* triangle = std::get_if<Triangle>(&out.shape)) area(value, *triangle);
    if (std::holds_alternative<Mesh>(out.shape)) mesh(value, std::get<Mesh>(out.shape), scene);
  }

  void mesh(const Value& value, const Mesh& out, const Scene& scene) {
    const bool has_material = value["material"] || value["reflectivity"];
    MeshOfScene& one = meshes_of_scene_.emplace_back(MeshOfScene{scene.objects.size() - 1, &value, !has_material, nullptr});
    const Value& own = value["materials"];
    for (std::size_t i = 0; i < own.items.size(); ++i)
      if (own.items[i].good) one.own[own.names[i]] = &material_in_place(own.items[i], scene);
    if (!value["file"].good || assets::is_gltf(out.file)) return;
    const bool may_have_colors = assets::is_obj(out.file) || mesh::suffix_of(out.file) == ".ply";
    if (!has_material && mesh::suffix_of(out.file) == ".ply") meshes_.want_pictures(out.file);
    if (!has_material && assets::is_obj(out.file))
      meshes_.want_materials(out.file);
    else if (own)
      faults_.add(own.place(), "materials are those of glTF and OBJ files",
                  "PLY and STL files have none; expected reflectivity or material");
    else if (!has_material && !may_have_colors)
      faults_.add(value.place(), "mesh lacks a key", assets::lacks_material);
    if (out.time_s) faults_.add(value["time"].place(), "time is for glTF files", "an OBJ, PLY or STL file stands still");
    if (!out.animation.empty()) faults_.add(value["animation"].place(), "animation is for glTF files", "an OBJ, PLY or STL file has none");
    if (out.play != Mesh::Play::still)
      faults_.add(value["play"].place(), "play is for glTF files", "an OBJ, PLY or STL file has no animation");
  }

  /// Reads keyframes out of files, once all else that was read is good.
  void read_keyframes(const Value& root, Scene& scene) {
    const Value& of_camera = root["camera"]["keyframes"];
    if (of_camera.is_map() && faults_.empty()) {
      const Pose mount =
          of_camera["mount"] ? mount_of(of_camera["mount"], faults_) : Pose{{0, 0, 0}, {0, 0, 1}, {0, -1, 0}, optical_in(of_camera)};
      if (of_camera["mount"] && of_camera["axes"])
        faults_.add(of_camera["axes"].place(), "keyframes have axes and a mount",
                    "the mount says how the camera is turned; it may have axes");
      for (const TimedPose& one : timed_poses(of_camera, scene)) {
        using base::operator*, base::operator+;
        CameraKeyframe& key = scene.camera.keyframes.emplace_back();
        key.time_s = one.time_s;
        key.pose.position = one.position + base::matrix_of(one.quaternion) * mount.position;
        key.pose.quaternion = without_minus_zero(base::product(one.quaternion, *mount.quaternion));
      }
    }
    for (const auto& [value, object] : keyframes_of_objects_) {
      if (!faults_.empty()) return;
      for (const TimedPose& one : timed_poses(*value, scene)) {
        Keyframe& key = scene.objects[object].keyframes.emplace_back();
        key.time_s = one.time_s, key.position = one.position, key.rotation.quaternion = one.quaternion;
      }
    }
  }

  std::vector<TimedPose> timed_poses(const Value& map, Scene& scene) {
    const Value &name = map["file"], &zero = map["time_zero"];
    std::string path;
    const std::string text = files::read_reference(name.text, assets::folder_beside(source_), files_.root, name.place(), path);
    const std::string sha256 = files::sha256_hex(text);
    if (files_.expected) {
      const auto expected = files_.expected->find(name.text);
      if (expected == files_.expected->end() || expected->second != sha256)
        base::fail(name.place(), in_quotes(path, 200) + " does not hold the keyframes that it did",
                   "its SHA-256 is not the one that the manifest has; expected the same file in the same place");
    }
    TrajectoryTimes times{map["time_unit"].text, {}};
    if (zero) times.zero = stamp_of(zero.number);
    const auto same = [&](const SceneFile& file) { return file.file == name.text; };
    if (std::none_of(scene.files.begin(), scene.files.end(), same)) scene.files.push_back({name.text, sha256});
    return parse_trajectory(text, path, times, clock_, faults_);
  }

  /// Once all else that was read is good: a file may be long.
  void read_meshes(Scene& scene) {
    for (MeshOfScene& one : meshes_of_scene_) {
      Mesh& mesh = std::get<Mesh>(scene.objects[one.object].shape);
      if (faults_.empty()) {
        const auto place = [&](const char* key) {
          const Value& said = (*one.value)[key];
          return (said ? said : *one.value).place();
        };
        one.known = &meshes_.read({place("file"), place("time"), place("play"), place("animation"), scene.objects[one.object].key}, mesh,
                                  one.by_material);
        one.known->show(0, mesh);
        mesh.notices = one.known->notices;
        if (one.by_material && one.own.empty() && !one.known->lacks.empty())
          base::fail(one.value->place(), "mesh lacks a key",
                     std::string(assets::lacks_material) + "; " + in_quotes(mesh.file, 200) + " " + one.known->lacks);
      } else {
        mesh.triangles = std::make_shared<const TriangleMesh>();  // what is wrong is told already
      }
    }
  }

  /// Each name that the scene says of a file's materials has to be one of them.
  void name_own_materials() {
    constexpr std::size_t most_names = 20;
    for (const MeshOfScene& one : meshes_of_scene_) {
      if (one.own.empty()) continue;
      const Value& own = (*one.value)["materials"];
      const std::vector<std::string>& all = one.known->materials;
      const std::set<std::string> known(all.begin(), all.end());
      std::vector<std::string> told(known.begin(), std::next(known.begin(), std::min(known.size(), most_names)));
      if (known.size() > most_names) told.push_back(std::to_string(known.size() - most_names) + " more");
      for (std::size_t i = 0; i < own.names.size(); ++i)
        if (!known.contains(own.names[i]))
          faults_.add(
              own.key_places[i],
              in_quotes((*one.value)["file"].text) + " has no material " + in_quotes(own.names[i]) + base::did_you_mean(own.names[i], all),
              "its materials: " + base::listed(told, "and"));
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
    const std::vector<assets::MeshReader::Piece>& pieces = of.known->pieces;
    if (objects.size() + pieces.size() + behind > most)
      base::fail((*of.value)["file"].place(), "the scene has too many objects",
                 "at most " + std::to_string(most) +
                     " (`tofray --limits`); a file's materials without a reflectivity of the object's are one each",
                 ErrorKind::limit);
    const std::string& file = std::get<Mesh>(whole.shape).file;
    const std::string name = whole.name.empty() ? std::filesystem::path(file).stem().string() : whole.name;
    const std::size_t first = objects.size();
    std::vector<const assets::FileMaterial*> taken;  // out of the file
    int guessed = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      Object& one = objects.emplace_back(whole);
      const assets::FileMaterial& in_file = pieces[k].of;
      const auto own = of.own.find(in_file.name);
      one.name = name + "/" + in_file.name;
      of.known->show(k, std::get<Mesh>(one.shape), own == of.own.end());
      std::get<Mesh>(one.shape).notices.clear();
      if (k > 0) one.material = static_cast<int>(materials.size()), materials.emplace_back();
      materials[static_cast<std::size_t>(one.material)] = own != of.own.end() ? *own->second : in_file.material;
      if (own != of.own.end()) {
        materials[static_cast<std::size_t>(one.material)].normals = in_file.material.normals;  // its shape, not what it is made of
        materials[static_cast<std::size_t>(one.material)].opacity = in_file.material.opacity;
        continue;
      }
      taken.push_back(&in_file);
      guessed += in_file.from == assets::FileMaterial::From::visible_colour ? 1 : 0;
    }
    Mesh& told = std::get<Mesh>(objects[first].shape);
    told.guessed = guessed, told.notices = notices_of(taken);
    told.notices.insert(told.notices.end(), of.known->notices.begin(), of.known->notices.end());
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
  const std::string& source_;
  const assets::MeshFiles& files_;
  std::vector<std::pair<const Value*, std::size_t>> keyframes_of_objects_;  ///< out of files, and their objects
  std::optional<Stamp> clock_;                                              ///< where the times of such files begin
  std::map<std::string, int> index_;
  std::deque<Material> of_files_;  ///< what objects say in place of their files' materials
  assets::MeshReader meshes_;
  std::vector<MeshOfScene> meshes_of_scene_;
};

Scene interpret(const Node& root, const std::string& source, const assets::MeshFiles& meshes) {
  Faults faults;
  const Value value = read(model::scene_form(), root, faults);
  Scene out = SceneReader(source, meshes, faults).scene(value);
  faults.raise();
  return out;
}

}  // namespace

void apply(Node& root, const Settings& settings) {
  refuse_too_many(settings.size(), base::whole("--set"));
  for (const auto& [key, text] : settings) {
    const base::Place place = base::whole("--set " + key);
    set_key(root, key, parse_value(text, place), place, yaml::Maps::replace);
  }
}

Node scene_tree(std::string_view text, const std::string& source, const Settings& settings) {
  Node root = parse_tree(text, source);
  apply(root, settings);
  return root;
}

Scene scene_from_tree(const Node& root, const std::string& source, const assets::MeshFiles& meshes) {
  Scene scene = interpret(root, source, meshes);
  scene.source = source;
  std::string stem = std::filesystem::path(source).stem().string();
  if (stem.starts_with("<") && stem.ends_with(">")) stem = stem.substr(1, stem.size() - 2);  // of no file: <stdin>
  // The name becomes a folder's: "." and ".." are folders that have one.
  scene.name = stem.empty() || stem == "." || stem == ".." ? "scene" : stem;
  return scene;
}

Scene scene_from_text(const std::string& text, const std::string& source, const Settings& settings, const assets::MeshFiles& meshes) {
  return scene_from_tree(scene_tree(text, source, settings), source, meshes);
}

Scene load_scene(const std::string& file_or_name, const Settings& settings, const assets::MeshFiles& meshes) {
  if (const Builtin* builtin = find_builtin(builtin_scenes(), file_or_name)) {
    Scene scene = scene_from_text(std::string(builtin->text), "<" + builtin->name + ">", settings, meshes);
    scene.name = builtin->name;
    return scene;
  }
  return scene_from_text(read_named("scene", file_or_name, builtin_scenes()), file_or_name, settings, meshes);
}

}  // namespace tofray::load

namespace tofray {

Scene load_scene(const std::string& file_or_name, const std::string& root) { return load::load_scene(file_or_name, {}, {root, {}}); }

Scene load_scene_text(const std::string& text, const std::string& source, const std::string& root) {
  return load::scene_from_text(text, source, {}, {root, {}});
}

Material load_material(const std::string& name) {
  if (const assets::LibraryMaterial* known = assets::find_library_material(name)) return known->material;
  std::vector<std::string> names;
  for (const assets::LibraryMaterial& one : assets::material_library()) names.push_back(one.material.name);
  throw Error(ErrorKind::bad_input, "error: no material " + base::in_quotes(name) + base::did_you_mean(name, names) +
                                        "\n  `tofray list materials` names those that are built in");
}

}  // namespace tofray
