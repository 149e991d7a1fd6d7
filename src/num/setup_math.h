// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

/// Elementary functions in double precision for everything that is computed once: lens tables, waveforms, spectra, scene transforms.
///
/// The C library's sin, exp, … differ in their last bits from machine to machine. These use + - * /, sqrt and fma only, all of which
/// IEEE 754 defines to the last bit, so that they give the same bits with every compiler and CPU (build with -ffp-contract=off, round to
/// nearest). Errors stay below 1 ulp (erfc: 1e-14 relative). Method: argument reduction in two-word arithmetic, then a short Taylor series.
namespace tofray::num::setup {

namespace detail {

/// An unevaluated sum hi + lo with |lo| <= ulp(hi)/2: about 106 bits.
struct Pair {
  double hi = 0, lo = 0;
};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Pair pi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr Pair half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/// a + b exactly, for any a and b (Knuth's two-sum).
inline Pair two_sum(double a, double b) {
  const double s = a + b;
  const double t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

/// a + b exactly, for |a| >= |b|.
inline Pair fast_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

/// a · b exactly.
inline Pair two_product(double a, double b) {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

inline Pair add(Pair a, Pair b) {
  const Pair s = two_sum(a.hi, b.hi);
  return fast_two_sum(s.hi, s.lo + (a.lo + b.lo));
}

inline Pair multiply(Pair a, Pair b) {
  const Pair p = two_product(a.hi, b.hi);
  return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

inline Pair divide(Pair a, Pair b) {
  const double q = a.hi / b.hi;
  const double rest = std::fma(-q, b.hi, a.hi) + (a.lo - q * b.lo);
  return fast_two_sum(q, rest / b.hi);
}

/// Square root of a > 0 by one Newton step upon the rounded root.
inline Pair square_root(Pair a) {
  const double r = std::sqrt(a.hi);
  return fast_two_sum(r, (std::fma(-r, r, a.hi) + a.lo) / (2.0 * r));
}

/// 2^n for −1022 <= n <= 1023.
inline double power_of_two(int n) {
  const std::uint64_t bits = static_cast<std::uint64_t>(n + 1023) << 52;
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// x · 2^n, |n| <= 2100, with one rounding where the result is subnormal and comes from a value of at least 2^−1022.
inline double scale(double x, int n) {
  while (n > 1023) {
    x *= power_of_two(1023);
    n -= 1023;
  }
  while (n < -1022) {
    x *= power_of_two(-960);
    n += 960;
  }  // not −1022: only the last step may go below the normal range
  return x * power_of_two(n);
}

/// Exponent e and mantissa m in [1, 2) of a finite x > 0 = m · 2^e.
inline int split(double x, double& mantissa) {
  int shift = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= power_of_two(54);
    shift = -54;
  }
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  const int exponent = static_cast<int>(bits >> 52) - 1023;
  bits = (bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL;
  std::memcpy(&mantissa, &bits, sizeof mantissa);
  return exponent + shift;
}

/// x = quadrant · π/2 + rest, |rest| <= π/4 (a little more where the rounding of x · 2/π decides the other way).
struct Reduced {
  int quadrant = 0;  ///< 0…3
  Pair rest;
};

/// Cody–Waite reduction; π/2 in three words of 53 bits, every product exact as a pair.
inline Reduced reduce(double x) {
  constexpr double words[3] = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54, -0x1.f1976b7ed8fbcp-110};
  const double n = std::floor(x * 0x1.45f306dc9c883p-1 + 0.5);
  if (n == 0) return {0, {x, 0.0}};
  const Pair p = two_product(n, words[0]);
  const Pair q = two_product(n, words[1]);
  // The first difference is exact (the two are alike), the following ones are carried with their rounding errors.
  const Pair a = two_sum(x - p.hi, -p.lo);
  const Pair b = two_sum(a.hi, -q.hi);
  const double tail = (a.lo + b.lo) - q.lo - n * words[2];
  return {static_cast<int>(static_cast<std::int64_t>(n) & 3), fast_two_sum(b.hi, tail)};
}

/// sin(r), |r| <= 0.8.
inline Pair sin_series(Pair r) {
  constexpr double c[] = {
      -1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800, 1.0 / 6227020800.0, -1.0 / 1307674368000.0, 1.0 / 355687428096000.0};
  const double z = r.hi * r.hi;
  double sum = c[7];
  for (int k = 6; k >= 0; --k) sum = sum * z + c[k];
  return fast_two_sum(r.hi, r.lo * (1.0 - 0.5 * z) + r.hi * z * sum);
}

/// cos(r), |r| <= 0.8.
inline Pair cos_series(Pair r) {
  constexpr double c[] = {1.0 / 24,
                          -1.0 / 720,
                          1.0 / 40320,
                          -1.0 / 3628800,
                          1.0 / 479001600.0,
                          -1.0 / 87178291200.0,
                          1.0 / 20922789888000.0,
                          -1.0 / 6402373705728000.0};
  const Pair z = two_product(r.hi, r.hi);
  double sum = c[7];
  for (int k = 6; k >= 0; --k) sum = sum * z.hi + c[k];
  const Pair w = fast_two_sum(1.0, -0.5 * z.hi);
  return fast_two_sum(w.hi, w.lo - (0.5 * z.lo + r.hi * r.lo) + z.hi * z.hi * sum);
}

/// Arguments beyond this have no use here, and their reduction would lack bits.
constexpr double largest_angle = 1e9;

/// sin(x + shift · π/2) as a pair.
inline Pair sine(Reduced x, int shift) {
  const int quadrant = (x.quadrant + shift) & 3;
  const Pair value = (quadrant & 1) ? cos_series(x.rest) : sin_series(x.rest);
  return (quadrant & 2) ? Pair{-value.hi, -value.lo} : value;
}

/// atan(y/x) for 0 <= y <= x, both of moderate size.
///
/// The quotient's nearest eighth c is taken off by atan(y/x) = atan c + atan((y − cx)/(x + cy)); the rest is below 1/16.
inline Pair atan_of_ratio(Pair y, Pair x) {
  constexpr Pair atan_of_eighths[] = {
      {0.0, 0.0},
      {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
      {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
      {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
      {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
      {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
      {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
      {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
      {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
  };
  const int k = static_cast<int>(8.0 * (y.hi / x.hi) + 0.5);
  const Pair c{0.125 * k, 0.0};
  const Pair minus_c{-c.hi, 0.0};
  const Pair t = k == 0 ? divide(y, x) : divide(add(y, multiply(minus_c, x)), add(x, multiply(c, y)));
  const double z = t.hi * t.hi;
  double sum = 1.0 / 17;
  for (int n = 15; n >= 3; n -= 2) sum = (n & 2 ? -1.0 : 1.0) / n + z * sum;
  return add(atan_of_eighths[k], fast_two_sum(t.hi, t.lo + t.hi * z * sum));
}

/// Angle of the point (x, y), x and y not negative, not both zero, finite.
inline Pair first_quadrant(Pair y, Pair x) {
  const bool steep = y.hi > x.hi;
  const Pair small = steep ? x : y;
  const Pair large = steep ? y : x;
  const double ratio = small.hi / large.hi;
  // So flat that atan(t) = t to all bits; also keeps subnormal numbers out of the series.
  Pair angle{ratio, 0.0};
  if (ratio > 0x1p-60) {
    double mantissa;
    const double unit = power_of_two(-split(large.hi, mantissa) / 2);
    angle = atan_of_ratio({small.hi * unit * unit, small.lo * unit * unit}, {large.hi * unit * unit, large.lo * unit * unit});
  }
  return steep ? add(half_pi, {-angle.hi, -angle.lo}) : angle;
}

/// e^(x.hi + x.lo)
inline double exp_of(Pair x) {
  constexpr double ln2[3] = {0x1.62e42fefa4000p-1, -0x1.8432a1b0e2000p-43, -0x1.8cff81a12a17ep-85};
  if (x.hi > 800.0) return infinity;
  if (x.hi < -800.0) return 0.0;
  // x = n ln 2 + r; the first two words of ln 2 have 40 bits, so that their products with n are exact.
  const double n = std::floor(x.hi * 0x1.71547652b82fep+0 + 0.5);
  const Pair a = two_sum(x.hi - n * ln2[0], -n * ln2[1]);
  const Pair r = fast_two_sum(a.hi, a.lo + (x.lo - n * ln2[2]));
  double factorial = 87178291200.0;  // 14!
  double sum = 1.0 / factorial;
  for (int k = 14; k >= 3; --k) {
    factorial /= k;
    sum = sum * r.hi + 1.0 / factorial;
  }
  const Pair one_plus_r = fast_two_sum(1.0, r.hi);
  const double value = one_plus_r.hi + (one_plus_r.lo + r.lo * one_plus_r.hi + r.hi * r.hi * sum);
  return scale(value, static_cast<int>(n));
}

/// ln x = e ln 2 + 2 atanh((m − 1)/(m + 1)) for a finite x > 0, to some 90 bits.
inline Pair log_of(double x) {
  constexpr Pair ln2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
  double m;
  int exponent = split(x, m);
  if (m > 0x1.6a09e667f3bcdp+0) {
    m *= 0.5;
    ++exponent;
  }
  const Pair s = divide({m - 1.0, 0.0}, two_sum(m, 1.0));
  const Pair z = multiply(s, s);
  Pair sum{0.0, 0.0};
  for (int n = 39; n >= 3; n -= 2) sum = multiply(z, add(sum, divide({1.0, 0.0}, {static_cast<double>(n), 0.0})));
  const Pair half = multiply(s, add({1.0, 0.0}, sum));
  return add(multiply({static_cast<double>(exponent), 0.0}, ln2), {2.0 * half.hi, 2.0 * half.lo});
}

}  // namespace detail

/// @param x [rad] −1e9…1e9; NaN beyond
inline double sin(double x) {
  if (!(std::fabs(x) <= detail::largest_angle)) return detail::nan;
  return x == 0 ? x : detail::sine(detail::reduce(x), 0).hi;
}

/// @param x [rad] −1e9…1e9; NaN beyond
inline double cos(double x) {
  if (!(std::fabs(x) <= detail::largest_angle)) return detail::nan;
  return detail::sine(detail::reduce(x), 1).hi;
}

/// @param x [rad] −1e9…1e9; NaN beyond
inline double tan(double x) {
  if (!(std::fabs(x) <= detail::largest_angle)) return detail::nan;
  if (x == 0) return x;
  const detail::Reduced r = detail::reduce(x);
  return detail::divide(detail::sine(r, 0), detail::sine(r, 1)).hi;
}

/// Angle of the point (x, y) [rad], −π…π; signs of zeros and infinities as in ISO C.
inline double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return detail::nan;
  double ay = std::fabs(y), ax = std::fabs(x);
  if (std::isinf(ay) || std::isinf(ax)) {
    ay = std::isinf(ay) ? 1 : 0;
    ax = std::isinf(ax) ? 1 : 0;
  }
  detail::Pair angle{0.0, 0.0};
  if (ay > 0) angle = detail::first_quadrant({ay, 0.0}, {ax, 0.0});
  if (std::signbit(x)) angle = detail::add(detail::pi, {-angle.hi, -angle.lo});
  return std::copysign(angle.hi, y);
}

/// @return [rad] −π/2…π/2
inline double atan(double x) { return atan2(x, 1.0); }

namespace detail {
/// √(1 − x²), |x| < 1.
inline Pair cathetus(double x) {
  const Pair square = two_product(x, x);
  const Pair rest = two_sum(1.0, -square.hi);
  return square_root(fast_two_sum(rest.hi, rest.lo - square.lo));
}
}  // namespace detail

/// @return [rad] −π/2…π/2; NaN for |x| > 1
inline double asin(double x) {
  const double a = std::fabs(x);
  if (!(a <= 1)) return detail::nan;
  if (a == 1) return std::copysign(detail::half_pi.hi, x);
  if (a < 0x1p-30) return x;
  return std::copysign(detail::first_quadrant({a, 0.0}, detail::cathetus(x)).hi, x);
}

/// @return [rad] 0…π; NaN for |x| > 1
inline double acos(double x) {
  const double a = std::fabs(x);
  if (!(a <= 1)) return detail::nan;
  if (a == 1) return x > 0 ? 0.0 : detail::pi.hi;
  detail::Pair angle = detail::first_quadrant(detail::cathetus(x), {a, 0.0});
  if (x < 0) angle = detail::add(detail::pi, {-angle.hi, -angle.lo});
  return angle.hi;
}

/// e^x; infinity above 709.78, 0 below −745.13
inline double exp(double x) { return std::isnan(x) ? detail::nan : detail::exp_of({x, 0.0}); }

/// Natural logarithm; −infinity at 0, NaN below
inline double log(double x) {
  if (!(x >= 0)) return detail::nan;
  if (x == 0) return -detail::infinity;
  return std::isinf(x) ? x : detail::log_of(x).hi;
}

/// x^y; special values as in ISO C.
inline double pow(double x, double y) {
  if (y == 0 || x == 1) return 1.0;
  if (std::isnan(x) || std::isnan(y)) return detail::nan;
  const double a = std::fabs(x);
  const bool whole = std::floor(y) == y;  // infinities, too
  const bool odd = whole && std::fabs(y) < 0x1p53 && std::floor(0.5 * y) != 0.5 * y;
  if (x < 0 && !whole) return std::isinf(x) ? (y > 0 ? detail::infinity : 0.0) : detail::nan;
  double value;
  if (a == 1)
    value = 1.0;
  else if (std::isinf(y))
    value = (a > 1) == (y > 0) ? detail::infinity : 0.0;
  else if (a == 0 || std::isinf(a))
    value = (a == 0) == (y < 0) ? detail::infinity : 0.0;
  else {
    // |y ln a| > 800 over- or underflows whatever its last bits; it must not overflow itself on the way.
    const detail::Pair l = detail::log_of(a);
    const double rough = l.hi * y;
    value = std::fabs(rough) > 800.0 ? (rough > 0 ? detail::infinity : 0.0) : detail::exp_of(detail::multiply(l, {y, 0.0}));
  }
  return odd && std::signbit(x) ? -value : value;
}

/// √(x² + y²) without overflow or underflow on the way.
inline double hypot(double x, double y) {
  double a = std::fabs(x), b = std::fabs(y);
  if (std::isinf(a) || std::isinf(b)) return detail::infinity;
  if (std::isnan(a) || std::isnan(b)) return detail::nan;
  if (a < b) {
    const double c = a;
    a = b;
    b = c;
  }
  if (b == 0) return a;
  double mantissa;
  const int exponent = detail::split(a, mantissa);
  a = detail::scale(a, -exponent);
  b = detail::scale(b, -exponent);
  return detail::scale(detail::square_root(detail::add(detail::two_product(a, a), detail::two_product(b, b))).hi, exponent);
}

/// Complementary error function, 2/√π ∫_x^∞ e^(−t²) dt, to 1e-14 relative down to the smallest normal result.
///
/// Below 0.5 the Taylor series of erf. Above, the trapezoidal rule of step h on the integral
/// erfc x = (x e^(−x²)/π) ∫ e^(−t²)/(t² + x²) dt, whose error falls as e^(−π²/h²) once the pole t = ix is accounted for
/// by −2/(e^(2πx/h) − 1).
inline double erfc(double x) {
  if (std::isnan(x)) return detail::nan;
  if (x < 0) return 2.0 - erfc(-x);
  if (x > 27) return 0.0;
  if (x < 0.5) {
    double sum = 0, term = 1;  // term: (−x²)^n/n!
    const double z = -x * x;
    for (int n = 0; n < 16; ++n) {
      sum += term / (2 * n + 1);
      term *= z / (n + 1);
    }
    return 1.0 - 0x1.20dd750429b6dp+0 * x * sum;
  }
  constexpr double step = 0.4375;
  double sum = 0;
  for (int k = 15; k >= 1; --k) {
    const double t = step * k;
    sum += exp(-t * t) / (t * t + x * x);
  }
  const detail::Pair square = detail::two_product(x, x);
  const double value = detail::exp_of({-square.hi, -square.lo}) * (step / detail::pi.hi) * (1.0 / x + 2.0 * x * sum);
  const double period = detail::pi.hi / step;
  return x < period ? value - 2.0 / (exp(2.0 * period * x) - 1.0) : value;
}

}  // namespace tofray::num::setup
