// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

/// The number type that kernels are written on.
///
/// A kernel is a template over `F`: float (scalar reference and CUDA), or a pack of 4, 8 or 16 floats (neon.h, avx2.h, avx512.h). With F
/// come Int<F>, Uint<F> (32 bits) and Mask<F>. All of them have the operators + - * / < <= > >= == != & | ! and the free functions of this
/// file; nothing else is needed to add a machine. Every function gives the same bits on every machine: IEEE single precision,
/// rounded to nearest, subnormals kept; min and max are comparisons (the second argument where one is NaN).
///
/// TOFRAY_INLINE: a function that is inlined wherever it is called. TOFRAY_LAMBDA: likewise a lambda, after its parameters.
/// TOFRAY_NOINLINE, for what is long and called in several places, is a function of its own on a processor. On a GPU it is inlined, too, since a
/// call there puts a pixel's numbers into memory.
#define TOFRAY_LAMBDA __attribute__((always_inline))
#if defined(__CUDACC__)
#define TOFRAY_INLINE __host__ __device__ __forceinline__
#define TOFRAY_NOINLINE __host__ __device__ __forceinline__ static
#define TOFRAY_CONSTANT __device__ constexpr
#else
#define TOFRAY_INLINE __attribute__((always_inline)) inline
#define TOFRAY_NOINLINE __attribute__((noinline)) static
#define TOFRAY_CONSTANT inline constexpr
#endif

