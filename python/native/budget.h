// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

namespace tofray::python {

/// budget() and budget_summary() for Python: rows as arrays.
void bind_budget(pybind11::module_& module);

}  // namespace tofray::python
