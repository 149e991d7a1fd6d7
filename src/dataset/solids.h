// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <vector>

#include "shape/vector.h"
#include "tofray/scene.h"

/// What of an object takes room, as boxes and half spaces.
namespace tofray::dataset {

using shape::Mat;
using shape::Vec;

inline Vec vec(const Vec3& a) { return {a[0], a[1], a[2]}; }
/// As rows.
Mat matrix_of(const Rotation& rotation);
/// By the right-hand rule about an axis of unit length: Rodrigues' formula, as rows.
Mat turn_about(const Vec& axis, double angle);
/// First b, then a.
Mat product(const Mat& a, const Mat& b);

/// A box along three axes (rows).
struct Solid {
  Vec center{};
  Mat axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vec half{};
};

/// An object's box along the world's axes before it is shifted, about what it turns about.
struct OwnBox {
  Vec low{}, high{};
  Vec about{};  ///< where the scene's file puts that point
};
/// None of a plane, and of a mesh without triangles.
std::optional<OwnBox> own_box(const Object& object);
/// The object's box in the world.
Solid solid_of(const Object& object, const OwnBox& box);

/// What an object may lie on: a flat piece, and the side that is up.
struct Surface {
  Vec middle{}, normal{};
  Vec x{}, y{};                   ///< of unit length, along it
  double half_x = 0, half_y = 0;  ///< 0: without end
  bool round = false;             ///< half_x is its radius
};
/// Of a plane, rectangle, disk, or of a box its upper side; none of all else.
std::optional<Surface> surface_of(const Object& object, const Vec& up);

/// Whether two boxes are at least so far apart along one of the 15 axes that can tell them apart.
bool apart(const Solid& a, const Solid& b, double gap);
/// Whether a box is all on that side of a plane, and as far from it.
bool beyond(const Solid& solid, const Vec& point, const Vec& normal, double gap);

/// The shortest turn of one direction into another, as rows; both of unit length.
Mat turn_between(const Vec& from, const Vec& to);

}  // namespace tofray::dataset
