// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "scene/motion.h"

/// Where a scene's objects are at a time, and how large.
namespace tofray::analysis {

using scene::Vec;

/// What an object takes of the world.
struct Body {
  bool endless = false;
  Vec low{}, high{};  ///< its box; infinite where it has no end
  /// Whether it is the same as another of the same type: how far it reaches along some directions; of a mesh, its size and first corner.
  std::array<double, 8> print{};
};

/// All objects of a scene at a time. What a mesh takes is found once for all objects that show it.
std::vector<Body> bodies_at(const Scene& scene, double time_s);

/// Whether a point of the world is inside a closed object at a time; nothing where the object is not closed, or a mesh.
std::optional<bool> is_inside(const Object& object, double time_s, const Vec& point);

/// How often the triangles of a mesh surround a point of the world, by their solid angle over 4π: 1 or −1 inside a closed one, 0 outside.
double surrounding(const Object& object, double time_s, const Vec& point);

/// Points of a thing that is all inside a convex one if they are.
std::vector<Vec> outermost(const Object& object, const Body& body);

}  // namespace tofray::analysis
