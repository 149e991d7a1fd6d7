// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "results/file_arrays.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "results/array_table.h"
#include "tofray/error.h"

namespace tofray::results {

Arrays::Arrays(std::vector<files::NamedArray> arrays, std::string where) : where_(std::move(where)), arrays_(std::move(arrays)) {
  if (const files::NpyArray* meta = find("meta"); meta != nullptr && meta->type.kind == 'U') {
    meta_text_ = meta->text();
    meta_ = files::parse_json(meta_text_, where_ + ": meta");
  }
  if (const files::NpyArray* flags = find("flags"); flags != nullptr && flags->type.kind != 'u' && flags->type.kind != 'i')
    throw Error(ErrorKind::bad_input, fmt::format("{}: error: array \"flags\" has the wrong type\n  got {}, expected uint16",
                                                  base::printable(where_), flags->type.name()));
  for (const ArrayRow& row : array_table()) {
    const files::NpyArray* array = row.is_image() ? find(row.name) : nullptr;
    if (array == nullptr || array->shape.size() != static_cast<std::size_t>(1 + std::count(row.shape.begin(), row.shape.end(), ',')))
      continue;
    const bool by_phase = row.shape.starts_with("[phase"), stack = by_phase || row.shape.starts_with("[bin");
    if (width_ == 0) height_ = array->shape[stack ? 1 : 0], width_ = array->shape[stack ? 2 : 1];
    if (by_phase && phases_ == 0) phases_ = array->shape[0];
  }
  if (const files::NpyArray* lit = find("lit"); phases_ == 0 && lit != nullptr && lit->shape.size() == 1) phases_ = lit->shape[0];
}

bool holds_arrays(const std::string& path) { return path.ends_with(".npz") || path.ends_with(".npy"); }

Arrays read_arrays(const std::string& path) {
  if (!path.ends_with(".npy")) return {files::read_npz(path), path};
  std::vector<files::NamedArray> one;
  one.push_back({"array", files::read_npy(path)});
  return {std::move(one), path};
}

const files::NpyArray* Arrays::find(std::string_view name) const {
  for (const files::NamedArray& one : arrays_) {
    if (one.name == name) return &one.array;
  }
  return nullptr;
}

unsigned flag_bits(double number) { return number >= 0 && number <= 65535 ? static_cast<unsigned>(number) : 0u; }

double Arrays::at(std::string_view name, std::size_t i) const {
  const files::NpyArray* array = find(name);
  return array == nullptr || array->type.kind == 'U' || i >= array->count() ? std::nan("") : array->number(i);
}

std::string Arrays::unit(const std::string& name) const {
  const files::Json* units = meta_.find("units");
  const files::Json* found = units == nullptr ? nullptr : units->find(name);
  if (found != nullptr && found->is_string()) return *found->string();
  const ArrayRow* known = find_array(name);
  return known == nullptr ? "" : known->unit;
}

}  // namespace tofray::results
