// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/control.h"

#include <gtest/gtest.h>

#include <algorithm>
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
  EXPECT_EQ(set.kind, Edit::Kind::set);
  EXPECT_EQ(set.key, "a.b");
  EXPECT_EQ(set.text, "");
  EXPECT_EQ(set.side, Side::a);
  EXPECT_EQ(std::get<Edit>(parse_control(R"({"type":"unset","id":1,"key":"a.b","side":"b"})")).kind, Edit::Kind::unset);
  EXPECT_EQ(std::get<Edit>(parse_control(R"({"type":"unset","id":1,"key":"a.b","side":"b"})")).side, Side::b);
  EXPECT_EQ(std::get<Edit>(parse_control(R"({"type":"seed","id":1,"seed":18446744073709551615})")).seed, UINT64_MAX);
  const auto state =
      std::get<Edit>(parse_control(R"({"type":"state","id":4,"overrides":[{"key":"a","text":"1"},{"key":"b","text":"2"}],"seed":7})"));
  EXPECT_EQ(state.kind, Edit::Kind::state);
  EXPECT_EQ(state.overrides, (Overrides{{"a", "1"}, {"b", "2"}}));
  EXPECT_EQ(state.seed, 7u);
  EXPECT_FALSE(std::get<Edit>(parse_control(R"({"type":"state","id":4,"overrides":[]})")).seed);
  const auto other = std::get<Edit>(parse_control(R"({"type":"other","id":5,"overrides":[],"scene":"room"})"));
  EXPECT_EQ(other.kind, Edit::Kind::open);
  EXPECT_EQ(other.side, Side::b);
  EXPECT_EQ(other.scene, "room");
  EXPECT_EQ(std::get<Edit>(parse_control(R"({"type":"other","id":5,"overrides":null})")).kind, Edit::Kind::close);
  EXPECT_EQ(std::get<Query>(parse_control(R"({"type":"controls","id":6,"side":"b"})")).side, Side::b);
  EXPECT_EQ(std::get<Query>(parse_control(R"({"type":"save","id":7})")).kind, Query::Kind::save);
  EXPECT_EQ(std::get<Acknowledge>(parse_control(R"({"type":"ack","sequence":1,"channel":1})")).side, Side::b);
  EXPECT_EQ(std::get<PixelQuestion>(parse_control(R"({"type":"pixel","id":3,"u":4,"v":5,"side":"b"})")).side, Side::b);
  const auto why = std::get<WhyQuestion>(parse_control(R"({"type":"why","id":3,"side":"b","region":[1,2,64,65]})"));
  EXPECT_TRUE(why.region && why.u0 == 1 && why.v0 == 2 && why.u1 == 64 && why.v1 == 65 && why.side == Side::b && why.id == 3);
  const auto inquiry = [](const char* text) { return std::get<Inquiry>(parse_control(text)); };
  EXPECT_EQ(std::get<SceneQuestion>(inquiry(R"({"type":"view3d","id":9,"side":"b"})")).side, Side::b);
  const auto drag = std::get<Drag>(inquiry(R"({"type":"drag","id":10,"object":2,"from":[3,4],"to":[-5.5,6],"how":"along","base":7})"));
  EXPECT_TRUE(drag.id == 10 && drag.object == 2 && drag.from_u == 3 && drag.from_v == 4 && drag.to_u == -5.5 && drag.to_v == 6);
  EXPECT_EQ(drag.how, Drag::How::along);
  EXPECT_EQ(drag.base, 7u);
  const auto place =
      std::get<Place>(inquiry(R"({"type":"place","id":11,"object":2,"position":[0.1,0,2.3],"rotation":[[0,-1,0],[1,0,0],[0,0,1]]})"));
  EXPECT_TRUE(place.object == 2 && place.position == (Vec3{0.1, 0, 2.3}) && !place.base);
  EXPECT_EQ((*place.rotation)[0], (Vec3{0, -1, 0}));
  const auto camera =
      std::get<Place>(inquiry(R"({"type":"camera","id":12,"position":null,"rotation":[[1,0,0],[0,1,0],[0,0,1]],"base":3})"));
  EXPECT_TRUE(!camera.object && !camera.position && camera.rotation && camera.base == 3u);
  const auto measure = std::get<Measure>(inquiry(R"({"type":"measure","id":13,"a":[1,2],"b":[3,4]})"));
  EXPECT_TRUE(measure.u[0] == 1 && measure.v[0] == 2 && measure.u[1] == 3 && measure.v[1] == 4);
  const auto region = std::get<RegionQuestion>(inquiry(R"({"type":"region","id":14,"region":[1,2,300,200]})"));
  EXPECT_TRUE(region.u0 == 1 && region.v0 == 2 && region.u1 == 300 && region.v1 == 200);
  EXPECT_EQ(std::get<Temporal>(inquiry(R"({"type":"temporal","id":15,"frames":50})")).frames, 50);
  EXPECT_EQ(std::get<Temporal>(inquiry(R"({"type":"temporal","id":15})")).frames, 200);
  EXPECT_EQ(std::get<Screenshot>(inquiry(R"({"type":"screenshot","id":16,"side":"b"})")).side, Side::b);
  EXPECT_EQ(std::get<Restore>(inquiry(R"({"type":"restore","id":17,"text":"{}"})")).text, "{}");
  const auto order = [](const char* text) { return std::get<Order>(parse_control(text)); };
  const Order record = order(R"({"type":"record","id":18,"first":3,"frames":4,"side":"b"})");
  EXPECT_TRUE(record.kind == Order::Kind::record && record.id == 18 && record.first == 3 && record.frames == 4 && record.side == Side::b);
  EXPECT_EQ(order(R"({"type":"export","id":19,"first":0,"frames":1})").kind, Order::Kind::page);
  EXPECT_EQ(order(R"({"type":"record_stop","id":20})").kind, Order::Kind::stop);
  EXPECT_TRUE(std::holds_alternative<Refused>(parse_control(R"({"type":"record","id":18,"first":3,"frames":0})")));
  EXPECT_TRUE(std::holds_alternative<Refused>(parse_control(R"({"type":"record","id":18,"first":3,"frames":10001})")));
}

