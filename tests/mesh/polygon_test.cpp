// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Faces that are not convex: their triangles have the area of the shoelace formula, and none lies beside them.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numbers>

#include "mesh/ear_clipping.h"
#include "mesh/polygons.h"
#include "mesh_files.h"

using namespace tofray;
using namespace tofray::mesh_test;

namespace {

/// Corners in a plane, in whole numbers: all areas are exact.
using Spot = std::array<std::int64_t, 2>;
using Outline = std::vector<Spot>;

/// Twice the area of a triangle, above 0 where it turns to the left.
std::int64_t doubled_area(const Spot& a, const Spot& b, const Spot& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

std::int64_t shoelace(const Outline& outline) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Spot &a = outline[i], &b = outline[(i + 1) % outline.size()];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

/// Where a plane lies: whole numbers again, so that floats hold the corners exactly.
struct Placed {
  std::array<std::int64_t, 3> zero, u, v;
  [[nodiscard]] std::array<std::int64_t, 3> at(const Spot& p) const {
    return {zero[0] + u[0] * p[0] + v[0] * p[1], zero[1] + u[1] * p[0] + v[1] * p[1], zero[2] + u[2] * p[0] + v[2] * p[1]};
  }
};
constexpr Placed in_xy{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

std::string obj_of(const Outline& outline, const Placed& plane = in_xy) {
  std::string text, face = "f";
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto p = plane.at(outline[i]);
    text += "v " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
    face += " " + std::to_string(i + 1);
  }
  return text + face + "\n";
}

std::string ply_of(const Outline& outline, const Placed& plane) {
  std::string text, face = std::to_string(outline.size());
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto p = plane.at(outline[i]);
    text += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
    face += " " + std::to_string(i);
  }
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(outline.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n" +
         text + face + "\n";
}

/// Each triangle turns as the outline does, and all together have its area: so each point is covered as often as the outline winds round it.
void expect_divided(const ReadMesh& read, const Outline& outline) {
  ASSERT_EQ(read.mesh.triangles.size(), outline.size() - 2);
  const std::int64_t turn = shoelace(outline) < 0 ? -1 : 1;
  std::int64_t sum = 0;
  for (const auto& [a, b, c] : read.mesh.triangles) {
    const std::int64_t area = turn * doubled_area(outline[static_cast<std::size_t>(a)], outline[static_cast<std::size_t>(b)],
                                                  outline[static_cast<std::size_t>(c)]);
    EXPECT_GE(area, 0);
    sum += area;
  }
  EXPECT_EQ(sum, turn * shoelace(outline));
  EXPECT_TRUE(read.notices.empty()) << read.notices[0];
}

/// By crossings of a ray, which know nothing of triangles.
bool is_inside(const Outline& outline, double x, double y) {
  bool in = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto [ax, ay] = outline[i];
    const auto [bx, by] = outline[(i + 1) % outline.size()];
    const auto ya = static_cast<double>(ay), yb = static_cast<double>(by), xa = static_cast<double>(ax), xb = static_cast<double>(bx);
    if ((ya > y) != (yb > y) && x < xa + (xb - xa) * (y - ya) / (yb - ya)) in = !in;
  }
  return in;
}

int covered(const ReadMesh& read, const Outline& outline, double x, double y) {
  int times = 0;
  for (const auto& triangle : read.mesh.triangles) {
    Outline corners;
    for (const std::int32_t i : triangle) corners.push_back(outline[static_cast<std::size_t>(i)]);
    times += is_inside(corners, x, y) ? 1 : 0;
  }
  return times;
}

/// No corner has a coordinate that is a half plus something irrational.
void expect_covers_what_is_inside(const ReadMesh& read, const Outline& outline, out_test::Random& random, std::uint64_t size) {
  for (int trial = 0; trial < 200; ++trial) {
    const double x = static_cast<double>(random.below(size)) + 1 / std::numbers::pi,
                 y = static_cast<double>(random.below(size)) + 1 / std::numbers::e;
    EXPECT_EQ(covered(read, outline, x, y), is_inside(outline, x, y) ? 1 : 0) << x << " " << y;
  }
}

Outline turned(Outline outline, std::size_t by) {
  std::rotate(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(by % outline.size()), outline.end());
  return outline;
}

Placed random_plane(out_test::Random& random) {
  for (;;) {
    Placed out{};
    for (auto* const vector : {&out.zero, &out.u, &out.v})
      for (std::int64_t& one : *vector) one = static_cast<std::int64_t>(random.below(13)) - 6;
    const auto& [zero, u, v] = out;
    if (u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0]) return out;
  }
}

