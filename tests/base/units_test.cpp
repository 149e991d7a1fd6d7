// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/units.h"

#include <clocale>
#include <cmath>

#include <gtest/gtest.h>

#include "base/constants.h"

namespace {

using namespace tofray::base;
using enum Quantity::Status;

double si(const char* text, Dimension dimension) {
  const auto quantity = parse_quantity(text, dimension);
  EXPECT_EQ(quantity.status, good) << text;
  return quantity.value;
}

TEST(units, give_the_double_nearest_to_the_written_decimal) {
  EXPECT_EQ(si("80.32 MHz", Dimension::frequency), 80.32e6);
  EXPECT_EQ(si("12 um", Dimension::length), 12e-6);
  EXPECT_EQ(si("850nm", Dimension::length), 850e-9);
  EXPECT_EQ(si("15.47 mm", Dimension::length), 15.47e-3);
  EXPECT_EQ(si("2000 us", Dimension::time), 2e-3);
  EXPECT_EQ(si("1.5e3 us", Dimension::time), 1.5e-3);
  EXPECT_EQ(si("+20 ps", Dimension::time), 20e-12);
  EXPECT_EQ(si("5 %", Dimension::fraction), 0.05);
  EXPECT_EQ(si("0.9 W/(m2 nm)", Dimension::spectral_irradiance), 0.9e9);
  EXPECT_EQ(si("5 klx", Dimension::illuminance), 5000);
  EXPECT_EQ(si("180 deg", Dimension::angle), pi);
  EXPECT_EQ(si("20 e/DN", Dimension::charge_per_code), 20);
  EXPECT_EQ(si("3 µm", Dimension::length), 3e-6);
}

TEST(units, bare_zero_is_good_anywhere_and_never_negative) {
  EXPECT_EQ(si("0", Dimension::frequency), 0);
  EXPECT_FALSE(std::signbit(si("-0", Dimension::length)));
  EXPECT_FALSE(std::signbit(si("-0.0 mm", Dimension::length)));
}

TEST(units, say_why_a_text_is_no_quantity) {
  const std::pair<const char*, Quantity::Status> cases[] = {{"80", bare},
                                                            {"80 Mhz", unknown_unit},
                                                            {"80 ms", other_dimension},
                                                            {"nan", not_finite},
                                                            {"inf Hz", not_finite},
                                                            {".inf", not_finite},
                                                            {"-infinity", not_finite},
                                                            {"1e309 Hz", out_of_range},
                                                            {"1e308 MHz", out_of_range},
                                                            {"1e-400 Hz", out_of_range},
                                                            {"1e-310 Hz", out_of_range},
                                                            {"", not_a_number},
                                                            {"Hz", not_a_number},
                                                            {"eighty Hz", not_a_number},
                                                            {"--1 Hz", not_a_number},
                                                            {"+-1 Hz", not_a_number},
                                                            {"0x10 Hz", unknown_unit},
                                                            {"1,5 Hz", unknown_unit},
                                                            {"1_000 Hz", unknown_unit},
                                                            {"1e99999999999999999999 Hz", out_of_range},
                                                            {"80 Hz Hz", unknown_unit}};
  for (const auto& [text, status] : cases) EXPECT_EQ(parse_quantity(text, Dimension::frequency).status, status) << text;
}

TEST(units, do_not_depend_on_the_locale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) std::setlocale(LC_ALL, "C.UTF-8");
  EXPECT_EQ(si("1.5 m", Dimension::length), 1.5);
  std::setlocale(LC_ALL, before.c_str());
}

TEST(units, every_unit_reads_back_what_messages_print) {
  for (int d = 0; d <= static_cast<int>(Dimension::spectral_irradiance); ++d)
    for (const auto& unit : unit_names(static_cast<Dimension>(d))) {
      const double value = si(("0.25 " + unit).c_str(), static_cast<Dimension>(d));
      EXPECT_GT(value, 0) << unit;
      EXPECT_NEAR(si(quantity_text(value, "1 " + unit).c_str(), static_cast<Dimension>(d)), value, 1e-15 * value) << unit;
    }
}

}  // namespace
