// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/ambient.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tofray/error.h"

using tofray::Ambient;
using tofray::Curve;
using tofray::Filter;
using tofray::scene::ambient_spectrum;
using tofray::scene::band_electron_rate_factor;
using tofray::scene::band_irradiance;

namespace {

constexpr double hc = 1.98644586e-25;  // J m

Ambient light(Ambient::Spectrum spectrum, Ambient::Quantity quantity, double amount) {
  Ambient ambient;
  ambient.spectrum = spectrum;
  ambient.quantity = quantity;
  ambient.amount = amount;
  return ambient;
}

Ambient sun(double level) { return light(Ambient::Spectrum::sun_am15, Ambient::Quantity::level, level); }
Ambient flat(double level) { return light(Ambient::Spectrum::equal_energy, Ambient::Quantity::level, level); }

Filter box(double center_nm, double half_width_nm, double peak = 1) {
  Filter filter;
  filter.center_m = center_nm * 1e-9;
  filter.half_width_m = half_width_nm * 1e-9;
  filter.peak = peak;
  return filter;
}

void expect_refusal(const Ambient& ambient, const Filter& filter, const std::string& part) {
  try {
    band_irradiance(ambient, filter);
    ADD_FAILURE() << "not refused: " << part;
  } catch (const tofray::Error& error) {
    EXPECT_EQ(error.kind(), tofray::ErrorKind::bad_input);
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

}  // namespace

// 835–865 nm: 31 tabulated values of mean 0.982 W m⁻² nm⁻¹; the integral gives the two end values half their weight.
TEST(band_irradiance, of_the_standard_sun_follows_its_table) {
  EXPECT_NEAR(band_irradiance(sun(1), box(850, 15)), 31 * 0.98169 - (1.0032 + 0.96324) / 2, 0.002);
  EXPECT_NEAR(band_irradiance(sun(1), box(940, 15)), 31 * 0.3734 - (0.71110 + 0.34117) / 2, 0.005);
  EXPECT_NEAR(band_irradiance(sun(0.05), box(850, 15, 0.8)), 0.04 * band_irradiance(sun(1), box(850, 15)), 1e-12);
}

TEST(band_irradiance, of_flat_light_is_width_times_peak) {
  EXPECT_NEAR(band_irradiance(flat(0.7), box(850, 15, 0.9)), 0.7 * 30 * 0.9, 1e-12);
}

TEST(band_irradiance, is_what_was_asked_for_whatever_the_spectrum) {
  for (const auto spectrum : {Ambient::Spectrum::sun_am15, Ambient::Spectrum::equal_energy})
    for (const double half_width : {2.0, 15.0, 60.0}) {
      const Ambient ambient = light(spectrum, Ambient::Quantity::band_irradiance_w_per_m2, 0.4);
      EXPECT_NEAR(band_irradiance(ambient, box(850, half_width, 0.8)), 0.4, 1e-15);
    }
}

// 5 klx of sun: the standard sun makes 109.5 klx and 29.45 W/m² within 835–865 nm.
TEST(band_irradiance, of_five_kilolux_of_sun_is_its_share_of_the_standard_sun) {
  const Ambient ambient = light(Ambient::Spectrum::sun_am15, Ambient::Quantity::illuminance_lx, 5000);
  EXPECT_NEAR(band_irradiance(ambient, box(850, 15)), 5.0 / 109.5 * 29.45, 0.01);
  EXPECT_NEAR(tofray::base::illuminance_lx(ambient_spectrum(ambient, box(850, 15))), 5000, 1e-9);
}

TEST(band_irradiance, of_a_table_is_the_integral_of_its_lines) {
  Ambient ambient = light(Ambient::Spectrum::table, Ambient::Quantity::level, 2);
  ambient.table_wavelength_m = {800e-9, 840e-9, 900e-9};
  ambient.table_irradiance_w_per_m3 = {0, 1e9, 4e8};
  // From 820 to 880 nm: a trapezoid of 0.5…1 over 20 nm and one of 1…0.6 over 40 nm, twice.
  EXPECT_NEAR(band_irradiance(ambient, box(850, 30)), 2 * (15 + 32), 1e-12);
  EXPECT_NEAR(band_irradiance(ambient, box(790, 20)), 2 * 10 * 0.125, 1e-12);  // beyond its samples there is nothing
}

TEST(band_irradiance, of_a_filter_table_is_the_integral_of_its_spline) {
  Filter filter;
  filter.table = {{830e-9, 850e-9, 870e-9}, {0, 0.9, 0}};  // three samples: a parabola, 2/3 of its box
  EXPECT_NEAR(band_irradiance(flat(1), filter), 2.0 / 3 * 40 * 0.9, 1e-12);
  filter.table = {{840e-9, 860e-9}, {0.5, 0.7}};  // a line; nothing passes beside it
  EXPECT_NEAR(band_irradiance(flat(1), filter), 20 * 0.6, 1e-12);
  filter.table = {{850e-9}, {0.5}};
  EXPECT_NEAR(band_irradiance(flat(1), filter), 0.5 * 3720, 1e-9);  // one sample passes everything
}

// Flat light E, box T of half width w about λ_0, QE = q_0 + q_1(λ − λ_0): E·T/(hc)·(2w·q_0·λ_0 + q_1·2w³/3).
TEST(band_electron_rate_factor, has_its_closed_form_for_a_linear_quantum_efficiency) {
  const double center = 850e-9, w = 15e-9, q0 = 0.4, q1 = -3e6;
  const Curve efficiency{{center - 50e-9, center + 50e-9}, {q0 - q1 * 50e-9, q0 + q1 * 50e-9}};
  const double right = 0.7e9 * 0.9 / hc * (2 * w * q0 * center + q1 * 2 * w * w * w / 3);
  EXPECT_NEAR(band_electron_rate_factor(flat(0.7), box(850, 15, 0.9), efficiency) / right, 1.0, 1e-8);  // hc has 9 digits here
}

TEST(band_electron_rate_factor, takes_a_single_sample_as_a_constant) {
  const double right = 1e9 / hc * 0.4 * 30e-9 * 850e-9;
  EXPECT_NEAR(band_electron_rate_factor(flat(1), box(850, 15), {{850e-9}, {0.4}}) / right, 1.0, 1e-8);
}

TEST(band_electron_rate_factor, holds_the_efficiency_outside_its_samples) {
  // 0.4 up to 850 nm, then a line to 0.3 at 855 nm, then 0.3.
  const double rate = band_electron_rate_factor(flat(1), box(850, 15), {{850e-9, 855e-9}, {0.4, 0.3}});
  const auto power = [](double a, double b) { return (b * b - a * a) / 2; };         // ∫ λ
  const auto cube = [](double a, double b) { return (b * b * b - a * a * a) / 3; };  // ∫ λ²
  const double line = (0.4 + 0.02 * 850) * power(850, 855) - 0.02 * cube(850, 855);  // nm
  const double right = 1e9 / hc * 1e-18 * (0.4 * power(835, 850) + line + 0.3 * power(855, 865));
  EXPECT_NEAR(rate / right, 1.0, 1e-8);
}

TEST(band_electron_rate_factor, of_narrow_light_is_the_photon_rate_times_efficiency) {
  const Ambient ambient = light(Ambient::Spectrum::sun_am15, Ambient::Quantity::band_irradiance_w_per_m2, 1);
  const double rate = band_electron_rate_factor(ambient, box(850, 0.01), {{850e-9}, {0.4}});
  EXPECT_NEAR(rate / (0.4 * 850e-9 / hc), 1.0, 1e-5);  // 0.01 nm of 850 nm
}

TEST(ambient, none_or_nothing_gives_no_light) {
  EXPECT_EQ(band_irradiance(Ambient{}, box(850, 15)), 0.0);
  EXPECT_EQ(band_irradiance(sun(0), box(850, 15)), 0.0);
  const Ambient dark = light(Ambient::Spectrum::sun_am15, Ambient::Quantity::illuminance_lx, 0);
  EXPECT_EQ(band_electron_rate_factor(dark, box(850, 15), {{1}, {0.4}}), 0.0);
}

TEST(ambient, refuses_what_makes_no_sense) {
  expect_refusal(sun(-1), box(850, 15), "must be a number that is not below zero");
  expect_refusal(sun(std::nan("")), box(850, 15), "must be a number that is not below zero");
  expect_refusal(sun(1), box(850, 0), "half width must be above zero");
  const Ambient band = light(Ambient::Spectrum::sun_am15, Ambient::Quantity::band_irradiance_w_per_m2, 1);
  expect_refusal(band, box(5000, 15), "filter passes nothing");
  Ambient infrared = light(Ambient::Spectrum::table, Ambient::Quantity::illuminance_lx, 100);
  infrared.table_wavelength_m = {830e-9, 870e-9};
  infrared.table_irradiance_w_per_m3 = {1e9, 1e9};
  expect_refusal(infrared, box(850, 15), "without any visible part");
  infrared.table_wavelength_m = {870e-9, 830e-9};
  expect_refusal(infrared, box(850, 15), "do not ascend");
  EXPECT_THROW(band_electron_rate_factor(sun(1), box(850, 15), Curve{}), tofray::Error);
}
