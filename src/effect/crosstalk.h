// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tofray::effect {

/// Light of a pixel that its neighbours collect.                                                           [theory: crosstalk]
struct Crosstalk {
  template <class Pixel>
  static bool on(const Pixel& pixel) {
    return pixel.crosstalk_left_right > 0 || pixel.crosstalk_up_down > 0;
  }
  /// Of the pixels along one edge alone.
  template <class Pixel>
  static void bin(Pixel& pixel, int n) {
    pixel.crosstalk_left_right /= n, pixel.crosstalk_up_down /= n;
  }
  /// What of a pixel's light it and its two neighbours collect: (e, 1 − 2e, e).
  struct Shares {
    double before, own, after;
  };
  struct Kernel {
    Shares row, column;
  };
  template <class Pixel>
  static Kernel shares(const Pixel& pixel) {
    const double a = pixel.crosstalk_left_right, b = pixel.crosstalk_up_down;
    return {{a, 1 - 2 * a, a}, {b, 1 - 2 * b, b}};
  }
};

}  // namespace tofray::effect
