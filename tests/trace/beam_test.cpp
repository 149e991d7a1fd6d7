// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Beams of rays find what each ray finds by itself, bit by bit, with each instruction set; and so do rays alone against many boxes and triangles
// at once, and a look at every triangle.
#include <gtest/gtest.h>

#include <cstring>

#include "backend/cpu/cpu.h"
#include "scene/hierarchy.h"
#include "scene/map_levels.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/random_scene.h"
#include "support/rays.h"
#include "support/sanitizers.h"
#include "trace/tile_search.h"

using namespace tofray;
using namespace tofray::test;
using shape::TileRays;

namespace {

struct Set {
  const char* name;
  Isa isa;
  TileSearchFunction search;
};
#define ONE_SET(set) {#set, Isa::set, tile_search_##set},
const Set all_sets[] = {TOFRAY_SETS(ONE_SET){"scalar", Isa::scalar, tile_search_scalar}};
#undef ONE_SET
/// What the others are held against: each ray by itself. (Plain scalar code has its fused products in software on x86.)
const Set& yardstick = all_sets[0].isa == Isa::scalar_fma ? all_sets[0] : all_sets[std::size(all_sets) - 1];

/// The one with the widest packs that run here; null: none do.
const Set* widest() {
  const Set* found = nullptr;
  for (const Set& set : all_sets) {
    if (set.isa != Isa::scalar && set.isa != Isa::scalar_fma && backend::can_run(set.isa)) found = &set;
  }
  return found;
}

/// A mesh somewhere, turned somehow.
struct Placed {
  scene::Hierarchy built;
  shape::Mesh mesh;
  scene::MapLevels opacity;

  /// @param cut  a third of it is cut out
  Placed(TriangleMesh triangles, const base::Mat3& turn, const Vec3& shift, bool cut) : opacity(*random_opacity()) {
    Random random(97);
    if (cut) add_details(random, triangles);
    built = scene::build_hierarchy(triangles);
    const shape::Placement at{{{vec(turn[0]), vec(turn[1]), vec(turn[2])}}, vec(shift)};
    mesh = shape::Mesh::placed(built, at);
    if (cut) mesh.cut = &opacity.view;
  }
};

/// Ground that goes up and down, seen along it: beams end nowhere, boxes are flat.
TriangleMesh ground(Random& random, int cells) {
  TriangleMesh out;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i)
      out.vertices.push_back({static_cast<float>(4.0 * i / cells - 2), static_cast<float>(random.between(0.2, 0.25)),
                              static_cast<float>(4.0 * j / cells - 2)});
  for (std::int32_t j = 0; j < cells; ++j)
    for (std::int32_t i = 0; i < cells; ++i) {
      const std::int32_t a = j * (cells + 1) + i, below = a + cells + 1;
      out.triangles.push_back({a, below, a + 1}), out.triangles.push_back({a + 1, below, below + 1});
    }
  return out;
}

TriangleMesh some_mesh(Random& random, int kind) {
  switch (kind % 5) {
    case 0: return single(stone(random, 1 + kind % 4, 1, {0, 0, 0}));
    case 1: return single(icosphere(kind % 6));
    case 2: return garbage(random, 10 + random.below(50));
    case 3: return ground(random, 4 + random.below(60));
    default: return single(stone(random, 5, random.scale(1e-3, 1e3), random.point(1)));
  }
}

/// A rectangle of directions, as a lens sees them, about d.
void look_along(Random& random, const Vec3& d, double pitch, TileRays& rays) {
  const Vec3 axis = base::normalized(d), right = random.across(axis), down = base::cross(axis, right);
  const bool wild = random.below(20) == 0, both_ways = random.below(20) == 0;  // no beam at all
  const int count = random.below(4) == 0 ? 1 + random.below(TileRays::count) : TileRays::count;
  const bool near_limit = random.below(4) == 0;
  for (int i = 0; i < TileRays::count; ++i) {
    const double x = pitch * (i % TileRays::row - 15.5 + random.between(-0.3, 0.3)), y = pitch * (i / TileRays::row - 3.5);
    const double way = base::length(d) * (both_ways && i / 8 % 2 == 1 ? -1 : 1);
    const Vec3 to = wild ? random.direction() : way * (axis + x * right + y * down);
    for (std::size_t k = 0; k < 3; ++k) rays.given[k][i] = static_cast<float>(to[k]);
    rays.shortest[i] = random.below(8) == 0 ? 0.5f : shape::nearest_mesh;
    rays.far[i] = i >= count ? -1.0f : near_limit ? static_cast<float>(random.between(0.5, 1.5)) : 3e38f;
  }
}

