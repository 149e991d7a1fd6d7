// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "brdf/reflectivity_map.h"
#include "shape/box.h"

/// Many triangles, found through boxes within boxes. Both sides reflect.
///
/// The rays go to the mesh, not the mesh to the rays: o and d are turned into the mesh's frame, t stays. Which triangle a ray meets does
/// not depend on the order in which boxes are opened, since
///
///     the test of a triangle is exact for its corners as they are rounded along the ray (difference_of_products keeps the sign), so that
///     neighbours agree about their common edge and about its ends, and nothing leaks between them (Woop, Benthin and Wald 2013);
///     t is a mean of the corners' depths with weights >= 0, so that the point lies in every box round the triangle (they are wider by
///     `slack` than it, more than rounding); and of two triangles at one t the one of the lower number is seen.
namespace tofray::shape {

/// Boxes of a node's children, and triangles of a leaf, lie side by side: a processor looks at all of them at once.
constexpr int mesh_width = 8, block_width = 16;

/// A box for each of up to eight children.
struct alignas(64) MeshNode {
  float low[3][mesh_width], high[3][mesh_width];
  std::int32_t child[mesh_width];  ///< a node, or leaf_of(…)
  std::int32_t children;
};
/// Up to sixteen triangles; after them the last one is repeated.
struct alignas(64) MeshTriangles {
  float corner[3][3][block_width];   ///< [corner][coordinate]
  std::int32_t number[block_width];  ///< in the user's list
};
/// What the corners of the triangles of one block say besides: zeros where they do not.
struct alignas(64) MeshDetails {
  float normal[3][3][block_width];    ///< [corner][coordinate], in the mesh's frame
  float texcoord[3][2][block_width];  ///< [corner][u, v]
  float shade[3][block_width];        ///< [corner]
};
constexpr int mesh_triangles_words = sizeof(MeshTriangles) / sizeof(float), mesh_details_words = sizeof(MeshDetails) / sizeof(float);
constexpr int most_mesh_levels = 28;

/// The first `count` triangles of block number `block`.
TOFRAY_INLINE std::int32_t leaf_of(std::int32_t block, std::int32_t count) { return ~(block * 32 + count); }
TOFRAY_INLINE std::int32_t block_of(std::int32_t leaf) { return ~leaf / 32; }
TOFRAY_INLINE std::int32_t count_of(std::int32_t leaf) { return ~leaf % 32; }

/// A mesh's triangles, and where they are none.
struct MeshTree {
  const MeshNode* nodes;
  const MeshTriangles* triangles;
  const MeshDetails* details;  ///< null: no corner has any
  const brdf::MapView* cut;    ///< a surface is where this picture is ½ or more (mesh_cut.h); null: everywhere
};

/// Mesh frame: turn·P, and the origin that is common to the rays.
struct MeshForm : MeshTree {
  float turn[3][3], origin[3];
  float slack;
  std::int32_t facet, object;
  Bounds bounds;
};

/// Mesh frame: turn·P + offset, and the way to the light.
struct MeshAlong : MeshTree {
  float turn[3][3], offset[3], direction[3];
  float extent;  ///< largest coordinate of the mesh
  std::int32_t object;
  Bounds bounds;  ///< on the light's screen
};

/// Rays in the mesh's frame, each from an origin of its own.
template <class F>
struct MeshRay {
  F origin[3], direction[3];
  F slack;  ///< boxes are wider by this
};
/// The nearest so far.
template <class F>
struct MeshHit {
  F t;
  Int<F> number, triangle;  ///< in the user's list, and block_width·block + place in the hierarchy's; −1: none
};

/// How the corners of a block's triangles move, in the mesh's frame, where the mesh changes its shape.
struct MeshSteps {
  float velocity[3][3][block_width];  ///< [corner][coordinate] [m/s] at the time of the truth
  float step[3][3][block_width];      ///< [m] until one frame later; at other times than that of the truth: until that
};
constexpr int mesh_steps_words = sizeof(MeshSteps) / sizeof(float);

/// For rays from anywhere: mesh frame turn·P + offset.
struct MeshFree : MeshTree {
  float turn[3][3], offset[3];
  float extent;  ///< largest coordinate of the mesh
  std::int32_t facet, object;
};

struct Mesh : MeshTree {
  using Form = MeshForm;
  using Along = MeshAlong;
  using Free = MeshFree;
  static constexpr int facets = 2;  ///< hits name the first; the second has what is left (facet_of)
  static constexpr bool closed = false, curved = true, many = true;

