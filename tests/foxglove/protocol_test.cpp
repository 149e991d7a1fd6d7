// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What readers of a stream say and are told, byte by byte.
#include "foxglove/protocol.h"

#include <gtest/gtest.h>

#include "files/json.h"
#include "support/text.h"
#include "tofray/error.h"
#include "tofray/messages.h"

namespace tofray::test {
namespace {

using namespace std::string_literals;

TEST(protocol, of_data_has_a_head_of_13_little_endian_bytes) {
  const auto head = foxglove::data_head(0x04030201, 0x0807060504030201);
  EXPECT_EQ(std::string(head.data(), head.size()), "\1\1\2\3\4\1\2\3\4\5\6\7\10"s);
  EXPECT_EQ(foxglove::time_message(0x01020304050607FF), "\2\xFF\7\6\5\4\3\2\1"s);
}

TEST(protocol, says_what_there_is_to_read) {
  const files::Json info = files::parse_json(foxglove::server_info("17"), "info");
  EXPECT_EQ(*info.find("op")->string(), "serverInfo");
  EXPECT_EQ(*info.find("sessionId")->string(), "17");
  EXPECT_EQ(*info.find("capabilities")->items()->front().string(), "time");
  const files::Json told =
      files::parse_json(foxglove::advertisement({{3, {"/camera/points", "sensor_msgs/msg/PointCloud2", "", true}}}), "channels");
  EXPECT_EQ(*told.find("op")->string(), "advertise");
  const files::Json& one = told.find("channels")->items()->front();
  std::uint64_t id = 0;
  EXPECT_TRUE(one.find("id")->unsigned_integer(id) && id == 3);
  for (const auto& [key, value] :
       std::vector<std::pair<const char*, std::string>>{{"topic", "/camera/points"},
                                                        {"encoding", "cdr"},
                                                        {"schemaName", "sensor_msgs/msg/PointCloud2"},
                                                        {"schemaEncoding", "ros2msg"},
                                                        {"schema", message_definition("sensor_msgs/msg/PointCloud2")}})
    EXPECT_EQ(*one.find(key)->string(), value) << key;
  const files::Json status = files::parse_json(foxglove::status(foxglove::Level::error, "no \"x\"\xFF"), "status");
  EXPECT_TRUE(status.find("level")->unsigned_integer(id) && id == 2);
}

TEST(protocol, takes_subscriptions_and_their_ends) {
  const auto wanted = std::get<foxglove::Subscribe>(
      foxglove::asked_by(R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":4294967295},{"id":7,"channelId":2,"more":1}]})"));
  EXPECT_EQ(wanted.subscriptions, (std::vector<foxglove::Subscription>{{0, 4294967295u}, {7, 2}}));
  const auto ended = std::get<foxglove::Unsubscribe>(foxglove::asked_by(R"({"op":"unsubscribe","subscriptionIds":[7,0]})"));
  EXPECT_EQ(ended.subscriptions, (std::vector<std::uint32_t>{7, 0}));
  EXPECT_EQ(std::get<foxglove::Other>(foxglove::asked_by(R"({"op":"getParameters"})")).op, "getParameters");
}

TEST(protocol, refuses_what_is_none_of_it_with_the_reason) {
  for (const auto& [text, reason] : std::vector<std::pair<std::string, std::string>>{
           {"", "a reader's message"},
           {"[]", "no text op"},
           {R"({"op":null})", "no text op"},
           {R"({"op":"subscribe","subscriptions":{}})", "no list subscriptions"},
           {R"({"op":"subscribe","subscriptions":[1]})", "is no object"},
           {R"({"op":"subscribe","subscriptions":[{"channelId":1}]})", "id is no whole number"},
           {R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":1}]})", "id is no whole number"},
           {R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":4294967296}]})", "channelId is no whole number"},
           {R"({"op":"unsubscribe"})", "no list subscriptionIds"},
           {R"({"op":"unsubscribe","subscriptionIds":[-1]})", "a subscriptionId is no whole number"}}) {
    try {
      (void)foxglove::asked_by(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_TRUE(has(error.what(), reason)) << error.what();
    }
  }
}

}  // namespace
}  // namespace tofray::test
