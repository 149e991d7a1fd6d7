// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "pictures/painter.h"
#include "pictures/picture_scale.h"
#include "pictures/pictures.h"

namespace tofray::pictures {

/// Looks of all our figures, in pixels.
namespace figure {
inline constexpr Rgb background{23, 24, 28}, ink{226, 228, 232}, faint_ink{150, 154, 162};
inline constexpr int margin = 26;
inline constexpr double title_size = 13, label_size = 9, note_size = 9.5;
inline constexpr int bar_gap = 12, bar_width = 14, label_width = 58, label_gap = 10;
}  // namespace figure

/// Colours of a figure's writing and of its invalid pixels.
struct Look {
  Rgb background, ink, faint_ink;
  Rgb invalid;  ///< of no particular reason
};
const Look& look_of(Theme theme);
/// Of pixels that are invalid for a reason: none looks like a depth.
Rgb color_of_reason(const FlagRow& reason, Theme theme);

/// How values of one quantity become colours.
struct ValueColors {
  PictureScale scale;
  std::function<Rgb(double value)> color;     ///< of a finite value
  std::function<double(double value)> place;  ///< where a value stands on the bar, 0 low, 1 high
};

/// Colours of an image's values; NaN is `invalid`.
std::vector<Rgb> colored(const std::vector<double>& values, const ValueColors& colors, Rgb invalid);

/// How wide a bar is with its labels.
int width_with_labels(const PictureScale& scale);

/// A vertical bar with ticks and labels to its right.
void draw_scale_bar(Painter& painter, int x, int y, int height, const ValueColors& colors, const Look& look);

/// By how much an image of this width is enlarged to be about `wanted` pixels wide: 1…8.
int enlargement(int width, int wanted);

}  // namespace tofray::pictures
