// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "camera/decoder/view.h"
#include "camera/light/view.h"
#include "camera/pixel/modulations.h"
#include "camera/pixel/waveform.h"
#include "camera/readout/image_camera.h"

namespace tofray::camera {

/// The correlation's harmonics as depth takes them: those of the mean of all lights, whatever of them is corrected.
///                                                                                                                 [theory: several-lights]
/// @param lights  of the camera, frozen
std::vector<Harmonic> mean_harmonics(const Camera& camera, const std::vector<LightView>& lights, double frequency_hz);

/// What decoding knows of the camera; owns what the view points to. Not copied.
class FrozenDecoder {
 public:
  /// @param camera  of the image's pixels; has to outlive this: its integration times are read anew
  /// @param sensor  whose suppression, nonlinearity and delays it may know; its arrays have to outlive this
  /// @param noise   false: no depth is too noisy
  /// @throws Error (bad_input) where raw frames, light and calibration make no depth
  FrozenDecoder(const ImageCamera& camera, const std::vector<LightView>& lights, const Modulations& modulations, const SensorView& sensor,
                bool noise);
  FrozenDecoder(const FrozenDecoder&) = delete;
  FrozenDecoder& operator=(const FrozenDecoder&) = delete;

  [[nodiscard]] const DecoderView& view() const { return view_; }
  /// Takes each raw frame's exposure to be as long as the camera says now.
  void take_integration_times();

 private:
  void freeze_modulations();
  void freeze_without_modulation();
  void freeze_lights();
  void freeze_noise(const SensorView& sensor, bool noise);
  void freeze_checks(bool noise);
  void freeze_known_delays(const SensorView& sensor);
  [[nodiscard]] double grey_time() const;

  const ImageCamera& camera_;
  const std::vector<LightView>& lights_;
  const Modulations& modulations_;
  DecoderView view_{};
  std::vector<DecodeRawFrame> raw_frames_;
  std::vector<DecodeModulation> decode_modulations_;
  std::vector<std::int32_t> grey_frames_;
  std::vector<std::vector<std::int32_t>> grouped_, pairs_;  // [modulation]
  std::vector<std::vector<float>> wiggling_;
  std::vector<float> known_late_;  // pixels' delays as decoding knows them of a specimen, [modulation][height][width]
};

}  // namespace tofray::camera
