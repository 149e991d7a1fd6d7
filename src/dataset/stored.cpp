// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dataset/stored.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/units.h"

namespace tofray::dataset {

namespace {

constexpr int most_arrays = 64;
/// What a set has that asks for nothing.
constexpr const char* usual_arrays = "raw,z_m,flags,gt_z_m,gt_object_id";

files::NpyType type_of(const std::string& name) { return {name.front(), name.ends_with("16") ? 2 : 1}; }

/// A step in the unit of an array. @return 0 where it is none, which is a fault
double step_of(const yaml::Value& value, const results::ArrayRow& row, base::Faults& faults) {
  const base::Unit* unit = base::find_unit(row.unit);
  const base::Quantity step = base::parse_quantity(value.text, unit != nullptr ? unit->dimension : base::Dimension::none);
  const bool good = step.status == base::Quantity::Status::good ||
                    (step.status == base::Quantity::Status::bare && (unit == nullptr || unit->dimension == base::Dimension::none));
  if (good && step.value > 0) return step.value;
  const std::string example = unit != nullptr ? "0.001 " + row.unit : "0.001, in " + row.unit;
  faults.add(value.place(), "this is no step of " + row.name,
             "got " + base::in_quotes(value.text) + ", expected more than 0, as in step: " + example);
  return 0;
}

}  // namespace

double Quantised::least() const { return type.kind == 'u' ? 0 : no_value() + 1; }
double Quantised::most() const { return type.kind == 'u' ? no_value() - 1 : -no_value() - 1; }
double Quantised::no_value() const { return type.kind == 'u' ? std::ldexp(1.0, 8 * type.size) - 1 : -std::ldexp(1.0, 8 * type.size - 1); }

model::ValueForm quantised_form() {
  using namespace model;
  return dictionary(map({required("type", choice({"uint8", "uint16", "int8", "int16"}), "what each number is stored as"),
                         required("step", text("a step with its unit", "0.1 mm"), "between one whole number and the next")}),
                    1, most_arrays);
}

std::vector<std::string> stored_arrays(const yaml::Value& value, base::Faults& faults) {
  std::vector<std::string> out;
  for (const yaml::Value& one : value.items) {
    if (!one.good) continue;
    if (const std::string why = results::why_no_array(one.text); !why.empty())
      faults.add(one.place(), why, "expected the name of an array, or a pattern as in gt_*; `tofray list arrays` has them all");
    out.push_back(one.text);
  }
  return out;
}

results::ArrayChoice choice_of(const std::vector<std::string>& words) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : ",") + word;
  return results::ArrayChoice(joined.empty() ? usual_arrays : joined);
}

std::vector<Quantised> quantised_arrays(const yaml::Value& value, const results::ArrayChoice& stored, base::Faults& faults) {
  std::vector<Quantised> out;
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    const yaml::Value& one = value.items[i];
    if (!one.good) continue;
    const results::ArrayRow* row = results::find_array(value.names[i]);
    if (row == nullptr)
      faults.add(value.key_places[i], results::why_no_array(value.names[i]),
                 "expected an array of floats; `tofray list arrays` has them all");
    else if (!row->is_image() || row->type.kind != 'f')
      faults.add(value.key_places[i], row->name + " is stored as it is",
                 "expected an array of a float for each pixel; this one is " + row->type.name() + " " + row->shape);
    else if (!stored.has(*row))
      faults.add(value.key_places[i], row->name + " is not stored", "expected it among `arrays`, or nothing of it below `as`");
    else if (const double step = step_of(one["step"], *row, faults); step > 0)
      out.push_back({row->name, type_of(one["type"].text), step});
  }
  return out;
}

}  // namespace tofray::dataset
