// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/num.h"
#include "tofray/frame_arrays.h"

namespace tofray::flow {

/// Where the arrays are that kernels write, under their names in files. A null pointer: not wanted.
struct FrameView {
#define TOFRAY_POINTER(name, part, member, element, ...) element* name;
  TOFRAY_IMAGE_ARRAYS(TOFRAY_POINTER)
#undef TOFRAY_POINTER
  bool operator==(const FrameView&) const = default;
};

#define TOFRAY_ONE_MORE(...) +1
constexpr int array_count = 0 TOFRAY_IMAGE_ARRAYS(TOFRAY_ONE_MORE);
#undef TOFRAY_ONE_MORE

/// Calls visit(pointer, shape, stage that writes it) for each array of a view, in the table's order.
template <class View, class Visit>
TOFRAY_INLINE void each_array(View& view, const Visit& visit) {
#define TOFRAY_VISIT(name, part, member, element, shape, stage, ...) visit(view.name, ArrayShape::shape, Stage::stage);
  TOFRAY_IMAGE_ARRAYS(TOFRAY_VISIT)
#undef TOFRAY_VISIT
}

/// How large a frame's arrays are.
struct FrameSize {
  std::int64_t pixels, phases, bins, modulations;
  bool operator==(const FrameSize&) const = default;
};
/// Values of each pixel in each image of an array.
TOFRAY_INLINE std::int64_t values_of_pixel(ArrayShape shape) {
  return shape == ArrayShape::vectors ? 3 : shape == ArrayShape::pairs || shape == ArrayShape::moved ? 2 : 1;
}
/// Values of an array; `list` lies on the host alone and is none of these.
TOFRAY_INLINE std::int64_t values_of(ArrayShape shape, const FrameSize& size) {
  const std::int64_t pixels = size.pixels;
  switch (shape) {
    case ArrayShape::stack: return size.phases * pixels;
    case ArrayShape::moved: return 2 * size.phases * pixels;
    case ArrayShape::by_frequency: return size.modulations * pixels;
    case ArrayShape::bins: return size.bins * pixels;
    case ArrayShape::vectors: return 3 * pixels;
    case ArrayShape::pairs: return 2 * pixels;
    default: return pixels;
  }
}

}  // namespace tofray::flow
