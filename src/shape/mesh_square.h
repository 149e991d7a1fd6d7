// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/mesh_beam.h"

namespace tofray::shape {

/// Sixteen rays of a tile side by side, on their way through a mesh.
/// \tparam any  the first triangle that is met will do, and closes the ray
/// \tparam cut  the mesh has a picture that says where a surface is
template <bool any, bool cut, class F>
class MeshSquare {
 public:
  /// @param of_tile    the axis is that of the tile's beam
  /// @param triangles  so many it may meet
  TOFRAY_INLINE MeshSquare(const MeshForm& form, const Beam& of_tile, const F (&direction)[3], const F (&slope)[2], F shortest,
                           Mask<F> wanted, int triangles, MeshHit<F>& hit)
      : form_(form), beam_(of_tile), shortest_(shortest), open_(wanted), hit_(hit), left_(triangles) {
    for (int i = 0; i < 2; ++i) {
      const float least = num::lowest(num::select(wanted, slope[i], F(3e38f)));
      beam_.bound(beam_.side[i], least, num::highest(num::select(wanted, slope[i], F(-3e38f))));
    }
    const int z = beam_.z;
    const Int<F> longest = longest_of(direction);
    const auto main = longest == Int<F>(z);
    main_ = wanted & main, has_others_ = num::any(wanted & (!main));
    along_ = {beam_.side[0].x, beam_.side[1].x, z, slope[0], slope[1], direction[z]};
    for (int k = 0; k < 3 && has_others_; ++k) other_[k] = sheared(direction, k), others_[k] = wanted & (longest == Int<F>(k));
    depth_per_t_ = num::abs(direction[z]);
    see_how_far();
  }

  /// From the root. @return false: it met more triangles than a beam is good for, and what it found is not all
  TOFRAY_INLINE bool run() { return go_down(0); }
  TOFRAY_INLINE bool run(const TileEntries& from) {
    constexpr int n = num::lanes<F>;
    for (int first = 0; first < from.count; first += n) {
      const BeamBoxes<F> boxes{{from.low[0] + first, from.low[1] + first, from.low[2] + first},
                               {from.high[0] + first, from.high[1] + first, from.high[2] + first}};
      F near;
      std::uint32_t met = num::lanes_of(boxes.within(beam_, far_, near));
      if (from.count - first < n) met &= first_of(from.count - first);
      alignas(64) float nears[n];
      store_all(nears, near);
      if (beam_.begin + at_least(nears[0] - beam_.begin) > far_) return true;
      for (; met != 0; met &= met - 1) {
        const int i = __builtin_ctz(met);
        if (nears[i] > far_) continue;
        if (!go_down(from.child[first + i])) return false;
        if (any && !num::any(open_)) return true;
      }
    }
    return true;
  }
  /// The rays that look for more.
  [[nodiscard]] TOFRAY_INLINE Mask<F> looking() const { return open_; }

 private:
  using Eight = num::Eight<F>;
  TOFRAY_INLINE bool go_down(std::int32_t child) {
    int waiting = 0;
    while (true) {
      if (child < 0) {
        test(child);
        if (left_ < 0) return false;
      } else {
        open(form_.nodes[child], waiting);
      }
      do {
        if (waiting == 0) return true;
        child = stack_[--waiting].child;
      } while (stack_[waiting].near > far_);
    }
  }

  /// Puts the children that the beam meets on the stack, the nearest on top.
  TOFRAY_INLINE void open(const MeshNode& node, int& waiting) {
    Eight near;
    std::uint32_t met = children_in(node, beam_, far_, near);
    alignas(64) float nears[mesh_width];
    store_all(nears, near);
    const int before = waiting;
    for (; met != 0; met &= met - 1) {
      const int i = __builtin_ctz(met);
      int at = waiting++;
      for (; at > before && stack_[at - 1].near < nears[i]; --at) stack_[at] = stack_[at - 1];
      stack_[at] = {node.child[i], nears[i]};
    }
  }

  /// Nothing deeper is nearer than what the rays have hit.
  TOFRAY_INLINE void see_how_far() {
    far_ = num::highest(num::select(open_, hit_.t * depth_per_t_, F(-3e38f))) + beam_.sign * beam_.origin[beam_.z] + beam_.slack;
  }

