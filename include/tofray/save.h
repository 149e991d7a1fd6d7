// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "tofray/camera.h"
#include "tofray/frame.h"
#include "tofray/scene.h"
#include "tofray/simulator.h"

/// Frames as files. As load.h, of libtofray_files.
namespace tofray {

/// The bytes of frame.npz as the command line writes it: every array that the frame has, the camera's numbers, and `meta`. The same
/// arguments give the same bytes.
/// @param compress  deflated in place of stored
std::string frame_npz(const Frame& frame, const Scene& scene, const Camera& camera, const SimulatorOptions& options = {},
                      bool compress = false);

}  // namespace tofray