  Mat axes;                ///< rows: those of the mesh's frame
  Vec origin;              ///< where its zero is
  Vec center, half;        ///< of its box, in its own frame
  const MeshSteps* steps;  ///< null: it keeps its shape, or nobody asks
  std::int32_t node_count, block_count;
  std::int32_t has_texcoords, has_shades;

  /// What it turns about.
  template <class Said>
  static Vec center_of(const Said&) {
    return {0, 0, 0};
  }
  /// Its triangles as they are at the time.
  template <class Said, class Sink>
  static void tessellate(const Said& said, Sink& to) {
    to.mesh(said);
  }
  /// @param built  the hierarchy of its triangles (scene/hierarchy.h)
  template <class Built>
  static Mesh placed(const Built& built, const Placement& at) {
    const Mat& m = at.turn;
    const Mat axes{{{m.row[0].x, m.row[1].x, m.row[2].x}, {m.row[0].y, m.row[1].y, m.row[2].y}, {m.row[0].z, m.row[1].z, m.row[2].z}}};
    return {{built.nodes.data(), built.triangles.data(), built.details.empty() ? nullptr : built.details.data(), nullptr},
            axes,
            at.shift,
            built.center,
            built.half,
            nullptr,
            static_cast<std::int32_t>(built.nodes.size()),
            static_cast<std::int32_t>(built.triangles.size()),
            built.has_texcoords ? 1 : 0,
            built.has_shades ? 1 : 0};
  }