bool touch(const Spot& a, const Spot& b, const Spot& c, const Spot& d) {
  const auto sign = [](std::int64_t x) { return x < 0 ? -1 : x > 0 ? 1 : 0; };
  const auto on = [&](const Spot& p, const Spot& q, const Spot& r) {
    return doubled_area(p, q, r) == 0 && std::min(p[0], q[0]) <= r[0] && r[0] <= std::max(p[0], q[0]) && std::min(p[1], q[1]) <= r[1] &&
           r[1] <= std::max(p[1], q[1]);
  };
  if (on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b)) return true;
  return sign(doubled_area(a, b, c)) * sign(doubled_area(a, b, d)) < 0 && sign(doubled_area(c, d, a)) * sign(doubled_area(c, d, b)) < 0;
}

/// Points in any order, untangled: where two edges cross, the way between them is walked the other way round.
Outline random_simple(out_test::Random& random, std::size_t corners, std::uint64_t size) {
  for (;;) {
    Outline out;
    while (out.size() < corners) {
      const Spot p{static_cast<std::int64_t>(random.below(size)), static_cast<std::int64_t>(random.below(size))};
      if (std::find(out.begin(), out.end(), p) == out.end()) out.push_back(p);
    }
    const std::size_t n = out.size();
    bool tangled = true;
    for (int rounds = 0; tangled && rounds < 200; ++rounds) {
      tangled = false;
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = i + 2; k < n; ++k)
          if ((k + 1) % n != i && touch(out[i], out[i + 1], out[k], out[(k + 1) % n])) {
            std::reverse(out.begin() + static_cast<std::ptrdiff_t>(i) + 1, out.begin() + static_cast<std::ptrdiff_t>(k) + 1);
            tangled = true;
          }
    }
    for (std::size_t i = 0; i < n; ++i)  // neighbours back to back
      tangled = tangled || (doubled_area(out[i], out[(i + 1) % n], out[(i + 2) % n]) == 0 &&
                            touch(out[i], out[(i + 1) % n], out[(i + 2) % n], out[(i + 2) % n]));
    if (!tangled && shoelace(out) != 0) return out;
  }
}

/// A rectangle with square holes in a row, each joined to the lower edge by a slit.
Outline with_holes(std::int64_t holes) {
  Outline out{{0, 0}};
  for (std::int64_t i = 0; i < holes; ++i) {
    const std::int64_t x = 10 * i + 3;
    const Outline hole = {{x, 0}, {x, 3}, {x, 7}, {x + 4, 7}, {x + 4, 3}, {x, 3}, {x, 0}};
    out.insert(out.end(), hole.begin(), hole.end());
  }
  out.insert(out.end(), {{10 * holes, 0}, {10 * holes, 10}, {0, 10}});
  return out;
}

