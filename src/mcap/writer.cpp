// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mcap/writer.h"

#include <algorithm>

#include "files/crc32.h"

namespace tofray::mcap {

Writer::Writer(GrowingFile& file, WriterOptions options) : file_(file), options_(std::move(options)) {
  std::string head(magic);
  Put put(head);
  const std::size_t at = put.begin(Opcode::header);
  put.text(options_.profile).text(options_.library);
  put.end(at);
  file_.write(head);
}

std::uint16_t Writer::add_schema(std::string_view name, std::string_view encoding, std::string_view definition) {
  std::string record;
  Put put(record);
  const std::size_t at = put.begin(Opcode::schema);
  put.u16(++schemas_).text(name).text(encoding).text(definition);  // 0 is no schema
  put.end(at);
  schema_records_ += record;
  file_.write(record);
  return static_cast<std::uint16_t>(schemas_);
}

std::uint16_t Writer::add_channel(std::uint16_t schema, std::string_view topic, std::string_view encoding, const Pairs& metadata) {
  const auto id = static_cast<std::uint16_t>(channels_.size());
  std::string record;
  Put put(record);
  const std::size_t at = put.begin(Opcode::channel);
  put.u16(id).u16(schema).text(topic).text(encoding).pairs(metadata);
  put.end(at);
  channels_.emplace_back();
  channel_records_ += record;
  file_.write(record);
  return id;
}

void Writer::attach(std::string_view name, std::string_view media_type, std::string_view data) {
  std::string record;
  Put put(record);
  const std::size_t at = put.begin(Opcode::attachment);
  put.u64(0).u64(0).text(name).text(media_type).u64(data.size()).raw(data);
  put.u32(files::crc32(std::string_view(record).substr(at)));
  put.end(at);
  Put index(attachment_indexes_);
  const std::size_t entry = index.begin(Opcode::attachment_index);
  index.u64(file_.size()).u64(record.size()).u64(0).u64(0).u64(data.size()).text(name).text(media_type);
  index.end(entry);
  ++attachments_;
  file_.write(record);
}

void Writer::add_metadata(std::string_view name, const Pairs& pairs) {
  std::string record;
  Put put(record);
  const std::size_t at = put.begin(Opcode::metadata);
  put.text(name).pairs(pairs);
  put.end(at);
  Put index(metadata_indexes_);
  const std::size_t entry = index.begin(Opcode::metadata_index);
  index.u64(file_.size()).u64(record.size()).text(name);
  index.end(entry);
  ++metadata_;
  file_.write(record);
}

void Writer::message(std::uint16_t channel, std::uint64_t log_ns, std::uint64_t publish_ns, std::string_view data) {
  Channel& to = channels_[channel];
  chunk_start_ = chunk_.empty() ? log_ns : std::min(chunk_start_, log_ns);
  chunk_end_ = chunk_.empty() ? log_ns : std::max(chunk_end_, log_ns);
  to.index.emplace_back(log_ns, chunk_.size());
  Put put(chunk_);
  chunk_ += static_cast<char>(Opcode::message);
  put.u64(2 + 4 + 8 + 8 + data.size()).u16(channel).u32(to.count++).u64(log_ns).u64(publish_ns).raw(data);
  ++messages_;
  if (chunk_.size() >= options_.chunk_bytes) end_chunk();
}

void Writer::end_chunk() {
  if (chunk_.empty()) return;
  start_ = chunks_ == 0 ? chunk_start_ : std::min(start_, chunk_start_);
  end_ = chunks_ == 0 ? chunk_end_ : std::max(end_, chunk_end_);
  const std::string_view compression = options_.zstd ? "zstd" : "";
  out_.clear();
  Put put(out_);
  const std::size_t at = put.begin(Opcode::chunk);
  put.u64(chunk_start_).u64(chunk_end_).u64(chunk_.size()).u32(files::crc32(chunk_)).text(compression);
  put.u64(0);  // how many bytes, known in a moment
  const std::size_t records = out_.size();
  if (options_.zstd)
    packer_.append(chunk_, out_);
  else
    out_ += chunk_;
  const std::uint64_t packed = out_.size() - records;
  for (std::size_t i = 0; i < 8; ++i) out_[records - 8 + i] = static_cast<char>(packed >> (8 * i) & 255);
  put.end(at);
  const std::uint64_t length = out_.size();

  std::string places;
  Put place(places);
  for (std::size_t id = 0; id < channels_.size(); ++id) {
    auto& index = channels_[id].index;
    if (index.empty()) continue;
    place.u16(id).u64(file_.size() + out_.size());
    const std::size_t entry = put.begin(Opcode::message_index);
    put.u16(id).u32(16 * index.size());
    for (const auto& [time, offset] : index) put.u64(time).u64(offset);
    put.end(entry);
    index.clear();
  }
  Put index(chunk_indexes_);
  const std::size_t entry = index.begin(Opcode::chunk_index);
  index.u64(chunk_start_).u64(chunk_end_).u64(file_.size()).u64(length).text(places).u64(out_.size() - length);
  index.text(compression).u64(packed).u64(chunk_.size());
  index.end(entry);
  ++chunks_;
  file_.write(out_);
  chunk_.clear();
}

void Writer::finish() {
  end_chunk();
  out_.clear();
  Put put(out_);
  std::size_t at = put.begin(Opcode::data_end);
  put.u32(file_.crc());
  put.end(at);
  const std::uint64_t summary = file_.size() + out_.size();
  const std::size_t summary_at = out_.size();

  std::string offsets;
  const auto group = [&](Opcode opcode, std::string_view records) {
    if (records.empty()) return;
    Put to(offsets);
    const std::size_t entry = to.begin(Opcode::summary_offset);
    to.number(static_cast<std::uint8_t>(opcode)).u64(file_.size() + out_.size()).u64(records.size());
    to.end(entry);
    out_ += records;
  };
  std::string statistics, counts;
  Put count(counts);
  for (std::size_t id = 0; id < channels_.size(); ++id)
    if (channels_[id].count > 0) count.u16(id).u64(channels_[id].count);
  Put put_statistics(statistics);
  at = put_statistics.begin(Opcode::statistics);
  put_statistics.u64(messages_).u16(schemas_).u32(channels_.size()).u32(attachments_).u32(metadata_).u32(chunks_);
  put_statistics.u64(start_).u64(end_).text(counts);
  put_statistics.end(at);
  group(Opcode::schema, schema_records_), group(Opcode::channel, channel_records_);
  group(Opcode::statistics, statistics), group(Opcode::chunk_index, chunk_indexes_);
  group(Opcode::attachment_index, attachment_indexes_), group(Opcode::metadata_index, metadata_indexes_);
  const std::uint64_t offsets_start = offsets.empty() ? 0 : file_.size() + out_.size();
  out_ += offsets;

  out_ += static_cast<char>(Opcode::footer);
  put.u64(8 + 8 + 4).u64(summary).u64(offsets_start);
  put.u32(files::crc32(std::string_view(out_).substr(summary_at)));
  out_ += magic;
  file_.write(out_);
}

}  // namespace tofray::mcap
