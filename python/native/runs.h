// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

/// Runs into folders, inputs with what is changed of them, and single pixels.
namespace tofray::python {

void bind_runs(pybind11::module_& module);

}  // namespace tofray::python
