// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/plan.h"
#include "scene/derive.h"

/// What goes from the host to the kernels.
namespace tofray::backend::gpu {

using pipeline::Pass;

/// One frame. All pointers are the device's; `setup.lens.tile` is of patches, not of tiles.
struct alignas(16) FrameArguments {
  pipeline::Setup setup;
  pipeline::Job job;
  bool operator==(const FrameArguments&) const = default;
};
static_assert(sizeof(FrameArguments) % 16 == 0, "kernels copy it in words of 16 bytes");

/// Place of a frame in the random numbers.
struct FrameNumber {
  std::uint32_t low, high;
};

/// Many frames at once. Either all have the same arguments but for their number and place, or each has arguments of its own.
struct Batch {
  const FrameNumber* numbers;  ///< [frame] device
  const FrameArguments* own;   ///< [frame] device; null: the common ones, with frame i's arrays `stride`·i bytes further on
  std::int64_t stride;
  std::int32_t frames;
  scene::Derive derive;  ///< what of the scene is derived anew for each frame
  pipeline::Step step;   ///< what is done to them
};

}  // namespace tofray::backend::gpu
