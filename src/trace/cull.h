// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/num.h"
#include "scene/forms.h"

/// Which forms a bundle of rays can meet at all. Culling never changes a result: it only leaves out what no ray of the bundle hits.
namespace tofray::trace {

/// Indices of the forms that are left; all of them where the list would overflow.
struct Picked {
  static constexpr int capacity = 1024;
  std::int32_t count;
  bool everything;
  std::uint16_t index[capacity];
  TOFRAY_FN int at(int i) const { return everything ? i : index[i]; }
};

/// A way through the forms that are left, in their order.
struct Walk {
  const Picked& picked;
  int i;
  TOFRAY_FN bool more() const { return i < picked.count; }
  TOFRAY_FN int index() const { return picked.at(i); }
  TOFRAY_FN void next() { ++i; }
};

/// What is left of all kinds. (Another type with these four walks can stand in its place.)
struct Culled {
  Picked planes, spheres, boxes, triangles;
  TOFRAY_FN bool empty() const { return planes.count + spheres.count + boxes.count + triangles.count == 0; }
  TOFRAY_FN Walk walk(const scene::PlaneForm*, int) const { return {planes, 0}; }
  TOFRAY_FN Walk walk(const scene::SphereForm*, int) const { return {spheres, 0}; }
  TOFRAY_FN Walk walk(const scene::BoxForm*, int) const { return {boxes, 0}; }
  TOFRAY_FN Walk walk(const scene::TriangleForm*, int) const { return {triangles, 0}; }
};

TOFRAY_FN bool overlap(const scene::Bounds& a, const scene::Bounds& b) {
  return (a.x_min <= b.x_max) & (a.x_max >= b.x_min) & (a.y_min <= b.y_max) & (a.y_max >= b.y_min);
}

/// False where no ray of the rectangle has d·m >= 0: the largest value of x·m0 + y·m1 + m2 over it, and room for rounding.
TOFRAY_FN bool reaches(const float* m, const scene::Bounds& r) {
  const float largest = (m[0] > 0 ? r.x_max : r.x_min) * m[0] + (m[1] > 0 ? r.y_max : r.y_min) * m[1] + m[2];
  const float x = num::max(num::abs(r.x_min), num::abs(r.x_max)), y = num::max(num::abs(r.y_min), num::abs(r.y_max));
  return largest + 1e-5f * (x * num::abs(m[0]) + y * num::abs(m[1]) + num::abs(m[2])) >= 0;
}

TOFRAY_FN bool can_meet(const scene::PlaneForm& plane, const scene::Bounds& r) { return reaches(plane.m, r); }
TOFRAY_FN bool can_meet(const scene::SphereForm& sphere, const scene::Bounds& r) { return overlap(sphere.bounds, r); }
TOFRAY_FN bool can_meet(const scene::BoxForm& box, const scene::Bounds& r) { return overlap(box.bounds, r); }
TOFRAY_FN bool can_meet(const scene::TriangleForm& t, const scene::Bounds& r) {
  return overlap(t.bounds, r) && reaches(t.edge[0], r) && reaches(t.edge[1], r) && reaches(t.edge[2], r);
}

template <class Form>
TOFRAY_FN void pick(const Form* forms, std::int32_t count, const scene::Bounds* r, Picked& out) {
  out.everything = r == nullptr;
  out.count = r == nullptr ? count : 0;
  for (int i = 0; i < count && !out.everything; ++i) {
    if (!can_meet(forms[i], *r)) continue;
    if (out.count == Picked::capacity || i > 0xffff) {
      out.everything = true;
      out.count = count;
    } else {
      out.index[out.count++] = static_cast<std::uint16_t>(i);
    }
  }
}

/// For rays d = (x, y, 1) with (x, y) in `rectangle`; a null pointer keeps everything.
TOFRAY_FN void cull(const scene::Forms& forms, const scene::Bounds* rectangle, Culled& out) {
  pick(forms.planes, forms.plane_count, rectangle, out.planes);
  pick(forms.spheres, forms.sphere_count, rectangle, out.spheres);
  pick(forms.boxes, forms.box_count, rectangle, out.boxes);
  pick(forms.triangles, forms.triangle_count, rectangle, out.triangles);
}

}  // namespace tofray::trace
