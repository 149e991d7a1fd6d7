// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tofray/camera.h"

namespace tofray::camera {

/// One harmonic m of the correlation between the modulated light and a pixel's gate.
struct Harmonic {
  int order = 1;         ///< m
  double amplitude = 0;  ///< a_m, may be negative
  double phase_rad = 0;  ///< ψ_m
  bool operator==(const Harmonic&) const = default;
};

/// The correlation's harmonics at one modulation frequency.
///
/// A pixel with light phasors Z_m (electrons) has the tap difference
///
///     D(τ) = Re Σ_m a_m · e^{i(mτ + ψ_m)} · Z_m                                                [theory: correlation]
///
/// Rectangular light of duty δ against a 50 % square gate, m = 1, 3, 5, …:
///
///     a_m = 4/(πm) · sin(mπ/2) · sinc(mδ) · sinc(m f t_rise) · g(m f/f_gate) · g(m f/f_light) · exp(−½(2πmfσ_jitter)²) · K(f)
///     ψ_m = −atan(m f/f_gate) + atan(m f/f_light),        sinc x = sin(πx)/(πx),   g(x) = 1/√(1 + x²)
///                                                                              [theory: rectangular-light, edges-poles-jitter]
///
/// `sine` is light 1 + d·cos of `modulation_depth` d, which has no duty and no edges: a_1 = (2d/π) · g(f/f_gate) · g(f/f_light) ·
/// exp(−½(2πfσ_jitter)²) · K(f) with the same ψ_1, and no other harmonic [theory: sinusoidal-light].
/// `trapezoid`, `gaussian` and `emission` are other lights, each of its own L_m; a_m·e^{iψ_m} = 2/(πm)·sin(mπ/2)·conj(L_m) with the same
/// factors [theory: trapezoid-pulse, gaussian-pulse, square-gate].
/// `measured` takes a_m·e^{iψ_m} = (2/n)·Σ_k D(τ_k)/S·e^{−imτ_k} [theory: measured-correlation], odd m < n/2, from the curve, which has
/// everything in it: no other member of the waveform but `harmonics` and the samples' phases, and no pole or contrast of the pixel, is
/// applied to it.
///
/// @param modulation_frequency_hz f > 0
/// @return orders 1, 3, 5, …, `waveform.harmonics` of them (fewer where a measured curve has too few samples)
/// @throws Error (bad_input) for a frequency, duty, modulation depth, number of harmonics or curve that makes no sense
std::vector<Harmonic> correlation_harmonics(const Waveform& waveform, const Pixel& pixel, double modulation_frequency_hz);

/// The correlation's harmonics of a light, whose wavelength has its say in the pixel's contrast (a measured correlation has that in it).
std::vector<Harmonic> correlation_harmonics(const Illumination& light, const Pixel& pixel, double modulation_frequency_hz);

}  // namespace tofray::camera
