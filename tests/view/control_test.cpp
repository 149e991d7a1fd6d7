// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/control.h"

#include <gtest/gtest.h>

#include <random>

#include "support/text.h"
#include "view/meter.h"
#include "view/wire.h"

namespace tofray::test {
namespace {

using namespace view;

TEST(control, is_read_of_every_type) {
  const auto want = std::get<Want>(parse_control(R"({"type":"want","arrays":["flags","z_m","z_m"],"rate":2.5})"));
  EXPECT_EQ(want.arrays, (std::vector<std::uint16_t>{*find_wire_array("z_m"), *find_wire_array("flags")}));
  EXPECT_EQ(want.rate, (Rate{Rate::Kind::number, 2.5}));
  EXPECT_EQ(std::get<Want>(parse_control(R"({"type":"want","arrays":[],"rate":"max"})")).rate, (Rate{Rate::Kind::most, 0}));
  EXPECT_FALSE(std::get<Visible>(parse_control(R"({"type":"visible","visible":false})")).visible);
  EXPECT_EQ(std::get<Acknowledge>(parse_control(R"({"type":"ack","sequence":4294967295})")).sequence, 4294967295u);
  EXPECT_TRUE(std::get<Play>(parse_control(R"({"type":"play"})")).playing);
  EXPECT_FALSE(std::get<Play>(parse_control(R"({"type":"pause"})")).playing);
  EXPECT_EQ(std::get<Seek>(parse_control(R"({"type":"seek","frame":12})")).frame, 12u);
  const auto pixel = std::get<PixelQuestion>(parse_control(R"({"type":"pixel","id":3,"u":4,"v":5})"));
  EXPECT_EQ(pixel.id, 3u);
  EXPECT_EQ(pixel.u, 4);
  EXPECT_EQ(pixel.v, 5);
  EXPECT_EQ(std::get<Fit>(parse_control(R"({"type":"fit","array":"z_m"})")).array, "z_m");
  const auto set = std::get<Edit>(parse_control(R"({"type":"set","id":1,"key":"a.b","text":""})"));
  EXPECT_EQ(set.key, "a.b");
  EXPECT_EQ(set.text, "");
  EXPECT_FALSE(std::get<Edit>(parse_control(R"({"type":"unset","id":1,"key":"a.b"})")).text.has_value());
  EXPECT_EQ(std::get<Edit>(parse_control(R"({"type":"seed","id":1,"seed":18446744073709551615})")).seed, UINT64_MAX);
}

TEST(control, that_is_wrong_is_answered_with_its_id_and_what_is_wrong) {
  struct Wrong {
    const char *message, *says;
  };
  for (const Wrong& one : {Wrong{"", "message"},
                           Wrong{"{", "message"},
                           Wrong{"[]", "no JSON object"},
                           Wrong{"null", "no JSON object"},
                           Wrong{"{}", "has no \"type\""},
                           Wrong{R"({"type":7})", "is no text"},
                           Wrong{R"({"type":"wnat"})", "of the type \"wnat\""},
                           Wrong{R"({"type":"want"})", "has no \"arrays\""},
                           Wrong{R"({"type":"want","arrays":"z_m"})", "no list"},
                           Wrong{R"({"type":"want","arrays":[1]})", "no text"},
                           Wrong{R"({"type":"want","arrays":["z_n"]})", "did you mean \"z_m\"?"},
                           Wrong{R"({"type":"want","arrays":[],"rate":"fast"})", "rate"},
                           Wrong{R"({"type":"want","arrays":[],"rate":0})", "rate"},
                           Wrong{R"({"type":"want","arrays":[],"rate":1e9})", "rate"},
                           Wrong{R"({"type":"visible","visible":1})", "neither true nor false"},
                           Wrong{R"({"type":"ack","sequence":-1})", "whole number"},
                           Wrong{R"({"type":"ack","sequence":4294967296})", "whole number"},
                           Wrong{R"({"type":"seek","frame":1.5})", "whole number"},
                           Wrong{R"({"type":"seek","frame":1000000001})", "whole number"},
                           Wrong{R"({"type":"pixel","id":1,"u":-1,"v":0})", "whole number"},
                           Wrong{R"({"type":"pixel","id":1,"u":1e9,"v":0})", "whole number"},
                           Wrong{R"({"type":"pixel","u":1,"v":0})", "has no \"id\""},
                           Wrong{R"({"type":"set","id":1,"key":"","text":"1"})", "no key"},
                           Wrong{R"({"type":"set","id":1,"key":"a=b","text":"1"})", "no key"},
                           Wrong{R"({"type":"set","id":1,"key":"a"})", "has no \"text\""},
                           Wrong{R"({"type":"set","id":1,"key":"a","text":1})", "is no text"},
                           Wrong{R"({"type":"seed","id":1,"seed":-3})", "whole number"},
                           Wrong{R"({"type":"pause","type":"play"})", "twice"}}) {
    const Control read = parse_control(one.message);
    ASSERT_TRUE(std::holds_alternative<Refused>(read)) << one.message;
    EXPECT_TRUE(has(std::get<Refused>(read).text + std::get<Refused>(read).more, one.says))
        << one.message << ": " << std::get<Refused>(read).text;
  }
  EXPECT_EQ(std::get<Refused>(parse_control(R"({"type":"set","id":17})")).id, 17u);
  EXPECT_FALSE(std::get<Refused>(parse_control(R"({"type":"set","id":"17"})")).id.has_value());
  EXPECT_TRUE(std::holds_alternative<Refused>(parse_control(std::string(60'000, '['))));
}

TEST(rate, is_own_max_or_a_number) {
  EXPECT_EQ(parse_rate("own"), (Rate{Rate::Kind::own, 0}));
  EXPECT_EQ(parse_rate("30"), (Rate{Rate::Kind::number, 30}));
  for (const char* wrong : {"", "fast", "0", "-1", "1e9", "nan", "inf", "3 ", "3Hz"}) EXPECT_FALSE(parse_rate(wrong)) << wrong;
}

// Heads of frames are found wherever the stream is cut.
TEST(meter, counts_pieces_and_frames_however_the_bytes_come) {
  const FrameMeter::Clock::time_point now{};
  const auto taken = [&](const std::string& bytes, std::size_t step) {
    FrameMeter meter;
    for (std::size_t at = 0; at < bytes.size(); at += step)
      if (!meter.take(bytes.data() + at, std::min(step, bytes.size() - at), now)) return false;
    return true;
  };
  const std::string mask(4, 'm');
  const std::string small = "\x81\x83" + mask + "abc", large = std::string("\x81\xfe\x01\x00", 4) + mask + std::string(256, 'x');
  const std::string piece = std::string("\x00\x80", 2) + mask, last = std::string("\x80\x80", 2) + mask,
                    ping = std::string("\x89\x80", 2) + mask;
  std::string pieces, good;
  for (int i = 0; i < 63; ++i) pieces += piece + ping;
  for (int i = 0; i < 300; ++i) good += small + large + ping;
  for (const std::size_t step : {1u, 2u, 3u, 7u, 64u, 100'000u}) {
    EXPECT_TRUE(taken(good, step));
    EXPECT_TRUE(taken(pieces + last + pieces, step));
    EXPECT_FALSE(taken(pieces + piece, step));
    std::string flood;
    for (int i = 0; i <= FrameMeter::most_frames_per_second; ++i) flood += ping;
    EXPECT_FALSE(taken(flood, step));
    EXPECT_TRUE(taken(flood.substr(ping.size()), step));
  }
}

}  // namespace
}  // namespace tofray::test
