// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tofray/camera.h"

/// How far a mode can tell distances apart.
namespace tofray::analysis {

struct Reach {
  double ambiguity_range_m = 0;  ///< of all modulation frequencies together; 0: no raw frame is lit
  std::vector<double> ranges_m;  ///< c/2f of each
};
Reach reach_of(const Camera& camera);

}  // namespace tofray::analysis
