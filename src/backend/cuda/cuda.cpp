// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cuda/cuda.h"

#include "tofray/error.h"

namespace tofray::backend {

CudaLack why_no_cuda(int) { return {"this build of tofray has no CUDA backend", false}; }

void refuse_cuda(const std::string& reason) {
  if (reason.empty()) return;
  throw Error(ErrorKind::device, "error: no GPU can be used: " + reason + "\n  take the backend cpu, or auto: the results are what they would be");
}

}  // namespace tofray::backend
