// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <deque>

#include "backend/cuda/frame_stream.h"

namespace tofray::backend::gpu {

/// A GPU with a camera and a scene, and its streams.
class LoadedDevice {
 public:
  /// @param block_size  threads per block
  /// @throws Fault where the GPU fails
  LoadedDevice(const Device& device, int block_size, const pipeline::Setup& setup);

  /// Stream i; made where there is none yet.
  FrameStream& stream(std::size_t i);
  [[nodiscard]] const Device& device() const { return device_; }
  [[nodiscard]] const Resident& resident() const { return resident_; }
  /// How full one multiprocessor is of the kernel that takes the time, 0 to 1.
  [[nodiscard]] double occupancy() const { return occupancy_; }

 private:
  void load(const pipeline::Setup& setup);
  void find_occupancy(const pipeline::Setup& setup);

  Device device_;
  int block_size_;
  double occupancy_ = 0;
  Resident resident_;
  std::deque<FrameStream> streams_;
};

}  // namespace tofray::backend::gpu
