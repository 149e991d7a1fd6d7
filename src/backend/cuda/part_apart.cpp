// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cuda/part.h"

namespace tofray::backend::gpu {

Part find_part() { return load_part(part_folders(), TOFRAY_PART_IDENTITY); }

}  // namespace tofray::backend::gpu
