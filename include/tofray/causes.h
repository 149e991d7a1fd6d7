// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tofray/camera.h"
#include "tofray/scene.h"
#include "tofray/simulator.h"

/// Why a depth is wrong: each cause by switching it off.
namespace tofray {

/// What one cause does to the error: the error with it minus the error without it.
struct ErrorCause {
  /// noise, multipath, wiggling, wrong_cycle, mixed_pixel, motion, scatter, crosstalk, filter, interference or drift
  std::string cause;
  double error_m = 0;  ///< mean over the pixels that have a depth with the cause and without it; NaN where none has
};

/// The error of z, split by cause. Means over the pixels that have a depth and a truth; NaN where there is none.
struct ErrorSplit {
  int pixels = 0;                  ///< number of pixels that were asked for
  int valid = 0;                   ///< number of pixels in the means
  double error_m = 0;              ///< error of z: z_m - gt_z_m
  double sigma_m = 0;              ///< noise of z as the camera estimates it: the root of the mean square
  std::vector<ErrorCause> causes;  ///< those that the scene and the camera have, the largest first
  double rest_m = 0;               ///< error_m less all causes: what several of them do together, and what is none of them
};

/// A rectangle of pixels, both corners in it.
struct PixelRegion {
  int u0 = 0, v0 = 0, u1 = 0, v1 = 0;
};

/// Splits the error of a frame's pixels, one simulated frame at a time.
///
/// The frame is simulated again with each cause off, with the same seed: noise: expected values; multipath: no bounces; wiggling: the first
/// harmonic of each light's correlation alone; mixed_pixel: one sample in the pixel's middle; motion: all stands where it is at the time of
/// the truth (but meshes that change their shape); scatter: no light scattered in the lens; crosstalk: no charge collected by neighbours;
/// filter: no filter over image or frames; interference: no other camera; drift: none with temperature. wrong_cycle takes no frame of its
/// own: each depth is compared with the one by the cycles nearest to the truth, from which the other causes are counted, too. All causes but
/// noise are counted in expected values: with other light chance would draw other counts.
class ErrorCauses {
 public:
  /// @throws Error (bad_input) where the region is beyond the image or turned over, and as Simulator
  ErrorCauses(const Scene& scene, const Camera& camera, const SimulatorOptions& options, std::uint64_t index, const PixelRegion& region);
  ~ErrorCauses();
  ErrorCauses(ErrorCauses&&) noexcept;
  ErrorCauses& operator=(ErrorCauses&&) noexcept;

  /// Simulates one frame more. One that SimulatorOptions::progress stopped is simulated again by the next
  /// call; the caller that set FrameProgress::stop resets it before.
  /// @return whether more are to come
  bool step();
  /// Good once `step` has said that no more are to come.
  [[nodiscard]] ErrorSplit result() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// All of it at once; ends early where SimulatorOptions::progress is told to stop, and says then what it has.
ErrorSplit error_causes(const Scene& scene, const Camera& camera, const SimulatorOptions& options, std::uint64_t index,
                        const PixelRegion& region);

}  // namespace tofray
