// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/frozen_scene.h"

#include "num/setup_math.h"
#include "scene/derive.h"

namespace tofray::scene {

using namespace base;
namespace setup = num::setup;

namespace {

shape::Vec vec(const Vec3& a) { return {a[0], a[1], a[2]}; }

/// Rodrigues' formula, as rows.
shape::Mat rotation_matrix(const Rotation& r) {
  if (r.angle_rad == 0) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const Vec3 k = normalized(r.axis);
  const double c = setup::cos(r.angle_rad), s = setup::sin(r.angle_rad), v = 1 - c;
  return {{{c + k[0] * k[0] * v, k[0] * k[1] * v - k[2] * s, k[0] * k[2] * v + k[1] * s},
           {k[1] * k[0] * v + k[2] * s, c + k[1] * k[1] * v, k[1] * k[2] * v - k[0] * s},
           {k[2] * k[0] * v - k[1] * s, k[2] * k[1] * v + k[0] * s, c + k[2] * k[2] * v}}};
}

/// Puts an object's shape into the list of its kind, which is the one in the same place as in the public variant.
template <class... T, class... Said, class Placed>
void add_body(shape::List<T...>, const std::variant<Said...>& shape, const Object& object, int index, BodyLists& to, const Placed& placed) {
  static_assert(sizeof...(T) == sizeof...(Said), "each shape of the public variant has its place in shape::Shapes");
  const auto add = [&]<class One, class From>(const From* said, shape::List<One> which) {
    if (said != nullptr) to.of<One>().bodies.push_back({placed(which, *said), vec(object.velocity_m_per_s), 0, index, object.material});
  };
  (add(std::get_if<Said>(&shape), shape::List<T>{}), ...);
}

/// Numbers the facets of a group.
template <class... T>
void number(shape::List<T...>, BodyLists& from, Group& to) {
  const auto one = [&]<class One>(shape::List<One>) {
    auto& bodies = from.of<One>().bodies;
    for (Body<One>& body : bodies) body.facet = to.facet_count, to.facet_count += One::facets;
    to.bodies.of<One>() = {bodies.data(), static_cast<std::int32_t>(bodies.size())};
    to.body_count += to.bodies.of<One>().count;
  };
  (one(shape::List<T>{}), ...);
}

}  // namespace

CameraFrame camera_frame(const Pose& pose) {
  const Vec3 forward = normalized(pose.look_at - pose.position);
  const Vec3 down = normalized(dot(pose.up, forward) * forward - pose.up);
  return {{{cross(down, forward), down, forward}}, pose.position};
}

FrozenScene::FrozenScene(const Scene& scene, const std::vector<Vec3>& lights, int moments) : sun_(scene.ambient.direction) {
  for (const Vec3& light : lights) lights_.push_back(vec(light));
  add_bodies(scene);
  add_materials(scene.materials);
  view_.moments = moves_ ? moments : 0;
  view_.lights = static_cast<std::int32_t>(lights_.size());
  view_.has_sun = sun_.has_value();
  view_.light_positions = lights_.data();
  lay_out();
  look(scene.camera.pose, std::vector<double>(static_cast<std::size_t>(moments), 0.0));
  derive();
}

void FrozenScene::add_materials(const std::vector<Material>& materials) {
  for (const Material& material : materials) {
    brdf::MaterialView& view = materials_.emplace_back(brdf::view_of(material));
    if (view.brdf != 0) view_.any_other_brdf = 1;
    if (material.map == nullptr) continue;
    const auto [known, fresh] = map_numbers_.try_emplace(material.map, static_cast<int>(maps_.size()));
    if (fresh) maps_.push_back(map_levels_.emplace_back(std::make_unique<MapLevels>(*material.map))->view);
    view.map = known->second;
  }
  // Facet 0 has a material even where there is nothing to be seen.
  if (materials_.empty()) materials_.emplace_back();
  view_.materials = materials_.data(), view_.material_count = static_cast<std::int32_t>(materials_.size());
  view_.maps = maps_.data(), view_.map_count = static_cast<std::int32_t>(maps_.size());
}

template <class T, class Said>
T FrozenScene::placed(const Said& said, const shape::Placement& at) {
  if constexpr (shape::many_of<T>) {
    const auto [known, fresh] = hierarchies_.try_emplace(said.triangles);
    if (fresh) known->second = build_hierarchy(*said.triangles);
    if (!known->second.details.empty()) view_.any_details = 1;
    return T::placed(known->second, at);
  } else {
    return T::placed(said, at);
  }
}

void FrozenScene::add_bodies(const Scene& scene) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const bool moving = dot(object.velocity_m_per_s, object.velocity_m_per_s) > 0;
    moves_ = moves_ || moving;
    for (const double v : object.velocity_m_per_s) velocities_.push_back(num::single(v));
    const shape::Placement at{rotation_matrix(object.rotation), vec(object.position)};
    add_body(shape::Shapes{}, object.shape, object, static_cast<int>(i), moving ? moving_ : still_,
             [&]<class T, class Said>(shape::List<T>, const Said& said) { return placed<T>(said, at); });
  }
  if (velocities_.empty()) velocities_.assign(3, 0.0f);
  view_.velocities = velocities_.data(), view_.object_count = static_cast<std::int32_t>(velocities_.size() / 3);
  number(shape::Shapes{}, still_, view_.still);
  number(shape::Shapes{}, moving_, view_.moving);
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

void FrozenScene::look(const Pose& pose, const std::vector<double>& moment_times) {
  const CameraFrame now = camera_frame(pose);
  const bool moved = now.rotation != camera_.rotation || now.position != camera_.position;
  still_known_ = still_known_ && !moved;
  moving_known_ = moving_known_ && !moved && moment_times == moment_times_;
  camera_ = now;
  moment_times_ = moment_times;
  if (sun_) toward_sun_ = camera_.rotation * normalized(-1.0 * *sun_);
  view_.camera = {{{vec(camera_.rotation[0]), vec(camera_.rotation[1]), vec(camera_.rotation[2])}}, vec(camera_.position)};
  view_.toward_sun = vec(toward_sun_);
  view_.moment_times = moment_times_.data();
}

void FrozenScene::derive() {
  if (still_known_ && (moving_known_ || !moves_)) return;
  const Derive what = still_known_ ? Derive::moving : Derive::all;
  const int units = unit_count(view_, what);
  for (int i = 0; i < units; ++i) scene::derive(view_, what, i);
  still_known_ = moving_known_ = true;
}

}  // namespace tofray::scene