/// The outline of a maze without loops, whose walls have no thickness: the right hand stays on the wall. All of the square is inside.
Outline maze(out_test::Random& random, std::int64_t size) {
  constexpr std::array<Spot, 4> steps{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};  // across a cell's sides: below, right, above, left
  const auto number = [&](const Spot& cell) { return static_cast<std::size_t>(cell[1] * size + cell[0]); };
  std::vector<std::array<bool, 4>> open(static_cast<std::size_t>(size * size));
  std::vector<bool> known(open.size());
  std::vector<Spot> way{{0, 0}};
  known[0] = true;
  while (!way.empty()) {
    const std::size_t from = random.below(3) == 0 ? random.below(way.size()) : way.size() - 1;
    const Spot cell = way[from];
    std::vector<std::size_t> sides;
    for (std::size_t side = 0; side < 4; ++side) {
      const Spot to{cell[0] + steps[side][0], cell[1] + steps[side][1]};
      if (to[0] >= 0 && to[1] >= 0 && to[0] < size && to[1] < size && !known[number(to)]) sides.push_back(side);
    }
    if (sides.empty()) {
      way.erase(way.begin() + static_cast<std::ptrdiff_t>(from));
      continue;
    }
    const std::size_t side = sides[random.below(sides.size())];
    const Spot to{cell[0] + steps[side][0], cell[1] + steps[side][1]};
    open[number(cell)][side] = open[number(to)][(side + 2) % 4] = true;
    known[number(to)] = true;
    way.push_back(to);
  }
  constexpr std::array<Spot, 4> ends{{{1, 0}, {1, 1}, {0, 1}, {0, 0}}};  // of each side, the cell to the left
  Outline out;
  Spot cell{0, 0};
  std::size_t side = 0;
  do {
    out.push_back({cell[0] + ends[side][0], cell[1] + ends[side][1]});
    side = (side + 1) % 4;
    while (open[number(cell)][side]) {
      cell = {cell[0] + steps[side][0], cell[1] + steps[side][1]};
      side = (side + 3) % 4;
    }
  } while (cell != Spot{0, 0} || side != 0);
  return out;
}

ReadMesh obj_of_text(const std::string& text) { return mesh::parse(Format::obj, text, "m.obj"); }

