// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/wrong_cycles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/constants.h"

namespace tofray::analysis {

namespace {

using base::pi;

/// Phases farther off than this are rarer than 1e-30.
constexpr double farthest_in_sigmas = 12;

/// Probabilities of phase errors, on a grid of equal steps of the measured phase.
class PhaseErrors {
 public:
  explicit PhaseErrors(const NoisyPhase& phase) {
    const double sigma = std::max(phase.sigma_rad, 1e-9), reach = std::min(pi, farthest_in_sigmas * sigma), step = 2 * reach / steps;
    std::vector<double> density;
    for (int i = 0; i <= steps; ++i) {
      const double measured = -reach + i * step;
      density.push_back(phase_density(measured, sigma));
      place_.push_back(phase.corrected ? phase.corrected(measured) : measured);
    }
    // From either end, so that small tails keep all their digits.
    above_.assign(steps + 1, 0.0), below_.assign(steps + 1, 0.0);
    double sum = 0;
    for (std::size_t i = steps; i-- > 0;) above_[i] = sum += 0.5 * step * (density[i] + density[i + 1]);
    for (std::size_t i = 0; i < steps; ++i) below_[i + 1] = below_[i] + 0.5 * step * (density[i] + density[i + 1]);
    for (std::size_t i = 0; i <= steps; ++i) above_[i] /= sum, below_[i] /= sum;
    for (std::size_t i = 0; i <= steps; ++i) weight_.push_back(density[i] * step * (i == 0 || i == steps ? 0.5 : 1) / sum);
  }
  /// Makes at_share() quick.
  void index_shares() {
    for (int j = 0; j <= shares; ++j) begin_.push_back(first_below(static_cast<double>(j) / shares, 0, above_.size()));
  }

  [[nodiscard]] static constexpr std::size_t count() { return steps + 1; }
  [[nodiscard]] double place(std::size_t i) const { return place_[i]; }
  /// Probability of the grid's place i: trapezoids.
  [[nodiscard]] double weight(std::size_t i) const { return weight_[i]; }
  /// P(θ > x), P(θ < x).
  [[nodiscard]] double above(double x) const { return x <= place_.front() ? 1 : x >= place_.back() ? 0 : at(above_, x); }
  [[nodiscard]] double below(double x) const { return x <= place_.front() ? 0 : x >= place_.back() ? 1 : at(below_, x); }
  /// The error that a share u of all are above; after index_shares().
  [[nodiscard]] double at_share(double u) const {
    const auto j = static_cast<std::size_t>(u * shares);
    const auto found = static_cast<std::ptrdiff_t>(first_below(u, begin_[j + 1], std::min(begin_[j] + 1, above_.size())));
    const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(found, 1, steps));
    const double upper = above_[i - 1], lower = above_[i], part = upper > lower ? (u - lower) / (upper - lower) : 0.0;
    return part * place_[i - 1] + (1 - part) * place_[i];
  }

 private:
  /// The first of a part of the grid that no more than a share u are above.
  [[nodiscard]] std::size_t first_below(double u, std::size_t from, std::size_t to) const {
    const auto begin = above_.begin() + static_cast<std::ptrdiff_t>(from), end = above_.begin() + static_cast<std::ptrdiff_t>(to);
    return static_cast<std::size_t>(std::lower_bound(begin, end, u, [](double one, double than) { return one > than; }) - above_.begin());
  }
  [[nodiscard]] double at(const std::vector<double>& tail, double x) const {
    const auto next = static_cast<std::size_t>(std::upper_bound(place_.begin(), place_.end(), x) - place_.begin());
    const double part = (x - place_[next - 1]) / (place_[next] - place_[next - 1]);
    return (1 - part) * tail[next - 1] + part * tail[next];
  }

