// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tofray::files {

enum class Packing { stored, deflated };

/// Writes a zip into memory that its caller keeps: every byte is copied once and summed once. (Zips are read by libzip.) The same entries
/// give the same bytes: their time is 1980-01-01 in every time zone. See PKWARE's APPNOTE.TXT, 4.3, for the format.
class ZipWriter {
 public:
  static constexpr std::uint64_t most_in_32_bits = 0xffffffff;
  /// @param file   emptied first; memory that it has is used again
  /// @param limit  sizes and places from here on stand in 64 bits; tests set a small one
  ZipWriter(std::string& file, Packing packing, std::uint64_t limit = most_in_32_bits);
  /// Adds an entry that consists of two pieces one after the other.
  void add(std::string_view name, std::string_view head, std::string_view body);
  /// Writes the directory. Nothing may be added after it.
  void finish();

 private:
  struct Entry {
    std::string name;
    std::uint32_t crc = 0;
    std::uint16_t method = 0;
    std::uint64_t packed = 0, unpacked = 0, offset = 0;
  };
  [[nodiscard]] bool is_large(const Entry& entry) const;
  void put_header(const Entry& entry);
  void put_directory_entry(const Entry& entry);

  std::string& file_;
  Packing packing_;
  std::uint64_t limit_;
  std::vector<Entry> entries_;
};

}  // namespace tofray::files
