// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

/// Every function of a number type over arrays of bits, compiled once for each instruction set, so that the results can be compared.
extern "C" {

constexpr int pack_block = 48;  ///< elements in a call: whole packs of any width

struct PackBlock {
  const std::uint32_t *a, *b, *c;  ///< [pack_block] arguments: bits of floats, or whole numbers
  std::uint32_t* out;              ///< [4][pack_block] results
  const float* table;              ///< [1024], for gather
};

/// Does function number `which` on one block. Returns false past the last function.
using PackFunctions = bool (*)(int which, const PackBlock*);
bool pack_functions_scalar(int which, const PackBlock*);
bool pack_functions_scalar_fma(int which, const PackBlock*);
bool pack_functions_avx2(int which, const PackBlock*);
bool pack_functions_avx512(int which, const PackBlock*);
bool pack_functions_neon(int which, const PackBlock*);
}
