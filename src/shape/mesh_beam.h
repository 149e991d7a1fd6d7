// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/mesh_search.h"

/// Rays of one origin, side by side, meet the same boxes and triangles: they go through a mesh's hierarchy as a beam, between four planes.
/// Boxes and triangles are held against the planes many at once; only triangles that the beam may meet are tested, for sixteen rays (4 × 4)
/// at once, by the same test as anywhere else (`meet`). The beam of a whole tile goes first, and leaves to its squares the boxes that they
/// begin with.
///
/// Planes are as far outside the rays as boxes are wider than triangles in mesh_search.h. So the hits are those of search_mesh, bit by bit.
namespace tofray::shape {

/// Rays of a tile, row by row, and what they meet.
struct TileRays {
  static constexpr int row = flow::tile_width, count = flow::tile_width * flow::tile_height;
  using Array = float[count];
  alignas(64) Array given[3];      ///< directions of rays that have one origin, or origins of those that have one direction
  alignas(64) Array shortest;      ///< t must be above it
  alignas(64) Array far;           ///< what lies beyond is not looked for; below 0: no ray
  alignas(64) Array t;             ///< where a triangle is met, if it is
  alignas(64) Array triangle;      ///< bits of a number: which one; −1: none
  alignas(64) Array direction[3];  ///< in the mesh's frame
  alignas(64) Array slope[2];      ///< of it, by the axis of the tile's beam

  template <class F>
  TOFRAY_INLINE static void load(const Array* arrays, int count_of_them, int at, F* out) {
    for (int k = 0; k < count_of_them; ++k) out[k] = num::load<F>(arrays[k] + at, num::lanes<F>);
  }
  template <class S>
  TOFRAY_INLINE static void load_square(const Array* arrays, int count_of_them, int at, S* out) {
    for (int k = 0; k < count_of_them; ++k) out[k] = num::load_square<S>(arrays[k] + at, row);
  }
};

/// Beams have an axis, z or −z of the mesh's frame (or another coordinate that has its place), and two planes for each of the others:
/// x − from·z >= at and x − to·z <= until.
struct Beam {
  struct Side {
    int x;  ///< which coordinate
    float from, to, at, until;
    float room;  ///< by so much the planes are outside the rays
  };
  float origin[3], slack;  ///< that of the mesh's boxes, twice
  int z;
  float sign;   ///< −1: it goes along −z
  float begin;  ///< nothing is met before this depth, which is sign·z
  Side side[2];

  TOFRAY_INLINE void start(const MeshForm& form) {
    for (int k = 0; k < 3; ++k) origin[k] = form.origin[k];
    slack = 2 * form.slack;
  }
  TOFRAY_INLINE void go_along(int axis, bool forward) {
    z = axis, sign = forward ? 1.0f : -1.0f;
    side[0].x = next_coordinate(z), side[1].x = next_coordinate(side[0].x);
    begin = sign * origin[z] - slack;
  }
  [[nodiscard]] TOFRAY_INLINE bool ahead() const { return sign > 0; }
  /// Its rays have slopes, x by z, between these.
  TOFRAY_INLINE void bound(Side& s, float least, float largest) const {
    s.from = ahead() ? least : largest, s.to = ahead() ? largest : least;
    s.room = slack * (1 + num::max(num::abs(least), num::abs(largest)));
    s.at = num::fnma(s.from, origin[z], origin[s.x]) - s.room;
    s.until = num::fnma(s.to, origin[z], origin[s.x]) + s.room;
  }
};

/// Boxes, by their ends along each coordinate.
/// \tparam V  so many of them
template <class V>
struct BeamBoxes {
  const float *low[3], *high[3];

  /// Of these boxes those that are not outside the beam, nor deeper than `far`. @param near  out: the depth at which each one begins
  TOFRAY_INLINE num::Mask<V> within(const Beam& beam, float far, V& near) const {
    near = V(beam.sign) * load_all<V>(beam.ahead() ? low[beam.z] : high[beam.z]);
    const V end = V(beam.sign) * load_all<V>(beam.ahead() ? high[beam.z] : low[beam.z]);
    return between(beam, beam.side[0]) & between(beam, beam.side[1]) & (near <= V(far)) & (end >= V(beam.begin));
  }

