// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "tofray/frame_arrays.h"

namespace tofray::test {

/// The names of all arrays that kernels write, those too that have to be asked for.
inline std::vector<std::string> every_array() {
#define TOFRAY_NAME(name, ...) #name,
  return {TOFRAY_IMAGE_ARRAYS(TOFRAY_NAME)};
#undef TOFRAY_NAME
}

}  // namespace tofray::test
