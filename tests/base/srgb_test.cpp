// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using tofray::base::linear_of_srgb;

TEST(srgb, is_that_of_the_standard_for_every_sample_of_16_bits) {
  for (int i = 0; i <= 65535; ++i) {
    const double a = i / 65535.0;
    const double right = a <= 0.04045 ? a / 12.92 : std::pow((a + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(linear_of_srgb(a), right, 6e-16 * right) << i;
    EXPECT_EQ(static_cast<float>(linear_of_srgb(a)), static_cast<float>(right)) << i;
  }
  EXPECT_EQ(linear_of_srgb(0), 0);
  EXPECT_EQ(linear_of_srgb(1), 1);
}

}  // namespace
