// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "results/manifest.h"
#include "tofray/scene.h"

/// Tables that a camera profile keeps in files of their own: a manifest holds their texts, too.
namespace tofray::run {

/// The files that the profile's text, or the scene's changes of it, name under `file:`, as inputs of the role "table".
/// @param folder  where the profile lies
std::vector<InputFile> profile_tables(const InputFile& profile, const std::string& folder, const std::vector<Override>& overrides);

/// The profile with the overrides made and every table's numbers in the place of its name.
/// @throws Error (bad_input) where `tables` lacks one
std::string profile_with_tables(const InputFile& profile, const std::vector<Override>& overrides, const std::vector<InputFile>& tables);

}  // namespace tofray::run
