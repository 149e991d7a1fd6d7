// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

/// Pictures of other renderers along the camera's rays.
namespace tofray::python {

void bind_rendered(pybind11::module_& module);

}  // namespace tofray::python
