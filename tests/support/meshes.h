// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "support/rays.h"

namespace tofray::test {

/// A closed mesh; triangles turn to the left seen from outside.
struct ClosedMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;

  /// As seen from one point.
  [[nodiscard]] Seen seen(const Vec3& origin) const {
    Seen out;
    for (const auto& t : triangles) out.add(shape::Triangle{{vec(at(t[0])), vec(at(t[1])), vec(at(t[2]))}}, origin);
    return out;
  }
  [[nodiscard]] const Vec3& at(int i) const { return vertices[static_cast<std::size_t>(i)]; }
};

/// The unit icosahedron, each triangle cut into four `cuts` times, vertices on the unit sphere: 20·4^cuts triangles.
inline ClosedMesh icosphere(int cuts) {
  using namespace base;
  const double g = 0.5 * (1 + std::sqrt(5.0));
  ClosedMesh mesh{{{-1, g, 0},
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
  for (Vec3& v : mesh.vertices) v = normalized(v);
  for (int cut = 0; cut < cuts; ++cut) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [found, made] = middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(mesh.vertices.size()));
      if (made) mesh.vertices.push_back(normalized(mesh.at(a) + mesh.at(b)));
      return found->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& t : mesh.triangles) {
      const int ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], ab, ca}, {t[1], bc, ab}, {t[2], ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  return mesh;
}

/// A closed mesh as users have it, in single precision.
inline TriangleMesh single(const ClosedMesh& mesh) {
  TriangleMesh out;
  for (const Vec3& v : mesh.vertices)
    out.vertices.push_back({static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])});
  for (const auto& t : mesh.triangles) out.triangles.push_back({t[0], t[1], t[2]});
  return out;
}

inline Mesh shared(TriangleMesh triangles) {
  Mesh out;
  out.triangles = std::make_shared<const TriangleMesh>(std::move(triangles));
  return out;
}

}  // namespace tofray::test
