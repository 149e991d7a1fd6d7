// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tofray::effect {

/// Gains, offsets, delays and phases that differ from pixel to pixel.                  [theory: phase-offset, binned-patterns]
struct PixelPatterns {
  /// Of n × n pixels that are read together gains, delays and phases are means, and offsets, in codes, a sum.
  template <class Pixel>
  static void bin(Pixel& pixel, int n) {
    pixel.prnu /= n, pixel.delay_s /= n, pixel.phase_offset_rad /= n, pixel.dsnu_dn *= n;
  }
};

}  // namespace tofray::effect
