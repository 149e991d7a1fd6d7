// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Ray and plane: t = n·(p − o) / n·d.
#include <gtest/gtest.h>

#include "support/random.h"
#include "support/rays.h"

using namespace tofray;
using namespace tofray::base;
using tofray::test::Random;

namespace {

constexpr double eps = 0x1p-23;

struct Case {
  Vec3 normal, point, origin;
  /// w of the first and only plane as the kernel finds it.
  [[nodiscard]] double w(const test::Ray& ray) const {
    return static_cast<double>(inverse_range(seen_from(shape::Plane{test::vec(point), test::vec(normal)}, test::vec(origin)), ray));
  }
};

Case random_case(Random& random) {
  const Vec3 n = random.direction(), origin = random.point(10);
  const double side = random.uniform() < 0.5 ? -1 : 1, away = random.scale(0.05, 50), aside = random.between(-5, 5);
  return {n, origin + side * away * n + aside * random.across(n), origin};
}

}  // namespace

// m is rounded once and the three products and sums once each: at most 7 half units of |d||m|, and 1/w one more: 4 eps·t/cos.
TEST(plane, range_is_that_of_the_closed_form) {
  Random random(1);
  int hits = 0;
  for (int i = 0; i < 1000000; ++i) {
    const Case c = random_case(random);
    const test::Ray ray = test::ray(random.direction());
    const Vec3 d = test::direction(ray);
    const double across = dot(c.normal, d), t = dot(c.normal, c.point - c.origin) / across, w = c.w(ray);
    if (std::abs(across) < 1e-5) continue;
    ASSERT_EQ(w > 0, t > 0) << i;
    if (t < 0) continue;
    ++hits;
    ASSERT_LE(std::abs(1 / w - t), 4 * eps * t / std::abs(across)) << i;
  }
  EXPECT_GT(hits, 490000);
}

// Directions that all but lie in the plane, on either side of the threshold (with room for rounding: 1e-7 of a unit vector).
TEST(plane, is_missed_by_rays_closer_to_it_than_a_millionth) {
  Random random(2);
  int hits = 0, misses = 0;
  for (int i = 0; i < 100000; ++i) {
    const Case c = random_case(random);
    const double rise = random.scale(1e-8, 1e-4);
    const test::Ray ray = test::ray(normalized(random.across(c.normal) + rise * c.normal));
    const Vec3 d = test::direction(ray);
    const double across = dot(c.normal, d), t = dot(c.normal, c.point - c.origin) / across;
    const bool hit = c.w(ray) > 0;
    if (std::abs(across) < 0.6e-6) {
      ++misses;
      ASSERT_FALSE(hit) << i;
    } else if (std::abs(across) > 1.4e-6) {
      ++hits;
      ASSERT_EQ(hit, t > 0) << i;
    }
  }
  EXPECT_GT(hits, 30000);
  EXPECT_GT(misses, 30000);
}

TEST(plane, through_the_origin_is_never_seen) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 n = random.direction();
    const shape::PlaneForm form = seen_from(shape::Plane{{0, 0, 0}, test::vec(n)}, {0, 0, 0});
    EXPECT_EQ(inverse_range(form, test::ray(random.direction())), 0);
    EXPECT_EQ(inverse_range(form, test::ray(random.across(n))), 0);
  }
}
