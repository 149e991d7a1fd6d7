// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "load/load.h"

namespace tofray::results {

/// Reads the camera out of a frame.npz's `meta` string, by way of the profile that `meta` amounts to, and changes keys of it. Every number
/// comes back as the same double.
/// @param where  the file, for messages
/// @throws Error (bad_input) where `meta` has no camera, or a key is wrong
Camera camera_of_meta(const std::string& meta, const std::string& where, const load::Settings& settings = {});

/// The camera of `meta` as a profile's text, with one mode, which load_camera() reads. @throws Error as camera_of_meta
std::string profile_of_meta(const std::string& meta, const std::string& where);

}  // namespace tofray::results
