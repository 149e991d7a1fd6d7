// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/vector_maps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "brdf/ggx.h"

namespace tofray::scene {

namespace {

/// Ggx::lobe_reflectivity(), which is linear in F_0, at any α: between 1,024 steps of √α of its 2,000 terms.
class Lobes {
 public:
  Lobes() {
    for (std::size_t i = 0; i <= steps; ++i) {
      const double root = static_cast<double>(i) / steps, alpha = std::max(root * root, 1e-3);
      none_[i] = brdf::Ggx::lobe_reflectivity(alpha, 0), all_[i] = brdf::Ggx::lobe_reflectivity(alpha, 1);
    }
  }
  [[nodiscard]] double at(double alpha, double f0) const {
    const double place = std::sqrt(alpha) * steps;
    const std::size_t i = std::min(static_cast<std::size_t>(place), steps - 1);
    const double beyond = place - static_cast<double>(i);
    const auto mean = [&](const std::array<double, steps + 1>& of) { return of[i] + beyond * (of[i + 1] - of[i]); };
    return (1 - f0) * mean(none_) + f0 * mean(all_);
  }

 private:
  static constexpr std::size_t steps = 1024;
  std::array<double, steps + 1> none_{}, all_{};
};

/// Pictures of `count` numbers, which numbers_of(texel) has of each texel.
template <std::size_t count, class NumbersOf>
Levels taken_apart(const VectorMap& map, const ReflectivityMap* opacity, const NumbersOf& numbers_of) {
  std::array<std::vector<float>, count> planes;
  for (auto& plane : planes) plane.reserve(map.values.size());
  for (const auto& texel : map.values) {
    const std::array<float, count> numbers = numbers_of(texel);
    for (std::size_t k = 0; k < count; ++k) planes[k].push_back(numbers[k]);
  }
  Levels out;
  for (auto& plane : planes)
    out.push_back(std::make_unique<const MapLevels>(std::move(plane), map.width, map.height, map.wrap_u, map.wrap_v, opacity));
  return out;
}

}  // namespace

Levels levels_of_normals(const VectorMap& normals, const ReflectivityMap* opacity) {
  return taken_apart<3>(normals, opacity, [](std::array<float, 3> n) {
    const double x = static_cast<double>(n[0]), y = static_cast<double>(n[1]), z = static_cast<double>(n[2]);
    const double length = std::sqrt(x * x + y * y + z * z);
    return std::array<float, 3>{static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
  });
}

Levels levels_of_finish(const VectorMap& finish, const ReflectivityMap* opacity) {
  static const Lobes lobes;
  return taken_apart<5>(finish, opacity, [](const std::array<float, 3>& texel) {
    const double f0 = static_cast<double>(texel[1]), alpha = static_cast<double>(texel[2]);
    const brdf::MaterialView view = brdf::Ggx::view(static_cast<double>(texel[0]), f0, alpha, lobes.at(alpha, f0));
    return std::array<float, 5>{view.number[0], view.number[1], view.number[2], view.reflectivity, view.matt};
  });
}

}  // namespace tofray::scene
