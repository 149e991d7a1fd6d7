// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <immintrin.h>

#include "num/avx2.h"

/// Sixteen lanes with AVX-512 (F, BW, DQ, VL).
namespace tofray::num {

struct Mask16 {
  __mmask16 v;
};
struct F32x16 {
  __m512 v;
  F32x16() = default;
  TOFRAY_INLINE F32x16(__m512 a) : v(a) {}
  TOFRAY_INLINE F32x16(float a) : v(_mm512_set1_ps(a)) {}
};
struct I32x16 {
  __m512i v;
  I32x16() = default;
  TOFRAY_INLINE I32x16(__m512i a) : v(a) {}
  TOFRAY_INLINE I32x16(std::int32_t a) : v(_mm512_set1_epi32(a)) {}
};
struct U32x16 {
  __m512i v;
  U32x16() = default;
  TOFRAY_INLINE U32x16(__m512i a) : v(a) {}
  TOFRAY_INLINE U32x16(std::uint32_t a) : v(_mm512_set1_epi32(static_cast<std::int32_t>(a))) {}
};

template <>
struct Traits<F32x16> {
  using Int = I32x16;
  using Uint = U32x16;
  using Mask = Mask16;
  using Eight = F32x8;
  using Square = F32x16;
  static constexpr int lanes = 16;
};

TOFRAY_INLINE F32x16 operator+(F32x16 a, F32x16 b) { return _mm512_add_ps(a.v, b.v); }
TOFRAY_INLINE F32x16 operator-(F32x16 a, F32x16 b) { return _mm512_sub_ps(a.v, b.v); }
TOFRAY_INLINE F32x16 operator*(F32x16 a, F32x16 b) { return _mm512_mul_ps(a.v, b.v); }
TOFRAY_INLINE F32x16 operator/(F32x16 a, F32x16 b) { return _mm512_div_ps(a.v, b.v); }
TOFRAY_INLINE F32x16 operator-(F32x16 a) { return _mm512_xor_ps(a.v, _mm512_set1_ps(-0.0f)); }
TOFRAY_INLINE Mask16 operator<(F32x16 a, F32x16 b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
TOFRAY_INLINE Mask16 operator<=(F32x16 a, F32x16 b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)}; }
TOFRAY_INLINE Mask16 operator>(F32x16 a, F32x16 b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_GT_OQ)}; }
TOFRAY_INLINE Mask16 operator>=(F32x16 a, F32x16 b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_GE_OQ)}; }
TOFRAY_INLINE Mask16 operator==(F32x16 a, F32x16 b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ)}; }
TOFRAY_INLINE Mask16 operator!=(F32x16 a, F32x16 b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_NEQ_UQ)}; }

TOFRAY_INLINE Mask16 operator&(Mask16 a, Mask16 b) { return {_kand_mask16(a.v, b.v)}; }
TOFRAY_INLINE Mask16 operator|(Mask16 a, Mask16 b) { return {_kor_mask16(a.v, b.v)}; }
TOFRAY_INLINE Mask16 operator!(Mask16 a) { return {_knot_mask16(a.v)}; }
TOFRAY_INLINE bool any(Mask16 a) { return a.v != 0; }
TOFRAY_INLINE bool all(Mask16 a) { return a.v == 0xffff; }
TOFRAY_INLINE std::uint32_t lanes_of(Mask16 a) { return a.v; }

TOFRAY_INLINE I32x16 operator+(I32x16 a, I32x16 b) { return _mm512_add_epi32(a.v, b.v); }
TOFRAY_INLINE I32x16 operator-(I32x16 a, I32x16 b) { return _mm512_sub_epi32(a.v, b.v); }
TOFRAY_INLINE I32x16 operator*(I32x16 a, I32x16 b) { return _mm512_mullo_epi32(a.v, b.v); }
TOFRAY_INLINE I32x16 operator&(I32x16 a, I32x16 b) { return _mm512_and_si512(a.v, b.v); }
TOFRAY_INLINE I32x16 operator|(I32x16 a, I32x16 b) { return _mm512_or_si512(a.v, b.v); }
TOFRAY_INLINE Mask16 operator==(I32x16 a, I32x16 b) { return {_mm512_cmpeq_epi32_mask(a.v, b.v)}; }
TOFRAY_INLINE Mask16 operator!=(I32x16 a, I32x16 b) { return {_mm512_cmpneq_epi32_mask(a.v, b.v)}; }
TOFRAY_INLINE Mask16 operator<(I32x16 a, I32x16 b) { return {_mm512_cmplt_epi32_mask(a.v, b.v)}; }
TOFRAY_INLINE Mask16 operator>(I32x16 a, I32x16 b) { return {_mm512_cmpgt_epi32_mask(a.v, b.v)}; }

