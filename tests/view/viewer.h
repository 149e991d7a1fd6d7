// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/json.h"
#include "support/tool.h"

/// A viewer that runs, and raw sockets that talk to it: nothing here is of the server's own code.
namespace tofray::test {

#if defined(TOFRAY_HAS_VIEW)
#define NEEDS_THE_VIEWER
#else
#define NEEDS_THE_VIEWER GTEST_SKIP() << "built without Boost"
#endif

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// `tofray view`, ended with the test.
class Viewer {
 public:
  explicit Viewer(Arguments more = {"demo"}, bool small = true, const Prepare& prepare = {}) {
    Arguments all = {"view", "--port", "0", "--json", "--test-hooks"};
    all.insert(all.end(), more.begin(), more.end());
    if (small) all = with_small_sensor(all);
    child_.emplace(start(all, folder_ / "out", folder_ / "err", [&] {
      in_folder(folder_.path())();
      if (prepare) prepare();
    }));
    const Clock::time_point end = Clock::now() + std::chrono::seconds(60);
    while (Clock::now() < end && content(folder_ / "out").find('\n') == std::string::npos) std::this_thread::sleep_for(milliseconds(5));
    const files::Json said = files::parse_json(
        content(folder_ / "out") + (content(folder_ / "out").empty() ? "{\"port\":0,\"url\":\"\"}" : ""), "stdout of the viewer");
    EXPECT_FALSE(content(folder_ / "out").empty()) << err();
    double number = 0;
    said.find("port")->number(number);
    port = static_cast<int>(number);
    url = *said.find("url")->string();
    token = url.substr(std::min(url.size(), url.find("#t=") + 3));
  }

  [[nodiscard]] std::string host() const { return "127.0.0.1:" + std::to_string(port); }
  [[nodiscard]] std::string err() const { return content(folder_ / "err"); }
  [[nodiscard]] std::string out() const { return content(folder_ / "out"); }
  [[nodiscard]] const Folder& folder() const { return folder_; }
  Running& process() { return *child_; }

  int port = 0;
  std::string url, token;

