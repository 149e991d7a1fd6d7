// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "analysis/stand.h"
#include "base/constants.h"

namespace tofray::analysis {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Directions that tell turned things of the same box apart.
const std::array<Vec, 4>& some_directions() {
  static const std::array<Vec, 4> all = {shape::normalized(Vec{1, 2, 3}), shape::normalized(Vec{-2, 3, 1}),
                                         shape::normalized(Vec{3, 1, -2}), shape::normalized(Vec{1, -3, 2})};
  return all;
}

constexpr Vec axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// Of triangles in their own frame.
struct MeshBox {
  Vec low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
};
MeshBox box_of(const TriangleMesh& mesh) {
  MeshBox out;
  for (const auto& triangle : mesh.triangles)
    for (const std::int32_t corner : triangle)
      for (int k = 0; k < 3; ++k) {
        const auto x = static_cast<double>(mesh.vertices[static_cast<std::size_t>(corner)][static_cast<std::size_t>(k)]);
        out.low[k] = std::min(out.low[k], x), out.high[k] = std::max(out.high[k], x);
      }
  return out;
}
using KnownMeshes = std::map<const TriangleMesh*, MeshBox>;

void widen(Body& body, const Vec& p) {
  for (int k = 0; k < 3; ++k) body.low[k] = std::min(body.low[k], p[k]), body.high[k] = std::max(body.high[k], p[k]);
}
Body nowhere() { return {false, {infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, {}}; }

Vec mesh_point(const Stand& stand, const Vec& p) { return stand.to_world(stand.at.turn * p + stand.at.shift); }

Body body_of(const Mesh& mesh, const Stand& stand, KnownMeshes& known) {
  Body out = nowhere();
  if (mesh.triangles == nullptr || mesh.triangles->triangles.empty()) return out;
  const auto [found, fresh] = known.try_emplace(mesh.triangles.get());
  if (fresh) found->second = box_of(*mesh.triangles);
  const MeshBox& box = found->second;
  for (int corner = 0; corner < 8; ++corner)
    widen(out, mesh_point(stand, {(corner & 1) != 0 ? box.high.x : box.low.x, (corner & 2) != 0 ? box.high.y : box.low.y,
                                  (corner & 4) != 0 ? box.high.z : box.low.z}));
  const auto& first = mesh.triangles->vertices[static_cast<std::size_t>(mesh.triangles->triangles[0][0])];
  const Vec corner = mesh_point(stand, {static_cast<double>(first[0]), static_cast<double>(first[1]), static_cast<double>(first[2])});
  out.print = {static_cast<double>(mesh.triangles->triangles.size()), static_cast<double>(mesh.triangles->vertices.size()), corner.x,
               corner.y, corner.z};
  return out;
}

/// A plane is where its normal, which has no sign, and its distance from zero say.
Body body_of(const shape::Plane& plane, const Stand& stand) {
  Vec normal = shape::normalized(stand.motion.turn * plane.normal);
  const double first = normal.x != 0 ? normal.x : normal.y != 0 ? normal.y : normal.z;
  if (first < 0) normal = -1 * normal;
  return {true,
          {-infinity, -infinity, -infinity},
          {infinity, infinity, infinity},
          {normal.x, normal.y, normal.z, shape::dot(normal, stand.to_world(plane.point))}};
}

template <class Shape>
Body body_of(const Shape& placed, const Stand& stand) {
  Body out;
  const auto span = [&](const Vec& along) {
    const shape::Span here = span_along(placed, shape::back(stand.motion.turn, along));
    const double shift = shape::dot(along, stand.motion.shift);
    return shape::Span{here.low + shift, here.high + shift};
  };
  for (int k = 0; k < 3; ++k) {
    const shape::Span one = span(axes[k]);
    out.low[k] = one.low, out.high[k] = one.high;
  }
  for (std::size_t k = 0; k < some_directions().size(); ++k) {
    const shape::Span one = span(some_directions()[k]);
    out.print[2 * k] = one.low, out.print[2 * k + 1] = one.high;
  }
  return out;
}

/// Solid angle of a triangle, whose corners are as seen from the point, over 4π (Van Oosterom and Strackee).
double solid_angle(const Vec& a, const Vec& b, const Vec& c) {
  const double la = shape::length(a), lb = shape::length(b), lc = shape::length(c);
  const double below = la * lb * lc + shape::dot(a, b) * lc + shape::dot(b, c) * la + shape::dot(c, a) * lb;
  return std::atan2(shape::dot(a, shape::cross(b, c)), below) / base::two_pi;
}

}  // namespace

std::vector<Body> bodies_at(const Scene& scene, double time_s) {
  std::vector<Body> out;
  KnownMeshes known;
  for (const Object& object : scene.objects)
    with_shape(shape::Shapes{}, object.shape, [&]<class Shape, class Said>(shape::List<Shape>, const Said& said) {
      const Stand stand = stand_of<Shape>(object, said, time_s);
      if constexpr (shape::many_of<Shape>)
        out.push_back(body_of(said, stand, known));
      else
        out.push_back(body_of(Shape::placed(said, stand.at), stand));
    });
  return out;
}

std::optional<bool> is_inside(const Object& object, double time_s, const Vec& point) {
  std::optional<bool> out;
  with_shape(shape::Shapes{}, object.shape, [&]<class Shape, class Said>(shape::List<Shape>, const Said& said) {
    if constexpr (Shape::closed) {
      const Stand stand = stand_of<Shape>(object, said, time_s);
      out = inside(Shape::placed(said, stand.at), stand.from_world(point));
    }
  });
  return out;
}

double surrounding(const Object& object, double time_s, const Vec& point) {
  const auto* mesh = std::get_if<Mesh>(&object.shape);
  if (mesh == nullptr || mesh->triangles == nullptr) return 0;
  const Stand stand = stand_of<shape::Mesh>(object, *mesh, time_s);
  const Vec seen = shape::back(stand.at.turn, stand.from_world(point) - stand.at.shift);
  const auto corner = [&](std::int32_t i) {
    const auto& v = mesh->triangles->vertices[static_cast<std::size_t>(i)];
    return Vec{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])} - seen;
  };
  double sum = 0;
  for (const auto& triangle : mesh->triangles->triangles) sum += solid_angle(corner(triangle[0]), corner(triangle[1]), corner(triangle[2]));
  return sum;
}

std::vector<Vec> outermost(const Object& object, const Body& body) {
  const Vec middle = 0.5 * (body.low + body.high), half = 0.5 * (body.high - body.low);
  const bool round = std::holds_alternative<Sphere>(object.shape);
  std::vector<Vec> out;
  for (int corner = 0; corner < 8; ++corner) {
    const double share = round ? 1 / std::sqrt(3.0) : 1;
    out.push_back(middle + share * Vec{(corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                                       (corner & 4) != 0 ? half.z : -half.z});
  }
  for (int k = 0; round && k < 3; ++k) out.push_back(middle + half[k] * axes[k]), out.push_back(middle - half[k] * axes[k]);
  return out;
}

}  // namespace tofray::analysis
