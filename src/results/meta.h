// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "tofray/camera.h"
#include "tofray/scene.h"
#include "tofray/simulator.h"

namespace tofray::files {
class Json;
}

namespace tofray::results {

/// "off" or "exact".
const char* noise_name(Noise noise);

/// Whether this `meta` is that of expected values. Depth came from the unrounded taps then, and no pixel was called low signal.
bool is_noise_free(const files::Json& meta);

/// The `meta` string of frame.npz: one JSON object on one line with
/// `tofray` (version), `seed`, `noise`, `exposure_samples`, `subpixel`, `frame` (index), `units` (one per array), `camera` and `scene`, both
/// resolved, in SI units with the names of tofray/camera.h and scene.h. Neither time nor machine nor a file's place is in it: the same
/// arguments give the same bytes. Of a sequence's frames only the index differs: the rest is made once.
class FrameMeta {
 public:
  FrameMeta(const Scene& scene, const Camera& camera, const SimulatorOptions& options);
  [[nodiscard]] std::string of(std::uint64_t frame_index) const;

 private:
  std::string before_, after_;  ///< of the index
};

/// `meta` of one frame.
std::string frame_meta(const Scene& scene, const Camera& camera, const SimulatorOptions& options, std::uint64_t frame_index);

}  // namespace tofray::results
