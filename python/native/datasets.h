// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

namespace tofray::python {

/// Dataset for Python.
void bind_datasets(pybind11::module_& module);

}  // namespace tofray::python
