// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "support/samples.h"

using namespace tofray;
using namespace tofray::files;
using out_test::error_of;

TEST(json, numbers_come_back_bit_by_bit) {
  std::vector<double> values = {0.1, 1e30, 5e-324, 1.7976931348623157e308, -0.0, 80.32e6, 1.0 / 3};
  out_test::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const std::uint64_t bits = random.next();
    double value = 0;
    std::memcpy(&value, &bits, 8);
    if (std::isfinite(value)) values.push_back(value);
  }
  const Json back = parse_json(json_text(Json::list(values)), "memory");
  ASSERT_EQ(back.items()->size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    double value = 0;
    ASSERT_TRUE((*back.items())[i].number(value));
    EXPECT_EQ(std::memcmp(&value, &values[i], 8), 0) << values[i];
  }
  EXPECT_EQ(json_text(Json::list(std::vector<double>{NAN, INFINITY})), "[null,null]");
}

TEST(json, keeps_the_order_of_keys_and_mends_bytes_that_are_no_text) {
  EXPECT_EQ(json_text(Json::object().set("z", 1).set("a", true).set("s", "\xFF\n")), "{\"z\":1,\"a\":true,\"s\":\"\xEF\xBF\xBD\\n\"}");
}

TEST(json, faults_have_a_place) {
  const auto message = [](const std::string& text) { return std::string(error_of([&] { (void)parse_json(text, "m.json"); }).what()); };
  EXPECT_EQ(message("{\"a\": 1,\n  \"b\": tru }").rfind("m.json:2:", 0), 0U) << message("{\"a\": 1,\n  \"b\": tru }");
  EXPECT_NE(message("").find("not JSON"), std::string::npos);
  EXPECT_NE(message("[1] 2").find("not JSON"), std::string::npos);
  EXPECT_NE(message("{\"a\": 1, \"a\": 2}").find("key \"a\" comes twice"), std::string::npos);
  EXPECT_NE(message("\"\xFF\"").find("not JSON"), std::string::npos);
  EXPECT_NE(message("[1e400]").find("m.json:1:6: error: a number is beyond the range of double"), std::string::npos) << message("[1e400]");
  EXPECT_EQ(error_of([] { (void)parse_json(std::string(100000, '['), "m.json"); }).kind(), ErrorKind::limit);
}

TEST(json, has_as_many_values_as_it_may_and_no_more) {
  EXPECT_EQ(parse_json("[1, {\"a\": []}]", "m.json", 4).items()->size(), 2U);
  const auto error = error_of([] { (void)parse_json("[1, {\"a\": []}]", "m.json", 3); });
  EXPECT_EQ(error.kind(), ErrorKind::limit);
  EXPECT_EQ(std::string(error.what()), "m.json: error: more than 3 values");
}
