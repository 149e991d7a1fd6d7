// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Who may talk to the viewer: what is asked of a request, without a socket.
#include "view/request.h"

#include <gtest/gtest.h>

#include "support/text.h"
#include "view/attacks.h"
#include "view/secret.h"

namespace tofray::test {
namespace {

const std::string token(64, 'a');

bool is_index(std::string_view target) { return target == "/"; }

view::Verdict verdict_of(const Attack& attack, const view::Admission& admission) {
  std::vector<std::string> texts;
  for (const std::string& one : attack.headers) texts.push_back(filled(one, 7170, token, "dGhlIHNhbXBsZSBub25jZQ=="));
  std::vector<view::Header> headers;
  for (const std::string& one : texts) {
    const std::size_t colon = one.find(':'), value = one.find_first_not_of(' ', colon + 1);
    headers.push_back({std::string_view(one).substr(0, colon), value == std::string::npos ? "" : std::string_view(one).substr(value)});
  }
  const std::string target = filled(attack.target, 7170, token, "");
  return view::judged({attack.method, target, std::string_view(attack.version) == "HTTP/1.1" ? 11 : 10, headers}, admission, is_index);
}

view::Admission usual() { return {view::hosts_of(7170, {}), token, false}; }

TEST(request, is_answered_by_its_host_origin_token_and_form_alone) {
  for (const Attack& one : attacks()) {
    std::string all;
    for (const std::string& header : one.headers) all += header + " | ";
    EXPECT_EQ(verdict_of(one, usual()).status, one.status) << one.method << " " << one.target << " " << all;
  }
  EXPECT_GE(attacks().size(), 80u);
}

TEST(request, of_another_name_needs_that_it_was_allowed) {
  view::Admission admission = usual();
  admission.hosts = view::hosts_of(7170, {"Lab7", "gate:8080"});
  EXPECT_EQ(verdict_of({"/", {"Host: lab7:7170"}}, admission).status, 200);
  EXPECT_EQ(verdict_of({"/", {"Host: gate:8080"}}, admission).status, 200);
  EXPECT_EQ(verdict_of({"/", {"Host: gate:7170"}}, admission).status, 421);
  EXPECT_EQ(verdict_of({"/", {"Host: lab7"}}, admission).status, 421);
  EXPECT_EQ(verdict_of({"/", {"Host: lab7:7170", "Origin: http://lab7:7170"}}, admission).status, 200);
}

TEST(request, of_a_frame_needs_embed) {
  const Attack frame{"/", {"Host: HOST", "Sec-Fetch-Site: cross-site", "Sec-Fetch-Mode: navigate", "Sec-Fetch-Dest: iframe"}};
  view::Admission admission = usual();
  EXPECT_EQ(verdict_of(frame, admission).status, 403);
  admission.embed = true;
  EXPECT_EQ(verdict_of(frame, admission).status, 200);
  EXPECT_TRUE(has(view::content_policy(admission.hosts, false), "frame-ancestors 'none'"));
  EXPECT_FALSE(has(view::content_policy(admission.hosts, true), "frame-ancestors 'none'"));
}

TEST(content_policy, names_each_host_that_its_grammar_knows) {
  const std::string policy = view::content_policy(view::hosts_of(7170, {"lab7", "[fd00::1]:80"}), false);
  EXPECT_TRUE(has(policy, "connect-src 'self' ws://127.0.0.1:7170 ws://localhost:7170 ws://lab7:7170;")) << policy;
  EXPECT_FALSE(has(policy, "[")) << policy;  // browsers report such a source as a fault, at each load
}

TEST(request, with_too_much_of_anything_is_refused) {
  Attack many{"/", {"Host: HOST"}};
  for (int i = 0; i < 100; ++i) many.headers.push_back("X-A: b");
  EXPECT_EQ(verdict_of(many, usual()).status, 431);
  const std::string path = "/" + std::string(9000, 'a');
  EXPECT_EQ(verdict_of({path.c_str(), {"Host: HOST"}}, usual()).status, 414);
}

TEST(token, is_256_bits_and_another_one_each_time) {
  const std::string one = view::new_token(), other = view::new_token();
  EXPECT_EQ(one.size(), 64u);
  EXPECT_EQ(one.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(one, other);
}

TEST(token, is_the_same_or_it_is_not) {
  EXPECT_TRUE(view::same_secret("abc", "abc"));
  for (const char* given : {"", "a", "ab", "abd", "abcabc", "abcd", "ABC", "xbc"}) EXPECT_FALSE(view::same_secret("abc", given)) << given;
  EXPECT_FALSE(view::same_secret("", ""));
}

}  // namespace
}  // namespace tofray::test
