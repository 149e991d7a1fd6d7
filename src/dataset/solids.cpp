// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dataset/solids.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "base/rotation.h"
#include "num/setup_math.h"
#include "shape/list.h"

namespace tofray::dataset {

namespace {

constexpr Vec world_axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// Calls look(shape::List<Shape>, said) with what the object is.
template <class Look, class... Shape, class... Said>
void look_at(shape::List<Shape...>, const std::variant<Said...>& said, const Look& look) {
  const auto one = [&]<class S, class T>(shape::List<S> type, const T* is) {
    if (is != nullptr) look(type, *is);
  };
  (one(shape::List<Shape>{}, std::get_if<Said>(&said)), ...);
}

std::optional<OwnBox> mesh_box(const Mesh& mesh, const Mat& turn) {
  if (mesh.triangles == nullptr || mesh.triangles->triangles.empty()) return {};
  constexpr double far = std::numeric_limits<double>::infinity();
  OwnBox out{{far, far, far}, {-far, -far, -far}, {}};
  for (const auto& triangle : mesh.triangles->triangles)
    for (const std::int32_t corner : triangle) {
      const auto& v = mesh.triangles->vertices[static_cast<std::size_t>(corner)];
      const Vec p = turn * Vec{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
      for (int k = 0; k < 3; ++k) out.low[k] = std::min(out.low[k], p[k]), out.high[k] = std::max(out.high[k], p[k]);
    }
  return out;
}

/// Any direction across another one.
Vec across(const Vec& a) {
  const double x = std::abs(a.x), y = std::abs(a.y), z = std::abs(a.z);
  const Vec other = x <= y && x <= z ? Vec{1, 0, 0} : y <= z ? Vec{0, 1, 0} : Vec{0, 0, 1};
  return shape::normalized(other - shape::dot(other, a) * a);
}

Surface flat(const Vec& middle, const Vec& normal, const Vec& up) {
  Surface out;
  out.middle = middle, out.normal = shape::dot(normal, up) < 0 ? -1 * normal : normal;
  out.x = across(out.normal), out.y = shape::cross(out.normal, out.x);
  return out;
}

double reach(const Solid& solid, const Vec& along) { return shape::reach_of_box(solid.axes, solid.half, along); }

}  // namespace

Mat turn_about(const Vec& a, double angle) {
  const double c = num::setup::cos(angle), s = num::setup::sin(angle), d = 1 - c;
  return {{{c + d * a.x * a.x, d * a.x * a.y - s * a.z, d * a.x * a.z + s * a.y},
           {d * a.y * a.x + s * a.z, c + d * a.y * a.y, d * a.y * a.z - s * a.x},
           {d * a.z * a.x - s * a.y, d * a.z * a.y + s * a.x, c + d * a.z * a.z}}};
}

Mat matrix_of(const Rotation& rotation) {
  if (!rotation.quaternion)
    return rotation.angle_rad == 0 ? Solid{}.axes : turn_about(shape::normalized(vec(rotation.axis)), rotation.angle_rad);
  const base::Mat3 rows = base::matrix_of(*rotation.quaternion);
  return {{vec(rows[0]), vec(rows[1]), vec(rows[2])}};
}

Mat product(const Mat& a, const Mat& b) {
  const auto row = [&](const Vec& r) { return r.x * b.row[0] + r.y * b.row[1] + r.z * b.row[2]; };
  return {{row(a.row[0]), row(a.row[1]), row(a.row[2])}};
}

std::optional<OwnBox> own_box(const Object& object) {
  const Mat turn = matrix_of(object.rotation);
  std::optional<OwnBox> out;
  look_at(shape::Shapes{}, object.shape, [&]<class Shape, class Said>(shape::List<Shape>, const Said& said) {
    if constexpr (shape::many_of<Shape>) {
      out = mesh_box(said, turn);
    } else if constexpr (!std::is_same_v<Shape, shape::Plane>) {
      OwnBox box;
      box.about = Shape::center_of(said);
      const auto placed = Shape::placed(said, shape::Placement{turn, -1 * box.about});
      for (int k = 0; k < 3; ++k) {
        const shape::Span span = span_along(placed, world_axes[k]);
        box.low[k] = span.low, box.high[k] = span.high;
      }
      out = box;
    }
  });
  return out;
}

Solid solid_of(const Object& object, const OwnBox& box) {
  Solid out;
  out.center = 0.5 * (box.low + box.high) + box.about + vec(object.position), out.half = 0.5 * (box.high - box.low);
  return out;
}

std::optional<Surface> surface_of(const Object& object, const Vec& up) {
  const shape::Placement at{matrix_of(object.rotation), vec(object.position)};
  if (const auto* plane = std::get_if<Plane>(&object.shape)) {
    const shape::Plane placed = shape::Plane::placed(*plane, at);
    return flat(placed.point, shape::normalized(placed.normal), up);
  }
  if (const auto* disk = std::get_if<Disk>(&object.shape)) {
    const shape::Disk placed = shape::Disk::placed(*disk, at);
    Surface out = flat(placed.center, placed.normal, up);
    out.half_x = placed.radius, out.round = true;
    return out;
  }
  if (const auto* rectangle = std::get_if<Rectangle>(&object.shape)) {
    const shape::Rectangle placed = shape::Rectangle::placed(*rectangle, at);
    const Vec x = placed.corner[1] - placed.corner[0], y = placed.corner[3] - placed.corner[0];
    Surface out = flat(placed.corner[0] + 0.5 * x + 0.5 * y, shape::normalized(shape::cross(x, y)), up);
    out.x = shape::normalized(x), out.y = shape::normalized(y), out.half_x = 0.5 * shape::length(x), out.half_y = 0.5 * shape::length(y);
    return out;
  }
  if (const auto* box = std::get_if<Box>(&object.shape)) {
    const shape::Box placed = shape::Box::placed(*box, at);
    int k = 0;
    for (int i = 1; i < 3; ++i)
      if (std::abs(shape::dot(placed.axes.row[i], up)) > std::abs(shape::dot(placed.axes.row[k], up))) k = i;
    const Vec normal = shape::dot(placed.axes.row[k], up) < 0 ? -1 * placed.axes.row[k] : placed.axes.row[k];
    Surface out = flat(placed.center + placed.half[k] * normal, normal, up);
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    out.x = placed.axes.row[i], out.y = placed.axes.row[j], out.half_x = placed.half[i], out.half_y = placed.half[j];
    return out;
  }
  return {};
}

bool apart(const Solid& a, const Solid& b, double gap) {
  const Vec between = b.center - a.center;
  const auto tells = [&](const Vec& axis) {
    const double length = shape::length(axis);
    constexpr double parallel = 1e-9;
    return length > parallel && std::abs(shape::dot(between, axis)) >= reach(a, axis) + reach(b, axis) + gap * length;
  };
  for (const Vec& axis : a.axes.row)
    if (tells(axis)) return true;
  for (const Vec& axis : b.axes.row)
    if (tells(axis)) return true;
  for (const Vec& one : a.axes.row)
    for (const Vec& other : b.axes.row)
      if (tells(shape::cross(one, other))) return true;
  return false;
}

bool beyond(const Solid& solid, const Vec& point, const Vec& normal, double gap) {
  return shape::dot(solid.center - point, normal) - reach(solid, normal) >= gap;
}

Mat turn_between(const Vec& from, const Vec& to) {
  const double c = shape::dot(from, to);
  constexpr double opposite = -1 + 1e-12;
  if (c < opposite) {  // half a turn about anything across
    const Vec a = across(from);
    return {{{2 * a.x * a.x - 1, 2 * a.x * a.y, 2 * a.x * a.z},
             {2 * a.y * a.x, 2 * a.y * a.y - 1, 2 * a.y * a.z},
             {2 * a.z * a.x, 2 * a.z * a.y, 2 * a.z * a.z - 1}}};
  }
  // Rodrigues' formula with the sine in the axis: R = c·1 + [v]ₓ + v·vᵀ/(1 + c).
  const Vec v = shape::cross(from, to);
  const double f = 1 / (1 + c);
  return {{{c + f * v.x * v.x, f * v.x * v.y - v.z, f * v.x * v.z + v.y},
           {f * v.y * v.x + v.z, c + f * v.y * v.y, f * v.y * v.z - v.x},
           {f * v.z * v.x - v.y, f * v.z * v.y + v.x, c + f * v.z * v.z}}};
}

}  // namespace tofray::dataset
