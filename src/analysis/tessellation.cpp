// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/tessellation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <variant>

#include "analysis/bodies.h"
#include "analysis/stand.h"
#include "base/constants.h"
#include "tofray/simulator.h"

namespace tofray::analysis {

namespace {

constexpr int sides = 64;
constexpr std::size_t box_triangles = 12;

using Corners = std::vector<std::array<float, 9>>;

void add(Corners& to, const Vec& a, const Vec& b, const Vec& c) {
  std::array<float, 9> one{};
  const Vec all[] = {a, b, c};
  for (std::size_t i = 0; i < 9; ++i) one[i] = static_cast<float>(all[i / 3][static_cast<int>(i % 3)]);
  to.push_back(one);
}

void add_quad(Corners& to, const Vec& a, const Vec& b, const Vec& c, const Vec& d) { add(to, a, b, c), add(to, a, c, d); }

/// A box from `low` to `high`, seen from outside.
void add_box(Corners& to, const Vec& low, const Vec& high) {
  const auto at = [&](int x, int y, int z) { return Vec{x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z}; };
  add_quad(to, at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
  add_quad(to, at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
  add_quad(to, at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
  add_quad(to, at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
  add_quad(to, at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
  add_quad(to, at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
}

/// A corner of an outline that is turned about an axis: how far from it, and how far along.
struct Outline {
  double radius, along;
};

/// What an outline makes when it is turned about an axis, the first corner lowest.
void add_turned(Corners& to, const std::vector<Outline>& outline, const Vec& along) {
  const Vec axis = shape::normalized(along), u = shape::way_across({0, 0, 0}, axis), v = shape::cross(axis, u);
  const auto at = [&](const Outline& one, int side) {
    const double angle = base::two_pi * (side % sides) / sides;
    return one.radius * (std::cos(angle) * u + std::sin(angle) * v) + one.along * axis;
  };
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const Outline &low = outline[i], &high = outline[i + 1];
    for (int side = 0; side < sides; ++side) {
      if (low.radius > 0) add(to, at(low, side), at(low, side + 1), at(high, side));
      if (high.radius > 0) add(to, at(low, side + 1), at(high, side + 1), at(high, side));
    }
  }
}

/// A quarter or half circle as part of an outline. @param from, to  in quarters of a turn from the axis's foot
void add_arc(std::vector<Outline>& outline, double radius, double middle, int from, int to) {
  const int steps = sides / 4 * (to - from);
  for (int i = 0; i <= steps; ++i) {
    const double angle = base::two_pi * (static_cast<double>(from) / 4 + static_cast<double>(i) / sides);
    const bool on_axis = (i == 0 && from == 0) || (i == steps && to == 2);
    outline.push_back({on_axis ? 0 : radius * std::sin(angle), middle - radius * std::cos(angle)});
  }
}

Vec vec(const Vec3& a) { return scene::vec(a); }

Corners corners_of(const Plane& plane, double patch_m) {
  const Vec normal = shape::normalized(vec(plane.normal)), u = patch_m * shape::way_across({0, 0, 0}, normal);
  const Vec v = shape::cross(normal, u), origin{0, 0, 0};
  Corners out;
  add_quad(out, origin - u - v, u - v, u + v, v - u);
  return out;
}
Corners corners_of(const Sphere& sphere, double /*patch_m*/) {
  std::vector<Outline> outline;
  add_arc(outline, sphere.radius, 0, 0, 2);
  Corners out;
  add_turned(out, outline, {0, 1, 0});
  return out;
}
Corners corners_of(const Box& box, double /*patch_m*/) {
  const Vec half = 0.5 * (vec(box.max) - vec(box.min));
  Corners out;
  add_box(out, -1 * half, half);
  return out;
}
Corners corners_of(const Triangle& triangle, double /*patch_m*/) {
  const Vec center = shape::Triangle::center_of(triangle);
  Corners out;
  add(out, vec(triangle.vertices[0]) - center, vec(triangle.vertices[1]) - center, vec(triangle.vertices[2]) - center);
  return out;
}
Corners corners_of(const Cylinder& cylinder, double /*patch_m*/) {
  const double half = 0.5 * cylinder.height, radius = cylinder.radius;
  Corners out;
  add_turned(out, {{0, -half}, {radius, -half}, {radius, half}, {0, half}}, vec(cylinder.axis));
  return out;
}
Corners corners_of(const Rectangle& rectangle, double /*patch_m*/) {
  const double x = 0.5 * rectangle.size[0], y = 0.5 * rectangle.size[1];
  Corners out;
  add_quad(out, {-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0});
  return out;
}
Corners corners_of(const Disk& disk, double /*patch_m*/) {
  Corners out;
  add_turned(out, {{disk.radius, 0}, {0, 0}}, vec(disk.normal));
  return out;
}
Corners corners_of(const Capsule& capsule, double /*patch_m*/) {
  const Vec along = vec(capsule.end) - vec(capsule.start);
  const double half = 0.5 * shape::length(along);
  std::vector<Outline> outline;
  add_arc(outline, capsule.radius, -half, 0, 1), add_arc(outline, capsule.radius, half, 1, 2);
  Corners out;
  add_turned(out, outline, along);
  return out;
}
Corners corners_of(const Cone& cone, double /*patch_m*/) {
  Corners out;
  add_turned(out, {{0, 0}, {cone.radius, 0}, {0, cone.height}}, vec(cone.axis));
  return out;
}

Corners corners_of(const Mesh& mesh, double time_s) {
  Corners out;
  if (mesh.triangles == nullptr) return out;
  std::vector<std::array<float, 3>> moved, normals;
  if (mesh.motion != nullptr) mesh.motion->at(time_s, moved, normals);
  const auto& vertices = mesh.motion != nullptr ? moved : mesh.triangles->vertices;
  out.reserve(mesh.triangles->triangles.size());
  for (const auto& triangle : mesh.triangles->triangles) {
    std::array<float, 9> one{};
    for (std::size_t i = 0; i < 9; ++i) one[i] = vertices[static_cast<std::size_t>(triangle[i / 3])][i % 3];
    out.push_back(one);
  }
  return out;
}

/// The box that holds triangles.
Corners box_of(const Corners& corners) {
  Vec low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const auto& one : corners)
    for (std::size_t i = 0; i < 9; ++i) {
      const auto k = static_cast<int>(i % 3);
      low[k] = std::min(low[k], static_cast<double>(one[i])), high[k] = std::max(high[k], static_cast<double>(one[i]));
    }
  Corners out;
  if (!corners.empty()) add_box(out, low, high);
  return out;
}

/// Half the side of the squares that planes become: the power of two beyond all else, so that it is the same while things move a little.
std::vector<double> patches_of(const Scene& scene, double time_s) {
  constexpr double least_m = 8;
  const std::vector<Body> bodies = bodies_at(scene, time_s);
  const auto pose = camera_pose(scene, time_s);
  const Vec camera{pose[3], pose[7], pose[11]};
  std::vector<double> out;
  for (const Object& object : scene.objects) {
    if (!std::holds_alternative<Plane>(object.shape)) {
      out.push_back(0);
      continue;
    }
    const Vec origin = pose_of(object, time_s).origin;
    double farthest = shape::length(camera - origin);
    for (const Body& body : bodies)
      for (int corner = 0; !body.endless && corner < 8; ++corner) {
        const Vec at{(corner & 1) != 0 ? body.high.x : body.low.x, (corner & 2) != 0 ? body.high.y : body.low.y,
                     (corner & 4) != 0 ? body.high.z : body.low.z};
        if (const double away = shape::length(at - origin); std::isfinite(away)) farthest = std::max(farthest, away);
      }
    out.push_back(std::exp2(std::ceil(std::log2(std::max(2 * farthest, least_m)))));
  }
  return out;
}

}  // namespace

Vec center_of(const Object& object) {
  Vec out{};
  with_shape(shape::Shapes{}, object.shape,
             [&]<class Shape, class Said>(shape::List<Shape>, const Said& said) { out = Shape::center_of(said); });
  return out;
}

ObjectPose gone_by(const Object& object, double time_s) {
  const scene::Motion motion = scene::motion_at(object, {0, 0, 0}, time_s);
  return {motion.shift, motion.turn};
}

shape::Mat turn_about(const Vec3& axis, double angle_rad) { return scene::rotation_matrix({axis, angle_rad}); }

ObjectPose pose_of(const Object& object, double time_s) {
  ObjectPose out;
  with_shape(shape::Shapes{}, object.shape, [&]<class Shape, class Said>(shape::List<Shape>, const Said& said) {
    const Stand stand = stand_of<Shape>(object, said, time_s);
    out = {stand.to_world(Shape::center_of(said) + stand.at.shift), scene::product(stand.motion.turn, stand.at.turn)};
  });
  return out;
}

std::vector<std::array<float, 9>> object_triangles(const Object& object, double time_s, double patch_m) {
  return std::visit(
      [&](const auto& said) {
        if constexpr (std::is_same_v<std::decay_t<decltype(said)>, Mesh>)
          return corners_of(said, time_s);
        else
          return corners_of(said, patch_m);
      },
      object.shape);
}

SceneTriangles scene_triangles(const Scene& scene, double time_s, std::size_t most) {
  const std::size_t count = scene.objects.size();
  const std::vector<double> patches = patches_of(scene, time_s);
  const auto triangles_of = [&](std::size_t i) { return object_triangles(scene.objects[i], time_s, patches[i]); };
  std::vector<std::size_t> sizes(count), order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = 0; i < count; ++i) {
    const auto* mesh = std::get_if<Mesh>(&scene.objects[i].shape);
    sizes[i] = mesh == nullptr ? triangles_of(i).size() : mesh->triangles == nullptr ? 0 : mesh->triangles->triangles.size();
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
  SceneTriangles out;
  out.drawn.assign(count, Drawn::none);
  std::size_t used = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t left = std::min((count - k - 1) * box_triangles, most), own = sizes[order[k]];
    const bool whole = used + own + left <= most || (own <= box_triangles && used + own <= most);
    if (!whole && used + box_triangles > most) continue;
    out.drawn[order[k]] = whole ? Drawn::shape : Drawn::box;
    used += whole ? own : box_triangles;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (out.drawn[i] == Drawn::none) continue;
    Corners corners = triangles_of(i);
    if (out.drawn[i] == Drawn::box) corners = box_of(corners);
    out.corners.insert(out.corners.end(), corners.begin(), corners.end());
    out.objects.insert(out.objects.end(), corners.size(), static_cast<std::uint32_t>(i));
  }
  return out;
}

}  // namespace tofray::analysis
