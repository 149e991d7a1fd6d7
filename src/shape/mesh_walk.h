// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/twin.h"
#include "shape/mesh_cut.h"

/// Rays of a pack that go through a mesh together: each box is held against all of them, and each triangle.
namespace tofray::shape {

/// A child that is still to be opened, and how near it begins for the nearest ray.
struct MeshEntry {
  std::int32_t child;
  float near;
};
constexpr int most_mesh_stack = most_mesh_levels * (mesh_width - 1) + mesh_width;

/// What of a mesh some rays meet that have the same longest coordinate.
/// \tparam any  the first triangle that is met will do, and closes the ray
/// \tparam cut  the mesh may have a picture that says where a surface is
template <bool any, bool cut, class F>
class MeshSearch {
 public:
  /// @param shortest  t must be above it
  /// @param wanted    the rays of which z is the longest coordinate
  TOFRAY_INLINE MeshSearch(const MeshTree& mesh, const MeshRay<F>& ray, int z, F shortest, Mask<F> wanted, MeshHit<F>& hit)
      : mesh_(mesh),
        along_(sheared(ray.direction, z)),
        origin_{ray.origin[0], ray.origin[1], ray.origin[2]},
        shortest_(shortest),
        open_(wanted),
        hit_(hit) {
    for (int k = 0; k < 3; ++k) {
      inverse_[k] = F(1.0f) / num::copy_sign(num::max(num::abs(ray.direction[k]), F(1e-30f)), ray.direction[k]);
      from_low_[k] = (ray.origin[k] + ray.slack) * inverse_[k], from_high_[k] = (ray.origin[k] - ray.slack) * inverse_[k];
    }
  }

  TOFRAY_INLINE void run() {
    open_node(mesh_.nodes[0]);
    while (waiting_ > 0) {
      const MeshEntry next = stack_[--waiting_];
      if (!num::any(open_ & (hit_.t >= F(next.near)))) continue;
      if (next.child >= 0) {
        open_node(mesh_.nodes[next.child]);
      } else {
        test(next.child);
        if (any && !num::any(open_)) return;
      }
    }
  }

 private:
  /// Puts the children that a ray enters on the stack, the nearest on top.
  TOFRAY_INLINE void open_node(const MeshNode& node) {
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

  TOFRAY_INLINE void test(std::int32_t leaf) {
    const MeshTriangles& block = mesh_.triangles[block_of(leaf)];
    for (int i = 0, count = count_of(leaf); i < count; ++i) {
      F t = F(0.0f);
      const auto corner = [&](int c, int k) TOFRAY_LAMBDA { return F(block.corner[c][k][i]) - origin_[k]; };
      MeshParts<F> parts;
      auto inside = open_ & meet<true>(corner, along_, t, parts);
      if (!num::any(inside)) continue;
      const std::int32_t triangle = block_of(leaf) * block_width + i;
      if (cut && mesh_.cut != nullptr) inside = not_cut_out(mesh_, triangle, parts, inside);
      const auto nearer = take_nearer(inside, t, block.number[i], triangle, shortest_, hit_);
      if (any) open_ = open_ & (!nearer);
    }
  }

  const MeshTree& mesh_;
  Sheared<F> along_;
  F origin_[3];
  F from_low_[3], from_high_[3], inverse_[3];
  F shortest_;
  Mask<F> open_;
  MeshHit<F>& hit_;
  int waiting_ = 0;
  MeshEntry stack_[most_mesh_stack];
};

template <bool any, bool cut, class F>
TOFRAY_NOINLINE void search_tree(const MeshTree& mesh, const MeshRay<F>& ray, F shortest, Mask<F> wanted, MeshHit<F>& hit) {
  const Int<F> longest = longest_of(ray.direction);
  for (int k = 0; k < 3; ++k) {
    const auto these = wanted & (longest == Int<F>(k));
    if (!num::any(these)) continue;
    MeshSearch<any, cut, F>(mesh, ray, k, shortest, these, hit).run();
  }
}

/// Two packs one after the other: the fewer rays go together, the fewer of them look at a triangle in vain.
/// @param search  (ray, shortest, wanted, hit) of one
template <class H, class Search>
TOFRAY_INLINE void search_in_halves(const MeshRay<num::Twin<H>>& ray, num::Twin<H> shortest, num::TwinMask<H> wanted,
                                    MeshHit<num::Twin<H>>& hit, const Search& search) {
  MeshRay<H> a, b;
  for (int k = 0; k < 3; ++k) {
    a.origin[k] = ray.origin[k].a, a.direction[k] = ray.direction[k].a;
    b.origin[k] = ray.origin[k].b, b.direction[k] = ray.direction[k].b;
  }
  a.slack = ray.slack.a, b.slack = ray.slack.b;
  MeshHit<H> of_a{hit.t.a, hit.number.a, hit.triangle.a}, of_b{hit.t.b, hit.number.b, hit.triangle.b};
  search(a, shortest.a, wanted.a, of_a), search(b, shortest.b, wanted.b, of_b);
  hit = {{of_a.t, of_b.t}, {of_a.number, of_b.number}, {of_a.triangle, of_b.triangle}};
}

/// Looks for a triangle nearer than hit.t, which stays as it is where there is none: rays that go side by side, or one by itself.
template <bool any, class F>
TOFRAY_INLINE void search_together(const MeshTree& mesh, const MeshRay<F>& ray, F shortest, Mask<F> wanted, MeshHit<F>& hit) {
  // (A ray by itself seldom asks; one search for all meshes is less code for a GPU.)
  if (num::lanes<F> == 1 || mesh.cut != nullptr) {
    search_tree<any, true, F>(mesh, ray, shortest, wanted, hit);
  } else {
    search_tree<any, false, F>(mesh, ray, shortest, wanted, hit);
  }
}
template <bool any, class H>
TOFRAY_INLINE void search_together(const MeshTree& mesh, const MeshRay<num::Twin<H>>& ray, num::Twin<H> shortest, num::TwinMask<H> wanted,
                                   MeshHit<num::Twin<H>>& hit) {
  search_in_halves<H>(ray, shortest, wanted, hit, [&](const MeshRay<H>& half, H from, Mask<H> its, MeshHit<H>& of_half) TOFRAY_LAMBDA {
    search_together<any>(mesh, half, from, its, of_half);
  });
}

}  // namespace tofray::shape