// Each member of each message is left out, and stands as something else.
TEST(control, of_every_type_is_refused_where_a_member_is_not_what_it_has_to_be) {
  struct Message {
    const char* type;
    std::vector<std::pair<std::string, std::string>> members;  ///< name and a good value
    std::vector<std::string> optional;
  };
  const std::vector<Message> all = {
      {"want", {{"arrays", R"(["z_m"])"}, {"rate", "5"}}, {"rate"}},
      {"visible", {{"visible", "true"}}, {}},
      {"ack", {{"sequence", "1"}, {"channel", "1"}}, {"channel"}},
      {"seek", {{"frame", "1"}}, {}},
      {"pixel", {{"id", "1"}, {"u", "1"}, {"v", "1"}, {"side", R"("b")"}}, {"side"}},
      {"why", {{"id", "1"}, {"u", "1"}, {"v", "1"}, {"side", R"("b")"}}, {"side"}},
      {"why", {{"id", "1"}, {"region", "[1,2,3,4]"}, {"side", R"("b")"}}, {"side"}},
      {"fit", {{"array", R"("z_m")"}}, {}},
      {"set", {{"id", "1"}, {"key", R"("a.b")"}, {"text", R"("1")"}, {"side", R"("b")"}}, {"side"}},
      {"unset", {{"id", "1"}, {"key", R"("a.b")"}, {"side", R"("b")"}}, {"side"}},
      {"seed", {{"id", "1"}, {"seed", "1"}, {"side", R"("b")"}}, {"side"}},
      {"state", {{"id", "1"}, {"overrides", R"([{"key":"a","text":"1"}])"}, {"seed", "1"}, {"side", R"("b")"}}, {"seed", "side"}},
      {"other", {{"id", "1"}, {"overrides", R"([{"key":"a","text":"1"}])"}, {"seed", "1"}, {"scene", R"("room")"}}, {"seed", "scene"}},
      {"controls", {{"id", "1"}, {"side", R"("b")"}}, {"side"}},
      {"save", {{"id", "1"}, {"side", R"("b")"}}, {"side"}},
      {"view3d", {{"id", "1"}, {"side", R"("b")"}}, {"side"}},
      {"drag",
       {{"id", "1"}, {"object", "1"}, {"from", "[1,2]"}, {"to", "[1.5,-2]"}, {"how", R"("turn")"}, {"base", "1"}, {"side", R"("b")"}},
       {"base", "side"}},
      {"place",
       {{"id", "1"},
        {"object", "1"},
        {"position", "[1,2,3]"},
        {"rotation", "[[1,0,0],[0,1,0],[0,0,1]]"},
        {"base", "1"},
        {"side", R"("b")"}},
       {"base", "side"}},
      {"camera",
       {{"id", "1"}, {"position", "[1,2,3]"}, {"rotation", "[[1,0,0],[0,1,0],[0,0,1]]"}, {"base", "1"}, {"side", R"("b")"}},
       {"base", "side"}},
      {"measure", {{"id", "1"}, {"a", "[1,2]"}, {"b", "[1,2]"}, {"side", R"("b")"}}, {"side"}},
      {"region", {{"id", "1"}, {"region", "[1,2,3,4]"}, {"side", R"("b")"}}, {"side"}},
      {"temporal", {{"id", "1"}, {"frames", "5"}, {"side", R"("b")"}}, {"frames", "side"}},
      {"screenshot", {{"id", "1"}, {"side", R"("b")"}}, {"side"}},
      {"restore", {{"id", "1"}, {"text", R"("{}")"}}, {}},
      {"record", {{"id", "1"}, {"first", "1"}, {"frames", "5"}, {"side", R"("b")"}}, {"side"}},
      {"export", {{"id", "1"}, {"first", "1"}, {"frames", "5"}, {"side", R"("b")"}}, {"side"}},
      {"record_stop", {{"id", "1"}}, {}}};
  const char* const others[] = {"-1",
                                "1.5",
                                "1e30",
                                "18446744073709551616",
                                "{}",
                                "[[]]",
                                "[1]",
                                R"([{"key":"a"}])",
                                R"([{"text":"a"}])",
                                R"([{"key":1,"text":"a"}])",
                                R"([{"key":"a","text":1}])",
                                R"([{"key":"a=b","text":"1"}])",
                                R"([{"key":"","text":"1"}])",
                                R"([null])",
                                R"(["a=1"])",
                                R"({"a":"1"})",
                                "\"\"",
                                "\"c\"",
                                "\"\\ud800\"",
                                "nul"};
  int refused = 0;
  for (const Message& message : all) {
    const auto text_of = [&](const std::string& left_out, const std::string& changed, const std::string& to) {
      std::string text = std::string(R"({"type":")") + message.type + '"';
      for (const auto& [name, value] : message.members)
        if (name != left_out) text += ",\"" + name + "\":" + (name == changed ? to : value);
      return text + "}";
    };
    EXPECT_FALSE(std::holds_alternative<Refused>(parse_control(text_of({}, {}, {})))) << message.type;
    for (const auto& [name, value] : message.members) {
      const bool may_lack = std::find(message.optional.begin(), message.optional.end(), name) != message.optional.end();
      EXPECT_EQ(std::holds_alternative<Refused>(parse_control(text_of(name, {}, {}))), !may_lack) << message.type << " without " << name;
      for (const char* other : others) {
        const bool is_text = name == "text" || name == "array", names_all = name == "scene" || name == "key";
        const std::string to = other;
        if (is_text && to.starts_with('"') && to != "\"\\ud800\"") continue;  // any text is good
        if (names_all && to == "\"c\"") continue;
        if (name == "rate" && to == "1.5") continue;
        EXPECT_TRUE(std::holds_alternative<Refused>(parse_control(text_of({}, name, to)))) << text_of({}, name, to);
        ++refused;
      }
      if (name == "overrides" && std::string(message.type) == "other") continue;  // it closes side B
      if (name == "position" || name == "rotation") continue;                     // as it is
      EXPECT_TRUE(std::holds_alternative<Refused>(parse_control(text_of({}, name, "null")))) << text_of({}, name, "null");
    }
  }
  EXPECT_GT(refused, 20 * 13);
}