TOFRAY_INLINE U32x16 operator+(U32x16 a, U32x16 b) { return _mm512_add_epi32(a.v, b.v); }
TOFRAY_INLINE U32x16 operator*(U32x16 a, U32x16 b) { return _mm512_mullo_epi32(a.v, b.v); }
TOFRAY_INLINE U32x16 operator&(U32x16 a, U32x16 b) { return _mm512_and_si512(a.v, b.v); }
TOFRAY_INLINE U32x16 operator|(U32x16 a, U32x16 b) { return _mm512_or_si512(a.v, b.v); }
TOFRAY_INLINE U32x16 operator^(U32x16 a, U32x16 b) { return _mm512_xor_si512(a.v, b.v); }
TOFRAY_INLINE U32x16 operator<<(U32x16 a, int n) { return _mm512_slli_epi32(a.v, static_cast<unsigned>(n)); }
TOFRAY_INLINE U32x16 operator>>(U32x16 a, int n) { return _mm512_srli_epi32(a.v, static_cast<unsigned>(n)); }

TOFRAY_INLINE F32x16 fma(F32x16 a, F32x16 b, F32x16 c) { return _mm512_fmadd_ps(a.v, b.v, c.v); }
TOFRAY_INLINE F32x16 fms(F32x16 a, F32x16 b, F32x16 c) { return _mm512_fmsub_ps(a.v, b.v, c.v); }
TOFRAY_INLINE F32x16 fnma(F32x16 a, F32x16 b, F32x16 c) { return _mm512_fnmadd_ps(a.v, b.v, c.v); }
TOFRAY_INLINE F32x16 sqrt(F32x16 a) { return _mm512_sqrt_ps(a.v); }
TOFRAY_INLINE F32x16 min(F32x16 a, F32x16 b) { return _mm512_min_ps(a.v, b.v); }
TOFRAY_INLINE F32x16 max(F32x16 a, F32x16 b) { return _mm512_max_ps(a.v, b.v); }
TOFRAY_INLINE F32x16 floor(F32x16 a) { return _mm512_roundscale_ps(a.v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC); }
TOFRAY_INLINE F32x16 round_even(F32x16 a) { return _mm512_roundscale_ps(a.v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC); }
TOFRAY_INLINE U32x16 bits(F32x16 a) { return _mm512_castps_si512(a.v); }
TOFRAY_INLINE F32x16 from_bits(U32x16 a) { return _mm512_castsi512_ps(a.v); }
TOFRAY_INLINE F32x16 abs(F32x16 a) { return _mm512_abs_ps(a.v); }
TOFRAY_INLINE F32x16 copy_sign(F32x16 a, F32x16 b) {
  return from_bits(_mm512_ternarylogic_epi32(_mm512_set1_epi32(0x7fffffff), bits(a).v, bits(b).v, 0xCA));
}
TOFRAY_INLINE F32x16 select(Mask16 m, F32x16 a, F32x16 b) { return _mm512_mask_blend_ps(m.v, b.v, a.v); }
TOFRAY_INLINE I32x16 select(Mask16 m, I32x16 a, I32x16 b) { return _mm512_mask_blend_epi32(m.v, b.v, a.v); }
TOFRAY_INLINE U32x16 select(Mask16 m, U32x16 a, U32x16 b) { return _mm512_mask_blend_epi32(m.v, b.v, a.v); }
TOFRAY_INLINE I32x16 to_int(F32x16 a) { return _mm512_cvttps_epi32(a.v); }
TOFRAY_INLINE F32x16 to_float(I32x16 a) { return _mm512_cvtepi32_ps(a.v); }
TOFRAY_INLINE U32x16 to_uint(I32x16 a) { return a.v; }
TOFRAY_INLINE I32x16 to_signed(U32x16 a) { return a.v; }

TOFRAY_INLINE void multiply_wide(U32x16 a, U32x16 b, U32x16& high, U32x16& low) {
  const __m512i even = _mm512_mul_epu32(a.v, b.v);
  const __m512i odd = _mm512_mul_epu32(_mm512_shuffle_epi32(a.v, static_cast<_MM_PERM_ENUM>(0xF5)),
                                       _mm512_shuffle_epi32(b.v, static_cast<_MM_PERM_ENUM>(0xF5)));
  high = _mm512_mask_shuffle_epi32(odd, 0x5555, even, static_cast<_MM_PERM_ENUM>(0xF5));
  low = _mm512_mask_shuffle_epi32(even, 0xAAAA, odd, static_cast<_MM_PERM_ENUM>(0xA0));
}

