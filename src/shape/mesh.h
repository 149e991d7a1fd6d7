// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/twin.h"
#include "shape/common.h"

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

/// A box for each of up to eight children.
struct MeshNode {
  static constexpr int width = 8;
  float low[3][width], high[3][width];
  std::int32_t child[width];  ///< a node; or leaf_of(first, count), so many triangles from `first` on
  std::int32_t children;
};
struct MeshTriangle {
  float corner[3][3];
  std::int32_t number;  ///< in the user's list
};
constexpr int mesh_triangle_words = sizeof(MeshTriangle) / sizeof(float);
constexpr int most_leaf_triangles = 15;
constexpr int most_mesh_levels = 28;

TOFRAY_FN std::int32_t leaf_of(std::int32_t first, std::int32_t count) { return ~(first * 16 + count); }

/// Mesh frame: turn·P, and the origin that is common to the rays.
struct MeshForm {
  float turn[3][3], origin[3];
  float slack;
  const MeshNode* nodes;
  const MeshTriangle* triangles;
  std::int32_t facet, object;
  Bounds bounds;
};

/// Mesh frame: turn·P + offset, and the way to the light.
struct MeshAlong {
  float turn[3][3], offset[3], direction[3];
  float extent;  ///< largest coordinate of the mesh
  const MeshNode* nodes;
  const MeshTriangle* triangles;
  std::int32_t object;
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
  Int<F> number, triangle;  ///< in the user's list, and in the hierarchy's; −1: none
};

struct Mesh {
  using Form = MeshForm;
  using Along = MeshAlong;
  static constexpr int facets = 1;
  static constexpr bool closed = false, curved = true, many = true;

  Mat axes;          ///< rows: those of the mesh's frame
  Vec origin;        ///< where its zero is
  Vec center, half;  ///< of its box, in its own frame
  const MeshNode* nodes;
  const MeshTriangle* triangles;
  std::int32_t node_count, triangle_count;

  /// @param built  the hierarchy of its triangles (scene/hierarchy.h)
  template <class Built>
  static Mesh placed(const Built& built, const Placement& at) {
    const Mat& m = at.turn;
    const Mat axes{{{m.row[0].x, m.row[1].x, m.row[2].x}, {m.row[0].y, m.row[1].y, m.row[2].y}, {m.row[0].z, m.row[1].z, m.row[2].z}}};
    return {axes,
            at.shift,
            built.center,
            built.half,
            built.nodes.data(),
            built.triangles.data(),
            static_cast<std::int32_t>(built.nodes.size()),
            static_cast<std::int32_t>(built.triangles.size())};
  }

  /// Of the triangles that these lanes see, not turned to the camera.
  template <class F>
  TOFRAY_FN static Direction<F> normal(const FacetColumns<F>& of, Int<F> triangle, Mask<F> its);
};

TOFRAY_FN Mesh in_frame(const Mesh& mesh, const Frame& frame) {
  Mesh out = mesh;
  for (int k = 0; k < 3; ++k) out.axes.row[k] = frame.direction(mesh.axes.row[k]);
  out.origin = frame.point(mesh.origin);
  return out;
}

TOFRAY_FN void facet_of(const Mesh& mesh, int, Facet& out) {
  for (int k = 0; k < 3; ++k) copy(mesh.axes.row[k], out.number + 3 * k);
  out.triangles = mesh.triangles;
}

/// The largest coordinate of the mesh's box as seen from a point of its frame.
TOFRAY_FN double reach(const Mesh& mesh, const Vec& from) {
  double most = 0;
  for (int k = 0; k < 3; ++k) most = ::fmax(most, ::fabs(mesh.center[k] - from[k]) + mesh.half[k]);
  return most;
}

/// By how much boxes are widened: some 16 roundings of the largest coordinate along the way, and what is rounded when it is added to
/// the origin, or taken times the inverse direction with it.
template <class F>
TOFRAY_FN F mesh_slack(F reach, F origin) {
  return reach * F(0x1p-19f) + origin * F(0x1p-22f);
}
/// Nothing of a mesh is nearer to the camera [m].
constexpr float nearest_mesh = 1e-6f;

TOFRAY_FN MeshForm seen_from(const Mesh& mesh, const Vec& origin) {
  MeshForm form{};
  for (int k = 0; k < 3; ++k) copy(mesh.axes.row[k], form.turn[k]);
  const Vec from = mesh.axes * (origin - mesh.origin);
  copy(from, form.origin);
  form.slack = mesh_slack(single(reach(mesh, from)), single(length(from)));
  form.nodes = mesh.nodes, form.triangles = mesh.triangles;
  Vec corners[8] = {};
  for (int i = 0; i < 8; ++i) {
    const Vec at{(i & 1 ? 1 : -1) * mesh.half.x, (i & 2 ? 1 : -1) * mesh.half.y, (i & 4 ? 1 : -1) * mesh.half.z};
    corners[i] = back(mesh.axes, mesh.center + at) + mesh.origin - origin;
  }
  form.bounds = mesh.triangle_count > 0 ? bounds_of_points(corners, 8) : nowhere();
  return form;
}

