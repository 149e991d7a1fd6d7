// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "gltf/parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/vec.h"

namespace tofray::gltf {
namespace {

using Triangle = std::array<std::int32_t, 3>;

/// Calls `take` with the three vertices of each triangle, turned as the first: strips turn every other one round.
template <class Take>
void for_each_triangle(const Primitive& primitive, const Take& take) {
  const auto corner = [&](std::size_t i) { return primitive.indices ? (*primitive.indices)[i] : static_cast<std::uint32_t>(i); };
  for (std::size_t i = 0; i < primitive.triangles(); ++i) {
    switch (primitive.mode) {
      case Primitive::Mode::triangles: take(corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)); break;
      case Primitive::Mode::strip: take(corner(i), corner(i + 1 + i % 2), corner(i + 2 - i % 2)); break;
      case Primitive::Mode::fan: take(corner(i + 1), corner(i + 2), corner(0)); break;
    }
  }
}

Vec3 vector_at(const Floats& all, std::size_t i) {
  const float* at = all->data() + 3 * i;
  return {at[0], at[1], at[2]};
}

/// The nearest float; infinity beyond its range.
float to_float(double value) {
  constexpr double most = std::numeric_limits<float>::max();
  return std::abs(value) <= most ? static_cast<float>(value) : std::numeric_limits<float>::infinity();
}

/// Takes the vertices of one primitive into the world.
class Placer {
 public:
  /// @param skin  the matrices of its joints, or nullptr
  Placer(const Primitive& primitive, const std::vector<double>& weights, const Matrix& world, const std::vector<Matrix>* skin)
      : primitive_(primitive), weights_(weights), world_(world), skin_(skin), world_mirrors_(determinant(world) < 0) {}

  [[nodiscard]] Vec3 position(std::size_t i) const {
    const Vec3 at = morphed(i, primitive_.positions, &MorphTarget::positions);
    return point(skin_ != nullptr ? blended(i) : world_, at);
  }

  /// 0 where there is no direction.
  [[nodiscard]] std::array<float, 3> normal(std::size_t i) const {
    const Matrix m = skin_ != nullptr ? blended(i) : world_;
    using base::operator*;
    const Vec3 n = cofactors_of_unit(m) * morphed(i, primitive_.normals, &MorphTarget::normals);
    const double size = base::length(n) * (determinant(m) < 0 ? -1 : 1);
    if (!(std::abs(size) > 0) || !std::isfinite(size)) return {0, 0, 0};
    return {static_cast<float>(n[0] / size), static_cast<float>(n[1] / size), static_cast<float>(n[2] / size)};
  }

  /// Whether what is at this vertex is turned inside out.
  [[nodiscard]] bool mirrors(std::size_t i) const { return skin_ != nullptr ? determinant(blended(i)) < 0 : world_mirrors_; }

 private:
  [[nodiscard]] Vec3 morphed(std::size_t i, const Floats& all, Floats MorphTarget::*of) const {
    using base::operator*, base::operator+;
    Vec3 sum = vector_at(all, i);
    for (std::size_t k = 0; k < primitive_.targets.size(); ++k)
      if (const Floats& more = primitive_.targets[k].*of; more && weights_[k] != 0) sum = sum + weights_[k] * vector_at(more, i);
    return sum;
  }

  /// The mean of the joints' matrices; a vertex without weights follows its first joint.
  [[nodiscard]] Matrix blended(std::size_t i) const {
    const float* weight = primitive_.joint_weights->data() + 4 * i;
    const std::uint32_t* joint = primitive_.joints->data() + 4 * i;
    const double sum = static_cast<double>(weight[0]) + weight[1] + weight[2] + weight[3];
    if (sum == 0) return (*skin_)[joint[0]];
    Matrix out{};
    for (std::size_t k = 0; k < 4; ++k) {
      if (weight[k] == 0) continue;
      const Matrix& m = (*skin_)[joint[k]];
      for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column) out[row][column] += weight[k] / sum * m[row][column];
    }
    return out;
  }

  /// The cofactors but for a factor: of the matrix over its largest number, so that small scales stay within the range of double.
  [[nodiscard]] static base::Mat3 cofactors_of_unit(Matrix m) {
    double largest = 0;
    for (const auto& row : m)
      for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(row[k]));
    if (largest > 0)
      for (auto& row : m)
        for (double& x : row) x /= largest;
    return cofactors(m);
  }

  const Primitive& primitive_;
  const std::vector<double>& weights_;
  const Matrix& world_;
  const std::vector<Matrix>* skin_;
  const bool world_mirrors_;
};

