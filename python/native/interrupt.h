// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

#include <csignal>

#include "tofray/simulator.h"

/// Ctrl-C while C++ computes. Python's own handler only notes the signal and acts between two of its instructions, of which there are none
/// meanwhile: for so long, ours stands before it and tells the simulator to stop.
namespace tofray::python {

class StopOnInterrupt {
 public:
  /// Does nothing but in the main thread, where Python acts on signals, and where somebody listens to SIGINT.
  explicit StopOnInterrupt(FrameProgress& progress);
  ~StopOnInterrupt();
  StopOnInterrupt(const StopOnInterrupt&) = delete;
  StopOnInterrupt& operator=(const StopOnInterrupt&) = delete;

 private:
  FrameProgress* outer_ = nullptr;
  bool installed_ = false;
};

/// Whether Python runs signal handlers in this thread. Needs the interpreter's lock.
bool is_main_thread();

}  // namespace tofray::python
