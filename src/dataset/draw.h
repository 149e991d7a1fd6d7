// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

/// Numbers by chance that are addressed, not drawn in a row: what is drawn for a path of a set's file depends on the set's seed, the sample
/// and the path alone. Another key, object or machine changes no other draw.
///
/// Everything here is made of + − × ÷ √, of num/setup_math.h and of whole numbers: the same bits with every compiler and processor.
namespace tofray::dataset {

/// Where in a set something is drawn.
struct Address {
  std::uint64_t seed = 0;
  std::uint64_t sample = 0;   ///< 0…2^40 − 1
  std::uint32_t view = 0;     ///< 0…255
  std::uint32_t attempt = 0;  ///< 0…65535
};

/// Bits by chance of a path at an address: Philox4x32-10 with the seed as key at the counter (sample's lower 32 bits; sample's upper 8, view, attempt;
/// the lower and the upper half of the first 8 bytes of the path's SHA-256, read as a big-endian number).
std::uint64_t random_bits(const Address& address, std::string_view path);

/// A multiple of 2^−53 in [0, 1).
double unit_number(std::uint64_t bits);

/// a + (b − a)·u, never outside [a, b].
double uniform(double a, double b, std::uint64_t bits);

/// e^(ln a + (ln b − ln a)·u) for 0 < a <= b, never outside.
double log_uniform(double a, double b, std::uint64_t bits);

/// Of the normal distribution with that mean and sigma, cut to [low, high], which may be infinite: μ + σ·Φ⁻¹(Φ(α) + u·(Φ(β) − Φ(α))) with α, β the ends in
/// sigmas from the mean. One draw, never a loop. Where hardly anything of the distribution lies between the ends (less than 1e-300), the end that is nearer to the mean.
double normal(double mean, double sigma, double low, double high, std::uint64_t bits);

/// Φ⁻¹(p), 0 < p < 1: the algorithm AS 241 (Wichura 1988), to 1e-15.
double inverse_normal(double p);

/// One of low…high, both included, as likely to one part in 2^64 divided by their number: the upper half of a product of 128 bits.
std::int64_t integer(std::int64_t low, std::int64_t high, std::uint64_t bits);

/// The index of one of these, as likely as its weight says. @param weights  not negative, not all 0
std::size_t weighted(const std::vector<double>& weights, std::uint64_t bits);

/// Where index i of n goes in an order by chance: a permutation of 0…n − 1, keyed by the seed and a path. A Feistel network of eight rounds on the smallest even
/// number of bits that holds n, applied until the result is below n.
std::uint64_t permuted(std::uint64_t i, std::uint64_t n, std::uint64_t seed, std::string_view path);

}  // namespace tofray::dataset
