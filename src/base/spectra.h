// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <vector>

namespace tofray::base {

/// A function of wavelength given by samples that straight lines join; zero outside their range.
///
/// Lines and not a cubic spline: the spectrum behind the atmosphere is a comb of absorption lines, not smooth on any grid.
struct Spectrum {
  std::vector<double> wavelength_m;  ///< ascending, at least 2
  std::vector<double> value;         ///< spectral irradiance [W m⁻³] (1 W m⁻² nm⁻¹ is 1e9 W m⁻³), or no unit

  /// @throws Error (bad_input) where the samples make no spectrum: fewer than 2, not ascending, not finite, negative
  void check() const;
  [[nodiscard]] double evaluate(double wavelength) const;
};

/// Sun at sea level, air mass 1.5, on a surface tilted by 37° toward it, sky light included: 280 to 4000 nm, 1000.4 W/m² in all.
///
/// The published table, sample by sample: every 0.5 nm up to 400 nm, 1 nm up to 1700, 5 nm beyond.
/// The mean of the tabulated values over 925–955 nm is 0.373 W m⁻² nm⁻¹; the integral, which gives the end values half their weight, 0.368.
/// [astm-g173, column "global tilt"]
const Spectrum& sun_am15();

/// Spectral luminous efficiency V(λ) of the light-adapted eye, largest 1 at 555 nm; 380 to 780 nm at every 5 nm. [iso23539]
const Spectrum& photopic();

/// Illuminance E_v = 683 lm/W · ∫ E_λ·V dλ  [lx]
double illuminance_lx(const Spectrum& irradiance);

/// ∫ E_λ(λ)·weight(λ) dλ from `from_m` to `to_m`, exact up to rounding for a weight that is a polynomial of degree <= 8 between its knots.
///
/// Five Gauss–Legendre points on every piece between two neighbouring samples, knots or ends (exact up to degree 9). A weight that is the
/// product of two cubic splines and of the wavelength has degree 7.
///
/// @param knots where pieces of the weight meet, in any order; those outside the range are ignored
double integrate(const Spectrum& spectrum, double from_m, double to_m, const std::vector<double>& knots,
                 const std::function<double(double)>& weight);

}  // namespace tofray::base
