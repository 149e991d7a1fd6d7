// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/ambient.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/constants.h"
#include "base/curve.h"
#include "base/faults.h"
#include "tofray/error.h"

namespace tofray::scene {

namespace {

using base::ClampedCurve;
using base::Spectrum;

constexpr double first_wavelength_m = 280e-9, last_wavelength_m = 4000e-9;  // range of `equal_energy`
constexpr double watt_per_m2_nm = 1e9;                                      // in W m⁻³

/// The filter as a function of wavelength, and the band outside which it passes nothing.
class Transmission {
 public:
  explicit Transmission(const Filter& filter) {
    if (filter.table.y.empty()) {
      if (!(filter.half_width_m > 0 && filter.center_m > 0)) base::refuse("a filter's centre and half width must be above zero");
      from_ = filter.center_m - filter.half_width_m;
      to_ = filter.center_m + filter.half_width_m;
      curve_.emplace(Curve{{filter.center_m}, {filter.peak}}, "the filter");
    } else {
      curve_.emplace(filter.table, "the filter");
      if (filter.table.x.size() > 1) {
        from_ = filter.table.x.front();
        to_ = filter.table.x.back();
      }
    }
  }

  /// ∫ E_λ·T·weight dλ; `knots`: where the weight's pieces meet.
  [[nodiscard]] double integrate(const Spectrum& spectrum, std::vector<double> knots, const std::function<double(double)>& weight) const {
    for (const double x : curve_->knots()) knots.push_back(x);
    return base::integrate(spectrum, from_, to_, knots, [&](double x) { return curve_->evaluate(x) * weight(x); });
  }

  [[nodiscard]] double integrate(const Spectrum& spectrum) const {
    return integrate(spectrum, {}, [](double) { return 1.0; });
  }

 private:
  std::optional<ClampedCurve> curve_;
  double from_ = 0, to_ = 1;  // a table of one sample: every wavelength
};

Spectrum tabulated(const Ambient& ambient) {
  switch (ambient.spectrum) {
    case Ambient::Spectrum::none: break;
    case Ambient::Spectrum::sun_am15: return base::sun_am15();
    case Ambient::Spectrum::equal_energy: return {{first_wavelength_m, last_wavelength_m}, {watt_per_m2_nm, watt_per_m2_nm}};
    case Ambient::Spectrum::table: {
      Spectrum table{ambient.table_wavelength_m, ambient.table_irradiance_w_per_m3};
      table.check();
      return table;
    }
  }
  return {{first_wavelength_m, last_wavelength_m}, {0.0, 0.0}};
}

double scale(const Ambient& ambient, const Spectrum& spectrum, const Filter& filter) {
  if (!(ambient.amount >= 0) || std::isinf(ambient.amount))
    base::refuse("the amount of ambient light must be a number that is not below zero\n  got " + std::to_string(ambient.amount));
  if (ambient.amount == 0 || ambient.spectrum == Ambient::Spectrum::none) return 0.0;
  if (ambient.quantity == Ambient::Quantity::level) return ambient.amount;
  const bool photometric = ambient.quantity == Ambient::Quantity::illuminance_lx;
  const double unscaled = photometric ? base::illuminance_lx(spectrum) : Transmission(filter).integrate(spectrum);
  if (!(unscaled > 0))
    base::refuse(photometric
                     ? "ambient light without any visible part cannot have an illuminance\n  give its level or band irradiance"
                     : "the filter passes nothing of the ambient light, which cannot have a band irradiance then\n  give its level");
  return ambient.amount / unscaled;
}

}  // namespace

base::Spectrum ambient_spectrum(const Ambient& ambient, const Filter& filter) {
  Spectrum spectrum = tabulated(ambient);
  const double factor = scale(ambient, spectrum, filter);
  for (double& value : spectrum.value) value *= factor;
  return spectrum;
}

double band_irradiance(const Ambient& ambient, const Filter& filter) {
  return Transmission(filter).integrate(ambient_spectrum(ambient, filter));
}

double band_electron_rate_factor(const Ambient& ambient, const Filter& filter, const Curve& quantum_efficiency) {
  const ClampedCurve efficiency(quantum_efficiency, "the pixel's quantum efficiency");
  return Transmission(filter).integrate(ambient_spectrum(ambient, filter), efficiency.knots(), [&](double wavelength) {
    return efficiency.evaluate(wavelength) * (wavelength / base::photon_energy_length);
  });
}

}  // namespace tofray::scene
