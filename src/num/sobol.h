// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/num.h"

/// Points that fill the unit square evenly, however many of them are taken: the first two coordinates of Sobol's sequence, scrambled as Owen
/// (1995) has it. Each point depends on its number and on seeds alone.                                 [theory: sobol-pairs]
namespace tofray::num {

/// A random permutation in which each bit is turned over, or not, by what stands below it: of the reversed word, so that halves of the unit
/// interval change places, then halves of those … (Laine and Karras 2011; Burley 2020).
template <class F>
TOFRAY_INLINE Uint<F> turned_over(Uint<F> a, Uint<F> seed) {
  a = a + seed;
  a = a ^ (a * Uint<F>(0x6c50b47cu));
  a = a ^ (a * Uint<F>(0xb82f1e52u));
  a = a ^ (a * Uint<F>(0xc7afe638u));
  a = a ^ (a * Uint<F>(0x8d22f6e6u));
  return a;
}

/// Pascal's triangle, modulo 2, times the word's bits: the second of Sobol's coordinates is the first one of what comes of it.
template <class F>
TOFRAY_INLINE Uint<F> pascal(Uint<F> a) {
  const auto added = [](Uint<F> x, int n, std::uint32_t mask) TOFRAY_LAMBDA { return x ^ ((x >> n) & Uint<F>(mask)); };
  a = added(a, 1, 0x55555555u), a = added(a, 2, 0x33333333u), a = added(a, 4, 0x0f0f0f0fu), a = added(a, 8, 0x00ff00ffu);
  return added(a, 16, 0x0000ffffu);
}

/// In [0, 1): the upper 24 bits.
template <class F>
TOFRAY_INLINE F unit(Uint<F> word) {
  return to_float(to_signed(word >> 8)) * F(0x1p-24f);
}

/// Where in the sequence number `index` is once it is shuffled: numbers 0 to 2ⁿ − 1 stay together.
template <class F>
TOFRAY_INLINE Uint<F> shuffled(Uint<F> index, Uint<F> seed) {
  return reversed(turned_over<F>(reversed(index), seed));
}

/// @param shuffled  number of the point
/// @param seeds     of its two coordinates
template <class F>
TOFRAY_INLINE void sobol_pair(Uint<F> shuffled, Uint<F> seed_u, Uint<F> seed_v, F& u, F& v) {
  // A coordinate is the reversed word; scrambling starts at its upper end, which is the word's lower one.
  u = unit<F>(reversed(turned_over<F>(shuffled, seed_u)));
  v = unit<F>(reversed(turned_over<F>(pascal<F>(shuffled), seed_v)));
}

}  // namespace tofray::num
