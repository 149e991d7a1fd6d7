// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

/// Chunks as zstd packs them.
namespace tofray::mcap {

/// Whether this build has zstd.
bool has_zstd();

/// Packs by zstd's level 1. One version of libzstd gives the same bytes each time.
class Packer {
 public:
  Packer();
  ~Packer();
  Packer(const Packer&) = delete;
  Packer& operator=(const Packer&) = delete;
  /// Appends what `bytes` become. Only where has_zstd().
  void append(std::string_view bytes, std::string& to);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What `packed` holds. @return false where it is not zstd's, or not so many bytes. Only where has_zstd().
bool unpack(std::string_view packed, std::size_t size, std::string& to);

}  // namespace tofray::mcap
