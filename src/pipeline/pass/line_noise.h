// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "effect/list.h"
#include "pipeline/pass/pass.h"

namespace tofray::pipeline {

/// Draws of the sensor's columns and rows, for all pixels of each.                                  [theory: column-noise]
struct LineNoise {
  static constexpr const char* name = "line_noise";
  static constexpr const char* does = "noise of the sensor's columns and rows";
  static constexpr Over over = Over::raw_frames;
  static constexpr int most_threads = most_block_threads;
  static constexpr When when = When::before_pixels;

  static bool wanted(const Setup& s, const Job&, Stage entry) {
    return s.last_stage >= Stage::raw && entry != Stage::depth && effect::LineNoise::draws_lines(s.sensor);
  }

  TOFRAY_INLINE static effect::FrameIndex frame_of(const PassWork& w) { return {w.job.index_low, w.job.index_high}; }
  /// All lines of raw frame k.
  template <class F>
  TOFRAY_INLINE static void raw_frame(const PassWork& w, int k) {
    const camera::SensorView& sensor = w.s.sensor;
    float* const normals = line_normals_in(w.s, w.job);
    effect::LineNoise::draw_all_lines<F>(sensor, k, frame_of(w), effect::of_column, sensor.width, normals);
    effect::LineNoise::draw_all_lines<F>(sensor, k, frame_of(w), effect::of_row, sensor.height, normals);
  }
  /// One line of one raw frame.
  TOFRAY_INLINE static void line(const PassWork& w, int number) {
    effect::LineNoise::draw_line(w.s.sensor, frame_of(w), number, line_normals_in(w.s, w.job));
  }
};

}  // namespace tofray::pipeline
