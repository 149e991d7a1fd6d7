// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

/// Files as a run's manifest.json lists them.
namespace tofray {

/// A file that a run starts from, as manifest.json lists it.
struct InputFile {
  std::string role;         ///< "scene", "profile", "table", "mesh", "keyframes", …
  std::string name;         ///< name by the caller or the scene; a built-in name where `text` is empty
  std::string text;         ///< the whole file, UTF-8; empty for what is built in, and for meshes and keyframes
  std::string sha256 = {};  ///< SHA-256 of a mesh and of keyframes, which may be too long to be here
};

/// A file that a run has written.
struct FileRecord {
  std::string name;  ///< within the folder
  std::uint64_t bytes = 0;
  std::string sha256;  ///< 64 hexadecimal digits
};

}  // namespace tofray
