// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "support/meshes.h"
#include "support/pixels.h"
#include "support/random.h"

namespace tofray::test {

/// A closed mesh that is not convex.
inline ClosedMesh stone(Random& random, int cuts, double size, const Vec3& middle) {
  ClosedMesh out = icosphere(cuts);
  for (Vec3& v : out.vertices) v = size * random.between(0.5, 1) * v + middle;
  return out;
}

/// What comes out of broken programs: no area, needles, corners as far away as the world goes, the same triangle twice.
inline TriangleMesh garbage(Random& random, int count) {
  TriangleMesh out;
  for (int i = 0; i < 3 * count; ++i) {
    const Vec3 at = random.below(4) == 0 ? random.scale(1e-35, 1e5) * random.direction() : random.point(1);
    out.vertices.push_back({static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(random.below(3) == 0 ? 0 : at[2])});
  }
  for (int i = 0; i < 3 * count; i += 3 * (1 + random.below(4))) {  // needles
    const auto at = static_cast<std::size_t>(i);
    const double share = random.uniform(), thick = random.scale(random.below(4) == 0 ? 1e-30 : 1e-9, 1e-3);
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = static_cast<double>(out.vertices[at][k]), b = static_cast<double>(out.vertices[at + 1][k]);
      out.vertices[at + 2][k] = static_cast<float>(a + share * (b - a) + thick * random.between(-1, 1));
    }
    out.triangles.push_back({i, i + 1, i + 2});
  }
  for (int i = 0; i < count; ++i) {
    const auto corner = [&] { return random.below(3 * count); };
    out.triangles.push_back(random.below(5) == 0 ? std::array{0, corner(), 0} : std::array{corner(), corner(), corner()});
    if (random.below(5) == 0) out.triangles.push_back(out.triangles.back());
  }
  return out;
}

/// Normals that are not the triangles', texture coordinates, and shades.
inline void add_details(Random& random, TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 n = random.direction();
    mesh.normals.push_back({static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])});
    mesh.texcoords.push_back({static_cast<float>(random.between(-2, 3)), static_cast<float>(random.between(-2, 3))});
    mesh.shades.push_back(static_cast<float>(i % 7) / 6);
  }
}

inline std::shared_ptr<const ReflectivityMap> random_map(Random& random) {
  auto map = std::make_shared<ReflectivityMap>();
  map->width = 1 + random.below(40), map->height = 1 + random.below(40);
  map->wrap_u = static_cast<ReflectivityMap::Wrap>(random.below(3)), map->wrap_v = static_cast<ReflectivityMap::Wrap>(random.below(3));
  for (int i = 0; i < map->width * map->height; ++i) map->values.push_back(static_cast<float>(random.uniform()));
  return map;
}

/// Pictures of normals, and of metal and roughness; by a chance of their own.
inline void add_vector_maps(Material& leaning, Material& metal) {
  Random random(99);
  const auto map = [&](int width, int height, const auto& value) {
    auto out = std::make_shared<VectorMap>();
    out->width = width, out->height = height;
    for (int i = 0; i < width * height; ++i) out->values.push_back(value());
    return out;
  };
  const auto number = [&](double low, double high) { return static_cast<float>(random.between(low, high)); };
  leaning.normals = map(7, 5, [&] { return std::array{number(-0.6, 0.6), number(-0.6, 0.6), 0.7F}; });
  metal.normals = leaning.normals;
  metal.finish = map(6, 9, [&] { return std::array{number(0, 1), number(0, 1), number(0.1, 1)}; });
}

/// A picture that cuts out a third of a mesh that has texture coordinates; by a chance of its own.
inline std::shared_ptr<const ReflectivityMap> random_opacity() {
  Random random(98);
  auto map = std::make_shared<ReflectivityMap>(*random_map(random));
  for (float& a : map->values) a = random.uniform() < 0.3 ? 0.0F : 1.0F;
  return map;
}