 private:
  Folder folder_;
  std::optional<Running> child_;
};

/// A TCP connection to this machine.
class Line {
 public:
  explicit Line(int port, bool v6 = false) {
    file_ = ::socket(v6 ? AF_INET6 : AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET, to.sin_port = htons(static_cast<std::uint16_t>(port)), to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    sockaddr_in6 to6{};
    to6.sin6_family = AF_INET6, to6.sin6_port = to.sin_port, to6.sin6_addr = in6addr_loopback;
    open_ = (v6 ? ::connect(file_, reinterpret_cast<sockaddr*>(&to6), sizeof to6)
                : ::connect(file_, reinterpret_cast<sockaddr*>(&to), sizeof to)) == 0;
  }
  ~Line() { close(); }
  Line(Line&& other) noexcept : file_(std::exchange(other.file_, -1)), open_(other.open_), read_(std::move(other.read_)) {}
  Line& operator=(Line&&) = delete;

  [[nodiscard]] bool open() const { return open_; }
  [[nodiscard]] int file() const { return file_; }
  /// @return whether all could be sent
  bool send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(file_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }
  /// What comes, up to where `enough` says so. @return false at the end of the connection and where it takes too long
  bool read_until(const std::function<bool(const std::string&)>& enough, milliseconds within = milliseconds(10'000)) {
    const Clock::time_point end = Clock::now() + within;
    while (!enough(read_)) {
      const auto left = std::chrono::duration_cast<milliseconds>(end - Clock::now()).count();
      pollfd wait{file_, POLLIN, 0};
      if (left < 0 || ::poll(&wait, 1, static_cast<int>(left)) <= 0) return false;
      char bytes[65536];
      const ssize_t got = ::recv(file_, bytes, sizeof bytes, 0);
      if (got <= 0) return ended_ = true, false;
      read_.append(bytes, static_cast<std::size_t>(got));
    }
    return true;
  }
  /// All until the other side ends it.
  const std::string& read_all(milliseconds within = milliseconds(10'000)) {
    read_until([](const std::string&) { return false; }, within);
    return read_;
  }
  /// Whether the other side has ended it.
  [[nodiscard]] bool ended() const { return ended_; }
  std::string& read() { return read_; }
  void close() {
    if (file_ >= 0) ::close(file_);
    file_ = -1;
  }
  /// Ends it by a reset.
  void reset() {
    const linger now{1, 0};
    ::setsockopt(file_, SOL_SOCKET, SO_LINGER, &now, sizeof now);
    close();
  }

 private:
  int file_ = -1;
  bool open_ = false, ended_ = false;
  std::string read_;
};

/// The status of an answer; 0 where none came.
inline int status_of(const std::string& answer) {
  return answer.starts_with("HTTP/1.1 ") && answer.size() > 12 ? std::atoi(answer.c_str() + 9) : 0;
}

/// Sends a request on a connection of its own and takes the head of the answer.
inline std::string asked(int port, const std::string& request) {
  Line line(port);
  line.send(request);
  line.read_until([](const std::string& text) { return text.find("\r\n\r\n") != std::string::npos; });
  return line.read();
}

constexpr const char* a_key = "dGhlIHNhbXBsZSBub25jZQ==";

inline std::string handshake(const std::string& host, const std::string& token, const std::string& more = {}) {
  return "GET /ws HTTP/1.1\r\nHost: " + host +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: " + a_key +
         "\r\nSec-WebSocket-Protocol: tofray.v1, t." + token + "\r\n" + more + "\r\n";
}

/// A frame of a WebSocket as a browser sends it.
inline std::string ws_frame(int opcode, const std::string& payload, bool last = true, int reserved = 0, bool masked = true) {
  std::string out(1, static_cast<char>((last ? 128 : 0) | reserved << 4 | opcode));
  const int mask_bit = masked ? 128 : 0;
  if (payload.size() < 126) {
    out += static_cast<char>(mask_bit | static_cast<int>(payload.size()));
  } else if (payload.size() < 65536) {
    out += static_cast<char>(mask_bit | 126);
    for (const int shift : {8, 0}) out += static_cast<char>(payload.size() >> shift & 255);
  } else {
    out += static_cast<char>(mask_bit | 127);
    for (int shift = 56; shift >= 0; shift -= 8) out += static_cast<char>(payload.size() >> shift & 255);
  }
  if (!masked) return out + payload;
  const char mask[4] = {0x12, 0x55, 0x7f, 0x03};
  out.append(mask, 4);
  for (std::size_t i = 0; i < payload.size(); ++i) out += static_cast<char>(payload[i] ^ mask[i % 4]);
  return out;
}

struct WsMessage {
  int opcode = -1;  ///< 1 text, 2 binary, 8 close; −1: the connection ended or nothing came
  std::string payload;
  [[nodiscard]] files::Json json() const { return files::parse_json(payload, "message"); }
  [[nodiscard]] int close_code() const {
    return opcode == 8 && payload.size() >= 2 ? static_cast<unsigned char>(payload[0]) << 8 | static_cast<unsigned char>(payload[1]) : 0;
  }
};

/// The head of a frame's message and its arrays.
struct WireFrame {
  std::uint32_t generation = 0, sequence = 0, width = 0, height = 0;
  std::uint64_t frame = 0;
  int channel = 0;  ///< 0: side A
  bool draft = false;
  std::map<int, std::string> arrays;  ///< bytes, by number
};

template <class T>
T little(const std::string& bytes, std::size_t at) {
  T out{};
  std::memcpy(&out, bytes.data() + at, sizeof(T));
  return out;
}

inline WireFrame wire_frame(const std::string& bytes) {
  WireFrame out;
  EXPECT_EQ(bytes.substr(0, 4), "TFV1");
  out.channel = static_cast<unsigned char>(bytes[6]), out.draft = (bytes[7] & 1) != 0;
  out.generation = little<std::uint32_t>(bytes, 8), out.sequence = little<std::uint32_t>(bytes, 12);
  out.frame = little<std::uint64_t>(bytes, 16), out.width = little<std::uint32_t>(bytes, 32), out.height = little<std::uint32_t>(bytes, 36);
  for (int i = 0; i < little<std::uint16_t>(bytes, 44); ++i) {
    const std::size_t row = 64 + 32 * static_cast<std::size_t>(i), place = little<std::uint32_t>(bytes, row + 4);
    EXPECT_EQ(place % 8, 0u);
    out.arrays[little<std::uint16_t>(bytes, row)] = bytes.substr(place, little<std::uint32_t>(bytes, row + 8));
  }
  return out;
}

/// A page: a WebSocket that has its hello.
class Page {
 public:
  explicit Page(const Viewer& viewer) : line_(viewer.port) {
    line_.send(handshake(viewer.host(), viewer.token));
    line_.read_until([](const std::string& text) { return text.find("\r\n\r\n") != std::string::npos; });
    EXPECT_EQ(status_of(line_.read()), 101) << line_.read();
    line_.read().erase(0, std::min(line_.read().find("\r\n\r\n"), line_.read().size()) + 4);
  }

  void send(const std::string& json) { line_.send(ws_frame(1, json)); }
  void want(const std::string& arrays, const std::string& rate = "\"max\"") {
    send(R"({"type":"want","arrays":[)" + arrays + R"(],"rate":)" + rate + "}");
  }
  void acknowledge(std::uint32_t sequence, int channel = 0) {
    send(R"({"type":"ack","sequence":)" + std::to_string(sequence) + R"(,"channel":)" + std::to_string(channel) + "}");
  }
  /// Arrays of an answer (channels 2 and 3) are not acknowledged.
  void acknowledge(const WireFrame& frame) {
    if (frame.channel < 2) acknowledge(frame.sequence, frame.channel);
  }

  WsMessage next(milliseconds within = milliseconds(10'000)) {
    WsMessage out;
    std::string& read = line_.read();
    std::size_t head = 2, size = 0;
    const auto whole = [&](const std::string& text) {
      if (text.size() < 2) return false;
      const unsigned length = static_cast<unsigned char>(text[1]) & 127u;
      head = 2u + (length == 126 ? 2u : length == 127 ? 8u : 0u), size = length;
      if (text.size() < head) return false;
      if (length >= 126) size = 0;
      for (std::size_t i = 2; i < head; ++i) size = size << 8 | static_cast<unsigned char>(text[i]);
      return text.size() >= head + size;
    };
    if (!line_.read_until(whole, within)) return out;
    out.opcode = read[0] & 15, out.payload = read.substr(head, size);
    read.erase(0, head + size);
    return out;
  }
  /// The next message of a type, past others; frames on the way are acknowledged.
  std::optional<files::Json> text(const std::string& type, milliseconds within = milliseconds(10'000)) {
    const Clock::time_point end = Clock::now() + within;
    while (Clock::now() < end) {
      const WsMessage one = next(std::chrono::duration_cast<milliseconds>(end - Clock::now()));
      if (one.opcode == 2) acknowledge(wire_frame(one.payload));
      if (one.opcode == 1 && *one.json().find("type")->string() == type) return one.json();
      if (one.opcode < 0) return {};
    }
    return {};
  }
  /// The next frame, past texts. It is not acknowledged.
  std::optional<WireFrame> frame(milliseconds within = milliseconds(10'000)) {
    const Clock::time_point end = Clock::now() + within;
    while (Clock::now() < end) {
      const WsMessage one = next(std::chrono::duration_cast<milliseconds>(end - Clock::now()));
      if (one.opcode == 2 && static_cast<unsigned char>(one.payload[6]) < 2) return wire_frame(one.payload);
      if (one.opcode < 0) return {};
    }
    return {};
  }
  /// The next frame for which this holds; others on the way are acknowledged, and it, too.
  std::optional<WireFrame> frame_with(const std::function<bool(const WireFrame&)>& holds) {
    const Clock::time_point end = Clock::now() + milliseconds(20'000);
    while (Clock::now() < end) {
      const auto one = frame();
      if (!one) return {};
      acknowledge(*one);
      if (holds(*one)) return one;
    }
    return {};
  }
  /// Sends a message and takes what answers it: `done`, `fault` or of that type.
  files::Json answer(const std::string& json, const std::string& type = "done") {
    send(json);
    const Clock::time_point end = Clock::now() + milliseconds(20'000);
    while (Clock::now() < end) {
      const WsMessage one = next();
      if (one.opcode < 0) break;
      if (one.opcode == 2) acknowledge(wire_frame(one.payload));
      if (one.opcode != 1) continue;
      const files::Json read = one.json();
      const std::string& is = *read.find("type")->string();
      if (is == type || is == "fault") return read;
    }
    ADD_FAILURE() << "no answer to " << json;
    return files::Json::object().set("type", "none");
  }
  Line& line() { return line_; }

 private:
  Line line_;
};

inline double number_in(const files::Json& json, const char* name) {
  double out = -1;
  const files::Json* found = json.find(name);
  EXPECT_TRUE(found != nullptr && found->number(out)) << name;
  return out;
}

/// The numbers of an array in a message.
template <class T>
std::vector<T> numbers_of(const std::string& bytes) {
  std::vector<T> out(bytes.size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
  return out;
}

/// Three numbers of a list.
inline std::array<double, 3> three(const files::Json& list) {
  std::array<double, 3> out{NAN, NAN, NAN};
  const auto* items = list.items();
  EXPECT_TRUE(items != nullptr && items->size() == 3);
  for (std::size_t i = 0; items != nullptr && i < 3 && i < items->size(); ++i) (*items)[i].number(out[i]);
  return out;
}
/// Three rows of three.
inline std::array<std::array<double, 3>, 3> rows_of(const files::Json& list) {
  std::array<std::array<double, 3>, 3> out{};
  const auto* items = list.items();
  EXPECT_TRUE(items != nullptr && items->size() == 3);
  for (std::size_t i = 0; items != nullptr && i < 3 && i < items->size(); ++i) out[i] = three((*items)[i]);
  return out;
}

/// The number of an array in messages.
inline int number_of(const files::Json& hello, const std::string& array) {
  const auto& all = *hello.find("arrays")->items();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (*all[i].find("name")->string() == array) return static_cast<int>(i);
  return -1;
}

/// A page and what it was greeted with.
struct Greeted {
  explicit Greeted(const Viewer& viewer) : page(viewer), hello(page.text("hello").value_or(files::Json())) {}
  Page page;
  files::Json hello;
};

}  // namespace tofray::test
