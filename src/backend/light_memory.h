// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/plan.h"

namespace tofray::backend {

/// Gives the light image that a frame needs its places from `base` on (of any machine; null: they are only counted).
/// @param input  null: from the scene on
/// @param kept   it needs one in any case
/// @return bytes; 0: it needs none
std::size_t place_light(const pipeline::Setup& setup, const flow::FrameView& wanted, const pipeline::Input* input, unsigned char* base,
                        flow::LightImage& image, bool kept = false);

/// Where the camera stood for a light image. Of a scene that stands still, the next frame from there has the same.
struct LightOrigin {
  bool known = false;
  bool mixed = false, noise = false;  ///< what else is known of it
  shape::CoordinateFrame camera{};
  bool operator==(const LightOrigin&) const = default;
};
/// Of a frame; what moves, or comes from elsewhere, is not known twice.
LightOrigin light_origin(const pipeline::Setup& setup, const flow::FrameView& wanted, const pipeline::Input* input);

}  // namespace tofray::backend
