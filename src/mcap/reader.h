// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "mcap/records.h"

/// Reads MCAP files from their beginning to their end, whoever wrote them, one chunk in memory at a time.
namespace tofray::mcap {

inline constexpr std::uint64_t max_chunk_bytes = std::uint64_t{256} << 20;   ///< unpacked
inline constexpr std::uint64_t max_record_bytes = std::uint64_t{512} << 20;  ///< of any record

/// Bytes of a file.
class Source {
 public:
  virtual ~Source() = default;
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// So many bytes from there on, good until the next call. @throws Error (io)
  virtual std::string_view read(std::uint64_t from, std::uint64_t size) = 0;
};

/// One that is in memory.
class MemorySource : public Source {
 public:
  explicit MemorySource(std::string_view bytes) : bytes_(bytes) {}
  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
  std::string_view read(std::uint64_t from, std::uint64_t size) override { return bytes_.substr(from, size); }

 private:
  std::string_view bytes_;
};

/// One on the disk. @throws Error (io) where it cannot be read or is no regular file
std::unique_ptr<Source> open_file(const std::string& path);

struct Schema {
  std::string name, encoding, definition;
};
struct Channel {
  Schema schema;
  std::string topic, encoding;
  Pairs metadata;
};
struct SeenMessage {
  const Channel& channel;
  std::uint32_t sequence;
  std::uint64_t log_ns, publish_ns;
  std::string_view data;
  std::uint64_t at;  ///< where its record, or the chunk that has it, begins in the file
};

/// Whoever wants to know what is in the file; good until the call returns. All may be left empty.
struct Reading {
  std::function<void(const SeenMessage&)> message = {};
  std::function<void(std::string_view name, std::string_view media_type, std::string_view data)> attachment = {};
  std::function<void(std::string_view name, const Pairs&)> metadata = {};
};

/// How it went.
struct Ended {
  std::string profile, library;
  bool complete = false;    ///< it has its end; otherwise the writer was killed, or the file was cut
  std::uint64_t bytes = 0;  ///< of the file up to the last whole record
  std::uint64_t chunks = 0, unpacked_bytes = 0, packed_bytes = 0;
  std::map<std::string, std::uint64_t> compressions;  ///< chunks by compression; "": none
  std::map<std::uint16_t, Channel> channels;
};

/// @param where  the file, for messages
/// @throws Error (bad_input) where it is no MCAP file, where a sum shows damage, where a chunk is packed by what is not read; (limit)
Ended read(Source& file, const std::string& where, const Reading& reading);

/// The records that begin from `first` to `last`, both places that a message of that file said it is `at`.
struct Part {
  std::uint64_t first, last;
  const std::map<std::uint16_t, Channel>& channels;  ///< of the whole file
};
/// @throws Error as read()
void read_part(Source& file, const std::string& where, const Reading& reading, const Part& part);

}  // namespace tofray::mcap
