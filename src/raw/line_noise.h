// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "raw/charge.h"

/// Noise of columns and rows: one draw for all pixels of a line, another one in each raw frame.              [theory: eq. 3.15]
///
/// A frame has few lines and many pixels, so that each line is drawn once, before the first pixel is exposed: standard normals
/// [raw_frames][width + height], columns first.
namespace tofray::raw {

TOFRAY_FN bool draws_lines(const camera::SensorView& s) { return s.lines_are_noisy != 0 && s.noise != Noise::off; }

/// Lines of a raw frame.
TOFRAY_FN int lines_of(const camera::SensorView& s) { return s.width + s.height; }
/// … of all of a frame.
TOFRAY_FN int line_draws(const camera::SensorView& s) { return draws_lines(s) ? s.raw_frames * lines_of(s) : 0; }

/// Draws some neighbouring lines of one kind.
/// @param kind     of_column or of_row
/// @param normals  of the frame
template <class F>
TOFRAY_FN void draw_lines(const camera::SensorView& s, int k, FrameIndex index, Purpose kind, int first, int count, float* normals) {
  const num::Random4<F> words = draw<F>(s, num::Int<F>(first) + num::lane_index<F>(), k, index, kind);
  F normal, other;
  num::normal_pair<F>(words.w[0], words.w[1], normal, other);
  num::store(normals + k * lines_of(s) + (kind == of_row ? s.width : 0) + first, normal, count);
}

/// Draw number `number` of a frame: that of one line.
TOFRAY_FN void draw_line(const camera::SensorView& s, FrameIndex index, int number, float* normals) {
  const int k = number / lines_of(s), line = number % lines_of(s);
  const bool row = line >= s.width;
  draw_lines<float>(s, k, index, row ? of_row : of_column, row ? line - s.width : line, 1, normals);
}

/// All lines of one kind in raw frame k.
/// @param count  how many there are
template <class F>
TOFRAY_FN void draw_all_lines(const camera::SensorView& s, int k, FrameIndex index, Purpose kind, int count, float* normals) {
  for (int i = 0; i < count; i += num::lanes<F>) {
    draw_lines<F>(s, k, index, kind, i, count - i < num::lanes<F> ? count - i : num::lanes<F>, normals);
  }
}

/// What the first raw frame's lines through a pack add to it; null: nothing.
struct LineNoise {
  const float *columns, *row;
  std::int32_t count;  ///< pixels of the pack
};

TOFRAY_FN LineNoise lines_through(const camera::SensorView& s, const flow::Pixels& p, const float* normals) {
  if (!draws_lines(s)) return {nullptr, nullptr, 0};
  return {normals + p.index % s.width, normals + s.width + p.index / s.width, p.count};
}

/// An offset [DN] with those of its column and its row in raw frame k.
template <class F>
TOFRAY_FN F with_line_noise(const camera::SensorView& s, int k, const LineNoise& lines, F offset) {
  if (lines.columns == nullptr) return offset;
  const int at = k * lines_of(s);
  const F of_columns = num::fma(F(s.column_noise), num::load<F>(lines.columns + at, lines.count), offset);
  return num::fma(F(s.row_noise), F(lines.row[at]), of_columns);
}

}  // namespace tofray::raw
