// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cuda_runtime.h>

#include "backend/cuda/runtime.h"

/// The device code as cuda_runtime.cu starts it.
namespace tofray::backend::gpu {

cudaError_t launch_kernel(const Launch& what, cudaStream_t stream);
/// Looks for the code of all kernels on the current device, and loads it: none comes while a graph is made.
cudaError_t find_kernels();
/// Threads of a pass's blocks where `block_size` is asked for: some kernels take more registers than a block of that size has for each.
int threads_of_block(Pass pass, int block_size);
/// The function that a launch of this block size runs.
const void* kernel_function(Pass pass, int block_size);

}  // namespace tofray::backend::gpu
