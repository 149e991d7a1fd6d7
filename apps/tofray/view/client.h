// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
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
  /// A text with arrays right behind it.
  void give(std::shared_ptr<const std::string> text, std::shared_ptr<const std::string> arrays, std::uint8_t kind);
  void offer(const std::shared_ptr<const Published>& frame);
  void close(websocket::close_code code);

  void want(Want want);
  void show(bool visible);
  void acknowledge(const Acknowledge& drawn);
  /// What of side B waits or was sent counts no longer.
  void forget_other();

  [[nodiscard]] std::uint64_t number() const { return number_; }
  /// Whether it looks at anything.
  [[nodiscard]] bool looks() const { return greeted_ && visible_ && !arrays_.empty() && !closing_; }
  /// Whether it looks at anything and would get another frame at once.
  [[nodiscard]] bool has_room() const { return looks() && channels_[0].has_room() && (!hub_.has_other() || channels_[1].has_room()); }
  [[nodiscard]] const std::vector<std::uint16_t>& arrays() const { return arrays_; }
  [[nodiscard]] double hz() const { return hub_.hz_of(rate_); }
  [[nodiscard]] std::uint64_t sent() const { return sent_; }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
  /// The frame that it got last.
  struct Seen {
    std::uint32_t generation = 0;
    std::uint64_t frame = 0;
  };
  [[nodiscard]] const Seen& seen(Side side) const { return channels_[static_cast<std::size_t>(side)].seen; }

 private:
  static constexpr std::size_t most_unacknowledged = 2, most_waiting_bytes = 1'000'000;
  /// The frames of a side.
  struct Channel {
    std::shared_ptr<const Published> pending;
    std::uint64_t offered = 0;  ///< when that was offered, of all that were
    std::deque<std::uint32_t> unacknowledged;
    Clock::time_point next{};
    Seen seen;
    [[nodiscard]] bool has_room() const { return !pending && unacknowledged.size() < most_unacknowledged; }
  };
  void drop_pending();
  /// @return whether it sends something
  bool pump(Channel& channel);
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
  /// What is told, in order: a text, or arrays of a kind.
  struct Told {
    std::shared_ptr<const std::string> bytes;
    std::optional<std::uint8_t> kind;  ///< none: a text
  };
  std::deque<Told> told_;
  std::size_t waiting_bytes_ = 0;
  Channel channels_[2];
  std::uint64_t offered_ = 0, sent_ = 0, dropped_ = 0;
};

}  // namespace tofray::view
