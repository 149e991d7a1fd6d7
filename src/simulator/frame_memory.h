// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

#include "camera/readout/image_camera.h"
#include "flow/frame_view.h"
#include "pipeline/setup.h"
#include "tofray/camera.h"
#include "tofray/frame.h"
#include "tofray/simulator.h"

namespace tofray::simulator {

/// Gives the arrays their sizes (nothing is allocated anew where they fit) and writes what is the same for all pixels.
/// @param transport  of the scene; none (as it is fresh) where the light comes from elsewhere
void prepare(Frame& frame, const camera::ImageCamera& camera, const SimulatorOptions& options, const Transport& transport);
/// Gives the arrays of a depth frame alone their sizes.
/// @param camera  as it is read out
void prepare(Depth& depth, const camera::ImageCamera& camera, const SimulatorOptions& options);
/// Whether an array is asked for by its name.
bool asks_for(const SimulatorOptions& options, std::string_view array);
/// The last stage that any of the arrays of a frame comes from: stages behind it are not computed.
Stage last_stage_of(const camera::ImageCamera& camera, const SimulatorOptions& options, const Transport& transport);
/// Where the arrays are that have a size, of the stages up to `last`.
flow::FrameView view_of(Frame& frame, Stage last);
flow::FrameView view_of(Depth& depth);
/// How a frame's electrons and codes are written. Past the caches where they lie elsewhere than those of the frame before, or are more than
/// caches hold: whoever reads them would fetch them from memory anyway, and what the caches have stays there. Their rows must be whole lines
/// of the cache: half a line costs more than it saves.
/// @param before  tap_a of the frame before; null: there was none
pipeline::TapStores tap_stores(const flow::FrameView& out, const float* before, int width, const flow::FrameSize& size);
/// A frame's arrays under their public names.
FrameArrays arrays_of(const flow::FrameView& view, const camera::ImageCamera& camera, std::int64_t bins, std::uint64_t index, int device);

}  // namespace tofray::simulator