/// Half bytes by tables, then bytes by places.
TOFRAY_INLINE U32x16 reversed(U32x16 a) {
  const __m512i half = _mm512_set1_epi8(0x0f);
  const __m512i upper =
      _mm512_broadcast_i32x4(_mm_setr_epi8(0, -128, 0x40, -64, 0x20, -96, 0x60, -32, 0x10, -112, 0x50, -48, 0x30, -80, 0x70, -16));
  const __m512i lower = _mm512_broadcast_i32x4(_mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15));
  const __m512i places = _mm512_broadcast_i32x4(_mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
  const __m512i in_bytes = _mm512_or_si512(_mm512_shuffle_epi8(upper, _mm512_and_si512(a.v, half)),
                                           _mm512_shuffle_epi8(lower, _mm512_and_si512(_mm512_srli_epi32(a.v, 4), half)));
  return _mm512_shuffle_epi8(in_bytes, places);
}

TOFRAY_INLINE F32x16 gather(const float* table, I32x16 index) { return _mm512_i32gather_ps(index.v, table, 4); }
TOFRAY_INLINE void gather_pair(const float* table, I32x16 index, F32x16& first, F32x16& second) {
  const __m512 low = _mm512_castpd_ps(_mm512_i32gather_pd(_mm512_castsi512_si256(index.v), table, 8));
  const __m512 high = _mm512_castpd_ps(_mm512_i32gather_pd(_mm512_extracti64x4_epi64(index.v, 1), table, 8));
  const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
  first = _mm512_permutex2var_ps(low, even, high);
  second = _mm512_permutex2var_ps(low, _mm512_add_epi32(even, _mm512_set1_epi32(1)), high);
}
TOFRAY_INLINE __m256 two_fours(const float* table, std::int32_t low, std::int32_t high) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(table + 4 * low)), _mm_load_ps(table + 4 * high), 1);
}
/// Four by four, turned.
TOFRAY_INLINE Four<F32x16> gather_four(const float* table, I32x16 index) {
  alignas(64) std::int32_t i[16];
  _mm512_store_si512(i, index.v);
  __m512 row[4];
  for (int j = 0; j < 4; ++j)
    row[j] = _mm512_insertf32x8(_mm512_castps256_ps512(two_fours(table, i[j], i[j + 4])), two_fours(table, i[j + 8], i[j + 12]), 1);
  const __m512 low = _mm512_unpacklo_ps(row[0], row[1]), more_low = _mm512_unpacklo_ps(row[2], row[3]);
  const __m512 high = _mm512_unpackhi_ps(row[0], row[1]), more_high = _mm512_unpackhi_ps(row[2], row[3]);
  return {{_mm512_shuffle_ps(low, more_low, 0x44), _mm512_shuffle_ps(low, more_low, 0xEE), _mm512_shuffle_ps(high, more_high, 0x44),
           _mm512_shuffle_ps(high, more_high, 0xEE)}};
}
TOFRAY_INLINE I32x16 gather(const std::int32_t* table, I32x16 index) { return _mm512_i32gather_epi32(index.v, table, 4); }
TOFRAY_INLINE std::int32_t first_of(Mask16 m, I32x16 a) {
  return _mm_cvtsi128_si32(_mm512_castsi512_si128(_mm512_maskz_compress_epi32(m.v, a.v)));
}

TOFRAY_INLINE F32x8 low_half(F32x16 a) { return _mm512_extractf32x8_ps(a.v, 0); }
TOFRAY_INLINE F32x8 high_half(F32x16 a) { return _mm512_extractf32x8_ps(a.v, 1); }
TOFRAY_INLINE float lowest(F32x16 a) { return lowest(min(low_half(a), high_half(a))); }
TOFRAY_INLINE float highest(F32x16 a) { return highest(max(low_half(a), high_half(a))); }

TOFRAY_INLINE __mmask16 first_lanes16(int n) { return static_cast<__mmask16>(n >= 16 ? 0xffffu : (1u << n) - 1u); }
TOFRAY_INLINE void store_dense(float* to, F32x16 a, std::uint32_t bits) {
  _mm512_storeu_ps(to, _mm512_maskz_compress_ps(static_cast<__mmask16>(bits), a.v));
}

