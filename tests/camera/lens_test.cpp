// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Projection and distortion, there and back; beyond the model nothing is made up.
#include "camera/lens/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "camera/frozen_camera.h"
#include "support/pixels.h"
#include "support/random.h"

using namespace tofray;
using camera::Point2;
using tofray::test::Random;

namespace {

Lens random_lens(Random& random) {
  Lens lens;
  lens.fx_px = random.between(150, 600), lens.fy_px = lens.fx_px * random.between(0.95, 1.05);
  lens.cx_px = random.between(80, 150), lens.cy_px = random.between(60, 120);
  lens.k1 = random.between(-0.4, 0.3), lens.k2 = random.between(-0.2, 0.2), lens.k3 = random.between(-0.1, 0.1);
  lens.p1 = random.between(-0.005, 0.005), lens.p2 = random.between(-0.005, 0.005);
  return lens;
}

/// A rational one: OpenCV's calibrations have k1 and k4, k2 and k5, k3 and k6 that nearly cancel.
Lens random_rational(Random& random) {
  Lens lens = random_lens(random);
  lens.k4 = random.between(-0.1, 2), lens.k5 = random.between(0, 1), lens.k6 = random.between(0, 0.2);
  lens.k1 += lens.k4, lens.k2 += lens.k5, lens.k3 += lens.k6;
  return lens;
}

Lens random_fisheye(Random& random) {
  Lens lens = random_lens(random);
  lens.distortion = Lens::Distortion::fisheye;
  lens.k1 = random.between(-0.1, 0.1), lens.k2 = random.between(-0.03, 0.03), lens.k3 = random.between(-0.01, 0.01);
  lens.k4 = random.between(-0.003, 0.003);
  return lens;
}

/// The formulas as OpenCV documents them, computed here.
Point2 formula(const Lens& l, double x, double y) {
  const double r2 = x * x + y * y;
  if (l.distortion == Lens::Distortion::fisheye) {
    const double r = std::sqrt(r2), t = std::atan(r), t2 = t * t;
    const double scale = r > 0 ? t * (1 + l.k1 * t2 + l.k2 * t2 * t2 + l.k3 * t2 * t2 * t2 + l.k4 * t2 * t2 * t2 * t2) / r : 1;
    return {x * scale, y * scale};
  }
  const double radial = (1 + l.k1 * r2 + l.k2 * r2 * r2 + l.k3 * r2 * r2 * r2) / (1 + l.k4 * r2 + l.k5 * r2 * r2 + l.k6 * r2 * r2 * r2);
  return {x * radial + 2 * l.p1 * x * y + l.p2 * (r2 + 2 * x * x), y * radial + l.p1 * (r2 + 2 * y * y) + 2 * l.p2 * x * y};
}

/// Determinant of its derivative, by differences.
double growth(const Lens& l, double x, double y) {
  const double h = 1e-5;
  const Point2 right = formula(l, x + h, y), left = formula(l, x - h, y), down = formula(l, x, y + h), up = formula(l, x, y - h);
  return ((right.x - left.x) * (down.y - up.y) - (down.x - up.x) * (right.y - left.y)) / (4 * h * h);
}

/// True where the model is one to one from the axis to here, with room.
bool well_behaved(const Lens& l, double x, double y) {
  for (int i = 0; i <= 40; ++i) {
    const double s = 1.1 * i / 40 + 1e-3, r2 = s * s * (x * x + y * y);
    if (growth(l, s * x, s * y) < 0.1 || 1 + r2 * (l.k4 + r2 * (l.k5 + r2 * l.k6)) < 0.1) return false;
    Lens radial = l;
    radial.p1 = radial.p2 = 0;
    if (growth(radial, s * x, s * y) < 0.1) return false;
  }
  return true;
}

}  // namespace

TEST(lens, distorts_by_the_formula) {
  Random random(1);
  for (int i = 0; i < 100000; ++i) {
    const Lens lens = random_lens(random);
    const double x = random.between(-1, 1), y = random.between(-1, 1);
    const Point2 expected = formula(lens, x, y), got = camera::distort(lens, {x, y});
    ASSERT_NEAR(got.x, expected.x, 1e-14);
    ASSERT_NEAR(got.y, expected.y, 1e-14);
  }
}

// Distorted and back to 1e-9 px, undistorted and back to 1e-10 px; |x|, |y| to 0.9: a field of 84 degrees.
TEST(lens, takes_pixels_to_rays_and_back) {
  Random random(2);
  int tried = 0;
  for (int i = 0; i < 100000; ++i) {
    const Lens lens = random_lens(random);
    const double x = random.between(-0.9, 0.9), y = random.between(-0.9, 0.9);
    if (!well_behaved(lens, x, y)) continue;
    ++tried;
    const Point2 pixel = camera::project(lens, {x, y});
    Point2 back{};
    ASSERT_TRUE(camera::unproject(lens, camera::growing_radius_squared(lens), pixel, back)) << i;
    ASSERT_NEAR(back.x * lens.fx_px, x * lens.fx_px, 1e-9) << i;
    ASSERT_NEAR(back.y * lens.fy_px, y * lens.fy_px, 1e-9) << i;
    const Point2 again = camera::project(lens, back);
    ASSERT_NEAR(again.x, pixel.x, 1e-10);
    ASSERT_NEAR(again.y, pixel.y, 1e-10);
  }
  EXPECT_GT(tried, 50000);
}

