// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

#include <memory>

#include "tofray/tofray.h"

/// A frame's memory, and its arrays as views of it.
namespace tofray::python {

namespace py = pybind11;

/// What Python's Frame holds: its arrays keep it alive, and so does the frame itself.
struct FrameMemory {
  std::shared_ptr<Frame> frame;
};

void bind_frames(py::module_& module);

/// Takes away the images that no stage computed: they would be offered as data, all zero. @param last  the last one that did
void leave_out_after(Stage last, Frame& frame);

/// Raw data out of a tofray.Raw's arrays.
Raw raw_from_python(py::handle value);
/// A frame out of a tofray.Frame's arrays: those that are of this frame already, or copies. Its parts agree in their sizes.
std::shared_ptr<Frame> frame_from_python(py::handle value);

}  // namespace tofray::python
