// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "files/json.h"
#include "tofray/run.h"

namespace tofray::app {

/// Warnings and notes of a command: said on stderr at once, and kept for --json.
class Remarks {
 public:
  /// Says a text of none, one or several remarks: "warning: …", "note: …", or one of these after a file's place; lines that begin with a
  /// blank go on with the one before.
  void tell(const std::string& text);
  void tell(const std::vector<Remark>& remarks);
  /// Adds `warnings` and `notes`, lists of texts, to a command's JSON.
  files::Json& put(files::Json& json) const;

 private:
  std::vector<std::string> warnings_, notes_;
};

/// Remarks as they are said.
std::string texts(const std::vector<Remark>& remarks);

}  // namespace tofray::app
