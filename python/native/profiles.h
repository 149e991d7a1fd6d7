// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

namespace tofray::python {

/// profile_file() for Python: what `fit` may vary, and where it is written.
void bind_profiles(pybind11::module_& module);

}  // namespace tofray::python
