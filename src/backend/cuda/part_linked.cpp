// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cuda/part.h"

namespace tofray::backend::gpu {

Part find_part() { return {tofray_cuda_runtime(), "", true}; }

}  // namespace tofray::backend::gpu
