// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/lens/view.h"

namespace tofray::camera {

/// View ray of each pixel, lens undistorted.
template <class F>
TOFRAY_INLINE flow::Ray<F> ray(const LensView& lens, const flow::Pixels& p) {
  const F x = num::load<F>(lens.ray_x + p.index, p.count), y = num::load<F>(lens.ray_y + p.index, p.count);
  return {x, y, F(1.0f), flow::square_of(x, y, F(1.0f)), num::load<F>(lens.inverse_length + p.index, p.count)};
}

/// Says early whose rays will be asked for: a frame's arrays have driven the lens out of the near caches since the frame before.
template <class F>
TOFRAY_INLINE void fetch_lens(const LensView& lens, const flow::Pixels& p) {
  num::fetch<F>(lens.ray_x, p.index, p.count), num::fetch<F>(lens.ray_y, p.index, p.count);
  num::fetch<F>(lens.inverse_length, p.index, p.count), num::fetch<F>(lens.vignetting, p.index, p.count);
}

template <class F>
TOFRAY_INLINE F vignetting(const LensView& lens, const flow::Pixels& p) {
  return num::load<F>(lens.vignetting + p.index, p.count);
}

}  // namespace tofray::camera
