// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/limits.h"
#include "base/text.h"
#include "model/row.h"

namespace tofray::model {

ValueForm form_of(const Number& number) {
  ValueForm form = model::number(number.dimension, number.range, number.example);
  form.bare = form.bare || number.bare;
  return form;
}

ValueForm whole_number(const Number& number) { return integer(number.range, number.example); }

Rows<1> curve_row(Row row, const Axis& x, const Axis& y, Constant constant) {
  const auto most = static_cast<int>(base::limit::curve_points.value);
  row.x_key = x.key, row.y_key = y.key;
  row.x = form_of(x.number), row.y = form_of(y.number);
  ValueForm samples = map({required(x.key, list(row.x, 2, most), "where the values stand, ascending"),
                           required(y.key, list(row.y, 2, most), "one for each " + row.x_key + "; a not-a-knot spline goes through them")});
  row.form = constant == Constant::allowed ? either({row.y, std::move(samples)}) : std::move(samples);
  row.form.max_items = most;
  Rows<1> out;
  out.rows.push_back(std::move(row));
  return out;
}

}  // namespace tofray::model
