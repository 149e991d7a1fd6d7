// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "backend/cpu/cpu.h"
#include "backend/cuda/loaded_device.h"
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

/// GPUs with a camera and a scene: the first one computes single frames, all of them batches.
class Cuda final : public Engine {
 public:
  /// @param device      −1: the first one that can be used, and all others for batches
  /// @param block_size  threads per block, a multiple of 32 up to 1024; 0: chosen
  /// @param host        its threads take a frame's arrays to their places
  /// @throws gpu::Fault where the GPU cannot be used; Error (bad_input) for a block size that cannot be
  Cuda(int device, int block_size, Cpu& host);

  // All of these throw gpu::Fault where a GPU fails.
  void load(const pipeline::Setup& setup) override;
  void run(const pipeline::Setup& setup, const pipeline::Job& job, Own own, const pipeline::Input* input) override;
  void run(Batch& batch) override;
  [[nodiscard]] std::unique_ptr<KeptFrames> keep(Batch& batch, std::unique_ptr<KeptFrames> before) override;
  [[nodiscard]] bool derives() const override { return true; }
  /// All but the processor's isa and threads.
  void describe(RanOn& out) const override;

 private:
  /// Those that batches use beside the first, unless they are open.
  void open_others(Batch& batch);

  gpu::Device device_;
  int block_size_;
  Cpu& host_;
  bool all_;                              ///< no other GPU is to be looked for
  std::deque<gpu::LoadedDevice> loaded_;  ///< the one of single frames first
};

}  // namespace tofray::backend
