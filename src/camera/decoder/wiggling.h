// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <complex>
#include <memory>
#include <vector>

#include "camera/pixel/waveform.h"

namespace tofray::camera {

/// What the demodulation Ẑ = (2/N)·Σ_k D_k·e^{−iτ_k} makes of a single noise-free path of phase φ, all harmonics included.
///
/// With D_k = Re Σ_m a_m e^{i(m(φ + τ_k) + ψ_m)} (one electron of light) the sum over k leaves
///
///     Ẑ(φ) = Σ_m P_m·a_m·e^{i(mφ + ψ_m)} + Q_m·a_m·e^{−i(mφ + ψ_m)}
///     P_m = (1/N) Σ_k e^{i(m−1)τ_k},   Q_m = (1/N) Σ_k e^{−i(m+1)τ_k}
///
/// For N equally spaced phases from τ_0 = 0 on, P_m is 1 for m ≡ 1, Q_m for m ≡ −1 (mod N), and otherwise 0: only these harmonics leak.
/// For four phases this is [theory: wiggling].
class PhaseResponse {
 public:
  /// @param reference_phases_rad τ_k, at least 3
  /// @throws Error (bad_input) for fewer than 3 phases, no harmonic, or a first harmonic that vanishes
  PhaseResponse(const std::vector<Harmonic>& harmonics, const std::vector<double>& reference_phases_rad);

  struct Value {
    double error_rad = 0;  ///< ε = φ̂ − φ, continuous in φ, period 2π; ψ_1 included
    double slope = 1;      ///< dφ̂/dφ
    double amplitude = 0;  ///< |Ẑ| per electron of light
  };
  [[nodiscard]] Value at(double phase_rad) const;

 private:
  struct Leak {
    int order;
    std::complex<double> forward, backward;  ///< P_m·a_m·e^{iψ_m}, Q_m·a_m·e^{−iψ_m}
  };
  std::vector<Leak> leaks_;
  std::complex<double> turn_back_;  ///< e^{−i·offset_}
  double offset_ = 0;               ///< [rad] phase of the first harmonic: what the error swings about
};

/// What a measured phase says of a single noise-free path, at n equidistant φ̂: node j stands at j/n turns.
struct WigglingTable {
  std::vector<double> correction;  ///< φ − φ̂ [turns]; period one turn, without jumps (it can lie outside ±0.5 because of ψ_1)
                                   ///<                                                                      [theory: wiggling-correction]
  std::vector<double> amplitude;  ///< Â = |Ẑ| of one electron of light                                           [theory: noise-estimate]
};

/// Table that takes a measured phase back to the true one: φ = φ̂ + correction(φ̂), ψ_1 taken out as well, and its amplitude to the light.
///
/// Every node is solved on the exact forward curve to 1e-12 turns or better.
///
/// @param reference_phases_rad τ_k of the raw frames, at least 3
/// @param nodes number n of nodes; node j stands at φ̂ = j/n turns
/// @throws Error (bad_input) as PhaseResponse, for nodes < 2, and where the measured phase does not grow with the true one throughout
WigglingTable wiggling_table(const std::vector<Harmonic>& harmonics, const std::vector<double>& reference_phases_rad, int nodes = 1024);
/// The one for all that ask for the same. @throws Error likewise
std::shared_ptr<const WigglingTable> shared_wiggling_table(const std::vector<Harmonic>& harmonics,
                                                           const std::vector<double>& reference_phases_rad, int nodes);

}  // namespace tofray::camera
