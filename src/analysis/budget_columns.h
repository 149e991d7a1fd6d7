// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tofray/budget.h"

/// The columns of a budget: a header alone, for what stands on the libraries' public functions, too.
namespace tofray::analysis {

/// A number of a budget's rows, as CSV, JSON and Python call it.
struct BudgetColumn {
  const char* name;
  double (*of)(const BudgetRow& row);  ///< NaN: there is none
};

/// A yes or no of a budget's rows, as CSV, JSON and Python call it.
struct BudgetFlag {
  const char* name;
  bool BudgetRow::*member;
};

/// A number of each modulation frequency.
struct BudgetFrequencyColumn {
  const char* name;
  double BudgetFrequency::*member;
};

namespace detail {

template <double BudgetRow::*member>
double of_row(const BudgetRow& row) {
  return row.*member;
}
template <double VarianceShares::*member>
double of_shares(const BudgetRow& row) {
  return row.share.*member;
}

}  // namespace detail

/// All numbers of a row.
inline const std::vector<BudgetColumn>& budget_columns() {
  static const std::vector<BudgetColumn> all = {
      {"z_m", &detail::of_row<&BudgetRow::z_m>},
      {"range_m", &detail::of_row<&BudgetRow::range_m>},
      {"reflectivity", &detail::of_row<&BudgetRow::reflectivity>},
      {"exposure", &detail::of_row<&BudgetRow::exposure>},
      {"irradiance_w_m2", &detail::of_row<&BudgetRow::irradiance_w_m2>},
      {"ambient_irradiance_w_m2", &detail::of_row<&BudgetRow::ambient_irradiance_w_m2>},
      {"power_w", &detail::of_row<&BudgetRow::power_w>},
      {"ambient_power_w", &detail::of_row<&BudgetRow::ambient_power_w>},
      {"signal_e", &detail::of_row<&BudgetRow::signal_e>},
      {"ambient_e", &detail::of_row<&BudgetRow::ambient_e>},
      {"dark_e", &detail::of_row<&BudgetRow::dark_e>},
      {"contrast", &detail::of_row<&BudgetRow::contrast>},
      {"amplitude_e", &detail::of_row<&BudgetRow::amplitude_e>},
      {"tap_filling", &detail::of_row<&BudgetRow::tap_filling>},
      {"adc_filling", &detail::of_row<&BudgetRow::adc_filling>},
      {"sigma_m", &detail::of_row<&BudgetRow::sigma_m>},
      {"sigma_z_m", &detail::of_row<&BudgetRow::sigma_z_m>},
      {"noise_estimate_m", &detail::of_row<&BudgetRow::noise_estimate_m>},
      {"share_signal_shot", &detail::of_shares<&VarianceShares::signal_shot>},
      {"share_ambient_shot", &detail::of_shares<&VarianceShares::ambient_shot>},
      {"share_dark_shot", &detail::of_shares<&VarianceShares::dark_shot>},
      {"share_read", &detail::of_shares<&VarianceShares::read>},
      {"share_adc", &detail::of_shares<&VarianceShares::adc>},
      {"share_suppression", &detail::of_shares<&VarianceShares::suppression>},
      {"share_lines", &detail::of_shares<&VarianceShares::lines>},
      {"exponent", &detail::of_row<&BudgetRow::exponent>},
      {"wrong_cycle", &detail::of_row<&BudgetRow::wrong_cycle>},
      {"bias_m", &detail::of_row<&BudgetRow::bias_m>},
  };
  return all;
}

inline const std::vector<BudgetFlag>& budget_flags() {
  static const std::vector<BudgetFlag> all = {{"saturated", &BudgetRow::saturated},
                                              {"low_signal", &BudgetRow::low_signal},
                                              {"no_return", &BudgetRow::no_return},
                                              {"beyond_ambiguity", &BudgetRow::beyond_ambiguity}};
  return all;
}

inline const std::vector<BudgetFrequencyColumn>& budget_frequency_columns() {
  static const std::vector<BudgetFrequencyColumn> all = {{"modulation_frequency_hz", &BudgetFrequency::modulation_frequency_hz},
                                                         {"integration_time_s", &BudgetFrequency::integration_time_s},
                                                         {"signal_e", &BudgetFrequency::signal_e},
                                                         {"ambient_e", &BudgetFrequency::ambient_e},
                                                         {"dark_e", &BudgetFrequency::dark_e},
                                                         {"amplitude_e", &BudgetFrequency::amplitude_e},
                                                         {"contrast", &BudgetFrequency::contrast},
                                                         {"sigma_m", &BudgetFrequency::sigma_m}};
  return all;
}

}  // namespace tofray::analysis
