// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/readout/image_camera.h"
#include "flow/frame_view.h"
#include "pipeline/setup.h"
#include "tofray/camera.h"

/// What comes into a region from pixels that are not read: light that the lens scatters, charge that neighbours share, what full wells spill.
/// So a frame of a region is computed with as much of the sensor round it as that takes, and cut.
namespace tofray::simulator {

/// Pixels of the image beside the region that is read.
struct Border {
  int left = 0, top = 0, right = 0, bottom = 0;
  [[nodiscard]] bool any() const { return left + top + right + bottom > 0; }
};

/// How many on each side: as far as something can come from, and as the sensor goes.
/// @param profile  was seen to be good
Border border_of(const Camera& profile);
/// The camera that reads these, too.
Camera with_border(const Camera& profile, const Border& border);
Camera without_border(const Camera& profile, const Border& border);
/// Where the region lies in the image of that camera.
pipeline::Region region_of(const camera::ImageCamera& image, const Border& border);

/// Copies the region of each array that both have.
/// @param wide    size of the images with the border
/// @param region  within them
void cut(const flow::FrameView& from, const flow::FrameSize& wide, int wide_width, const pipeline::Region& region, flow::FrameView& to);

}  // namespace tofray::simulator