  /// Of its triangles, not turned to the camera.
  template <class F>
  TOFRAY_INLINE static Direction<F> normal(const Facet& of, Int<F> triangle);
};

TOFRAY_INLINE Mesh in_frame(const Mesh& mesh, const CoordinateFrame& frame) {
  Mesh out = mesh;
  for (int k = 0; k < 3; ++k) out.axes.row[k] = frame.direction(mesh.axes.row[k]);
  out.origin = frame.point(mesh.origin);
  return out;
}

TOFRAY_INLINE Span span_along(const Mesh& mesh, const Vec& a) {
  return span_about(dot(mesh.origin, a) + dot(mesh.center, mesh.axes * a), reach_of_box(mesh.axes, mesh.half, a));
}

/// The second: where the camera's zero is in the mesh's frame, whether corners have texture coordinates and shades, and how they
/// move.
TOFRAY_INLINE void facet_of(const Mesh& mesh, int side, Facet& out) {
  if (side == 1) {
    copy(mesh.axes * (-1.0 * mesh.origin), out.number);
    out.number[3] = mesh.has_texcoords != 0 ? 1.0f : 0.0f, out.number[4] = mesh.has_shades != 0 ? 1.0f : 0.0f;
    out.steps = mesh.steps;
    return;
  }
  for (int k = 0; k < 3; ++k) copy(mesh.axes.row[k], out.number + 3 * k);
  out.triangles = mesh.triangles, out.details = mesh.details;
}

/// The largest coordinate of the mesh's box as seen from a point of its frame.
TOFRAY_INLINE double reach(const Mesh& mesh, const Vec& from) {
  double most = 0;
  for (int k = 0; k < 3; ++k) most = ::fmax(most, ::fabs(mesh.center[k] - from[k]) + mesh.half[k]);
  return most;
}

/// A number type of many lanes lets the rays of a tile go together (mesh_beam.h).
template <class F>
constexpr bool has_beams = num::lanes<F> > 1;

/// By how much boxes are widened: some 16 roundings of the largest coordinate along the way, and what is rounded when it is added to
/// the origin, or taken times the inverse direction with it.
template <class F>
TOFRAY_INLINE F mesh_slack(F reach, F origin) {
  return reach * F(0x1p-19f) + origin * F(0x1p-22f);
}
/// Nothing of a mesh is nearer to the camera [m].
constexpr float nearest_mesh = 1e-6f;

TOFRAY_INLINE MeshForm seen_from(const Mesh& mesh, const Vec& origin) {
  MeshForm form{};
  for (int k = 0; k < 3; ++k) copy(mesh.axes.row[k], form.turn[k]);
  const Vec from = mesh.axes * (origin - mesh.origin);
  copy(from, form.origin);
  form.slack = mesh_slack(single(reach(mesh, from)), single(length(from)));
  static_cast<MeshTree&>(form) = mesh;
  Vec corners[8] = {};
  for (int i = 0; i < 8; ++i) {
    const Vec at{(i & 1 ? 1 : -1) * mesh.half.x, (i & 2 ? 1 : -1) * mesh.half.y, (i & 4 ? 1 : -1) * mesh.half.z};
    corners[i] = back(mesh.axes, mesh.center + at) + mesh.origin - origin;
  }
  form.bounds = mesh.block_count > 0 ? bounds_of_points(corners, 8) : nowhere();
  return form;
}

TOFRAY_INLINE float begins_at(const Mesh& mesh, const Vec& origin) {
  const Vec from = mesh.axes * (origin - mesh.origin);
  return single(span_along(mesh, {0, 0, 1}).low - origin.z - depth_room * (reach(mesh, from) + length(from)));
}
TOFRAY_INLINE float begins_along(const Mesh& mesh, const Vec& s) {
  return single(-span_along(mesh, s).high - depth_room * (reach(mesh, {0, 0, 0}) + length(mesh.origin)));
}

TOFRAY_INLINE bool can_meet(const MeshForm& mesh, const Bounds& r) { return overlap(mesh.bounds, r); }

TOFRAY_INLINE MeshAlong seen_along(const Mesh& mesh, const Vec& s) {
  MeshAlong form{};
  for (int k = 0; k < 3; ++k) copy(mesh.axes.row[k], form.turn[k]);
  copy(mesh.axes * (-1.0 * mesh.origin), form.offset);
  copy(mesh.axes * s, form.direction);
  form.extent = single(reach(mesh, {0, 0, 0}));
  static_cast<MeshTree&>(form) = mesh;
  return form;
}

/// Rays by their longest coordinate z: at depth z they are at (x·z, y·z) from their origin.
template <class F>
struct Sheared {
  int x, y, z;  ///< which coordinate is which
  F slope_x, slope_y;
  F length;  ///< of d along z
};

TOFRAY_INLINE int next_coordinate(int k) { return k == 2 ? 0 : k + 1; }

template <class F>
TOFRAY_INLINE Sheared<F> sheared(const F (&direction)[3], int z) {
  const int x = next_coordinate(z), y = next_coordinate(x);
  // (Lanes of another longest coordinate are computed along with these, and thrown away.)
  const F length = num::select(direction[z] == F(0.0f), F(1.0f), direction[z]);
  return {x, y, z, direction[x] / length, direction[y] / length, length};
}

/// The parts of a triangle that a point in it divides it into, each opposite a corner, and their sum: all of one sign.
template <class F>
struct MeshParts {
  F first, second, third, all;
};

/// Where the rays meet the triangle's plane; a mask of those that meet the triangle.
/// @param corner  (corner, coordinate): where it is from the rays' origin
/// @param parts   out: where in the triangle that is
/// \tparam look_first  whether t is left out where no ray meets it: a division less, but a branch that nobody can foresee
template <bool look_first, class F, class Corner>
TOFRAY_INLINE Mask<F> meet(const Corner& corner, const Sheared<F>& ray, F& t, MeshParts<F>& parts) {
  F x[3], y[3], z[3];
  for (int i = 0; i < 3; ++i) {
    z[i] = corner(i, ray.z);
    x[i] = num::fnma(ray.slope_x, z[i], corner(i, ray.x));
    y[i] = num::fnma(ray.slope_y, z[i], corner(i, ray.y));
  }
  const F u = difference_of_products(x[2], y[1], y[2], x[1]);
  const F v = difference_of_products(x[0], y[2], y[0], x[2]);
  const F w = difference_of_products(x[1], y[0], y[1], x[0]);
  const F zero = F(0.0f), area = u + v + w;
  const auto inside = ((num::min(u, num::min(v, w)) >= zero) | (num::max(u, num::max(v, w)) <= zero)) & (num::abs(area) > F(1e-30f));
  if (!look_first || num::any(inside))
    t = num::fma(u, z[0], num::fma(v, z[1], w * z[2])) / (num::select(inside, area, F(1.0f)) * ray.length);
  parts = {u, v, w, area};
  return inside;
}
template <bool look_first, class F, class Corner>
TOFRAY_INLINE Mask<F> meet(const Corner& corner, const Sheared<F>& ray, F& t) {
  MeshParts<F> parts;
  return meet<look_first>(corner, ray, t, parts);
}

/// The nearer of what was hit so far and the triangles that are met at t. @return a mask of the rays that it is nearer for
template <class F>
TOFRAY_INLINE Mask<F> take_nearer(Mask<F> inside, F t, std::int32_t number, std::int32_t triangle, F shortest, MeshHit<F>& hit) {
  const auto nearer = inside & (t > shortest) & ((t < hit.t) | ((t == hit.t) & (Int<F>(number) < hit.number)));
  hit.t = num::select(nearer, t, hit.t);
  hit.number = num::select(nearer, Int<F>(number), hit.number);
  hit.triangle = num::select(nearer, Int<F>(triangle), hit.triangle);
  return nearer;
}

/// A ray from the form's origin, in the mesh's frame.
template <class F>
TOFRAY_INLINE MeshRay<F> in_mesh(const MeshForm& form, const F (&direction)[3]) {
  MeshRay<F> out;
  for (int k = 0; k < 3; ++k) {
    const float* m = form.turn[k];
    out.origin[k] = F(form.origin[k]);
    out.direction[k] = num::fma(direction[0], F(m[0]), num::fma(direction[1], F(m[1]), direction[2] * F(m[2])));
  }
  out.slack = F(form.slack);
  return out;
}

/// The way from a point to the light.
template <class F>
TOFRAY_INLINE MeshRay<F> in_mesh(const MeshAlong& form, const F (&point)[3]) {
  MeshRay<F> out;
  F away = F(0.0f);
  for (int k = 0; k < 3; ++k) {
    const float* m = form.turn[k];
    out.origin[k] = num::fma(point[0], F(m[0]), num::fma(point[1], F(m[1]), num::fma(point[2], F(m[2]), F(form.offset[k]))));
    out.direction[k] = F(form.direction[k]);
    away = num::max(away, num::abs(out.origin[k]));
  }
  out.slack = mesh_slack(F(form.extent) + away, away);
  return out;
}

/// (B − A) × (C − A) of one facet's triangles, in the camera's frame and of unit length; zero where a triangle has no area.
template <class F>
TOFRAY_INLINE Direction<F> Mesh::normal(const Facet& facet, Int<F> triangle) {
  const float* corners = facet.triangles->corner[0][0];
  const Int<F> place = triangle & Int<F>(block_width - 1);
  const Int<F> at = (triangle - place) * Int<F>(mesh_triangles_words / block_width) + place;
  F a[3], b[3];
  for (int k = 0; k < 3; ++k) {
    const F first = num::gather(corners + k * block_width, at);
    a[k] = num::gather(corners + (3 + k) * block_width, at) - first, b[k] = num::gather(corners + (6 + k) * block_width, at) - first;
  }
  F n[3] = {difference_of_products(a[1], b[2], a[2], b[1]), difference_of_products(a[2], b[0], a[0], b[2]),
            difference_of_products(a[0], b[1], a[1], b[0])};
  const F largest = num::max(num::abs(n[0]), num::max(num::abs(n[1]), num::abs(n[2])));
  const F scale = F(1.0f) / num::max(largest, F(1e-37f));
  for (int k = 0; k < 3; ++k) n[k] = n[k] * scale;
  const F size = num::sqrt(num::fma(n[0], n[0], num::fma(n[1], n[1], n[2] * n[2])));
  const F unit = F(1.0f) / num::max(size, F(1e-30f));
  const float* turn = facet.number;
  const auto turned = [&](int c) TOFRAY_LAMBDA {
    return num::fma(n[0], F(turn[c]), num::fma(n[1], F(turn[3 + c]), n[2] * F(turn[6 + c]))) * unit;
  };
  return {turned(0), turned(1), turned(2)};
}

TOFRAY_INLINE MeshFree free_of(const Mesh& mesh) {
  MeshFree form{};
  for (int k = 0; k < 3; ++k) copy(mesh.axes.row[k], form.turn[k]);
  copy(mesh.axes * (-1.0 * mesh.origin), form.offset);
  form.extent = single(reach(mesh, {0, 0, 0}));
  static_cast<MeshTree&>(form) = mesh;
  return form;
}

template <class F>
TOFRAY_INLINE MeshRay<F> in_mesh(const MeshFree& form, const FreeRay<F>& ray) {
  MeshRay<F> out;
  F away = F(0.0f);
  for (int k = 0; k < 3; ++k) {
    out.origin[k] = placed(ray, form.turn[k], form.offset[k]), out.direction[k] = turned(ray, form.turn[k]);
    away = num::max(away, num::abs(out.origin[k]));
  }
  out.slack = mesh_slack(F(form.extent) + away, away);
  return out;
}

}  // namespace tofray::shape