template <>
struct Memory<F32x16> {
  TOFRAY_INLINE static F32x16 load_dense(const float* from, std::uint32_t bits) {
    return _mm512_maskz_expand_ps(static_cast<__mmask16>(bits), _mm512_loadu_ps(from));
  }
  TOFRAY_INLINE static void finish_stores() { _mm_sfence(); }
  TOFRAY_INLINE static I32x16 lane_index() { return _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15); }
  TOFRAY_INLINE static F32x16 load(const float* from, int n) {
    return n >= 16 ? _mm512_loadu_ps(from) : _mm512_maskz_loadu_ps(first_lanes16(n), from);
  }
  TOFRAY_INLINE static F32x16 load_square(const float* from, int row) {
    return _mm512_insertf32x8(_mm512_castps256_ps512(Memory<F32x8>::load_square(from, row).v),
                              Memory<F32x8>::load_square(from + 2 * row, row).v, 1);
  }
  TOFRAY_INLINE static I32x16 load_int(const std::int32_t* from, int n) {
    return n >= 16 ? _mm512_loadu_si512(from) : _mm512_maskz_loadu_epi32(first_lanes16(n), from);
  }
};
TOFRAY_INLINE void store_square(float* to, int row, F32x16 a) {
  store_square(to, row, low_half(a)), store_square(to + 2 * row, row, high_half(a));
}
// Whole packs go without a mask: masked stores are slower on some machines, and conversion within a masked store much slower.
TOFRAY_INLINE void store(float* to, F32x16 a, int n) {
  if (n >= 16) {
    _mm512_storeu_ps(to, a.v);
  } else {
    _mm512_mask_storeu_ps(to, first_lanes16(n), a.v);
  }
}
TOFRAY_INLINE void store(std::int32_t* to, I32x16 a, int n) {
  if (n >= 16) {
    _mm512_storeu_si512(to, a.v);
  } else {
    _mm512_mask_storeu_epi32(to, first_lanes16(n), a.v);
  }
}
TOFRAY_INLINE void store(std::uint16_t* to, I32x16 a, int n) {
  const __m256i narrow = _mm512_cvtepi32_epi16(a.v);
  if (n >= 16) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), narrow);
  } else {
    _mm256_mask_storeu_epi16(to, first_lanes16(n), narrow);
  }
}
template <>
inline constexpr bool can_store_past<F32x16> = true;
TOFRAY_INLINE void store_past(float* to, F32x16 a) { _mm512_stream_ps(to, a.v); }
TOFRAY_INLINE void store_past(std::uint16_t* to, I32x16 a) {
  _mm256_stream_si256(reinterpret_cast<__m256i*>(to), _mm512_cvtepi32_epi16(a.v));
}
TOFRAY_INLINE void store(std::uint8_t* to, I32x16 a, int n) {
  const __m128i narrow = _mm512_cvtepi32_epi8(a.v);
  if (n >= 16) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), narrow);
  } else {
    _mm_mask_storeu_epi8(to, first_lanes16(n), narrow);
  }
}

/// Elements of x0 y0 z0 x1 y1 z1 …: those of x and y by `from_xy` (16 on: y), then those of z put in by `from_z` (16 on: z).
TOFRAY_INLINE __m512 interleaved(__m512 x, __m512 y, __m512 z, __m512i from_xy, __m512i from_z) {
  return _mm512_permutex2var_ps(_mm512_permutex2var_ps(x, from_xy, y), from_z, z);
}
TOFRAY_INLINE void store2(float* to, F32x16 x, F32x16 y, int n) {
  const __m512i low = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23),
                high = _mm512_add_epi32(low, _mm512_set1_epi32(8));
  store(to, F32x16(_mm512_permutex2var_ps(x.v, low, y.v)), 2 * n);
  if (2 * n > 16) store(to + 16, F32x16(_mm512_permutex2var_ps(x.v, high, y.v)), 2 * n - 16);
}
TOFRAY_INLINE void store3(float* to, F32x16 x, F32x16 y, F32x16 z, int n) {
  const __m512 first = interleaved(x.v, y.v, z.v, _mm512_setr_epi32(0, 16, 0, 1, 17, 0, 2, 18, 0, 3, 19, 0, 4, 20, 0, 5),
                                   _mm512_setr_epi32(0, 1, 16, 3, 4, 17, 6, 7, 18, 9, 10, 19, 12, 13, 20, 15));
  const __m512 second = interleaved(x.v, y.v, z.v, _mm512_setr_epi32(21, 0, 6, 22, 0, 7, 23, 0, 8, 24, 0, 9, 25, 0, 10, 26),
                                    _mm512_setr_epi32(0, 21, 2, 3, 22, 5, 6, 23, 8, 9, 24, 11, 12, 25, 14, 15));
  const __m512 third = interleaved(x.v, y.v, z.v, _mm512_setr_epi32(0, 11, 27, 0, 12, 28, 0, 13, 29, 0, 14, 30, 0, 15, 31, 0),
                                   _mm512_setr_epi32(26, 1, 2, 27, 4, 5, 28, 7, 8, 29, 10, 11, 30, 13, 14, 31));
  store(to, F32x16(first), 3 * n);
  if (3 * n > 16) store(to + 16, F32x16(second), 3 * n - 16);
  if (3 * n > 32) store(to + 32, F32x16(third), 3 * n - 32);
}

}  // namespace tofray::num
