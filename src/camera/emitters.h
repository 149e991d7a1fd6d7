// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tofray/camera.h"

namespace tofray::camera {

/// The same camera with point sources in place of its lights: what kernels, arrays of one's own and the decoder count as a light each.
/// Of a camera that has nothing else it is the camera itself.
Camera with_emitters(const Camera& camera);

}  // namespace tofray::camera