 private:
  TOFRAY_INLINE num::Mask<V> between(const Beam& beam, const Beam::Side& s) const {
    const V at = num::fnma(V(s.from), load_all<V>(s.from > 0 ? low[beam.z] : high[beam.z]), load_all<V>(high[s.x]));
    const V until = num::fnma(V(s.to), load_all<V>(s.to > 0 ? high[beam.z] : low[beam.z]), load_all<V>(low[s.x]));
    return (at >= V(s.at)) & (until <= V(s.until));
  }
};

/// Children of a node that a beam meets, a bit for each.
template <class V>
TOFRAY_INLINE std::uint32_t children_in(const MeshNode& node, const Beam& beam, float far, V& near) {
  const BeamBoxes<V> boxes{{node.low[0], node.low[1], node.low[2]}, {node.high[0], node.high[1], node.high[2]}};
  return num::lanes_of(boxes.within(beam, far, near)) & first_of(node.children);
}

/// Boxes that a tile's beam meets, where its squares begin; the nearest first.
struct TileEntries {
  static constexpr int most = 80;
  int count;
  alignas(64) float low[3][most], high[3][most];
  std::int32_t child[most];
};

/// Boxes on their way to the entries: each by its node and its place there.
struct TileQueue {
  static constexpr int most = 4 * TileEntries::most;
  std::int32_t box[most + mesh_width];
  float near[most + mesh_width];
  int end = 0;

  /// (No branch for each box: nobody can foresee which of the eight are met.)
  template <class Eight>
  TOFRAY_INLINE void add(std::int32_t node, std::uint32_t met, Eight near_of) {
    alignas(64) float nears[mesh_width];
    store_all(nears, near_of);
    for (int i = 0; i < mesh_width; ++i) {
      box[end] = node * mesh_width + i, near[end] = nears[i];
      end += static_cast<int>(met >> i & 1u);
    }
  }
  [[nodiscard]] TOFRAY_INLINE bool has_room() const { return end + mesh_width <= most; }
};

/// Puts numbers >= 0 in their order, to 1 in 65,536. @param place  out: of each one
template <class F>
TOFRAY_INLINE void order(const float* numbers, int count, int* place) {
  constexpr int n = num::lanes<F>;
  constexpr std::uint32_t low_bits = 127;
  static_assert(TileEntries::most <= low_bits && TileEntries::most % n == 0);
  alignas(64) std::int32_t key[TileEntries::most];  // no two are the same
  for (int i = 0; i < count; ++i) key[i] = static_cast<std::int32_t>((num::bits(numbers[i]) & ~low_bits) | static_cast<std::uint32_t>(i));
  for (int i = count; i % n != 0; ++i) key[i] = 0x7fffffff;
  for (int i = 0; i < count; ++i) {
    place[i] = 0;
    for (int j = 0; j < count; j += n) place[i] += __builtin_popcount(num::lanes_of(num::load_int<F>(key + j, n) < num::Int<F>(key[i])));
  }
}
/// What comes later in that order is not less than this.
TOFRAY_INLINE float at_least(float number) { return number * (1 - 0x1p-15f); }

/// The boxes that a tile's beam meets, opened level by level until there are many.
template <class F>
TOFRAY_NOINLINE void find_entries(const MeshNode* nodes, const Beam& beam, float far, TileEntries& out) {
  using Eight = num::Eight<F>;
  TileQueue queue;
  const auto open = [&](std::int32_t number) TOFRAY_LAMBDA {
    Eight near;
    const std::uint32_t met = children_in(nodes[number], beam, far, near);
    queue.add(number, met, num::max(near - Eight(beam.begin), Eight(0.0f)));
  };
  open(0);
  int kept = 0;
  for (int i = 0; i < queue.end; ++i) {
    const std::int32_t box = queue.box[i], child = nodes[box / mesh_width].child[box % mesh_width];
    const int all = kept + queue.end - i;
    if (child >= 0 && all + mesh_width <= TileEntries::most && queue.has_room()) {
      open(child);
    } else {
      queue.box[kept] = box, queue.near[kept++] = queue.near[i];
    }
  }
  int place[TileEntries::most];
  order<F>(queue.near, kept, place);
  out.count = kept;
  for (int i = 0; i < kept; ++i) {
    const MeshNode& node = nodes[queue.box[i] / mesh_width];
    const int slot = queue.box[i] % mesh_width, at = place[i];
    for (int k = 0; k < 3; ++k) out.low[k][at] = node.low[k][slot], out.high[k][at] = node.high[k][slot];
    out.child[at] = node.child[slot];
  }
}

}  // namespace tofray::shape
