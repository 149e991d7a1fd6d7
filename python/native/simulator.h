// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

#include "tofray/tofray.h"

/// Simulator and process() for Python: the interpreter's lock is free while they compute, and Ctrl-C ends them.
namespace tofray::python {

namespace py = pybind11;

void bind_simulator(py::module_& module);

/// SimulatorOptions out of a dict of words. @throws Error (bad_input) that names the word
SimulatorOptions options_from_python(const py::dict& words);

}  // namespace tofray::python