  /// A block's corners as they are from the origin.
  struct Corners {
    alignas(64) float at[3][3][block_width];
  };

  /// Of a block's triangles those that are not outside the beam.
  TOFRAY_INLINE std::uint32_t triangles_in(const MeshTriangles& block, Corners& corners) const {
    const auto from_origin = [&](int c, int k) TOFRAY_LAMBDA {
      const F out = load_all<F>(block.corner[c][k]) - F(beam_.origin[k]);
      store_all(corners.at[c][k], out);
      return out;
    };
    const F sign = F(beam_.sign), z[3] = {from_origin(0, beam_.z), from_origin(1, beam_.z), from_origin(2, beam_.z)};
    const F nearest = num::min(sign * z[0], num::min(sign * z[1], sign * z[2]));
    const F deepest = num::max(sign * z[0], num::max(sign * z[1], sign * z[2]));
    auto met = (nearest <= F(far_ - beam_.begin)) & (deepest >= F(-beam_.slack));
    for (const Beam::Side& s : beam_.side) {
      F at[3], until[3];
      for (int c = 0; c < 3; ++c) {
        const F x = from_origin(c, s.x);
        at[c] = num::fnma(F(s.from), z[c], x), until[c] = num::fnma(F(s.to), z[c], x);
      }
      met = met & (num::max(at[0], num::max(at[1], at[2])) >= F(-s.room)) & (num::min(until[0], num::min(until[1], until[2])) <= F(s.room));
    }
    return num::lanes_of(met);
  }

  TOFRAY_INLINE void test(std::int32_t leaf) {
    const MeshTriangles& block = form_.triangles[block_of(leaf)];
    Corners corners;
    auto changed = F(1.0f) < F(0.0f);
    const std::uint32_t met = triangles_in(block, corners) & first_of(count_of(leaf));
    left_ -= __builtin_popcount(met);
    for (std::uint32_t left = met; left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      const std::int32_t number = block.number[i], triangle = block_of(leaf) * block_width + i;
      const auto corner = [&](int c, int k) TOFRAY_LAMBDA { return F(corners.at[c][k][i]); };
      changed = changed | test(corner, along_, main_, number, triangle);
      for (int k = 0; k < 3 && has_others_; ++k) {
        if (k != beam_.z) changed = changed | test(corner, other_[k], others_[k], number, triangle);
      }
    }
    if (!num::any(changed)) return;
    if (any) open_ = open_ & (!changed);
    see_how_far();
  }

  /// @return the rays that it is nearer for. (No branch where nothing is cut out: it is met as often as not, and the next triangle need not wait for it.)
  template <class Corner>
  TOFRAY_INLINE Mask<F> test(const Corner& corner, const Sheared<F>& along, Mask<F> its, std::int32_t number, std::int32_t triangle) {
    F t = F(0.0f);
    MeshParts<F> parts;
    auto inside = open_ & its & meet<false>(corner, along, t, parts);
    if (cut) {
      if (!num::any(inside)) return inside;
      inside = not_cut_out(form_, triangle, parts, inside);
    }
    return take_nearer(inside, t, number, triangle, shortest_, hit_);
  }

  const MeshForm& form_;
  Beam beam_;
  F shortest_;
  Mask<F> open_;
  MeshHit<F>& hit_;
  Sheared<F> along_, other_[3];  ///< by the beam's axis, which is the longest coordinate of `main_`; and by each other's
  Mask<F> main_, others_[3];
  bool has_others_;
  F depth_per_t_;
  float far_;
  int left_;  ///< triangles that it may still meet
  MeshEntry stack_[most_mesh_stack];
};

/// Squares of a tile that meet more triangles than a beam is good for: sixteen rays alone take as long as a beam for some 150 that are in the
/// caches. What is dense for one mostly is for the next. It changes no hit.
class DenseSquares {
 public:
  /// Triangles that a beam may meet.
  TOFRAY_INLINE int most_triangles() const { return found_ ? 100 : few_triangles; }
  /// Whether the next one looks ray by ray at once.
  TOFRAY_INLINE bool skips() { return left_-- > 0; }
  /// One was. The next three are not tried; after a second one none of the tile, which has sixteen.
  TOFRAY_INLINE void add() {
    left_ = found_ ? 16 : 3;
    found_ = true;
  }