double seconds_of(const Outline& outline) {
  const std::string text = obj_of(outline);
  const auto start = std::chrono::steady_clock::now();
  expect_divided(obj_of_text(text), outline);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TEST(polygon, of_six_corners_of_an_l_has_three_quarters_of_the_square_whichever_comes_first) {
  const Outline l = {{2, -2}, {2, 0}, {0, 0}, {0, 2}, {-2, 2}, {-2, -2}};
  ASSERT_EQ(shoelace(l), 2 * 12);
  for (std::size_t first = 0; first < l.size(); ++first) {
    const Outline from_there = turned(l, first);
    expect_divided(obj_of_text(obj_of(from_there)), from_there);
    const Outline other_way(from_there.rbegin(), from_there.rend());
    expect_divided(obj_of_text(obj_of(other_way)), other_way);
    expect_divided(mesh::parse(Format::ply, ply_of(from_there, in_xy), "m.ply"), from_there);
  }
}

TEST(polygon, of_four_corners_with_a_dent_is_divided_there) {
  const Outline dart = {{0, 0}, {4, 4}, {0, 2}, {-4, 4}};
  for (std::size_t first = 0; first < 4; ++first) expect_divided(obj_of_text(obj_of(turned(dart, first))), turned(dart, first));
}

TEST(polygon, with_holes_joined_by_slits_leaves_them_open) {
  out_test::Random random(3);
  for (const std::int64_t holes : {1, 2, 7}) {
    const Outline outline = with_holes(holes);
    ASSERT_EQ(shoelace(outline), 2 * (100 - 16) * holes);
    for (std::size_t first = 0; first < outline.size(); ++first) {
      const Outline from_there = turned(outline, first);
      const ReadMesh read = obj_of_text(obj_of(from_there, random_plane(random)));
      expect_divided(read, from_there);
      expect_covers_what_is_inside(read, from_there, random, static_cast<std::uint64_t>(10 * holes));
    }
  }
}

TEST(polygon, may_have_corners_twice_on_its_edges_and_back_to_back) {
  const Outline outlines[] = {
      {{0, 0}, {0, 0}, {4, 0}, {4, 4}, {4, 4}, {4, 4}, {2, 1}, {0, 4}},                  // corners twice
      {{0, 0}, {1, 0}, {2, 0}, {4, 0}, {4, 2}, {4, 4}, {3, 2}, {2, 0}, {1, 2}, {0, 4}},  // touches its own edge
      {{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 2}, {2, 4}, {0, 4}},                          // a slit inward
      {{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 6}, {2, 4}, {0, 4}, {0, 3}, {1, 2}, {0, 1}},  // a spike outward
      {{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 1}, {2, 6}, {0, 6}},                          // a slit beside a dent
      {{0, 0},
       {4, 0},
       {4, 4},
       {2, 2},
       {0, 4},
       {0, 8},
       {4, 8},
       {4, 4},
       {8, 4},
       {8, 10},
       {-2, 10},
       {-2, 0}},  // two of its corners in one place
  };
  for (const Outline& outline : outlines)
    for (std::size_t first = 0; first < outline.size(); ++first) {
      SCOPED_TRACE(obj_of(turned(outline, first)));
      expect_divided(obj_of_text(obj_of(turned(outline, first))), turned(outline, first));
    }
}

TEST(polygon, like_a_star_has_the_area_of_the_shoelace_formula) {
  out_test::Random random(5);
  for (const std::size_t corners : {10U, 34U, 100U})
    for (int trial = 0; trial < 20; ++trial) {
      Outline star;
      for (std::size_t i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
        const double far = i % 2 == 0 ? 1000 : 100 + static_cast<double>(random.below(800));
        star.push_back({std::lround(far * std::cos(angle)), std::lround(far * std::sin(angle))});
      }
      expect_divided(obj_of_text(obj_of(star, random_plane(random))), star);
    }
}

TEST(polygon, of_any_simple_shape_on_any_plane_is_covered_once_and_nothing_beside_it) {
  out_test::Random random(11);
  for (const auto& [corners, size, trials] : {std::tuple{4U, 5U, 300}, {7U, 6U, 300}, {12U, 9U, 200}, {25U, 100U, 100}, {100U, 1000U, 40}})
    for (int trial = 0; trial < trials; ++trial) {
      const Outline outline = random_simple(random, corners, size);
      const Placed plane = random_plane(random);
      SCOPED_TRACE(obj_of(outline, plane));
      const ReadMesh read = obj_of_text(obj_of(outline, plane));
      expect_divided(read, outline);
      if (trial % 10 == 0) expect_covers_what_is_inside(read, outline, random, size);
      expect_divided(mesh::parse(Format::ply, ply_of(outline, plane), "m.ply"), outline);
    }
}

TEST(polygon, like_a_maze_of_walls_without_thickness_is_covered_once) {
  out_test::Random random(23);
  for (int trial = 0; trial < 200; ++trial) {
    const auto size = static_cast<std::int64_t>(2 + random.below(9));
    const Outline outline = turned(maze(random, size), random.below(1000));
    ASSERT_EQ(shoelace(outline), 2 * size * size);
    SCOPED_TRACE(obj_of(outline));
    expect_divided(obj_of_text(obj_of(outline, random_plane(random))), outline);
  }
}

TEST(polygon, takes_its_normals_and_texture_coordinates_along) {
  // Those of each corner are its place.
  const Outline l = {{2, -2}, {2, 0}, {0, 0}, {0, 2}, {-2, 2}, {-2, -2}};
  std::string text = "v 9 9 9\nv 8 8 8\nv 9 8 7\nf 1 2 3\n", face = "f";
  for (const auto& [x, y] : l) {
    const std::string at = std::to_string(x) + " " + std::to_string(y);
    text += "v " + at + " 0\nvt " + at + "\nvn " + at + " 1\n";
    face += " -" + std::to_string(l.size() - static_cast<std::size_t>(&x - &l[0][0]) / 2);
    face += "/" + std::to_string(1 + static_cast<std::size_t>(&x - &l[0][0]) / 2) + "/" +
            std::to_string(1 + static_cast<std::size_t>(&x - &l[0][0]) / 2);
  }
  const ReadMesh read = obj_of_text(text + face + "\n");
  ASSERT_EQ(read.mesh.vertices.size(), 9U);
  for (std::size_t i = 3; i < 9; ++i) {
    const auto& [x, y, z] = read.mesh.vertices[i];
    EXPECT_EQ(read.mesh.texcoords[i], (std::array<float, 2>{x, 1 - y}));
    EXPECT_NEAR(read.mesh.normals[i][0] / read.mesh.normals[i][2], x, 1e-5);
  }
}

TEST(polygon, that_is_convex_stays_the_fan_of_its_first_corner) {
  // On a slanted plane, where rounding moves each corner by half a unit of its last place; a third of the corners lie on straight edges.
  std::string text, face = "f";
  std::vector<std::array<double, 2>> rim;
  for (int i = 0; i < 60; ++i) {
    const double angle = 2 * std::numbers::pi * (i / 3 * 3) / 60, after = 2 * std::numbers::pi * (i / 3 * 3 + 3) / 60, part = (i % 3) / 3.0;
    rim.push_back(
        {std::cos(angle) + part * (std::cos(after) - std::cos(angle)), std::sin(angle) + part * (std::sin(after) - std::sin(angle))});
  }
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const auto [u, v] = rim[i];
    text += "v " + base::number_text(5 + 0.31 * u + 0.77 * v) + " " + base::number_text(0.2 * u - 0.4 * v) + " " +
            base::number_text(3 + u) + "\n";
    face += " " + std::to_string(i + 1);
  }
  const ReadMesh read = obj_of_text(text + face);
  for (std::int32_t i = 0; i < 58; ++i)
    EXPECT_EQ(read.mesh.triangles[static_cast<std::size_t>(i)], (std::array<std::int32_t, 3>{0, i + 1, i + 2}));
}

