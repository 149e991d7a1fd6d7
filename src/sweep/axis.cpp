// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/text.h"
#include "base/units.h"
#include "load/builtin.h"
#include "model/key_stage.h"
#include "model/lines.h"
#include "sweep/trimmed.h"
#include "tofray/error.h"
#include "tofray/sweep.h"

namespace tofray {

namespace {

using sweeps::trimmed;

using model::ValueForm;
using FormKind = ValueForm::Kind;

constexpr std::size_t most_values = 100'000;

[[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& expected) {
  throw Error(ErrorKind::bad_input, fmt::format("error: --vary {} cannot be {}\n  expected {}", key, base::in_quotes(value), expected));
}

/// The parts between commas that stand in no brackets and no quotes.
std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> out(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth <= 0) {
      out.emplace_back();
      continue;
    }
    out.back() += c;
  }
  for (std::string& one : out) one = trimmed(one);
  return out;
}

/// A key as --set takes it, and what the tables say of it.
struct Key {
  std::string name;
  const ValueForm* form = nullptr;
  Stage stage = Stage::trace;
};

std::vector<std::string> all_keys() {
  std::vector<std::string> out = {"mode", "profile"};
  for (const model::Line& line : model::lines_of(model::scene_form())) out.push_back(line.key);
  for (const model::Line& line : model::lines_of(model::camera_form())) out.push_back("camera." + line.key), out.push_back(line.key);
  return out;
}

Key key_of(const std::string& typed) {
  if (typed == "mode" || typed == "camera.mode") return {"mode", nullptr, Stage::trace};
  if (typed == "profile" || typed == "camera.profile") return {"camera.profile", nullptr, Stage::trace};
  const bool of_camera = typed.starts_with("camera.");
  if (const auto known = model::known_key(model::scene_form(), typed)) return {typed, known->form, known->stage};
  if (const auto known = model::known_key(model::camera_form(), of_camera ? typed.substr(7) : typed))
    return {of_camera ? typed : "camera." + typed, known->form, known->stage};
  std::string like = typed;
  std::replace(like.begin(), like.end(), '*', '0');
  throw Error(ErrorKind::bad_input,
              fmt::format("error: --vary has an unknown key {}{}\n  expected a key of the scene or of its camera, as in --vary "
                          "illumination.0.power=0.1W:1W:10 (`tofray list keys` has all)",
                          base::in_quotes(typed), base::did_you_mean(like, all_keys())));
}

/// Of a number, or of what may be one in place of a curve.
const ValueForm* number_form(const ValueForm* form) {
  if (form == nullptr) return nullptr;
  if (form->kind == FormKind::number || form->kind == FormKind::integer) return form;
  if (form->kind != FormKind::either) return nullptr;
  for (const ValueForm& one : form->forms)
    if (const ValueForm* found = number_form(&one)) return found;
  return nullptr;
}

std::string range_of(const ValueForm& form) {
  return fmt::format("{} to {}, as in {}", base::quantity_text(form.low, form.example), base::quantity_text(form.high, form.example),
                     form.example);
}

/// SI; none: it is no number.
std::optional<double> number_of(const ValueForm& form, const std::string& text) {
  const base::Quantity read = base::parse_quantity(text, form.dimension);
  using Status = base::Quantity::Status;
  const bool good = read.status == Status::good || (read.status == Status::bare && form.bare);
  if (!good || !(read.value >= form.low && read.value <= form.high)) return std::nullopt;
  if (form.kind == FormKind::integer && read.value != std::rint(read.value)) return std::nullopt;
  return read.value;
}

double size_of(const std::string& unit) {
  const base::Unit* found = base::find_unit(unit);
  return found == nullptr ? 1 : std::pow(10, found->exponent) * found->factor;
}

/// A:B:n or A:B:logn; empty: it is none.
std::vector<std::string> range_values(const std::string& key, const ValueForm* form, const std::string& text) {
  const std::size_t first = text.find(':'), second = first == std::string::npos ? first : text.find(':', first + 1);
  if (second == std::string::npos || text.find(':', second + 1) != std::string::npos) return {};
  const std::string low = trimmed(text.substr(0, first)), high = trimmed(text.substr(first + 1, second - first - 1));
  std::string count = trimmed(text.substr(second + 1));
  const bool log = count.starts_with("log");
  if (log) count.erase(0, 3);
  std::size_t n = 0;
  const auto read = std::from_chars(count.data(), count.data() + count.size(), n);
  if (read.ec != std::errc() || read.ptr != count.data() + count.size()) return {};
  if (form == nullptr) refuse(key, text, "values with \",\" between: only numbers have ranges");
  if (n < 2 || n > most_values) refuse(key, text, fmt::format("2 to {} values, as in {}:{}:10", most_values, low, high));
  const std::optional<double> from = number_of(*form, low), to = number_of(*form, high);
  if (!from || !to) refuse(key, from ? high : low, range_of(*form));
  if (log && (!(*from > 0) || !(*to > 0))) refuse(key, text, "both ends of a logarithmic range above 0, or an even one: A:B:n");
  const std::string unit = base::parse_quantity(low, form->dimension).unit;
  const double size = size_of(unit);
  std::vector<std::string> out;
  for (std::size_t i = 0; i < n; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(n - 1);
    const double value = log ? *from * std::pow(*to / *from, share) : *from + (*to - *from) * share;
    const std::string number = fmt::format("{:.{}g}", value / size, log ? 6 : 12);
    out.push_back(i == 0 ? low : i + 1 == n ? high : unit.empty() ? number : number + " " + unit);
    if (!number_of(*form, out.back()))
      refuse(key, text,
             form->kind == FormKind::integer ? fmt::format("whole numbers alone, and {} is none: a list, a,b,c", number) : range_of(*form));
  }
  return out;
}

std::vector<std::string> all_values(const Key& key, const InputRequest& inputs) {
  std::vector<std::string> out;
  if (key.name == "mode") return load_inputs(inputs).camera.mode_names;
  if (key.name == "camera.profile") {
    for (const load::Builtin& one : load::builtin_profiles()) out.push_back(one.name);
    return out;
  }
  if (key.form->kind == FormKind::choice || key.form->kind == FormKind::tagged) return key.form->names;
  if (key.form->kind == FormKind::boolean) return {"true", "false"};
  refuse(key.name, "@all", "values or a range: @all is for choices, switches, mode and profile");
}

SweepAxis axis_of(const Key& key, std::vector<std::string> values) {
  SweepAxis out;
  out.key = key.name, out.stage = key.stage, out.values = std::move(values);
  const ValueForm* const number = number_form(key.form);
  for (const std::string& value : out.values) {
    if (value.empty()) refuse(key.name, value, "a value between two commas");
    if (number == nullptr) continue;
    const std::optional<double> si = number_of(*number, value);
    const bool curve = key.form->kind == FormKind::either && value.find_first_of("[{") != std::string::npos;
    if (!si && !curve) refuse(key.name, value, range_of(*number));
    if (si) out.numbers.push_back(*si);
  }
  if (out.numbers.size() != out.values.size()) out.numbers.clear();
  if (!out.numbers.empty()) out.unit = base::si_unit(number->dimension);
  return out;
}

}  // namespace