  static constexpr int steps = 4096, shares = 512;
  std::vector<std::size_t> begin_;  // where shares of j/512 begin
  std::vector<double> place_, weight_, above_, below_;
};

/// P(|M θ₂ − N θ₁| > π): the errors of q of [theory: two-frequency-unwrapping], which is rounded.
double of_two(const PhaseErrors& first, const PhaseErrors& second, double m, double n) {
  double sum = 0;
  for (std::size_t i = 0; i < PhaseErrors::count(); ++i) {
    const double shift = n * first.place(i);
    sum += first.weight(i) * (second.above((pi + shift) / m) + second.below((shift - pi) / m));
  }
  return std::min(sum, 1.0);
}

/// Largest error, either way, that noise can bring in a grid's reach.
double farthest_of(const NoisyPhase& phase) {
  const double reach = std::min(pi, farthest_in_sigmas * std::max(phase.sigma_rad, 1e-9));
  if (!phase.corrected) return reach;
  return std::max(std::fabs(phase.corrected(reach)), std::fabs(phase.corrected(-reach)));
}

/// Half of the least distance between two choices of cycles, as chooses_wrongly() measures it: errors that are shorter choose their own.
double half_apart(const std::vector<int>& cycles, std::size_t reference) {
  double least = 1;
  for (std::size_t i = 0; i < cycles.size(); ++i)
    if (i != reference) least = std::min(least, 1.0 / cycles[i]);
  for (int n = 1; n < cycles[reference]; ++n) {
    double square = 0;
    for (std::size_t i = 0; i < cycles.size(); ++i) {
      const double apart = static_cast<double>(n) * cycles[i] / cycles[reference], off = apart - std::round(apart);
      square += off * off / (static_cast<double>(cycles[i]) * cycles[i]);
    }
    least = std::min(least, std::sqrt(square));
  }
  return 0.5 * least;
}
/// Length of errors, in ambiguity ranges.
double length_of(const std::vector<double>& error, std::size_t reference) {
  double square = 0;
  for (const double one : error) square += (one - error[reference]) * (one - error[reference]);
  return std::sqrt(square);
}

std::size_t reference_of(const std::vector<int>& cycles) {
  return static_cast<std::size_t>(std::min_element(cycles.begin(), cycles.end()) - cycles.begin());
}

/// Whether no error within the grids' reach makes another choice.
bool is_never_wrong(const std::vector<NoisyPhase>& phases, const std::vector<int>& cycles) {
  if (cycles.size() == 2) return cycles[0] * farthest_of(phases[1]) + cycles[1] * farthest_of(phases[0]) < pi;
  const std::size_t reference = reference_of(cycles);
  const double of_reference = farthest_of(phases[reference]) / (2 * pi * cycles[reference]);
  double square = 0;
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    const double most = i == reference ? 0 : farthest_of(phases[i]) / (2 * pi * cycles[i]) + of_reference;
    square += most * most;
  }
  return std::sqrt(square) < half_apart(cycles, reference);
}

/// One choice of cycles by [theory: unwrapping], with half paths in ambiguity ranges: whether it is another than that of exact phases.
bool chooses_wrongly(const std::vector<double>& error, const std::vector<int>& cycles, std::size_t reference) {
  double best = 0;
  int chosen = 0;
  bool own = true;  // every other modulation frequency's cycle is its own there
  for (int n = 0; n < cycles[reference]; ++n) {
    const double here = error[reference] + static_cast<double>(n) / cycles[reference];
    double cost = 0;
    bool all_own = true;
    for (std::size_t i = 0; i < cycles.size(); ++i) {
      if (i == reference) continue;
      const double apart = (error[i] - here) * cycles[i], whole = std::round(apart);
      cost += (apart - whole) * (apart - whole) / (static_cast<double>(cycles[i]) * cycles[i]);
      all_own = all_own && whole == 0;
    }
    if (n == 0 || cost < best) best = cost, chosen = n, own = all_own;
  }
  return chosen != 0 || !own;
}

double of_many(const std::vector<PhaseErrors>& errors, const std::vector<int>& cycles) {
  const std::size_t reference = reference_of(cycles);
  const double surely_right = half_apart(cycles, reference);
  // Kronecker's sequence by the powers of 1/φ_d, the root of x^{d+1} = x + 1: as even in d dimensions as a golden section is in one.
  double root = 1;
  for (int i = 0; i < 64; ++i) root = std::pow(1 + root, 1 / (static_cast<double>(errors.size()) + 1));
  constexpr int draws = 1 << 14;
  int wrong = 0;
  std::vector<double> error(errors.size());
  for (int draw = 0; draw < draws; ++draw) {
    double step = 1;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      step /= root;
      const double turns = 0.5 + (draw + 1) * step, u = turns - std::floor(turns);
      error[i] = errors[i].at_share(u) / (2 * pi * cycles[i]);
    }
    wrong += length_of(error, reference) >= surely_right && chooses_wrongly(error, cycles, reference) ? 1 : 0;
  }
  return static_cast<double>(wrong) / draws;
}

}  // namespace

double phase_density(double theta, double sigma) {
  const double rho = 1 / sigma, along = rho * std::cos(theta), across = rho * std::sin(theta);
  const double tail = 0.5 * std::erfc(-along / std::sqrt(2.0));
  return std::exp(-0.5 * rho * rho) / (2 * pi) + along / std::sqrt(2 * pi) * std::exp(-0.5 * across * across) * tail;
}

double wrong_cycle_probability(const std::vector<NoisyPhase>& phases, const std::vector<int>& cycles) {
  if (cycles.size() < 2 || is_never_wrong(phases, cycles)) return 0;
  std::vector<PhaseErrors> errors;
  errors.reserve(phases.size());
  for (const NoisyPhase& one : phases) errors.emplace_back(one);
  if (cycles.size() == 2) return of_two(errors[0], errors[1], cycles[0], cycles[1]);
  for (PhaseErrors& one : errors) one.index_shares();
  return of_many(errors, cycles);
}

}  // namespace tofray::analysis
