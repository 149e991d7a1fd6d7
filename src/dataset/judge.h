// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Draws against their law: each value's place in its distribution, from 0 to 1, is uniform where the sampler is right, whatever the law.
namespace tofray::dataset {

/// Part of a distribution: it begins at `from` and holds `share` of all draws. A value of a continuous law has no share.
struct Portion {
  double from = 0, share = 0;
};

// Where a value lies in its law; none where the ends leave too few numbers between them to judge by.
std::optional<Portion> uniform_place(double value, double a, double b);
std::optional<Portion> log_uniform_place(double value, double a, double b);
std::optional<Portion> normal_place(double value, double mean, double sigma, double low, double high);
/// Place of number `which` out of `count` equally likely ones.
Portion place_among(double which, double count);
/// Place of number `which` out of those that are as likely as their weights say.
Portion place_by_weight(std::size_t which, const std::vector<double>& weights);

/// Draws of one key, by their place in their law.
struct DrawCounts {
  static constexpr int bins = 16;
  /// Fewer draws say nothing: 20 are expected in a bin.
  static constexpr std::uint64_t least = 20 * bins;
  /// χ² of 15 degrees of freedom that right draws exceed once in a million times.
  static constexpr double most = 56.493;
  std::string form;
  std::array<std::uint64_t, bins> counts{};

  /// @param spread  by chance, in [0, 1): where in its share it lies
  void add(const Portion& place, double spread);
  void add(const DrawCounts& other);
  [[nodiscard]] std::uint64_t draws() const;
  /// Against as many in each bin; 0 where there are none.
  [[nodiscard]] double chi_square() const;
  [[nodiscard]] bool misses() const { return draws() >= least && chi_square() > most; }
};

/// By the path of their key.
using Judgement = std::map<std::string, DrawCounts>;

/// What to say of draws that miss their law; empty where all keep it.
std::string missed_laws(const Judgement& of);

}  // namespace tofray::dataset
