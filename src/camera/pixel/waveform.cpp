// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/pixel/waveform.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "base/constants.h"
#include "base/curve.h"
#include "base/faults.h"
#include "base/periodic.h"
#include "base/text.h"
#include "num/setup_math.h"
#include "tofray/error.h"

namespace tofray::camera {

namespace {

namespace setup = num::setup;
using base::pi;

double sinc(double x) { return x == 0 ? 1.0 : setup::sin(pi * x) / (pi * x); }

/// Multiplies the harmonic by a single pole's gain; returns the pole's phase lag [rad].
double pass_pole(Harmonic& harmonic, double frequency_hz, double pole_hz) {
  if (pole_hz == 0) return 0.0;
  const double ratio = harmonic.order * frequency_hz / pole_hz;
  harmonic.amplitude /= std::sqrt(1.0 + ratio * ratio);
  return setup::atan(ratio);
}

/// Of the square gate: 4/(πm)·sin(mπ/2), m odd.
double gate_amplitude(int m) { return (m % 4 == 1 ? 4.0 : -4.0) / (pi * m); }

/// (2/n)·Σ_k v_k·e^{−imk·2π/n}: harmonic m of equally spaced samples of one period.
std::complex<double> harmonic_of(const std::vector<double>& samples, int m) {
  const auto n = static_cast<int>(samples.size());
  double real = 0, imaginary = 0;
  for (int k = 0; k < n; ++k) {
    const auto turn = static_cast<int>(static_cast<long long>(m) * k % n);  // reduced exactly, so that long curves lose nothing
    const double angle = 2.0 * pi * turn / n;
    real += samples[static_cast<std::size_t>(k)] * setup::cos(angle);
    imaginary -= samples[static_cast<std::size_t>(k)] * setup::sin(angle);
  }
  return {2.0 / n * real, 2.0 / n * imaginary};
}

/// L_m of light 1 + Σ_m Re L_m·e^{2πimft} whose edges differ: its slope is a box of unit area at either edge.  [theory: trapezoid-pulse]
std::complex<double> trapezoid(int m, const Waveform& w, double frequency_hz) {
  const double rise = sinc(m * frequency_hz * w.rise_time_s), fall = sinc(m * frequency_hz * w.fall_time_s), angle = pi * m * w.duty;
  const double per = 1 / (pi * m * w.duty);
  return {per * setup::sin(angle) * (rise + fall), per * setup::cos(angle) * (fall - rise)};
}

/// Light of mean 1 out of a measured one.                                                             [theory: square-gate]
std::vector<double> emitted(const Waveform& w) {
  std::vector<double> light = w.sample_phases_rad.empty() ? w.emission : base::over_a_period(w.sample_phases_rad, w.emission);
  double mean = 0;
  for (const double one : light) mean += one / static_cast<double>(light.size());
  if (!(mean > 0)) base::refuse("a measured emission has no light");
  for (double& one : light) one /= mean;
  return light;
}

/// Light against a square gate: 2/(πm)·sin(mπ/2)·conj(L_m).
Harmonic against_gate(int m, const std::complex<double>& light) {
  return {m, 0.5 * gate_amplitude(m) * setup::hypot(light.real(), light.imag()), -setup::atan2(light.imag(), light.real())};
}

/// Light of amplitude 2·sinc(mδ)·sinc(m f t_rise), or d, or of a pulse of its own, against a square gate of amplitude 4/(πm)·sin(mπ/2).
/// @param light  of an emission: over one period
Harmonic ideal_harmonic(int m, const Waveform& waveform, double frequency_hz, const std::vector<double>& light) {
  switch (waveform.kind) {
    case Waveform::Kind::sine: return {m, 2.0 / pi * waveform.modulation_depth, 0.0};
    case Waveform::Kind::trapezoid: return against_gate(m, trapezoid(m, waveform, frequency_hz));
    case Waveform::Kind::emission: return against_gate(m, harmonic_of(light, m));
    case Waveform::Kind::gaussian: {
      const double angle = 2.0 * pi * m * frequency_hz * waveform.sigma_s;
      return {m, gate_amplitude(m) * setup::exp(-0.5 * angle * angle), 0.0};  // [theory: gaussian-pulse]
    }
    default: break;
  }
  const double sign = m % 4 == 1 ? 1.0 : -1.0;  // sin(mπ/2), m odd
  return {m, sign * 4.0 / (pi * m) * sinc(m * waveform.duty) * sinc(m * frequency_hz * waveform.rise_time_s), 0.0};
}

/// What light and gate make of it: poles, jitter, contrast.
Harmonic real_harmonic(Harmonic harmonic, const Waveform& waveform, const Pixel& pixel, double frequency_hz, double contrast) {
  // A slow gate samples later, which looks like a shorter path; slow light looks like a longer one.
  harmonic.phase_rad -= pass_pole(harmonic, frequency_hz, pixel.bandwidth_hz);
  harmonic.phase_rad += pass_pole(harmonic, frequency_hz, waveform.bandwidth_hz);
  const double jitter_rad = 2.0 * pi * harmonic.order * frequency_hz * waveform.jitter_s;
  harmonic.amplitude *= setup::exp(-0.5 * jitter_rad * jitter_rad) * contrast;
  return harmonic;
}

std::vector<Harmonic> measured_harmonics(const Waveform& waveform) {
  const auto n = static_cast<int>(waveform.correlation.size());
  if (n < 3) base::refuse("a measured correlation needs at least 3 samples over its period\n  got " + std::to_string(n));
  for (int k = 0; k < n; ++k)
    if (!std::isfinite(waveform.correlation[static_cast<std::size_t>(k)]))
      base::refuse("sample " + std::to_string(k) + " of a measured correlation is not a finite number");
  const bool even = waveform.sample_phases_rad.empty();
  const std::vector<double> samples = even ? waveform.correlation : base::over_a_period(waveform.sample_phases_rad, waveform.correlation);
  std::vector<Harmonic> harmonics;
  for (int m = 1; m < 2 * waveform.harmonics && 2 * m < n; m += 2) {
    const std::complex<double> one = harmonic_of(samples, m);
    harmonics.push_back({m, setup::hypot(one.real(), one.imag()), setup::atan2(one.imag(), one.real())});
  }
  return harmonics;
}

/// A pulse that rises before it has fallen, or falls before it has risen, is none.
void check_pulse(const Waveform& waveform, double frequency_hz) {
  if (!(waveform.duty > 0 && waveform.duty < 1)) base::refuse("a duty must lie between 0 and 1\n  got " + std::to_string(waveform.duty));
  const double edges = 0.5 * frequency_hz * (waveform.rise_time_s + waveform.fall_time_s);
  if (waveform.kind == Waveform::Kind::trapezoid && edges > std::min(waveform.duty, 1 - waveform.duty))
    base::refuse("the edges of a trapezoid do not fit into its pulse or its pause\n  got a mean edge of " + base::number_text(100 * edges) +
                 " % of the period at " + base::number_text(1e-6 * frequency_hz) + " MHz, at most the shorter of pulse and pause: " +
                 base::number_text(100 * std::min(waveform.duty, 1 - waveform.duty)) + " %");
}

}  // namespace

std::vector<Harmonic> correlation_harmonics(const Waveform& waveform, const Pixel& pixel, double modulation_frequency_hz) {
  if (!(modulation_frequency_hz > 0) || std::isinf(modulation_frequency_hz))
    base::refuse("a modulation frequency must be above zero\n  got " + std::to_string(modulation_frequency_hz) + " Hz");
  if (waveform.harmonics < 1) base::refuse("a waveform needs at least one harmonic\n  got " + std::to_string(waveform.harmonics));
  if (waveform.kind == Waveform::Kind::measured) return measured_harmonics(waveform);
  const bool sine = waveform.kind == Waveform::Kind::sine;
  if (sine && !(waveform.modulation_depth > 0 && waveform.modulation_depth <= 1))
    base::refuse("a modulation depth must lie above 0, up to 1\n  got " + std::to_string(waveform.modulation_depth));
  if (waveform.kind == Waveform::Kind::rectangular || waveform.kind == Waveform::Kind::trapezoid)
    check_pulse(waveform, modulation_frequency_hz);

  const double contrast = base::ClampedCurve(pixel.contrast, "the pixel's contrast").evaluate(modulation_frequency_hz);
  const int count = sine ? 1 : waveform.harmonics;
  const std::vector<double> light = waveform.kind == Waveform::Kind::emission ? emitted(waveform) : std::vector<double>{};
  std::vector<Harmonic> harmonics;
  for (int i = 0; i < count; ++i) {
    const Harmonic ideal = ideal_harmonic(2 * i + 1, waveform, modulation_frequency_hz, light);
    harmonics.push_back(real_harmonic(ideal, waveform, pixel, modulation_frequency_hz, contrast));
  }
  return harmonics;
}

std::vector<Harmonic> correlation_harmonics(const Illumination& light, const Pixel& pixel, double modulation_frequency_hz) {
  std::vector<Harmonic> harmonics = correlation_harmonics(light.waveform, pixel, modulation_frequency_hz);
  if (pixel.contrast_by_wavelength.y.empty() || light.waveform.kind == Waveform::Kind::measured) return harmonics;
  const double factor =
      base::ClampedCurve(pixel.contrast_by_wavelength, "contrast_by_wavelength").evaluate(light.illumination_wavelength_m);
  for (Harmonic& harmonic : harmonics) harmonic.amplitude *= factor;
  return harmonics;
}

}  // namespace tofray::camera
