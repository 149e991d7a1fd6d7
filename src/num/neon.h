// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <arm_neon.h>

#include "num/num.h"

/// Four lanes with NEON as every 64-bit ARM has it (which rounds as IEEE 754 says and keeps subnormals; that of 32 bits does not).
/// Kernels take two of them side by side (twin.h).
namespace tofray::num {

struct Mask4 {
  uint32x4_t v;  ///< all bits of a lane, or none
};
struct F32x4 {
  float32x4_t v;
  F32x4() = default;
  TOFRAY_INLINE F32x4(float32x4_t a) : v(a) {}
  TOFRAY_INLINE F32x4(float a) : v(vdupq_n_f32(a)) {}
};
struct I32x4 {
  int32x4_t v;
  I32x4() = default;
  TOFRAY_INLINE I32x4(int32x4_t a) : v(a) {}
  TOFRAY_INLINE I32x4(std::int32_t a) : v(vdupq_n_s32(a)) {}
};
struct U32x4 {
  uint32x4_t v;
  U32x4() = default;
  TOFRAY_INLINE U32x4(uint32x4_t a) : v(a) {}
  TOFRAY_INLINE U32x4(std::uint32_t a) : v(vdupq_n_u32(a)) {}
};

template <>
struct Traits<F32x4> {
  using Int = I32x4;
  using Uint = U32x4;
  using Mask = Mask4;
  using Eight = Twin<F32x4>;
  using Square = Twin<Twin<F32x4>>;
  static constexpr int lanes = 4;
};

TOFRAY_INLINE F32x4 operator+(F32x4 a, F32x4 b) { return vaddq_f32(a.v, b.v); }
TOFRAY_INLINE F32x4 operator-(F32x4 a, F32x4 b) { return vsubq_f32(a.v, b.v); }
TOFRAY_INLINE F32x4 operator*(F32x4 a, F32x4 b) { return vmulq_f32(a.v, b.v); }
TOFRAY_INLINE F32x4 operator/(F32x4 a, F32x4 b) { return vdivq_f32(a.v, b.v); }
TOFRAY_INLINE F32x4 operator-(F32x4 a) { return vnegq_f32(a.v); }
TOFRAY_INLINE Mask4 operator<(F32x4 a, F32x4 b) { return {vcltq_f32(a.v, b.v)}; }
TOFRAY_INLINE Mask4 operator<=(F32x4 a, F32x4 b) { return {vcleq_f32(a.v, b.v)}; }
TOFRAY_INLINE Mask4 operator>(F32x4 a, F32x4 b) { return {vcgtq_f32(a.v, b.v)}; }
TOFRAY_INLINE Mask4 operator>=(F32x4 a, F32x4 b) { return {vcgeq_f32(a.v, b.v)}; }
TOFRAY_INLINE Mask4 operator==(F32x4 a, F32x4 b) { return {vceqq_f32(a.v, b.v)}; }
TOFRAY_INLINE Mask4 operator!=(F32x4 a, F32x4 b) { return {vmvnq_u32(vceqq_f32(a.v, b.v))}; }

TOFRAY_INLINE Mask4 operator&(Mask4 a, Mask4 b) { return {vandq_u32(a.v, b.v)}; }
TOFRAY_INLINE Mask4 operator|(Mask4 a, Mask4 b) { return {vorrq_u32(a.v, b.v)}; }
TOFRAY_INLINE Mask4 operator!(Mask4 a) { return {vmvnq_u32(a.v)}; }
TOFRAY_INLINE bool any(Mask4 a) { return vmaxvq_u32(a.v) != 0; }
TOFRAY_INLINE bool all(Mask4 a) { return vminvq_u32(a.v) != 0; }

TOFRAY_INLINE I32x4 operator+(I32x4 a, I32x4 b) { return vaddq_s32(a.v, b.v); }
TOFRAY_INLINE I32x4 operator-(I32x4 a, I32x4 b) { return vsubq_s32(a.v, b.v); }
TOFRAY_INLINE I32x4 operator*(I32x4 a, I32x4 b) { return vmulq_s32(a.v, b.v); }
TOFRAY_INLINE I32x4 operator&(I32x4 a, I32x4 b) { return vandq_s32(a.v, b.v); }
TOFRAY_INLINE I32x4 operator|(I32x4 a, I32x4 b) { return vorrq_s32(a.v, b.v); }
TOFRAY_INLINE Mask4 operator==(I32x4 a, I32x4 b) { return {vceqq_s32(a.v, b.v)}; }
TOFRAY_INLINE Mask4 operator!=(I32x4 a, I32x4 b) { return !(a == b); }
TOFRAY_INLINE Mask4 operator>(I32x4 a, I32x4 b) { return {vcgtq_s32(a.v, b.v)}; }
TOFRAY_INLINE Mask4 operator<(I32x4 a, I32x4 b) { return {vcltq_s32(a.v, b.v)}; }

TOFRAY_INLINE U32x4 operator+(U32x4 a, U32x4 b) { return vaddq_u32(a.v, b.v); }
TOFRAY_INLINE U32x4 operator*(U32x4 a, U32x4 b) { return vmulq_u32(a.v, b.v); }
TOFRAY_INLINE U32x4 operator&(U32x4 a, U32x4 b) { return vandq_u32(a.v, b.v); }
TOFRAY_INLINE U32x4 operator|(U32x4 a, U32x4 b) { return vorrq_u32(a.v, b.v); }
TOFRAY_INLINE U32x4 operator^(U32x4 a, U32x4 b) { return veorq_u32(a.v, b.v); }
// The compiler's own shifts of packs, of which it makes the one instruction with a constant (intrinsics of that want it as an argument).
TOFRAY_INLINE U32x4 operator<<(U32x4 a, int n) { return a.v << vdupq_n_u32(static_cast<std::uint32_t>(n)); }
TOFRAY_INLINE U32x4 operator>>(U32x4 a, int n) { return a.v >> vdupq_n_u32(static_cast<std::uint32_t>(n)); }

TOFRAY_INLINE F32x4 fma(F32x4 a, F32x4 b, F32x4 c) { return vfmaq_f32(c.v, a.v, b.v); }
TOFRAY_INLINE F32x4 fms(F32x4 a, F32x4 b, F32x4 c) { return vfmaq_f32(vnegq_f32(c.v), a.v, b.v); }
TOFRAY_INLINE F32x4 fnma(F32x4 a, F32x4 b, F32x4 c) { return vfmsq_f32(c.v, a.v, b.v); }
TOFRAY_INLINE F32x4 sqrt(F32x4 a) { return vsqrtq_f32(a.v); }
TOFRAY_INLINE F32x4 select(Mask4 m, F32x4 a, F32x4 b) { return vbslq_f32(m.v, a.v, b.v); }
TOFRAY_INLINE I32x4 select(Mask4 m, I32x4 a, I32x4 b) { return vbslq_s32(m.v, a.v, b.v); }
TOFRAY_INLINE U32x4 select(Mask4 m, U32x4 a, U32x4 b) { return vbslq_u32(m.v, a.v, b.v); }
// NEON's own minimum and maximum answer otherwise where one is NaN, and tell −0 from 0.
TOFRAY_INLINE F32x4 min(F32x4 a, F32x4 b) { return select(a < b, a, b); }
TOFRAY_INLINE F32x4 max(F32x4 a, F32x4 b) { return select(a > b, a, b); }
TOFRAY_INLINE F32x4 floor(F32x4 a) { return vrndmq_f32(a.v); }
TOFRAY_INLINE F32x4 round_even(F32x4 a) { return vrndnq_f32(a.v); }
TOFRAY_INLINE U32x4 bits(F32x4 a) { return vreinterpretq_u32_f32(a.v); }
TOFRAY_INLINE F32x4 from_bits(U32x4 a) { return vreinterpretq_f32_u32(a.v); }
TOFRAY_INLINE F32x4 abs(F32x4 a) { return vabsq_f32(a.v); }
TOFRAY_INLINE F32x4 copy_sign(F32x4 a, F32x4 b) { return vbslq_f32(vdupq_n_u32(0x80000000u), b.v, a.v); }
TOFRAY_INLINE I32x4 to_int(F32x4 a) { return vcvtq_s32_f32(a.v); }
TOFRAY_INLINE F32x4 to_float(I32x4 a) { return vcvtq_f32_s32(a.v); }
TOFRAY_INLINE U32x4 to_uint(I32x4 a) { return vreinterpretq_u32_s32(a.v); }
TOFRAY_INLINE I32x4 to_signed(U32x4 a) { return vreinterpretq_s32_u32(a.v); }

TOFRAY_INLINE void multiply_wide(U32x4 a, U32x4 b, U32x4& high, U32x4& low) {
  const uint32x4_t first = vreinterpretq_u32_u64(vmull_u32(vget_low_u32(a.v), vget_low_u32(b.v)));
  const uint32x4_t second = vreinterpretq_u32_u64(vmull_high_u32(a.v, b.v));
  high = vuzp2q_u32(first, second), low = vuzp1q_u32(first, second);
}

// There is no gather: a load for each lane.
TOFRAY_INLINE U32x4 reversed(U32x4 a) { return vreinterpretq_u32_u8(vrev32q_u8(vrbitq_u8(vreinterpretq_u8_u32(a.v)))); }

TOFRAY_INLINE F32x4 gather(const float* table, I32x4 index) {
  float32x4_t out = vdupq_n_f32(table[vgetq_lane_s32(index.v, 0)]);
  out = vld1q_lane_f32(table + vgetq_lane_s32(index.v, 1), out, 1);
  out = vld1q_lane_f32(table + vgetq_lane_s32(index.v, 2), out, 2);
  return vld1q_lane_f32(table + vgetq_lane_s32(index.v, 3), out, 3);
}
TOFRAY_INLINE I32x4 gather(const std::int32_t* table, I32x4 index) {
  int32x4_t out = vdupq_n_s32(table[vgetq_lane_s32(index.v, 0)]);
  out = vld1q_lane_s32(table + vgetq_lane_s32(index.v, 1), out, 1);
  out = vld1q_lane_s32(table + vgetq_lane_s32(index.v, 2), out, 2);
  return vld1q_lane_s32(table + vgetq_lane_s32(index.v, 3), out, 3);
}
TOFRAY_INLINE void gather_pair(const float* table, I32x4 index, F32x4& first, F32x4& second) {
  const float32x4_t low = vcombine_f32(vld1_f32(table + 2 * vgetq_lane_s32(index.v, 0)), vld1_f32(table + 2 * vgetq_lane_s32(index.v, 1)));
  const float32x4_t high = vcombine_f32(vld1_f32(table + 2 * vgetq_lane_s32(index.v, 2)), vld1_f32(table + 2 * vgetq_lane_s32(index.v, 3)));
  first = vuzp1q_f32(low, high), second = vuzp2q_f32(low, high);
}
TOFRAY_INLINE Four<F32x4> gather_four(const float* table, I32x4 index) {
  const float32x4_t a = vld1q_f32(table + 4 * vgetq_lane_s32(index.v, 0)), b = vld1q_f32(table + 4 * vgetq_lane_s32(index.v, 1));
  const float32x4_t c = vld1q_f32(table + 4 * vgetq_lane_s32(index.v, 2)), d = vld1q_f32(table + 4 * vgetq_lane_s32(index.v, 3));
  const float32x4_t even = vtrn1q_f32(a, b), odd = vtrn2q_f32(a, b), more_even = vtrn1q_f32(c, d), more_odd = vtrn2q_f32(c, d);
  return {{vcombine_f32(vget_low_f32(even), vget_low_f32(more_even)), vcombine_f32(vget_low_f32(odd), vget_low_f32(more_odd)),
           vcombine_f32(vget_high_f32(even), vget_high_f32(more_even)), vcombine_f32(vget_high_f32(odd), vget_high_f32(more_odd))}};
}

// By comparisons, and in the order of AVX's lanes: zeros keep their signs.
TOFRAY_INLINE float lowest(F32x4 a) {
  const F32x4 m = min(a, vextq_f32(a.v, a.v, 2));
  return min(vgetq_lane_f32(m.v, 0), vgetq_lane_f32(m.v, 1));
}
TOFRAY_INLINE float highest(F32x4 a) {
  const F32x4 m = max(a, vextq_f32(a.v, a.v, 2));
  return max(vgetq_lane_f32(m.v, 0), vgetq_lane_f32(m.v, 1));
}

TOFRAY_INLINE I32x4 numbered4() {
  constexpr std::int32_t numbers[4] = {0, 1, 2, 3};
  return vld1q_s32(numbers);
}
TOFRAY_INLINE std::uint32_t lanes_of(Mask4 a) { return vaddvq_u32(vandq_u32(a.v, vshlq_u32(vdupq_n_u32(1), numbered4().v))); }
TOFRAY_INLINE std::int32_t first_of(Mask4 m, I32x4 a) {
  std::int32_t all_lanes[4];
  vst1q_s32(all_lanes, a.v);
  return all_lanes[__builtin_ctz(lanes_of(m))];
}

// Parts of a pack lane by lane: nothing beyond it is read or written.
TOFRAY_INLINE void store_dense(float* to, F32x4 a, std::uint32_t bits) {
  float lane[4];
  vst1q_f32(lane, a.v);
  for (; bits != 0; bits &= bits - 1) *to++ = lane[__builtin_ctz(bits)];
}

template <>
struct Memory<F32x4> {
  TOFRAY_INLINE static F32x4 load_dense(const float* from, std::uint32_t bits) {
    float lane[4] = {0, 0, 0, 0};
    for (; bits != 0; bits &= bits - 1) lane[__builtin_ctz(bits)] = *from++;
    return vld1q_f32(lane);
  }
  TOFRAY_INLINE static I32x4 lane_index() { return numbered4(); }
  TOFRAY_INLINE static F32x4 load(const float* from, int n) {
    if (n >= 4) return vld1q_f32(from);
    float32x4_t out = vdupq_n_f32(0);
    if (n > 0) out = vld1q_lane_f32(from, out, 0);
    if (n > 1) out = vld1q_lane_f32(from + 1, out, 1);
    if (n > 2) out = vld1q_lane_f32(from + 2, out, 2);
    return out;
  }
  TOFRAY_INLINE static F32x4 load_square(const float* from, int) { return vld1q_f32(from); }
  TOFRAY_INLINE static I32x4 load_int(const std::int32_t* from, int n) {
    if (n >= 4) return vld1q_s32(from);
    int32x4_t out = vdupq_n_s32(0);
    if (n > 0) out = vld1q_lane_s32(from, out, 0);
    if (n > 1) out = vld1q_lane_s32(from + 1, out, 1);
    if (n > 2) out = vld1q_lane_s32(from + 2, out, 2);
    return out;
  }
};
TOFRAY_INLINE void store_square(float* to, int, F32x4 a) { vst1q_f32(to, a.v); }
TOFRAY_INLINE void store(float* to, F32x4 a, int n) {
  if (n >= 4) return vst1q_f32(to, a.v);
  if (n > 0) vst1q_lane_f32(to, a.v, 0);
  if (n > 1) vst1q_lane_f32(to + 1, a.v, 1);
  if (n > 2) vst1q_lane_f32(to + 2, a.v, 2);
}
TOFRAY_INLINE void store(std::int32_t* to, I32x4 a, int n) {
  if (n >= 4) return vst1q_s32(to, a.v);
  if (n > 0) vst1q_lane_s32(to, a.v, 0);
  if (n > 1) vst1q_lane_s32(to + 1, a.v, 1);
  if (n > 2) vst1q_lane_s32(to + 2, a.v, 2);
}
TOFRAY_INLINE void store(std::uint16_t* to, I32x4 a, int n) {
  const uint16x4_t narrow = vmovn_u32(vreinterpretq_u32_s32(a.v));
  if (n >= 4) return vst1_u16(to, narrow);
  if (n > 0) vst1_lane_u16(to, narrow, 0);
  if (n > 1) vst1_lane_u16(to + 1, narrow, 1);
  if (n > 2) vst1_lane_u16(to + 2, narrow, 2);
}
TOFRAY_INLINE void store(std::uint8_t* to, I32x4 a, int n) {
  const uint16x4_t half = vmovn_u32(vreinterpretq_u32_s32(a.v));
  const uint8x8_t narrow = vmovn_u16(vcombine_u16(half, half));
  if (n > 0) vst1_lane_u8(to, narrow, 0);
  if (n > 1) vst1_lane_u8(to + 1, narrow, 1);
  if (n > 2) vst1_lane_u8(to + 2, narrow, 2);
  if (n > 3) vst1_lane_u8(to + 3, narrow, 3);
}
TOFRAY_INLINE void store2(float* to, F32x4 x, F32x4 y, int n) {
  const float32x4x2_t pairs = {{x.v, y.v}};
  if (n >= 4) return vst2q_f32(to, pairs);
  if (n > 0) vst2q_lane_f32(to, pairs, 0);
  if (n > 1) vst2q_lane_f32(to + 2, pairs, 1);
  if (n > 2) vst2q_lane_f32(to + 4, pairs, 2);
}
TOFRAY_INLINE void store3(float* to, F32x4 x, F32x4 y, F32x4 z, int n) {
  const float32x4x3_t points = {{x.v, y.v, z.v}};
  if (n >= 4) return vst3q_f32(to, points);
  if (n > 0) vst3q_lane_f32(to, points, 0);
  if (n > 1) vst3q_lane_f32(to + 3, points, 1);
  if (n > 2) vst3q_lane_f32(to + 6, points, 2);
}

}  // namespace tofray::num
