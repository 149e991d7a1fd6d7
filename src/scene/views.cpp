// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/frozen_scene.h"

namespace tofray::scene {

using namespace base;

namespace {

constexpr float everywhere = std::numeric_limits<float>::max();
constexpr Bounds unbounded{-everywhere, everywhere, -everywhere, everywhere};
/// Stands for an infinite inverse length: d·huge is finite for every direction, and 0·huge is 0.
constexpr double huge = 1e30;

float f(double a) { return static_cast<float>(a); }
void copy(const Vec3& from, float to[3]) { to[0] = f(from[0]), to[1] = f(from[1]), to[2] = f(from[2]); }
double inverse(double a) { return std::abs(a) < 1 / huge ? std::copysign(huge, a) : 1 / a; }

/// A little wider than computed, so that rounding in single precision never cuts a hit off.
Bounds widened(double x_min, double x_max, double y_min, double y_max) {
  const auto out = [](double a, double sign) { return f(a + sign * (1e-5 + 1e-5 * std::abs(a))); };
  return {out(x_min, -1), out(x_max, 1), out(y_min, -1), out(y_max, 1)};
}

Bounds bounds_of_points(const Vec3* points, int count) {
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  for (int i = 0; i < count; ++i) {
    if (points[i][2] < 1e-6 * length(points[i])) return unbounded;
    for (int k = 0; k < 2; ++k) {
      const double q = points[i][static_cast<std::size_t>(k)] / points[i][2];
      low[k] = std::min(low[k], q), high[k] = std::max(high[k], q);
    }
  }
  return widened(low[0], high[0], low[1], high[1]);
}

/// Tangent planes through the origin: q = x/z on them solves (c_x − q·c_z)² = R²(1 + q²).
Bounds bounds_of_sphere(const Vec3& c, double radius) {
  if (c[2] <= radius * 1.0001) return unbounded;
  double low[2], high[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const double square = c[2] * c[2] - radius * radius;
    const double root = radius * std::sqrt(c[k] * c[k] + square);
    low[k] = (c[k] * c[2] - root) / square, high[k] = (c[k] * c[2] + root) / square;
  }
  return widened(low[0], high[0], low[1], high[1]);
}

bool inside_sphere(const Placed::PlacedSphere& s, const Vec3& p) { return dot(s.center - p, s.center - p) < s.radius * s.radius; }
bool inside_box(const Placed::PlacedBox& b, const Vec3& p) {
  const Vec3 q = b.axes * (p - b.center);
  return std::abs(q[0]) < b.half[0] && std::abs(q[1]) < b.half[1] && std::abs(q[2]) < b.half[2];
}

SphereForm sphere_form(const Placed::PlacedSphere& s, const Vec3& origin, int facet) {
  const Vec3 c = s.center - origin;
  const bool inside = inside_sphere(s, origin);
  SphereForm form{};
  copy(c, form.c);
  form.radius_squared = f(s.radius * s.radius);
  form.inverse_power = f(inverse(dot(c, c) - s.radius * s.radius));
  form.facet = facet, form.object = s.object;
  form.inside = inside;
  form.own_blocks = inside != inside_sphere(s, {0, 0, 0});
  form.bounds = inside ? unbounded : bounds_of_sphere(c, s.radius);
  return form;
}

BoxForm box_form(const Placed::PlacedBox& b, const Vec3& origin, int facet) {
  BoxForm form{};
  const Vec3 center = b.axes * (b.center - origin);
  for (std::size_t k = 0; k < 3; ++k) {
    copy(b.axes[k], form.axis[k]);
    const double low = center[k] - b.half[k], high = center[k] + b.half[k];
    const bool between = low < 0 && high > 0;
    // Between the two sides the slab is entered at t = 0 (w = infinite) and left through the side that d points to.
    const double near_side = low >= 0 ? low : high, far_side = low >= 0 ? high : low;
    // Seen from the very plane of a side, the slab is where the axis points away from it: the sign does not come from a zero.
    form.near_scale[k] = between ? 0 : f(low >= 0 ? inverse(std::abs(low)) : -inverse(std::abs(high)));
    form.near_offset[k] = between ? f(huge) : 0;
    form.far_scale[k][0] = f(inverse(far_side));
    form.far_scale[k][1] = between ? f(inverse(near_side)) : form.far_scale[k][0];
  }
  Vec3 corners[8];
  for (int i = 0; i < 8; ++i) {
    const Vec3 q{(i & 1 ? 1 : -1) * b.half[0], (i & 2 ? 1 : -1) * b.half[1], (i & 4 ? 1 : -1) * b.half[2]};
    corners[i] = b.center + transposed(b.axes) * q - origin;
  }
  form.facet = facet, form.object = b.object;
  form.inside = inside_box(b, origin);
  form.own_blocks = (form.inside != 0) != inside_box(b, {0, 0, 0});
  form.bounds = form.inside ? unbounded : bounds_of_points(corners, 8);
  return form;
}

/// False where the triangle is seen edge-on: no ray hits it.
bool triangle_form(const Placed::PlacedTriangle& t, const Vec3& origin, int facet, TriangleForm& form) {
  const Vec3 v[3] = {t.vertices[0] - origin, t.vertices[1] - origin, t.vertices[2] - origin};
  const Vec3 normal = cross(v[1] - v[0], v[2] - v[0]);
  // The nearest vertex gives the plane's offset with the least cancellation.
  const int near = dot(v[0], v[0]) <= dot(v[1], v[1]) ? (dot(v[0], v[0]) <= dot(v[2], v[2]) ? 0 : 2) : (dot(v[1], v[1]) <= dot(v[2], v[2]) ? 1 : 2);
  const double offset = dot(normal, v[near]);
  const double side = offset < 0 ? -1 : 1;
  if (std::abs(offset) <= 1e-9 * length(normal) * length(v[near])) return false;
  copy((1 / offset) * normal, form.m);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 across = cross(v[(i + 1) % 3], v[(i + 2) % 3]);
    const double size = length(across);
    const Vec3 unit = (size > 0 ? side / size : 0) * across;
    copy(unit, form.edge[i]);
    for (std::size_t k = 0; k < 3; ++k) form.edge_low[i][k] = f(unit[k] - static_cast<double>(form.edge[i][k]));
  }
  form.facet = facet, form.object = t.object;
  form.bounds = bounds_of_points(v, 3);
  return true;
}

}  // namespace

