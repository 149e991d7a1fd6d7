// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "base/vec.h"
#include "tofray/camera.h"

namespace tofray::camera {

/// The points that stand for an area, each for the same share of it, in the source's frame about the area's middle [m]; of a point source
/// (0, 0, 0). Their mean is the middle. However many they are, no two stand in the same of `points` columns of equal area, nor of as many
/// rows: that makes the shadow of an edge along x or y as smooth as so many points can.   [theory: rectangle-light, disk-light]
std::vector<Vec3> points_of(const Area& area);

}  // namespace tofray::camera
