// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/frozen_scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/range.h"
#include "base/text.h"
#include "scene/derive.h"
#include "tofray/error.h"

namespace tofray::scene {

using namespace base;

namespace {

/// Puts an object's shape into the list of its kind, which is the one in the same place as in the public variant.
/// @param body  makes it: body(shape::List<kind>, what the object says of it)
template <class... T, class... Said, class Make>
void add_body(shape::List<T...>, const std::variant<Said...>& shape, BodyLists& to, const Make& body) {
  static_assert(sizeof...(T) == sizeof...(Said), "each shape of the public variant has its place in shape::Shapes");
  const auto add = [&]<class One, class From>(const From* said, shape::List<One> which) {
    if (said != nullptr) to.of<One>().bodies.push_back(body(which, *said));
  };
  (add(std::get_if<Said>(&shape), shape::List<T>{}), ...);
}

/// Numbers the facets of a group.
template <class... T>
void number(shape::List<T...>, BodyLists& from, Group& to) {
  const auto one = [&]<class One>(shape::List<One>) {
    auto& bodies = from.of<One>().bodies;
    for (Body<One>& body : bodies) body.facet = to.facet_count, to.facet_count += One::facets;
    to.bodies.of<One>() = {bodies.data(), static_cast<std::int32_t>(bodies.size()), 0};
    to.body_count += to.bodies.of<One>().count;
  };
  (one(shape::List<T>{}), ...);
}

/// The frame in which what a motion moves is seen: x → axes·(turn·x + shift − position) = axes·turn·(x − turnᵀ·(position − shift)).
shape::CoordinateFrame frame_of(const CameraFrame& camera, const Motion& motion, bool turns) {
  const shape::Mat axes{{vec(camera.rotation[0]), vec(camera.rotation[1]), vec(camera.rotation[2])}};
  const Vec from = vec(camera.position) - motion.shift;
  if (!turns) return {axes, from};
  return {product(axes, motion.turn), back(motion.turn, from)};
}

/// The mesh with the vertices and normals that it has at a time.
TriangleMesh shape_at(const TriangleMesh& mesh, const MeshMotion& motion, double time_s) {
  TriangleMesh out;
  out.triangles = mesh.triangles;
  motion.at(time_s, out.vertices, out.normals);
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::bad_input,
                "error: at " + number_text(time_s) + " s " + what + "\n  its MeshMotion has to give what the mesh has");
  };
  if (out.vertices.size() != mesh.vertices.size() || out.normals.size() != mesh.normals.size())
    refuse("a mesh has " + std::to_string(out.vertices.size()) + " vertices and " + std::to_string(out.normals.size()) +
           " normals in place of " + std::to_string(mesh.vertices.size()) + " and " + std::to_string(mesh.normals.size()));
  for (const auto& triangle : out.triangles)
    for (const std::int32_t corner : triangle)
      for (const float x : out.vertices[static_cast<std::size_t>(corner)])
        if (!(std::abs(x) <= farthest_m)) refuse("a mesh has a corner beyond the world");
  for (const auto& normal : out.normals)
    for (const float x : normal)
      if (!(std::abs(x) <= 2.0F)) refuse("a mesh has a normal that is none");
  return out;
}

double farthest(const std::vector<shape::Vec>& points) {
  double out = 0;
  for (const shape::Vec& point : points) out = std::fmax(out, shape::length(point));
  return out;
}
/// The largest coordinate of any mesh in its own frame.
double largest_mesh(const Group& group, int moments) {
  const BodiesOf<shape::Mesh>& meshes = group.bodies.of<shape::Mesh>();
  double out = 0;
  for (int k = 0; k < (meshes.per_moment != 0 ? moments : 1); ++k)
    for (int i = 0; i < meshes.count; ++i) out = std::fmax(out, reach(meshes.at(k, i).shape, {0, 0, 0}));
  return out;
}

bool turns(const Object& object) { return !object.keyframes.empty() || length(object.angular_velocity_rad_per_s) > 0; }

}  // namespace

