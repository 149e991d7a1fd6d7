// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

namespace tofray::python {

/// sweep() and best_cells() for Python: axes and numbers as lists.
void bind_sweep(pybind11::module_& module);

}  // namespace tofray::python
