// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "dataset/set_file.h"
#include "files/json.h"
#include "files/npz.h"

/// Arrays of floats as whole numbers, and back.
namespace tofray::shards {

/// A .npy file of codes: the nearest whole number to value / step, of two as near the even one; NaN is the code of its own.
/// @param source  of the sample, for messages
/// @throws Error (bad_input) where the type has no code for a value
std::string quantised_npy(const files::NpyView& view, const dataset::Quantised& as, const std::string& source);

/// How the set stores an array; none where it is as it is.
const dataset::Quantised* quantised(const dataset::SetFile& set, const std::string& array);

/// "float32", or "uint16 in steps of 0.0001".
std::string stored_type(const dataset::SetFile& set, const results::ArrayRow& row);

/// What stands in a sample's JSON beside unit and shape.
void put_type(files::Json& about, const dataset::Quantised& as);

/// Element i of an array that a sample stores. @param about  what its JSON says of it, or none
double stored_number(const files::NpyArray& array, std::size_t i, const files::Json* about);

}  // namespace tofray::shards
