// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "support/text.h"

namespace tofray::test {

/// Names that a run which did not finish may not leave behind.
inline std::vector<std::string> temporaries(const std::filesystem::path& folder) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (has(entry.path().filename().native(), ".tmp")) found.push_back(entry.path().native());
  }
  return found;
}

}  // namespace tofray::test
