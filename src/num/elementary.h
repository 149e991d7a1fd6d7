// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/num.h"

/// Elementary functions in single precision for every number type: sums and fused products only, so the same bits everywhere.
/// The coefficients are minimax fits of our own (relative error of the polynomial in front of each).
namespace tofray::num {

/// Whole turns taken off: t − round(t), in [−½, ½].
template <class F>
TOFRAY_INLINE F wrap_turns(F t) {
  return t - round_even(t);
}

/// sin and cos of 2πt for an angle t in turns, |t| < 2^21. Fits on |t| <= 1/8: 3.2e-9 and 5.4e-11.
template <class F>
TOFRAY_INLINE void sincos_turns(F t, F& sine, F& cosine) {
  const F quarter = round_even(t * F(4.0f));
  const F r = fma(quarter, F(-0.25f), t);
  const F u = r * r;
  const F s = r * fma(u, fma(u, fma(u, F(-75.3935623f), F(81.5923538f)), F(-41.3416634f)), F(6.28318548f));
  const F c = fma(u, fma(u, fma(u, fma(u, F(59.2459602f), F(-85.4437408f)), F(64.9393234f)), F(-19.7392082f)), F(1.0f));
  // Quarter turns swap the two and change signs: bit 0 swaps, bit 1 turns round.
  const Int<F> q = to_int(quarter);
  const auto swap = (q & Int<F>(1)) != Int<F>(0);
  const Uint<F> turned = to_uint(q & Int<F>(2)) << 30;
  const Uint<F> turned_cosine = to_uint((q + Int<F>(1)) & Int<F>(2)) << 30;
  sine = from_bits(bits(select(swap, c, s)) ^ turned);
  cosine = from_bits(bits(select(swap, s, c)) ^ turned_cosine);
}

/// atan(t)/t in turns, of t² in [0, 1]. Fit of atan: 1.5e-8.
template <class F>
TOFRAY_INLINE F atan_share(F u) {
  F p = fma(u, F(0.000453568035f), F(-0.0025573778f));
  p = fma(u, p, F(0.00679452764f));
  p = fma(u, p, F(-0.0119434232f));
  p = fma(u, p, F(0.0169355571f));
  p = fma(u, p, F(-0.0226057991f));
  p = fma(u, p, F(0.031819243f));
  p = fma(u, p, F(-0.0530512333f));
  return fma(u, p, F(0.159154937f));
}

/// Angle of the vector (x, y) in turns, in [−½, ½]; 0 for the zero vector.
template <class F>
TOFRAY_INLINE F atan2_turns(F y, F x) {
  const F ax = abs(x), ay = abs(y);
  const F longer = max(ax, ay), shorter = min(ax, ay);
  const F t = shorter / select(longer > F(0.0f), longer, F(1.0f));
  F p = t * atan_share(t * t);
  p = select(ay > ax, F(0.25f) - p, p);
  p = select(x < F(0.0f), F(0.5f) - p, p);
  return copy_sign(p, y);
}

/// 1/√x to 4e-7, where the root is at hand. By multiplications, because a processor's divider, which finds roots, too, is slow; a guess from the
/// exponent and two steps of Newton's, whose numbers are a fit (1.8e-7 before rounding).
template <class F>
TOFRAY_INLINE F inverse_root(F x, F root) {
  const F guess = from_bits(to_uint(Int<F>(0x5f375ee0) - to_signed(bits(x) >> 1)));
  const F nearer = guess * fnma(root, guess, F(2.0005984f));
  return nearer * fnma(root, nearer, F(2.0000002f));
}

/// Natural logarithm of a normal number > 0. Fit of log(1+f) on [√½−1, √2−1]: 3.1e-8.
template <class F>
TOFRAY_INLINE F log(F a) {
  // a = m·2^e with m in [√½, √2)
  const Int<F> shifted = to_signed((bits(a) + Uint<F>(0x3f800000u - 0x3f3504f3u)) >> 23) - Int<F>(127);
  const F f = from_bits(bits(a) + (to_uint(Int<F>(0) - shifted) << 23)) - F(1.0f);
  const F e = to_float(shifted);
  F p = fma(f, F(0.0870035961f), F(-0.142674759f));
  p = fma(f, p, F(0.149147868f));
  p = fma(f, p, F(-0.165775865f));
  p = fma(f, p, F(0.199630618f));
  p = fma(f, p, F(-0.250013381f));
  p = fma(f, p, F(0.333339095f));
  const F ff = f * f;
  p = fma(p * f, ff, fma(ff, F(-0.5f), f));
  return fma(e, F(0.693147182f), p);
}

/// 2^a; 0 below −126, the largest power above 127. Fit on [−½, ½]: 2.0e-9.
template <class F>
TOFRAY_INLINE F exp2(F a) {
  const F held = min(max(a, F(-126.0f)), F(127.0f));
  const F whole = round_even(held);
  const F r = held - whole;
  F p = fma(r, F(0.000153533605f), F(0.0013398875f));
  p = fma(r, p, F(0.00961843692f));
  p = fma(r, p, F(0.0555033237f));
  p = fma(r, p, F(0.240226477f));
  p = fma(r, p, F(0.693147182f));
  p = fma(r, p, F(1.0f));
  const F scale = from_bits(to_uint(to_int(whole) + Int<F>(127)) << 23);
  return select(a < F(-126.0f), F(0.0f), p * scale);
}

template <class F>
TOFRAY_INLINE F exp(F a) {
  return exp2(a * F(1.44269502f));
}

/// base^exponent for base in [0, 1] and exponent >= 0 (0^0 = 1).
template <class F>
TOFRAY_INLINE F power(F base, F exponent) {
  const F held = max(base, F(1.1754944e-38f));
  return select(exponent == F(0.0f), F(1.0f), select(base > F(0.0f), exp2(exponent * (log(held) * F(1.44269502f))), F(0.0f)));
}

}  // namespace tofray::num
