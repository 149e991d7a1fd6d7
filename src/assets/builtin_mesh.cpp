// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "assets/builtin_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/vec.h"

namespace tofray::assets {

namespace {

using base::operator+;
using base::operator*;

/// Chebyshev's polynomial of degree 5: between −1 and 1 it goes up and down as a cosine does, and is the same on every machine.
double wave(double x) { return ((16 * x * x - 20) * x * x + 5) * x; }

std::array<float, 3> single(const Vec3& p) { return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])}; }

using Corners = std::array<std::int32_t, 3>;

/// Points on the unit sphere.
struct Sphere {
  std::vector<Vec3> points;
  std::vector<Corners> triangles;
};

Sphere icosahedron() {
  const double g = 0.5 * (1 + std::sqrt(5.0));
  Sphere out{{{-1, g, 0},
              {1, g, 0},
              {-1, -g, 0},
              {1, -g, 0},
              {0, -1, g},
              {0, 1, g},
              {0, -1, -g},
              {0, 1, -g},
              {g, 0, -1},
              {g, 0, 1},
              {-g, 0, -1},
              {-g, 0, 1}},
             {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
              {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  for (Vec3& p : out.points) p = base::normalized(p);
  return out;
}

/// Each triangle in four, by the middles of its edges.
void refine(Sphere& sphere) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [known, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(sphere.points.size()));
    if (fresh) {
      const Vec3 sum = sphere.points[static_cast<std::size_t>(a)] + sphere.points[static_cast<std::size_t>(b)];
      sphere.points.push_back(base::normalized(sum));
    }
    return known->second;
  };
  std::vector<Corners> finer;
  finer.reserve(4 * sphere.triangles.size());
  for (const auto& [a, b, c] : sphere.triangles) {
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  sphere.triangles = std::move(finer);
}

}  // namespace

TriangleMesh bumpy_ball(int cuts) {
  Sphere sphere = icosahedron();
  for (int i = 0; i < cuts; ++i) refine(sphere);
  TriangleMesh out{{}, std::move(sphere.triangles)};
  out.vertices.reserve(sphere.points.size());
  for (const Vec3& p : sphere.points) out.vertices.push_back(single(0.5 * (1 + 0.08 * wave(p[0]) * wave(p[1]) * wave(p[2])) * p));
  return out;
}

TriangleMesh wavy_floor(int cells) {
  constexpr double half_m = 2, height_m = 0.02;
  TriangleMesh out;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const double x = 2.0 * i / cells - 1, z = 2.0 * j / cells - 1;
      out.vertices.push_back(single({half_m * x, height_m * wave(x) * wave(z), half_m * z}));
    }
  for (std::int32_t j = 0; j < cells; ++j)
    for (std::int32_t i = 0; i < cells; ++i) {
      const std::int32_t a = j * (cells + 1) + i, below = a + cells + 1;
      out.triangles.push_back({a, below, a + 1});
      out.triangles.push_back({a + 1, below, below + 1});
    }
  return out;
}

std::vector<std::string> builtin_mesh_names() { return {"bumpy-ball", "wavy-floor"}; }

std::optional<TriangleMesh> builtin_mesh(std::string_view name) {
  if (name == "bumpy-ball") return bumpy_ball(6);
  if (name == "wavy-floor") return wavy_floor(100);
  return std::nullopt;
}

}  // namespace tofray::assets
