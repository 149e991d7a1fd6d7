// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "dds/publisher.h"

namespace tofray::dds {

/// Loads libtofray_dds.so, which stays loaded, and joins a domain.
/// @throws Error (device) where the library is not there, is of another version, or DDS cannot start; the text says what to do
std::unique_ptr<stream::Publisher> open_publisher(const Settings& settings);
/// A publisher out of the first of these folders that holds the library.
std::unique_ptr<stream::Publisher> open_publisher(const Settings& settings, const std::vector<std::filesystem::path>& folders);

}  // namespace tofray::dds
