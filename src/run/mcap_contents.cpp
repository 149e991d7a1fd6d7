// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include "mcap/reader.h"
#include "run/mcap_contents.h"

namespace tofray {

namespace run {

McapContents contents_of(mcap::Source& source, const std::string& where) {
  McapContents out;
  out.file = where;
  std::map<std::string, McapContents::Channel> channels;
  mcap::Reading reading;
  reading.message = [&](const mcap::SeenMessage& message) {
    McapContents::Channel& to = channels[message.channel.topic];
    const auto when = static_cast<std::int64_t>(message.log_ns);
    if (to.messages == 0) {
      to.topic = message.channel.topic, to.type = message.channel.schema.name, to.encoding = message.channel.encoding;
      to.first_ns = to.last_ns = when;
    }
    to.first_ns = std::min(to.first_ns, when), to.last_ns = std::max(to.last_ns, when);
    ++to.messages, to.bytes += message.data.size();
    out.first_ns = out.messages == 0 ? when : std::min(out.first_ns, when);
    out.last_ns = out.messages == 0 ? when : std::max(out.last_ns, when);
    ++out.messages;
  };
  reading.attachment = [&](std::string_view name, std::string_view, std::string_view data) {
    out.attachments.emplace_back(name, data.size());
  };
  reading.metadata = [&](std::string_view name, const mcap::Pairs& pairs) { out.metadata.emplace_back(name, pairs); };
  const mcap::Ended ended = mcap::read(source, where, reading);
  out.profile = ended.profile, out.library = ended.library;
  out.complete = ended.complete, out.bytes = source.size(), out.lost_bytes = source.size() - ended.bytes;
  out.chunks = ended.chunks, out.unpacked_bytes = ended.unpacked_bytes, out.packed_bytes = ended.packed_bytes;
  for (const auto& [name, count] : ended.compressions)
    out.compression += (out.compression.empty() ? "" : ",") + (name.empty() ? std::string("none") : name);
  for (const auto& [id, channel] : ended.channels)  // those without messages
    if (!channels.contains(channel.topic)) channels[channel.topic] = {channel.topic, channel.schema.name, channel.encoding};
  for (auto& [topic, channel] : channels) {
    if (channel.messages > 1 && channel.last_ns > channel.first_ns)
      channel.rate_hz = static_cast<double>(channel.messages - 1) / (1e-9 * static_cast<double>(channel.last_ns - channel.first_ns));
    out.channels.push_back(std::move(channel));
  }
  return out;
}

}  // namespace run

McapContents mcap_contents(const std::string& file) {
  const std::unique_ptr<mcap::Source> source = mcap::open_file(file);
  return run::contents_of(*source, file);
}

}  // namespace tofray
