// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include "load/builtin.h"
#include "tofray/load.h"

namespace tofray {
namespace {

/// @param what  "scene", "camera"
NameChoice file_before_builtin(const std::string& typed, const std::vector<load::Builtin>& builtins, const std::string& what) {
  if (load::find_builtin(builtins, typed) == nullptr) return {typed, {}};
  for (const char* suffix : {"", ".yaml", ".yml"}) {
    const std::string file = typed + suffix;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) continue;
    // "./" keeps a name without a suffix from being that of a built-in one again.
    const std::string name = *suffix == '\0' ? "./" + file : file;
    return {name, name + " of this folder is taken, not the built-in " + what + " " + typed +
                      "\n  the built-in one is taken where the folder has no such file"};
  }
  return {typed, {}};
}

}  // namespace

NameChoice choose_scene(const std::string& typed) { return file_before_builtin(typed, load::builtin_scenes(), "scene"); }

NameChoice choose_camera(const std::string& typed) { return file_before_builtin(typed, load::builtin_profiles(), "camera"); }

}  // namespace tofray
