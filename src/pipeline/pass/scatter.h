// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/gather.h"
#include "pipeline/pass/pass.h"

/// Light that lens and filter scatter over the sensor, and what neighbours then collect of it, as passes over the light image.
///                                                                                           [theory: lens-scatter, crosstalk]
/// Each value is a sum in the order of its sources' rows and columns, whatever the machine. Nothing comes in from beyond the edges, and what
/// goes there is lost.
namespace tofray::pipeline {

/// A value of each pixel of a row, x to x + count − 1.
struct RowPart {
  int x, y, count;
};

/// Σ_x' from(x', y)·K(x − x'), x' ascending.
/// @param weights  K(0)
template <class F>
TOFRAY_INLINE F along_row(const float* row, int width, int x, int radius, const float* weights, F sum) {
  const int first = x - radius > 0 ? x - radius : 0, end = x + radius + num::lanes<F>;
  const int last = (end < width ? end : width) - 1;
  for (int at = first; at <= last; ++at) sum = num::fma(F(row[at]), num::load<F>(weights + (x - at), num::lanes<F>), sum);
  return sum;
}

/// Of one plane of the image: a separable kernel's first half.
template <class F>
TOFRAY_INLINE void scatter_row(const camera::ScatterTerm& term, int width, const RowPart& p, const float* from, float* to) {
  const float* middle = term.weights + camera::ScatterTerm::pad + term.radius;
  const int row = p.y * width;
  num::store(to + row + p.x, along_row<F>(from + row, width, p.x, term.radius, middle, F(0.0f)), p.count);
}

/// Its second half, or a whole kernel that is not separable. What is scattered is added to what the terms before have brought.
template <class F>
TOFRAY_INLINE void scatter_column(const camera::ScatterView& s, int item, int width, int height, const RowPart& p, const float* from,
                                  const float* rows, float* to) {
  const camera::ScatterTerm& term = s.term[item];
  const int at = p.y * width + p.x, radius = term.radius;
  const int first = p.y - radius > 0 ? p.y - radius : 0, last = p.y + radius < height ? p.y + radius : height - 1;
  F sum = F(0.0f);
  if (!s.is_sharing(item)) sum = item == 0 ? num::load<F>(from + at, p.count) * F(s.kept) : num::load<F>(to + at, p.count);
  if (s.has_rows(item)) {
    for (int y = first; y <= last; ++y)
      sum = num::fma(num::load<F>(rows + y * width + p.x, p.count), F(term.column[radius + p.y - y]), sum);
  } else {
    constexpr int pad = camera::ScatterTerm::pad;
    const int stride = 2 * (radius + pad) + 1;
    for (int y = first; y <= last; ++y) {
      const float* middle = term.weights + (radius + p.y - y) * stride + pad + radius;
      sum = along_row<F>(from + y * width, width, p.x, radius, middle, sum);
    }
  }
  num::store(to + at, sum, p.count);
}

/// Where some pixels side by side lie in their row.
TOFRAY_INLINE RowPart row_part(const PassWork& w, const Pixels& p) { return {p.index % w.s.lens.width, p.index / w.s.lens.width, p.count}; }

/// Calls plane(from, rows, to) for each plane of the image, with what is scattered, what is scattered along rows alone, and all of it.
template <class Plane>
TOFRAY_INLINE void each_scattered_plane(const PassWork& w, const Plane& plane) {
  const flow::LightImage& image = w.job.light;
  const std::int64_t pixels = std::int64_t{w.s.lens.width} * w.s.lens.height;
  const int planes = image.times * light_planes(w.s, image.times);
  const bool anew = w.item > 0 && w.s.scatter.is_sharing(w.item);
  for (int i = 0; i < planes; ++i)
    plane((anew ? image.scattered : image.values) + i * pixels, image.rows + i * pixels, image.scattered + i * pixels);
}

/// The light image along rows.
struct ScatterRows {
  static constexpr const char* name = "scatter_rows";
  static constexpr const char* does = "scattered light along rows";
  static constexpr Over over = Over::rows;
  static constexpr int most_threads = most_block_threads;

  template <class F>
  TOFRAY_INLINE static void pixels(const PassWork& w, const Pixels& p) {
    const int width = w.s.lens.width;
    const RowPart part = row_part(w, p);
    each_scattered_plane(w, [&](const float* from, float* rows, float*)
                                TOFRAY_LAMBDA { scatter_row<F>(w.s.scatter.term[w.item], width, part, from, rows); });
  }
};

/// The light image along columns; with a kernel that is not separable along both at once.
struct ScatterColumns {
  static constexpr const char* name = "scatter_columns";
  static constexpr const char* does = "scattered light along columns, or both at once";
  static constexpr Over over = Over::rows;
  static constexpr int most_threads = most_block_threads;

  template <class F>
  TOFRAY_INLINE static void pixels(const PassWork& w, const Pixels& p) {
    const int width = w.s.lens.width;
    const RowPart part = row_part(w, p);
    each_scattered_plane(w, [&](const float* from, float* rows, float* to)
                                TOFRAY_LAMBDA { scatter_column<F>(w.s.scatter, w.item, width, w.s.lens.height, part, from, rows, to); });
  }
};

}  // namespace tofray::pipeline
