// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The promise that a kernel gives the same bits on every machine rests on each function of the number types: here each is compared with
// the plain float's, over special values in all combinations and a million random words.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "backend/cpu/cpu.h"
#include "num/pack_functions.h"

using tofray::Isa;
using tofray::backend::can_run;

namespace {

PackFunctions functions_of(Isa isa) {
  switch (isa) {
#define ONE_SET(set) \
  case Isa::set: return pack_functions_##set;
    TOFRAY_SETS(ONE_SET)
#undef ONE_SET
    default: return pack_functions_scalar;
  }
}

/// Zeros, the smallest and largest of each kind, powers of two, halves, integers, infinities, NaNs, each with both signs.
std::vector<std::uint32_t> special_values() {
  std::vector<std::uint32_t> values;
  for (const std::uint32_t v : {0x00000000u, 0x00000001u, 0x007fffffu, 0x00800000u, 0x00ffffffu, 0x33800000u, 0x3effffffu, 0x3f000000u,
                                0x3f000001u, 0x3f3504f3u, 0x3f3504f4u, 0x3f7fffffu, 0x3f800000u, 0x3f800001u, 0x3fb504f3u, 0x3fc00000u,
                                0x40200000u, 0x41800000u, 0x42fc0000u, 0x42fe0000u, 0x42fe0001u, 0x4affffffu, 0x4b000000u, 0x4b000001u,
                                0x4b7fffffu, 0x4b800000u, 0x4effffffu, 0x7f7fffffu, 0x7f800000u, 0x7f800001u, 0x7fc00000u, 0x7fffffffu}) {
    values.push_back(v), values.push_back(v | 0x80000000u);
  }
  return values;
}

struct Arguments {
  std::vector<std::uint32_t> a, b, c;
};

Arguments arguments() {
  Arguments out;
  const auto special = special_values();
  std::mt19937 random(5);
  for (const std::uint32_t a : special) {
    for (const std::uint32_t b : special) {
      for (int k = 0; k < 8; ++k) out.a.push_back(a), out.b.push_back(b), out.c.push_back(special[random() % special.size()]);
    }
  }
  // Random words; and random floats of like size, which is where additions and fused products round in earnest.
  for (int i = 0; i < 1'000'000; ++i) {
    const bool like = i % 2 != 0;
    const auto word = [&]() { return static_cast<std::uint32_t>(like ? (random() & 0x83ffffffu) + 0x3c000000u : random()); };
    out.a.push_back(word()), out.b.push_back(word()), out.c.push_back(word());
  }
  while (out.a.size() % pack_block != 0) out.a.push_back(0), out.b.push_back(0), out.c.push_back(0);
  return out;
}

bool is_nan(std::uint32_t bits) { return (bits & 0x7fffffffu) > 0x7f800000u; }

/// Functions that only move bits keep a NaN's bits; what arithmetic makes is any NaN (what is stored is one written NaN, in
/// pipeline/store.h).
bool moves_bits(int which) {
  return which == 4 || which == 11 || which == 12 || which == 16 || (which >= 100 && which < 200) || which >= 300;
}

void compare(PackFunctions machine, PackFunctions reference) {
  const Arguments in = arguments();
  std::vector<float> table;
  for (int i = 0; i < 1024; ++i) table.push_back(static_cast<float>(i) * 1.25f - 3.0f);
  int functions = 0;
  for (const int family : {0, 100, 200, 300, 400}) {
    for (int which = family;; ++which) {
      std::vector<std::uint32_t> got(4 * pack_block), expected(4 * pack_block);
      bool known = true;
      for (std::size_t i = 0; known && i < in.a.size(); i += pack_block) {
        got.assign(got.size(), 0), expected.assign(expected.size(), 0);
        PackBlock block{&in.a[i], &in.b[i], &in.c[i], got.data(), table.data()};
        known = machine(which, &block);
        block.out = expected.data();
        ASSERT_EQ(known, reference(which, &block));
        for (std::size_t k = 0; k < got.size(); ++k) {
          if (got[k] == expected[k] || (!moves_bits(which) && is_nan(got[k]) && is_nan(expected[k]))) continue;
          const std::size_t at = i + k % pack_block;
          FAIL() << "function " << which << ", result " << k / pack_block << std::hex << ": a " << in.a[at] << " b " << in.b[at] << " c "
                 << in.c[at] << " gives " << got[k] << ", not " << expected[k];
        }
      }
      if (!known) break;
      ++functions;
    }
  }
  EXPECT_EQ(functions, 17 + 10 + 9 + 7 + 2);
}

class Packs : public testing::TestWithParam<Isa> {};

}  // namespace

TEST_P(Packs, give_the_same_bits_as_the_plain_float_in_every_function) {
  const Isa isa = GetParam();
  if (!can_run(isa)) GTEST_SKIP() << tofray::backend::isa_name(isa) << " does not run here";
  compare(functions_of(isa), pack_functions_scalar);
}

INSTANTIATE_TEST_SUITE_P(machines, Packs, testing::ValuesIn(tofray::backend::machine_isas),
                         [](const auto& which) { return tofray::backend::isa_name(which.param); });

// The plain float against itself says nothing of its reductions over lanes: they agree with a loop.
TEST(packs, of_one_lane_are_their_own_smallest_and_largest) {
  const Arguments in = arguments();
  std::vector<std::uint32_t> out(4 * pack_block);
  const PackBlock block{in.a.data(), in.b.data(), in.c.data(), out.data(), nullptr};
  ASSERT_TRUE(pack_functions_scalar(400, &block));
  for (int k = 0; k < pack_block; ++k) EXPECT_EQ(out[static_cast<std::size_t>(k)], 1u);
}
