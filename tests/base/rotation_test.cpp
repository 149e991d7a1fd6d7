// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Quaternions and matrices against Rodrigues' formula and against each other.
#include "base/rotation.h"

#include <gtest/gtest.h>

#include <array>

#include "support/random.h"
#include "support/turning.h"

using namespace tofray;
using base::Mat3;
using base::matrix_of;
using Q = Quaternion;
using base::product;
using base::quaternion_of;
using base::operator*;
using base::operator-;

namespace {

Quaternion about(const Vec3& axis, double angle) {
  const Vec3 v = std::sin(0.5 * angle) * base::normalized(axis);
  return {v[0], v[1], v[2], std::cos(0.5 * angle)};
}

std::string why(const Mat3& m) {
  const base::NoRotation wrong = base::why_no_rotation(m);
  return wrong.what + " | " + wrong.more;
}

constexpr double root_half = 0.70710678118654752;

}  // namespace

TEST(quaternion, turns_as_rodrigues_formula_does) {
  test::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Rotation by{random.point(1), 0.05 * i};
    const Vec3 p = random.point(3);
    EXPECT_LT(base::length(matrix_of(about(by.axis, by.angle_rad)) * p - test::turned(by, p)), 1e-13) << i;
  }
}

TEST(quaternion, has_the_same_matrix_at_any_length_and_with_the_other_sign) {
  const Mat3 one = matrix_of(Q{0.5, -0.5, 0.5, 0.5});
  EXPECT_EQ(matrix_of(Q{-0.5, 0.5, -0.5, -0.5}), one);
  EXPECT_EQ(matrix_of(Q{2, -2, 2, 2}), one);
}

TEST(quaternion, of_quarter_turns_has_whole_numbers_in_its_matrix) {
  EXPECT_EQ(matrix_of(Q{0, 0, root_half, root_half}), (Mat3{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}));
  EXPECT_EQ(matrix_of(Q{0, root_half, 0, root_half}), (Mat3{{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}}));
  EXPECT_EQ(matrix_of(Q{root_half, 0, 0, root_half}), (Mat3{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}}));
  EXPECT_EQ(matrix_of(Q{-0.5, 0.5, -0.5, 0.5}), (Mat3{{{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}}}));
}

TEST(quaternion, of_a_matrix_has_that_matrix_however_far_it_turns) {
  test::Random random(2);
  for (int i = 0; i < 400; ++i) {
    const Quaternion q = about(random.point(1), i < 200 ? 0.0315 * i : 3.14159265358979 - 1e-3 * (i - 300));
    const Mat3 m = matrix_of(q);
    const Quaternion back = quaternion_of(m);
    EXPECT_NEAR(std::abs(base::dot(back, q)), 1, 1e-14) << i;
    EXPECT_GE(back[3], 0);
    EXPECT_NEAR(base::length(back), 1, 1e-15);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(base::length(matrix_of(back)[k] - m[k]), 1e-14) << i;
  }
  // Half turns: w is 0, and another part is the largest.
  EXPECT_EQ(quaternion_of({{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}), (Quaternion{1, 0, 0, 0}));
  EXPECT_EQ(quaternion_of({{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}), (Quaternion{0, 1, 0, 0}));
  EXPECT_EQ(quaternion_of({{{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}}), (Quaternion{0, 0, 1, 0}));
}

TEST(quaternion, products_turn_by_the_second_first) {
  const Quaternion a = about({1, 2, 3}, 0.7), b = about({-1, 0.5, 2}, 2.1);
  const Vec3 p{0.3, -0.4, 1.2};
  EXPECT_LT(base::length(matrix_of(product(a, b)) * p - matrix_of(a) * (matrix_of(b) * p)), 1e-14);
  EXPECT_LT(base::length(matrix_of(product(base::inverse(a), a)) * p - p), 1e-14);
}

TEST(matrix, that_is_no_rotation_says_what_it_is) {
  EXPECT_EQ(why(matrix_of(about({1, 2, 3}, 1.1))), " | ");
  EXPECT_EQ(why({{{0.707, -0.707, 0}, {0.707, 0.707, 0}, {0, 0, 1}}}), " | ") << "three decimals are good enough";
  EXPECT_NE(why({{{0.70, -0.71, 0}, {0.71, 0.70, 0}, {0, 0, 1}}}), " | ");
  EXPECT_TRUE(why({{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}).starts_with("the matrix mirrors: its determinant is -1 | expected 1;"));
  EXPECT_TRUE(
      why({{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}})
          .starts_with("the matrix scales: it is no rotation | got columns that are 2, 2 and 2 long, determinant 8; expected 1; divide"));
  EXPECT_TRUE(why({{{1, 0, 0}, {0, 1, 0}, {0, 0, 2}}}).starts_with("the matrix is no rotation | got columns that are 1, 1 and 2 long"));
  EXPECT_TRUE(why({{{1, 0.6, 0}, {0, 0.8, 0}, {0, 0, 1}}}).starts_with("the matrix shears"));
  EXPECT_TRUE(why({{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}).starts_with("the matrix is no rotation"));
}

TEST(quaternion, that_is_not_of_unit_length_says_its_length_and_its_order) {
  for (const double size : {0.9991, 1.0009}) EXPECT_EQ(base::why_no_rotation(Quaternion{0, 0, 0, size}).what, "") << size;
  for (const double size : {0.0, 0.9989, 1.0011}) EXPECT_NE(base::why_no_rotation(Quaternion{0, 0, 0, size}).what, "") << size;
  EXPECT_EQ(base::why_no_rotation(Quaternion{0, 3, 0, 4}).more,
            "got a length of 5, expected 1; its order is x, y, z, w: no rotation at all is [0, 0, 0, 1]");
}
