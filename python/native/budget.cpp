// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "budget.h"

#include "analysis/budget_columns.h"
#include "arrays.h"
#include "convert.h"
#include "tofray/tofray.h"

namespace tofray::python {

namespace {

template <class T>
void take_word(const py::dict& words, const char* name, T& into) {
  from_python(words[name], into, {nullptr, name});
}

BudgetRequest budget_request(const py::dict& words) {
  BudgetRequest out;
  take_word(words, "distance_m", out.distances_m), take_word(words, "reflectivity", out.reflectivities);
  take_word(words, "ambient", out.ambients), take_word(words, "angle_rad", out.angle_rad);
  take_word(words, "temperature_celsius", out.temperature_celsius), take_word(words, "pixel", out.pixel);
  take_word(words, "auto_exposure", out.auto_exposure);
  return out;
}

/// One number of all rows. @param of  the number of a row
template <class T, class Of>
py::array_t<T> column(const std::vector<BudgetRow>& rows, const Shape& shape, const Of& of) {
  py::array_t<T> out(shape);
  T* to = out.mutable_data();
  for (const BudgetRow& row : rows) *to++ = of(row);
  return out;
}

py::dict arrays_of(const std::vector<BudgetRow>& rows, const Shape& shape) {
  py::dict out;
  for (const analysis::BudgetColumn& one : analysis::budget_columns()) out[one.name] = column<double>(rows, shape, one.of);
  for (const analysis::BudgetFlag& one : analysis::budget_flags())
    out[one.name] = column<bool>(rows, shape, [&](const BudgetRow& row) { return row.*(one.member); });
  Shape by_frequency = shape;
  by_frequency.push_back(static_cast<py::ssize_t>(rows.front().frequencies.size()));
  for (const analysis::BudgetFrequencyColumn& one : analysis::budget_frequency_columns()) {
    py::array_t<double> array(by_frequency);
    double* to = array.mutable_data();
    for (const BudgetRow& row : rows)
      for (const BudgetFrequency& frequency : row.frequencies) *to++ = frequency.*(one.member);
    const std::string name = one.name;
    out[(name == "modulation_frequency_hz" ? name : "frequency_" + name).c_str()] = array;
  }
  return out;
}

py::dict summary_of(const BudgetSummary& summary, py::ssize_t lights, py::ssize_t reflectivities) {
  py::dict out;
  out["ambiguity_range_m"] = summary.ambiguity_range_m, out["low_signal_m"] = summary.low_signal_m;
  out["energy_per_frame_j"] = summary.energy_per_frame_j, out["mean_power_w"] = summary.mean_power_w;
  out["radiant_intensity_w_sr"] = summary.radiant_intensity_w_sr;
  out["noise_equivalent_distance_m"] = summary.noise_at_1_m_m;
  out["correlated_responsivity_e_per_j"] = summary.correlated_e_per_j;
  out["uncorrelated_responsivity_e_per_j"] = summary.uncorrelated_e_per_j;
  out["background_light_rejection"] = to_python(summary.rejection);
  py::array_t<double> reach(Shape{lights, reflectivities}), nearest(Shape{lights, reflectivities});
  double *to_reach = reach.mutable_data(), *to_nearest = nearest.mutable_data();
  for (const BudgetReach& one : summary.reach) *to_reach++ = one.reach_m, *to_nearest++ = one.nearest_m;
  out["reach_m"] = reach, out["nearest_m"] = nearest;
  return out;
}

/// @param with_summary  false: an empty one, in a tenth of the time
py::tuple budget_of(const py::object& camera, const py::dict& words, bool with_summary) {
  Camera of;
  from_python(camera, of, {nullptr, "camera"});
  const BudgetRequest request = budget_request(words);
  if (request.distances_m.empty() || request.reflectivities.empty() || request.ambients.empty())
    throw Error(ErrorKind::bad_input, "budget: error: got an empty list\n  expected at least one distance, reflectivity and ambient light");
  std::vector<BudgetRow> rows;
  BudgetSummary summary;
  {
    const py::gil_scoped_release free;
    rows = budget(of, request);
    if (with_summary) summary = budget_summary(of, request);
  }
  const Shape shape = {static_cast<py::ssize_t>(request.ambients.size()), static_cast<py::ssize_t>(request.reflectivities.size()),
                       static_cast<py::ssize_t>(request.distances_m.size())};
  return py::make_tuple(arrays_of(rows, shape), with_summary ? summary_of(summary, shape[0], shape[1]) : py::dict());
}

}  // namespace

void bind_budget(py::module_& module) {
  module.def("budget", &budget_of, py::arg("camera"), py::arg("request"), py::arg("with_summary") = true);
}

}  // namespace tofray::python
