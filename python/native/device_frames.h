// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

#include <memory>

#include "tofray/tofray.h"

/// Frames that stay in a GPU's memory, for libraries that compute there: CUDA's array interface (version 3) and DLPack.
namespace tofray::python {

namespace py = pybind11;

/// What Python's DeviceFrames holds; its arrays keep it alive. At least one frame.
struct DeviceBatch {
  std::shared_ptr<const DeviceFrames> frames;
};

void bind_device_frames(py::module_& module);

}  // namespace tofray::python
