// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include "base/text.h"
#include "cli/console.h"
#include "commands/film_text.h"
#include "files/json.h"
#include "run/input_kind.h"
#include "tofray/mcap.h"

namespace tofray::app {

namespace {

double seconds_of(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

/// What made it, as the record `tofray` says.
std::string origin_of(const McapContents& of) {
  for (const auto& [name, pairs] : of.metadata) {
    if (name != "tofray") continue;
    std::string text;
    for (const auto& [key, value] : pairs)
      if (key != "meta") text += fmt::format("{}{} {}", text.empty() ? "" : ", ", base::printable(key), base::printable(value));
    return text + "\n";
  }
  return "";
}

std::string text_of(const McapContents& of) {
  std::string text =
      fmt::format("{}: MCAP, profile {}, by {}\n{}\n", base::printable(of.file), of.profile.empty() ? "none" : base::printable(of.profile),
                  of.library.empty() ? "an unknown writer" : base::printable(of.library), origin_of(of));
  text += fmt::format("{:<36} {:<38} {:>9} {:>9} {:>11}\n", "topic", "type", "messages", "Hz", "kB each");
  for (const McapContents::Channel& one : of.channels) {
    const double each = one.messages == 0 ? 0 : 1e-3 * static_cast<double>(one.bytes) / static_cast<double>(one.messages);
    const std::string rate = one.rate_hz > 0 ? fmt::format("{:.4g}", one.rate_hz) : "-";
    text += fmt::format("{:<36} {:<38} {:>9} {:>9} {:>11.1f}\n", base::printable(one.topic), base::printable(one.type), one.messages, rate,
                        each);
  }
  text += fmt::format("\n{} messages from {:.6f} s to {:.6f} s ({:.6f} s)\n", of.messages, seconds_of(of.first_ns), seconds_of(of.last_ns),
                      seconds_of(of.last_ns - of.first_ns));
  text += fmt::format("{} chunk{}, compression {}: {:.1f} MB, unpacked {:.1f} MB\n", of.chunks, of.chunks == 1 ? "" : "s",
                      of.compression.empty() ? "none" : base::printable(of.compression), 1e-6 * static_cast<double>(of.packed_bytes),
                      1e-6 * static_cast<double>(of.unpacked_bytes));
  for (const auto& [name, bytes] : of.attachments) text += fmt::format("attached: {} ({} bytes)\n", base::printable(name), bytes);
  return text;
}

files::Json json_of(const McapContents& of) {
  files::Json channels = files::Json::array(), attachments = files::Json::array(), metadata = files::Json::array();
  for (const McapContents::Channel& one : of.channels)
    channels.push(files::Json::object()
                      .set("topic", one.topic)
                      .set("type", one.type)
                      .set("encoding", one.encoding)
                      .set("messages", one.messages)
                      .set("bytes", one.bytes)
                      .set("rate_hz", one.rate_hz)
                      .set("first_ns", one.first_ns)
                      .set("last_ns", one.last_ns));
  for (const auto& [name, bytes] : of.attachments) attachments.push(files::Json::object().set("name", name).set("bytes", bytes));
  for (const auto& [name, pairs] : of.metadata) {
    files::Json values = files::Json::array();
    for (const auto& [key, value] : pairs) values.push(files::Json::object().set("key", key).set("value", value));
    metadata.push(files::Json::object().set("name", name).set("values", std::move(values)));
  }
  files::Json json = files::Json::object();
  json.set("file", of.file).set("profile", of.profile).set("library", of.library).set("complete", of.complete);
  json.set("bytes", of.bytes).set("lost_bytes", of.lost_bytes).set("messages", of.messages);
  json.set("first_ns", of.first_ns).set("last_ns", of.last_ns).set("chunks", of.chunks).set("compression", of.compression);
  json.set("packed_bytes", of.packed_bytes).set("unpacked_bytes", of.unpacked_bytes);
  return json.set("channels", std::move(channels)).set("attachments", std::move(attachments)).set("metadata", std::move(metadata));
}

}  // namespace

std::string ends_early(const std::string& file) {
  return fmt::format("warning: {} ends early: its writer was stopped, or it was cut; this is all up to its last whole chunk\n",
                     base::printable(file));
}

int inspect_film(const std::string& file, bool json) {
  run::refuse_missing(file);
  const McapContents contents = mcap_contents(file);
  if (!contents.complete) say(ends_early(file));
  print(json ? files::json_text(json_of(contents), 2) + "\n" : text_of(contents));
  return 0;
}

}  // namespace tofray::app
