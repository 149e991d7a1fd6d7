// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// g++ 12 drops the rounding of double → float → double where its vectorizer packs two of them (-O2 and above, straight-line code): then the
// low halves of numbers kept in two floats become 0. The build switches that pass off; this is how one would notice that it came back.
#include <gtest/gtest.h>

#include <array>

namespace {

struct Halves {
  float high[3], low[3];
};

__attribute__((noinline)) Halves halves(const double* u) {
  Halves h;
  for (int k = 0; k < 3; ++k) h.high[k] = static_cast<float>(u[k]);
  for (int k = 0; k < 3; ++k) h.low[k] = static_cast<float>(u[k] - static_cast<double>(h.high[k]));
  return h;
}

}  // namespace

TEST(rounding, to_single_precision_is_not_optimised_away) {
  volatile double one = 1;
  const std::array<double, 3> u{0.1 * one, 0.3 * one, 0.7 * one};
  const Halves h = halves(u.data());
  // 0.1, 0.3 and 0.7 minus their nearest floats
  EXPECT_FLOAT_EQ(h.low[0], -1.4901161e-9f);
  EXPECT_FLOAT_EQ(h.low[1], -1.1920929e-8f);
  EXPECT_FLOAT_EQ(h.low[2], 1.1920929e-8f);
}
