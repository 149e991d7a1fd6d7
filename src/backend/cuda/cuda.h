// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

/// Runs the pipeline on a GPU: one thread for each pixel. No type of CUDA's is in this header.
namespace tofray::backend {

/// What stands in the way of computing frames on a GPU.
struct CudaLack {
  std::string reason;          ///< one line; empty: nothing does
  bool gpu_present = false;    ///< there is a GPU, or its driver, so that its owner will want to know the reason
};
/// @param device  which GPU, from 0 on; −1: the first one
CudaLack why_no_cuda(int device);

/// @throws Error (device) with the reason, where there is one
void refuse_cuda(const std::string& reason);

}  // namespace tofray::backend
