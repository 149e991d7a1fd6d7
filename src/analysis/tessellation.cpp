// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/tessellation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
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

/// What a shape says its triangles to (shape/list.h).
class Triangles {
 public:
  Corners all;
  double patch_m;  ///< half the side of the square that stands for what has no end

  Triangles(double time_s, double patch) : patch_m(patch), time_s_(time_s) {}

  void triangle(const Vec& a, const Vec& b, const Vec& c) {
    std::array<float, 9> one{};
    const Vec corners[] = {a, b, c};
    for (std::size_t i = 0; i < 9; ++i) one[i] = static_cast<float>(corners[i / 3][static_cast<int>(i % 3)]);
    all.push_back(one);
  }
  void quad(const Vec& a, const Vec& b, const Vec& c, const Vec& d) { triangle(a, b, c), triangle(a, c, d); }

  /// A box from `low` to `high`, seen from outside.
  void box(const Vec& low, const Vec& high) {
    const auto at = [&](int x, int y, int z) { return Vec{x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z}; };
    quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
    quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
    quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
    quad(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
    quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
    quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
  }

  /// The next corner of an outline: how far from the axis, and how far along it.
  void corner(double radius, double along) { outline_.push_back({radius, along}); }
  /// A quarter or half circle as the outline's next part. @param from, to  in quarters of a turn from the axis's foot
  void arc(double radius, double middle, int from, int to) {
    const int steps = sides / 4 * (to - from);
    for (int i = 0; i <= steps; ++i) {
      const double angle = base::two_pi * (static_cast<double>(from) / 4 + static_cast<double>(i) / sides);
      const bool on_axis = (i == 0 && from == 0) || (i == steps && to == 2);
      corner(on_axis ? 0 : radius * std::sin(angle), middle - radius * std::cos(angle));
    }
  }
  /// What the outline makes when it is turned about an axis, its first corner lowest. The next outline begins anew.
  void turn_about(const Vec& along) {
    const Vec axis = shape::normalized(along), u = shape::way_across({0, 0, 0}, axis), v = shape::cross(axis, u);
    const auto at = [&](const Corner& one, int side) {
      const double angle = base::two_pi * (side % sides) / sides;
      return one.radius * (std::cos(angle) * u + std::sin(angle) * v) + one.along * axis;
    };
    for (std::size_t i = 0; i + 1 < outline_.size(); ++i) {
      const Corner &low = outline_[i], &high = outline_[i + 1];
      for (int side = 0; side < sides; ++side) {
        if (low.radius > 0) triangle(at(low, side), at(low, side + 1), at(high, side));
        if (high.radius > 0) triangle(at(low, side + 1), at(high, side + 1), at(high, side));
      }
    }
    outline_.clear();
  }

  /// A mesh as it is at the time.
  void mesh(const Mesh& said) {
    if (said.triangles == nullptr) return;
    std::vector<std::array<float, 3>> moved, normals;
    if (said.motion != nullptr) said.motion->at(time_s_, moved, normals);
    const auto& vertices = said.motion != nullptr ? moved : said.triangles->vertices;
    all.reserve(said.triangles->triangles.size());
    for (const auto& corners : said.triangles->triangles) {
      std::array<float, 9> one{};
      for (std::size_t i = 0; i < 9; ++i) one[i] = vertices[static_cast<std::size_t>(corners[i / 3])][i % 3];
      all.push_back(one);
    }
  }

 private:
  struct Corner {
    double radius, along;
  };
  std::vector<Corner> outline_;
  double time_s_;
};

/// The box that holds triangles.
Corners box_of(const Corners& corners) {
  Vec low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const auto& one : corners)
    for (std::size_t i = 0; i < 9; ++i) {
      const auto k = static_cast<int>(i % 3);
      low[k] = std::min(low[k], static_cast<double>(one[i])), high[k] = std::max(high[k], static_cast<double>(one[i]));
    }
  Triangles out(0, 0);
  if (!corners.empty()) out.box(low, high);
  return out.all;
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
  Triangles out(time_s, patch_m);
  with_shape(shape::Shapes{}, object.shape,
             [&]<class Shape, class Said>(shape::List<Shape>, const Said& said) { Shape::tessellate(said, out); });
  return std::move(out.all);
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
