// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <immintrin.h>

#include "num/num.h"

/// Eight lanes with AVX2 and FMA.
namespace tofray::num {

struct Mask8 {
  __m256 v;
};
struct F32x8 {
  __m256 v;
  F32x8() = default;
  TOFRAY_INLINE F32x8(__m256 a) : v(a) {}
  TOFRAY_INLINE F32x8(float a) : v(_mm256_set1_ps(a)) {}
};
struct I32x8 {
  __m256i v;
  I32x8() = default;
  TOFRAY_INLINE I32x8(__m256i a) : v(a) {}
  TOFRAY_INLINE I32x8(std::int32_t a) : v(_mm256_set1_epi32(a)) {}
};
struct U32x8 {
  __m256i v;
  U32x8() = default;
  TOFRAY_INLINE U32x8(__m256i a) : v(a) {}
  TOFRAY_INLINE U32x8(std::uint32_t a) : v(_mm256_set1_epi32(static_cast<std::int32_t>(a))) {}
};

template <>
struct Traits<F32x8> {
  using Int = I32x8;
  using Uint = U32x8;
  using Mask = Mask8;
  using Eight = F32x8;
  using Square = Twin<F32x8>;
  static constexpr int lanes = 8;
};

TOFRAY_INLINE F32x8 operator+(F32x8 a, F32x8 b) { return _mm256_add_ps(a.v, b.v); }
TOFRAY_INLINE F32x8 operator-(F32x8 a, F32x8 b) { return _mm256_sub_ps(a.v, b.v); }
TOFRAY_INLINE F32x8 operator*(F32x8 a, F32x8 b) { return _mm256_mul_ps(a.v, b.v); }
TOFRAY_INLINE F32x8 operator/(F32x8 a, F32x8 b) { return _mm256_div_ps(a.v, b.v); }
TOFRAY_INLINE F32x8 operator-(F32x8 a) { return _mm256_xor_ps(a.v, _mm256_set1_ps(-0.0f)); }
TOFRAY_INLINE Mask8 operator<(F32x8 a, F32x8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
TOFRAY_INLINE Mask8 operator<=(F32x8 a, F32x8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)}; }
TOFRAY_INLINE Mask8 operator>(F32x8 a, F32x8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)}; }
TOFRAY_INLINE Mask8 operator>=(F32x8 a, F32x8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_GE_OQ)}; }
TOFRAY_INLINE Mask8 operator==(F32x8 a, F32x8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_EQ_OQ)}; }
TOFRAY_INLINE Mask8 operator!=(F32x8 a, F32x8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_NEQ_UQ)}; }

TOFRAY_INLINE Mask8 operator&(Mask8 a, Mask8 b) { return {_mm256_and_ps(a.v, b.v)}; }
TOFRAY_INLINE Mask8 operator|(Mask8 a, Mask8 b) { return {_mm256_or_ps(a.v, b.v)}; }
TOFRAY_INLINE Mask8 operator!(Mask8 a) { return {_mm256_xor_ps(a.v, _mm256_castsi256_ps(_mm256_set1_epi32(-1)))}; }
TOFRAY_INLINE bool any(Mask8 a) { return _mm256_movemask_ps(a.v) != 0; }
TOFRAY_INLINE bool all(Mask8 a) { return _mm256_movemask_ps(a.v) == 0xff; }
TOFRAY_INLINE std::uint32_t lanes_of(Mask8 a) { return static_cast<std::uint32_t>(_mm256_movemask_ps(a.v)); }

