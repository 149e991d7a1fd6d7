// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "io/json.h"
#include "io/load.h"

namespace tofray::io {

/// The camera that a frame.npz says it was made with, as a profile's text again: `camera` of frame_meta(). Every number comes back as
/// the same double. (What the light pattern's cells are is not in `meta`; no depth depends on it.)
std::string profile_text(const Json& camera);

/// Reads the camera out of a frame.npz's `meta` string and changes keys of it.
/// @param where  the file, for messages
/// @throws Error (bad_input) where `meta` has no camera, or a key is wrong
Camera camera_of_meta(const std::string& meta, const std::string& where, const Settings& settings = {});

}  // namespace tofray::io
