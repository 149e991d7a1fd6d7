// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "results/manifest.h"
#include "tofray/run.h"

/// A request as manifest.json keeps it, and back.
namespace tofray::run {

/// Frames of a run, and the largest number of its first one.
inline constexpr std::uint64_t most_frames = 1'000'000'000'000;

/// Words of options, in the order of Driver and of StampAt.
const std::vector<std::string>& driver_words();
const std::vector<std::string>& stamp_words();

/// What a manifest says of what was asked for. Inputs, files, machine and times are not yet in it.
results::Manifest manifest_of(const RunRequest& request);

/// What was asked for, put back from its manifest.
/// @param file  the manifest, for messages
/// @throws Error (bad_input) where it has an option that is unknown, or a value that this cannot have
RunRequest request_of(const results::Manifest& manifest, const std::string& file);

}  // namespace tofray::run
