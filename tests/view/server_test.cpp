// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The real server, from outside: what strangers send, and what does not end it.
#include <dirent.h>

#include <numeric>

#include "view/attacks.h"
#include "view/viewer.h"

namespace tofray::test {
namespace {

std::string request_of(const Attack& attack, const Viewer& viewer) {
  std::string text =
      std::string(attack.method) + " " + filled(attack.target, viewer.port, viewer.token, a_key) + " " + attack.version + "\r\n";
  for (const std::string& one : attack.headers) text += filled(one, viewer.port, viewer.token, a_key) + "\r\n";
  return text + "\r\n";
}

/// Whether a page still gets a frame.
void expect_works(const Viewer& viewer) {
  Page page(viewer);
  ASSERT_TRUE(page.text("hello"));
  page.want("\"z_m\"");
  EXPECT_TRUE(page.frame());
}

std::size_t open_files(pid_t pid) {
  DIR* folder = ::opendir(("/proc/" + std::to_string(pid) + "/fd").c_str());
  std::size_t count = 0;
  while (folder != nullptr && ::readdir(folder) != nullptr) ++count;
  if (folder != nullptr) ::closedir(folder);
  return count;
}

pid_t pid_of(const Viewer& viewer) { return static_cast<pid_t>(number_in(files::parse_json(viewer.out(), "stdout"), "pid")); }

TEST(server, answers_each_request_by_its_host_origin_token_and_form) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  for (const Attack& one : attacks()) {
    const std::string request = request_of(one, viewer), answer = asked(viewer.port, request);
    EXPECT_EQ(status_of(answer), one.status) << request << answer;
    EXPECT_FALSE(has(answer, "Access-Control")) << answer;
    EXPECT_FALSE(has(answer, viewer.token));
    if (status_of(answer) == 101) continue;
    for (const char* header : {"Content-Security-Policy: default-src 'none'; script-src 'self'", "X-Content-Type-Options: nosniff",
                               "Referrer-Policy: no-referrer", "Cross-Origin-Opener-Policy: same-origin",
                               "Cross-Origin-Resource-Policy: same-origin", "Cache-Control: no-store"})
      EXPECT_TRUE(has(answer, header)) << request << answer;
  }
  expect_works(viewer);
}

TEST(server, refuses_what_is_no_request_and_goes_on) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  const std::string host = "Host: " + viewer.host() + "\r\n";
  const std::pair<std::string, int> cases[] = {
      {"\r\n\r\n\r\n", 400},
      {"GET\r\n\r\n", 400},
      {"GET / HTTP/1.1\n" + host + "\r\n", 400},
      {"GET / HTTP/9.9\r\n" + host + "\r\n", 400},
      {"GET  / HTTP/1.1\r\n" + host + "\r\n", 400},
      {"GET /\x01 HTTP/1.1\r\n" + host + "\r\n", 400},
      {"G\xffT / HTTP/1.1\r\n" + host + "\r\n", 400},
      {"GET / HTTP/1.1\r\nHost 127.0.0.1\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\n: x\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\n" + host + "X: a\x7f\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\n" + host + "Content-Length: 18446744073709551616\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\n" + host + "Content-Length: -1\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\n" + host + "Content-Length: 1\r\nContent-Length: 2\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\n" + host + "X: " + std::string(20'000, 'a') + "\r\n\r\n", 431},
      {"GET /" + std::string(9'000, 'a') + " HTTP/1.1\r\n" + host + "\r\n", 414},
      {std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11) + std::string(200, 'x') + "\r\n\r\n", 400},  // TLS
      {"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", 400},
  };
  for (const auto& [request, status] : cases) EXPECT_EQ(status_of(asked(viewer.port, request)), status) << request.substr(0, 100);
  expect_works(viewer);
}

TEST(server, answers_requests_one_after_the_other_on_one_connection) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  const std::string request = "GET / HTTP/1.1\r\nHost: " + viewer.host() + "\r\n\r\n",
                    nothing = "GET /x HTTP/1.1\r\nHost: " + viewer.host() + "\r\n\r\n";
  Line line(viewer.port);
  line.send(request + request + request + nothing);
  const std::string all = line.read_all();
  EXPECT_TRUE(line.ended());
  std::size_t good = 0;
  for (std::size_t at = all.find("HTTP/1.1 200"); at != std::string::npos; at = all.find("HTTP/1.1 200", at + 1)) ++good;
  EXPECT_EQ(good, 3u);
  EXPECT_TRUE(has(all, "HTTP/1.1 404"));
}

TEST(server, is_reached_at_both_addresses_of_this_machine_and_at_no_other) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Line six(viewer.port, true);
  if (six.open()) {
    six.send("GET / HTTP/1.1\r\nHost: [::1]:" + std::to_string(viewer.port) + "\r\n\r\n");
    six.read_until([](const std::string& text) { return has(text, "\r\n\r\n"); });
    EXPECT_EQ(status_of(six.read()), 200);
  }
  // Listening sockets of this port, as the kernel has them: 0100007F is 127.0.0.1.
  char port[8];
  std::snprintf(port, sizeof port, ":%04X", viewer.port);
  std::istringstream table(content("/proc/net/tcp"));
  std::string row;
  int listening = 0;
  while (std::getline(table, row)) {
    if (!has(row, std::string(port) + " 00000000:0000 0A")) continue;
    ++listening;
    EXPECT_TRUE(has(row, std::string("0100007F") + port)) << row;
  }
  EXPECT_EQ(listening, 1);
}

TEST(server, tells_the_token_once_and_shows_it_to_no_other_user) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  expect_works(viewer);
  const std::string at = "/proc/" + std::to_string(pid_of(viewer));
  EXPECT_FALSE(has(content(at + "/cmdline"), viewer.token));
  EXPECT_FALSE(has(viewer.err(), viewer.token));
  EXPECT_EQ(viewer.out().find(viewer.token), viewer.out().rfind(viewer.token));
}

