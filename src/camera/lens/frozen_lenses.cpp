// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/lens/frozen_lenses.h"

#include "camera/lens/subpixel.h"
#include "num/num.h"

namespace tofray::camera {

using num::single;

FrozenLenses::FrozenLenses(const Camera& image, int subpixel, int threads) {
  const Sensor& sensor = image.sensor;
  middle_ = FrozenLens::shared({image.lens, sensor.width, sensor.height, {0, 0}, 1}, threads);
  subpixel_.count = 1;
  if (subpixel == 1) return;
  for (const SubpixelSample& sample : subpixel_samples(sensor, subpixel)) {
    samples_.push_back(
        FrozenLens::shared({image.lens, sensor.width, sensor.height, sample.offset_px, 1.0 / (subpixel * subpixel)}, threads));
    views_.push_back(samples_.back()->view());
    shares_.push_back(single(sample.share));
  }
  subpixel_ = {static_cast<std::int32_t>(samples_.size()), views_.data(), shares_.data()};
}

}  // namespace tofray::camera
