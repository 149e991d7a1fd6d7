// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/emitters.h"

namespace tofray::camera {

namespace {

void append_emitters(const Illumination& light, std::vector<Illumination>& out) { out.push_back(light); }

}  // namespace

Camera with_emitters(const Camera& camera) {
  Camera out = camera;
  out.illumination.clear();
  for (const Illumination& light : camera.illumination) append_emitters(light, out.illumination);
  return out;
}

}  // namespace tofray::camera
