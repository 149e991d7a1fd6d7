// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cuda/part.h"

namespace tofray::backend::gpu {

Part find_part() { return {nullptr, "tofray was built without code for GPUs (TOFRAY_CUDA=ON ./dev build makes it, with nvcc)", false}; }

}  // namespace tofray::backend::gpu
