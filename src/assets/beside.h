// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/content.h"
#include "base/limits.h"
#include "mesh/read_mesh.h"

namespace tofray::assets {

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

/// A file that a mesh's file named, as it was when it was looked for.
struct NamedRead {
  bool beside;  ///< by read_beside(), else by files::read_reference()
  std::string name, folder, root;
  base::Limit most;
  std::optional<base::Content> bytes;  ///< none where there was no file
  std::string found;

  /// Whether it would be the same now.
  [[nodiscard]] bool is_unchanged() const;
};

/// Notes which files this thread looks for as long as it lives.
class NamedReads {
 public:
  NamedReads();
  ~NamedReads();
  NamedReads(const NamedReads&) = delete;
  NamedReads& operator=(const NamedReads&) = delete;
  [[nodiscard]] const std::vector<NamedRead>& all() const { return reads_; }
  /// For who reads a named file. Nothing where nobody notes.
  static void note(bool beside, const std::string& name, const std::string& folder, const std::string& root, const base::Limit& most,
                   const std::string* bytes, const std::string& found);

 private:
  NamedReads* outer_;
  std::vector<NamedRead> reads_;
};

}  // namespace tofray::assets