TEST(server, has_the_same_number_of_files_after_a_storm) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  expect_works(viewer);
  std::this_thread::sleep_for(milliseconds(300));
  const std::size_t before = open_files(pid_of(viewer));
  for (int i = 0; i < 200; ++i) {
    Line line(viewer.port);
    if (i % 3 == 0) line.send("GET / HT");
    if (i % 3 == 1) line.send(handshake(viewer.host(), viewer.token));
    if (i % 2 == 0) line.reset();
  }
  const Clock::time_point end = Clock::now() + std::chrono::seconds(8);
  while (Clock::now() < end && open_files(pid_of(viewer)) > before) std::this_thread::sleep_for(milliseconds(50));
  EXPECT_LE(open_files(pid_of(viewer)), before);
  expect_works(viewer);
}

TEST(server, lets_64_connections_in_and_closes_those_that_say_nothing) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Page good(viewer);
  ASSERT_TRUE(good.text("hello"));
  std::vector<Line> slow;
  for (int i = 0; i < 63; ++i) {
    slow.emplace_back(viewer.port);
    slow.back().send("GET / HTTP/1.1\r\nX");
  }
  std::this_thread::sleep_for(milliseconds(300));
  EXPECT_EQ(status_of(asked(viewer.port, "GET / HTTP/1.1\r\nHost: " + viewer.host() + "\r\n\r\n")), 503);
  const Clock::time_point begin = Clock::now();
  for (Line& one : slow) one.read_all();
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  for (const Line& one : slow) EXPECT_TRUE(one.ended());
  EXPECT_LT(seconds, 8);
  EXPECT_EQ(status_of(asked(viewer.port, "GET / HTTP/1.1\r\nHost: " + viewer.host() + "\r\n\r\n")), 200);
}

TEST(server, ends_within_a_second_of_a_signal_with_0_and_says_so_to_pages) {
  NEEDS_THE_VIEWER;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Viewer viewer({"room", "--bounces", "8", "--samples", "4096"}, false);  // a frame takes minutes
    Page page(viewer);
    page.want("\"z_m\"");
    std::this_thread::sleep_for(milliseconds(500));
    const Clock::time_point begin = Clock::now();
    viewer.process().send(signal);
    EXPECT_EQ(viewer.process().finish(), 0);
    EXPECT_LT(std::chrono::duration<double>(Clock::now() - begin).count(), 1.0) << signal;
    int code = 0;
    for (WsMessage one = page.next(); one.opcode >= 0 && code == 0; one = page.next()) code = one.close_code();
    EXPECT_EQ(code, 1001);
  }
}

TEST(server, refuses_a_port_that_is_taken_and_looks_for_one_where_none_is_named) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  const Result taken = run({"view", "demo", "--test-hooks", "--port", std::to_string(viewer.port)});
  EXPECT_EQ(taken.code, 3);
  EXPECT_TRUE(has(taken.err, "cannot listen on 127.0.0.1 port " + std::to_string(viewer.port))) << taken.err;
}

