// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>

#include "model/form.h"

/// What a dotted key of a scene or a profile means, by the tables.
namespace tofray::model {

/// A key that the tables have.
struct KnownKey {
  const ValueForm* form = nullptr;  ///< of its value; where several kinds have such a key, of the first of them
  Stage stage = Stage::trace;       ///< the first stage of a frame that looks at it; where kinds differ, the earliest
};

/// @param file  scene_form() or camera_form()
/// @param key   "lens.f_number", "illumination.0.power"; an element of a list is a number, or * for all
/// @return none: no file of that kind may have it
std::optional<KnownKey> known_key(const FileForm& file, const std::string& key);

}  // namespace tofray::model