SweepAxis sweep_axis(const std::string& text, const InputRequest& inputs) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
    throw Error(ErrorKind::bad_input,
                fmt::format("error: --vary cannot be {}\n  expected KEY=VALUES, as in --vary illumination.0.power=0.1W,1W or "
                            "=0.1W:1W:10, or mode=@all",
                            base::in_quotes(text)));
  const Key key = key_of(text.substr(0, equals));
  const std::string values = trimmed(text.substr(equals + 1));
  if (values == "@all") return axis_of(key, all_values(key, inputs));
  std::vector<std::string> range = range_values(key.name, number_form(key.form), values);
  return axis_of(key, range.empty() ? split_values(values) : std::move(range));
}

SweepAxis sweep_axis(const std::string& key, const std::vector<std::string>& values, const InputRequest&) {
  if (values.empty()) refuse(key, "", "one value at least");
  return axis_of(key_of(key), values);
}

SweepAxis sweep_axis_of_numbers(const std::string& typed, const std::vector<double>& numbers, const InputRequest& inputs) {
  const ValueForm* const form = number_form(key_of(typed).form);
  if (form == nullptr) refuse(typed, numbers.empty() ? "" : base::number_text(numbers[0]), "texts: the values of this key are no numbers");
  const std::string unit = base::si_unit(form->dimension);
  std::vector<std::string> texts;
  for (const double one : numbers) texts.push_back(base::number_text(one) + (unit.empty() ? "" : " " + unit));
  return sweep_axis(typed, texts, inputs);
}

}  // namespace tofray
