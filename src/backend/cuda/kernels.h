// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cuda_runtime.h>

#include "backend/cuda/pixel.h"
#include "backend/cuda/runtime.h"

/// The device code as cuda_runtime.cu starts it.
namespace tofray::backend::gpu {

cudaError_t launch_kernel(const Launch& what, cudaStream_t stream);
/// Looks for the code of all kernels on the current device, and loads it: none comes while a graph is made.
cudaError_t find_kernels();
/// Largest block of a kernel: some take more registers than a block of the largest size has for each thread.
constexpr int most_threads_of(Pass pass) {
  return pass == Pass::bounces || pass == Pass::transient || pass == Pass::input || pass == Pass::derive ? 256 : max_block_size;
}
/// Threads of its blocks where `block_size` is asked for.
constexpr int threads_of_block(Pass pass, int block_size) {
  return block_size < most_threads_of(pass) ? block_size : most_threads_of(pass);
}
/// The function that a launch of this block size runs.
const void* kernel_function(Pass pass, int block_size);

}  // namespace tofray::backend::gpu