TOFRAY_FN bool can_meet(const MeshForm& mesh, const Bounds& r) { return overlap(mesh.bounds, r); }

TOFRAY_FN MeshAlong seen_along(const Mesh& mesh, const Vec& s) {
  MeshAlong form{};
  for (int k = 0; k < 3; ++k) copy(mesh.axes.row[k], form.turn[k]);
  copy(mesh.axes * (-1.0 * mesh.origin), form.offset);
  copy(mesh.axes * s, form.direction);
  form.extent = single(reach(mesh, {0, 0, 0}));
  form.nodes = mesh.nodes, form.triangles = mesh.triangles;
  return form;
}

/// a·b − c·d to 1.5 units in the last place, its sign as without any rounding (Kahan; Jeannerod, Louvet and Muller 2013).
template <class F>
TOFRAY_FN F difference_of_products(F a, F b, F c, F d) {
  const F product = c * d;
  const F rounding = num::fnma(c, d, product);
  return num::fma(a, b, -product) + rounding;
}

/// Rays by their longest coordinate z: at depth z they are at (x·z, y·z) from their origin.
template <class F>
struct Sheared {
  int x, y, z;  ///< which coordinate is which
  F slope_x, slope_y;
  F origin[3];
  F length;  ///< of d along z
};

template <class F>
TOFRAY_FN Sheared<F> sheared(const MeshRay<F>& ray, int z) {
  const int x = z == 2 ? 0 : z + 1, y = z == 0 ? 2 : z - 1;
  // (Lanes of another longest coordinate are computed along with these, and thrown away.)
  const F length = num::select(ray.direction[z] == F(0.0f), F(1.0f), ray.direction[z]);
  return {x, y, z, ray.direction[x] / length, ray.direction[y] / length, {ray.origin[x], ray.origin[y], ray.origin[z]}, length};
}

/// Where the rays meet the triangle's plane; a mask of those that meet the triangle.
template <class F>
TOFRAY_FN Mask<F> meet(const MeshTriangle& triangle, const Sheared<F>& ray, F& t) {
  F x[3], y[3], z[3];
  for (int i = 0; i < 3; ++i) {
    z[i] = F(triangle.corner[i][ray.z]) - ray.origin[2];
    x[i] = num::fnma(ray.slope_x, z[i], F(triangle.corner[i][ray.x]) - ray.origin[0]);
    y[i] = num::fnma(ray.slope_y, z[i], F(triangle.corner[i][ray.y]) - ray.origin[1]);
  }
  const F u = difference_of_products(x[2], y[1], y[2], x[1]);
  const F v = difference_of_products(x[0], y[2], y[0], x[2]);
  const F w = difference_of_products(x[1], y[0], y[1], x[0]);
  const F zero = F(0.0f), area = u + v + w;
  const auto inside = ((num::min(u, num::min(v, w)) >= zero) | (num::max(u, num::max(v, w)) <= zero)) & (num::abs(area) > F(1e-30f));
  if (num::any(inside)) t = num::fma(u, z[0], num::fma(v, z[1], w * z[2])) / (num::select(inside, area, F(1.0f)) * ray.length);
  return inside;
}

/// A child that is still to be opened, and how near it begins for the nearest ray.
struct MeshEntry {
  std::int32_t child;
  float near;
};

/// What of a mesh some rays meet that have the same longest coordinate.
/// \tparam any  the first triangle that is met will do, and closes the ray
template <bool any, class F>
class MeshSearch {
 public:
  /// @param shortest  t must be above it
  /// @param wanted    the rays of which z is the longest coordinate
  TOFRAY_FN MeshSearch(const MeshNode* nodes, const MeshTriangle* triangles, const MeshRay<F>& ray, int z, F shortest, Mask<F> wanted,
                       MeshHit<F>& hit)
      : nodes_(nodes), triangles_(triangles), along_(sheared(ray, z)), shortest_(shortest), open_(wanted), hit_(hit) {
    for (int k = 0; k < 3; ++k) {
      inverse_[k] = F(1.0f) / num::copy_sign(num::max(num::abs(ray.direction[k]), F(1e-30f)), ray.direction[k]);
      from_low_[k] = (ray.origin[k] + ray.slack) * inverse_[k], from_high_[k] = (ray.origin[k] - ray.slack) * inverse_[k];
    }
  }