TOFRAY_INLINE I32x8 operator+(I32x8 a, I32x8 b) { return _mm256_add_epi32(a.v, b.v); }
TOFRAY_INLINE I32x8 operator-(I32x8 a, I32x8 b) { return _mm256_sub_epi32(a.v, b.v); }
TOFRAY_INLINE I32x8 operator*(I32x8 a, I32x8 b) { return _mm256_mullo_epi32(a.v, b.v); }
TOFRAY_INLINE I32x8 operator&(I32x8 a, I32x8 b) { return _mm256_and_si256(a.v, b.v); }
TOFRAY_INLINE I32x8 operator|(I32x8 a, I32x8 b) { return _mm256_or_si256(a.v, b.v); }
TOFRAY_INLINE Mask8 operator==(I32x8 a, I32x8 b) { return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(a.v, b.v))}; }
TOFRAY_INLINE Mask8 operator!=(I32x8 a, I32x8 b) { return !(a == b); }
TOFRAY_INLINE Mask8 operator>(I32x8 a, I32x8 b) { return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(a.v, b.v))}; }
TOFRAY_INLINE Mask8 operator<(I32x8 a, I32x8 b) { return b > a; }

TOFRAY_INLINE U32x8 operator+(U32x8 a, U32x8 b) { return _mm256_add_epi32(a.v, b.v); }
TOFRAY_INLINE U32x8 operator*(U32x8 a, U32x8 b) { return _mm256_mullo_epi32(a.v, b.v); }
TOFRAY_INLINE U32x8 operator&(U32x8 a, U32x8 b) { return _mm256_and_si256(a.v, b.v); }
TOFRAY_INLINE U32x8 operator|(U32x8 a, U32x8 b) { return _mm256_or_si256(a.v, b.v); }
TOFRAY_INLINE U32x8 operator^(U32x8 a, U32x8 b) { return _mm256_xor_si256(a.v, b.v); }
TOFRAY_INLINE U32x8 operator<<(U32x8 a, int n) { return _mm256_slli_epi32(a.v, n); }
TOFRAY_INLINE U32x8 operator>>(U32x8 a, int n) { return _mm256_srli_epi32(a.v, n); }

TOFRAY_INLINE F32x8 fma(F32x8 a, F32x8 b, F32x8 c) { return _mm256_fmadd_ps(a.v, b.v, c.v); }
TOFRAY_INLINE F32x8 fms(F32x8 a, F32x8 b, F32x8 c) { return _mm256_fmsub_ps(a.v, b.v, c.v); }
TOFRAY_INLINE F32x8 fnma(F32x8 a, F32x8 b, F32x8 c) { return _mm256_fnmadd_ps(a.v, b.v, c.v); }
TOFRAY_INLINE F32x8 sqrt(F32x8 a) { return _mm256_sqrt_ps(a.v); }
TOFRAY_INLINE F32x8 min(F32x8 a, F32x8 b) { return _mm256_min_ps(a.v, b.v); }
TOFRAY_INLINE F32x8 max(F32x8 a, F32x8 b) { return _mm256_max_ps(a.v, b.v); }
TOFRAY_INLINE F32x8 floor(F32x8 a) { return _mm256_floor_ps(a.v); }
TOFRAY_INLINE F32x8 round_even(F32x8 a) { return _mm256_round_ps(a.v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC); }
TOFRAY_INLINE U32x8 bits(F32x8 a) { return _mm256_castps_si256(a.v); }
TOFRAY_INLINE F32x8 from_bits(U32x8 a) { return _mm256_castsi256_ps(a.v); }
TOFRAY_INLINE F32x8 abs(F32x8 a) { return from_bits(bits(a) & 0x7fffffffu); }
TOFRAY_INLINE F32x8 copy_sign(F32x8 a, F32x8 b) { return from_bits((bits(a) & 0x7fffffffu) | (bits(b) & 0x80000000u)); }
TOFRAY_INLINE F32x8 select(Mask8 m, F32x8 a, F32x8 b) { return _mm256_blendv_ps(b.v, a.v, m.v); }
TOFRAY_INLINE I32x8 select(Mask8 m, I32x8 a, I32x8 b) {
  return _mm256_castps_si256(_mm256_blendv_ps(_mm256_castsi256_ps(b.v), _mm256_castsi256_ps(a.v), m.v));
}
TOFRAY_INLINE U32x8 select(Mask8 m, U32x8 a, U32x8 b) { return select(m, I32x8(a.v), I32x8(b.v)).v; }
TOFRAY_INLINE I32x8 to_int(F32x8 a) { return _mm256_cvttps_epi32(a.v); }
TOFRAY_INLINE F32x8 to_float(I32x8 a) { return _mm256_cvtepi32_ps(a.v); }
TOFRAY_INLINE U32x8 to_uint(I32x8 a) { return a.v; }
TOFRAY_INLINE I32x8 to_signed(U32x8 a) { return a.v; }

