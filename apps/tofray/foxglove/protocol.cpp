// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "foxglove/protocol.h"

#include <limits>

#include "base/text.h"
#include "files/json.h"
#include "tofray/error.h"
#include "tofray/messages.h"
#include "tofray/version.h"

namespace tofray::foxglove {

namespace {

using files::Json;
constexpr std::size_t most_values = 10'000;

/// Little-endian.
template <class Whole>
void put(char* at, Whole value) {
  for (std::size_t i = 0; i < sizeof(Whole); ++i) at[i] = static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i));
}

Json channel_json(const Channel& channel) {
  return Json::object()
      .set("id", channel.id)
      .set("topic", channel.topic.name)
      .set("encoding", "cdr")
      .set("schemaName", channel.topic.type)
      .set("schemaEncoding", "ros2msg")
      .set("schema", message_definition(channel.topic.type));
}

[[noreturn]] void refuse(const std::string& why) { throw Error(ErrorKind::bad_input, why); }

std::uint32_t number_of(const Json* found, const char* name) {
  std::uint64_t number = 0;
  if (found == nullptr || !found->unsigned_integer(number) || number > std::numeric_limits<std::uint32_t>::max())
    refuse(std::string(name) + " is no whole number of 0 to 4294967295");
  return static_cast<std::uint32_t>(number);
}

const Json::Array& list_of(const Json& message, const char* name) {
  const Json* found = message.find(name);
  if (found == nullptr || !found->is_array()) refuse(std::string("the message has no list ") + name);
  return *found->items();
}

Subscribe subscribe_of(const Json& message) {
  Subscribe out;
  for (const Json& one : list_of(message, "subscriptions")) {
    if (!one.is_object()) refuse("a subscription is no object");
    out.subscriptions.push_back({number_of(one.find("id"), "id"), number_of(one.find("channelId"), "channelId")});
  }
  return out;
}

Unsubscribe unsubscribe_of(const Json& message) {
  Unsubscribe out;
  for (const Json& one : list_of(message, "subscriptionIds")) out.subscriptions.push_back(number_of(&one, "a subscriptionId"));
  return out;
}

}  // namespace

std::string server_info(const std::string& session) {
  return json_text(Json::object()
                       .set("op", "serverInfo")
                       .set("name", std::string("tofray ") + version())
                       .set("capabilities", Json::list(std::vector<const char*>{"time"}))
                       .set("metadata", Json::object())
                       .set("sessionId", session));
}

std::string advertisement(const std::vector<Channel>& channels) {
  Json all = Json::array();
  for (const Channel& one : channels) all.push(channel_json(one));
  return json_text(Json::object().set("op", "advertise").set("channels", std::move(all)));
}

std::string status(Level level, const std::string& message) {
  return json_text(Json::object().set("op", "status").set("level", static_cast<int>(level)).set("message", message));
}

std::array<char, 13> data_head(std::uint32_t subscription, std::int64_t time_ns) {
  std::array<char, 13> out{};
  out[0] = 1;
  put(out.data() + 1, subscription);
  put(out.data() + 5, time_ns);
  return out;
}

std::string time_message(std::int64_t time_ns) {
  std::string out(9, '\2');
  put(out.data() + 1, time_ns);
  return out;
}

Asked asked_by(std::string_view text) {
  const Json message = files::parse_json(text, "a reader's message", most_values);
  const Json* op = message.is_object() ? message.find("op") : nullptr;
  if (op == nullptr || !op->is_string()) refuse("the message has no text op");
  if (*op->string() == "subscribe") return subscribe_of(message);
  if (*op->string() == "unsubscribe") return unsubscribe_of(message);
  return Other{*op->string()};
}

}  // namespace tofray::foxglove
