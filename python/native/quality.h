// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

namespace tofray::python {

/// quality(), compare() and load_depths() for Python: numbers by name.
void bind_quality(pybind11::module_& module);

}  // namespace tofray::python
