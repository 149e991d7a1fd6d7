// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/num.h"

/// Two packs side by side as one number type: each operation is done for both, so that the processor has two independent chains of
/// work in hand while one waits for its results.
namespace tofray::num {

template <class Half>
struct TwinMask {
  Mask<Half> a, b;
};
template <class Half>
struct TwinInt {
  Int<Half> a, b;
  TwinInt() = default;
  TOFRAY_INLINE TwinInt(Int<Half> low, Int<Half> high) : a(low), b(high) {}
  TOFRAY_INLINE TwinInt(std::int32_t v) : a(v), b(v) {}
};
template <class Half>
struct TwinUint {
  Uint<Half> a, b;
  TwinUint() = default;
  TOFRAY_INLINE TwinUint(Uint<Half> low, Uint<Half> high) : a(low), b(high) {}
  TOFRAY_INLINE TwinUint(std::uint32_t v) : a(v), b(v) {}
};
template <class Half>
struct Twin {
  Half a, b;
  Twin() = default;
  TOFRAY_INLINE Twin(Half low, Half high) : a(low), b(high) {}
  TOFRAY_INLINE Twin(float v) : a(v), b(v) {}
};

template <class Half>
struct Traits<Twin<Half>> {
  using Int = TwinInt<Half>;
  using Uint = TwinUint<Half>;
  using Mask = TwinMask<Half>;
  using Eight = typename Traits<Half>::Eight;
  using Square = typename Traits<Half>::Square;
  static constexpr int lanes = 2 * num::lanes<Half>;
};

#define TOFRAY_TWIN_BINARY(type, result, op)                  \
  template <class H>                                          \
  TOFRAY_INLINE result<H> operator op(type<H> x, type<H> y) { \
    return {x.a op y.a, x.b op y.b};                          \
  }
TOFRAY_TWIN_BINARY(Twin, Twin, +)
TOFRAY_TWIN_BINARY(Twin, Twin, -)
TOFRAY_TWIN_BINARY(Twin, Twin, *)
TOFRAY_TWIN_BINARY(Twin, Twin, /)
TOFRAY_TWIN_BINARY(Twin, TwinMask, <)
TOFRAY_TWIN_BINARY(Twin, TwinMask, <=)
TOFRAY_TWIN_BINARY(Twin, TwinMask, >)
TOFRAY_TWIN_BINARY(Twin, TwinMask, >=)
TOFRAY_TWIN_BINARY(Twin, TwinMask, ==)
TOFRAY_TWIN_BINARY(Twin, TwinMask, !=)
TOFRAY_TWIN_BINARY(TwinMask, TwinMask, &)
TOFRAY_TWIN_BINARY(TwinMask, TwinMask, |)
TOFRAY_TWIN_BINARY(TwinInt, TwinInt, +)
TOFRAY_TWIN_BINARY(TwinInt, TwinInt, -)
TOFRAY_TWIN_BINARY(TwinInt, TwinInt, *)
TOFRAY_TWIN_BINARY(TwinInt, TwinInt, &)
TOFRAY_TWIN_BINARY(TwinInt, TwinInt, |)
TOFRAY_TWIN_BINARY(TwinInt, TwinMask, ==)
TOFRAY_TWIN_BINARY(TwinInt, TwinMask, !=)
TOFRAY_TWIN_BINARY(TwinInt, TwinMask, <)
TOFRAY_TWIN_BINARY(TwinInt, TwinMask, >)
TOFRAY_TWIN_BINARY(TwinUint, TwinUint, +)
TOFRAY_TWIN_BINARY(TwinUint, TwinUint, *)
TOFRAY_TWIN_BINARY(TwinUint, TwinUint, &)
TOFRAY_TWIN_BINARY(TwinUint, TwinUint, |)
TOFRAY_TWIN_BINARY(TwinUint, TwinUint, ^)
#undef TOFRAY_TWIN_BINARY

template <class H>
TOFRAY_INLINE Twin<H> operator-(Twin<H> x) {
  return {-x.a, -x.b};
}
template <class H>
TOFRAY_INLINE TwinMask<H> operator!(TwinMask<H> x) {
  return {!x.a, !x.b};
}
template <class H>
TOFRAY_INLINE TwinUint<H> operator<<(TwinUint<H> x, int n) {
  return {x.a << n, x.b << n};
}
template <class H>
TOFRAY_INLINE TwinUint<H> operator>>(TwinUint<H> x, int n) {
  return {x.a >> n, x.b >> n};
}

#define TOFRAY_TWIN_UNARY(type, result, name) \
  template <class H>                          \
  TOFRAY_INLINE result<H> name(type<H> x) {   \
    return {name(x.a), name(x.b)};            \
  }
TOFRAY_TWIN_UNARY(Twin, Twin, sqrt)
TOFRAY_TWIN_UNARY(Twin, Twin, floor)
TOFRAY_TWIN_UNARY(Twin, Twin, round_even)
TOFRAY_TWIN_UNARY(Twin, Twin, abs)
TOFRAY_TWIN_UNARY(Twin, TwinUint, bits)
TOFRAY_TWIN_UNARY(TwinUint, Twin, from_bits)
TOFRAY_TWIN_UNARY(Twin, TwinInt, to_int)
TOFRAY_TWIN_UNARY(TwinInt, Twin, to_float)
TOFRAY_TWIN_UNARY(TwinInt, TwinUint, to_uint)
TOFRAY_TWIN_UNARY(TwinUint, TwinInt, to_signed)
TOFRAY_TWIN_UNARY(TwinUint, TwinUint, reversed)
#undef TOFRAY_TWIN_UNARY

template <class H>
TOFRAY_INLINE Twin<H> fma(Twin<H> x, Twin<H> y, Twin<H> z) {
  return {fma(x.a, y.a, z.a), fma(x.b, y.b, z.b)};
}
template <class H>
TOFRAY_INLINE Twin<H> fms(Twin<H> x, Twin<H> y, Twin<H> z) {
  return {fms(x.a, y.a, z.a), fms(x.b, y.b, z.b)};
}
template <class H>
TOFRAY_INLINE Twin<H> fnma(Twin<H> x, Twin<H> y, Twin<H> z) {
  return {fnma(x.a, y.a, z.a), fnma(x.b, y.b, z.b)};
}
template <class H>
TOFRAY_INLINE Twin<H> min(Twin<H> x, Twin<H> y) {
  return {min(x.a, y.a), min(x.b, y.b)};
}
template <class H>
TOFRAY_INLINE Twin<H> max(Twin<H> x, Twin<H> y) {
  return {max(x.a, y.a), max(x.b, y.b)};
}
template <class H>
TOFRAY_INLINE Twin<H> copy_sign(Twin<H> x, Twin<H> y) {
  return {copy_sign(x.a, y.a), copy_sign(x.b, y.b)};
}
template <class H>
TOFRAY_INLINE Twin<H> select(TwinMask<H> m, Twin<H> x, Twin<H> y) {
  return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
}
template <class H>
TOFRAY_INLINE TwinInt<H> select(TwinMask<H> m, TwinInt<H> x, TwinInt<H> y) {
  return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
}
template <class H>
TOFRAY_INLINE TwinUint<H> select(TwinMask<H> m, TwinUint<H> x, TwinUint<H> y) {
  return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
}
template <class H>
TOFRAY_INLINE bool any(TwinMask<H> m) {
  return any(m.a | m.b);
}
template <class H>
TOFRAY_INLINE bool all(TwinMask<H> m) {
  return all(m.a & m.b);
}

template <class H>
TOFRAY_INLINE std::uint32_t lanes_of(TwinMask<H> m) {
  return lanes_of(m.a) | lanes_of(m.b) << lanes<H>;
}

template <class H>
TOFRAY_INLINE void multiply_wide(TwinUint<H> x, TwinUint<H> y, TwinUint<H>& high, TwinUint<H>& low) {
  multiply_wide(x.a, y.a, high.a, low.a);
  multiply_wide(x.b, y.b, high.b, low.b);
}
template <class H>
TOFRAY_INLINE Twin<H> gather(const float* table, TwinInt<H> index) {
  return {gather(table, index.a), gather(table, index.b)};
}
template <class H>
TOFRAY_INLINE TwinInt<H> gather(const std::int32_t* table, TwinInt<H> index) {
  return {gather(table, index.a), gather(table, index.b)};
}
template <class H>
TOFRAY_INLINE void gather_pair(const float* table, TwinInt<H> index, Twin<H>& first, Twin<H>& second) {
  gather_pair(table, index.a, first.a, second.a);
  gather_pair(table, index.b, first.b, second.b);
}
template <class H>
TOFRAY_INLINE Four<Twin<H>> gather_four(const float* table, TwinInt<H> index) {
  const Four<H> a = gather_four(table, index.a), b = gather_four(table, index.b);
  return {{{a.value[0], b.value[0]}, {a.value[1], b.value[1]}, {a.value[2], b.value[2]}, {a.value[3], b.value[3]}}};
}
template <class H>
TOFRAY_INLINE std::int32_t first_of(TwinMask<H> m, TwinInt<H> x) {
  return any(m.a) ? first_of(m.a, x.a) : first_of(m.b, x.b);
}
template <class H>
TOFRAY_INLINE float lowest(Twin<H> x) {
  return lowest(min(x.a, x.b));
}
template <class H>
TOFRAY_INLINE float highest(Twin<H> x) {
  return highest(max(x.a, x.b));
}

/// How many lanes of the second half a count of both reaches.
template <class H>
TOFRAY_INLINE int beyond(int n) {
  return n > lanes<H> ? n - lanes<H> : 0;
}

/// Bits of the first half's lanes.
template <class H>
TOFRAY_INLINE std::uint32_t low_bits(std::uint32_t bits) {
  return bits & ((std::uint32_t{1} << lanes<H>)-1);
}

template <class H>
struct Memory<Twin<H>> {
  TOFRAY_INLINE static void finish_stores() { Memory<H>::finish_stores(); }
  TOFRAY_INLINE static Twin<H> load(const float* from, int n) {
    return {num::load<H>(from, n), num::load<H>(from + lanes<H>, beyond<H>(n))};
  }
  TOFRAY_INLINE static TwinInt<H> load_int(const std::int32_t* from, int n) {
    return {num::load_int<H>(from, n), num::load_int<H>(from + lanes<H>, beyond<H>(n))};
  }
  TOFRAY_INLINE static Twin<H> load_square(const float* from, int row) {
    return {num::load_square<H>(from, row), num::load_square<H>(from + lanes<H> / 4 * row, row)};
  }
  TOFRAY_INLINE static Twin<H> load_dense(const float* from, std::uint32_t bits) {
    const std::uint32_t low = low_bits<H>(bits);
    return {num::load_dense<H>(from, low), num::load_dense<H>(from + __builtin_popcount(low), bits >> lanes<H>)};
  }
  TOFRAY_INLINE static TwinInt<H> lane_index() { return {num::lane_index<H>(), num::lane_index<H>() + Int<H>(lanes<H>)}; }
};
template <class H>
TOFRAY_INLINE void store(float* to, Twin<H> x, int n) {
  store(to, x.a, n), store(to + lanes<H>, x.b, beyond<H>(n));
}
template <class H>
TOFRAY_INLINE void store_square(float* to, int row, Twin<H> x) {
  store_square(to, row, x.a), store_square(to + lanes<H> / 4 * row, row, x.b);
}
template <class H, class Element>
TOFRAY_INLINE void store(Element* to, TwinInt<H> x, int n) {
  store(to, x.a, n), store(to + lanes<H>, x.b, beyond<H>(n));
}
template <class H>
TOFRAY_INLINE void store_dense(float* to, Twin<H> x, std::uint32_t bits) {
  const std::uint32_t low = low_bits<H>(bits);
  store_dense(to, x.a, low), store_dense(to + __builtin_popcount(low), x.b, bits >> lanes<H>);
}
template <class H>
inline constexpr bool can_store_past<Twin<H>> = can_store_past<H>;
template <class H>
TOFRAY_INLINE void store_past(float* to, Twin<H> x) {
  store_past(to, x.a), store_past(to + lanes<H>, x.b);
}
template <class H>
TOFRAY_INLINE void store_past(std::uint16_t* to, TwinInt<H> x) {
  store_past(to, x.a), store_past(to + lanes<H>, x.b);
}
template <class H>
TOFRAY_INLINE void store2(float* to, Twin<H> x, Twin<H> y, int n) {
  store2(to, x.a, y.a, n), store2(to + 2 * lanes<H>, x.b, y.b, beyond<H>(n));
}
template <class H>
TOFRAY_INLINE void store3(float* to, Twin<H> x, Twin<H> y, Twin<H> z, int n) {
  store3(to, x.a, y.a, z.a, n), store3(to + 3 * lanes<H>, x.b, y.b, z.b, beyond<H>(n));
}

}  // namespace tofray::num
