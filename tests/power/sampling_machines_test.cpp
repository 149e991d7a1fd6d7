// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Ways that light comes from are the same, to the bit, on every number type: packs whose lanes have different BRDFs, at their limits, too.
#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "backend/cpu/cpu.h"
#include "brdf/list.h"
#include "power/sampling_functions.h"
#include "support/random.h"
#include "tofray/scene.h"

using tofray::Isa;
using tofray::Material;
using tofray::test::Random;

namespace {

/// Numbers of a pack's lanes, each in its own row.
struct Lanes {
  std::vector<float> in = std::vector<float>(sampling_numbers * sampling_block);
  std::vector<std::int32_t> brdf = std::vector<std::int32_t>(sampling_block);

  void put(int lane, const Material& material, Random& random) {
    const tofray::brdf::MaterialView view = tofray::brdf::view_of(material);
    brdf[static_cast<std::size_t>(lane)] = view.brdf;
    const tofray::Vec3 n = random.direction(), aside = random.across(n);
    const double cosine = random.below(4) == 0 ? 1e-4 : random.uniform(), sine = std::sqrt(1 - cosine * cosine);
    const auto share = [&] { return random.below(8) == 0 ? 0 : random.below(8) == 0 ? 1 - 0x1p-24 : random.below(1 << 24) * 0x1p-24; };
    const double all[] = {view.reflectivity,
                          view.number[0],
                          view.number[1],
                          view.number[2],
                          n[0],
                          n[1],
                          n[2],
                          cosine * n[0] + sine * aside[0],
                          cosine * n[1] + sine * aside[1],
                          cosine * n[2] + sine * aside[2],
                          share(),
                          share()};
    for (int k = 0; k < sampling_numbers; ++k) in[static_cast<std::size_t>(k * sampling_block + lane)] = static_cast<float>(all[k]);
  }
};

Material material_of(int brdf, Random& random) {
  const double diffuse = 0.5 * random.uniform(), other = random.below(3) == 0 ? 0 : 0.5 * random.uniform();
  return {"",    static_cast<Material::Brdf>(brdf), diffuse, other, random.scale(1, 1e4), random.between(0, 1.5), random.scale(1e-3, 1),
          other, random.scale(1e-3, 0.785)};
}

SamplingFunction sampling_of(Isa isa) {
  switch (isa) {
#define ONE_SET(set) \
  case Isa::set: return sampling_##set;
    TOFRAY_SETS(ONE_SET)
#undef ONE_SET
    default: return sampling_scalar;
  }
}

class SamplingMachines : public testing::TestWithParam<Isa> {};

}  // namespace

TEST_P(SamplingMachines, draw_the_same_bits_as_the_plain_float) {
  const Isa isa = GetParam();
  if (!tofray::backend::can_run(isa)) GTEST_SKIP() << tofray::backend::isa_name(isa) << " does not run here";
  const SamplingFunction machine = sampling_of(isa);
  Random random(11);
  for (int i = 0; i < 3000; ++i) {
    Lanes lanes;
    // All lanes of any BRDF; all of one; Lambert and one other.
    const int kind = i % 3, one = random.below(5);
    for (int lane = 0; lane < sampling_block; ++lane) {
      lanes.put(lane, material_of(kind == 0 ? random.below(5) : kind == 1 ? one : random.below(2) * one, random), random);
    }
    std::vector<float> got(4 * sampling_block), expected(4 * sampling_block);
    SamplingBlock block{lanes.in.data(), lanes.brdf.data(), got.data()};
    machine(&block);
    block.out = expected.data();
    sampling_scalar(&block);
    for (std::size_t k = 0; k < got.size(); ++k) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(got[k]), std::bit_cast<std::uint32_t>(expected[k]))
          << i << ", number " << k / sampling_block << " of BRDF " << lanes.brdf[k % sampling_block] << ": " << got[k] << ", not "
          << expected[k];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(machines, SamplingMachines, testing::ValuesIn(tofray::backend::machine_isas),
                         [](const auto& which) { return tofray::backend::isa_name(which.param); });
