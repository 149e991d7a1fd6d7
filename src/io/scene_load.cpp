// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/ranges.h"
#include "base/text.h"
#include "io/builtin.h"
#include "io/convert.h"
#include "io/load.h"
#include "io/text_file.h"

namespace tofray::io {

namespace {

using base::Faults;
using base::in_quotes;

constexpr double shortest = base::range::shortest_m;

Vec3 difference(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec3 cross(const Vec3& a, const Vec3& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }
double length(const Vec3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

class SceneReader {
 public:
  explicit SceneReader(Faults& faults) : faults_(faults) {}

  Scene scene(const Value& root) {
    Scene out;
    camera(root["camera"], out.camera);
    if (root["ambient"]) ambient(root["ambient"], out.ambient);
    const Value& materials = root["materials"];
    for (std::size_t i = 0; i < materials.items.size(); ++i) {
      out.materials.push_back(material(materials.items[i]));
      out.materials.back().name = materials.names[i];
    }
    for (const auto& entry : root["objects"].items)
      if (entry.good && !entry.items.empty()) out.objects.push_back(object(entry, out));
    return out;
  }

 private:
  Vec3 direction(const Value& value, const char* what) {
    const Vec3 out = vector(value);
    if (value && value.good && length(out) < shortest)
      faults_.add(value.place(), std::string(what) + " has no length",
                  "got " + flow_text(*value.node) + ", expected a direction such as [0, 0, 1]");
    return out;
  }

  void camera(const Value& value, CameraChoice& out) {
    if (!value || value.node->kind != Node::Kind::map) return;
    if (value["profile"].good) out.profile = value["profile"].text;
    if (value["mode"].good) out.mode = value["mode"].text;
    if (value.node->find("profile") != nullptr) out.profile_where = base::to_string(value["profile"].place());
    if (value["mode"]) out.mode_where = base::to_string(value["mode"].place());
    if (value["pose"].good) pose(value["pose"], out.pose);
    overrides(*value.node, out);
  }

  void overrides(const Node& camera, CameraChoice& out) {
    std::vector<std::string> known = {"profile", "mode", "pose"};
    out.overrides = flattened(camera, known);
    refuse_too_many(out.overrides.size(), camera.place);
    std::vector<std::string> names;
    for (const auto& key : camera_form().root.keys) names.push_back(key.name);
    known.insert(known.end(), names.begin(), names.end());
    for (const auto& key : camera.keys) {
      const std::string first = key.text.substr(0, key.text.find('.'));
      if (std::find(known.begin(), known.end(), first) == known.end())
        faults_.add(key.place, "unknown key " + in_quotes(key.text) + " in camera" + base::did_you_mean(first, known),
                    "expected profile, mode, pose, or a key of a camera profile that overrides its value: " + base::listed(names, "and"));
    }
  }

  void pose(const Value& value, Pose& out) {
    out.position = vector(value["position"]);
    out.look_at = vector(value["look_at"]);
    out.up = direction(value["up"], "up");
    const Vec3 view = difference(out.look_at, out.position);
    const double view_length = length(view), up_length = length(out.up);
    if (view_length < shortest) {
      faults_.add(value.place_of("look_at"), "the camera looks at the point where it stands", "look_at has to differ from position");
    } else if (up_length >= shortest && length(cross(view, out.up)) < 1e-6 * view_length * up_length) {
      faults_.add(value.place_of("up"), "the camera's up is its direction of view",
                  "expected another direction, such as up: [0, -1, 0] or, for a view along y, up: [0, 0, 1]");
    }
  }

  void ambient(const Value& value, Ambient& out) {
    const Value& spectrum = value["spectrum"];
    if (!spectrum || !spectrum.good) return;
    if (spectrum.either == 1) {
      out.spectrum = Ambient::Spectrum::table;
      table(spectrum, "wavelength", "irradiance", faults_, out.table_wavelength_m, out.table_irradiance_w_per_m3);
    } else {
      out.spectrum = spectrum.text == "none"       ? Ambient::Spectrum::none
                     : spectrum.text == "sun_am15" ? Ambient::Spectrum::sun_am15
                                                   : Ambient::Spectrum::equal_energy;
    }
    bool amount = false;
    using enum Ambient::Quantity;
    for (const auto& [key, quantity] :
         {std::pair{"level", Ambient::Quantity::level}, {"illuminance", illuminance_lx}, {"band_irradiance", band_irradiance_w_per_m2}}) {
      if (!value[key]) continue;
      out.quantity = quantity;
      out.amount = value[key].number;
      amount = true;
    }
    if (!amount && out.spectrum != Ambient::Spectrum::none)
      faults_.add(value.place(), "ambient does not say how much light",
                  "expected level: 5 %, illuminance: 5 klx, or band_irradiance: 0.4 W/m2");
    if (out.amount > 0 && out.spectrum == Ambient::Spectrum::none)
      faults_.add(spectrum.place(), "ambient has an amount, but its spectrum is none",
                  "expected a spectrum such as sun_am15, or no amount");
    if (value["direction"]) out.direction = direction(value["direction"], "direction");
  }

  Material material(const Value& value) {
    Material out;
    if (!value.good) return out;
    out.brdf = value.text == "phong" ? Material::Brdf::phong : Material::Brdf::lambert;
    if (out.brdf == Material::Brdf::lambert) {
      out.diffuse = value["reflectivity"].number;
      return out;
    }
    out.diffuse = value["diffuse"].number;
    out.specular = value["specular"].number;
    out.exponent = value["exponent"].number;
    if (out.diffuse + out.specular > 1 + 1e-12)
      faults_.add(value.place(), "diffuse + specular is more than 1",
                  "got " + base::number_text(out.diffuse) + " + " + base::number_text(out.specular) +
                      "; a surface cannot send back more light than it gets");
    return out;
  }

  int material_of(const Value& object, Scene& scene) {
    const Value& chosen = object["material"];
    if (chosen && chosen.either == 0) return named_material(chosen, scene);
    Material one;
    if (chosen)
      one = material(chosen);
    else
      one.diffuse = object["reflectivity"].number;
    scene.materials.push_back(one);
    return static_cast<int>(scene.materials.size()) - 1;
  }

  int named_material(const Value& chosen, const Scene& scene) {
    if (index_.empty())
      for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (!scene.materials[i].name.empty()) index_.emplace(scene.materials[i].name, static_cast<int>(i));
    const auto found = index_.find(chosen.text);
    if (found != index_.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [name, i] : index_) names.push_back(name);
    const bool many = names.size() > 20;
    faults_.add(chosen.place(), "no material " + in_quotes(chosen.text) + base::did_you_mean(chosen.text, names),
                names.empty()
                    ? "expected a name out of the scene's materials: section, which is missing; or write reflectivity: 0.5 instead"
                : many ? "expected one out of the scene's materials: section"
                       : "materials of this scene: " + base::listed(names, "and"));
    return 0;
  }

  Object object(const Value& entry, Scene& scene) {
    const Value& value = entry.items[0];
    Object out;
    if (value["name"]) out.name = value["name"].text;
    out.material = material_of(value, scene);
    out.position = vector(value["position"]);
    out.velocity_m_per_s = vector(value["velocity"]);
    if (value["rotation"]) {
      out.rotation.axis = direction(value["rotation"]["axis"], "axis");
      out.rotation.angle_rad = value["rotation"]["angle"].number;
    }
    if (entry.text == "plane") out.shape = Plane{vector(value["point"]), direction(value["normal"], "normal")};
    if (entry.text == "sphere") out.shape = Sphere{vector(value["center"]), value["radius"].number};
    if (entry.text == "box") out.shape = box(value);
    if (entry.text == "triangle") out.shape = triangle(value);
    return out;
  }

  Box box(const Value& value) {
    const Box out{vector(value["min"]), vector(value["max"])};
    for (std::size_t k = 0; k < 3; ++k)
      if (!(out.max[k] - out.min[k] >= shortest))
        faults_.add(value["min"].items[k].place(), std::string("the box's min is not below its max in ") + "xyz"[k],
                    "got " + base::number_text(out.min[k]) + " m and " + base::number_text(out.max[k]) +
                        " m, expected a thickness of at least 1 um");
    return out;
  }

  Triangle triangle(const Value& value) {
    Triangle out;
    for (std::size_t k = 0; k < 3; ++k) out.vertices[k] = vector(value["vertices"].items[k]);
    const Vec3 a = difference(out.vertices[1], out.vertices[0]), b = difference(out.vertices[2], out.vertices[0]);
    const double longest = std::max({length(a), length(b), length(difference(a, b))});
    // Height over the longest side; the second bound is what rounding of the coordinates leaves of three points on a line.
    const double height = longest > 0 ? length(cross(a, b)) / longest : 0;
    if (!(height >= shortest && height >= 1e-9 * longest))
      faults_.add(value["vertices"].place(), "the triangle has no area",
                  "its three corners lie on a line or in one point; expected a height of at least 1 um");
    return out;
  }

  Faults& faults_;
  std::map<std::string, int> index_;
};

Scene interpret(const Node& root) {
  Faults faults;
  const Value value = read(scene_form(), root, faults);
  Scene out = SceneReader(faults).scene(value);
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

Scene scene_from_text(const std::string& text, const std::string& source, const Settings& settings) {
  Node root = parse_tree(text, source);
  apply(root, settings);
  Scene scene = interpret(root);
  scene.source = source;
  const std::string stem = std::filesystem::path(source).stem().string();
  // The name becomes a folder's: "." and ".." are folders that have one.
  scene.name = stem.empty() || stem == "." || stem == ".." ? "scene" : stem;
  return scene;
}

Scene load_scene(const std::string& file_or_name, const Settings& settings) {
  if (const Builtin* builtin = find_builtin(builtin_scenes(), file_or_name)) {
    Scene scene = scene_from_text(std::string(builtin->text), "<" + builtin->name + ">", settings);
    scene.name = builtin->name;
    return scene;
  }
  return scene_from_text(read_named("scene", file_or_name, builtin_scenes()), file_or_name, settings);
}

}  // namespace tofray::io

namespace tofray {

Scene load_scene(const std::string& file_or_name) { return io::load_scene(file_or_name, {}); }

}  // namespace tofray
