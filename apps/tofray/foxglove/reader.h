// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <atomic>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "foxglove/board.h"
#include "view/beast.h"
#include "view/metered_stream.h"
#include "view/request.h"

namespace tofray::foxglove {

/// What readers of a server share, of the thread of sockets but for the board.
struct Reception {
  Board board;
  view::ReaderAdmission admission;
  std::set<std::string> refused_origins;  ///< of which was told
  std::atomic<int> connections = 0;
};

/// A reader of the stream: a connection that speaks HTTP once, then its WebSocket.
class Reader : public std::enable_shared_from_this<Reader> {
 public:
  Reader(view::tcp::socket&& socket, std::shared_ptr<Reception> reception);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  void greet();
  void close();

  // Of any thread, under the board's mutex:
  void tell(std::string text);
  void tell_time(std::int64_t time_ns);
  /// @return false where it subscribed to this and is too far behind
  bool give(std::uint32_t channel, const Kept& message);
  [[nodiscard]] int subscriptions() const { return static_cast<int>(subscribed_.size()); }
  [[nodiscard]] bool has_all() const { return waiting_.empty() && !writing_; }

 private:
  using error_code = view::error_code;
  /// A text, or bytes: a head and what stands behind it.
  struct Item {
    bool text = false;
    std::string head;
    std::shared_ptr<const std::string> body;
    [[nodiscard]] std::size_t size() const { return sizeof(Item) + head.size() + (body ? body->size() : 0); }
  };
  void judge(error_code error);
  void refuse(const view::Verdict& verdict);
  void accept();
  void join();
  void leave();
  void read();
  void took(const std::string& text);
  void subscribe(const std::vector<Subscription>& wanted);
  void add(const Subscription& wanted);
  void unsubscribe(const std::vector<std::uint32_t>& ended);
  bool put(Item item);
  void pump();

  view::websocket::stream<view::MeteredStream> socket_;
  std::shared_ptr<Reception> reception_;
  Board& board_;
  view::beast::flat_buffer buffer_{65536};
  std::optional<view::http::request_parser<view::http::empty_body>> parser_;
  std::string protocol_;
  bool closing_ = false;
  // under the board's mutex:
  std::map<std::uint32_t, std::uint32_t> subscribed_;  ///< its own numbers by channel
  std::deque<Item> waiting_;
  std::size_t waiting_bytes_ = 0;
  bool writing_ = false;
  // what is being written:
  Item item_;
};

}  // namespace tofray::foxglove
