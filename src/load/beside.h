// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>

#include "base/limits.h"
#include "mesh/read_mesh.h"

namespace tofray::load {

/// A file that a mesh's file names, as it was found.
struct Beside {
  std::string bytes;
  std::string found;   ///< where
  std::string notice;  ///< a sentence where it has another name than the one that is said
};

/// Reads a file that another one names: of that name, in or below its folder (or --root); else of the name's last part, which is what is
/// right of paths on the machine that wrote the file, `C:\textures\wood.png`; each of them also in other case.
/// @param most  bytes
/// @return nothing where there is none
/// @throws Error (limit) where it is too long
std::optional<Beside> read_beside(const mesh::Reference& reference, const std::string& folder, const std::string& root,
                                  const base::Limit& most);

}  // namespace tofray::load
