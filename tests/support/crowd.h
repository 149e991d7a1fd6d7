// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "support/random_scene.h"
#include "support/wobble.h"

namespace tofray::test {

/// Many small things of all shapes that end somewhere, some of them at the very same place, behind the camera or around it; each third
/// one moves where that is asked for, and meshes share their triangles.
inline Scene crowd(Random& random, int objects, bool moving, double width = 1.5) {
  Scene scene;
  scene.materials = {{"matt", Material::Brdf::lambert, 0.7, 0, 1}};
  scene.objects.push_back(object(Plane{{0, 0, 5}, Vec3{0.1, 0.05, -1}}));
  const auto rock = shared(single(stone(random, 1, 0.03, {0, 0, 0})));
  const Vec3 twins{0.1, 0.1, 2};
  for (int i = 0; i < objects; ++i) {
    const Vec3 aside = random.point(width);
    const double size = random.below(50) == 0 ? random.scale(0.1, 8) : random.scale(1e-3, 0.05);
    const Vec3 middle = random.below(10) == 0 ? twins : Vec3{aside[0], aside[1], random.between(random.below(8) == 0 ? -3 : 0.5, 4.5)};
    Object one;
    const int kind = random.below(9);
    if (kind <= 1) one.shape = Sphere{middle, size};
    if (kind == 2) one.shape = Box{middle - Vec3{size, size, size}, middle + Vec3{size, 0.5 * size, size}};
    if (kind == 3) one.shape = Triangle{{middle, middle + size * random.direction(), middle + size * random.direction()}};
    if (kind == 4) one.shape = Cylinder{middle, random.direction(), 0.5 * size, size};
    if (kind == 5) one.shape = Rectangle{middle, {size, 0.3 * size}};
    if (kind == 6) one.shape = Disk{middle, random.direction(), size};
    if (kind == 7) one.shape = Capsule{middle, middle + size * random.direction(), 0.5 * size};
    if (kind == 8) one.shape = Cone{middle, random.direction(), size, 2 * size};
    if (i % 20 == 0) one.shape = rock, one.position = middle;
    if (random.below(3) == 0) one.rotation = {random.direction(), random.between(-3, 3)};
    if (moving && i % 3 == 0) one.velocity_m_per_s = random.point(2);
    scene.objects.push_back(one);
  }
  return scene;
}

/// Lets all meshes change their shape, by much more than they are large.
inline void let_meshes_change(Scene& scene) {
  std::shared_ptr<const MeshMotion> motion;
  for (Object& one : scene.objects) {
    auto* mesh = std::get_if<Mesh>(&one.shape);
    if (mesh == nullptr) continue;
    if (motion == nullptr) motion = wobbling(*mesh, 0.3, 2).motion;
    mesh->motion = motion;
  }
}

}  // namespace tofray::test
