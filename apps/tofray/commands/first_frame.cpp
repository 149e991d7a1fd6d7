// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "commands/first_frame.h"

#include "cli/progress.h"
#include "tofray/simulator.h"

namespace tofray::app {

Frame first_frame(const run::Loaded& in, SimulatorOptions wanted) {
  FrameProgress now;
  wanted.progress = &now;
  const Progress progress(1, "frame", false, &now);
  return Simulator(in.scene, in.camera, wanted).frame(0);
}

}  // namespace tofray::app