TEST(polygon, with_corners_on_a_straight_edge_has_a_triangle_at_each_of_them) {
  // From the apex a fan would do; from a corner on the edge it takes care not to cut off the apex.
  const Outline outlines[] = {{{2, 3}, {0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}},
                              {{0, 0}, {2, 0}, {4, 0}, {4, 4}, {3, 3}, {2, 4}, {1, 3}, {0, 4}, {0, 2}}};
  for (const Outline& outline : outlines)
    for (std::size_t first = 0; first < outline.size(); ++first) {
      const Outline from_there = turned(outline, first);
      std::vector<mesh::Point> points;
      for (const auto& [x, y] : from_there) points.push_back({static_cast<double>(x), static_cast<double>(y)});
      std::vector<mesh::Corners> triangles;
      std::int64_t work = 1000;
      ASSERT_EQ(mesh::EarClipping().divide(points, work, triangles), mesh::EarClipping::Outcome::divided);
      for (const auto& [a, b, c] : triangles)
        EXPECT_GT(doubled_area(from_there[static_cast<std::size_t>(a)], from_there[static_cast<std::size_t>(b)],
                               from_there[static_cast<std::size_t>(c)]),
                  0);
    }
}

TEST(polygon, that_crosses_itself_stays_a_fan_and_is_told) {
  const ReadMesh read = obj_of_text("v 0 0 0\nv 4 4 0\nv 4 0 0\nv 0 3 0\nf 1 2 3 4\nf 4 3 2 1\n");
  EXPECT_EQ(read.mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}, {3, 1, 0}}));
  EXPECT_EQ(read.notices, std::vector<std::string>{"2 faces cross themselves: what lies inside is a guess"});
}