namespace tofray::num {

template <class F>
struct Traits;
template <class Half>
struct Twin;

template <>
struct Traits<float> {
  using Int = std::int32_t;
  using Uint = std::uint32_t;
  using Mask = bool;
  static constexpr int lanes = 1;
};

template <class F>
using Int = typename Traits<F>::Int;
template <class F>
using Uint = typename Traits<F>::Uint;
template <class F>
using Mask = typename Traits<F>::Mask;
template <class F>
constexpr int lanes = Traits<F>::lanes;

/// Eight lanes, and 4 × 4, on a machine that has F.
template <class F>
using Eight = typename Traits<F>::Eight;
template <class F>
using Square = typename Traits<F>::Square;

TOFRAY_INLINE float single(double a) { return static_cast<float>(a); }
/// a·b + c, rounded once.
TOFRAY_INLINE float fma(float a, float b, float c) {
#if defined(__CUDA_ARCH__)
  return __fmaf_rn(a, b, c);
#else
  return __builtin_fmaf(a, b, c);
#endif
}
/// c − a·b, rounded once.
TOFRAY_INLINE float fms(float a, float b, float c) { return fma(a, b, -c); }   ///< a·b − c
TOFRAY_INLINE float fnma(float a, float b, float c) { return fma(-a, b, c); }  ///< c − a·b
TOFRAY_INLINE float sqrt(float a) {
#if defined(__CUDA_ARCH__)
  return __fsqrt_rn(a);
#else
  return __builtin_sqrtf(a);
#endif
}
TOFRAY_INLINE float min(float a, float b) { return a < b ? a : b; }
TOFRAY_INLINE float max(float a, float b) { return a > b ? a : b; }
TOFRAY_INLINE float floor(float a) {
#if defined(__CUDA_ARCH__)
  return ::floorf(a);
#else
  return __builtin_floorf(a);
#endif
}
/// To the nearest integer, halves to the even one.
TOFRAY_INLINE float round_even(float a) {
#if defined(__CUDA_ARCH__)
  return ::rintf(a);
#else
  return __builtin_rintf(a);
#endif
}

TOFRAY_INLINE std::uint32_t bits(float a) {
#if defined(__CUDA_ARCH__)
  return __float_as_uint(a);
#else
  return __builtin_bit_cast(std::uint32_t, a);
#endif
}
TOFRAY_INLINE float from_bits(std::uint32_t a) {
#if defined(__CUDA_ARCH__)
  return __uint_as_float(a);
#else
  return __builtin_bit_cast(float, a);
#endif
}
TOFRAY_INLINE float abs(float a) { return from_bits(bits(a) & 0x7fffffffu); }
/// The magnitude of a with the sign of b.
TOFRAY_INLINE float copy_sign(float a, float b) { return from_bits((bits(a) & 0x7fffffffu) | (bits(b) & 0x80000000u)); }

TOFRAY_INLINE float select(bool m, float a, float b) { return m ? a : b; }
TOFRAY_INLINE std::int32_t select(bool m, std::int32_t a, std::int32_t b) { return m ? a : b; }
TOFRAY_INLINE std::uint32_t select(bool m, std::uint32_t a, std::uint32_t b) { return m ? a : b; }
TOFRAY_INLINE bool any(bool m) { return m; }
TOFRAY_INLINE bool all(bool m) { return m; }
TOFRAY_INLINE std::uint32_t lanes_of(bool m) { return m ? 1u : 0u; }  ///< a bit for each lane

/// Toward zero. The argument must fit: machines differ beyond.
TOFRAY_INLINE std::int32_t to_int(float a) { return static_cast<std::int32_t>(a); }
TOFRAY_INLINE float to_float(std::int32_t a) { return static_cast<float>(a); }
TOFRAY_INLINE std::uint32_t to_uint(std::int32_t a) { return static_cast<std::uint32_t>(a); }
TOFRAY_INLINE std::int32_t to_signed(std::uint32_t a) { return static_cast<std::int32_t>(a); }

/// Both halves of a 32 × 32 bit product.
TOFRAY_INLINE void multiply_wide(std::uint32_t a, std::uint32_t b, std::uint32_t& high, std::uint32_t& low) {
#if defined(__CUDA_ARCH__)
  high = __umulhi(a, b);
  low = a * b;
#else
  const std::uint64_t product = static_cast<std::uint64_t>(a) * b;
  high = static_cast<std::uint32_t>(product >> 32);
  low = static_cast<std::uint32_t>(product);
#endif
}

/// The bits of a word from its other end.
TOFRAY_INLINE std::uint32_t reversed(std::uint32_t a) {
#if defined(__CUDA_ARCH__)
  return __brev(a);
#else
  const auto swapped = [](std::uint32_t x, int n, std::uint32_t mask) TOFRAY_LAMBDA { return ((x >> n) & mask) | ((x & mask) << n); };
  a = swapped(a, 1, 0x55555555u), a = swapped(a, 2, 0x33333333u), a = swapped(a, 4, 0x0f0f0f0fu);
  return __builtin_bswap32(a);
#endif
}

/// table[index], lane by lane.
TOFRAY_INLINE float gather(const float* table, std::int32_t index) { return table[index]; }
TOFRAY_INLINE std::int32_t gather(const std::int32_t* table, std::int32_t index) { return table[index]; }

/// table[2·index] and table[2·index + 1]; the table is aligned to 8 bytes.
TOFRAY_INLINE void gather_pair(const float* table, std::int32_t index, float& first, float& second) {
  first = table[2 * index], second = table[2 * index + 1];
}
/// Four values in a row; the table is aligned to 16 bytes.
template <class F>
struct Four {
  F value[4];
};
TOFRAY_INLINE Four<float> gather_four(const float* table, std::int32_t index) {
  return {{table[4 * index], table[4 * index + 1], table[4 * index + 2], table[4 * index + 3]}};
}

/// The value of the first lane of those in a mask, of which there is one at least.
TOFRAY_INLINE std::int32_t first_of(bool, std::int32_t a) { return a; }
/// Smallest and largest of all lanes.
TOFRAY_INLINE float lowest(float a) { return a; }
TOFRAY_INLINE float highest(float a) { return a; }

/// What a number type knows of memory and of its lanes.
template <class F>
struct Memory;
template <>
struct Memory<float> {
  TOFRAY_INLINE static float load(const float* from, int) { return *from; }
  TOFRAY_INLINE static std::int32_t load_int(const std::int32_t* from, int) { return *from; }
  TOFRAY_INLINE static std::int32_t lane_index() { return 0; }
  TOFRAY_INLINE static float load_dense(const float* from, std::uint32_t bits) { return bits != 0 ? *from : 0.0f; }
};

/// The first n lanes to or from memory; the others read as 0 and are not written.
template <class F>
TOFRAY_INLINE F load(const float* from, int n) {
  return Memory<F>::load(from, n);
}
template <class F>
TOFRAY_INLINE Int<F> load_int(const std::int32_t* from, int n) {
  return Memory<F>::load_int(from, n);
}
/// 0, 1, 2 … lanes−1.
template <class F>
TOFRAY_INLINE Int<F> lane_index() {
  return Memory<F>::lane_index();
}
/// Lanes in rows of four, one row of memory below the other.
template <class F>
TOFRAY_INLINE F load_square(const float* from, int row) {
  return Memory<F>::load_square(from, row);
}
TOFRAY_INLINE void store_square(float* to, int, float a) { *to = a; }
TOFRAY_INLINE void store(float* to, float a, int) { *to = a; }
TOFRAY_INLINE void store(std::int32_t* to, std::int32_t a, int) { *to = a; }
TOFRAY_INLINE void store(std::uint16_t* to, std::int32_t a, int) { *to = static_cast<std::uint16_t>(a); }
TOFRAY_INLINE void store(std::uint8_t* to, std::int32_t a, int) { *to = static_cast<std::uint8_t>(a); }
/// Lanes that have a bit, one after the other, to memory, in which what follows may be written over: up to as many values as there are lanes.
TOFRAY_INLINE void store_dense(float* to, float a, std::uint32_t) { *to = a; }
/// Values that stand one after the other into the lanes that have a bit, in their order; the other lanes are 0. As many values as there are
/// lanes may be read.
template <class F>
TOFRAY_INLINE F load_dense(const float* from, std::uint32_t bits) {
  return Memory<F>::load_dense(from, bits);
}

/// Says early that n values will be read, or written, from table[first] on, if there is a table: for the processor's types, which wait for
/// memory.
template <class F, bool to = false, class T>
TOFRAY_INLINE void fetch(const T* table, std::int32_t first, int n) {
  constexpr int pixels_at_once = lanes<F>, line = 64 / sizeof(T);
  if constexpr (pixels_at_once > 1) {
    for (int i = 0; table != nullptr && i < n; i += line) __builtin_prefetch(table + first + i, to ? 1 : 0);
  }
}
template <class F, class T>
TOFRAY_INLINE void fetch_to(const T* table, std::int32_t first, int n) {
  fetch<F, true>(table, first, n);
}

/// Whether a number type has a store_past(to, value) of its own (avx2.h, avx512.h): all lanes, past the caches, to memory that is aligned to
/// the pack. For what will not be read soon; other threads may read it once finish_stores() has been called.
/// (Those of a float are plain stores: the name has to stand where no type has its own.)
template <class F>
inline constexpr bool can_store_past = false;
TOFRAY_INLINE void store_past(float* to, float a) { *to = a; }
TOFRAY_INLINE void store_past(std::uint16_t* to, std::int32_t a) { *to = static_cast<std::uint16_t>(a); }
template <class F>
TOFRAY_INLINE void finish_stores() {
  if constexpr (can_store_past<F>) Memory<F>::finish_stores();
}
/// x0 y0 x1 y1 …
TOFRAY_INLINE void store2(float* to, float x, float y, int) { to[0] = x, to[1] = y; }
/// x0 y0 z0 x1 y1 z1 …
TOFRAY_INLINE void store3(float* to, float x, float y, float z, int) { to[0] = x, to[1] = y, to[2] = z; }

}  // namespace tofray::num
