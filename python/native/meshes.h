// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

#include <memory>

/// TriangleMesh, ReflectivityMap, VectorMap and MeshMotion: what scenes share, and what therefore never changes.
namespace tofray::python {

namespace py = pybind11;

void bind_meshes(py::module_& module);

/// What a function of the user's raised while a frame was computed: the exception that the call ends with.
std::shared_ptr<py::error_already_set>& pending_callback_fault();
/// Raises it, if there is one. Needs the interpreter's lock.
void raise_callback_fault();

}  // namespace tofray::python
