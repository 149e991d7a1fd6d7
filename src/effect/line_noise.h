// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "effect/adc.h"

namespace tofray::effect {

/// Noise of columns and rows: one draw for all pixels of a line, another one in each raw frame.          [theory: column-noise]
///
/// A frame has few lines and many pixels, so that each line is drawn once, before the first pixel is exposed: standard normals
/// [raw_frames][width + height], columns first.
struct LineNoise {
  struct View {
    float column_noise, row_noise;  ///< [DN]
    std::int32_t lines_are_noisy;   ///< 1: columns or rows have noise
    bool operator==(const View&) const = default;
  };
  template <class Camera>
  static void set(const Camera& camera, View& s) {
    const double step = Adc::step_of(camera);
    s.column_noise = static_cast<float>(camera.pixel.column_noise_e / step);
    s.row_noise = static_cast<float>(camera.pixel.row_noise_e / step);
    s.lines_are_noisy = s.column_noise > 0 || s.row_noise > 0;
  }
  static bool on(const View& s) { return s.lines_are_noisy != 0; }
  /// The amplifier's, which reads once.
  template <class Pixel>
  static void bin(Pixel&, int) {}
  template <class Camera>
  static double variance(const Camera& camera) {
    const double column = camera.pixel.column_noise_e, row = camera.pixel.row_noise_e;
    return column * column + row * row;
  }
  /// Variance of A−B by column and row noise [e²], out of a view, whose numbers are codes.
  template <class Sensor>
  static double variance_as_set(const Sensor& s) {
    const double step = static_cast<double>(s.step), column = static_cast<double>(s.column_noise), row = static_cast<double>(s.row_noise);
    return step * step * (column * column + row * row);
  }

  template <class Sensor>
  TOFRAY_INLINE static bool draws_lines(const Sensor& s) {
    return s.lines_are_noisy != 0 && s.noise != Noise::off;
  }
  /// Lines of a raw frame.
  template <class Sensor>
  TOFRAY_INLINE static int lines_of(const Sensor& s) {
    return s.width + s.height;
  }
  /// Draws of all lines of a frame.
  template <class Sensor>
  TOFRAY_INLINE static int line_draws(const Sensor& s) {
    return draws_lines(s) ? s.raw_frames * lines_of(s) : 0;
  }

  /// Draws some neighbouring lines of one kind.
  /// @param kind     of_column or of_row
  /// @param normals  of the frame
  template <class F, class Sensor>
  TOFRAY_INLINE static void draw_lines(const Sensor& s, int k, FrameIndex index, Purpose kind, int first, int count, float* normals) {
    const num::Random4<F> words = draw<F>(s, num::Int<F>(first) + num::lane_index<F>(), k, index, kind);
    F normal, other;
    num::normal_pair<F>(words.w[0], words.w[1], normal, other);
    num::store(normals + k * lines_of(s) + (kind == of_row ? s.width : 0) + first, normal, count);
  }
  /// Draw number `number` of a frame: that of one line.
  template <class Sensor>
  TOFRAY_INLINE static void draw_line(const Sensor& s, FrameIndex index, int number, float* normals) {
    const int k = number / lines_of(s), line = number % lines_of(s);
    const bool row = line >= s.width;
    draw_lines<float>(s, k, index, row ? of_row : of_column, row ? line - s.width : line, 1, normals);
  }
  /// All lines of one kind in raw frame k.
  /// @param count  how many there are
  template <class F, class Sensor>
  TOFRAY_INLINE static void draw_all_lines(const Sensor& s, int k, FrameIndex index, Purpose kind, int count, float* normals) {
    for (int i = 0; i < count; i += num::lanes<F>) {
      draw_lines<F>(s, k, index, kind, i, count - i < num::lanes<F> ? count - i : num::lanes<F>, normals);
    }
  }

  template <class Sensor>
  TOFRAY_INLINE static LinesOfPack lines_through(const Sensor& s, const flow::Pixels& p, const float* normals) {
    if (!draws_lines(s)) return {nullptr, nullptr, 0};
    return {normals + p.index % s.width, normals + s.width + p.index / s.width, p.count};
  }
  /// Adds that of a pixel's column and of its row to the ADC's offset.
  template <bool drawn, class F, class Sensor, class Kept>
  TOFRAY_INLINE static void change_charge(const Sensor& s, const RawFrameView&, int k, FrameIndex, Kept& e, Chain<F>& chain) {
    if (!drawn || e.lines.columns == nullptr) return;
    const int at = k * lines_of(s);
    const F of_columns = num::fma(F(s.column_noise), num::load<F>(e.lines.columns + at, e.lines.count), chain.offset);
    chain.offset = num::fma(F(s.row_noise), F(e.lines.row[at]), of_columns);
  }
};

}  // namespace tofray::effect
