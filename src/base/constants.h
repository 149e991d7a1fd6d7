// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Constants of nature, SI units. Those of the SI's definition are exact [bipm2019].
namespace tofray::base {

constexpr double pi = 3.14159265358979323846;
constexpr double two_pi = 2.0 * pi;

constexpr double speed_of_light = 299792458.0;                             ///< c [m/s] in vacuum, exact
constexpr double planck_constant = 6.62607015e-34;                         ///< h [J s], exact
constexpr double elementary_charge = 1.602176634e-19;                      ///< e [C], exact
constexpr double boltzmann_constant = 1.380649e-23;                        ///< k [J/K], exact
constexpr double photon_energy_length = planck_constant * speed_of_light;  ///< h·c [J m]: a photon of wavelength λ has hc/λ
constexpr double luminous_efficacy = 683.0;  ///< K_cd [lm/W] at 540 THz, exact; K_m of the photopic curve rounds to it

}  // namespace tofray::base
