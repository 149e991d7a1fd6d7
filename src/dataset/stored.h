// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "base/faults.h"
#include "files/npy.h"
#include "model/form.h"
#include "results/array_table.h"
#include "yaml/reader.h"

/// What is stored of each sample: which arrays, and of which type.
namespace tofray::dataset {

/// An array of floats that is stored as whole numbers: value = code * step, and no value is one code of its own.
struct Quantised {
  std::string array;
  files::NpyType type;
  double step = 0;                        ///< in the array's unit
  [[nodiscard]] double least() const;     ///< smallest code of a number
  [[nodiscard]] double most() const;      ///< largest code of a number
  [[nodiscard]] double no_value() const;  ///< the code of NaN: the greatest of an unsigned type, the least of a signed one
};

/// What may stand behind `as`.
model::ValueForm quantised_form();

/// Names and patterns of arrays. @param value  of the key `arrays`
std::vector<std::string> stored_arrays(const yaml::Value& value, base::Faults& faults);

/// The arrays that these names and patterns choose; of none the usual ones.
results::ArrayChoice choice_of(const std::vector<std::string>& words);

/// @param value  of the key `as`
std::vector<Quantised> quantised_arrays(const yaml::Value& value, const results::ArrayChoice& stored, base::Faults& faults);

}  // namespace tofray::dataset
