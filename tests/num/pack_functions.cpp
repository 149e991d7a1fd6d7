// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set; like the kernels it includes nothing that leaves a shared inline function behind.
#if defined(PACK_AVX512)
#include "num/avx512.h"
#define PACK_FUNCTIONS pack_functions_avx512
using F = tofray::num::F32x16;
#elif defined(PACK_AVX2)
#include "num/avx2.h"
#define PACK_FUNCTIONS pack_functions_avx2
using F = tofray::num::F32x8;
#elif defined(PACK_NEON)
#include "num/neon.h"
#include "num/twin.h"
#define PACK_FUNCTIONS pack_functions_neon
using F = tofray::num::Twin<tofray::num::F32x4>;
#elif defined(PACK_SCALAR_FMA)
#define PACK_FUNCTIONS pack_functions_scalar_fma
using F = float;
#else
#define PACK_FUNCTIONS pack_functions_scalar
using F = float;
#endif

#include "num/pack_functions.h"
#include "raw/poisson.h"

namespace {

using namespace tofray;
using I = num::Int<F>;
using U = num::Uint<F>;
using M = num::Mask<F>;
constexpr int lanes = num::lanes<F>;

/// One pack's worth of arguments and where its results go.
struct At {
  const PackBlock& block;
  int i;
  TOFRAY_INLINE static F real(const std::uint32_t* from) {
    std::int32_t words[lanes];
    for (int k = 0; k < lanes; ++k) words[k] = static_cast<std::int32_t>(from[k]);
    return num::from_bits(num::to_uint(num::load_int<F>(words, lanes)));
  }
  TOFRAY_INLINE static I whole(const std::uint32_t* from) { return num::to_signed(num::bits(real(from))); }
  TOFRAY_INLINE F a() const { return real(block.a + i); }
  TOFRAY_INLINE F b() const { return real(block.b + i); }
  TOFRAY_INLINE F c() const { return real(block.c + i); }
  TOFRAY_INLINE I ia() const { return whole(block.a + i); }
  TOFRAY_INLINE I ib() const { return whole(block.b + i); }
  TOFRAY_INLINE U ua() const { return num::to_uint(ia()); }
  TOFRAY_INLINE U ub() const { return num::to_uint(ib()); }
  TOFRAY_INLINE U uc() const { return num::bits(c()); }
  TOFRAY_INLINE void put(I value, int row = 0) const {
    std::int32_t words[lanes];
    num::store(words, value, lanes);
    for (int k = 0; k < lanes; ++k) block.out[row * pack_block + i + k] = static_cast<std::uint32_t>(words[k]);
  }
  TOFRAY_INLINE void put(U value, int row = 0) const { put(num::to_signed(value), row); }
  TOFRAY_INLINE void put(F value, int row = 0) const { put(num::bits(value), row); }
  TOFRAY_INLINE void put(M value, int row = 0) const { put(num::select(value, I(1), I(0)), row); }
};

template <class Function>
TOFRAY_INLINE bool each(const PackBlock& block, Function function) {
  for (int i = 0; i < pack_block; i += lanes) function(At{block, i});
  return true;
}

#define EACH(...) \
  return each(    \
      block, [](const At& at) __attribute__((always_inline)) { __VA_ARGS__; })

TOFRAY_INLINE bool arithmetic(int which, const PackBlock& block) {
  switch (which) {
    case 0: EACH(at.put(at.a() + at.b()));
    case 1: EACH(at.put(at.a() - at.b()));
    case 2: EACH(at.put(at.a() * at.b()));
    case 3: EACH(at.put(at.a() / at.b()));
    case 4: EACH(at.put(-at.a()));
    case 5:
      EACH(at.put(num::fma(at.a(), at.b(), at.c())); at.put(num::fnma(at.a(), at.b(), at.c()), 1);
           at.put(num::fms(at.a(), at.b(), at.c()), 2));
    case 6: EACH(at.put(num::sqrt(at.a())));
    case 7: EACH(at.put(num::min(at.a(), at.b())));
    case 8: EACH(at.put(num::max(at.a(), at.b())));
    case 9: EACH(at.put(num::floor(at.a())));
    case 10: EACH(at.put(num::round_even(at.a())));
    case 11: EACH(at.put(num::abs(at.a())));
    case 12: EACH(at.put(num::copy_sign(at.a(), at.b())));
    case 13: EACH(at.put(at.a() < at.b()); at.put(at.a() <= at.b(), 1); at.put(at.a() > at.b(), 2); at.put(at.a() >= at.b(), 3));
    case 14: EACH(at.put(at.a() == at.b()); at.put(at.a() != at.b(), 1));
    case 15: EACH(const M m = at.a() < at.b(); const M n = at.b() < at.c(); at.put(m & n); at.put(m | n, 1); at.put(!m, 2));
    case 16:
      EACH(at.put(num::select(at.a() < at.b(), at.b(), at.c())); at.put(num::select(at.a() < at.b(), at.ib(), at.ia()), 1);
           at.put(num::select(at.a() < at.b(), at.ub(), at.uc()), 2));
    default: return false;
  }
}

TOFRAY_INLINE bool whole_numbers(int which, const PackBlock& block) {
  switch (which) {
    case 0: EACH(at.put(at.ua() + at.ub()); at.put(at.ua() & at.ub(), 1); at.put(at.ua() | at.ub(), 2); at.put(at.ua() ^ at.ub(), 3));
    case 1: EACH(at.put(at.ua() << 1); at.put(at.ua() << 31, 1); at.put(at.ua() >> 9, 2); at.put(at.ua() >> 31, 3));
    case 2: EACH(U high; U low; num::multiply_wide(at.ua(), at.ub(), high, low); at.put(high); at.put(low, 1));
    case 3:
      EACH(const I x = num::to_signed(at.ua() >> 2); const I y = num::to_signed(at.ub() >> 2); at.put(x + y); at.put(x - y, 1);
           at.put(num::to_signed(at.ua() >> 17) * num::to_signed(at.ub() >> 17), 2); at.put(x & y, 3));
    case 4: EACH(at.put(at.ia() == at.ib()); at.put(at.ia() != at.ib(), 1); at.put(at.ia() < at.ib(), 2); at.put(at.ia() > at.ib(), 3));
    case 5: EACH(at.put(at.ia() | at.ib()); at.put(num::to_float(at.ia()), 1));
    // to_int wants an argument that fits
    case 6: EACH(at.put(num::to_int(num::select(num::abs(at.a()) < F(2.1e9f), at.a(), F(1.5f)))));
    case 7:
      return each(
          block, [&](const At& at) __attribute__((always_inline)) {
            const I index = num::to_signed(at.ua() >> 22);
            at.put(num::gather(block.table, index));
            at.put(num::gather(reinterpret_cast<const std::int32_t*>(block.table), index), 1);
            F first, second;
            num::gather_pair(block.table, num::to_signed(at.ua() >> 23), first, second);
            at.put(first, 2);
            at.put(second, 3);
          });
    case 8:
      return each(
          block, [&](const At& at) __attribute__((always_inline)) {
            const num::Four<F> four = num::gather_four(block.table, num::to_signed(at.ua() >> 24));
            for (int k = 0; k < 4; ++k) at.put(four.value[k], k);
          });
    case 9: EACH(at.put(num::reversed(at.ua())); at.put(num::reversed(num::reversed(at.ub())), 1));
    default: return false;
  }
}

TOFRAY_INLINE bool elementary(int which, const PackBlock& block) {
  switch (which) {
    case 0:
      EACH(const F t = num::select(num::abs(at.a()) < F(0x1p21f), at.a(), F(0.3f)); F s; F c; num::sincos_turns(t, s, c); at.put(s);
           at.put(c, 1); at.put(num::wrap_turns(at.a()), 2));
    case 1: EACH(at.put(num::atan2_turns(at.a(), at.b())));
    case 2: EACH(at.put(num::log(num::abs(at.a()))));
    case 3: EACH(at.put(num::exp2(at.a())); at.put(num::exp(at.a()), 1));
    case 4: EACH(at.put(num::power(num::min(num::abs(at.a()), F(1.0f)), num::abs(at.b()))));
    case 5:
      return each(
          block, [&](const At& at) __attribute__((always_inline)) {
            const auto r = num::philox<F>(at.ua(), block.b[0], block.b[1], block.b[2], num::round_keys(block.c[0], block.c[1]));
            for (int k = 0; k < 4; ++k) at.put(r.w[k], k);
          });
    case 6: EACH(F x; F y; num::normal_pair<F>(at.ua(), at.ub(), x, y); at.put(x); at.put(y, 1); at.put(num::uniform<F>(at.ua()), 2));
    case 7: EACH(at.put(raw::poisson_by_inversion<F>(num::uniform<F>(at.ua()) * F(16.0f), num::uniform<F>(at.ub()))));
    case 8: EACH(at.put(raw::poisson_by_expansion<F>(num::abs(at.a()), num::uniform<F>(at.ub()) * F(12.0f) - F(6.0f))));
    default: return false;
  }
}

/// Calls `part` for each number n of lanes, with where to say which bits are wrong.
template <class Part>
TOFRAY_INLINE bool each_part(const PackBlock& block, const Part& part) {
  return each(
      block, [&](const At& at) __attribute__((always_inline)) {
        for (int n = 1; n <= lanes; ++n) part(at, n, block.out + at.i);
      });
}

/// Which bits are wrong of what was 7 before and is `from` where it is written.
TOFRAY_INLINE std::uint32_t wrong(std::uint32_t got, bool written, std::uint32_t from) { return got ^ (written ? from : 7u); }

/// Whole packs past the caches, between others that stay: no bit is wrong. (A template, since only there `if constexpr` leaves out what a type lacks.)
template <class P>
TOFRAY_INLINE void past_caches(const At& at) {
  alignas(64) float to[3 * num::lanes<P>];
  alignas(64) std::uint16_t halves[3 * num::lanes<P>];
  for (float& one : to) one = num::from_bits(7u);
  for (std::uint16_t& one : halves) one = 7;
  if constexpr (num::can_store_past<P>) {
    num::store_past(to + num::lanes<P>, at.a()), num::store_past(halves + num::lanes<P>, num::to_signed(at.ua() >> 16));
    num::finish_stores<P>();
  } else {
    num::store(to + num::lanes<P>, at.a(), num::lanes<P>);
    num::store(halves + num::lanes<P>, num::to_signed(at.ua() >> 16), num::lanes<P>);
  }
  for (int k = 0; k < 3 * num::lanes<P>; ++k) {
    const int of = k % num::lanes<P>;
    const bool written = k / num::lanes<P> == 1;
    at.block.out[at.i + of] |= wrong(num::bits(to[k]), written, at.block.a[at.i + of]);
    at.block.out[pack_block + at.i + of] |= wrong(halves[k], written, at.block.a[at.i + of] >> 16);
  }
}

/// Parts of a pack: what lies beyond reads as 0 and is not written. No bit is wrong.
TOFRAY_INLINE bool parts(int which, const PackBlock& block) {
  switch (which) {
    case 0:
      return each_part(
          block, [&](const At& at, int n, std::uint32_t* out) __attribute__((always_inline)) {
            float to[lanes], all[lanes], from[lanes];
            for (int k = 0; k < lanes; ++k) from[k] = num::from_bits(block.a[at.i + k]), to[k] = num::from_bits(7u);
            num::store(to, num::load<F>(from, n), n), num::store(all, num::load<F>(from, n), lanes);
            for (int k = 0; k < lanes; ++k) {
              out[k] |= wrong(num::bits(to[k]), k < n, block.a[at.i + k]);
              out[pack_block + k] |= num::bits(all[k]) ^ (k < n ? block.a[at.i + k] : 0u);
            }
          });
    case 1:
      return each_part(
          block, [&](const At& at, int n, std::uint32_t* out) __attribute__((always_inline)) {
            std::int32_t to[lanes], all[lanes], from[lanes];
            for (int k = 0; k < lanes; ++k) from[k] = static_cast<std::int32_t>(block.a[at.i + k]), to[k] = 7;
            num::store(to, num::load_int<F>(from, n), n), num::store(all, num::load_int<F>(from, n), lanes);
            for (int k = 0; k < lanes; ++k) {
              out[k] |= wrong(static_cast<std::uint32_t>(to[k]), k < n, block.a[at.i + k]);
              out[pack_block + k] |= static_cast<std::uint32_t>(all[k]) ^ (k < n ? block.a[at.i + k] : 0u);
            }
          });
    case 2:
      return each_part(
          block, [&](const At& at, int n, std::uint32_t* out) __attribute__((always_inline)) {
            std::uint16_t halves[lanes];
            std::uint8_t bytes[lanes];
            for (int k = 0; k < lanes; ++k) halves[k] = 7, bytes[k] = 7;
            num::store(halves, num::to_signed(at.ua() >> 16), n), num::store(bytes, num::to_signed(at.ua() >> 24), n);
            for (int k = 0; k < lanes; ++k) {
              out[k] |= wrong(halves[k], k < n, block.a[at.i + k] >> 16);
              out[pack_block + k] |= wrong(bytes[k], k < n, block.a[at.i + k] >> 24);
            }
          });
    case 3:
      return each_part(
          block, [&](const At& at, int n, std::uint32_t* out) __attribute__((always_inline)) {
            float pairs[2 * lanes], points[3 * lanes];
            for (float& one : pairs) one = num::from_bits(7u);
            for (float& one : points) one = num::from_bits(7u);
            num::store2(pairs, at.a(), at.b(), n), num::store3(points, at.a(), at.b(), at.c(), n);
            const std::uint32_t* from[] = {block.a + at.i, block.b + at.i, block.c + at.i};
            for (int k = 0; k < 2 * lanes; ++k) out[k / 2] |= wrong(num::bits(pairs[k]), k / 2 < n, from[k % 2][k / 2]);
            for (int k = 0; k < 3 * lanes; ++k) out[pack_block + k / 3] |= wrong(num::bits(points[k]), k / 3 < n, from[k % 3][k / 3]);
          });
    case 4:
      return each(
          block, [&](const At& at) __attribute__((always_inline)) { past_caches<F>(at); });
    case 5:
      return each(
          block, [&](const At& at) __attribute__((always_inline)) {
            // those of any lanes, one after the other, and back again
            const std::uint32_t some = block.b[at.i] & static_cast<std::uint32_t>((std::uint64_t{1} << lanes) - 1);
            float dense[2 * lanes], back[lanes];
            for (float& one : dense) one = num::from_bits(7u);
            num::store_dense(dense, at.a(), some), num::store(back, num::load_dense<F>(dense, some), lanes);
            int place = 0;
            for (int k = 0; k < lanes; ++k) {
              const bool has = (some >> k & 1) != 0;
              block.out[at.i + k] |= num::bits(back[k]) ^ (has ? block.a[at.i + k] : 0u);
              if (has) block.out[pack_block + at.i + k] |= num::bits(dense[place++]) ^ block.a[at.i + k];
            }
            for (int k = lanes; k < 2 * lanes; ++k) block.out[2 * pack_block + at.i] |= num::bits(dense[k]) ^ 7u;
          });
    default: return false;
  }
}

/// What moves between lanes and memory.
TOFRAY_INLINE bool memory(int which, const PackBlock& block) {
  if (which > 0) return parts(which - 1, block);
  return each(
      block, [&](const At& at) __attribute__((always_inline)) { at.put(num::lane_index<F>() + I(at.i)); });
}

/// Rows of four, read and written back, against a plain loop: they agree, and nothing else is written. (A template: a plain float has none.)
template <class P>
TOFRAY_INLINE bool square_is_good(const float* from) {
  if constexpr (num::lanes<P> >= 4) {
    constexpr int row = 7, room = num::lanes<P> / 4 * row;
    const P square = num::load_square<P>(from, row);
    float to[room], as_read[num::lanes<P>];
    num::store(as_read, square, num::lanes<P>);
    for (int k = 0; k < room; ++k) to[k] = 7.5f;
    num::store_square(to, row, square);
    bool good = true;
    for (int k = 0; k < num::lanes<P>; ++k) good = good && as_read[k] == from[k / 4 * row + k % 4];
    for (int k = 0; k < room; ++k) good = good && to[k] == (k % row < 4 ? from[k] : 7.5f);
    return good;
  } else {
    return true;
  }
}
TOFRAY_INLINE bool squares(const PackBlock& block) {
  return each(
      block, [&](const At& at) __attribute__((always_inline)) {
        const bool good = square_is_good<F>(block.table + at.i);
        for (int k = 0; k < lanes; ++k) block.out[at.i + k] = good;
      });
}

/// What speaks of all lanes: the smallest, the largest, any and all, the first, against a plain loop over the same pack. 1: agrees.
TOFRAY_INLINE bool over_lanes(int which, const PackBlock& block) {
  if (which == 1) return squares(block);
  if (which != 0) return false;
  return each(
      block, [&](const At& at) __attribute__((always_inline)) {
        float low = 3e38f, high = -3e38f;
        bool some = false, every = true;
        std::uint32_t less = 0;
        for (int k = 0; k < lanes; ++k) {
          const float a = num::from_bits(block.a[at.i + k] & 0xbfffffffu),
                      b = num::from_bits(block.b[at.i + k] & 0xbfffffffu);  // no NaN, no inf
          low = a < low ? a : low, high = a > high ? a : high;
          some = some || a < b, every = every && a < b, less |= (a < b ? 1u : 0u) << k;
        }
        const F a = num::from_bits(at.ua() & U(0xbfffffffu)), b = num::from_bits(at.ub() & U(0xbfffffffu));
        const bool good = num::lowest(a) == low && num::highest(a) == high && num::any(a < b) == some && num::all(a < b) == every &&
                          num::lanes_of(a < b) == less &&
                          (!some || num::first_of(a < b, at.ia()) == static_cast<std::int32_t>(block.a[at.i + __builtin_ctz(less)])) &&
                          num::any(a == a) && num::all(a == a) && !num::any(a != a);
        for (int k = 0; k < lanes; ++k) block.out[at.i + k] = good;
      });
}

}  // namespace

extern "C" bool PACK_FUNCTIONS(int which, const PackBlock* block) {
  if (which < 100) return arithmetic(which, *block);
  if (which < 200) return whole_numbers(which - 100, *block);
  if (which < 300) return elementary(which - 200, *block);
  if (which < 400) return memory(which - 300, *block);
  return over_lanes(which - 400, *block);
}
