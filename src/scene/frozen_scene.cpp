// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/frozen_scene.h"

namespace tofray::scene {

using namespace base;

FrozenScene::FrozenScene(const Scene& scene, const std::vector<Vec3>& lights, int slots)
    : scene_(scene), lights_(lights), camera_(camera_frame(scene.camera.pose)) {
  for (const Object& object : scene_.objects) {
    moves_ = moves_ || dot(object.velocity_m_per_s, object.velocity_m_per_s) > 0;
  }
  if (scene_.ambient.direction) toward_sun_ = camera_.rotation * normalized(-1.0 * *scene_.ambient.direction);
  for (const Material& material : scene_.materials) view_.any_specular = view_.any_specular || material.specular > 0;
  view_.slots = moves_ ? slots : 0;
  view_.lights = static_cast<std::int32_t>(lights_.size());
  add_still();
  update(std::vector<double>(static_cast<std::size_t>(slots), 0.0));
}

void FrozenScene::add_still() {
  const Placed still = place(scene_, camera_, Group::still, 0);
  append_facets(still, scene_, facets_);
  still_facets_ = facets_.size();
  still_views_.emplace_back(still, Vec3{0, 0, 0}, 0);
  for (const Vec3& light : lights_) still_views_.emplace_back(still, light, 0);
  for (std::size_t i = 1; i < still_views_.size(); ++i) light_still_.push_back(still_views_[i].forms());
  if (scene_.ambient.direction) sun_views_.emplace_back(still, toward_sun_);
}

void FrozenScene::update(const std::vector<double>& slot_times) {
  facets_.resize(still_facets_);
  moving_views_.clear(), camera_moving_.clear(), light_moving_.clear(), sun_moving_.clear();
  sun_views_.resize(scene_.ambient.direction ? 1 : 0);
  for (std::size_t slot = 0; moves_ && slot < slot_times.size(); ++slot) {
    const Placed moving = place(scene_, camera_, Group::moving, slot_times[slot]);
    const int base = static_cast<int>(facets_.size());
    append_facets(moving, scene_, facets_);
    moving_views_.emplace_back(moving, Vec3{0, 0, 0}, base);
    camera_moving_.push_back(moving_views_.back().forms());
    for (const Vec3& light : lights_) {
      moving_views_.emplace_back(moving, light, base);
      light_moving_.push_back(moving_views_.back().forms());
    }
    if (scene_.ambient.direction) {
      sun_views_.emplace_back(moving, toward_sun_);
      sun_moving_.push_back(sun_views_.back().forms());
    }
  }
  view_.camera_still = still_views_[0].forms();
  view_.light_still = light_still_.data();
  view_.camera_moving = camera_moving_.data();
  view_.light_moving = light_moving_.data();
  view_.sun_still = sun_views_.empty() ? ParallelForms{} : sun_views_[0].forms();
  view_.sun_moving = sun_moving_.data();
  // Where nothing is hit, facet 0 is read all the same, and what it says is thrown away.
  if (facets_.empty()) facets_.emplace_back();
  view_.facets = facets_.data();
  view_.facet_count = static_cast<std::int32_t>(facets_.size());
}

}  // namespace tofray::scene
