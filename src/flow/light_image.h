// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/num.h"

namespace tofray::flow {

/// The light of all pixels, between stages 2 and 3: where a pixel's light is a sum that one look at the scene does not give, it is gathered
/// here. All of it is linear: sums of images are images of sums.                                    [theory: light-image]
///
/// Planes: S, the ambient rate, then of each modulation frequency what flow::Light has of it: in_phase and quarter where those are enough
/// (PhasorView::sums_alone), else all orders' real parts, then all imaginary ones. Where something moves there is a time for each raw frame,
/// which has but its own modulation frequency. Where light bounces, `values` is all of it in the end, and `before` the direct light.
/// Where samples within the pixels are compared, three planes follow: the share of samples that see what the pixel's middle sees, and the
/// nearest and farthest range [m] that they see (3e38 and 0: they see nothing).
struct LightImage {
  float* values;           ///< [time][plane][height][width]; null: there is none
  float* before;           ///< `values` before the last sample was added: what is written is never read, so that it may be written twice
  float* rows;             ///< `values`, scattered along rows alone; null where the lens scatters nothing
  float* scattered;        ///< `values`, scattered along rows and columns: what reaches the pixels; null where the lens scatters nothing
  float* indirect;         ///< light that has met more than one surface, in the shape of `values`; null where light does not bounce
  float* indirect_before;  ///< `indirect` before the last sample was added
  float*
      guide;  ///< [7][height][width] position [m], normal and reflectivity of what a pixel sees, 0: nothing; or null: neighbours are not compared
  float* error;           ///< [modulation][height][width] paths·(error across Ẑ)² [e⁻²], as two halves of the paths show it; or null
  float* noise;           ///< [modulation][height][width] variance across Ẑ [e⁻²], of many pixels together; or null
  float* smoothed_noise;  ///< `noise` once the light is smoothed; or null
  std::int32_t* goal;     ///< [height][width] paths that a pixel shall have; null: all as many
  std::int32_t halves;    ///< 1: behind the indirect light is half the difference of what two halves of its paths say
  std::int32_t times;     ///< 1, or one for each raw frame
  std::int32_t* object;   ///< [height][width] that the sample which is looked at now sees, or null: they are not compared
  float* range;           ///< [height][width] likewise
  bool operator==(const LightImage&) const = default;
};
constexpr int compared_planes = 3;
constexpr int guide_planes = 7;

}  // namespace tofray::flow
