// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "camera/pixel/modulations.h"
#include "camera/pixel/pixel_patterns.h"
#include "camera/pixel/view.h"
#include "camera/readout/image_camera.h"

namespace tofray::camera {

/// Dark electrons of a tap per second, at the camera's temperature.
double dark_current(const Camera& camera);

/// The sensor: raw frames with their gates, and what its effects read. Owns what the view points to. Not copied.
class FrozenSensor {
 public:
  /// @param profile  whose sensor has all pixels
  /// @param camera   of the image's pixels; has to outlive this: its integration times are read anew
  /// @param orders   of a gate
  /// @param noise    false: expected values
  FrozenSensor(const Camera& profile, const ImageCamera& camera, const Modulations& modulations, int orders, std::uint64_t seed,
               bool noise);
  FrozenSensor(const FrozenSensor&) = delete;
  FrozenSensor& operator=(const FrozenSensor&) = delete;

  [[nodiscard]] const SensorView& view() const { return view_; }
  /// In a frame that starts at time t [s]: temperature drift and another camera's light depend on that, and on the frame's number and seed
  /// what is drawn of the latter. Where either is there, a view is good until the next call.
  /// @param seed  of this frame, in place of the camera's
  const SensorView& at(double time_s, std::uint64_t index, std::optional<std::uint64_t> seed);
  /// Exposes each raw frame for as long as the camera says now; the views stay where they are.
  void take_integration_times();
  /// Start of each raw frame after the start of its frame [s].
  [[nodiscard]] const std::vector<double>& raw_frame_start_s() const { return start_; }
  /// Whether all gates stay at quarter turns.
  [[nodiscard]] bool at_quarter_turns() const;

 private:
  void freeze_raw_frames();
  [[nodiscard]] double gate_phase(std::size_t raw_frame) const;
  void freeze_gates(double half_path_m);
  void freeze_other_camera(double time_s, std::uint64_t index);
  void freeze_read_curve();

  const ImageCamera& camera_;
  const Modulations& modulations_;
  int orders_;
  PixelPatterns patterns_;
  SensorView view_{};
  std::vector<RawFrameView> raw_frames_;
  std::vector<float> gates_, other_gates_;
  std::vector<float> read_;  // the curve of nonlinearity
  std::vector<double> start_;
  num::RoundKeys keys_{};  // of the camera's seed
  double drifted_m_ = 0;   // half path for which the gates were made
};

}  // namespace tofray::camera