  TOFRAY_FN void run() {
    open_node(nodes_[0]);
    while (waiting_ > 0) {
      const MeshEntry next = stack_[--waiting_];
      if (!num::any(open_ & (hit_.t >= F(next.near)))) continue;
      if (next.child >= 0) {
        open_node(nodes_[next.child]);
      } else {
        test(~next.child);
        if (any && !num::any(open_)) return;
      }
    }
  }

 private:
  /// Puts the children that a ray enters on the stack, the nearest on top.
  TOFRAY_FN void open_node(const MeshNode& node) {
    const int before = waiting_;
    for (int i = 0; i < node.children; ++i) {
      F enter = shortest_, leave = hit_.t;
      for (int k = 0; k < 3; ++k) {
        const F a = num::fma(F(node.low[k][i]), inverse_[k], -from_low_[k]), b = num::fma(F(node.high[k][i]), inverse_[k], -from_high_[k]);
        enter = num::max(enter, num::min(a, b)), leave = num::min(leave, num::max(a, b));
      }
      const auto met = open_ & (enter <= leave);
      if (!num::any(met)) continue;
      const float near = num::lowest(num::select(met, enter, F(3e38f)));
      int at = waiting_++;
      for (; at > before && stack_[at - 1].near < near; --at) stack_[at] = stack_[at - 1];
      stack_[at] = {node.child[i], near};
    }
  }

  TOFRAY_FN void test(std::int32_t leaf) {
    for (int i = leaf / 16, end = i + leaf % 16; i < end; ++i) {
      F t = F(0.0f);
      const auto inside = open_ & meet(triangles_[i], along_, t);
      if (!num::any(inside)) continue;
      const Int<F> number = Int<F>(triangles_[i].number);
      const auto nearer = inside & (t > shortest_) & ((t < hit_.t) | ((t == hit_.t) & (number < hit_.number)));
      hit_.t = num::select(nearer, t, hit_.t);
      hit_.number = num::select(nearer, number, hit_.number);
      hit_.triangle = num::select(nearer, Int<F>(i), hit_.triangle);
      if (any) open_ = open_ & (!nearer);
    }
  }

  const MeshNode* nodes_;
  const MeshTriangle* triangles_;
  Sheared<F> along_;
  F from_low_[3], from_high_[3], inverse_[3];
  F shortest_;
  Mask<F> open_;
  MeshHit<F>& hit_;
  int waiting_ = 0;
  MeshEntry stack_[most_mesh_levels * (MeshNode::width - 1) + MeshNode::width];
};

/// Looks for a triangle nearer than hit.t, which stays as it is where there is none.
template <bool any, class F>
TOFRAY_APART void search_mesh(const MeshNode* nodes, const MeshTriangle* triangles, const MeshRay<F>& ray, F shortest, Mask<F> wanted,
                              MeshHit<F>& hit) {
  const F x = num::abs(ray.direction[0]), y = num::abs(ray.direction[1]), z = num::abs(ray.direction[2]);
  const Int<F> longest = num::select((x > y) & (x > z), Int<F>(0), num::select(y > z, Int<F>(1), Int<F>(2)));
  for (int k = 0; k < 3; ++k) {
    const auto these = wanted & (longest == Int<F>(k));
    if (!num::any(these)) continue;
    MeshSearch<any, F>(nodes, triangles, ray, k, shortest, these, hit).run();
  }
}

/// Two packs one after the other: the fewer rays go together, the fewer of them look at a triangle in vain.
template <bool any, class H>
TOFRAY_FN void search_mesh(const MeshNode* nodes, const MeshTriangle* triangles, const MeshRay<num::Twin<H>>& ray, num::Twin<H> shortest,
                           num::TwinMask<H> wanted, MeshHit<num::Twin<H>>& hit) {
  MeshRay<H> a, b;
  for (int k = 0; k < 3; ++k) {
    a.origin[k] = ray.origin[k].a, a.direction[k] = ray.direction[k].a;
    b.origin[k] = ray.origin[k].b, b.direction[k] = ray.direction[k].b;
  }
  a.slack = ray.slack.a, b.slack = ray.slack.b;
  MeshHit<H> of_a{hit.t.a, hit.number.a, hit.triangle.a}, of_b{hit.t.b, hit.number.b, hit.triangle.b};
  search_mesh<any, H>(nodes, triangles, a, shortest.a, wanted.a, of_a);
  search_mesh<any, H>(nodes, triangles, b, shortest.b, wanted.b, of_b);
  hit = {{of_a.t, of_b.t}, {of_a.number, of_b.number}, {of_a.triangle, of_b.triangle}};
}

template <class F>
TOFRAY_FN MeshRay<F> in_mesh(const MeshForm& form, const Ray<F>& ray) {
  MeshRay<F> out;
  for (int k = 0; k < 3; ++k) out.origin[k] = F(form.origin[k]), out.direction[k] = dot(ray, form.turn[k]);
  out.slack = F(form.slack);
  return out;
}