TOFRAY_INLINE void multiply_wide(U32x8 a, U32x8 b, U32x8& high, U32x8& low) {
  const __m256i even = _mm256_mul_epu32(a.v, b.v);
  const __m256i odd = _mm256_mul_epu32(_mm256_srli_epi64(a.v, 32), _mm256_srli_epi64(b.v, 32));
  high = _mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xAA);
  low = _mm256_blend_epi32(even, _mm256_slli_epi64(odd, 32), 0xAA);
}

/// Half bytes by tables, then bytes by places.
TOFRAY_INLINE U32x8 reversed(U32x8 a) {
  const __m256i half = _mm256_set1_epi8(0x0f);
  const __m256i upper =
      _mm256_broadcastsi128_si256(_mm_setr_epi8(0, -128, 0x40, -64, 0x20, -96, 0x60, -32, 0x10, -112, 0x50, -48, 0x30, -80, 0x70, -16));
  const __m256i lower = _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15));
  const __m256i places = _mm256_broadcastsi128_si256(_mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
  const __m256i in_bytes = _mm256_or_si256(_mm256_shuffle_epi8(upper, _mm256_and_si256(a.v, half)),
                                           _mm256_shuffle_epi8(lower, _mm256_and_si256(_mm256_srli_epi32(a.v, 4), half)));
  return _mm256_shuffle_epi8(in_bytes, places);
}

TOFRAY_INLINE F32x8 gather(const float* table, I32x8 index) { return _mm256_i32gather_ps(table, index.v, 4); }
TOFRAY_INLINE __m128 two_pairs(const double* pairs, std::int32_t low, std::int32_t high) {
  return _mm_castpd_ps(_mm_loadh_pd(_mm_load_sd(pairs + low), pairs + high));
}
/// Pair by pair: the processor's own gather of pairs takes twice the time (benches/README.md).
TOFRAY_INLINE void gather_pair(const float* table, I32x8 index, F32x8& first, F32x8& second) {
  const double* pairs = reinterpret_cast<const double*>(table);
  alignas(32) std::int32_t i[8];
  _mm256_store_si256(reinterpret_cast<__m256i*>(i), index.v);
  const __m256 outer = _mm256_insertf128_ps(_mm256_castps128_ps256(two_pairs(pairs, i[0], i[1])), two_pairs(pairs, i[4], i[5]), 1);
  const __m256 inner = _mm256_insertf128_ps(_mm256_castps128_ps256(two_pairs(pairs, i[2], i[3])), two_pairs(pairs, i[6], i[7]), 1);
  first = _mm256_shuffle_ps(outer, inner, 0x88), second = _mm256_shuffle_ps(outer, inner, 0xDD);
}
/// Four by four, turned.
TOFRAY_INLINE Four<F32x8> gather_four(const float* table, I32x8 index) {
  alignas(32) std::int32_t i[8];
  _mm256_store_si256(reinterpret_cast<__m256i*>(i), index.v);
  __m256 row[4];
  for (int j = 0; j < 4; ++j)
    row[j] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(table + 4 * i[j])), _mm_load_ps(table + 4 * i[j + 4]), 1);
  const __m256 low = _mm256_unpacklo_ps(row[0], row[1]), more_low = _mm256_unpacklo_ps(row[2], row[3]);
  const __m256 high = _mm256_unpackhi_ps(row[0], row[1]), more_high = _mm256_unpackhi_ps(row[2], row[3]);
  return {{_mm256_shuffle_ps(low, more_low, 0x44), _mm256_shuffle_ps(low, more_low, 0xEE), _mm256_shuffle_ps(high, more_high, 0x44),
           _mm256_shuffle_ps(high, more_high, 0xEE)}};
}
TOFRAY_INLINE I32x8 gather(const std::int32_t* table, I32x8 index) { return _mm256_i32gather_epi32(table, index.v, 4); }
TOFRAY_INLINE std::int32_t first_of(Mask8 m, I32x8 a) {
  return _mm256_cvtsi256_si32(_mm256_permutevar8x32_epi32(a.v, _mm256_set1_epi32(__builtin_ctz(lanes_of(m)))));
}

