// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "base/spectra.h"
#include "tofray/camera.h"
#include "tofray/scene.h"

namespace tofray::scene {

/// Spectral irradiance E_λ [W m⁻³] that the ambient light makes on a surface that faces it, scaled to the quantity that the user gave.
///
///     level:            amount × the spectrum as tabulated (sun_am15: the standard sun; equal_energy: 1 W m⁻² nm⁻¹ from 280 to 4000 nm)
///     illuminance:      scaled so that 683 lm/W · ∫ E_λ V dλ = amount
///     band irradiance:  scaled so that ∫ E_λ T dλ = amount
///
/// Spectrum `none`, or an amount of 0, gives two samples of zero.
///
/// @throws Error (bad_input) for an amount below zero or not finite, a table that makes no spectrum, a filter that makes no sense, and
///         light that cannot be scaled because the eye, or the camera behind its filter, sees nothing of it
base::Spectrum ambient_spectrum(const Ambient& ambient, const Filter& filter);

/// E_B = ∫ E_λ·T(λ) dλ  [W/m²]: ambient irradiance within the camera's filter.  [theory: ambient-light]
///
/// T is `filter.peak` over centre ± half width and 0 outside, or the filter's table: a not-a-knot spline within its samples (never below 0)
/// and 0 outside; a table of one sample passes all wavelengths alike.
double band_irradiance(const Ambient& ambient, const Filter& filter);

/// ∫ E_λ·T(λ)·QE(λ)·λ/(hc) dλ  [e⁻ s⁻¹ m⁻²]: photo-electrons per second and area that E_B would make if it fell upon the pixel itself.
///
/// An irradiance x·E_B of the same spectrum makes x times as many. So a pixel that a surface of reflectivity ρ fills collects
///
///     B = ρ/π · (πT_lens cos⁴α/(4N²)) · pitch² · fill_factor · t_int · (this)     electrons
///
/// @param quantum_efficiency not-a-knot spline through its samples, held at the first and last value outside; one sample is a constant
/// @throws Error (bad_input) as ambient_spectrum, and for a quantum efficiency without samples
double band_electron_rate_factor(const Ambient& ambient, const Filter& filter, const Curve& quantum_efficiency);

}  // namespace tofray::scene
