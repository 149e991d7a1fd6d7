// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "camera/frozen_lens.h"
#include "camera/frozen_scatter.h"
#include "camera/image_camera.h"
#include "camera/views.h"
#include "camera/waveform.h"
#include "tofray/camera.h"

namespace tofray::camera {

/// One light: pattern table and numbers; owns the table.
struct FrozenLight {
  LightView view{};
  std::vector<float> table;
};
/// @param quantum_efficiency  QE at the light's wavelength
FrozenLight freeze_light(const Illumination& light, double quantum_efficiency);

/// Modulation frequencies of the lit raw frames in the order they first appear, and their place in a common base.
struct Modulations {
  std::vector<double> frequency_hz;
  std::vector<int> of_raw_frame;  ///< −1: unlit
  std::vector<int> cycles;        ///< M_i: f_i = M_i·f_0
  double base_hz = 0;             ///< f_0
};
/// @throws Error (bad_input) where the frequencies have no common base with cycles up to 1000
Modulations modulations_of(const Mode& mode);

/// τ, of its phase and its delay together [rad]; 0 where unlit.
double reference_phase_of(const RawFrame& frame);

/// Camera profile → views. Owns all arrays the views point to; not copied.
class FrozenCamera {
 public:
  /// @param noise     false: expected values
  /// @param subpixel  samples of each pixel along a row and along a column
  /// @param threads   that find the lens's rays; 0: one per core
  /// @throws Error (bad_input) where the profile makes no sense as a whole
  FrozenCamera(const Camera& camera, bool noise, std::uint64_t seed, int subpixel = 1, int threads = 0);
  FrozenCamera(const FrozenCamera&) = delete;
  FrozenCamera& operator=(const FrozenCamera&) = delete;

  [[nodiscard]] const LensView& lens() const { return middle_->view(); }
  [[nodiscard]] const SubpixelView& subpixel() const { return subpixel_; }
  [[nodiscard]] const ScatterView& scatter() const { return scatter_.view(); }
  [[nodiscard]] const std::vector<LightView>& lights() const { return light_views_; }
  [[nodiscard]] const PhasorView& phasors() const { return phasors_; }
  [[nodiscard]] const PowerView& power() const { return power_; }
  [[nodiscard]] const DecoderView& decoder() const { return decoder_; }
  /// The correlation's harmonics as depth takes them: those of the mean of all lights, whatever of them is corrected.      [theory: eq. 4.15]
  [[nodiscard]] std::vector<Harmonic> mean_harmonics(std::size_t modulation) const;
  /// The sensor in a frame that starts at time t [s]: temperature drift and another camera's light depend on that, and on the frame's number
  /// and seed what is drawn of the latter. Where either is there, a view is good until the next call.
  /// @param seed  of this frame, in place of the camera's
  [[nodiscard]] const SensorView& sensor(double time_s, std::uint64_t index = 0, std::optional<std::uint64_t> seed = {});
  /// Exposes each raw frame for so long from now on; the views stay where they are.
  void set_integration_times(const std::vector<double>& seconds);
  /// Start of each raw frame after the start of its frame [s].
  [[nodiscard]] const std::vector<double>& raw_frame_start_s() const { return start_; }

 private:
  void freeze_lens(int subpixel, int threads);
  void freeze_sequence(std::uint64_t seed, bool noise);
  void freeze_phasors();
  [[nodiscard]] double first_phase(std::size_t modulation) const;
  [[nodiscard]] double mean_frequency(std::size_t modulation) const;
  [[nodiscard]] double gate_phase(std::size_t raw_frame) const;
  void freeze_gates(double half_path_m);
  void freeze_other_camera(double time_s, std::uint64_t index);
  [[nodiscard]] double drift_m(double time_s) const;
  void freeze_patterns();
  using Map = std::shared_ptr<const std::vector<float>>;
  /// A pattern over the image; null where sigma is 0.
  [[nodiscard]] Map drawn(double sigma, double mean, double least, std::uint32_t stream) const;
  void freeze_read_curve();
  [[nodiscard]] double dark_current() const;
  void freeze_decoder(bool noise);
  void freeze_modulations(double grey_time);
  void freeze_without_modulation();
  void freeze_known_delays();

  Sensor sensor_pixels_;  // the whole sensor, and what is read of it
  Pixel one_pixel_;
  Readout readout_;
  ImageCamera camera_;
  Modulations modulations_;
  std::shared_ptr<const FrozenLens> middle_;
  std::vector<std::shared_ptr<const FrozenLens>> samples_;  // within the pixel
  std::vector<LensView> sample_views_;
  std::vector<float> shares_;
  FrozenScatter scatter_;
  SubpixelView subpixel_{};
  PowerView power_{};
  SensorView sensor_{};
  DecoderView decoder_{};
  PhasorView phasors_{};
  std::vector<FrozenLight> lights_;
  std::vector<LightView> light_views_;
  std::vector<RawFrameView> raw_frames_;
  std::vector<ModulationView> phasor_modulations_;
  std::vector<float> sources_, gates_, other_gates_;
  num::RoundKeys keys_{};  // of the camera's seed
  double drifted_m_ = 0;   // what the gates were made for
  std::vector<DecodeRawFrame> decode_frames_;
  std::vector<DecodeModulation> decode_modulations_;
  std::vector<std::int32_t> grey_frames_;
  std::vector<std::vector<std::int32_t>> grouped_, pairs_;  // [modulation]
  Map gain_, offset_, delay_;
  std::vector<float> late_, read_;  // delay_ with the pixels' phases in it, [modulation][height][width]
  std::vector<float> known_late_;   // the same as decoding knows it of a specimen
  std::vector<std::vector<float>> wiggling_, light_;
  std::vector<double> start_;
};

}  // namespace tofray::camera
