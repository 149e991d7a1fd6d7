// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/text.h"
#include "base/units.h"
#include "sweep/metrics.h"
#include "sweep/trimmed.h"
#include "tofray/error.h"

namespace tofray {

namespace {

using sweeps::trimmed;

/// A metric of the sweep, or an axis of numbers.
struct Quantity {
  std::size_t metric = 0;
  std::optional<std::size_t> axis;
  std::string unit;  ///< "m", "%", "e", or the axis's SI unit
  bool at_least = false;

  [[nodiscard]] double of(const Sweep& sweep, std::uint64_t cell) const {
    return axis ? sweep.axes[*axis].numbers[sweep.place(cell, *axis)] : sweep.value(cell, 0, metric);
  }
  /// Less is better.
  [[nodiscard]] double cost(const Sweep& sweep, std::uint64_t cell) const {
    const double value = of(sweep, cell);
    return axis ? value : at_least ? -value : std::fabs(value);
  }
};

Quantity quantity_of(const Sweep& sweep, const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    const SweepAxis& axis = sweep.axes[i];
    if (axis.numbers.empty()) continue;
    known.push_back(axis.key);
    if (axis.key == name || axis.key == "camera." + name) return {0, i, axis.unit, false};
  }
  for (std::size_t i = 0; i < sweep.metrics.size(); ++i) {
    const std::string& metric = sweep.metrics[i];
    const std::string unit = metric.ends_with("_m")         ? "m"
                             : metric.ends_with("_percent") ? "%"
                                                            : "e",
                      plain = metric.substr(0, metric.rfind('_'));
    known.push_back(plain);
    if (metric == name || plain == name) return {i, {}, unit, sweep_metrics()[sweeps::metric_named(metric)].at_least};
  }
  throw Error(ErrorKind::bad_input, fmt::format("error: --best: the sweep has no {}{}\n  expected {}", base::in_quotes(name),
                                                base::did_you_mean(name, known), base::listed(known)));
}

std::optional<double> plain_number(std::string text) {
  text = trimmed(text);
  double number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

double limit_of(const std::string& name, const Quantity& quantity, const std::string& text) {
  std::optional<double> out;
  if (quantity.unit == "%" || quantity.unit == "e") {
    if (text.ends_with(quantity.unit)) out = plain_number(text.substr(0, text.size() - 1));
  } else if (quantity.unit.empty()) {
    out = plain_number(text);
    if (!out && text.ends_with("%"))
      if (const auto share = plain_number(text.substr(0, text.size() - 1))) out = *share / 100;
  } else if (const base::Unit* unit = base::find_unit(quantity.unit)) {
    const base::Quantity read = base::parse_quantity(text, unit->dimension);
    if (read.status == base::Quantity::Status::good) out = read.value;
  }
  if (out) return *out;
  throw Error(ErrorKind::bad_input,
              fmt::format("error: --best: {} cannot be held against {}\n  expected a number{}", name, base::in_quotes(text),
                          quantity.unit.empty() ? "" : " with a unit, as in 5 " + (quantity.unit == "m" ? "mm" : quantity.unit)));
}

struct Condition {
  Quantity quantity;
  bool above = false;
  double limit = 0;
  [[nodiscard]] bool holds(const Sweep& sweep, std::uint64_t cell) const {
    const double value = quantity.of(sweep, cell), size = quantity.axis ? value : std::fabs(value);
    return above ? size > limit : size < limit;
  }
};

}  // namespace

std::vector<std::uint64_t> best_cells(const Sweep& sweep, const std::string& wish) {
  std::vector<Quantity> aims;
  std::vector<Condition> conditions;
  for (std::size_t from = 0; from <= wish.size();) {
    const std::size_t end = std::min(wish.find(',', from), wish.size());
    const std::string part = trimmed(wish.substr(from, end - from));
    from = end + 1;
    const std::size_t sign = part.find_first_of("<>");
    if (sign == std::string::npos) {
      aims.push_back(quantity_of(sweep, part));
      continue;
    }
    const std::string name = trimmed(part.substr(0, sign));
    const Quantity quantity = quantity_of(sweep, name);
    conditions.push_back({quantity, part[sign] == '>', limit_of(name, quantity, trimmed(part.substr(sign + 1)))});
  }
  if (aims.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("error: --best {} has no aim\n  expected a name without < and > among the parts, as in --best "
                            "\"sigma, fill>95%\"",
                            base::in_quotes(wish)));
  struct Candidate {
    std::uint64_t cell;
    std::vector<double> costs;
  };
  std::vector<Candidate> all;
  for (std::uint64_t cell = 0; cell < sweep.cells(); ++cell) {
    Candidate one{cell, {}};
    for (const Quantity& aim : aims) one.costs.push_back(aim.cost(sweep, cell));
    const bool known = std::none_of(one.costs.begin(), one.costs.end(), [](double cost) { return std::isnan(cost); });
    if (known && std::all_of(conditions.begin(), conditions.end(), [&](const Condition& each) { return each.holds(sweep, cell); }))
      all.push_back(std::move(one));
  }
  // Whoever is better than another in all aims stands before it.
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.costs < b.costs; });
  const auto beats = [](const Candidate& a, const Candidate& b) {
    bool better = false;
    for (std::size_t i = 0; i < a.costs.size(); ++i) {
      if (a.costs[i] > b.costs[i]) return false;
      better = better || a.costs[i] < b.costs[i];
    }
    return better;
  };
  std::vector<const Candidate*> front;
  for (const Candidate& one : all)
    if (std::none_of(front.begin(), front.end(), [&](const Candidate* other) { return beats(*other, one); })) front.push_back(&one);
  std::vector<std::uint64_t> out;
  for (const Candidate* one : front) out.push_back(one->cell);
  return out;
}

}  // namespace tofray
