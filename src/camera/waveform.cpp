// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/waveform.h"

#include <cmath>
#include <string>

#include "base/constants.h"
#include "base/curve.h"
#include "base/faults.h"
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

/// Light of amplitude 2·sinc(mδ)·sinc(m f t_rise), or d, against a square gate of amplitude 4/(πm)·sin(mπ/2).
double ideal_amplitude(int m, const Waveform& waveform, double frequency_hz) {
  if (waveform.kind == Waveform::Kind::sine) return 2.0 / pi * waveform.modulation_depth;
  const double sign = m % 4 == 1 ? 1.0 : -1.0;  // sin(mπ/2), m odd
  return sign * 4.0 / (pi * m) * sinc(m * waveform.duty) * sinc(m * frequency_hz * waveform.rise_time_s);
}

/// What light and gate make of it: poles, jitter, contrast.
Harmonic real_harmonic(int m, const Waveform& waveform, const Pixel& pixel, double frequency_hz, double contrast) {
  Harmonic harmonic{m, ideal_amplitude(m, waveform, frequency_hz), 0.0};
  // A slow gate samples later, which looks like a shorter path; slow light looks like a longer one.
  harmonic.phase_rad -= pass_pole(harmonic, frequency_hz, pixel.bandwidth_hz);
  harmonic.phase_rad += pass_pole(harmonic, frequency_hz, waveform.bandwidth_hz);
  const double jitter_rad = 2.0 * pi * m * frequency_hz * waveform.jitter_s;
  harmonic.amplitude *= setup::exp(-0.5 * jitter_rad * jitter_rad) * contrast;
  return harmonic;
}

std::vector<Harmonic> measured_harmonics(const std::vector<double>& correlation, int count) {
  const auto n = static_cast<int>(correlation.size());
  if (n < 3) base::refuse("a measured correlation needs at least 3 samples over its period\n  got " + std::to_string(n));
  std::vector<Harmonic> harmonics;
  for (int m = 1; m < 2 * count && 2 * m < n; m += 2) {
    double real = 0, imaginary = 0;
    for (int k = 0; k < n; ++k) {
      const double value = correlation[static_cast<std::size_t>(k)];
      if (!std::isfinite(value)) base::refuse("sample " + std::to_string(k) + " of a measured correlation is not a finite number");
      const auto turn = static_cast<int>(static_cast<long long>(m) * k % n);  // reduced exactly, so that long curves lose nothing
      const double angle = 2.0 * pi * turn / n;
      real += value * setup::cos(angle);
      imaginary -= value * setup::sin(angle);
    }
    harmonics.push_back({m, 2.0 / n * setup::hypot(real, imaginary), setup::atan2(imaginary, real)});
  }
  return harmonics;
}

}  // namespace

std::vector<Harmonic> correlation_harmonics(const Waveform& waveform, const Pixel& pixel, double modulation_frequency_hz) {
  if (!(modulation_frequency_hz > 0) || std::isinf(modulation_frequency_hz))
    base::refuse("a modulation frequency must be above zero\n  got " + std::to_string(modulation_frequency_hz) + " Hz");
  if (waveform.harmonics < 1) base::refuse("a waveform needs at least one harmonic\n  got " + std::to_string(waveform.harmonics));
  if (waveform.kind == Waveform::Kind::measured) return measured_harmonics(waveform.correlation, waveform.harmonics);
  const bool sine = waveform.kind == Waveform::Kind::sine;
  if (sine && !(waveform.modulation_depth > 0 && waveform.modulation_depth <= 1))
    base::refuse("a modulation depth must lie above 0, up to 1\n  got " + std::to_string(waveform.modulation_depth));
  if (!sine && !(waveform.duty > 0 && waveform.duty < 1))
    base::refuse("a duty must lie between 0 and 1\n  got " + std::to_string(waveform.duty));

  const double contrast = base::ClampedCurve(pixel.contrast, "the pixel's contrast").evaluate(modulation_frequency_hz);
  const int count = sine ? 1 : waveform.harmonics;
  std::vector<Harmonic> harmonics;
  for (int i = 0; i < count; ++i) harmonics.push_back(real_harmonic(2 * i + 1, waveform, pixel, modulation_frequency_hz, contrast));
  return harmonics;
}

}  // namespace tofray::camera