TEST(control, that_is_wrong_is_answered_with_its_id_and_what_is_wrong) {
  struct Wrong {
    const char *message, *says;
  };
  for (const Wrong& one :
       {Wrong{"", "message"},
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
        Wrong{R"({"type":"why","u":1,"v":0})", "has no \"id\""},
        Wrong{R"({"type":"why","id":1,"u":1})", "has no \"v\""},
        Wrong{R"({"type":"why","id":1,"u":1,"v":1,"region":[0,0,1,1]})", "a pixel and a region"},
        Wrong{R"({"type":"why","id":1,"region":[0,0,1]})", "two corners"},
        Wrong{R"({"type":"why","id":1,"region":[2,0,1,1]})", "two corners"},
        Wrong{R"({"type":"why","id":1,"region":[0,2,1,1]})", "two corners"},
        Wrong{R"({"type":"why","id":1,"region":[0,0,1,16385]})", "two corners"},
        Wrong{R"({"type":"why","id":1,"region":[0,0,64,1]})", "64 x 64"},
        Wrong{R"({"type":"why","id":1,"region":[0,0,1,64]})", "64 x 64"},
        Wrong{R"({"type":"drag","id":1,"object":1,"from":[0,0],"to":[0,0],"how":"up"})", "parallel, along, turn or scale"},
        Wrong{R"({"type":"drag","id":1,"object":1,"from":[0.5,0],"to":[0,0],"how":"turn"})", "\"from\" is no pixel"},
        Wrong{R"({"type":"drag","id":1,"object":1,"from":[0,0],"to":[0,20000],"how":"turn"})", "\"to\" is no place"},
        Wrong{R"({"type":"drag","id":1,"object":-1,"from":[0,0],"to":[0,0],"how":"turn"})", "whole number"},
        Wrong{R"({"type":"place","id":1,"object":1,"position":null,"rotation":null})", "neither a position nor"},
        Wrong{R"({"type":"place","id":1,"object":1,"position":[0,0,1e7],"rotation":null})", "no place in the world"},
        Wrong{R"({"type":"place","id":1,"object":1,"position":[0,0],"rotation":null})", "no place in the world"},
        Wrong{R"({"type":"camera","id":1,"position":null,"rotation":[[1,0],[0,1]]})", "three rows"},
        Wrong{R"({"type":"camera","id":1,"position":null,"rotation":[[1,0,0],[0,1,0],[0,0,-1]]})", "mirrors"},
        Wrong{R"({"type":"camera","id":1,"position":null,"rotation":[[1,0.05,0],[0,0.99875,0],[0,0,1]]})", "shears"},
        Wrong{R"({"type":"measure","id":1,"a":[0,0]})", "has no \"b\""},
        Wrong{R"({"type":"region","id":1,"region":[5,0,4,4]})", "two corners"},
        Wrong{R"({"type":"temporal","id":1,"frames":1})", "two frames"},
        Wrong{R"({"type":"temporal","id":1,"frames":10001})", "whole number"},
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
