// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "tofray/camera.h"
#include "tofray/frame.h"
#include "tofray/options.h"
#include "tofray/scene.h"
#include "tofray/stages.h"
#include "tofray/version.h"

namespace tofray {

/// Which frame. What is not set is the simulator's.
struct FrameRequest {
  std::uint64_t index = 0;  ///< starts at index / frame_rate
  std::optional<std::uint64_t> seed = {};
  std::optional<Pose> pose = {};  ///< of the camera
};

/// Frames that stay in a GPU's memory.
class DeviceFrames {
 public:
  DeviceFrames();
  ~DeviceFrames();
  DeviceFrames(DeviceFrames&&) noexcept;
  DeviceFrames& operator=(DeviceFrames&&) noexcept;

  [[nodiscard]] std::uint64_t size() const;
  /// Pointers of the device's memory, good until the next use of this object.
  [[nodiscard]] FrameArrays operator[](std::uint64_t i) const;
  /// How long the device computed, by its own clock [s].
  [[nodiscard]] double seconds() const;

  struct Impl;

 private:
  friend class Simulator;
  std::unique_ptr<Impl> impl_;
};

/// Simulates frames of one scene seen by one camera. frame(i) depends on nothing but (scene, camera, options, i).
class Simulator {
 public:
  /// @throws Error (bad_input) for a number that is not finite or out of its range, and where scene, camera and options do not fit
  /// together; (limit) where they are beyond a limit; (device) where Backend::cuda is wanted and cannot be had
  Simulator(const Scene& scene, const Camera& camera, const SimulatorOptions& options = {});
  ~Simulator();
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;

  /// Frame i starts at i / frame_rate. Where Decoding::temporal_frames is more than 1, so many frames less one are computed before it, but for
  /// those that were computed last.
  [[nodiscard]] Frame frame(std::uint64_t index);
  /// The same into memory that the caller keeps: arrays of the right size are not allocated anew.
  void frame(std::uint64_t index, Frame& into);
  /// The same of a frame with a seed or a pose of its own.
  /// @throws Error (bad_input) for a pose that cannot be
  void frame(const FrameRequest& request, Frame& into);

  /// Stages 2 to 4 of what another renderer saw. Of the scene only its ambient light counts, and the camera's pose for where the sun is.
  /// @throws Error (bad_input) for an array of another size than camera and sequence ask for, and for a value out of its range
  [[nodiscard]] Frame frame(std::uint64_t index, const Geometry& seen);
  void frame(std::uint64_t index, const Geometry& seen, Frame& into);
  /// Stages 3 and 4 of light that was computed elsewhere; nothing of the scene counts. Truth: power_w and signal_e, the rest is unknown.
  /// @throws Error (bad_input) as above
  [[nodiscard]] Frame frame(std::uint64_t index, const PixelLight& light);
  void frame(std::uint64_t index, const PixelLight& light, Frame& into);
  /// The same of light by the length of its path. Truth: signal_e, the rest is unknown.
  /// @throws Error (bad_input) as above, where there is no light source or no lit raw frame, and where light sources differ in waveform;
  /// (limit) for histograms that are too large
  [[nodiscard]] Frame frame(std::uint64_t index, const Transient& light);
  void frame(std::uint64_t index, const Transient& light, Frame& into);

  /// Many frames, in their order: `count` from `first` on, or one for each request. On GPUs several of them are on their way at once, in
  /// bounded memory; all GPUs take part unless SimulatorOptions::device names one.
  /// Ends with the last whole frame once FrameProgress::stop is set.
  /// @param take  is given each frame when it is done; the arrays are good until it returns
  /// @throws Error (bad_input) for a request with a pose that cannot be: before the first frame
  void frames(std::uint64_t first, std::uint64_t count, const std::function<void(const FrameArrays&)>& take);
  void frames(std::span<const FrameRequest> requests, const std::function<void(const FrameArrays&)>& take);
  /// The same, left in the GPU's memory, which `into` holds and uses again where it is large enough.
  /// @throws Error (device) where the processor computes, or where the memory is too small for them; (bad_input) as above
  void frames_on_device(std::uint64_t first, std::uint64_t count, DeviceFrames& into);
  void frames_on_device(std::span<const FrameRequest> requests, DeviceFrames& into);

  /// What computes the frames.
  [[nodiscard]] RanOn ran_on() const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

/// Where the camera is at a time: camera to world, [4][4] row-major, last row 0 0 0 1.
std::array<double, 16> camera_pose(const Scene& scene, double time_s);
/// A pose as a matrix: camera to world, row by row.
/// @throws Error (bad_input) where it looks nowhere, or its quaternion is not of unit length to 1e-3
std::array<double, 16> pose_matrix(const Pose& pose);
/// The pose, by its quaternion, that has such a matrix: of a camera's optical frame, x right, y down, z forward.
/// @throws Error (bad_input) where the upper left 3 x 3 is no rotation to 1e-3, or the last row is not 0 0 0 1
Pose pose_from_matrix(const std::array<double, 16>& camera_to_world);

/// Decodes raw data, simulated or measured, into depth (theory 4). Needs `raw`, or `tap_a` and `tap_b`, and the arrays by
/// phase; the camera says the rest. Taps, where present, are taken unrounded only if `raw` is empty; a tap that holds no
/// number flags its pixel as saturated.
/// @param ran_on  where not null: gets to know what computed
Depth process(const Raw& raw, const Camera& camera, const SimulatorOptions& options = {}, RanOn* ran_on = nullptr);

}  // namespace tofray