FrozenScene::FrozenScene(const Scene& scene, const std::vector<Vec3>& lights, int moments, bool bounces, int threads) : scene_(scene) {
  for (const Vec3& light : lights) lights_.push_back(vec(light));
  add_bodies(moments, threads);
  add_materials(scene.materials);
  view_.moments = moves_ ? moments : 0;
  view_.lights = static_cast<std::int32_t>(lights_.size());
  view_.has_sun = scene.ambient.direction.has_value();
  view_.light_positions = lights_.data();
  view_.bounces = bounces;
  lay_out();
  look({}, {std::vector<double>(static_cast<std::size_t>(moments), 0.0)});
  still_clusters_.build(view_, view_.still, 1);
  moving_clusters_.build(view_, view_.moving, view_.moments);
  // Of meshes as they are at the beginning, also where they change their shape: each frame is the same whatever was computed before it.
  view_.roughness = num::single(position_error *
                                (farthest(lights_) + std::fmax(largest_mesh(view_.still, 1), largest_mesh(view_.moving, view_.moments))));
  derive();
}

template <class Make>
int FrozenScene::number_of_maps(const void* map, const ReflectivityMap* opacity, const Make& make) {
  const auto [known, fresh] = map_numbers_.try_emplace({map, opacity}, static_cast<int>(maps_.size()));
  if (!fresh) return known->second;
  for (auto& levels : make()) {
    maps_.push_back(levels->view);
    map_levels_.push_back(std::move(levels));
  }
  return known->second;
}

void FrozenScene::add_materials(const std::vector<Material>& materials) {
  std::vector<int> cut_out_by;
  for (const Material& material : materials) {
    brdf::MaterialView& view = materials_.emplace_back(brdf::view_of(material));
    const ReflectivityMap* const opacity = material.opacity.get();
    const auto one = [](auto levels) {
      Levels out;
      out.push_back(std::move(levels));
      return out;
    };
    if (material.map != nullptr)
      view.map = number_of_maps(material.map.get(), opacity, [&] { return one(std::make_unique<MapLevels>(*material.map, opacity)); });
    if (material.normals != nullptr)
      view.normals = number_of_maps(material.normals.get(), opacity, [&] { return levels_of_normals(*material.normals, opacity); });
    if (material.finish != nullptr)
      view.finish = number_of_maps(material.finish.get(), opacity, [&] { return levels_of_finish(*material.finish, opacity); });
    cut_out_by.push_back(-1);
    if (opacity != nullptr)
      cut_out_by.back() = number_of_maps(nullptr, opacity, [&] {
        const ReflectivityMap& of = *opacity;
        return one(std::make_unique<MapLevels>(of.values, of.width, of.height, of.wrap_u, of.wrap_v, nullptr, 1));
      });
  }
  // Facet 0 has a material even where there is nothing to be seen.
  if (materials_.empty()) materials_.emplace_back();
  view_.materials = materials_.data(), view_.material_count = static_cast<std::int32_t>(materials_.size());
  view_.maps = maps_.data(), view_.map_count = static_cast<std::int32_t>(maps_.size());
  cut_out(cut_out_by);
}

/// Tells meshes which picture says where their surface is.
/// @param map_of_material  its number; −1: none
void FrozenScene::cut_out(const std::vector<int>& map_of_material) {
  for (BodyLists* group : {&still_, &moving_})
    for (Body<shape::Mesh>& body : group->of<shape::Mesh>().bodies) {
      const int map = map_of_material.empty() ? -1 : map_of_material[static_cast<std::size_t>(body.material)];
      if (map >= 0 && body.shape.has_texcoords != 0) body.shape.cut = maps_.data() + map;
    }
}

template <class T, class Said>
T FrozenScene::placed(const Said& said, const shape::Placement& at, [[maybe_unused]] int threads) {
  if constexpr (shape::many_of<T>) {
    std::shared_ptr<const Hierarchy>& hierarchy = hierarchies_[said.triangles];
    if (hierarchy == nullptr) hierarchy = shared_hierarchy(*said.triangles, threads);
    if (!hierarchy->details.empty()) view_.any_details = 1;
    return T::placed(*hierarchy, at);
  } else {
    return T::placed(said, at);
  }
}

