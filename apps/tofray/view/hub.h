// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "view/beast.h"
#include "view/control.h"
#include "view/outbox.h"
#include "view/request.h"
#include "view/session.h"

namespace tofray::view {

class Client;

/// What all connections share: who is there, what they want together, and the session that computes it. Of the thread of sockets, but for
/// what Outbox has.
class Hub : public Outbox {
 public:
  Hub(net::io_context& io, Session& session, Rate rate, Admission admission);

  void publish(std::shared_ptr<const Published> frame, SessionCounts counts) override;
  void greet(std::uint64_t client, std::string hello) override;
  void tell(std::uint64_t client, std::string text) override;
  void give(std::uint64_t client, std::string text, std::string arrays, std::uint8_t kind) override;
  void tell_all(std::string text) override;
  void own_rate(double hz) override;
  void other(bool open) override;

  std::uint64_t join(Client& client);
  void leave(std::uint64_t client);
  void took(Client& client, const std::string& message);
  /// Tells the session what is wanted now. @param again  see Session::demand
  void wanted(bool again);
  [[nodiscard]] double hz_of(const Rate& rate) const;
  /// Whether there is a side B.
  [[nodiscard]] bool has_other() const { return has_other_; }
  [[nodiscard]] const Rate& usual_rate() const { return rate_; }
  [[nodiscard]] const Admission& admission() const { return admission_; }
  void close_all();

  static constexpr int most_connections = 64;
  int connections = 0;

 private:
  void tell_counts();

  net::io_context& io_;
  Session& session_;
  Rate rate_;
  Admission admission_;
  std::map<std::uint64_t, Client*> clients_;
  std::uint64_t next_ = 1;
  double own_hz_ = 0;
  bool has_other_ = false;
  SessionCounts counts_;
  std::uint64_t told_computed_ = 0;
  std::chrono::steady_clock::time_point told_at_{};
  net::steady_timer ticker_;
  bool ticking_ = false;
};

/// Counts a connection while it lives, and keeps the hub as long.
class Counted {
 public:
  explicit Counted(std::shared_ptr<Hub> hub) : hub_(std::move(hub)) { ++hub_->connections; }
  Counted(Counted&&) noexcept = default;
  Counted& operator=(Counted&&) = delete;
  ~Counted() {
    if (hub_ != nullptr) --hub_->connections;
  }
  [[nodiscard]] Hub& hub() const { return *hub_; }

 private:
  std::shared_ptr<Hub> hub_;
};

}  // namespace tofray::view
