// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shards/plan.h"
#include "shards/statistics.h"

/// What stands beside a shard's tar, and exists exactly when the tar is complete. Nothing of the machine or the time is in it.
namespace tofray::shards {

struct Record {
  struct Member {
    std::string name;                     ///< behind the sample's key and a dot: "raw.npy"
    std::uint64_t offset = 0, bytes = 0;  ///< in the tar, of the member's own bytes
    std::uint32_t crc = 0;                ///< CRC-32 of them
  };
  struct Sample {
    std::uint64_t sample = 0, view = 0;
    std::uint64_t pixels = 0, valid = 0;  ///< of its image, and those that have a depth
    std::vector<Member> members;
  };
  struct Hole {
    std::uint64_t sample = 0;
    std::string why;
  };
  std::string plan;  ///< its id
  std::uint64_t shard = 0, first = 0, count = 0, bytes = 0;
  std::string sha256;  ///< of the tar
  std::vector<Sample> samples;
  std::vector<Hole> holes;
  std::map<std::string, std::string> inputs;  ///< SHA-256 of files that the samples read and the plan does not list, by name
  Statistics statistics;

  /// Whether it is of that shard as the plan wants it.
  [[nodiscard]] bool fits(const Plan& of, std::uint64_t number) const;
};

std::string record_text(const Record& record);
/// @throws Error (bad_input) where it is no record
Record parse_record(std::string_view text, const std::string& where);
/// The file's bytes; none where there is no such file. @throws Error (io)
std::optional<std::string> read_record_text(const std::filesystem::path& folder, std::uint64_t shard);
/// None where there is no such file. @throws Error (io, bad_input)
std::optional<Record> read_record(const std::filesystem::path& folder, std::uint64_t shard);
/// Whether a shard is there: its record, which fits the plan, and a tar of its size.
bool is_complete(const std::filesystem::path& folder, const Plan& plan, std::uint64_t shard);

}  // namespace tofray::shards
