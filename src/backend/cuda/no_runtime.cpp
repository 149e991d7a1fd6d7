// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// In the place of runtime.cu where tofray is built without CUDA.
#include "backend/cuda/runtime.h"

namespace tofray::backend::gpu {

extern "C" Runtime* tofray_cuda_runtime() { return nullptr; }

}  // namespace tofray::backend::gpu