View::View(const Placed& placed, const Vec3& origin, int facet_base) {
  int facet = facet_base;
  for (const auto& p : placed.planes) {
    const double distance = p.offset - dot(p.normal, origin);
    PlaneForm form{};
    copy(inverse(distance) * p.normal, form.m);
    form.horizon = f(1e-6 * std::abs(inverse(distance)));
    form.facet = facet++, form.object = p.object;
    if (std::abs(distance) > 1 / huge) planes_.push_back(form);
  }
  for (const auto& s : placed.spheres) spheres_.push_back(sphere_form(s, origin, facet++));
  for (const auto& b : placed.boxes) boxes_.push_back(box_form(b, origin, facet)), facet += 3;
  for (const auto& t : placed.triangles) {
    TriangleForm form{};
    if (triangle_form(t, origin, facet++, form)) triangles_.push_back(form);
  }
}

Forms View::forms() const {
  return {planes_.data(), spheres_.data(), boxes_.data(), triangles_.data(),
          static_cast<std::int32_t>(planes_.size()), static_cast<std::int32_t>(spheres_.size()),
          static_cast<std::int32_t>(boxes_.size()), static_cast<std::int32_t>(triangles_.size())};
}

ParallelView::ParallelView(const Placed& placed, const Vec3& s) {
  for (const auto& p : placed.planes) {
    const double along = dot(p.normal, s);
    if (std::abs(along) < 1e-6) continue;
    ParallelPlane form{};
    copy((-1 / along) * p.normal, form.m);
    form.c = f(p.offset / along), form.object = p.object;
    planes_.push_back(form);
  }
  for (const auto& sphere : placed.spheres) {
    ParallelSphere form{};
    copy(sphere.center, form.c);
    form.radius_squared = f(sphere.radius * sphere.radius), form.object = sphere.object;
    form.own_blocks = inside_sphere(sphere, {0, 0, 0});
    spheres_.push_back(form);
  }
  for (const auto& b : placed.boxes) {
    ParallelBox form{};
    const Vec3 direction = b.axes * s, center = b.axes * b.center;
    for (std::size_t k = 0; k < 3; ++k) {
      copy(b.axes[k], form.axis[k]);
      form.offset[k] = f(-center[k]), form.half[k] = f(b.half[k]), form.inverse[k] = f(inverse(direction[k]));
    }
    form.object = b.object, form.own_blocks = inside_box(b, {0, 0, 0});
    boxes_.push_back(form);
  }
  for (const auto& t : placed.triangles) {
    const auto& v = t.vertices;
    const Vec3 normal = cross(v[1] - v[0], v[2] - v[0]);
    const double along = dot(normal, s);
    if (std::abs(along) <= 1e-6 * length(normal)) continue;
    ParallelTriangle form{};
    copy((-1 / along) * normal, form.m);
    form.c = f(dot(normal, v[0]) / along), form.object = t.object;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 edge = v[(i + 1) % 3] - v[i];
      const Vec3 across = (along < 0 ? -1.0 : 1.0) * cross(s, edge);
      const Vec3 inward = (1 / length(edge)) * across;
      copy(inward, form.edge[i]);
      form.edge_offset[i] = f(-dot(inward, v[i]));
    }
    triangles_.push_back(form);
  }
}

ParallelForms ParallelView::forms() const {
  return {planes_.data(), spheres_.data(), boxes_.data(), triangles_.data(),
          static_cast<std::int32_t>(planes_.size()), static_cast<std::int32_t>(spheres_.size()),
          static_cast<std::int32_t>(boxes_.size()), static_cast<std::int32_t>(triangles_.size())};
}

}  // namespace tofray::scene