TOFRAY_INLINE float lowest(F32x8 a) {
  __m128 m = _mm_min_ps(_mm256_castps256_ps128(a.v), _mm256_extractf128_ps(a.v, 1));
  m = _mm_min_ps(m, _mm_movehl_ps(m, m));
  return _mm_cvtss_f32(_mm_min_ss(m, _mm_movehdup_ps(m)));
}
TOFRAY_INLINE float highest(F32x8 a) {
  __m128 m = _mm_max_ps(_mm256_castps256_ps128(a.v), _mm256_extractf128_ps(a.v, 1));
  m = _mm_max_ps(m, _mm_movehl_ps(m, m));
  return _mm_cvtss_f32(_mm_max_ss(m, _mm_movehdup_ps(m)));
}

/// Of each set of eight lanes, in a byte each: which lanes those are that have a bit, one after the other; and the way back, the place of
/// each of them (128: it has no bit).
struct DenseLanes {
  std::uint64_t to[256], back[256];
  constexpr DenseLanes() : to(), back() {
    for (int bits = 0; bits < 256; ++bits) {
      int place = 0;
      for (int lane = 0; lane < 8; ++lane) {
        const bool has = (bits >> lane & 1) != 0;
        back[bits] |= std::uint64_t{has ? static_cast<unsigned>(place) : 128u} << (8 * lane);
        if (has) to[bits] |= std::uint64_t{static_cast<unsigned>(lane)} << (8 * place++);
      }
    }
  }
};
static constexpr DenseLanes dense_lanes;  // no symbol of its own, which a linker could hand to another kernel
TOFRAY_INLINE __m256i eight_bytes(std::uint64_t bytes) { return _mm256_cvtepi8_epi32(_mm_cvtsi64_si128(static_cast<long long>(bytes))); }
TOFRAY_INLINE void store_dense(float* to, F32x8 a, std::uint32_t bits) {
  _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(a.v, eight_bytes(dense_lanes.to[bits])));
}

