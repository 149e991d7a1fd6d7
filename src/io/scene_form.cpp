// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/limits.h"
#include "base/ranges.h"
#include "io/form.h"

/// The tables of a scene file. Bounds are those of a scene that a camera of some centimetres could look at, with room to spare.
namespace tofray::io {

namespace {

using enum base::Dimension;

namespace range = base::range;

Form coordinate() { return bare_number(length, range::coordinate_m, "0.5 m"); }
Form point() { return list(coordinate(), 3, 3); }
Form direction() { return list(number(none, range::component, "1"), 3, 3); }
Form part(const std::string& example) { return number(fraction, range::share, example); }

std::vector<Key> lambert_keys() {
  return {required("reflectivity", part("0.85"), "share of the light that comes back, all of it diffuse")};
}

std::vector<Key> phong_keys() {
  return {required("diffuse", part("0.4"), "k_d, the Lambertian share"),
          required("specular", part("0.3"), "k_s, the share of the lobe about the mirror direction; diffuse + specular may not exceed 1"),
          required("exponent", number(none, range::phong_exponent, "20"), "n of the lobe's cos^n: the larger, the shinier")};
}

Form material() { return tagged("brdf", {{"lambert", lambert_keys()}, {"phong", phong_keys()}}, "lambert"); }

// What every object has besides its shape.
Form object(std::vector<Key> shape) {
  shape.push_back(absent("reflectivity", part("0.5"), "of a Lambertian surface, in place of `material`"));
  shape.push_back(absent("material", either({text("the name of a material", "paper"), material()}),
                         "a name out of `materials`, or a material written here"));
  shape.push_back(absent("name", text("a name", "ball"), "how listings call the object"));
  shape.push_back(optional("position", point(), "[0, 0, 0]", "a shift [m]"));
  shape.push_back(absent("rotation",
                         map({required("axis", direction(), "the axis, by the right-hand rule; any length but zero"),
                              required("angle", number(angle, range::rotation_rad, "30 deg"), "how far")}),
                         "a turn about the object's own centre (of a plane: about its point)"));
  shape.push_back(optional("velocity", list(bare_number(speed, range::velocity_m_per_s, "1 m/s"), 3, 3), "[0, 0, 0]", "[m/s]"));
  Form form = map(std::move(shape));
  form.exactly_one = {"reflectivity", "material"};
  return form;
}

Form objects() {
  Form form;
  form.kind = Form::Kind::variant;
  form.names = {"plane", "sphere", "box", "triangle"};
  form.forms.push_back(object({required("point", point(), "a point of the plane [m]"),
                               optional("normal", direction(), "[0, 0, -1]", "any length but zero; both sides reflect")}));
  form.forms.push_back(
      object({required("center", point(), "[m]"), required("radius", bare_number(length, range::radius_m, "25 cm"), "[m]")}));
  form.forms.push_back(object({required("min", point(), "the corner of the smallest x, y and z, before the rotation [m]"),
                               required("max", point(), "the opposite corner [m]")}));
  form.forms.push_back(object({required("vertices", list(point(), 3, 3), "the three corners [m]")}));
  form.refused = {{"mesh", "meshes are not supported in this version"}};
  return list(std::move(form), 0, static_cast<int>(base::limit::objects.value));
}

Form camera() {
  Form pose = map({optional("position", point(), "[0, 0, 0]", "of the entrance pupil [m]"),
                   optional("look_at", point(), "[0, 0, 1]", "a point on the optical axis [m]"),
                   optional("up", direction(), "[0, -1, 0]", "the world's direction that is up in the image")});
  Form form = map({optional("profile", text("a camera or a file", "pico-flexx"), "pico-flexx",
                            "a built-in camera (`tofray list cameras`), or a profile's file beside the scene or below"),
                   absent("mode", text("a mode of the camera", "MODE_9_5FPS_2000"), "one of the profile's modes; its first unless given"),
                   optional("pose", std::move(pose), "{}", "where the camera stands; the world is the camera's frame unless given")});
  form.open = true;  // the profile's own keys may follow and override it
  return form;
}

Form ambient() {
  const auto count = static_cast<int>(base::limit::curve_points.value);
  Form spectrum = either({choice({"sun_am15", "equal_energy", "none"}),
                          map({required("wavelength", list(number(length, range::wavelength_m, "850 nm"), 2, count), "ascending"),
                               required("irradiance", list(number(spectral_irradiance, range::spectral_irradiance_w_per_m3, "0.9 W/(m2 nm)"), 2, count),
                                        "on the surfaces, one for each wavelength")})});
  Form form = map({optional("spectrum", std::move(spectrum), "sun_am15", "the light's spectrum: a built-in name, or a table"),
                   absent("level", number(fraction, range::ambient_level, "5 %"), "share of the spectrum as it is tabulated (sun_am15: of full sun)"),
                   absent("illuminance", number(illuminance, range::illuminance_lx, "5 klx"), "on the surfaces, as a light meter reads it"),
                   absent("band_irradiance", number(irradiance, range::band_irradiance_w_per_m2, "0.4 W/m2"), "on the surfaces, within the camera's filter"),
                   absent("direction", direction(), "in which the light travels (a sun with shadows); from everywhere unless given")});
  form.at_most_one = {"level", "illuminance", "band_irradiance"};
  return form;
}

FileForm make() {
  FileForm file;
  file.kind = "scene";
  file.title = "tofray scene: objects, materials, ambient light, and where the camera stands";
  file.root = map({optional("camera", camera(), "{}", "which camera, where it stands, and what to change in its profile"),
                   absent("ambient", ambient(), "light that is not the camera's own; none unless given"),
                   absent("materials", dictionary(material(), 0, static_cast<int>(base::limit::materials.value)),
                          "materials by name, at the illumination wavelength"),
                   required("objects", objects(), "what the camera looks at")});
  file.root.meant = {{"lights", "camera.illumination"},
                     {"light", "camera.illumination"},
                     {"light_sources", "camera.illumination"},
                     {"lamps", "camera.illumination"},
                     {"sun", "ambient"},
                     {"sunlight", "ambient"},
                     {"ambient_light", "ambient"},
                     {"shapes", "objects"},
                     {"geometry", "objects"},
                     {"spheres", "objects"},
                     {"planes", "objects"},
                     {"boxes", "objects"},
                     {"triangles", "objects"},
                     {"meshes", "objects"},
                     {"profile", "camera.profile"},
                     {"pose", "camera.pose"}};
  // What a camera's profile has may be meant for the scene's camera.
  for (const Key& key : camera_form().root.keys) file.root.meant.emplace_back(key.name, "camera." + key.name);
  return file;
}

}  // namespace

const FileForm& scene_form() {
  static const FileForm form = make();
  return form;
}

}  // namespace tofray::io
