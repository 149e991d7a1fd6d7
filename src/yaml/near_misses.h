// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "base/faults.h"
#include "model/form.h"
#include "yaml/tree.h"

/// Mistakes that people make and YAML reads as something else: each says whether it is there, and adds the fault that names it.
namespace tofray::yaml {

using model::ValueForm;

/// "1,5 m" where a number is wanted.
bool has_decimal_comma(const Node& scalar, const std::string& label, base::Faults& faults);

/// {reflectivity: 0,5}, which is a map with the key "5". @param i  the key that the form does not know
bool comma_made_key(const Node& map, std::size_t i, base::Faults& faults);

/// "- plane:" with its keys beside it in place of below: one fault for all of them. @param form  the variant
bool keys_stand_beside(const ValueForm& form, const Node& map, base::Faults& faults);

/// Keys of the forms that a data set's file has in place of values.
const std::vector<std::string>& forms_of_sets();

/// {uniform: [1 m, 3 m]} or "= wall - 1 m" in a plain scene: what only the file of a data set may have.
bool is_form_of_a_set(const Node& node, const std::string& label, base::Faults& faults);

}  // namespace tofray::yaml