/// Makes the parts of a model, one after the other.
class PartMaker {
 public:
  PartMaker(const Model& model, const Pose& pose) : model_(model), pose_(pose), skins_(model.skins.size()) {}

  /// @param world  of the node, or of one of its instances
  void add(int node, const Matrix& world, const Primitive& primitive, std::vector<Part>& parts) {
    const auto i = static_cast<std::size_t>(node);
    const int skin = model_.nodes[i].skin;
    const Placer placer(primitive, pose_.weights[i], world, skin == none ? nullptr : &matrices(skin));
    Part& part = parts.emplace_back();
    part.node = node, part.material = primitive.material;
    number_vertices(primitive, placer, part);
    place_vertices(primitive, placer, part);
    drop_not_finite(part);
    for (const std::uint32_t vertex : used_) place_[vertex] = -1;
  }

 private:
  /// From a skin's own frame into the world, by joint.
  const std::vector<Matrix>& matrices(int skin) {
    std::vector<Matrix>& out = skins_[static_cast<std::size_t>(skin)];
    const Skin& one = model_.skins[static_cast<std::size_t>(skin)];
    if (out.empty())
      for (std::size_t i = 0; i < one.joints.size(); ++i)
        out.push_back(product(pose_.world[static_cast<std::size_t>(one.joints[i])], one.inverse_bind[i]));
    return out;
  }

  std::int32_t number(std::uint32_t vertex) {
    std::int32_t& place = place_[vertex];
    if (place < 0) {
      place = static_cast<std::int32_t>(used_.size());
      used_.push_back(vertex);
    }
    return place;
  }

  /// Triangles, and which vertices they use.
  void number_vertices(const Primitive& primitive, const Placer& placer, Part& part) {
    used_.clear();
    if (place_.size() < primitive.vertices()) place_.resize(primitive.vertices(), -1);
    for_each_triangle(primitive, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      if (a == b || b == c || a == c) return;
      const std::int32_t first = number(a), second = number(b), third = number(c);
      part.mesh.triangles.push_back(placer.mirrors(a) ? Triangle{first, third, second} : Triangle{first, second, third});
    });
  }

  void place_vertices(const Primitive& primitive, const Placer& placer, Part& part) const {
    for (const std::uint32_t i : used_) {
      const Vec3 at = placer.position(i);
      part.mesh.vertices.push_back({to_float(at[0]), to_float(at[1]), to_float(at[2])});
      if (primitive.normals) part.normals.push_back(placer.normal(i));
      for (std::size_t set = 0; set < 2; ++set)
        if (const Floats& all = primitive.texcoords[set]) part.texcoords[set].push_back({(*all)[2 * i], (*all)[2 * i + 1]});
      if (primitive.colors) {
        const float* color = primitive.colors->data() + primitive.color_width * i;
        part.colors.push_back({color[0], color[1], color[2], primitive.color_width == 4 ? color[3] : 1.F});
      }
    }
  }

  /// Vertices keep their numbers: one that is not finite is at 0, and no triangle has it.
  static void drop_not_finite(Part& part) {
    std::vector<std::array<float, 3>>& vertices = part.mesh.vertices;
    auto& triangles = part.mesh.triangles;
    std::vector<bool> finite;
    for (auto& v : vertices) {
      finite.push_back(std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]));
      if (!finite.back()) v = {0, 0, 0};
    }
    part.not_finite = std::erase_if(triangles, [&](const Triangle& triangle) {
      return !std::all_of(triangle.begin(), triangle.end(), [&](std::int32_t i) { return finite[static_cast<std::size_t>(i)]; });
    });
  }

  const Model& model_;
  const Pose& pose_;
  std::vector<std::vector<Matrix>> skins_;
  std::vector<std::int32_t> place_;  ///< of the primitive's vertices: which of the part's each is, -1 where none
  std::vector<std::uint32_t> used_;  ///< of the part's vertices: which of the primitive's each is
};

}  // namespace

std::vector<Part> parts(const Model& model, const Pose& pose) {
  std::vector<Part> out;
  PartMaker maker(model, pose);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.mesh == none || pose.in_scene[i] == 0) continue;
    for (std::size_t k = 0; k < node.shown(); ++k) {
      const Matrix world = node.instances ? product(pose.world[i], (*node.instances)[k]) : pose.world[i];
      for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives)
        maker.add(static_cast<int>(i), world, primitive, out);
    }
  }
  return out;
}

}  // namespace tofray::gltf
