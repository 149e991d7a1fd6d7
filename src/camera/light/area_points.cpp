// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/light/area_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/constants.h"
#include "num/setup_math.h"

namespace tofray::camera {

using namespace base;
namespace setup = num::setup;

namespace {

/// Columns of equal area, or rows, as many as points: each moves into the middle of one of them, in the order in which they stand.
/// @param middle_of  where the share of the area is that lies before it
template <class MiddleOf>
void into_columns(std::vector<Vec3>& points, std::size_t axis, const MiddleOf& middle_of) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a][axis] < points[b][axis]; });
  const auto count = static_cast<double>(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) points[order[i]][axis] = middle_of((static_cast<double>(i) + 0.5) / count);
}

/// A cell of equal area for each point, as near to squares as rows of them can be. Within its row a point stands one step higher than the
/// next, within its cell one step further right than in the row before.                                   [theory: rectangle-light]
std::vector<Vec3> in_rectangle(double width, double height, int points) {
  int rows = 1;
  while (rows < points && rows * (rows + 1) < points * height / width) ++rows;
  std::vector<Vec3> out;
  for (int r = 0; r < rows; ++r) {
    const int before = r * points / rows, count = (r + 1) * points / rows - before;
    for (int i = 0; i < count; ++i) {
      out.push_back({(i + (r + 0.5) / rows) / count, height * ((before + count - i - 0.5) / points - 0.5), 0});
    }
  }
  into_columns(out, 0, [&](double share) { return width * (share - 0.5); });
  return out;
}

/// Where the line x = t lies that has this share of the disk x² + y² <= 1 on its left.
double line_of(double share) {
  const double beyond = pi * std::abs(share - 0.5);  // t·√(1 − t²) + asin t
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double t = 0.5 * (low + high);
    (t * std::sqrt(1 - t * t) + setup::asin(t) < beyond ? low : high) = t;
  }
  return share < 0.5 ? -low : low;
}

/// A spiral of pairs on either side of the middle, as far out as their share of the area is, half a golden turn from pair to pair; then
/// each point moves into a column and a row of its own.                                                        [theory: disk-light]
std::vector<Vec3> in_disk(double radius, int points) {
  constexpr double first_turn = 0.505;  // with it no point of 1 to 64 leaves the disk by more than 0.2 % where it moves
  const double half_golden_turn = pi * (std::sqrt(5.0) - 1) / 2;
  std::vector<Vec3> out;
  if (points % 2 == 1) out.push_back({0, 0, 0});
  for (int k = 0; k < points / 2; ++k) {
    const double away = std::sqrt((2 * k + 1.0 + points % 2) / points), turn = first_turn + k * half_golden_turn;
    const Vec3 one{away * setup::cos(turn), away * setup::sin(turn), 0};
    out.push_back(one), out.push_back(-1.0 * one);
  }
  into_columns(out, 0, line_of);
  into_columns(out, 1, line_of);
  for (Vec3& one : out) one = (radius / std::max(1.0, length(one))) * one;
  return out;
}

}  // namespace

std::vector<Vec3> points_of(const Area& area) {
  switch (area.kind) {
    case Area::Kind::disk: return in_disk(area.radius_m, area.points);
    case Area::Kind::rectangle: return in_rectangle(area.width_m, area.height_m, area.points);
    case Area::Kind::none: break;
  }
  return {{0, 0, 0}};
}

}  // namespace tofray::camera
