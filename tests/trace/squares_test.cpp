// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Squares of a tile's rays, which look for many forms the nearest first, find what each ray finds that is held against one form after the
// other, bit by bit, with each instruction set: from the camera, from lights, and in the sun.
#include <gtest/gtest.h>

#include <cstring>

#include "backend/cpu/cpu.h"
#include "support/crowd.h"
#include "support/culler.h"
#include "support/rays.h"
#include "support/sanitizers.h"
#include "trace/squares.h"

using namespace tofray;
using namespace tofray::test;
using shape::TileRays;

namespace {

struct SquareSet {
  const char* name;
  Isa isa;
  SquareSearchFunction search;
};
#define ONE_SET(set) {#set, Isa::set, square_search_##set},
const std::vector<SquareSet> square_sets = {TOFRAY_SETS(ONE_SET)};
#undef ONE_SET

/// Those that run here, the widest last.
std::vector<SquareSet> sets_here() {
  std::vector<SquareSet> out;
  for (const SquareSet& set : square_sets)
    if (backend::can_run(set.isa)) out.push_back(set);
  return out;
}

/// Spheres, boxes and instances of one mesh, on a lattice: they touch their neighbours, have parts of faces in common with them or stand in
/// them, and some stand twice at one place.
Scene lattice(Random& random, int side) {
  constexpr double step = 0.1;
  Scene scene;
  std::vector<Object> twins;
  scene.materials = {{"matt", Material::Brdf::lambert, 0.7, 0, 1}};
  const auto rock = shared(single(stone(random, 1, 0.7 * step, {0, 0, 0})));
  for (int i = 0; i < side * side * side; ++i) {
    const Vec3 at{step * (i % side - 0.5 * side), step * (i / side % side - 0.5 * side), 1.2 + step * (i / side / side)};
    const Vec3 half{random.between(0.5, 1.2) * step, random.between(0.5, 1.2) * step, 0.5 * step};
    Object one;
    switch (random.below(6)) {
      case 0: one.shape = Sphere{at, 0.5 * step}; break;
      case 1: one.shape = Sphere{at + random.point(0.3 * step), random.scale(0.2, 0.9) * step}; break;
      case 2: one.shape = Box{at - half, at + half}; break;
      case 3: continue;
      default:
        one.shape = rock, one.position = at;
        if (random.below(2) == 0) one.rotation = {random.direction(), random.between(-3, 3)};
    }
    scene.objects.push_back(one);
    if (random.below(6) == 0) twins.push_back(one);
  }
  scene.objects.insert(scene.objects.end(), twins.rbegin(), twins.rend());
  scene.ambient.direction = Vec3{0.3, 0.5, 1} + random.point(0.3);
  return scene;
}

/// What a tile of a lens, or of anything, may see.
void look_somewhere(Random& random, SquareTile& tile) {
  const double x = random.between(-0.5, 0.5), y = random.between(-0.5, 0.5), pitch = random.scale(3e-4, 0.03);
  const bool scattered = random.below(4) == 0;
  const int count = random.below(4) == 0 ? 1 + random.below(TileRays::count) : TileRays::count;
  for (int i = 0; i < TileRays::count; ++i) {
    const double across = scattered ? 16 * random.between(-1, 1) : i % TileRays::row - 15.5;
    const double down = scattered ? 4 * random.between(-1, 1) : i / TileRays::row - 3.5;
    tile.x[i] = static_cast<float>(x + pitch * across), tile.y[i] = static_cast<float>(y + pitch * down), tile.z[i] = 1;
    tile.wanted[i] = i < count ? 1.0f : 0.0f;
  }
}

/// A little before what the rays of a tile have met, or somewhere, as an eye sees it. @param eye  null: no eye, but the sun
void go_there(Random& random, const scene::SceneView& s, const SquareTile& from, const shape::Vec* eye, SquareTile& to) {
  const bool anywhere = random.below(4) == 0;
  for (int i = 0; i < TileRays::count; ++i) {
    const bool met = from.w[i] > 0 && !anywhere;
    const double t = met ? (1 - 1e-5) / static_cast<double>(from.w[i]) : random.between(0.9, 2.5);
    const Vec3 at{t * static_cast<double>(from.x[i]), t * static_cast<double>(from.y[i]), t};
    const Vec3 way = eye != nullptr ? at - vec3(*eye) : at;
    to.x[i] = static_cast<float>(way[0]), to.y[i] = static_cast<float>(way[1]), to.z[i] = static_cast<float>(way[2]);
    to.range[i] = static_cast<float>(base::length(at)), to.wanted[i] = from.wanted[i];
    to.object[i] = met ? s.facets[from.facet[i]].object : random.below(20) == 0 ? 5 : -1;
  }
}

/// @return false: there is none, or no rectangle
bool rectangle_of(const SquareTile& tile, scene::Bounds& out) {
  pipeline::Rectangle<float> seen;
  for (int i = 0; i < TileRays::count; ++i) seen.add(tile.x[i], tile.y[i], tile.z[i], tile.wanted[i] > 0);
  out = seen.bounds();
  return !seen.open;
}
scene::Bounds on_screen(const SquareTile& tile, const shape::Vec& toward_sun) {
  const pipeline::OnScreen<float> screen(toward_sun);
  pipeline::Rectangle<float> seen;
  for (int i = 0; i < TileRays::count; ++i) screen.add(tile.x[i], tile.y[i], tile.z[i], tile.wanted[i] > 0, seen);
  return seen.bounds();
}

bool same_at(const SquareSearch& what, const SquareTile& one, const SquareTile& other, int i) {
  if (what.shadow) return (one.dark[i] > 0) == (other.dark[i] > 0);
  if (std::memcmp(one.w + i, other.w + i, sizeof one.w[i]) != 0) return false;
  return !(one.w[i] > 0) || (one.facet[i] == other.facet[i] && one.triangle[i] == other.triangle[i]);
}

struct Counts {
  long rays = 0, met = 0, squares = 0;
};

/// All sets find in the rectangle what one of them finds without any, which is left in the tile.
/// @param sets  the first of them does
template <class Forms>
void compare_squares(const std::vector<SquareSet>& sets, SquareSearch what, const Forms& forms, const scene::Bounds& rectangle,
                     Counts& counts) {
  static SquareTile reference, other;
  Culler culler(forms);
  what.marks = culler.marks(), what.room = culler.room();
  SquareTile& tile = *what.tile;
  reference = tile, what.tile = &reference;
  sets.front().search(&what);
  for (const SquareSet& set : sets) {
    SquareSearch how = what;
    other = tile;
    how.rectangle = &rectangle, how.tile = &other;
    set.search(&how);
    counts.squares += how.by_squares;
    for (int i = 0; i < TileRays::count; ++i) {
      ASSERT_TRUE(!(tile.wanted[i] > 0) || same_at(what, reference, other, i)) << set.name << ", ray " << i;
    }
  }
  tile = reference;
  for (int i = 0; i < TileRays::count; ++i) {
    if (!(tile.wanted[i] > 0)) continue;
    ++counts.rays, counts.met += what.shadow ? tile.dark[i] > 0 : tile.w[i] > 0;
  }
}

class Squares : public testing::TestWithParam<int> {};

}  // namespace

