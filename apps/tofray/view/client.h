// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "view/hub.h"
#include "view/metered_stream.h"

namespace tofray::view {

/// A page: its WebSocket, what it wants, and how many frames it has not drawn yet.
class Client : public std::enable_shared_from_this<Client> {
 public:
  using Clock = std::chrono::steady_clock;

  Client(beast::tcp_stream&& stream, Counted counted);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void accept(http::request<http::empty_body> request);
  void greet(std::string hello);
  void tell(std::shared_ptr<const std::string> text);
  void offer(const std::shared_ptr<const Published>& frame);
  void close(websocket::close_code code);

  void want(Want want);
  void show(bool visible);
  void acknowledge(std::uint32_t sequence);

  [[nodiscard]] std::uint64_t number() const { return number_; }
  /// Whether it looks at anything.
  [[nodiscard]] bool looks() const { return greeted_ && visible_ && !arrays_.empty() && !closing_; }
  /// … and would get another frame at once.
  [[nodiscard]] bool has_room() const { return looks() && !pending_ && unacknowledged_.size() < most_unacknowledged; }
  [[nodiscard]] const std::vector<std::uint16_t>& arrays() const { return arrays_; }
  [[nodiscard]] double hz() const { return hub_.hz_of(rate_); }
  [[nodiscard]] std::uint64_t sent() const { return sent_; }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
  std::uint32_t seen_generation = 0;  ///< of the frame that it got last
  std::uint64_t seen_frame = 0;

 private:
  static constexpr std::size_t most_unacknowledged = 2, most_waiting_bytes = 1'000'000;
  void read();
  void pump();
  void write(std::shared_ptr<const std::string> bytes, bool text);

  websocket::stream<MeteredStream> socket_;
  Counted counted_;
  Hub& hub_;
  beast::flat_buffer buffer_{65536};
  net::steady_timer later_;
  std::uint64_t number_ = 0;
  std::vector<std::uint16_t> arrays_;
  Rate rate_;
  bool visible_ = true, greeted_ = false, writing_ = false, closing_ = false;
  std::deque<std::shared_ptr<const std::string>> texts_;
  std::size_t waiting_bytes_ = 0;
  std::shared_ptr<const Published> pending_;
  std::deque<std::uint32_t> unacknowledged_;
  Clock::time_point next_{};
  std::uint64_t sent_ = 0, dropped_ = 0;
};

}  // namespace tofray::view