/// Towards a corner of a block of the mesh; in the frame in which it is placed.
Vec3 toward_block(Random& random, const Placed& placed, int number, const Vec3& from) {
  const auto& blocks = placed.built.triangles;
  const shape::MeshTriangles& block = blocks[static_cast<std::size_t>(number) % blocks.size()];
  const int place = random.below(shape::block_width), c = random.below(3);
  Vec3 corner{};
  for (std::size_t k = 0; k < 3; ++k) corner[k] = static_cast<double>(block.corner[c][k][place]);
  const shape::Vec at = shape::back(placed.mesh.axes, vec(corner)) + placed.mesh.origin;
  const Vec3 to = Vec3{at.x, at.y, at.z} - from;
  return base::length(to) > 1e-6 ? to : random.direction();
}

Vec3 toward_mesh(Random& random, const Placed& placed, const Vec3& from) {
  return toward_block(random, placed, random.below(static_cast<int>(placed.built.triangles.size())), from);
}

/// Each ray at a corner, those of a square at corners that are close together: the outermost rays of its beam go through the outermost
/// corners of boxes, where rounding decides what is inside.
void look_at_corners(Random& random, const Placed& placed, const Vec3& from, TileRays& rays) {
  const int first = random.below(static_cast<int>(placed.built.triangles.size()));
  for (int i = 0; i < TileRays::count; ++i) {
    const Vec3 to = random.scale(0.1, 10) * toward_block(random, placed, first + i % TileRays::row / 4, from);
    for (std::size_t k = 0; k < 3; ++k) rays.given[k][i] = static_cast<float>(to[k]);
    rays.shortest[i] = shape::nearest_mesh, rays.far[i] = 3e38f;
  }
}

void search(const Set& set, const TileSearch& what, TileRays& found) {
  TileSearch here = what;
  found = *what.rays;
  here.rays = &found;
  set.search(&here);
}

std::int32_t triangle(const TileRays& rays, int i) {
  std::int32_t out = 0;
  std::memcpy(&out, rays.triangle + i, sizeof out);
  return out;
}

/// All sets agree about a tile. @return rays that met something
int same_in_all_sets(const TileSearch& what, bool scalar_too) {
  static TileRays one, other;
  search(yardstick, what, one);
  int met = 0;
  for (int i = 0; i < TileRays::count; ++i) met += what.rays->far[i] > 0 && triangle(one, i) >= 0;
  for (const Set& set : all_sets) {
    if (&set == &yardstick || !backend::can_run(set.isa) || (set.isa == Isa::scalar && !scalar_too)) continue;
    for (const bool alone : {false, true}) {
      TileSearch how = what;
      how.alone = alone;
      search(set, how, other);
      for (int i = 0; i < TileRays::count; ++i) {
        if (!(what.rays->far[i] > 0)) continue;
        const bool same = what.any || what.parallel != nullptr
                              ? (triangle(one, i) >= 0) == (triangle(other, i) >= 0)
                              : triangle(one, i) == triangle(other, i) && std::memcmp(one.t + i, other.t + i, 4) == 0;
        if (!same) ADD_FAILURE() << set.name << (alone ? " alone" : "") << " ray " << i;
        if (!same) return met;
      }
    }
  }
  return met;
}

class Beams : public testing::TestWithParam<int> {};

}  // namespace

