// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "dataset/set_file.h"
#include "tofray/scene.h"

namespace tofray::dataset {

/// Which of the rules a scene breaks, by a frame of direct light of a quarter of the camera's columns and rows with its noise: whole numbers of pixels, the same on every
/// machine.
/// @return the first one; none where all hold
std::optional<std::size_t> broken_rule(const Scene& scene, std::uint64_t seed, const std::vector<AcceptRule>& rules);

}  // namespace tofray::dataset
