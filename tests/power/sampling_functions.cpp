// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set; like the kernels it includes nothing that leaves a shared inline function behind.
#if defined(SAMPLING_AVX512)
#include "num/avx512.h"
#include "num/twin.h"
#define SAMPLING sampling_avx512
using F = tofray::num::Twin<tofray::num::F32x16>;
#elif defined(SAMPLING_AVX2)
#include "num/avx2.h"
#include "num/twin.h"
#define SAMPLING sampling_avx2
using F = tofray::num::Twin<tofray::num::F32x8>;
#elif defined(SAMPLING_NEON)
#include "num/neon.h"
#include "num/twin.h"
#define SAMPLING sampling_neon
using F = tofray::num::Twin<tofray::num::F32x4>;
#elif defined(SAMPLING_SCALAR_FMA)
#define SAMPLING sampling_scalar_fma
using F = float;
#else
#define SAMPLING sampling_scalar
using F = float;
#endif

#include "brdf/sample.h"
#include "power/sampling_functions.h"

extern "C" void SAMPLING(const SamplingBlock* block) {
  using namespace tofray;
  constexpr int lanes = num::lanes<F>;
  for (int i = 0; i < sampling_block; i += lanes) {
    F in[sampling_numbers];
    for (int k = 0; k < sampling_numbers; ++k) in[k] = num::load<F>(block->in + k * sampling_block + i, lanes);
    const flow::Finish<F> finish{in[0], {in[1], in[2], in[3]}, num::load_int<F>(block->brdf + i, lanes)};
    const auto got = brdf::sample<F>(finish, {in[4], in[5], in[6]}, {in[7], in[8], in[9]}, in[10], in[11]);
    const F out[] = {got.light.x, got.light.y, got.light.z, got.weight};
    for (int k = 0; k < 4; ++k) num::store(block->out + k * sampling_block + i, out[k], lanes);
  }
}
