// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "tofray/run.h"

namespace tofray::sweeps {

/// The keys that a key with * means: one for each element of the lists of the scene, or of its camera, as they are with what is set.
/// A key without * means itself.
/// @throws Error (bad_input) where there is none
std::vector<std::string> elements_of(const std::string& key, const InputRequest& inputs, const Inputs& loaded);

}  // namespace tofray::sweeps
