// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/budget_request.h"
#include "base/units.h"
#include "tofray/budget.h"
#include "tofray/error.h"

namespace tofray {

namespace {

/// A number that was tried.
struct Tried {
  double value = 0;
  BudgetRow row;
  std::string fault;  ///< why there is no camera with it
  [[nodiscard]] bool has_sigma() const { return fault.empty() && std::isfinite(row.sigma_m); }
};

double halfway(double one, double other) { return one > 0 && other > 0 ? std::sqrt(one * other) : 0.5 * (one + other); }

class Search {
 public:
  Search(const std::function<Camera(double)>& camera_of, const BudgetNeed& need, const BudgetRequest& request)
      : camera_of_(camera_of), need_(need), request_(request) {
    request_.distances_m = {need.z_m}, request_.reflectivities = {need.reflectivity}, request_.ambients = {need.ambient};
    request_ = analysis::complete_request(request_);
  }
  Tried at(double value) const {
    Tried out;
    out.value = value;
    try {
      out.row = analysis::BudgetCamera(camera_of_(value), request_).at(0, need_.z_m, need_.reflectivity, false);
    } catch (const Error& error) {
      out.fault = error.what();
    }
    return out;
  }
  [[nodiscard]] bool enough(const Tried& one) const { return one.row.sigma_m <= need_.sigma_m; }

  /// Between a number with which σ is enough and one with which it is not: the secant of ln σ over the number's logarithm, which is straight
  /// for most numbers, in turn with halving.
  [[nodiscard]] Tried between(Tried good, Tried bad) const {
    constexpr int most = 100;
    for (int i = 0; i < most && std::fabs(excess(good)) > 1e-8; ++i) {
      double middle = halfway(good.value, bad.value);
      if (i % 3 != 2 && good.value > 0 && bad.value > 0 && bad.has_sigma()) {
        const double part = excess(good) / (excess(good) - excess(bad));
        middle = good.value * std::pow(bad.value / good.value, std::clamp(part, 0.0, 1.0) + (i % 3 == 1 ? 1e-7 : 0));
      }
      if (middle == good.value || middle == bad.value || std::fabs(good.value - bad.value) <= 1e-14 * std::fabs(good.value)) break;
      const Tried one = at(middle);
      (one.has_sigma() && enough(one) ? good : bad) = one;
    }
    return good;
  }
  /// With its wrong cycles.
  [[nodiscard]] BudgetSolution solution(const Tried& found) const {
    return {true, found.value, analysis::BudgetCamera(camera_of_(found.value), request_).at(0, need_.z_m, need_.reflectivity, true), {}};
  }

 private:
  /// ln σ over what is needed.
  [[nodiscard]] double excess(const Tried& one) const { return std::log(one.row.sigma_m / need_.sigma_m); }

  const std::function<Camera(double)>& camera_of_;
  BudgetNeed need_;
  BudgetRequest request_;
};

/// Powers of two about the guess, and the ends of the range, ascending.
std::vector<double> places(double guess, double low, double high) {
  constexpr int halvings = 20;
  std::vector<double> out = {low, high};
  for (int i = -halvings; i <= halvings; ++i) {
    const double value = std::ldexp(guess, i);
    if (value > low && value < high) out.push_back(value);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// All of them, and the last numbers that have a range noise before those that have none: σ may cross the need just before the pixel saturates.
std::vector<Tried> with_edges(const Search& search, double guess, double low, double high) {
  constexpr int halvings = 26;
  std::vector<Tried> out;
  for (const double value : places(guess, low, high)) {
    Tried here = search.at(value);
    if (!out.empty() && out.back().has_sigma() != here.has_sigma()) {
      Tried known = here.has_sigma() ? here : out.back(), beyond = here.has_sigma() ? out.back() : here;
      for (int i = 0; i < halvings; ++i) {
        const Tried middle = search.at(halfway(known.value, beyond.value));
        (middle.has_sigma() ? known : beyond) = middle;
      }
      out.push_back(here.has_sigma() ? beyond : known), out.push_back(here.has_sigma() ? known : beyond);
    }
    out.push_back(std::move(here));
  }
  return out;
}

std::string fillings(const Tried& one) {
  return fmt::format("(tap {:.0f} %, ADC {:.0f} %)", 100 * one.row.tap_filling, 100 * one.row.adc_filling);
}

/// None of them will do: the one that comes nearest, and why, with figures.
BudgetSolution not_reached(const std::vector<Tried>& tried, double need_m) {
  const auto off = [&](const Tried& one) { return std::fabs(std::log(one.row.sigma_m / need_m)); };
  const Tried* nearest = nullptr;
  for (const Tried& one : tried)
    if (one.has_sigma() && (nearest == nullptr || off(one) < off(*nearest))) nearest = &one;
  BudgetSolution out;
  if (nearest == nullptr) {
    const auto some = std::find_if(tried.begin(), tried.end(), [](const Tried& one) { return one.fault.empty(); });
    if (some == tried.end())
      out.why = "there is no camera with any of them: " + tried.front().fault.substr(0, tried.front().fault.find('\n'));
    else
      out.why = some->row.saturated ? fmt::format("the pixel is saturated with each of them {}", fillings(*some))
                                    : "nothing comes back from the wall";
    return out;
  }
  out.value = nearest->value, out.row = nearest->row;
  out.why = fmt::format("range noise goes {} {:.4g} mm", nearest->row.sigma_m < need_m ? "no higher than" : "down to",
                        1e3 * nearest->row.sigma_m);
  const std::ptrdiff_t at = nearest - tried.data(), count = static_cast<std::ptrdiff_t>(tried.size());
  for (const std::ptrdiff_t beside : {at + 1, at - 1}) {
    if (beside < 0 || beside >= count || !tried[static_cast<std::size_t>(beside)].row.saturated) continue;
    out.why += fmt::format("; beyond, the pixel is saturated {}", fillings(tried[static_cast<std::size_t>(beside)]));
    break;
  }
  return out;
}

}  // namespace

BudgetSolution solve_budget(const std::function<Camera(double)>& camera_of, double guess, double low, double high, const BudgetNeed& need,
                            const BudgetRequest& request) {
  if (!(need.sigma_m > 0) || !(low <= high) || !(guess > 0))
    throw Error(ErrorKind::bad_input,
                fmt::format("error: a number of {:g} to {:g} about {:g} for a range noise of {:g} m cannot be looked for\n"
                            "  expected a noise and a guess above 0, and a range that is not empty",
                            low, high, guess, need.sigma_m));
  const Search search(camera_of, need, request);
  const std::vector<Tried> tried = with_edges(search, guess, low, high);
  // Of all steps from enough to not enough, the one nearest to the guess.
  std::optional<std::size_t> step;
  const auto away = [&](std::size_t i) { return std::fabs(std::log(std::max(tried[i].value, 1e-300) / guess)); };
  for (std::size_t i = 0; i + 1 < tried.size(); ++i) {
    if (!tried[i].has_sigma() || !tried[i + 1].has_sigma() || search.enough(tried[i]) == search.enough(tried[i + 1])) continue;
    if (!step || away(i) < away(*step)) step = i;
  }
  if (!step) return not_reached(tried, need.sigma_m);
  const Tried &one = tried[*step], &other = tried[*step + 1];
  const Tried found = search.enough(one) ? search.between(one, other) : search.between(other, one);
  return search.solution(found);
}

}  // namespace tofray