namespace {

/// Of each object the number of its class, −1: it has none; one at least.
std::vector<std::int32_t> classes_of(const Scene& scene) {
  std::vector<std::string> names = scene.classes;
  if (names.empty()) {
    for (const Object& object : scene.objects)
      if (!object.class_name.empty()) names.push_back(object.class_name);
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
  }
  std::vector<std::int32_t> out;
  for (const Object& object : scene.objects) {
    const auto at = std::find(names.begin(), names.end(), object.class_name);
    out.push_back(at == names.end() || object.class_name.empty() ? -1 : static_cast<std::int32_t>(at - names.begin()));
  }
  if (out.empty()) out.push_back(-1);
  return out;
}

}  // namespace

void FrozenScene::add_bodies(int moments, int threads) {
  const bool camera_moves = !scene_.camera.keyframes.empty();
  moves_ = camera_moves;
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    const Object& object = scene_.objects[i];
    const bool moving = camera_moves || scene::moves(object);
    moves_ = moves_ || moving;
    const shape::Placement at = placement_of(object);
    add_body(shape::Shapes{}, object.shape, moving ? moving_ : still_, [&]<class T, class Said>(shape::List<T>, const Said& said) {
      if (moving) movers_.push_back({i, T::center_of(said) + at.shift});
      const auto mover = static_cast<std::int32_t>(moving ? movers_.size() - 1 : 0) - (moving ? 0 : 1);
      return Body<T>{placed<T>(said, at, threads), mover, 0, static_cast<std::int32_t>(i), object.material};
    });
    add_changing(i);
  }
  motions_.resize(1 + movers_.size());
  motion_of_.resize(std::max<std::size_t>(scene_.objects.size(), 1));
  for (std::size_t m = 0; m < movers_.size(); ++m) motion_of_[movers_[m].object] = static_cast<std::int32_t>(1 + m);
  class_of_ = classes_of(scene_);
  view_.class_of = class_of_.data();
  view_.motions = motions_.data(), view_.motion_of = motion_of_.data();
  view_.object_count = static_cast<std::int32_t>(motion_of_.size());
  view_.movers = static_cast<std::int32_t>(movers_.size());
  number(shape::Shapes{}, still_, view_.still);
  number(shape::Shapes{}, moving_, view_.moving);
  if (changing_.empty()) return;
  auto& meshes = moving_.of<shape::Mesh>().bodies;
  const std::size_t count = meshes.size();
  for (std::size_t i = count; i < count * static_cast<std::size_t>(moments); ++i) meshes.push_back(Body<shape::Mesh>(meshes[i - count]));
  view_.moving.bodies.of<shape::Mesh>() = {meshes.data(), static_cast<std::int32_t>(count), static_cast<std::int32_t>(count)};
  for (Changing& one : changing_) one.at.resize(static_cast<std::size_t>(moments));
}

void FrozenScene::add_changing(std::size_t object) {
  const auto* mesh = std::get_if<Mesh>(&scene_.objects[object].shape);
  if (mesh == nullptr || mesh->motion == nullptr) return;
  std::size_t which = 0;
  while (which < changing_.size() && (changing_[which].motion != mesh->motion.get() || changing_[which].mesh != mesh->triangles.get()))
    ++which;
  if (which == changing_.size())
    changing_.push_back({mesh->triangles.get(), mesh->motion.get(), hierarchies_.at(mesh->triangles).get(), {}, {}, {}});
  changing_bodies_.push_back({moving_.of<shape::Mesh>().bodies.size() - 1, object, which});
}

void FrozenScene::lay_out() {
  std::size_t used = 0;
  const auto place = [&](auto*& array, std::size_t count) {
    if (memory_ != nullptr) array = reinterpret_cast<std::remove_reference_t<decltype(array)>>(memory_.get() + used);
    used += (count * sizeof *array + 63) / 64 * 64;
  };
  each_derived(view_, Derive::all, place);
  memory_ = std::make_unique<unsigned char[]>(used);
  used = 0;
  each_derived(view_, Derive::all, place);
}