/// Some of everything before a slanted wall; half of it turned, and moving if asked for.
inline Scene random_scene(Random& random, int objects, bool moving) {
  Scene scene;
  scene.materials = {{"matt", Material::Brdf::lambert, 0.7, 0, 1},
                     {"paint", Material::Brdf::phong, 0.4, 0.3, 12},
                     {"dark", Material::Brdf::lambert, 0.05, 0, 1},
                     {"metal", Material::Brdf::ggx, 0, 0.8},
                     {"sheet", Material::Brdf::retro, 0.1}};
  for (Material& one : scene.materials) one.map = random_map(random);
  scene.materials[3].alpha = 0.2;
  add_vector_maps(scene.materials[1], scene.materials[3]);
  scene.materials[4].retro = 0.3, scene.materials[4].spread_rad = 0.03;
  const double back = random.between(3, 6);
  const Vec3 slant = random.point(0.4);
  scene.objects.push_back(object(Plane{{0, 0, back}, Vec3{slant[0], slant[1], -1}}));
  for (int i = 0; i < objects; ++i) {
    const double away = random.between(0.6, 4), size = random.scale(0.03, 0.6);
    const Vec3 aside = random.point(0.7 * away), middle{aside[0], aside[1], away};
    Object one;
    const int kind = random.below(14);
    if (kind < 2) one.shape = Sphere{middle, size};
    if (kind >= 2 && kind < 4) {
      const Vec3 half = 0.5 * size * (Vec3{1.2, 1.2, 1.2} + random.point(1));
      one.shape = Box{middle - half, middle + half};
    }
    if (kind >= 4 && kind < 7) {
      Triangle triangle;
      for (Vec3& vertex : triangle.vertices) vertex = middle + size * random.direction();
      one.shape = triangle;
    }
    if (kind == 7) one.shape = Plane{middle + Vec3{0, 0, 2}, random.direction()};
    if (kind == 8) one.shape = Cylinder{middle, random.direction(), 0.5 * size, random.between(0.3, 2) * size};
    if (kind == 10) one.shape = Rectangle{middle, {random.between(0.3, 2) * size, random.between(0.3, 2) * size}};
    if (kind == 11) one.shape = Disk{middle, random.direction(), size};
    if (kind == 12) one.shape = Capsule{middle, middle + random.between(0.2, 2) * size * random.direction(), 0.5 * size};
    if (kind == 13) one.shape = Cone{middle, random.direction(), size, random.between(0.3, 3) * size};
    if (kind == 9) {
      TriangleMesh triangles = single(stone(random, random.below(3), size, middle));
      if (random.below(2) == 0) add_details(random, triangles);
      one.shape = shared(std::move(triangles));
    }
    one.material = random.below(5);
    if (random.uniform() < 0.5) {
      one.rotation.axis = random.direction();
      one.rotation.angle_rad = random.between(-3, 3);
    }
    if (moving && random.uniform() < 0.4) one.velocity_m_per_s = random.point(3);
    scene.objects.push_back(one);
  }
  return scene;
}

/// Cuts holes into those of a random scene's meshes that have texture coordinates and one of two materials.
inline void cut_out(Scene& scene) { scene.materials[0].opacity = scene.materials[3].opacity = random_opacity(); }

/// Sets some of a scene's things in motion while the first frames of a camera are taken: they turn, or follow keyframes; its camera does,
/// if asked for, about where it stands.
inline void set_in_motion(Random& random, Scene& scene, bool camera) {
  for (Object& one : scene.objects) {
    const int kind = random.below(4);
    if (kind == 0) one.angular_velocity_rad_per_s = random.point(30);
    if (kind != 1) continue;
    one.keyframes = {{random.between(-1, 0), one.position, one.rotation}};
    for (int i = random.below(4); i > 0; --i) {
      const Rotation turn{random.below(2) == 0 ? one.rotation.axis : random.direction(), random.between(-4, 4)};
      one.keyframes.push_back({one.keyframes.back().time_s + random.scale(1e-3, 1), one.position + random.point(0.3), turn});
    }
    one.position = one.velocity_m_per_s = {0, 0, 0}, one.rotation = {};
  }
  if (!camera) return;
  scene.camera.keyframes = {{-0.01, scene.camera.pose}};
  for (int i = 1 + random.below(3); i > 0; --i) {
    Pose pose = scene.camera.pose;
    pose.position = pose.position + random.point(0.15), pose.look_at = pose.look_at + random.point(0.3),
    pose.up = pose.up + random.point(0.1);
    scene.camera.keyframes.push_back({scene.camera.keyframes.back().time_s + random.scale(3e-3, 1), pose});
  }
  scene.camera.pose = {};
}

/// A camera that looks about from somewhere near zero.
inline Pose random_pose(Random& random) {
  const Vec3 at = random.point(0.3);
  const Vec3 ahead = at + Vec3{0, 0, 2} + random.point(0.5);
  return {at, ahead, Vec3{0, -1, 0} + random.point(0.6)};
}

}  // namespace tofray::test
