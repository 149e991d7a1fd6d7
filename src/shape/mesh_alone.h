// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/mesh_walk.h"

/// A ray by itself against the eight children of a node at once, and against a block of triangles at once: rays that have nothing in
/// common, on a machine that has many lanes. The test of a triangle is `meet`, as for packs of rays, so that t is the same, bit by bit.
namespace tofray::shape {

template <class F>
TOFRAY_INLINE F load_all(const float* from) {
  return num::load<F>(from, num::lanes<F>);
}
template <class F>
TOFRAY_INLINE void store_all(float* to, F values) {
  num::store(to, values, num::lanes<F>);
}

TOFRAY_INLINE std::uint32_t first_of(int count) { return (1u << count) - 1u; }

/// Rays of a pack, to go through a mesh one by one.
template <class F>
struct MeshRaysApart {
  static constexpr int count = num::lanes<F>;
  alignas(64) float origin[3][count], inverse[3][count], from_near[3][count], from_far[3][count];
  alignas(64) float slope_x[count], slope_y[count], length[count];  ///< as of Sheared
  alignas(64) float shortest[count], t[count];
  alignas(64) std::int32_t near[3][count];  ///< where in a node the sides of the boxes lie at which the ray comes in
  alignas(64) std::int32_t longest[count], number[count], triangle[count];
};

template <class F>
TOFRAY_INLINE void take_apart(const MeshRay<F>& ray, F shortest, const MeshHit<F>& hit, MeshRaysApart<F>& out) {
  constexpr int n = num::lanes<F>;
  const F(&d)[3] = ray.direction;
  for (int k = 0; k < 3; ++k) {
    const F inverse = F(1.0f) / num::copy_sign(num::max(num::abs(d[k]), F(1e-30f)), d[k]);
    num::store(out.origin[k], ray.origin[k], n), num::store(out.inverse[k], inverse, n);
    // Which side that is nobody can foresee: no branch may depend on it.
    const auto back = inverse < F(0.0f);
    const F from_low = (ray.origin[k] + ray.slack) * inverse, from_high = (ray.origin[k] - ray.slack) * inverse;
    num::store(out.from_near[k], num::select(back, from_high, from_low), n);
    num::store(out.from_far[k], num::select(back, from_low, from_high), n);
    num::store(out.near[k], num::select(back, Int<F>((3 + k) * mesh_width), Int<F>(k * mesh_width)), n);
  }
  const Int<F> longest = longest_of(d);
  const auto is_x = longest == Int<F>(0), is_y = longest == Int<F>(1);
  const auto turned_to = [&](F x, F y, F z) TOFRAY_LAMBDA { return num::select(is_x, x, num::select(is_y, y, z)); };
  const F along = turned_to(d[0], d[1], d[2]), length = num::select(along == F(0.0f), F(1.0f), along);
  num::store(out.slope_x, turned_to(d[1], d[2], d[0]) / length, n), num::store(out.slope_y, turned_to(d[2], d[0], d[1]) / length, n);
  num::store(out.length, length, n), num::store(out.longest, longest, n);
  num::store(out.shortest, shortest, n), num::store(out.t, hit.t, n);
  num::store(out.number, hit.number, n), num::store(out.triangle, hit.triangle, n);
}

/// \tparam any  the first triangle that is met will do, and ends the search
/// \tparam cut  the mesh has a picture that says where a surface is
/// \tparam F    so many triangles at once
template <bool any, bool cut, class F>
class MeshAlone {
 public:
  TOFRAY_INLINE MeshAlone(const MeshTree& mesh, MeshRaysApart<F>& rays, int i) : mesh_(mesh), rays_(rays), i_(i) {
    const int z = rays.longest[i], x = next_coordinate(z);
    along_ = {x, next_coordinate(x), z, F(rays.slope_x[i]), F(rays.slope_y[i]), F(rays.length[i])};
    for (int k = 0; k < 3; ++k) {
      inverse_[k] = Eight(rays.inverse[k][i]);
      from_near_[k] = Eight(rays.from_near[k][i]), from_far_[k] = Eight(rays.from_far[k][i]);
      near_[k] = rays.near[k][i], far_[k] = (3 + 2 * k) * mesh_width - near_[k];
      origin_[k] = F(rays.origin[k][i]);
    }
    shortest_ = Eight(rays.shortest[i]);
    t_ = rays.t[i];
  }

  TOFRAY_INLINE void run() {
    std::int32_t child = 0;
    int waiting = 0;
    while (true) {
      if (child >= 0) {
        if (open(mesh_.nodes[child], child, waiting)) continue;
      } else if (test(child) && any) {
        return;
      }
      do {
        if (waiting == 0) return;
        child = stack_[--waiting].child;
      } while (stack_[waiting].near > t_);
    }
  }

 private:
  using Eight = num::Eight<F>;

