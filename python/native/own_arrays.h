// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

#include "tofray/stages.h"

/// tofray.Geometry, PixelLight and Transient: arrays of one's own in the place of what the first stages find.
namespace tofray::python {

Geometry geometry_from_python(pybind11::handle value);
PixelLight light_from_python(pybind11::handle value);
Transient transient_from_python(pybind11::handle value);

}  // namespace tofray::python