TEST(lens, rational_or_a_fisheye_distorts_by_the_formula_and_back) {
  Random random(7);
  int tried[2] = {0, 0};
  for (int i = 0; i < 60000; ++i) {
    const bool rational = i % 2 == 0;
    const Lens lens = rational ? random_rational(random) : random_fisheye(random);
    const double far = rational ? 1.2 : i % 3 == 0 ? 1e-4 : 4;  // 100 degrees; 160, and where the fisheye's formula is a series
    const double x = random.between(-far, far), y = random.between(-far, far);
    const Point2 expected = formula(lens, x, y), got = camera::distort(lens, {x, y});
    ASSERT_NEAR(got.x, expected.x, 2e-14 * (1 + std::abs(expected.x))) << i;
    ASSERT_NEAR(got.y, expected.y, 2e-14 * (1 + std::abs(expected.y))) << i;
    if (x * x + y * y >= camera::growing_radius_squared(lens) || (rational && !well_behaved(lens, x, y))) continue;
    const double slope = rational ? 1 : 1 + x * x + y * y;  // of tan θ over θ
    Point2 back{};
    if (!rational && growth(lens, x, y) * slope * slope < 0.1) continue;  // near where the radius turns
    ASSERT_TRUE(camera::undistort(lens, camera::growing_radius_squared(lens), got, back)) << i << " " << x << " " << y;
    ASSERT_NEAR(back.x, x, 1e-12 * slope) << i;
    ASSERT_NEAR(back.y, y, 1e-12 * slope) << i;
    ++tried[i % 2];
  }
  EXPECT_GT(tried[0], 15000);
  EXPECT_GT(tried[1], 20000);
}

// Without coefficients a fisheye's radius is the angle itself, as far as the model goes; with a k1 below 0 it turns at θ = 1/√(−3 k1).
TEST(lens, of_a_fisheye_ends_where_its_radius_turns) {
  constexpr double degree = 3.14159265358979323846 / 180;
  Lens lens;
  lens.fx_px = lens.fy_px = 1, lens.distortion = Lens::Distortion::fisheye;
  const double whole = camera::growing_radius_squared(lens);
  Point2 p{};
  for (const double angle : {0.0, 1e-9, 1.0, 45.0, 80.0, 89.0}) {
    ASSERT_TRUE(camera::undistort(lens, whole, {0, angle * degree}, p)) << angle;
    EXPECT_EQ(p.x, 0);
    EXPECT_NEAR(p.y, std::tan(angle * degree), 1e-9 * (1 + p.y * p.y)) << angle;
  }
  EXPECT_FALSE(camera::undistort(lens, whole, {0, 89.9 * degree}, p));
  lens.k1 = -0.5;
  const double limit = camera::growing_radius_squared(lens), turn = 1 / std::sqrt(1.5);
  EXPECT_NEAR(std::atan(std::sqrt(limit)), turn, 1e-9);
  EXPECT_TRUE(camera::undistort(lens, limit, {turn * 2 / 3 * (1 - 1e-6), 0}, p));
  EXPECT_FALSE(camera::undistort(lens, limit, {turn * 2 / 3 * (1 + 1e-6), 0}, p));
}

// Where 1 + k4 r² falls to 0 the model has a pole: nothing beyond it is seen.
TEST(lens, rational_ends_before_its_pole) {
  Lens lens;
  lens.fx_px = lens.fy_px = 1, lens.k4 = -0.5;
  const double limit = camera::growing_radius_squared(lens);
  EXPECT_NEAR(limit, 2, 1e-9);
  Point2 p{};
  ASSERT_TRUE(camera::undistort(lens, limit, {5, 0}, p));  // x/(1 − x²/2) = 5
  EXPECT_NEAR(p.x, (std::sqrt(1 + 2 * 25.0) - 1) / 5, 1e-12);
}

TEST(lens, without_distortion_is_a_pinhole) {
  Lens lens;
  lens.fx_px = 200, lens.fy_px = 210, lens.cx_px = 111.5, lens.cy_px = 85.5;
  Point2 p{};
  ASSERT_TRUE(camera::unproject(lens, camera::growing_radius_squared(lens), {0, 0}, p));
  EXPECT_DOUBLE_EQ(p.x, -111.5 / 200);
  EXPECT_DOUBLE_EQ(p.y, -85.5 / 210);
}

