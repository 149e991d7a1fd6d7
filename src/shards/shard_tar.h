// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "files/sha256.h"
#include "shards/record.h"
#include "tofray/error.h"

namespace tofray::shards {

/// A shard's file, read in pieces.
class ShardTar {
 public:
  explicit ShardTar(const std::filesystem::path& path) : path_(path), file_(path, std::ios::binary) {}
  [[nodiscard]] bool is_open() const { return file_.is_open(); }
  std::string sha256() {
    files::Sha256 sum;
    std::string piece(std::size_t{1} << 20, '\0');
    file_.clear(), file_.seekg(0);
    while (file_.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file_.gcount() > 0)
      sum.add(std::string_view(piece.data(), static_cast<std::size_t>(file_.gcount())));
    if (file_.bad()) throw Error(ErrorKind::io, fmt::format("{}: error: cannot read it", path_.native()));
    return sum.hex();
  }
  /// The bytes of a member, as many of them as there are.
  std::string read(const Record::Member& member) {
    std::error_code fault;
    const std::uint64_t there = std::filesystem::file_size(path_, fault);
    std::string out(member.offset < there ? std::min(member.bytes, there - member.offset) : 0, '\0');
    file_.clear(), file_.seekg(static_cast<std::streamoff>(member.offset));
    file_.read(out.data(), static_cast<std::streamsize>(out.size()));
    return out;
  }

 private:
  std::filesystem::path path_;
  std::ifstream file_;
};

}  // namespace tofray::shards
