// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/pixel/view.h"

namespace tofray::camera {

/// How late pixels are at one modulation frequency [s]: their fixed delay, and their fixed phase there.       [theory: phase-offset]
/// @param from  a SensorView or DecoderView that has delays
template <class F, class View>
TOFRAY_INLINE F late_by(const View& from, int modulation, const flow::Pixels& p) {
  return num::load<F>(from.delay + modulation * from.delay_stride + p.index, p.count);
}

}  // namespace tofray::camera