// 20 scenes, a million rays in each: from near and far, along and across, narrow and wide, at what is seen and through it.
TEST_P(Beams, meet_what_each_ray_meets) {
  if (!backend::can_run(yardstick.isa)) GTEST_SKIP() << "this machine has no FMA";
  Random random(static_cast<std::uint64_t>(100 + GetParam()));
  const double away = GetParam() % 7 == 6 ? 1.5e5 : GetParam() % 7 == 5 ? 1e3 : 0;
  const Vec3 shift = away * Vec3{1, -0.7, 0.4};
  const Placed placed(some_mesh(random, GetParam()),
                      GetParam() % 2 == 0 ? random.rotation() : base::Mat3{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, shift, GetParam() % 3 == 1);
  static TileRays rays;
  int met = 0, tiles = 0;
  const double size = 2 * std::fmax(placed.mesh.half.x, std::fmax(placed.mesh.half.y, placed.mesh.half.z));
  for (; tiles * TileRays::count < 1'000'000 && !HasFailure(); ++tiles) {
    const Vec3 from = shift + (random.below(4) == 0 ? 0.1 * size * random.direction() : random.scale(0.3, 30) * size * random.direction());
    const shape::MeshForm form = shape::seen_from(placed.mesh, vec(from));
    if (tiles % 4 == 1) {
      look_at_corners(random, placed, from, rays);
    } else {
      look_along(random, toward_mesh(random, placed, from), random.scale(1e-5, 0.3), rays);
    }
    met += same_in_all_sets({&form, nullptr, tiles % 3 == 2, &rays}, tiles % 40 == 0);
    if (tiles % 8 != 0) continue;
    const shape::MeshAlong along = shape::seen_along(placed.mesh, vec(random.direction()));
    for (int i = 0; i < TileRays::count; ++i) {
      const Vec3 p = from + random.between(0.8, 1.2) * Vec3{static_cast<double>(rays.given[0][i]), static_cast<double>(rays.given[1][i]),
                                                            static_cast<double>(rays.given[2][i])};
      for (std::size_t k = 0; k < 3; ++k) rays.given[k][i] = static_cast<float>(p[k]);
    }
    met += same_in_all_sets({nullptr, &along, true, &rays}, tiles % 40 == 0);
  }
  EXPECT_GT(met, 10000) << tiles;
}
// The hierarchy leaves no triangle out: a look at every triangle, of up to 10,000, without any box, meets the same at the same t, bit by
// bit, and so do a ray by itself, with and without FMA in hardware, packs, and rays alone on a machine with packs. 20,000 rays in each of 20 scenes; so many as
// TOFRAY_LONG_RAYS says where it is set (.ci/long: a million).
TEST_P(Beams, meet_what_a_look_at_every_triangle_meets) {
  const Set* const packs = widest();
  if (packs == nullptr || !backend::can_run(yardstick.isa)) GTEST_SKIP() << "no packs on this machine";
  const int rays_wanted = often_unless("TOFRAY_LONG_RAYS", 20'000);
  Random random(static_cast<std::uint64_t>(300 + GetParam()));
  const Vec3 shift = (GetParam() % 7 == 6 ? 1.5e5 : 0) * Vec3{1, -0.7, 0.4};
  const int kind = GetParam() % 5;
  const Placed placed(kind == 4 ? single(stone(random, 4, random.scale(1e-3, 1e3), random.point(1))) : some_mesh(random, GetParam()),
                      GetParam() % 2 == 0 ? random.rotation() : base::Mat3{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, shift, GetParam() % 3 == 1);
  ASSERT_LE(placed.built.triangles.size() * shape::block_width, 30'000U);
  static TileRays rays, by_all, one, packed, alone, portable;
  int met = 0;
  const double size = 2 * std::fmax(placed.mesh.half.x, std::fmax(placed.mesh.half.y, placed.mesh.half.z));
  for (int tile = 0; tile * TileRays::count < rays_wanted && !HasFailure(); ++tile) {
    const Vec3 from = shift + (random.below(4) == 0 ? 0.1 : random.scale(0.3, 30)) * size * random.direction();
    const shape::MeshForm form = shape::seen_from(placed.mesh, vec(from));
    if (tile % 4 == 1) {
      look_at_corners(random, placed, from, rays);
    } else {
      look_along(random, toward_mesh(random, placed, from), random.scale(1e-5, 0.3), rays);
    }
    search(*packs, {&form, nullptr, false, &rays, static_cast<int>(placed.built.triangles.size())}, by_all);
    search(yardstick, {&form, nullptr, false, &rays}, one);
    search(*packs, {&form, nullptr, false, &rays}, packed);
    search(*packs, {&form, nullptr, false, &rays, 0, true}, alone);
    const bool slowly = tile % 40 == 0;
    if (slowly) search(all_sets[std::size(all_sets) - 1], {&form, nullptr, false, &rays}, portable);
    for (int i = 0; i < TileRays::count; ++i) {
      if (!(rays.far[i] > 0)) continue;
      met += triangle(by_all, i) >= 0;
      for (const TileRays* other : {&one, &packed, &alone, &portable}) {
        if (other == &portable && !slowly) continue;
        ASSERT_EQ(triangle(*other, i), triangle(by_all, i)) << tile << " " << i;
        ASSERT_EQ(std::memcmp(other->t + i, by_all.t + i, 4), 0) << tile << " " << i;
      }
    }
  }
  EXPECT_GT(met, rays_wanted / 100);
}
INSTANTIATE_TEST_SUITE_P(scene, Beams, testing::Range(0, 20));
