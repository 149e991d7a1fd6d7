// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dataset/draw.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string>

#include "files/sha256.h"
#include "num/philox.h"
#include "num/setup_math.h"

namespace tofray::dataset {

namespace {

/// The first 8 bytes of a path's SHA-256. The last ones are known: a set draws for the same paths in each sample.
std::uint64_t hash_of(std::string_view path) {
  constexpr std::size_t most_known = 4096;
  thread_local std::map<std::string, std::uint64_t, std::less<>> known;
  if (const auto found = known.find(path); found != known.end()) return found->second;
  const std::string hex = files::sha256_hex(path);
  std::uint64_t hash = 0;
  std::from_chars(hex.data(), hex.data() + 16, hash, 16);
  if (known.size() >= most_known) known.clear();
  known.emplace(path, hash);
  return hash;
}

std::uint32_t low_half(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
std::uint32_t high_half(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }

std::uint64_t philox(std::uint64_t seed, std::uint32_t c0, std::uint32_t c1, std::uint64_t hash) {
  const auto words = num::philox<float>(c0, c1, low_half(hash), high_half(hash), num::round_keys(low_half(seed), high_half(seed)));
  return static_cast<std::uint64_t>(words.w[0]) << 32 | words.w[1];
}

/// Φ(x) for x <= 0: the tail that double carries to its last digits.
double lower_tail(double x) { return 0.5 * num::setup::erfc(-x / std::sqrt(2.0)); }

/// (c[0] + c[1] x + …) / (d[0] + d[1] x + …)
double ratio(const double (&c)[8], const double (&d)[8], double x) {
  double above = c[7], below = d[7];
  for (int i = 6; i >= 0; --i) above = above * x + c[i], below = below * x + d[i];
  return above / below;
}

}  // namespace

std::uint64_t random_bits(const Address& address, std::string_view path) {
  const std::uint32_t c1 = high_half(address.sample) << 24 | (address.view & 0xffu) << 16 | (address.attempt & 0xffffu);
  return philox(address.seed, low_half(address.sample), c1, hash_of(path));
}

double unit_number(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

double uniform(double a, double b, std::uint64_t bits) {
  const double u = unit_number(bits);
  // b − a of the largest numbers overflows.
  const double x = std::isfinite(b - a) ? a + (b - a) * u : a * (1 - u) + b * u;
  return std::clamp(x, a, b);
}

double log_uniform(double a, double b, std::uint64_t bits) {
  const double from = num::setup::log(a), to = num::setup::log(b);
  return std::clamp(num::setup::exp(from + (to - from) * unit_number(bits)), a, b);
}

double inverse_normal(double p) {
  constexpr double central_above[8] = {3.3871328727963666080,    1.3314166789178437745e+2, 1.9715909503065514427e+3,
                                       1.3731693765509461125e+4, 4.5921953931549871457e+4, 6.7265770927008700853e+4,
                                       3.3430575583588128105e+4, 2.5090809287301226727e+3};
  constexpr double central_below[8] = {1.0,
                                       4.2313330701600911252e+1,
                                       6.8718700749205790830e+2,
                                       5.3941960214247511077e+3,
                                       2.1213794301586595867e+4,
                                       3.9307895800092710610e+4,
                                       2.8729085735721942674e+4,
                                       5.2264952788528545610e+3};
  constexpr double near_above[8] = {1.42343711074968357734,    4.63033784615654529590,   5.76949722146069140550,
                                    3.64784832476320460504,    1.27045825245236838258,   2.41780725177450611770e-1,
                                    2.27238449892691845833e-2, 7.74545014278341407640e-4};
  constexpr double near_below[8] = {1.0,
                                    2.05319162663775882187,
                                    1.67638483018380384940,
                                    6.89767334985100004550e-1,
                                    1.48103976427480074590e-1,
                                    1.51986665636164571966e-2,
                                    5.47593808499534494600e-4,
                                    1.05075007164441684324e-9};
  constexpr double far_above[8] = {6.65790464350110377720,    5.46378491116411436990,    1.78482653991729133580,
                                   2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                   2.71155556874348757815e-5, 2.01033439929228813265e-7};
  constexpr double far_below[8] = {1.0,
                                   5.99832206555887937690e-1,
                                   1.36929880922735805310e-1,
                                   1.48753612908506148525e-2,
                                   7.86869131145613259100e-4,
                                   1.84631831751005468180e-5,
                                   1.42151175831644588870e-7,
                                   2.04426310338993978564e-15};
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) return q * ratio(central_above, central_below, 0.180625 - q * q);
  const double r = std::sqrt(-num::setup::log(q < 0 ? p : 1 - p));
  const double x = r <= 5 ? ratio(near_above, near_below, r - 1.6) : ratio(far_above, far_below, r - 5);
  return q < 0 ? -x : x;
}

double normal(double mean, double sigma, double low, double high, std::uint64_t bits) {
  if (sigma == 0) return std::clamp(mean, low, high);
  double alpha = (low - mean) / sigma, beta = (high - mean) / sigma;
  // What lies wholly above the mean is drawn as its mirror image: there the tails are exact.
  const bool mirrored = alpha > 0;
  if (mirrored) alpha = -alpha, beta = -beta, std::swap(alpha, beta);
  const double from = lower_tail(std::min(alpha, 0.0)), to = beta <= 0 ? lower_tail(beta) : 1 - lower_tail(-beta);
  if (!(to - from > 1e-300)) return mirrored ? low : high;
  const double u = (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;  // neither 0 nor 1
  const double p = std::clamp(from + (to - from) * u, 0x1p-1022, 1 - 0x1p-53);
  const double x = inverse_normal(p);
  return std::clamp(mean + sigma * (mirrored ? -x : x), low, high);
}

std::int64_t integer(std::int64_t low, std::int64_t high, std::uint64_t bits) {
  const std::uint64_t count = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low) + 1;
  // The upper half of bits · count, out of halves. (A count of 2^64 is 0 here, and is every number.)
  if (count == 0) return static_cast<std::int64_t>(bits);
  const std::uint64_t a = bits >> 32, b = bits & 0xffffffffu, c = count >> 32, d = count & 0xffffffffu;
  const std::uint64_t middle = a * d + (b * d >> 32), low_middle = b * c + (middle & 0xffffffffu);
  const std::uint64_t upper = a * c + (middle >> 32) + (low_middle >> 32);
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(low) + upper);
}

std::size_t weighted(const std::vector<double>& weights, std::uint64_t bits) {
  double all = 0;
  for (const double one : weights) all += one;
  double left = unit_number(bits) * all;
  std::size_t last = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] <= 0) continue;
    if (left < weights[i]) return i;
    left -= weights[i], last = i;
  }
  return last;  // rounding took the rest
}

std::uint64_t permuted(std::uint64_t i, std::uint64_t n, std::uint64_t seed, std::string_view path) {
  if (n <= 1) return 0;
  int half = 1;
  while (2 * half < 64 && (std::uint64_t{1} << (2 * half)) < n) ++half;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1, hash = hash_of(path);
  do {
    std::uint64_t left = i >> half, right = i & mask;
    for (std::uint32_t round = 0; round < 8; ++round) {
      const std::uint64_t mixed = philox(seed, low_half(right), 0xff000000u | round, hash) & mask;
      left ^= mixed;
      std::swap(left, right);
    }
    i = left << half | right;
  } while (i >= n);
  return i;
}

}  // namespace tofray::dataset