void FrozenScene::look(const std::optional<Pose>& pose, const Times& times) {
  const auto camera = [&](double time) { return camera_frame(pose ? *pose : pose_at(scene_.camera, time)); };
  std::vector<CameraFrame> cameras;
  for (const double time : times.moments) {
    cameras.push_back(camera(time));
    if (!moves_) break;  // one is as good as all
  }
  // A pose that is asked for stands still, also where the scene's camera only passes through it.
  const bool moved = cameras != cameras_ || pose.has_value() != posed_;
  still_known_ = still_known_ && !moved;
  moving_known_ = moving_known_ && !moved && times == times_;
  cameras_ = std::move(cameras), times_ = times, posed_ = pose.has_value();
  const auto& [rotation, position] = cameras_.front();
  view_.camera = {{{vec(rotation[0]), vec(rotation[1]), vec(rotation[2])}}, vec(position)};
  if (moved) look_for_sun(camera(times.truth_s()));
  if (!moving_known_) place_movers(), change_shapes();
  if (!moving_known_ && !movers_.empty()) look_at_motion(pose);
  if (!moving_known_) look_to_truth(pose);
}

void FrozenScene::look_for_sun(const CameraFrame& at_truth) {
  toward_suns_.clear(), sun_directions_.clear();
  const Vec3 sun = scene_.ambient.direction ? normalized(-1.0 * *scene_.ambient.direction) : Vec3{0, 0, 0};
  for (const CameraFrame& camera : cameras_) {
    const Vec3 toward = camera.rotation * sun;
    toward_suns_.push_back(vec(toward));
    for (const double x : toward) sun_directions_.push_back(num::single(x));
  }
  toward_sun_ = at_truth.rotation * sun;
  view_.toward_sun = toward_suns_.data(), view_.sun_directions = sun_directions_.data();
}

void FrozenScene::place_movers() {
  frames_.clear();
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    for (const Mover& mover : movers_) {
      const Object& object = scene_.objects[mover.object];
      frames_.push_back(frame_of(cameras_[k], motion_at(object, mover.center, times_.moments[k]), turns(object)));
    }
  }
  view_.frames = frames_.data();
}

void FrozenScene::change_shapes() {
  if (changing_.empty()) return;
  for (std::size_t k = 0; k < times_.moments.size(); ++k)
    for (Changing& one : changing_) refit(*one.built, shape_at(*one.mesh, *one.motion, times_.moments[k]), one.at[k]);
  // One time after the other for all of them: several may come out of one film.
  const auto all_at = [&](double time) {
    std::vector<Vertices> out;
    for (const Changing& one : changing_) out.push_back(shape_at(*one.mesh, *one.motion, time).vertices);
    return out;
  };
  constexpr double apart_s = 1e-3;
  const double truth = times_.truth_s();
  const auto now = all_at(truth), before = all_at(truth - apart_s), after = all_at(truth + apart_s),
             later = all_at(truth + times_.period_s);
  for (Changing& one : changing_) one.to_truth.resize(times_.to_truth ? times_.moments.size() : 0);
  for (std::size_t k = 0; k < times_.moments.size() && times_.to_truth; ++k) {
    const auto then = all_at(times_.moments[k]);
    for (std::size_t i = 0; i < changing_.size(); ++i)
      changing_[i].to_truth[k] = steps_of(*changing_[i].built, *changing_[i].mesh, then[i], then[i], 1, then[i], now[i]);
  }
  for (std::size_t i = 0; i < changing_.size(); ++i)
    changing_[i].steps = steps_of(*changing_[i].built, *changing_[i].mesh, before[i], after[i], apart_s, now[i], later[i]);
  auto& meshes = moving_.of<shape::Mesh>().bodies;
  const auto count = static_cast<std::size_t>(view_.moving.bodies.of<shape::Mesh>().count);
  for (std::size_t k = 0; k < times_.moments.size(); ++k) {
    for (const ChangingBody& one : changing_bodies_) {
      const Changing& changing = changing_[one.which];
      shape::Mesh& mesh = meshes[k * count + one.body].shape;
      const brdf::MapView* const cut = mesh.cut;
      mesh = shape::Mesh::placed(changing.at[k], placement_of(scene_.objects[one.object]));
      mesh.cut = cut;
      mesh.steps = k == times_.truth ? changing.steps.data() : times_.to_truth ? changing.to_truth[k].data() : nullptr;
    }
  }
}

