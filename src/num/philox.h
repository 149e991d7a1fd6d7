// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/elementary.h"

/// Counter-based random numbers: Philox4x32-10 (Salmon et al. 2011). No state and no order: what is drawn depends on key and
/// counter alone, so threads, lanes, tiles and machines do not matter.
namespace tofray::num {

template <class F>
struct Random4 {
  Uint<F> w[4];
};

/// A key's ten round keys: both halves grow by Weyl's constants.
struct RoundKeys {
  std::uint32_t k0[10], k1[10];
  bool operator==(const RoundKeys&) const = default;
};
TOFRAY_INLINE RoundKeys round_keys(std::uint32_t k0, std::uint32_t k1) {
  RoundKeys keys{};
  for (std::uint32_t i = 0; i < 10; ++i) keys.k0[i] = k0 + i * 0x9E3779B9u, keys.k1[i] = k1 + i * 0xBB67AE85u;
  return keys;
}

/// One block of four words for a counter (c0…c3) and a key. Only c0 differs from lane to lane.
template <class F>
TOFRAY_INLINE Random4<F> philox(Uint<F> c0, std::uint32_t c1, std::uint32_t c2, std::uint32_t c3, const RoundKeys& keys) {
  constexpr std::uint32_t m0 = 0xD2511F53u, m1 = 0xCD9E8D57u;
  // As long as words are the same in every lane, so are their products: the first round's second one and the second round's first.
  std::uint32_t high, low;
  multiply_wide(c2, m1, high, low);
  const std::uint32_t w0 = high ^ c1 ^ keys.k0[0], w1 = low;
  multiply_wide(w0, m0, high, low);
  Uint<F> high0, low0, high1, low1;
  multiply_wide(c0, Uint<F>(m0), high0, low0);
  multiply_wide(high0 ^ Uint<F>(c3 ^ keys.k1[0]), Uint<F>(m1), high1, low1);
  Random4<F> r{{high1 ^ Uint<F>(w1 ^ keys.k0[1]), low1, low0 ^ Uint<F>(high ^ keys.k1[1]), Uint<F>(low)}};
  for (int round = 2; round < 10; ++round) {
    multiply_wide(r.w[0], Uint<F>(m0), high0, low0);
    multiply_wide(r.w[2], Uint<F>(m1), high1, low1);
    r = {{high1 ^ r.w[1] ^ Uint<F>(keys.k0[round]), low1, high0 ^ r.w[3] ^ Uint<F>(keys.k1[round]), low0}};
  }
  return r;
}

/// Uniform in (0, 1): the middle of one of 2^23 equal cells.
template <class F>
TOFRAY_INLINE F uniform(Uint<F> word) {
  return fma(to_float(to_signed(word >> 9)), F(0x1p-23f), F(0x1p-24f));
}

/// −2·ln u for u = (n + 1)·2^−24, n the upper 24 bits of a word. Fit of −2·ln m on [1, 2): 2.9e-6, absolute, which is what a radius needs.
template <class F>
TOFRAY_INLINE F minus_two_log(Uint<F> word) {
  const Uint<F> u = bits(to_float(to_signed((word >> 8) + Uint<F>(1u))));
  const F octave = to_float(to_signed(u >> 23) - Int<F>(127 + 24));
  const F t = from_bits((u & Uint<F>(0x007fffffu)) | Uint<F>(0x3f800000u)) - F(1.0f);
  F p = fma(t, F(0.0366772562f), F(-0.171138465f));
  p = fma(t, p, F(0.387520343f));
  p = fma(t, p, F(-0.635297358f));
  p = fma(t, p, F(0.99574995f));
  p = fma(t, p, F(-1.9998033f));
  return max(fma(t, p, octave * F(-1.38629436f)), F(0.0f));
}

/// Two independent standard normals from two words (Box and Muller 1958): radius from the upper 24 bits of one, angle from a half
/// (the upper bit of the other) and a place in it (the rest). |z| <= 5.8.
template <class F>
TOFRAY_INLINE void normal_pair(Uint<F> radius_word, Uint<F> angle_word, F& first, F& second) {
  const F radius = sqrt(minus_two_log<F>(radius_word));
  // r in [−1/4, 1/4) turns, and half a turn or none; fits of sine (3.3e-9) and cosine (4.7e-8)
  const F r = to_float(to_signed(angle_word << 1)) * F(0x1p-33f);
  const F v = r * r;
  const F s = r * fma(v, fma(v, fma(v, fma(v, F(39.536705f), F(-76.54978f)), F(81.601006f)), F(-41.341656f)), F(6.283185f));
  const F c = fma(v, fma(v, fma(v, fma(v, F(56.242382f), F(-85.24033f)), F(64.93459f)), F(-19.739172f)), F(0.99999994f));
  const F turned = from_bits(bits(radius) ^ (angle_word & Uint<F>(0x80000000u)));
  first = turned * c, second = turned * s;
}

}  // namespace tofray::num