  static constexpr int few_triangles = 256;

 private:
  int left_ = 0;
  bool found_ = false;
};

/// Four rays in each of four rows, from ray number `at` on.
/// @param dense  of the squares of the tile before it
template <bool any, bool cut, class F>
TOFRAY_NOINLINE void search_square(const MeshForm& form, const Beam& beam, const TileEntries& entries, TileRays& rays, int at,
                                   DenseSquares& dense) {
  MeshHit<F> hit{num::load_square<F>(rays.far + at, TileRays::row), Int<F>(0x7fffffff), Int<F>(-1)};
  auto wanted = hit.t > F(0.0f);
  if (num::any(wanted)) {
    MeshRay<F> ray{{F(form.origin[0]), F(form.origin[1]), F(form.origin[2])}, {}, F(form.slack)};
    TileRays::load_square(rays.direction, 3, at, ray.direction);
    const F shortest = num::load_square<F>(rays.shortest + at, TileRays::row);
    bool alone = dense.skips();
    if (!alone) {
      F slope[2];
      TileRays::load_square(rays.slope, 2, at, slope);
      MeshSquare<any, cut, F> square(form, beam, ray.direction, slope, shortest, wanted, dense.most_triangles(), hit);
      alone = !square.run(entries);
      if (alone) dense.add();
      wanted = square.looking();
    }
    if (alone && num::any(wanted)) search_mesh<any>(form, ray, shortest, wanted, hit);
  }
  num::store_square(rays.t + at, TileRays::row, hit.t);
  num::store_square(rays.triangle + at, TileRays::row, num::from_bits(num::to_uint(hit.triangle)));
}

/// Sixteen rays of one origin, from the root: as a beam or, where they are no beam or few, each by itself.
template <bool any, class F>
TOFRAY_NOINLINE void search_from_root(const MeshForm& form, const MeshRay<F>& ray, F shortest, Mask<F> wanted, MeshHit<F>& hit) {
  constexpr int few = 3;
  const F(&d)[3] = ray.direction;
  const int axis = num::first_of(wanted, longest_of(d)), x = next_coordinate(axis), y = next_coordinate(x);
  const F length = num::select(wanted, d[axis], F(1.0f)), slope[2] = {d[x] / length, d[y] / length};
  const bool forward = !num::any(length <= F(0.0f)), backward = !num::any(wanted & (d[axis] >= F(0.0f)));
  const bool steep = num::any(wanted & (num::max(num::abs(slope[0]), num::abs(slope[1])) >= F(4.0f)));
  if (__builtin_popcount(num::lanes_of(wanted)) <= few || steep || !(forward || backward))
    return search_mesh<any>(form, ray, shortest, wanted, hit);
  Beam beam;
  beam.start(form), beam.go_along(axis, forward);
  const auto run = [&](auto&& square) TOFRAY_LAMBDA {
    if (!square.run()) search_mesh<any>(form, ray, shortest, square.looking(), hit);
  };
  if (form.cut == nullptr) {
    run(MeshSquare<any, false, F>(form, beam, d, slope, shortest, wanted, DenseSquares::few_triangles, hit));
  } else {
    run(MeshSquare<any, true, F>(form, beam, d, slope, shortest, wanted, DenseSquares::few_triangles, hit));
  }
}

/// The beam of a tile along the coordinate that is longest for most rays; and their slopes by it.
/// @return false where they are no beam: some go the other way along it, or almost across
template <class F>
TOFRAY_INLINE bool make_beam(const MeshForm& form, TileRays& rays, Beam& beam, float& far) {
  F sum[3] = {F(0.0f), F(0.0f), F(0.0f)}, direction[3];
  for (int i = 0; i < TileRays::count; i += num::lanes<F>) {
    F given[3];
    TileRays::load(rays.given, 3, i, given);
    const MeshRay<F> ray = in_mesh(form, given);
    const auto wanted = load_all<F>(rays.far + i) > F(0.0f);
    for (int k = 0; k < 3; ++k) {
      store_all(rays.direction[k] + i, ray.direction[k]);
      sum[k] = sum[k] + num::select(wanted, num::abs(ray.direction[k]), F(0.0f));
    }
  }
  const float x = num::highest(sum[0]), y = num::highest(sum[1]), z = num::highest(sum[2]);
  const int axis = x > y && x > z ? 0 : y > z ? 1 : 2;
  const int others[2] = {next_coordinate(axis), next_coordinate(next_coordinate(axis))};
  const F most = F(3e38f);
  F shortest = most, longest = -most, deepest = -most, least[2] = {most, most}, largest[2] = {-most, -most};
  for (int i = 0; i < TileRays::count; i += num::lanes<F>) {
    TileRays::load(rays.direction, 3, i, direction);
    const F far_of_each = load_all<F>(rays.far + i);
    const auto wanted = far_of_each > F(0.0f);
    const F along = direction[axis], length = num::select(wanted & (along != F(0.0f)), along, F(1.0f));
    shortest = num::min(shortest, num::select(wanted, along, most)), longest = num::max(longest, num::select(wanted, along, -most));
    deepest = num::max(deepest, num::select(wanted, far_of_each * num::abs(along), -most));
    for (int j = 0; j < 2; ++j) {
      const F slope = direction[others[j]] / length;
      least[j] = num::min(least[j], num::select(wanted, slope, most)), largest[j] = num::max(largest[j], num::select(wanted, slope, -most));
      store_all(rays.slope[j] + i, slope);
    }
  }
  const bool forward = num::lowest(shortest) > 0, backward = num::highest(longest) < 0;
  bool narrow = forward || backward;
  beam.start(form), beam.go_along(axis, forward);
  for (int j = 0; j < 2; ++j) {
    const float low = num::lowest(least[j]), high = num::highest(largest[j]);
    narrow = narrow && low > -4 && high < 4;
    beam.bound(beam.side[j], low, high);
  }
  far = num::highest(deepest) + beam.sign * beam.origin[axis] + beam.slack;
  return narrow;
}

/// Each ray without regard to where the others go, sixteen at once. (They are neighbours, so that packs do as well as rays alone.)
/// @param form  of one origin, or of parallel light
template <bool any, class F, class Form>
TOFRAY_NOINLINE void search_square_alone(const Form& form, TileRays& rays, int at) {
  F given[3];
  TileRays::load_square(rays.given, 3, at, given);
  MeshHit<F> hit{num::load_square<F>(rays.far + at, TileRays::row), Int<F>(0x7fffffff), Int<F>(-1)};
  const auto wanted = hit.t > F(0.0f);
  const F shortest = num::load_square<F>(rays.shortest + at, TileRays::row);
  if (num::any(wanted)) search_together<any>(form, in_mesh(form, given), shortest, wanted, hit);
  num::store_square(rays.t + at, TileRays::row, hit.t);
  num::store_square(rays.triangle + at, TileRays::row, num::from_bits(num::to_uint(hit.triangle)));
}

template <class Search>
TOFRAY_INLINE void each_square(const Search& search) {
  for (int y = 0; y < flow::tile_height; y += 4)
    for (int x = 0; x < flow::tile_width; x += 4) search(y * TileRays::row + x);
}

/// What the rays of a tile meet that have one origin.
template <bool any, class F>
TOFRAY_INLINE void search_tile(const MeshForm& form, TileRays& rays) {
  using Square = num::Square<F>;
  Beam beam;
  float far = 0;
  if (make_beam<F>(form, rays, beam, far)) {
    TileEntries entries;
    find_entries<Square>(form.nodes, beam, far, entries);
    DenseSquares dense;
    if (form.cut == nullptr) {
      each_square([&](int at) TOFRAY_LAMBDA { search_square<any, false, Square>(form, beam, entries, rays, at, dense); });
    } else {
      each_square([&](int at) TOFRAY_LAMBDA { search_square<any, true, Square>(form, beam, entries, rays, at, dense); });
    }
  } else {
    each_square([&](int at) TOFRAY_LAMBDA { search_square_alone<any, Square>(form, rays, at); });
  }
}

/// Searches a mesh for rays of a tile that go to the sun.
template <bool any, class F>
TOFRAY_INLINE void search_tile(const MeshAlong& form, TileRays& rays) {
  each_square([&](int at) TOFRAY_LAMBDA { search_square_alone<any, num::Square<F>>(form, rays, at); });
}

}  // namespace tofray::shape