// Any target at all; what is called an inverse is one, and lies on the branch that starts at the axis.
TEST(lens, never_makes_up_an_inverse) {
  Random random(3);
  int found = 0, refused = 0;
  for (int i = 0; i < 100000; ++i) {
    const Lens lens = random_lens(random);
    const Point2 target{random.between(-1.5, 1.5), random.between(-1.5, 1.5)};
    Point2 p{};
    if (!camera::undistort(lens, camera::growing_radius_squared(lens), target, p)) {
      ++refused;
      continue;
    }
    ++found;
    const Point2 at = formula(lens, p.x, p.y);
    ASSERT_NEAR(at.x, target.x, 1e-11) << i;
    ASSERT_NEAR(at.y, target.y, 1e-11) << i;
    for (int s = 0; s <= 20; ++s) {
      const double r2 = (s / 20.0) * (s / 20.0) * (p.x * p.x + p.y * p.y) * 0.9999;
      ASSERT_GE(1 + r2 * (3 * lens.k1 + r2 * (5 * lens.k2 + r2 * 7 * lens.k3)), -1e-9) << i;
    }
  }
  EXPECT_GT(found, 40000);
  EXPECT_GT(refused, 10000);
}

// k1 alone: r(1 + k1 r²) grows up to r² = −1/(3 k1), where it is ⅔ of that r. Beyond there is no inverse.
TEST(lens, knows_where_a_barrel_ends) {
  for (const double k1 : {-0.05, -0.2, -0.30, -0.337, -0.37}) {
    Lens lens;
    lens.fx_px = lens.fy_px = 1;
    lens.k1 = k1;
    const double farthest = 2.0 / 3 * std::sqrt(-1 / (3 * k1));
    for (const double angle : {0.0, 0.7, 2.0, 4.0}) {
      Point2 p{};
      const double in = farthest * (1 - 1e-6), out = farthest * (1 + 1e-6);
      EXPECT_TRUE(camera::undistort(lens, camera::growing_radius_squared(lens), {in * std::cos(angle), in * std::sin(angle)}, p)) << k1;
      EXPECT_FALSE(camera::undistort(lens, camera::growing_radius_squared(lens), {out * std::cos(angle), out * std::sin(angle)}, p)) << k1;
    }
  }
}

// Corners of the pico flexx: its own k1 reaches them, −0.37 does not. Those pixels are flagged, counted, and hold no depth and no light.
TEST(lens, flags_corners_without_an_inverse) {
  Camera camera = load_camera("pico-flexx");
  const Scene scene = test::wall(1, 0.8);
  for (const std::uint16_t flags : test::expected_frame(scene, camera).depth.flags) ASSERT_EQ(flags & flag_outside_lens, 0);
  camera.lens.k1 = -0.37;
  const Frame frame = test::expected_frame(scene, camera);
  const double farthest = 2.0 / 3 * std::sqrt(1 / (3 * 0.37)) * 212;
  int outside = 0, expected = 0;
  for (std::size_t i = 0; i < frame.depth.flags.size(); ++i) {
    const double x = static_cast<double>(i % 224) - 111.5, y = std::floor(static_cast<double>(i) / 224) - 85.5;
    const bool flagged = (frame.depth.flags[i] & flag_outside_lens) != 0;
    expected += std::hypot(x, y) > farthest;
    outside += flagged;
    ASSERT_EQ(flagged, std::hypot(x, y) > farthest) << i;
    if (!flagged) continue;
    ASSERT_TRUE(std::isnan(frame.depth.z_m[i]) && std::isnan(frame.depth.range_m[i]));
    ASSERT_EQ(frame.depth.confidence[i], 0);
    ASSERT_EQ(frame.truth.power_w[i], 0);
  }
  EXPECT_EQ(outside, expected);
  EXPECT_GT(outside, 10);
}

// In single precision: the rays that kernels read lead back to their pixels.
TEST(lens, rays_in_single_precision_lead_back_to_their_pixels) {
  const Camera camera = load_camera("pico-flexx");
  const camera::FrozenCamera frozen(camera, false, 0);
  for (int i = 0; i < 224 * 172; ++i) {
    const Point2 ray{static_cast<double>(frozen.lens().ray_x[i]), static_cast<double>(frozen.lens().ray_y[i])};
    const Point2 p = camera::project(camera.lens, ray);
    ASSERT_NEAR(p.x, i % 224, 2e-4);
    ASSERT_NEAR(p.y, std::floor(i / 224.0), 2e-4);
  }
}

// A sensor of 12 megapixels behind a small sensor's lens took minutes: 60 times 50 steps for each pixel that it does not reach.
TEST(lens, says_soon_that_a_pixel_far_outside_has_no_ray) {
  Lens lens;
  lens.k1 = -0.3, lens.p1 = 1e-3, lens.p2 = -1e-3;
  const double limit = camera::growing_radius_squared(lens);
  const auto time_of = [&](double x, bool has_ray) {
    camera::Point2 p{};
    const std::clock_t start = std::clock();
    for (int i = 0; i < 300'000; ++i) EXPECT_EQ(camera::undistort(lens, limit, {x + 1e-7 * i, 0.2}, p), has_ray);
    return std::clock() - start;
  };
  // A tenth of the time of pixels that have a ray; ten times as much with the search.
  EXPECT_LT(time_of(2, false), time_of(0.2, true));
}
