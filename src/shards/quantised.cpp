// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "shards/quantised.h"

#include <fmt/core.h>

#include <cmath>
#include <limits>

#include "tofray/error.h"

namespace tofray::shards {

namespace {

[[noreturn]] void refuse(const files::NpyView& view, const dataset::Quantised& as, const std::string& source, std::size_t at,
                         double value) {
  const std::size_t width = view.shape.back(), height = view.shape.size() > 1 ? view.shape[view.shape.size() - 2] : 1;
  const std::string& unit = results::find_array(view.name)->unit;
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: error: {} is {:.6g} {} at pixel {},{}, and {} in steps of {:.6g} holds {:.6g} to {:.6g}\n"
                          "  expected a larger step or another type below `as`, or none for this array",
                          source, view.name, value, unit, at % width, at / width % height, as.type.name(), as.step, as.least() * as.step,
                          as.most() * as.step));
}

}  // namespace

std::string quantised_npy(const files::NpyView& view, const dataset::Quantised& as, const std::string& source) {
  const files::NpyArray array{view.type, view.shape, std::string(view.bytes)};
  std::string out = files::npy_header(as.type, view.shape);
  for (std::size_t i = 0; i < array.count(); ++i) {
    const double value = array.number(i), code = std::isnan(value) ? as.no_value() : std::nearbyint(value / as.step);
    if (!std::isnan(value) && !(code >= as.least() && code <= as.most())) refuse(view, as, source, i, value);
    const auto bits = static_cast<unsigned>(static_cast<int>(code));
    for (int byte = 0; byte < as.type.size; ++byte) out += static_cast<char>(bits >> 8 * byte & 255);
  }
  return out;
}

const dataset::Quantised* quantised(const dataset::SetFile& set, const std::string& array) {
  for (const dataset::Quantised& one : set.as)
    if (one.array == array) return &one;
  return nullptr;
}

std::string stored_type(const dataset::SetFile& set, const results::ArrayRow& row) {
  const dataset::Quantised* const as = quantised(set, row.name);
  return as == nullptr ? row.type.name() : fmt::format("{} in steps of {:.6g}", as->type.name(), as->step);
}

void put_type(files::Json& about, const dataset::Quantised& as) {
  about.set("dtype", as.type.name()).set("step", as.step).set("no_value", static_cast<std::int64_t>(as.no_value()));
}

double stored_number(const files::NpyArray& array, std::size_t i, const files::Json* about) {
  double step = 0, no_value = 0;
  const auto has = [&](const char* key, double& value) { return about->find(key) != nullptr && about->find(key)->number(value); };
  if (about == nullptr || !has("step", step) || !has("no_value", no_value)) return array.number(i);
  return array.number(i) == no_value ? std::numeric_limits<double>::quiet_NaN() : array.number(i) * step;
}

}  // namespace tofray::shards