TEST(server, is_not_started_for_what_cannot_be_simulated) {
  NEEDS_THE_VIEWER;
  EXPECT_EQ(run({"view", "crad", "--test-hooks"}).code, 3);
  EXPECT_EQ(run({"view", "demo", "--test-hooks", "--set", "camera.lens.fnumber=1"}).code, 2);
  EXPECT_EQ(run({"view", "demo", "--test-hooks", "--host", "nowhere.example"}).code, 2);
  EXPECT_EQ(run({"view", "demo", "--test-hooks", "--rate", "fast"}).code, 2);
  EXPECT_EQ(run({"view", "demo", "--test-hooks", "--port", "65536"}).code, 2);
}

TEST(server, of_a_profile_shows_the_demo_by_that_camera) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"pico-monstar"}, false);
  Page page(viewer);
  const auto hello = page.text("hello");
  ASSERT_TRUE(hello);
  EXPECT_EQ(*hello->find("scene")->string(), "demo");
  EXPECT_EQ(*hello->find("camera")->string(), "pico-monstar");
}

/// One text message, in frames; what it is answered with.
struct Malformed {
  std::string what, bytes;
  int code;  ///< of the close frame; 0: none, the connection just ends; 1: it goes on
};

std::vector<Malformed> malformed() {
  const std::string play = R"({"type":"pause"})";
  std::vector<Malformed> out = {{"whole", ws_frame(1, play), 1},
                                {"in two pieces", ws_frame(1, play.substr(0, 5), false) + ws_frame(0, play.substr(5)), 1},
                                {"with a ping between", ws_frame(1, "{", false) + ws_frame(9, "p") + ws_frame(0, "}"), 1},
                                {"empty", ws_frame(1, ""), 1},
                                {"a ping", ws_frame(9, "hello"), 1},
                                {"an empty ping", ws_frame(9, ""), 1},
                                {"a ping of 125 bytes", ws_frame(9, std::string(125, 'p')), 1},
                                {"a pong that nobody asked for", ws_frame(10, "x"), 1},
                                {"no JSON", ws_frame(1, "hello"), 1},
                                {"JSON of no kind", ws_frame(1, R"({"type":"x"})"), 1},
                                {"nested a thousand times", ws_frame(1, std::string(1000, '[')), 1},
                                {"a NUL", ws_frame(1, std::string("{\0}", 3)), 1},
                                {"60 kB of nothing", ws_frame(1, std::string(60'000, ' ')), 1},
                                {"65,536 bytes", ws_frame(1, std::string(65'536, ' ')), 1},
                                {"in 60 empty pieces", [&] {
                                   std::string all = ws_frame(1, "", false);
                                   for (int i = 0; i < 60; ++i) all += ws_frame(0, "", false);
                                   return all + ws_frame(0, play);
                                 }(), 1},
                                {"binary", ws_frame(2, "abc"), 1003},
                                {"65,537 bytes", ws_frame(1, std::string(65'537, ' ')), 1009},
                                {"65,537 bytes in pieces", ws_frame(1, std::string(60'000, ' '), false) + ws_frame(0, std::string(5'537, ' ')), 1009},
                                {"a head of 2^62 bytes", std::string("\x81\xff\x40\0\0\0\0\0\0\0mask", 14), 1009},
                                {"a length with the top bit", std::string("\x81\xff\x80\0\0\0\0\0\0\0mask", 14), -1},
                                {"a length that is longer than needed", std::string("\x81\xfe\0\x05mask", 8) + "abcde", 1002},
                                {"a long length that is longer than needed", std::string("\x81\xff\0\0\0\0\0\0\0\x05mask", 14) + "abcde", 1002},
                                {"a piece that begins nothing", ws_frame(0, "x"), 1002},
                                {"the last piece of nothing", ws_frame(0, "x", false), 1002},
                                {"a second beginning", ws_frame(1, "{", false) + ws_frame(1, "}"), 1002},
                                {"a binary beginning within a text", ws_frame(1, "{", false) + ws_frame(2, "}"), 1002},
                                {"a ping of 126 bytes", ws_frame(9, std::string(126, 'p')), 1002},
                                {"a pong of 126 bytes", ws_frame(10, std::string(126, 'p')), 1002},
                                {"a ping with a long length", std::string("\x89\xfe\0\x01maskx", 9), 1002},
                                {"a ping with a longer length", std::string("\x89\xff\0\0\0\0\0\0\0\x01maskx", 15), 1002},
                                {"a close with a long length", std::string("\x88\xfe\0\x02maskxx", 10), 1002},
                                {"a ping in pieces", ws_frame(9, "p", false), 1002},
                                {"a pong in pieces", ws_frame(10, "p", false), 1002},
                                {"a close in pieces", ws_frame(8, "", false), 1002},
                                {"a close of one byte", ws_frame(8, "x"), 1002},
                                {"a close of 126 bytes", ws_frame(8, std::string("\x03\xe8", 2) + std::string(124, 'x')), 1002},
                                {"a close with bad UTF-8", ws_frame(8, std::string("\x03\xe8\xff\xff", 4)), 1002},
                                {"a close", ws_frame(8, std::string("\x03\xe8", 2)), 1000},
                                {"an empty close", ws_frame(8, ""), -1},
                                {"endless empty pieces", [] {
                                   std::string all = ws_frame(1, "", false);
                                   for (int i = 0; i < 5000; ++i) all += ws_frame(0, "", false);
                                   return all;
                                 }(), 0},
                                {"endless pieces of a byte", [] {
                                   std::string all = ws_frame(1, "{", false);
                                   for (int i = 0; i < 5000; ++i) all += ws_frame(0, " ", false);
                                   return all;
                                 }(), 0},
                                {"a flood of pings", [] {
                                   std::string all;
                                   for (int i = 0; i < 50'000; ++i) all += ws_frame(9, "");
                                   return all;
                                 }(), 0},
                                {"a flood of pongs", [] {
                                   std::string all;
                                   for (int i = 0; i < 50'000; ++i) all += ws_frame(10, "");
                                   return all;
                                 }(), 0},
                                {"HTTP where frames are expected", "GET / HTTP/1.1\r\n\r\n", 1002}};
  for (int opcode = 0; opcode < 16; ++opcode)
    for (const int reserved : {1, 2, 4, 7})
      if (opcode <= 2 || (opcode >= 8 && opcode <= 10))
        out.push_back(
            {"reserved bits " + std::to_string(reserved) + " of " + std::to_string(opcode), ws_frame(opcode, "", true, reserved), 1002});
  for (const int opcode : {3, 4, 5, 6, 7, 11, 12, 13, 14, 15})
    for (const bool last : {true, false})
      out.push_back({"opcode " + std::to_string(opcode) + (last ? "" : " in pieces"), ws_frame(opcode, "x", last), 1002});
  for (const int opcode : {1, 2, 8, 9, 10})
    out.push_back({"not masked " + std::to_string(opcode), ws_frame(opcode, "", true, 0, false), 1002});
  const char* const bad[] = {"\xff",
                             "\x80",
                             "\xc0\xaf",
                             "\xe0\x80\xaf",
                             "\xed\xa0\x80",
                             "\xf0\x80\x80\xaf",
                             "\xf4\x90\x80\x80",
                             "\xf8\x88\x80\x80\x80",
                             "\xc3",
                             "\xe2\x82",
                             "a\xc3\x28",
                             "\xce\xba\xed\xa0\x80",
                             "\xf5\x80\x80\x80",
                             "\xe2\x28\xa1",
                             "\xf0\x28\x8c\xbc",
                             "\xfe"};
  for (const char* text : bad) out.push_back({"bad UTF-8", ws_frame(1, text), 1007});
  out.push_back({"bad UTF-8 over two pieces", ws_frame(1, "\xe2\x82", false) + ws_frame(0, "x"), 1007});
  for (const int code : {0, 999, 1004, 1005, 1006, 1015, 1016, 2999})
    out.push_back({"close code " + std::to_string(code), ws_frame(8, {static_cast<char>(code >> 8), static_cast<char>(code & 255)}), 1002});
  return out;
}

TEST(server, takes_100_malformed_websockets_and_goes_on) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  std::size_t cases = 0;
  for (const Malformed& one : malformed()) {
    cases += one.code == 1 ? 0 : 1;
    Page page(viewer);
    page.text("hello");
    page.line().send(one.bytes);
    if (one.code == 1) {
      page.send(R"({"type":"seek","frame":3})");
      EXPECT_TRUE(page.text("state")) << one.what;
      continue;
    }
    WsMessage last;
    constexpr milliseconds patience{30'000};  // under sanitizers, on a machine with other work, a flood takes its time
    for (WsMessage next = page.next(patience); next.opcode >= 0; next = page.next(patience)) {
      if (next.opcode == 8) page.line().send(ws_frame(8, next.payload));  // as a browser does
      last = std::move(next);
    }
    EXPECT_TRUE(page.line().ended()) << one.what;
    if (one.code > 1) {
      EXPECT_EQ(last.close_code(), one.code) << one.what;
    }
    if (one.code == 0) {
      EXPECT_NE(last.opcode, 2) << one.what;
    }
  }
  EXPECT_GE(cases, 100u);
  expect_works(viewer);
}

}  // namespace
}  // namespace tofray::test