  /// Goes to the nearest child that the ray enters; the others wait, the nearest on top. @return false where it enters none
  TOFRAY_INLINE bool open(const MeshNode& node, std::int32_t& child, int& waiting) {
    const float* planes = node.low[0];  // those of `high` follow
    const auto at = [&](int plane, int k, Eight from)
                        TOFRAY_LAMBDA { return num::fms(load_all<Eight>(planes + plane), inverse_[k], from); };
    const Eight enter = num::max(num::max(at(near_[0], 0, from_near_[0]), at(near_[1], 1, from_near_[1])),
                                 num::max(at(near_[2], 2, from_near_[2]), shortest_));
    const Eight leave =
        num::min(num::min(at(far_[0], 0, from_far_[0]), at(far_[1], 1, from_far_[1])), num::min(at(far_[2], 2, from_far_[2]), Eight(t_)));
    std::uint32_t met = num::lanes_of(enter <= leave) & first_of(node.children);
    if (met == 0) return false;
    const int first = __builtin_ctz(met);
    met &= met - 1;
    child = node.child[first];
    if (met == 0) return true;
    alignas(64) float nears[mesh_width];
    store_all(nears, enter);
    const int second = __builtin_ctz(met);
    met &= met - 1;
    fetch(node.child[second]);
    const bool swapped = nears[second] < nears[first];
    const MeshEntry one{node.child[first], nears[first]}, two{node.child[second], nears[second]};
    const int before = waiting;
    stack_[waiting++] = swapped ? one : two;
    MeshEntry nearest = swapped ? two : one;
    for (; met != 0; met &= met - 1) {
      const int i = __builtin_ctz(met);
      MeshEntry next{node.child[i], nears[i]};
      fetch(node.child[i]);
      if (next.near < nearest.near) {
        const MeshEntry other = nearest;
        nearest = next, next = other;
      }
      int place = waiting++;
      for (; place > before && stack_[place - 1].near < next.near; --place) stack_[place] = stack_[place - 1];
      stack_[place] = next;
    }
    child = nearest.child;
    return true;
  }

  /// Says early that a child will be looked at, once what comes before it is done: a line of the cache for each coordinate of a node's boxes.
  TOFRAY_INLINE void fetch(std::int32_t child) const {
    const char* at =
        child >= 0 ? reinterpret_cast<const char*>(mesh_.nodes + child) : reinterpret_cast<const char*>(mesh_.triangles + block_of(child));
    for (int k = 0; k < 3; ++k) __builtin_prefetch(at + 64 * k);
  }

  /// @return whether a triangle of the block is nearer
  TOFRAY_INLINE bool test(std::int32_t leaf) {
    const MeshTriangles& block = mesh_.triangles[block_of(leaf)];
    bool found = false;
    for (int first = 0, count = count_of(leaf); first < count; first += num::lanes<F>) {
      F t = F(0.0f);
      const auto corner = [&](int c, int k) TOFRAY_LAMBDA { return load_all<F>(block.corner[c][k] + first) - origin_[k]; };
      MeshParts<F> parts;
      const auto inside = meet<true>(corner, along_, t, parts);
      if (!num::any(inside)) continue;
      std::uint32_t met = num::lanes_of(inside & (t > F(rays_.shortest[i_])) & (t <= F(t_)));
      if (met == 0) continue;
      alignas(64) float of_t[num::lanes<F>];
      store_all(of_t, t);
      for (; met != 0; met &= met - 1) {
        const int at = __builtin_ctz(met);
        const std::int32_t number = block.number[first + at], triangle = block_of(leaf) * block_width + first + at;
        if (!(of_t[at] < t_ || (of_t[at] == t_ && number < rays_.number[i_]))) continue;
        if (cut && !is_there(parts, at, triangle)) continue;
        t_ = of_t[at], rays_.t[i_] = t_, rays_.number[i_] = number, rays_.triangle[i_] = triangle;
        found = true;
      }
    }
    return found;
  }

  TOFRAY_INLINE bool is_there(const MeshParts<F>& parts, int at, std::int32_t triangle) const {
    const auto of_lane = [&](F a) TOFRAY_LAMBDA {
      alignas(64) float each[num::lanes<F>];
      store_all(each, a);
      return each[at];
    };
    return not_cut_out<float>(mesh_, triangle, {of_lane(parts.first), of_lane(parts.second), of_lane(parts.third), of_lane(parts.all)},
                              true);
  }

  const MeshTree& mesh_;
  MeshRaysApart<F>& rays_;
  int i_;
  Sheared<F> along_;
  F origin_[3];
  Eight inverse_[3], from_near_[3], from_far_[3], shortest_;
  int near_[3], far_[3];
  float t_;
  MeshEntry stack_[most_mesh_stack];
};

template <bool any, bool cut, class F>
TOFRAY_NOINLINE void search_alone(const MeshTree& mesh, const MeshRay<F>& ray, F shortest, Mask<F> wanted, MeshHit<F>& hit) {
  MeshRaysApart<F> rays;
  take_apart(ray, shortest, hit, rays);
  for (std::uint32_t left = num::lanes_of(wanted); left != 0; left &= left - 1)
    MeshAlone<any, cut, F>(mesh, rays, __builtin_ctz(left)).run();
  hit.t = load_all<F>(rays.t);
  hit.number = num::load_int<F>(rays.number, num::lanes<F>), hit.triangle = num::load_int<F>(rays.triangle, num::lanes<F>);
}

}  // namespace tofray::shape