/// The nearest triangle, where it is nearer than the hit so far.
template <class F>
TOFRAY_FN void nearest_in(const MeshForm& form, const Ray<F>& ray, flow::Hit<F>& hit) {
  const auto before = hit.w > F(0.0f);
  const F far = num::select(before, F(1.0f + 0x1p-20f) / num::select(before, hit.w, F(1.0f)), F(3e38f));
  MeshHit<F> found{far, Int<F>(0x7fffffff), Int<F>(-1)};
  search_mesh<false>(form.nodes, form.triangles, in_mesh(form, ray), F(nearest_mesh), F(0.0f) <= F(0.0f), found);
  const auto met = found.triangle > Int<F>(-1);
  const F w = F(1.0f) / num::select(met, found.t, F(1.0f));
  const auto nearer = met & (w > hit.w);
  hit.w = num::select(nearer, w, hit.w);
  hit.facet = num::select(nearer, Int<F>(form.facet), hit.facet);
  hit.triangle = num::select(nearer, found.triangle, hit.triangle);
}

/// Whether a triangle stands before t = `far`.
template <class F>
TOFRAY_FN Mask<F> stands_before(const MeshForm& form, const Ray<F>& ray, F far, Mask<F> wanted) {
  MeshHit<F> found{far, Int<F>(0), Int<F>(-1)};
  search_mesh<true>(form.nodes, form.triangles, in_mesh(form, ray), F(0.0f), wanted, found);
  return found.triangle > Int<F>(-1);
}

/// Whether a triangle stands beyond the margin on the way to the light.
template <class F>
TOFRAY_FN Mask<F> blocks(const MeshAlong& form, const Surface<F>& p, const float*, F margin) {
  MeshRay<F> ray;
  F away = F(0.0f);
  for (int k = 0; k < 3; ++k) {
    ray.origin[k] = affine(p, form.turn[k], form.offset[k]), ray.direction[k] = F(form.direction[k]);
    away = num::max(away, num::abs(ray.origin[k]));
  }
  ray.slack = mesh_slack(F(form.extent) + away, away);
  MeshHit<F> found{F(3e38f), Int<F>(0), Int<F>(-1)};
  search_mesh<true>(form.nodes, form.triangles, ray, margin, p.found, found);
  return found.triangle > Int<F>(-1);
}

/// (B − A) × (C − A) of one facet's triangles, in the camera's frame and of unit length; zero where a triangle has no area.
template <class F>
TOFRAY_FN Direction<F> mesh_normal(const Facet& facet, Int<F> triangle) {
  const float* corners = facet.triangles->corner[0];
  const Int<F> at = triangle * Int<F>(mesh_triangle_words);
  F a[3], b[3];
  for (int k = 0; k < 3; ++k) {
    const F first = num::gather(corners + k, at);
    a[k] = num::gather(corners + 3 + k, at) - first, b[k] = num::gather(corners + 6 + k, at) - first;
  }
  F n[3] = {difference_of_products(a[1], b[2], a[2], b[1]), difference_of_products(a[2], b[0], a[0], b[2]),
            difference_of_products(a[0], b[1], a[1], b[0])};
  const F largest = num::max(num::abs(n[0]), num::max(num::abs(n[1]), num::abs(n[2])));
  const F scale = F(1.0f) / num::max(largest, F(1e-37f));
  for (int k = 0; k < 3; ++k) n[k] = n[k] * scale;
  const F size = num::sqrt(num::fma(n[0], n[0], num::fma(n[1], n[1], n[2] * n[2])));
  const F unit = F(1.0f) / num::max(size, F(1e-30f));
  const float* turn = facet.number;
  const auto turned = [&](int c) __attribute__((always_inline)) {
    return num::fma(n[0], F(turn[c]), num::fma(n[1], F(turn[3 + c]), n[2] * F(turn[6 + c]))) * unit;
  };
  return {turned(0), turned(1), turned(2)};
}

/// Mostly all lanes see one mesh; else one after the other.
template <class F>
TOFRAY_FN Direction<F> Mesh::normal(const FacetColumns<F>& of, Int<F> triangle, Mask<F> its) {
  Direction<F> out{F(0.0f), F(0.0f), F(0.0f)};
  Int<F> left = num::select(its, Int<F>(1), Int<F>(0));
  for (int i = 0; i < num::lanes<F>; ++i) {
    if (num::lane(left, i) == 0) continue;
    const std::int32_t row = num::lane(of.facet, i);
    const auto these = its & (of.facet == Int<F>(row));
    const Direction<F> n = mesh_normal<F>(of.at(row), num::select(these, triangle, Int<F>(0)));
    out = {num::select(these, n.x, out.x), num::select(these, n.y, out.y), num::select(these, n.z, out.z)};
    left = num::select(these, Int<F>(0), left);
  }
  return out;
}

}  // namespace tofray::shape
