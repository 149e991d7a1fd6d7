// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "flow/frame_view.h"
#include "tofray/camera.h"
#include "tofray/frame.h"

namespace tofray::simulator {

/// Gives the arrays their sizes (nothing is allocated anew where they fit) and writes what is the same for all pixels.
void prepare(Frame& frame, const Camera& camera, bool truth);
void prepare(Depth& depth, int width, int height);
/// Where the arrays are.
flow::FrameView view_of(Frame& frame);
flow::FrameView view_of(Depth& depth);

}  // namespace tofray::simulator
