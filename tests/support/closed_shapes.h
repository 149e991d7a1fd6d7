// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>

#include <algorithm>

#include "support/brute_force.h"
#include "support/random.h"
#include "support/rays.h"

/// What holds of every closed shape, against its span in double precision. A Case has shape(), size() and middle(), `axis` and `origin`.
namespace tofray::test {

template <class Case>
double inverse_range_of(const Case& c, const Ray& ray, int& side) {
  return static_cast<double>(inverse_range(seen_from(c.shape(), vec(c.origin)), ray, side));
}

/// A ray that comes near its middle.
template <class Case>
Ray ray_near(const Case& c, Random& random) {
  return ray(base::normalized(c.middle() + 0.8 * c.size() * random.point(1) - c.origin));
}

/// The closed form's unit normal at a point of the surface, and how far the point is from the nearest border of its facet.
struct Side {
  int facet = 0;
  Vec3 normal{};
  double to_border = 0;
};

struct Tally {
  int hits = 0, misses = 0, measured = 0, facets[3] = {};
};

/// From outside. Where the surface is, is known to some 2^-24 of the distance of its far end: m and d are rounded once each, and six
/// products and sums: 8 of these, and twice that where a root is taken; along the ray longer by 1/cos of the angle between ray and normal.
template <class Case, class Make, class SideAt>
Tally compare_from_outside(int count, Random& random, const Make& make, const SideAt& side_at) {
  Tally tally;
  for (int i = 0; i < count; ++i) {
    const Case c = make(random);
    if (inside(c.shape(), vec(c.origin))) continue;
    const Ray ray = ray_near(c, random);
    const Vec3 d = direction(ray);
    const Span s = span(c.shape(), c.origin, d);
    const double away = base::length(c.origin - c.middle()) + c.size();
    if (s.clearance < 1e-4 + 64 * 0x1p-24 * away / c.size()) continue;
    int side = -1;
    const double w = inverse_range_of(c, ray, side), t = first(s);
    EXPECT_EQ(w > 0, t > 0) << i;
    if (testing::Test::HasFailure()) return tally;
    if (!(w > 0)) {
      ++tally.misses;
      continue;
    }
    ++tally.hits;
    const Side at = side_at(c, c.origin + t * d);
    const double cosine = std::abs(base::dot(at.normal, d)) / base::length(d);
    if (at.to_border < 1e-3 * c.size() || cosine < 0.02) continue;
    ++tally.measured, ++tally.facets[at.facet];
    EXPECT_EQ(side, at.facet) << i;
    EXPECT_LE(std::abs(1 / w - t), 16 * 0x1p-24 * away / cosine) << i;
  }
  return tally;
}

/// From inside every ray meets the far side. @param make  a case whose origin is inside
template <class Case, class Make, class SideAt>
Tally compare_from_inside(int count, Random& random, const Make& make, const SideAt& side_at) {
  Tally tally;
  for (int i = 0; i < count; ++i) {
    const Case c = make(random);
    const Ray ray = test::ray(i % 7 == 0 ? c.axis : i % 7 == 1 ? -1.0 * c.axis : i % 7 == 2 ? random.across(c.axis) : random.direction());
    const Vec3 d = direction(ray);
    const Span s = span(c.shape(), c.origin, d);
    int side = -1;
    const double w = inverse_range_of(c, ray, side);
    EXPECT_GT(w, 0) << i;
    const Side at = side_at(c, c.origin + s.leave * d);
    const double cosine = std::max(1e-2, std::abs(base::dot(at.normal, d)) / base::length(d));
    EXPECT_NEAR(1 / w, s.leave, 32 * 0x1p-24 * c.size() / (cosine * cosine)) << i;
    EXPECT_TRUE(at.to_border < 1e-3 * c.size() || side == at.facet) << i;
    if (testing::Test::HasFailure()) return tally;
    ++tally.hits, ++tally.facets[at.facet];
  }
  return tally;
}

/// Light of a sun along the axis, across it and from anywhere, from points about the shape and in it.
template <class Case, class Make>
Tally compare_sun_shadows(int count, Random& random, const Make& make) {
  Tally tally;
  for (int i = 0; i < count; ++i) {
    const Case c = make(random);
    const int kind = i % 8;
    const Vec3 s = kind == 0 ? c.axis : kind == 1 ? -1.0 * c.axis : kind == 2 ? random.across(c.axis) : random.direction();
    const Vec3 at = c.middle() + 0.8 * c.size() * random.point(1) + random.between(-2, 1) * c.size() * s;
    flow::Surface<float> p{};
    p.x = static_cast<float>(at[0]), p.y = static_cast<float>(at[1]), p.z = static_cast<float>(at[2]);
    const float sun[3] = {static_cast<float>(s[0]), static_cast<float>(s[1]), static_cast<float>(s[2])};
    const float margin = static_cast<float>(1e-4 * c.size());
    const bool got = blocks(seen_along(c.shape(), vec(s)), p, sun, margin);
    const Span span = test::span(c.shape(), {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)}, s);
    if (span.clearance < 2e-4) continue;
    const double through = span.enter > span.leave ? -c.size() : span.leave - std::fmax(span.enter, 0);
    if (std::abs(through) < 4e-4 * c.size()) continue;
    EXPECT_EQ(got, through > 0) << i << " " << kind;
    if (testing::Test::HasFailure()) return tally;
    ++(got ? tally.hits : tally.misses);
  }
  return tally;
}

/// No ray that meets it is beyond its bounds. Returns how many met it.
template <class Case, class Make>
int hits_within_bounds(int count, Random& random, const Make& make) {
  int hits = 0;
  for (int i = 0; i < count; ++i) {
    Case c = make(random);
    c.origin = c.middle() - Vec3{0, 0, random.between(1.01, 4) * c.size()} + c.size() * random.point(1);
    const Vec3 d = c.middle() + 0.6 * c.size() * random.point(1) - c.origin;
    if (d[2] <= 0) continue;
    const Ray ray = test::ray({d[0] / d[2], d[1] / d[2], 1});
    int side = -1;
    if (!(inverse_range_of(c, ray, side) > 0)) continue;
    ++hits;
    EXPECT_TRUE(can_meet(seen_from(c.shape(), vec(c.origin)), {ray.x, ray.x, ray.y, ray.y})) << i;
    if (testing::Test::HasFailure()) return hits;
  }
  return hits;
}

/// The numbers of a facet give the normal at a point of it.
template <class T>
Vec3 normal_at(const T& shape, int side, const Vec3& at) {
  shape::Facet facet{};
  facet.curved = 1;
  facet_of(shape, side, facet);
  const auto wide = [](float a) { return static_cast<double>(a); };
  if (facet.curved == 0) return {wide(facet.number[0]), wide(facet.number[1]), wide(facet.number[2])};
  const shape::Direction<float> n = T::normal(facet, static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2]));
  return {wide(n.x), wide(n.y), wide(n.z)};
}

}  // namespace tofray::test