// A dozen thousand rays in each of four scenes, and their shadow rays; so many as TOFRAY_LONG_RAYS says where it is set.
TEST_P(Squares, find_what_one_form_after_the_other_has) {
  const std::vector<SquareSet> sets = sets_here();
  if (sets.empty()) GTEST_SKIP() << "this machine has no fused products";
  const std::vector<SquareSet> with_packs(sets.size() > 1 ? sets.begin() + 1 : sets.begin(), sets.end());
  Random random(static_cast<std::uint64_t>(500 + GetParam()));
  const Scene scene = lattice(random, with_sanitizers ? 7 : 12);
  const scene::FrozenScene frozen(scene, {Vec3{0.03, 0, 0}, 0.5 * random.direction()}, 1);
  const scene::SceneView& s = frozen.view();
  Counts seen, shaded, in_sun;
  static SquareTile tile, there;
  const int rays = often_unless("TOFRAY_LONG_RAYS", 12'000);
  for (int tiles = 0; seen.rays < rays && !HasFatalFailure(); ++tiles) {
    const std::vector<SquareSet>& asked = tiles % 16 == 0 ? sets : with_packs;  // one ray after the other is slow
    look_somewhere(random, tile);
    scene::Bounds rectangle{};
    ASSERT_TRUE(rectangle_of(tile, rectangle));
    const scene::Forms forms = s.camera_still();
    compare_squares(asked, {&forms, nullptr, false, nullptr, nullptr, nullptr, {}, nullptr, &tile, false}, forms, rectangle, seen);
    for (int l = 0; l < s.lights; ++l) {
      const scene::Forms from_light = s.light_still(l);
      go_there(random, s, tile, s.light_positions + l, there);
      if (!rectangle_of(there, rectangle)) continue;
      compare_squares(asked, {&from_light, nullptr, true, nullptr, nullptr, nullptr, {}, nullptr, &there, false}, from_light, rectangle,
                      shaded);
    }
    const scene::Alongs alongs = s.sun_still();
    go_there(random, s, tile, nullptr, there);
    compare_squares(asked, {nullptr, &alongs, true, s.toward_sun, s.sun(0), nullptr, {}, nullptr, &there, false}, alongs,
                    on_screen(there, *s.toward_sun), in_sun);
  }
  for (const Counts& one : {seen, shaded, in_sun}) {
    const bool few = one.rays < 5'000;  // with sanitizers, of some tiles alone: shares are chance
    EXPECT_GT(one.met, few ? 0 : one.rays / 10);
    EXPECT_LT(one.met, few ? one.rays + 1 : one.rays * 99 / 100);
    EXPECT_GT(one.squares * TileRays::count, few || sets.size() <= 1 ? -1 : one.rays / 4);
  }
}
INSTANTIATE_TEST_SUITE_P(scene, Squares, testing::Range(0, 4));
