// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mcap/compression.h"
#include "mcap/growing_file.h"
#include "mcap/records.h"

namespace tofray::mcap {

struct WriterOptions {
  std::string profile, library;
  bool zstd = true;                       ///< only where has_zstd()
  std::size_t chunk_bytes = 1024 * 1024;  ///< a chunk ends with the message by which it has so many
};

/// Writes an MCAP file: schemas and channels, then messages in chunks with their indexes, then a summary. A chunk goes to the disk whole, with
/// its indexes behind it. No clock is asked: the same calls give the same bytes.
class Writer {
 public:
  Writer(GrowingFile& file, WriterOptions options);
  std::uint16_t add_schema(std::string_view name, std::string_view encoding, std::string_view definition);
  std::uint16_t add_channel(std::uint16_t schema, std::string_view topic, std::string_view encoding, const Pairs& metadata = {});
  void attach(std::string_view name, std::string_view media_type, std::string_view data);
  void add_metadata(std::string_view name, const Pairs& pairs);
  void message(std::uint16_t channel, std::uint64_t log_ns, std::uint64_t publish_ns, std::string_view data);
  /// Ends the chunk that has messages, if there is one.
  void end_chunk();
  /// Ends the data and writes the summary. Nothing may be added after it.
  void finish();

 private:
  struct Channel {
    std::uint64_t count = 0;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> index;  ///< of the chunk: log time, place
  };
  void put_data(std::string_view record);
  GrowingFile& file_;
  WriterOptions options_;
  Packer packer_;
  std::string chunk_, out_;
  std::uint64_t chunk_start_ = 0, chunk_end_ = 0, start_ = 0, end_ = 0, messages_ = 0;
  std::vector<Channel> channels_;
  std::string schema_records_, channel_records_, chunk_indexes_, attachment_indexes_, metadata_indexes_;
  std::uint64_t schemas_ = 0, chunks_ = 0, attachments_ = 0, metadata_ = 0;
};

}  // namespace tofray::mcap
