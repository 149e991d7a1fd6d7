// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "files/output_folder.h"
#include "results/manifest.h"
#include "tofray/run.h"

namespace tofray::run {

/// Files that earlier runs wrote into a folder, as the manifest.json that lies there says: they would be read together with this run's.
class EarlierFiles {
 public:
  /// Before this run writes there. Where there is no manifest, or none that can be read, nobody knows of any.
  explicit EarlierFiles(const std::filesystem::path& folder);

  /// Once this run has written all but its manifest: tells of those that it has not replaced, or removes them. Those that stay go into
  /// the manifest, for the next run. Parts of one run (--first-frame) belong together: nothing is told of them.
  /// @param clean  whether they are removed: only what is a plain file of the size that is known, and not after an interruption
  std::vector<Remark> settle(const files::OutputFolder& folder, bool clean, results::Manifest& now) const;

 private:
  std::optional<results::Manifest> before_;
};

}  // namespace tofray::run
