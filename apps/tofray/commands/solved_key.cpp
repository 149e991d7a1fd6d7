// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "commands/solved_key.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/text.h"
#include "base/units.h"
#include "cli/commands.h"
#include "model/form.h"
#include "model/lines.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

using model::ValueForm;
using Kind = ValueForm::Kind;

/// The form of a number at a dotted path, or none.
const ValueForm* number_at(const ValueForm& form, const std::string& path) {
  if (path.empty()) {
    if (form.kind == Kind::number) return &form;
    for (const ValueForm& one : form.forms)
      if (form.kind == Kind::either && one.kind == Kind::number) return &one;
    return nullptr;
  }
  const std::size_t dot = std::min(path.find('.'), path.size());
  const std::string first = path.substr(0, dot), rest = dot < path.size() ? path.substr(dot + 1) : "";
  switch (form.kind) {
    case Kind::map:
      for (const model::Key& key : form.keys)
        if (key.name == first) return number_at(key.form, rest);
      return nullptr;
    case Kind::list: return first.find_first_not_of("0123456789") == std::string::npos ? number_at(form.forms[0], rest) : nullptr;
    case Kind::dictionary: return number_at(form.forms[0], rest);
    case Kind::variant:
      for (std::size_t i = 0; i < form.names.size(); ++i)
        if (form.names[i] == first) return number_at(form.forms[i], rest);
      return nullptr;
    case Kind::tagged:
    case Kind::either:
      for (const ValueForm& one : form.forms)
        if (const ValueForm* found = number_at(one, path)) return found;
      return nullptr;
    default: return nullptr;
  }
}

[[noreturn]] void refuse_need(const std::string& text) {
  throw Error(ErrorKind::bad_input,
              fmt::format("error: --need cannot be {}\n  expected \"sigma 10mm at 3m, 10%, 50klx\": a range noise, a distance, the "
                          "wall's reflectivity, and the light if it is not dark",
                          base::in_quotes(text)));
}

std::string trimmed(std::string text) {
  while (!text.empty() && text.front() == ' ') text.erase(0, 1);
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

double need_length(const std::string& part, const std::string& text) {
  const base::Quantity length = base::parse_quantity(part, base::Dimension::length);
  if (length.status != base::Quantity::Status::good || !(length.value > 0)) refuse_need(text);
  return length.value;
}

}  // namespace

std::string SolvedKey::text(double value) const { return base::quantity_text(value, example); }

bool is_number_key(const std::string& key) { return number_at(model::camera_form().root, key) != nullptr; }

SolvedKey solved_key(const std::string& typed) {
  const std::string key = typed.starts_with("camera.") ? typed.substr(7) : typed;
  const ValueForm* const form = number_at(model::camera_form().root, key);
  if (form == nullptr) {
    std::vector<std::string> names;
    bool known = false;
    for (const model::Line& line : model::lines_of(model::camera_form())) names.push_back(line.key), known = known || line.key == key;
    throw Error(ErrorKind::bad_input,
                fmt::format("error: --solve cannot be {}{}\n  expected a key of a profile whose value is one number, as in --solve "
                            "illumination.0.power (`tofray list keys` has all)",
                            base::in_quotes(typed), known ? "" : base::did_you_mean(key, names)));
  }
  SolvedKey out{key, form->example, base::parse_quantity(form->example, form->dimension).value, form->low, form->high};
  if (!(out.guess > 0)) out.guess = form->high > 0 ? 1e-3 * form->high : 1;
  return out;
}

BudgetNeed budget_need(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(',', from), text.size());
    parts.push_back(trimmed(text.substr(from, end - from)));
    from = end + 1;
  }
  const std::size_t at = parts[0].find(" at ");
  if (parts.size() < 2 || parts.size() > 3 || at == std::string::npos || !parts[0].starts_with("sigma ")) refuse_need(text);
  BudgetNeed out;
  out.sigma_m = need_length(parts[0].substr(6, at - 6), text), out.z_m = need_length(parts[0].substr(at + 4), text);
  const base::Quantity share = base::parse_quantity(parts[1], base::Dimension::fraction);
  if (share.status != base::Quantity::Status::good || !(share.value >= 0 && share.value <= 1)) refuse_need(text);
  out.reflectivity = share.value;
  if (parts.size() == 3) {
    Options one;
    option("--ambient").take(one, parts[2]);
    out.ambient = one.ambients.at(0);
  }
  return out;
}

}  // namespace tofray::app
