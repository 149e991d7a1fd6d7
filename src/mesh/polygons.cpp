// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/polygons.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <utility>

#include "base/vec.h"
#include "mesh/ear_clipping.h"
#include "mesh/fan.h"

namespace tofray::mesh {
namespace {

using base::operator+;
using base::operator-;
using Outcome = EarClipping::Outcome;

constexpr double least_overhang = 1e-6;  // of a face's area

/// The corners of a face.
class Outline {
 public:
  Outline(const TriangleMesh& mesh, std::size_t first, std::size_t corners) : mesh_(mesh), first_(first), corners_(corners) {}
  [[nodiscard]] std::size_t corners() const { return corners_; }
  [[nodiscard]] Vec3 operator[](std::size_t corner) const {
    const auto& p = mesh_.vertices[static_cast<std::size_t>(corner_of_fan(mesh_.triangles, first_, corner))];
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }
  /// Twice the area, as a vector along the normal.
  [[nodiscard]] Vec3 area() const {
    const Vec3 a = (*this)[0];
    Vec3 sum{}, b = (*this)[1] - a;
    for (std::size_t i = 2; i < corners_; ++i) {
      const Vec3 c = (*this)[i] - a;
      sum = sum + base::cross(b, c);
      b = c;
    }
    return sum;
  }

 private:
  const TriangleMesh& mesh_;
  std::size_t first_, corners_;
};

/// The plane across the axis along which a face's normal is longest, in which its inner side lies to the left.
class Plane {
 public:
  explicit Plane(const Vec3& normal) {
    std::size_t across = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (std::abs(normal[k]) > std::abs(normal[across])) across = k;
    has_area_ = std::isfinite(normal[across]) && std::abs(normal[across]) > 0;
    first_ = (across + 1) % 3, second_ = (across + 2) % 3;
    if (normal[across] < 0) std::swap(first_, second_);
  }
  [[nodiscard]] bool has_area() const { return has_area_; }
  [[nodiscard]] Point point(const Vec3& p) const { return {p[first_], p[second_]}; }

 private:
  std::size_t first_ = 0, second_ = 1;
  bool has_area_ = false;
};

/// Whether the fan covers the face alone, to rounding: of its triangles those that turn the wrong way cover what the others cover beside
/// the face.
bool is_fan(const Outline& outline, const Plane& plane) {
  const Point a = plane.point(outline[0]);
  Point b = plane.point(outline[1]);
  double beside = 0, all = 0;
  for (std::size_t i = 2; i < outline.corners(); ++i) {
    const Point c = plane.point(outline[i]);
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    all += area;
    if (orientation(a, b, c) < 0) beside -= area;
    b = c;
  }
  return beside <= least_overhang * all;
}

}  // namespace

void Polygons::divide(TriangleMesh& mesh, const std::vector<CornerList*>& lists, std::vector<std::string>& notices) const {
  EarClipping clipping;
  std::vector<Point> flat;
  std::vector<Corners> triangles;
  std::int64_t work = most_work;
  std::size_t crossing = 0, too_long = 0;
  for (const Face& face : faces_) {
    const Outline outline(mesh, face.first, face.corners);
    const Plane plane(outline.area());
    if (!plane.has_area() || is_fan(outline, plane)) continue;
    Outcome outcome = Outcome::too_long;
    if (face.corners <= most_corners) {
      flat.clear();
      for (std::size_t i = 0; i < face.corners; ++i) flat.push_back(plane.point(outline[i]));
      outcome = clipping.divide(flat, work, triangles);
    }
    crossing += outcome == Outcome::crosses_itself ? 1 : 0, too_long += outcome == Outcome::too_long ? 1 : 0;
    if (outcome != Outcome::divided) continue;
    replace_fan(mesh.triangles, face.first, face.corners, triangles);
    for (CornerList* list : lists) list->replace(face.first, face.corners, triangles);
  }
  if (crossing > 0)
    notices.push_back(crossing == 1 ? "1 face crosses itself: what lies inside is a guess"
                                    : fmt::format("{} faces cross themselves: what lies inside is a guess", crossing));
  if (too_long > 0)
    notices.push_back(fmt::format("{} of too many corners to divide: what lies beside may be covered",
                                  too_long == 1 ? "1 face is" : fmt::format("{} faces are", too_long)));
}

}  // namespace tofray::mesh
