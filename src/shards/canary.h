// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace tofray::shards {

/// SHA-256 of all arrays of two small frames in which most of what tofray computes takes part. A machine, a build or a version that has another one makes other
/// bytes than the one that made the plan.
std::string canary_sha256();

}  // namespace tofray::shards
