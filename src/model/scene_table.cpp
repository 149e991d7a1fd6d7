// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/constants.h"
#include "base/limits.h"
#include "model/rules.h"
#include "model/tables.h"

/// What a scene file may say. Ranges are those of a scene that a camera of some centimetres could look at, with room to spare.
namespace tofray::model {

namespace {

using enum base::Dimension;

constexpr auto most_objects = static_cast<int>(base::limit::objects.value);
constexpr auto most_materials = static_cast<int>(base::limit::materials.value);

}  // namespace

template <>
const Table& table_of<Material>() {
  using enum Material::Brdf;
  constexpr auto brdf = &Material::brdf;
  static const Table rows =
      table<Material>(
          words<&Material::name>("", "", "", ""),  // the key of the file's `materials`
          kind<brdf>("brdf", {"lambert", "phong", "oren_nayar", "ggx", "retro"}),
          number<&Material::diffuse>("reflectivity", {fraction, share, "0.85"},
                                     "reflectivity: share of the light that is reflected, all of it diffusely")
              .when<brdf>(lambert, oren_nayar)
              .required(),
          also(number<&Material::diffuse>("diffuse", {fraction, share, "0.4"}, "k_d, the Lambertian share").when<brdf>(phong).required()),
          also(number<&Material::diffuse>("diffuse", {fraction, share, "0.4"}, "k_d, the diffuse share below the microfacets; 0: a metal")
                   .when<brdf>(ggx)),
          also(number<&Material::diffuse>("diffuse", {fraction, share, "0.05"}, "k_d, the Lambertian share").when<brdf>(retro)),
          number<&Material::specular>("specular", {fraction, share, "0.3"},
                                      "k_s, the share of the lobe about the mirror direction; diffuse + specular may not exceed 1")
              .when<brdf>(phong)
              .required(),
          also(number<&Material::specular>("specular", {fraction, share, "0.04"},
                                           "F_0, reflectance of a microfacet at normal incidence: 0.04 for plastic, 0.9 for aluminium")
                   .when<brdf>(ggx)
                   .required()),
          number<&Material::exponent>("exponent", {none, phong_exponent, "20"}, "exponent n of the lobe's cos^n: the larger, the shinier")
              .when<brdf>(phong)
              .required(),
          number<&Material::roughness_rad>("roughness", {angle, {0, 0.5 * base::pi}, "20 deg"},
                                           "spread (1 sigma) of the slopes of the surface's facets; 0: Lambert")
              .when<brdf>(oren_nayar)
              .required(),
          number<&Material::alpha>("alpha", {none, {1e-3, 1}, "0.3"}, "spread of the microfacets' slopes: glTF's roughness squared")
              .when<brdf>(ggx)
              .required(),
          number<&Material::retro>("retro", {fraction, share, "0.2"},
                                   "k_r, the share that goes back toward the light; diffuse + retro may not exceed 1")
              .when<brdf>(retro)
              .required(),
          number<&Material::spread_rad>("spread", {angle, {1e-3, 0.25 * base::pi}, "0.5 deg"},
                                        "angle between light and camera at which half of the peak is left")
              .when<brdf>(retro)
              .required(),
          no_row<&Material::map>("a picture out of a mesh's file"), no_row<&Material::normals>("a picture out of a mesh's file"),
          no_row<&Material::finish>("a picture out of a mesh's file"), no_row<&Material::opacity>("a picture out of a mesh's file"))
          .check_with(materials_send_back_no_more_than_they_get)
          .kind_may_be_missing();
  return rows;
}

namespace {

/// Rotations as other software writes them: the reader makes quaternions of them.
std::vector<Key> matrix_and_euler(int columns, const char* matrix) {
  const ValueForm entry = form_of(component), turn = form_of(Number{angle, {-100, 100}, "30 deg"});
  std::vector<Key> angles;
  for (const auto& [name, doc] : {std::pair{"roll", "rotation about the fixed axis x, as rpy in URDF"},
                                  {"pitch", "rotation about the fixed axis y, after roll"},
                                  {"yaw", "rotation about the fixed axis z, after pitch"}}) {
    angles.push_back(absent(name, turn, doc));
    angles.back().fallback = "0 deg";
  }
  return {absent("matrix", list(list(entry, 3, columns), 3, columns), matrix),
          absent("euler", map(std::move(angles)), "rotations about the fixed axes x, y and z, one after the other, as rpy in URDF")};
}

std::vector<Key> axes_of_cameras() {
  std::vector<Key> keys{
      absent("axes", choice({"optical", "body", "opengl"}),
             "axes of the frame that quaternion, matrix and euler rotate: optical: x right, y down, z forward; body (ROS): "
             "x forward, y left, z up; opengl (Blender): x right, y up, z backward")};
  keys.back().fallback = "optical";
  return keys;
}

/// Poses at times out of a file.
ValueForm keyframe_file(std::vector<Key> more) {
  std::vector<Key> keys{required("file", text("a file", "poses.csv"),
                                 "file with a pose per line, t x y z qx qy qz qw or as its header says, beside the scene or below"),
                        absent("time_unit", choice({"s", "ms", "us", "ns"}), "unit of the file's times; as its header says, else s"),
                        absent("time_zero", form_of(Number{time, {-1e12, 1e12}, "0 s"}),
                               "the file's time at which the scene's is 0; 0 s, but where its times are of a clock (beyond 1e6 s) the "
                               "first one of the scene's first such file, the camera's before those of objects")};
  for (Key& key : more) keys.push_back(std::move(key));
  return map(std::move(keys));
}

}  // namespace

template <>
const Table& table_of<Rotation>() {
  static const Table rows =
      table<Rotation>(
          number<&Rotation::axis>("axis", component, "axis of the rotation, by the right-hand rule, of any length but zero").absent(),
          number<&Rotation::angle_rad>("angle", {angle, {-100, 100}, "30 deg"}, "angle of the rotation about axis").absent(),
          number<&Rotation::quaternion>("quaternion", component, "unit quaternion x, y, z, w").absent().in_place_of({"axis", "angle_rad"}))
          .and_keys(matrix_and_euler(3, "three rows of three numbers, whose columns are the images of x, y and z"))
          .with_exactly_one({"axis", "quaternion", "matrix", "euler"})
          .with_meant({{"orientation", "quaternion"}, {"rpy", "euler"}})
          .check_with(turns_have_an_axis);
  return rows;
}

namespace {
constexpr Number moment{time, {-1e6, 1e6}, "0.5 s"};
constexpr auto most_keyframes = static_cast<int>(base::limit::keyframes.value);
}  // namespace

template <>
const Table& table_of<Keyframe>() {
  static const Table rows =
      table<Keyframe>(number<&Keyframe::time_s>("time", moment, "time of the keyframe; frame i starts at i / frame rate").required(),
                      number<&Keyframe::position>("position", coordinate, "shift of the object [m]"),
                      record<&Keyframe::rotation>("rotation", "rotation about the object's own centre"));
  return rows;
}

template <>
const Table& table_of<Object>() {
  static const Table rows =
      table<Object>(
          words<&Object::name>("name", "a name", "ball", "name of the object in listings").absent(),
          // the key of the file's entry
          one_of<&Object::shape>(names_of_shapes()),
          number<&Object::material>("", {none, {0, 2.0 * most_objects}, "0"}, ""),  // a name, or a material of its own
          number<&Object::position>("position", coordinate, "shift of the object [m]"),
          record<&Object::rotation>("rotation", "rotation about the object's own centre (of a plane: about its point)"),
          number<&Object::velocity_m_per_s>("velocity", {speed, {-1e4, 1e4}, "1 m/s", true}, "velocity of the object [m/s]"),
          number<&Object::angular_velocity_rad_per_s>("angular_velocity", {angular_speed, {-1e4, 1e4}, "90 deg/s"},
                                                      "angular velocity about the object's own centre: axis times rate"),
          records<&Object::keyframes>("keyframes", 0, most_keyframes,
                                      "poses at times, in place of `position`, `rotation` and both velocities; motion between two is even")
              .or_else(keyframe_file({})),
          words<&Object::class_name>("class", "a name", "chair", "class of the object, for gt_class_id; see the scene's `classes`")
              .in_meta_if_set(),
          no_row<&Object::key, &Object::where>("where the file says it"))
          .check_with(objects_move_one_way);
  return rows;
}

template <>
const Table& table_of<Ambient>() {
  using enum Ambient::Quantity;
  constexpr auto quantity = &Ambient::quantity;
  static const Table rows =
      table<Ambient>(
          choice<&Ambient::spectrum>("spectrum", {"none", "sun_am15", "equal_energy", "table"},
                                     "spectrum of the light: a built-in name, or a table; sun_am15 unless given")
              .absent(),
          curve_of_two<&Ambient::table_wavelength_m, &Ambient::table_irradiance_w_per_m3>(
              "spectrum", {"wavelength", {length, {100e-9, 20e-6}, "850 nm"}},
              {"irradiance", {spectral_irradiance, {0, 1e13}, "0.9 W/(m2 nm)"}}, "spectral irradiance on the surfaces")
              .when<&Ambient::spectrum>(Ambient::Spectrum::table),
          choice<quantity>("", {"level", "illuminance_lx", "band_irradiance_w_per_m2"}, ""),  // the key of the amount says it
          number<&Ambient::amount>("level", {fraction, {0, 100}, "5 %"}, "share of the tabulated spectrum (sun_am15: of full sun)")
              .when<quantity>(level)
              .absent(),
          also(number<&Ambient::amount>("illuminance", {illuminance, {0, 1e7}, "5 klx"},
                                        "illuminance of the surfaces, as a light meter reads it")
                   .when<quantity>(illuminance_lx)
                   .absent()),
          also(number<&Ambient::amount>("band_irradiance", {irradiance, {0, 1e5}, "0.4 W/m2"},
                                        "irradiance of the surfaces within the camera's filter")
                   .when<quantity>(band_irradiance_w_per_m2)
                   .absent()),
          number<&Ambient::direction>("direction", component,
                                      "direction in which the light travels (a sun with shadows); uniform from everywhere unless given")
              .direction()
              .absent())
          .complete_with(light_is_the_suns);
  return rows;
}

template <>
const Table& table_of<Pose>() {
  static const Table rows = [] {
    std::vector<Key> more = matrix_and_euler(
        4, "matrix from the camera's frame to the world's, by rows: 3 x 3, or 3 x 4 or 4 x 4 with the position in the last column [m]");
    for (Key& key : axes_of_cameras()) more.push_back(std::move(key));
    return table<Pose>(
               number<&Pose::position>("position", coordinate, "position of the entrance pupil [m]"),
               number<&Pose::look_at>("look_at", coordinate, "a point on the optical axis; [1, 0, 0] where `world_up` is z [m]"),
               number<&Pose::up>("up", component, "world direction that is up in the image; that of `world_up` unless given").direction(),
               number<&Pose::quaternion>("quaternion", component, "unit quaternion x, y, z, w from the camera's frame to the world's")
                   .absent()
                   .in_place_of({"look_at", "up"}))
        .and_keys(std::move(more))
        .with_at_most_one({"look_at", "quaternion", "matrix", "euler"})
        .with_meant({{"frame", "axes"},
                     {"convention", "axes"},
                     {"orientation", "quaternion"},
                     {"rotation", "quaternion"},
                     {"rpy", "euler"},
                     {"translation", "position"},
                     {"transform", "matrix"}})
        .check_with(poses_look_somewhere);
  }();
  return rows;
}

namespace {
/// Where a camera is on what carries it.
ValueForm mount_form() {
  ValueForm form = form_of(table_of<Pose>());
  std::erase_if(form.keys, [](const Key& key) { return key.name == "look_at" || key.name == "up"; });
  std::erase(form.at_most_one, "look_at");
  for (Key& key : form.keys) {
    if (key.name == "position") key.doc = "position of the entrance pupil in the robot's frame [m]";
    if (key.name == "quaternion") key.doc = "unit quaternion x, y, z, w from the camera's frame to the robot's";
    if (key.name == "matrix") key.doc = "matrix from the camera's frame to the robot's, by rows, as at `pose`";
    key.member.clear();
  }
  return form;
}
}  // namespace

template <>
const Table& table_of<CameraKeyframe>() {
  static const Table rows = table<CameraKeyframe>(
      number<&CameraKeyframe::time_s>("time", moment, "time of the keyframe; frame i starts at i / frame rate").required(),
      record<&CameraKeyframe::pose>("pose", "pose of the camera at that time"));
  return rows;
}

template <>
const Table& table_of<CameraChoice>() {
  static const Table rows =
      table<CameraChoice>(
          words<&CameraChoice::profile>("profile", "a camera or a file", "pico-flexx",
                                        "a built-in camera (`tofray list cameras`), or a profile's file beside the scene or below"),
          words<&CameraChoice::mode>("mode", "a mode of the camera", "MODE_9_5FPS_2000",
                                     "one of the profile's modes; its first unless given")
              .absent(),
          record<&CameraChoice::pose>("pose", "pose of the camera; the world's frame is the camera's unless given"),
          records<&CameraChoice::keyframes>("keyframes", 0, most_keyframes,
                                            "poses of the camera at times, in place of `pose`; motion between two is even")
              .or_else(keyframe_file([] {
                std::vector<Key> more = axes_of_cameras();
                more[0].doc = "axes of the frame that the file's poses move: as at `pose`";
                more.push_back(absent("mount", mount_form(),
                                      "pose of the camera on what the file's poses move (its frame to the robot's), if they differ"));
                return more;
              }())),
          no_row<&CameraChoice::overrides>("keys of the profile among the section's own"),
          no_row<&CameraChoice::profile_where, &CameraChoice::mode_where>("where the file says them"))
          .check_with(cameras_move_one_way);
  return rows;
}

template <>
const Table& table_of<TransientBins>() {
  static const Table rows =
      table<TransientBins>(number<&TransientBins::bins>("bins", {none, {0, 1e6}, "2000"}, "number of bins; 0: no histograms").required(),
                           number<&TransientBins::first_m>("first", {length, {0, 1e6}, "2 m"},
                                                           "path length at which the first bin begins, all the way from light to camera"),
                           number<&TransientBins::width_m>("width", {length, {1e-6, 1e6}, "1 mm"}, "width of a bin in path length"));
  return rows;
}

template <>
const Table& table_of<Transport>() {
  static const Table rows =
      table<Transport>(
          number<&Transport::bounces>("bounces", {none, {0, 64}, "4"},
                                      "maximum number of bounces: surfaces that light meets beyond the first one"),
          number<&Transport::samples>("samples", {none, {1, 65536}, "16"},
                                      "light paths per pixel (Monte Carlo samples), where bounces is not 0; the first ones of max_samples"),
          number<&Transport::seed>("seed", {none, {0, 9007199254740991.0}, "0"},
                                   "seed of the light paths: another one draws other paths of the same light"),
          number<&Transport::max_samples>(
              "max_samples", {none, {0, 65536}, "1024"},
              "most light paths per pixel: their number is doubled, pixel by pixel, until path_noise is reached; 0: samples"),
          number<&Transport::path_noise_m>(
              "path_noise", {length, {0, 100}, "2 mm"},
              "standard error of the half path at which a pixel has enough paths; 0: a fifth of its depth noise"),
          flag<&Transport::smooth>("smooth", "whether light that bounces is smoothed over neighbours that see the same surface"),
          record<&Transport::transient>("transient", "histograms of light by path length for each pixel; none unless given"))
          .check_with(paths_have_an_aim);
  return rows;
}

template <>
const Table& table_of<Scene>() {
  static const Table rows =
      table<Scene>(
          words<&Scene::name>("", "", "", ""),  // the file's
          no_row<&Scene::source>("a file's place is no part of what it says"),
          choice<&Scene::world_up>("world_up", {"-y", "y", "z"},
                                   "the world's axis that is up: it decides where a camera looks and what is up in its image unless its "
                                   "pose says so, and how meshes are turned; z in the worlds of ROS and Blender")
              .in_meta_if_set(),
          record<&Scene::camera>("camera", "which camera, where it stands, and what to change in its profile").not_in_meta(),
          record<&Scene::ambient>("ambient", "ambient light; none unless given").since(Stage::power),
          record<&Scene::transport>("transport", "multipath: light that bounces from surface to surface; none unless given")
              .since(Stage::power),
          records<&Scene::materials>("", 0, most_materials + most_objects, ""),  // by name, and those of objects
          records<&Scene::objects>("", 0, most_objects, ""), no_row<&Scene::files>("what the reader met"),
          no_row<&Scene::classes>("a list of words: the reader's"))
          .check_with(objects_fit_their_scene);
  return rows;
}

namespace {

/// An entry has one of the shapes' names, and under it the shape's keys and the object's.
ValueForm objects_form() {
  const Table& object = table_of<Object>();
  const Row& shape =
      *std::find_if(object.rows.begin(), object.rows.end(), [](const Row& row) { return row.form.kind == ValueForm::Kind::variant; });
  ValueForm form = shape.form;
  const Slot shapes = slot_of(shape, object.fresh);
  for (const auto& table : std::get<VariantSlot>(shapes).tables) {
    ValueForm one = form_of(table());
    one.keys.push_back(
        absent("reflectivity", form_of(Number{fraction, share, "0.5"}), "reflectivity of a Lambertian surface, in place of `material`"));
    one.keys.push_back(absent("material", either({text("the name of a material", "paper"), form_of(table_of<Material>())}),
                              "a name out of `materials` or of `tofray list materials`, or a material written here"));
    if (table == &table_of<Mesh>)
      one.keys.push_back(absent("materials", dictionary(one.keys.back().form, 1, most_materials),
                                "materials in place of those of the glTF or OBJ file, by their names there"));
    for (Key& key : keys_of(object)) one.keys.push_back(std::move(key));
    // A glTF file has materials of its own; the reader asks for one where a file has none.
    if (table == &table_of<Mesh>)
      one.at_most_one = {"reflectivity", "material", "materials"};
    else
      one.exactly_one = {"reflectivity", "material"};
    form.forms.push_back(std::move(one));
  }
  return list(std::move(form), 0, most_objects);
}

std::string plural(const std::string& name) { return name + (name.ends_with("x") || name.ends_with("h") ? "es" : "s"); }

/// Keys that the scene has not, and what they mean.
std::vector<std::pair<std::string, std::string>> words_that_people_try() {
  std::vector<std::pair<std::string, std::string>> words = {{"lights", "camera.illumination"},
                                                            {"light", "camera.illumination"},
                                                            {"light_sources", "camera.illumination"},
                                                            {"lamps", "camera.illumination"},
                                                            {"sun", "ambient"},
                                                            {"sunlight", "ambient"},
                                                            {"ambient_light", "ambient"},
                                                            {"shapes", "objects"},
                                                            {"geometry", "objects"},
                                                            {"profile", "camera.profile"},
                                                            {"pose", "camera.pose"},
                                                            {"keyframes", "camera.keyframes"},
                                                            {"up_axis", "world_up"},
                                                            {"z_up", "world_up: z"},
                                                            {"seed", "--seed"}};
  for (const std::string& shape : names_of_shapes()) words.emplace_back(plural(shape), "objects");
  for (const auto& [word, path] : camera_form().root.meant) words.emplace_back(word, "camera." + path);
  // What a camera's profile has may be meant for the scene's camera.
  for (const Key& key : camera_form().root.keys) words.emplace_back(key.name, "camera." + key.name);
  return words;
}

}  // namespace

const FileForm& scene_form() {
  static const FileForm form = [] {
    FileForm file{"scene", "tofray scene: objects, materials, ambient light, and where the camera stands", form_of(table_of<Scene>()),
                  false};
    file.root.keys[1].form.open = true;  // the profile's own keys may follow and override it
    file.root.keys.push_back(absent("materials", dictionary(form_of(table_of<Material>()), 0, most_materials),
                                    "materials by name, at the illumination wavelength"));
    file.root.keys.push_back(required("objects", objects_form(), "what the camera looks at"));
    file.root.keys.push_back(absent("classes", list(text("a name", "chair"), 1, most_objects),
                                    "classes of objects in the order in which gt_class_id counts them; unless given, those of the objects "
                                    "in alphabetical order"));
    file.root.meant = words_that_people_try();
    return file;
  }();
  return form;
}

}  // namespace tofray::model
