// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/border.h"

#include <algorithm>
#include <cmath>

#include "camera/lens/frozen_scatter.h"
#include "camera/readout/image_camera.h"

namespace tofray::simulator {

namespace {

/// From how many pixels away something comes.
int reach(const camera::ImageCamera& image) {
  int out = camera::scattered_radius(image.lens.scatter);
  if (image.pixel.crosstalk_left_right > 0 || image.pixel.crosstalk_up_down > 0) ++out;
  return out + (image.pixel.blooming_share > 0 ? 1 : 0);
}

/// Of one side of the sensor.
int room(int pixels, int binning, int wanted) { return std::clamp(pixels / binning, 0, wanted); }

template <class T>
void cut_array(const T* from, T* to, ArrayShape shape, const flow::FrameSize& wide, int wide_width, const pipeline::Region& region) {
  if (from == nullptr || to == nullptr) return;
  const std::int64_t each = flow::values_of_pixel(shape), images = flow::values_of(shape, wide) / (each * wide.pixels);
  for (std::int64_t image = 0; image < images; ++image) {
    for (int y = 0; y < region.height; ++y) {
      const T* const row = from + (image * wide.pixels + std::int64_t{region.top + y} * wide_width + region.left) * each;
      to = std::copy_n(row, region.width * each, to);
    }
  }
}

/// The camera that reads a border, too.
/// @param sign  −1: the border is taken away
Camera moved_by(const Camera& profile, const Border& border, int sign) {
  if (!border.any()) return profile;
  const camera::ImageCamera image(profile);
  Camera out = profile;
  Readout& r = out.readout;
  r.left -= sign * border.left * r.binning, r.top -= sign * border.top * r.binning;
  r.width = (image.sensor.width + sign * (border.left + border.right)) * r.binning;
  r.height = (image.sensor.height + sign * (border.top + border.bottom)) * r.binning;
  return out;
}

}  // namespace

Border border_of(const Camera& profile) {
  const Readout& r = profile.readout;
  const camera::ImageCamera image(profile);
  const int wanted = reach(image), n = r.binning;
  if (wanted == 0) return {};
  const int right = profile.sensor.width - r.left - image.sensor.width * n,
            bottom = profile.sensor.height - r.top - image.sensor.height * n;
  return {room(r.left, n, wanted), room(r.top, n, wanted), room(right, n, wanted), room(bottom, n, wanted)};
}

Camera with_border(const Camera& profile, const Border& border) { return moved_by(profile, border, 1); }
Camera without_border(const Camera& profile, const Border& border) { return moved_by(profile, border, -1); }

pipeline::Region region_of(const camera::ImageCamera& image, const Border& border) {
  if (!border.any()) return {};
  return {border.left, border.top, image.sensor.width - border.left - border.right, image.sensor.height - border.top - border.bottom};
}

void cut(const flow::FrameView& from, const flow::FrameSize& wide, int wide_width, const pipeline::Region& region, flow::FrameView& to) {
#define TOFRAY_CUT(name, part, member, element, shape, ...) cut_array(from.name, to.name, ArrayShape::shape, wide, wide_width, region);
  TOFRAY_IMAGE_ARRAYS(TOFRAY_CUT)
#undef TOFRAY_CUT
}

}  // namespace tofray::simulator