// Found by chance: 10³⁰ cells away is no whole number (the sanitizers' build tells).
TEST(polygon, whose_ears_are_far_outside_of_all_hollow_corners_is_divided) {
  const ReadMesh got =
      mesh::parse(Format::obj,
                  "v 0 0 0\nv 3 0 0\nv 4888888888888888888888888888888 3 0\nv 8 7 0\nv 7 7 0\nv 7 4 0\nv 10 0 0\nv 10 10 0\nv 0 "
                  "1888888888888888888888888888888 3\nf 1 2 3 4 2 6 3 2 7 9\n",
                  "m");
  EXPECT_EQ(got.mesh.triangles.size(), 8U);
}

TEST(polygon, of_a_hundred_thousand_corners_takes_seconds) {
  constexpr std::int64_t n = 50'000;
  Outline comb{{-1, 0}}, spiral, back, star;
  for (std::int64_t i = 0; i < n; ++i) comb.insert(comb.end(), {{20 * i, 100'000}, {20 * i + 10, 10}});
  comb.push_back({20 * n, 0});
  for (std::int64_t i = 0; i < n; ++i) {
    const double angle = 0.02 * static_cast<double>(i), far = 1000 + 100 * angle;
    spiral.push_back({std::lround(far * std::cos(angle)), std::lround(far * std::sin(angle))});
    back.push_back({std::lround((far + 200) * std::cos(angle)), std::lround((far + 200) * std::sin(angle))});
    const double turn = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n),
                 r = i % 2 == 0 ? 8e6 : 1e6 + 100.0 * static_cast<double>(i);
    star.push_back({std::lround(r * std::cos(turn)), std::lround(r * std::sin(turn))});
  }
  spiral.insert(spiral.end(), back.rbegin(), back.rend());
  for (const Outline& outline : {comb, spiral, star, with_holes(n / 4)})
    EXPECT_LT(seconds_of(outline), 2);  // of a tenth of one  // of a second or two
}

TEST(polygon, that_is_too_much_work_is_given_up) {
  std::vector<mesh::Point> comb{{-1, 0}};
  for (int i = 0; i < 1000; ++i) comb.insert(comb.end(), {{2.0 * i, 100}, {2.0 * i + 1, 10}});
  comb.push_back({2000, 0});
  std::reverse(comb.begin(), comb.end());
  std::vector<mesh::Corners> triangles;
  std::int64_t little = 10, much = 100'000'000;
  EXPECT_EQ(mesh::EarClipping().divide(comb, little, triangles), mesh::EarClipping::Outcome::too_long);
  EXPECT_EQ(mesh::EarClipping().divide(comb, much, triangles), mesh::EarClipping::Outcome::divided);
  EXPECT_LT(much, 100'000'000);
}

TEST(orientation, of_points_on_a_line_to_the_last_bit_is_exact) {
  // Two near zero and one far away: double rounds even their differences. By whole numbers of 128 bits.
  out_test::Random random(2);
  __extension__ using Whole = __int128;
  int on_a_line = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const auto k = static_cast<std::int64_t>(1 + random.below(8)), m = static_cast<std::int64_t>(1 + random.below(8));
    const auto far = static_cast<std::int64_t>(1 + random.below(1U << 20U)) << 34;
    const auto s = static_cast<std::int64_t>(random.below(1U << 20U)), t = static_cast<std::int64_t>(random.below(1U << 20U));
    std::array<Spot, 3> p{{{far * k, far * m}, {s * k, s * m}, {t * k, t * m + static_cast<std::int64_t>(random.below(3)) - 1}}};
    std::rotate(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(random.below(3)), p.end());
    const Whole det = Whole{p[1][0] - p[0][0]} * (p[2][1] - p[0][1]) - Whole{p[1][1] - p[0][1]} * (p[2][0] - p[0][0]);
    const auto at = [&](std::size_t i) { return mesh::Point{static_cast<double>(p[i][0]), static_cast<double>(p[i][1])}; };
    EXPECT_EQ(mesh::orientation(at(0), at(1), at(2)), det > 0 ? 1 : det < 0 ? -1 : 0);
    on_a_line += det == 0 ? 1 : 0;
  }
  EXPECT_GT(on_a_line, 5000);
}
