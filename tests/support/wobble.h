// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <memory>

#include "support/meshes.h"
#include "tofray/scene.h"

namespace tofray::test {

/// A mesh whose vertices go to and fro, each at its own phase; its normals stay.
class Wobble : public MeshMotion {
 public:
  Wobble(std::shared_ptr<const TriangleMesh> mesh, double size, double rate_hz) : mesh_(std::move(mesh)), size_(size), rate_hz_(rate_hz) {}
  void at(double time_s, std::vector<std::array<float, 3>>& vertices, std::vector<std::array<float, 3>>& normals) const override {
    vertices = mesh_->vertices, normals = mesh_->normals;
    for (auto& v : vertices) {
      const double phase = 7 * static_cast<double>(v[0]) + 5 * static_cast<double>(v[1]);
      v[2] += static_cast<float>(size_ * std::sin(6.283185307179586 * rate_hz_ * time_s + phase));
    }
  }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  double size_, rate_hz_;
};

/// Gives a mesh that motion.
inline Mesh wobbling(Mesh mesh, double size, double rate_hz) {
  mesh.motion = std::make_shared<Wobble>(mesh.triangles, size, rate_hz);
  return mesh;
}

}  // namespace tofray::test
