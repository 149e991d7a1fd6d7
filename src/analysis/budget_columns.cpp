// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/budget_columns.h"

namespace tofray::analysis {

namespace {

template <double BudgetRow::*member>
double of_row(const BudgetRow& row) {
  return row.*member;
}
template <double VarianceShares::*member>
double of_shares(const BudgetRow& row) {
  return row.share.*member;
}

}  // namespace

const std::vector<BudgetColumn>& budget_columns() {
  static const std::vector<BudgetColumn> all = {
      {"z_m", &of_row<&BudgetRow::z_m>},
      {"range_m", &of_row<&BudgetRow::range_m>},
      {"reflectivity", &of_row<&BudgetRow::reflectivity>},
      {"exposure", &of_row<&BudgetRow::exposure>},
      {"irradiance_w_m2", &of_row<&BudgetRow::irradiance_w_m2>},
      {"ambient_irradiance_w_m2", &of_row<&BudgetRow::ambient_irradiance_w_m2>},
      {"power_w", &of_row<&BudgetRow::power_w>},
      {"ambient_power_w", &of_row<&BudgetRow::ambient_power_w>},
      {"signal_e", &of_row<&BudgetRow::signal_e>},
      {"ambient_e", &of_row<&BudgetRow::ambient_e>},
      {"dark_e", &of_row<&BudgetRow::dark_e>},
      {"contrast", &of_row<&BudgetRow::contrast>},
      {"amplitude_e", &of_row<&BudgetRow::amplitude_e>},
      {"tap_filling", &of_row<&BudgetRow::tap_filling>},
      {"adc_filling", &of_row<&BudgetRow::adc_filling>},
      {"sigma_m", &of_row<&BudgetRow::sigma_m>},
      {"sigma_z_m", &of_row<&BudgetRow::sigma_z_m>},
      {"noise_estimate_m", &of_row<&BudgetRow::noise_estimate_m>},
      {"share_signal_shot", &of_shares<&VarianceShares::signal_shot>},
      {"share_ambient_shot", &of_shares<&VarianceShares::ambient_shot>},
      {"share_dark_shot", &of_shares<&VarianceShares::dark_shot>},
      {"share_read", &of_shares<&VarianceShares::read>},
      {"share_adc", &of_shares<&VarianceShares::adc>},
      {"share_suppression", &of_shares<&VarianceShares::suppression>},
      {"share_lines", &of_shares<&VarianceShares::lines>},
      {"exponent", &of_row<&BudgetRow::exponent>},
      {"wrong_cycle", &of_row<&BudgetRow::wrong_cycle>},
      {"bias_m", &of_row<&BudgetRow::bias_m>},
  };
  return all;
}

const std::vector<BudgetFlag>& budget_flags() {
  static const std::vector<BudgetFlag> all = {{"saturated", &BudgetRow::saturated},
                                              {"low_signal", &BudgetRow::low_signal},
                                              {"no_return", &BudgetRow::no_return},
                                              {"beyond_ambiguity", &BudgetRow::beyond_ambiguity}};
  return all;
}

const std::vector<BudgetFrequencyColumn>& budget_frequency_columns() {
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
