// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "support/sanitizers.h"
#include "tofray/tofray.h"

namespace tofray::test {

/// A camera of the same view on a quarter of the pixels, with tiles that are cut at the right and below: each pixel takes its time under
/// qemu and sanitizers.
inline Camera quarter(Camera camera) {
  Lens& lens = camera.lens;
  camera.sensor.width /= 2, camera.sensor.height /= 2;
  lens.fx_px /= 2, lens.fy_px /= 2;
  lens.cx_px = (lens.cx_px + 0.5) / 2 - 0.5, lens.cy_px = (lens.cy_px + 0.5) / 2 - 0.5;
  return camera;
}

/// A scene's camera; of a quarter of its pixels for a sanitizer, which sees in them what it would see in all.
inline Camera camera_of(const Scene& scene) {
  const Camera camera = load_camera(scene);
  return with_sanitizers ? quarter(camera) : camera;
}

}  // namespace tofray::test
