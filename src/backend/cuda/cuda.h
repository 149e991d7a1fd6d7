// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <deque>
#include <string>
#include <vector>

#include "backend/cpu/cpu.h"
#include "backend/cuda/frame_stream.h"
#include "backend/engine.h"

/// Runs the pipeline on a GPU: one thread for each pixel. No type of CUDA's is in this header.
namespace tofray::backend {

/// What stands in the way of computing frames on a GPU.
struct CudaLack {
  std::string reason;        ///< one line; empty: nothing does
  bool gpu_present = false;  ///< there is a GPU, or its driver, so that its owner will want to know the reason
  std::string gpu;           ///< name of the one that can be used
};
/// @param device  which GPU, from 0 on; −1: the first one that can be used
CudaLack why_no_cuda(int device);

/// "0: NVIDIA H200, compute capability 9.0, 140 GB", one line for each GPU that can be used.
std::vector<std::string> usable_gpus();

/// Where a GPU sits, as other libraries (NVML) know it: "0000:3b:00.0".
/// @throws gpu::Fault where it cannot be used
std::string cuda_bus_id(int device);

/// @param wanted  0: chosen
/// @return threads per block
/// @throws Error (bad_input) for a number that cannot be
int check_block_size(int wanted);

/// One GPU with a camera and a scene.
class Cuda final : public Engine {
 public:
  /// @param device      −1: the first one that can be used
  /// @param block_size  threads per block, a multiple of 32 up to 1024; 0: chosen
  /// @param host        its threads take a frame's arrays to their places
  /// @throws gpu::Fault where the GPU cannot be used; Error (bad_input) for a block size that cannot be
  Cuda(int device, int block_size, Cpu& host);

  /// @throws gpu::Fault
  void load(const pipeline::Setup& setup) override;
  /// @throws gpu::Fault
  void run(const pipeline::Setup& setup, const pipeline::Job& job, const pipeline::Input* input = nullptr) override;
  [[nodiscard]] bool derives() const override { return true; }
  /// All but the processor's isa and threads.
  void describe(RanOn& out) const override;

  /// Stream i; made where there is none yet.
  gpu::FrameStream& frame_stream(std::size_t i);
  [[nodiscard]] const gpu::Resident& resident() const { return resident_; }
  [[nodiscard]] const gpu::Device& device() const { return device_; }

 private:
  gpu::Device device_;
  int block_size_;
  Cpu& host_;
  double occupancy_ = 0;  ///< how full one multiprocessor is of the kernel that takes the time
  gpu::Resident resident_;
  std::deque<gpu::FrameStream> frame_streams_;
};

}  // namespace tofray::backend
