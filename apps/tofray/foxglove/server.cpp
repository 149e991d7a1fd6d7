// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "foxglove/server.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "foxglove/reader.h"
#include "view/listener.h"

namespace tofray::foxglove {

namespace {

namespace net = view::net;

constexpr view::Ports usual_ports{8765, 20};  // where Foxglove and Lichtblick look first

std::string session_now() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(since).count());
}

class SocketPublisher : public stream::Publisher {
 public:
  explicit SocketPublisher(const Settings& settings)
      : io_(1), listeners_(view::listening(io_, {"the stream", settings.host, settings.port, usual_ports})), history_(settings.history) {
    reception_->board.session = session_now();
    reception_->admission = {view::hosts_of(port(), settings.allowed_hosts), settings.allowed_origins, protocols};
    for (const auto& one : listeners_)
      one->accept([this](view::tcp::socket&& socket) { std::make_shared<Reader>(std::move(socket), reception_)->greet(); });
    thread_ = std::jthread([this] { view::run_sockets(io_); });
  }

  /// Readers have a moment to take their leave.
  ~SocketPublisher() override {
    net::post(io_, [this] { end(); });
    {
      std::unique_lock lock(board().mutex);
      board().changed.wait_for(lock, std::chrono::milliseconds(300), [this] { return board().readers.empty(); });
    }
    io_.stop();
    thread_.join();
    board().readers.clear();
  }
  SocketPublisher(const SocketPublisher&) = delete;
  SocketPublisher& operator=(const SocketPublisher&) = delete;

  [[nodiscard]] int port() const { return listeners_.front()->port(); }

  int offer(const stream::TopicForm& topic) override {
    const std::scoped_lock lock(board().mutex);
    const Channel fresh{static_cast<std::uint32_t>(board().channels.size() + 1), topic};
    board().channels.push_back(fresh);
    board().kept.emplace_back();
    for (const auto& reader : board().readers) reader->tell(advertisement({fresh}));
    return static_cast<int>(fresh.id - 1);
  }

  bool send(int topic, std::string_view cdr, std::int64_t time_ns) override {
    const Kept message{std::make_shared<const std::string>(cdr), time_ns};
    const std::scoped_lock lock(board().mutex);
    keep(static_cast<std::size_t>(topic), message);
    bool all = true;
    for (const auto& reader : board().readers) {
      if (time_ns > board().time_ns) reader->tell_time(time_ns);
      all = reader->give(static_cast<std::uint32_t>(topic + 1), message) && all;
    }
    board().time_ns = std::max(board().time_ns, time_ns);
    return all;
  }

  int readers() override {
    const std::scoped_lock lock(board().mutex);
    int all = 0;
    for (const auto& reader : board().readers) all += reader->subscriptions();
    return all;
  }

  bool delivered(double at_most_s) override {
    std::unique_lock lock(board().mutex);
    return board().changed.wait_for(lock, std::chrono::duration<double>(at_most_s), [this] {
      return std::all_of(board().readers.begin(), board().readers.end(), [](const auto& reader) { return reader->has_all(); });
    });
  }

 private:
  Board& board() { return reception_->board; }

  void keep(std::size_t topic, const Kept& message) {
    if (!board().channels.at(topic).topic.lasting) return;
    auto& kept = board().kept.at(topic);
    kept.push_back(message);
    if (kept.size() > static_cast<std::size_t>(history_)) kept.pop_front();
  }

  void end() {
    for (const auto& one : listeners_) one->close();
    std::set<std::shared_ptr<Reader>> readers;
    {
      const std::scoped_lock lock(board().mutex);
      readers = board().readers;
    }
    for (const auto& one : readers) one->close();
  }

  net::io_context io_;
  view::Listeners listeners_;
  std::shared_ptr<Reception> reception_ = std::make_shared<Reception>();
  int history_;
  std::jthread thread_;
};

}  // namespace

Server open_server(const Settings& settings) {
  auto publisher = std::make_unique<SocketPublisher>(settings);
  const std::string url = fmt::format("ws://localhost:{}", publisher->port());
  return {std::move(publisher), url, !view::is_loopback(settings.host)};
}

}  // namespace tofray::foxglove
