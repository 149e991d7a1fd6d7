// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/setup.h"

/// What can be done to a frame, one after the other, each over all its pixels before the next begins. A pass is a type in one
/// file of this folder, which list.h names:
///
///     P::name            as plans, profilers and errors of a GPU say it
///     P::does            … and what it does, for people
///     P::over            what a worker of the processor takes at once
///     P::most_threads    of a block of a GPU: fewer where the kernel takes more registers than a block of the largest size has for each
///     P::pixels<F>(w, p) the pass for some pixels side by side, on any machine
///     P::row<F>(w, y)    … for a row of the image, where packs side by side are not all that there is to it
///     P::rays(s, item)   rays that each pixel sends, for the progress of a frame, where it is not one
///     P::when            when a frame takes it, and P::wanted(s, job, entry) whether, where it has a step of its own over the image
///
/// plan.h has the order: the steps of light's way by their names, and where those with P::when come in.
namespace tofray::pipeline {

struct Input;

/// What a worker of the processor takes at once.
enum class Over {
  scene,       ///< (a GPU alone has this pass)
  tiles,       ///< of the image, in packs of pixels side by side
  rows,        ///< a band of the image's rows
  raw_frames,  ///< one of them
};

/// When a frame takes a pass that has a step of its own over the image. Of those at one time the first in the list is first.
enum class When {
  before_pixels,  ///< before the raw frames of any pixel
  after_pixels,   ///< once the depth of all pixels is known
  over_depth,     ///< later, over z, behind a filter that keeps edges; pixels that then fly are written as invalid
};

constexpr int most_block_threads = 1024;  ///< threads in the largest block of a GPU
constexpr int heavy_block_threads =
    256;  ///< threads in the largest block of a kernel that takes more registers than a block of most_block_threads has for each

constexpr std::int32_t of_filter = 1;  ///< `item` of the pass WriteDepth: it takes what the filter left

/// What a pass does, and with what.
struct PassWork {
  const Setup& s;
  const Job& job;
  const Input* input;  ///< what came from elsewhere, or is in the light image
  std::int32_t item;   ///< which sample of the pixel, which kernel of the lens, which round of paths, whether the range is a filter's
  Pixels next{0, 0};   ///< those that come after, whose memory may be fetched meanwhile; count 0: not known
};

}  // namespace tofray::pipeline