TOFRAY_INLINE __m256i first_lanes8(int n) { return _mm256_cmpgt_epi32(_mm256_set1_epi32(n), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)); }
template <>
struct Memory<F32x8> {
  TOFRAY_INLINE static I32x8 lane_index() { return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7); }
  TOFRAY_INLINE static F32x8 load(const float* from, int n) {
    return n >= 8 ? _mm256_loadu_ps(from) : _mm256_maskload_ps(from, first_lanes8(n));
  }
  TOFRAY_INLINE static F32x8 load_square(const float* from, int row) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(from)), _mm_loadu_ps(from + row), 1);
  }
  TOFRAY_INLINE static void finish_stores() { _mm_sfence(); }
  TOFRAY_INLINE static F32x8 load_dense(const float* from, std::uint32_t bits) {
    const __m256i place = eight_bytes(dense_lanes.back[bits]);  // below 0: no bit
    return _mm256_andnot_ps(_mm256_castsi256_ps(_mm256_srai_epi32(place, 31)), _mm256_permutevar8x32_ps(_mm256_loadu_ps(from), place));
  }
  TOFRAY_INLINE static I32x8 load_int(const std::int32_t* from, int n) { return _mm256_maskload_epi32(from, first_lanes8(n)); }
};
TOFRAY_INLINE void store_square(float* to, int row, F32x8 a) {
  _mm_storeu_ps(to, _mm256_castps256_ps128(a.v)), _mm_storeu_ps(to + row, _mm256_extractf128_ps(a.v, 1));
}
TOFRAY_INLINE void store(float* to, F32x8 a, int n) {
  if (n >= 8) {
    _mm256_storeu_ps(to, a.v);
  } else {
    _mm256_maskstore_ps(to, first_lanes8(n), a.v);
  }
}
TOFRAY_INLINE void store(std::int32_t* to, I32x8 a, int n) { _mm256_maskstore_epi32(to, first_lanes8(n), a.v); }
TOFRAY_INLINE void store(std::uint16_t* to, I32x8 a, int n) {
  const __m128i narrow = _mm256_castsi256_si128(_mm256_permute4x64_epi64(_mm256_packus_epi32(a.v, a.v), 0x08));
  if (n >= 8) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), narrow);
  } else {
    alignas(16) std::uint16_t packed[8];
    _mm_store_si128(reinterpret_cast<__m128i*>(packed), narrow);
    for (int i = 0; i < n; ++i) to[i] = packed[i];
  }
}
TOFRAY_INLINE void store(std::uint8_t* to, I32x8 a, int n) {
  const __m128i halves = _mm256_castsi256_si128(_mm256_permute4x64_epi64(_mm256_packus_epi32(a.v, a.v), 0x08));
  const __m128i narrow = _mm_packus_epi16(halves, halves);
  if (n >= 8) {
    _mm_storel_epi64(reinterpret_cast<__m128i*>(to), narrow);
  } else {
    alignas(16) std::uint8_t packed[16];
    _mm_store_si128(reinterpret_cast<__m128i*>(packed), narrow);
    for (int i = 0; i < n; ++i) to[i] = packed[i];
  }
}
template <>
inline constexpr bool can_store_past<F32x8> = true;
TOFRAY_INLINE void store_past(float* to, F32x8 a) { _mm256_stream_ps(to, a.v); }
TOFRAY_INLINE void store_past(std::uint16_t* to, I32x8 a) {
  _mm_stream_si128(reinterpret_cast<__m128i*>(to), _mm256_castsi256_si128(_mm256_permute4x64_epi64(_mm256_packus_epi32(a.v, a.v), 0x08)));
}
TOFRAY_INLINE void store2(float* to, F32x8 x, F32x8 y, int n) {
  const __m256 low = _mm256_unpacklo_ps(x.v, y.v), high = _mm256_unpackhi_ps(x.v, y.v);
  store(to, F32x8(_mm256_permute2f128_ps(low, high, 0x20)), 2 * n);
  if (2 * n > 8) store(to + 8, F32x8(_mm256_permute2f128_ps(low, high, 0x31)), 2 * n - 8);
}
/// Elements of x0 y0 z0 x1 y1 z1 …: all three packs in the same new order, taken in turn.
template <int x_lanes, int y_lanes>
TOFRAY_INLINE __m256 interleaved(__m256 x, __m256 y, __m256 z, __m256i order) {
  const __m256 xy = _mm256_blend_ps(_mm256_permutevar8x32_ps(z, order), _mm256_permutevar8x32_ps(y, order), y_lanes);
  return _mm256_blend_ps(xy, _mm256_permutevar8x32_ps(x, order), x_lanes);
}
TOFRAY_INLINE void store3(float* to, F32x8 x, F32x8 y, F32x8 z, int n) {
  const __m256i first = _mm256_setr_epi32(0, 0, 0, 1, 1, 1, 2, 2), second = _mm256_setr_epi32(2, 3, 3, 3, 4, 4, 4, 5);
  const __m256i third = _mm256_setr_epi32(5, 5, 6, 6, 6, 7, 7, 7);
  store(to, F32x8(interleaved<0x49, 0x92>(x.v, y.v, z.v, first)), 3 * n);
  if (3 * n > 8) store(to + 8, F32x8(interleaved<0x92, 0x24>(x.v, y.v, z.v, second)), 3 * n - 8);
  if (3 * n > 16) store(to + 16, F32x8(interleaved<0x24, 0x49>(x.v, y.v, z.v, third)), 3 * n - 16);
}

}  // namespace tofray::num
