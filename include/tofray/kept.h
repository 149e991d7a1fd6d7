// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>

#include "tofray/camera.h"
#include "tofray/frame.h"
#include "tofray/options.h"
#include "tofray/scene.h"

/// Frames of cameras that differ late: what the first stages found for one of them is good for the others. `tofray/sweep.h` stands on it.
namespace tofray {

/// Light and ground truth that stages 1 and 2 found of a frame; empty until KeptFrames::frame_to.
class KeptLight {
 public:
  KeptLight();
  ~KeptLight();
  KeptLight(KeptLight&&) noexcept;
  KeptLight& operator=(KeptLight&&) noexcept;
  /// Whether there is any.
  [[nodiscard]] bool filled() const { return impl_ != nullptr; }

  struct Impl;

 private:
  friend class KeptFrames;
  std::unique_ptr<Impl> impl_;
};

/// Raw frames and ground truth of a frame; empty until KeptFrames::keep.
class KeptRaw {
 public:
  KeptRaw();
  ~KeptRaw();
  KeptRaw(KeptRaw&&) noexcept;
  KeptRaw& operator=(KeptRaw&&) noexcept;
  /// Whether there are any.
  [[nodiscard]] bool filled() const { return impl_ != nullptr; }

  struct Impl;

 private:
  friend class KeptFrames;
  std::unique_ptr<Impl> impl_;
};

/// A simulator on the processor whose frames may begin with what another one kept, and have the bytes of Simulator::frame then, too.
///
/// The caller answers for what differs between the two: of light that was kept nothing that stages 1 and 2 look at, of raw frames nothing
/// but Camera::decoding. Everything else has to be the same, scene, options and frame.
class KeptFrames {
 public:
  /// @throws Error as Simulator; (bad_input) for Backend::cuda
  KeptFrames(const Scene& scene, const Camera& camera, const SimulatorOptions& options = {});
  ~KeptFrames();
  KeptFrames(KeptFrames&&) noexcept;
  KeptFrames& operator=(KeptFrames&&) noexcept;

  /// Whether light can be kept: not where exposures follow the light or depth is a mean over frames, nor where the noise of depth says how
  /// many ways of bouncing light are followed (Transport::max_samples).
  [[nodiscard]] bool can_keep_light() const;
  /// Whether raw frames can: not where light cannot, where light bounces (the truth of multipath is the decoder's), where full wells spill into
  /// their neighbours, nor without noise, where depth takes charge that no converter rounds.
  [[nodiscard]] bool can_keep_raw() const;
  /// Whether what was kept of one frame is good for all: nothing moves.
  [[nodiscard]] bool stands_still() const;

  /// As Simulator::frame.
  void frame(std::uint64_t index, Frame& into);
  /// Computes a frame as Simulator::frame does, and keeps its light.
  void frame_to(std::uint64_t index, KeptLight& light, Frame& into);
  /// Computes a frame out of light that was kept. Several threads may read it at once, each with its own KeptFrames.
  /// @return false where it lies otherwise in memory or is of other times: nothing was done
  bool frame_from(std::uint64_t index, const KeptLight& light, Frame& into);
  /// Computes a frame out of raw frames that were kept. Several threads may read them at once, each with its own KeptFrames.
  void frame_from(std::uint64_t index, const KeptRaw& raw, Frame& into);
  /// Keeps the raw frames of the frame that was computed last.
  /// @throws Error (bad_input) where SimulatorOptions::arrays leaves out tap_a, tap_b or raw
  void keep(KeptRaw& raw) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tofray