namespace {

/// From where an object's points are seen to where they are seen at another time. What is at X before it moves is at A·(X − o) now and at
/// B·(X − q) then: B·Aᵀ·P + B·(o − q).                                                          [theory: camera-frame-motion]
void put_step(const shape::CoordinateFrame& here, const shape::CoordinateFrame& there, MotionView& out) {
  shape::copy(there.axes * (here.origin - there.origin), out.step);
  for (int k = 0; k < 3; ++k) {
    Vec row = here.axes * there.axes.row[k];
    row[k] = row[k] - 1;
    shape::copy(here.axes == there.axes ? Vec{0, 0, 0} : row, out.turn + 3 * k);  // else rounding would be left
  }
}

}  // namespace

/// How all moves from each moment to the time of the truth.                                           [theory: raw-frame-flow]
void FrozenScene::look_to_truth(const std::optional<Pose>& pose) {
  view_.to_truth = nullptr;
  if (!times_.to_truth) return;
  const CameraFrame camera = camera_frame(pose ? *pose : pose_at(scene_.camera, times_.truth_s()));
  const std::size_t rows = 1 + movers_.size();
  to_truth_.assign(rows * times_.moments.size(), {});
  for (std::size_t k = 0; k < times_.moments.size(); ++k) {
    for (std::size_t m = 0; m < movers_.size(); ++m) {
      const Object& object = scene_.objects[movers_[m].object];
      const shape::CoordinateFrame there = frame_of(camera, motion_at(object, movers_[m].center, times_.truth_s()), turns(object));
      put_step(frames_[k * movers_.size() + m], there, to_truth_[k * rows + 1 + m]);
    }
  }
  view_.to_truth = to_truth_.data();
}

/// P is seen at axes·(X − position); both X and the camera move.                                   [theory: camera-frame-motion]
void FrozenScene::look_at_motion(const std::optional<Pose>& pose) {
  const double now = times_.truth_s(), later = now + times_.period_s;
  const MovingCamera camera = pose ? MovingCamera{camera_frame(*pose)} : camera_at(scene_.camera, now);
  const CameraFrame after = pose ? camera.frame : camera_frame(pose_at(scene_.camera, later));
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    const Mover& mover = movers_[m];
    const Object& object = scene_.objects[mover.object];
    const Motion motion = motion_at(object, mover.center, now);
    const shape::CoordinateFrame here = frame_of(camera.frame, motion, turns(object)),
                                 there = frame_of(after, motion_at(object, mover.center, later), turns(object));
    const shape::Mat axes{{vec(camera.frame.rotation[0]), vec(camera.frame.rotation[1]), vec(camera.frame.rotation[2])}};
    MotionView& out = motions_[1 + m];
    shape::copy(axes * (motion.drift + cross(motion.spin, vec(camera.frame.position)) - camera.velocity), out.velocity);
    shape::copy(axes * (motion.spin - camera.spin), out.spin);
    put_step(here, there, out);
  }
}

void FrozenScene::derive() {
  if (still_known_ && (moving_known_ || !moves_)) return;
  const Derive what = still_known_ ? Derive::moving : Derive::all;
  const int units = unit_count(view_, what);
  for (int i = 0; i < units; ++i) scene::derive(view_, what, i);
  if (!still_known_) still_clusters_.update(view_, view_.still);
  moving_clusters_.update(view_, view_.moving);
  still_known_ = moving_known_ = true;
}

}  // namespace tofray::scene
