// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <vector>

/// How often noise makes unwrapping choose another cycle.
namespace tofray::analysis {

/// Density of the phase of a phasor of length 1/σ with normal noise of variance 1 in each part, about its own phase:
///
///     p(θ) = e^{−ρ²/2}/2π + ρ cos θ/√(2π) · e^{−ρ² sin² θ/2} · Φ(ρ cos θ),   ρ = 1/σ    [theory: noisy-phasor]
///
/// @param theta  [rad] −π…π
/// @param sigma  [rad] standard deviation of small errors, above 0
double phase_density(double theta, double sigma);

/// A measured phase with noise.
struct NoisyPhase {
  double sigma_rad = 0;  ///< of the measured phase, before wiggling is taken out; 0: exact
  /// The error of the phase that is unwrapped, by that of the measured one [rad]: what the correction of wiggling makes of it. It grows
  /// throughout, from one of −π to one of π. Empty: the same.
  std::function<double(double)> corrected;
};

/// Probability that the half paths of several modulation frequencies are unwrapped to other cycles than their own: for two by integration,
/// for more by 16,384 quasi-random phases through [theory: unwrapping].                      [theory: wrong-cycle-share]
/// Noise is normal: where codes are longer than the noise that they round, it says too much or too little.
/// @param cycles  of each modulation frequency in the ambiguity range, without a common divisor
double wrong_cycle_probability(const std::vector<NoisyPhase>& phases, const std::vector<int>& cycles);

}  // namespace tofray::analysis
