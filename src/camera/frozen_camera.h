// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "camera/decoder/frozen_decoder.h"
#include "camera/lens/frozen_lenses.h"
#include "camera/lens/frozen_scatter.h"
#include "camera/light/frozen_light.h"
#include "camera/pixel/frozen_phasors.h"
#include "camera/pixel/frozen_sensor.h"
#include "camera/pixel/modulations.h"
#include "camera/readout/image_camera.h"

namespace tofray::camera {

/// Camera profile → views: lens, light, pixel and decoder, frozen for rendering as plain numbers in single precision that kernels read. Owns all
/// arrays the views point to; not copied.
class FrozenCamera {
 public:
  /// @param noise     false: expected values
  /// @param subpixel  samples of each pixel along a row and along a column
  /// @param threads   that find the lens's rays; 0: one per core
  /// @throws Error (bad_input) where the profile makes no sense as a whole
  FrozenCamera(const Camera& profile, bool noise, std::uint64_t seed, int subpixel = 1, int threads = 0);
  FrozenCamera(const FrozenCamera&) = delete;
  FrozenCamera& operator=(const FrozenCamera&) = delete;

  [[nodiscard]] const LensView& lens() const { return lenses_.middle(); }
  [[nodiscard]] const SubpixelView& subpixel() const { return lenses_.subpixel(); }
  [[nodiscard]] const ScatterView& scatter() const { return scatter_.view(); }
  [[nodiscard]] const std::vector<LightView>& lights() const { return lights_.views(); }
  [[nodiscard]] const PowerView& power() const { return power_; }
  [[nodiscard]] const PhasorView& phasors() const { return phasors_.view(); }
  [[nodiscard]] const DecoderView& decoder() const { return decoder_.view(); }
  /// The correlation's harmonics as depth takes them.                                                 [theory: several-lights]
  [[nodiscard]] std::vector<Harmonic> mean_harmonics(std::size_t modulation) const {
    return camera::mean_harmonics(camera_, lights_.views(), modulations_.frequency_hz[modulation]);
  }
  /// The sensor in a frame that starts at time t [s], as FrozenSensor::at says.
  [[nodiscard]] const SensorView& sensor(double time_s, std::uint64_t index = 0, std::optional<std::uint64_t> seed = {}) {
    return sensor_.at(time_s, index, seed);
  }
  /// Exposes each raw frame for so long from now on; the views stay where they are.
  void set_integration_times(const std::vector<double>& seconds);
  /// Start of each raw frame after the start of its frame [s].
  [[nodiscard]] const std::vector<double>& raw_frame_start_s() const { return sensor_.raw_frame_start_s(); }

 private:
  ImageCamera camera_;  // with a point source for each light
  Modulations modulations_;
  FrozenScatter scatter_;
  FrozenLenses lenses_;
  FrozenLights lights_;
  PowerView power_;
  FrozenPhasors phasors_;
  FrozenSensor sensor_;
  FrozenDecoder decoder_;
};

}  // namespace tofray::camera
