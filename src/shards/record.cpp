// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "shards/record.h"

#include <fmt/core.h>

#include "base/text.h"
#include "files/json.h"
#include "files/read_bytes.h"
#include "shards/layout.h"
#include "tofray/error.h"

namespace tofray::shards {

namespace {

using files::Json;

constexpr const char* record_form = "tofray-shard-1";
constexpr std::size_t most_record_bytes = std::size_t{1} << 30;

/// Reads members of a document, and remembers whether all of them were there.
struct Reader {
  bool good = true;
  void number(const Json* json, std::uint64_t& into) { good = good && json != nullptr && json->unsigned_integer(into); }
  void text(const Json* json, std::string& into) {
    good = good && json != nullptr && json->string() != nullptr;
    if (good) into = *json->string();
  }
  const Json::Array& list(const Json* json) {
    static const Json::Array none;
    good = good && json != nullptr && json->is_array();
    return good ? *json->items() : none;
  }
  const Json::Object& map(const Json* json) {
    static const Json::Object none;
    good = good && json != nullptr && json->is_object();
    return good ? *json->members() : none;
  }
};

}  // namespace

bool Record::fits(const Plan& of, std::uint64_t number) const {
  return plan == of.id && shard == number && first == of.first_of(number) && count == of.count_of(number);
}

std::string record_text(const Record& record) {
  Json samples = Json::array(), holes = Json::array(), inputs = Json::object();
  for (const Record::Sample& one : record.samples) {
    Json members = Json::array();
    for (const Record::Member& member : one.members)
      members.push(Json::array().push(member.name).push(member.offset).push(member.bytes).push(std::uint64_t{member.crc}));
    samples.push(Json::object()
                     .set("sample", one.sample)
                     .set("view", one.view)
                     .set("pixels", one.pixels)
                     .set("valid", one.valid)
                     .set("members", std::move(members)));
  }
  for (const Record::Hole& one : record.holes) holes.push(Json::object().set("sample", one.sample).set("why", one.why));
  for (const auto& [name, sha256] : record.inputs) inputs.set(name, sha256);
  Json out = Json::object();
  out.set("format", record_form).set("plan", record.plan).set("shard", record.shard).set("first", record.first).set("count", record.count);
  out.set("bytes", record.bytes).set("sha256", record.sha256).set("holes", std::move(holes)).set("inputs", std::move(inputs));
  out.set("statistics", record.statistics.json())
      .set("members", "name, offset in the tar, bytes, CRC-32")
      .set("samples", std::move(samples));
  return files::json_text(out) + "\n";
}

Record parse_record(std::string_view text, const std::string& where) {
  const Json json = files::parse_json(text, where);
  Record out;
  Reader read;
  std::string format;
  read.text(json.find("format"), format), read.text(json.find("plan"), out.plan), read.text(json.find("sha256"), out.sha256);
  read.number(json.find("shard"), out.shard), read.number(json.find("first"), out.first), read.number(json.find("count"), out.count);
  read.number(json.find("bytes"), out.bytes);
  for (const Json& one : read.list(json.find("samples"))) {
    Record::Sample& sample = out.samples.emplace_back();
    read.number(one.find("sample"), sample.sample), read.number(one.find("view"), sample.view);
    read.number(one.find("pixels"), sample.pixels), read.number(one.find("valid"), sample.valid);
    for (const Json& member : read.list(one.find("members"))) {
      const Json::Array& parts = read.list(&member);
      read.good = read.good && parts.size() == 4;
      if (!read.good) break;
      Record::Member& into = sample.members.emplace_back();
      std::uint64_t crc = 0;
      read.text(&parts[0], into.name), read.number(&parts[1], into.offset), read.number(&parts[2], into.bytes), read.number(&parts[3], crc);
      into.crc = static_cast<std::uint32_t>(crc);
    }
  }
  for (const Json& one : read.list(json.find("holes"))) {
    Record::Hole& hole = out.holes.emplace_back();
    read.number(one.find("sample"), hole.sample), read.text(one.find("why"), hole.why);
  }
  for (const auto& [name, sha256] : read.map(json.find("inputs"))) read.text(&sha256, out.inputs[name]);
  if (!read.good || format != record_form)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: this is no record of a shard\n  expected a file of the format {}", where, record_form));
  const Json* statistics = json.find("statistics");
  out.statistics = statistics_of(statistics != nullptr ? *statistics : Json::object(), where);
  return out;
}

std::optional<std::string> read_record_text(const std::filesystem::path& folder, std::uint64_t shard) {
  return files::read_bytes_if_there((folder / record_name(shard)).native(), most_record_bytes);
}

std::optional<Record> read_record(const std::filesystem::path& folder, std::uint64_t shard) {
  const std::optional<std::string> text = read_record_text(folder, shard);
  if (!text) return {};
  return parse_record(*text, (folder / record_name(shard)).native());
}

bool is_complete(const std::filesystem::path& folder, const Plan& plan, std::uint64_t shard) {
  try {
    const std::optional<Record> record = read_record(folder, shard);
    std::error_code fault;
    const std::uintmax_t bytes = std::filesystem::file_size(folder / tar_name(shard), fault);
    return record && record->fits(plan, shard) && !fault && bytes == record->bytes;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::bad_input) return false;
    throw;
  }
}

}  // namespace tofray::shards
