// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

/// The sampler of BRDFs over arrays, compiled once for each instruction set as kernels are, so that the results can be compared.
extern "C" {

constexpr int sampling_block = 64;  ///< lanes in a call: whole packs of any width
constexpr int sampling_numbers = 12;

struct SamplingBlock {
  const float* in;           ///< [sampling_numbers][sampling_block] reflectivity, three numbers, normal, view, u, v
  const std::int32_t* brdf;  ///< [sampling_block]
  float* out;                ///< [4][sampling_block] direction and weight
};

using SamplingFunction = void (*)(const SamplingBlock*);
void sampling_scalar(const SamplingBlock*);
void sampling_scalar_fma(const SamplingBlock*);
void sampling_avx2(const SamplingBlock*);
void sampling_avx512(const SamplingBlock*);
void sampling_neon(const SamplingBlock*);
}
