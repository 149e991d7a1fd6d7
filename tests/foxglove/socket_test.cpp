// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Readers that come, read and go while a stream runs, each in a thread: what the two threads of the stream share is what ThreadSanitizer looks at.
#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "support/text.h"
#include "view/viewer.h"

namespace tofray::test {
namespace {

/// `tofray stream --to foxglove`, ended with the test.
class Stream {
 public:
  explicit Stream(Arguments more) {
    Arguments all = {"stream", "flying-ball", "--to", "foxglove", "--port", "0"};
    all.insert(all.end(), more.begin(), more.end());
    child_.emplace(start(with_small_sensor(all), folder_ / "out", folder_ / "err", in_folder(folder_.path())));
    const Clock::time_point end = Clock::now() + std::chrono::seconds(60);
    while (Clock::now() < end && !has(err(), "ws://localhost:")) std::this_thread::sleep_for(milliseconds(5));
    const std::string said = err();
    const std::size_t at = said.find("ws://localhost:");
    EXPECT_NE(at, std::string::npos) << said;
    if (at != std::string::npos) port = std::atoi(said.c_str() + at + 15);
  }
  [[nodiscard]] std::string err() const { return content(folder_ / "err"); }
  int interrupt() {
    child_->send(SIGINT);
    return child_->finish();
  }
  int port = 0;

 private:
  Folder folder_;
  std::optional<Running> child_;
};

std::string hello_to(int port) {
  return "GET / HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: " + a_key +
         "\r\nSec-WebSocket-Protocol: foxglove.websocket.v1\r\n\r\n";
}

bool has_an_end(const std::string& text) { return text.find("\r\n\r\n") != std::string::npos; }

/// Comes, subscribes to channel 1 and reads so many bytes, then goes by one way or another. @return whether it got them
bool read_some(int port, std::size_t bytes, int way) {
  Line line(port);
  line.send(hello_to(port));
  if (!line.read_until(has_an_end) || status_of(line.read()) != 101) return false;
  line.send(ws_frame(1, R"({"op":"subscribe","subscriptions":[{"id":5,"channelId":1}]})"));
  const bool got = line.read_until([bytes](const std::string& text) { return text.size() > bytes; }, milliseconds(60'000));
  if (way == 0) line.send(ws_frame(1, R"({"op":"unsubscribe","subscriptionIds":[5]})") + ws_frame(8, "\x03\xE8"));
  if (way == 1) line.reset();
  return got;
}

TEST(socket, readers_come_and_go_while_a_stream_runs) {
  NEEDS_THE_VIEWER;
  Stream stream({"--rate", "20", "--topics", "depth,points"});
  std::atomic<int> good = 0;
  std::vector<std::jthread> readers;
  constexpr int threads = 4, each = 6;
  for (int i = 0; i < threads; ++i)
    readers.emplace_back([&, i] {
      for (int k = 0; k < each; ++k) good += read_some(stream.port, 20'000, (i + k) % 3) ? 1 : 0;
    });
  readers.clear();
  EXPECT_EQ(good, threads * each);
  EXPECT_EQ(stream.interrupt(), 0) << stream.err();
}

TEST(socket, the_end_of_a_stream_is_told_to_who_reads_and_who_does_not) {
  NEEDS_THE_VIEWER;
  Stream stream({"--rate", "20"});
  Line reads(stream.port), silent(stream.port);
  for (Line* one : {&reads, &silent}) one->send(hello_to(stream.port));
  EXPECT_TRUE(reads.read_until(has_an_end));
  reads.send(ws_frame(1, R"({"op":"subscribe","subscriptions":[{"id":5,"channelId":1}]})"));
  EXPECT_TRUE(reads.read_until([](const std::string& text) { return text.size() > 20'000; }, milliseconds(60'000)));
  EXPECT_EQ(stream.interrupt(), 0) << stream.err();
  EXPECT_TRUE(has(reads.read_all(), "the stream has ended"));
  silent.read_all();
  EXPECT_TRUE(reads.ended() && silent.ended());
}

}  // namespace
}  // namespace tofray::test
