// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/options.h"
#include "tofray/simulator.h"
#include "view/control.h"
#include "view/outbox.h"

namespace tofray::view {

/// What pages want of a session, all of them together.
struct Demand {
  bool ready = false;                             ///< someone looks and has room for a frame
  double rate_hz = 0;                             ///< the fastest that is wanted; infinity: as fast as they draw
  std::vector<std::vector<std::uint16_t>> wants;  ///< each set of arrays once
};

struct Question {
  std::uint64_t client = 0;
  PixelQuestion pixel;
  std::uint32_t generation = 0;
  std::uint64_t frame = 0;  ///< of the frame that the page got last
};

struct Why {
  std::uint64_t client = 0;
  WhyQuestion asked;
  std::uint32_t generation = 0;
  std::uint64_t frame = 0;  ///< of the frame that the page got last
};

struct Inquired {
  std::uint64_t client = 0;
  Inquiry what;
  Side side = Side::a;
  std::uint32_t generation = 0;
  std::uint64_t frame = 0;  ///< of the frame that the page got last
};

/// What all pages look at, one state or two beside each other, each a scene + list of --set + seed, at one frame, and the thread that
/// computes them. What it is told waits in a mailbox
/// where the newest wins: of several changes of a key by one page, several questions of it, several places in time, the last one counts.
class Session {
 public:
  /// @throws Error where the scene cannot be simulated
  Session(app::Options options, bool test_hooks, std::string build);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void start(Outbox& outbox);
  /// Asks the thread to end, and gives up what it computes.
  void stop();
  /// Waits for the end of the thread. @return whether it came in time
  bool ended(std::chrono::milliseconds within);

  // From the thread of the sockets:
  /// @param again  the frame shown is wanted once more, by who has not got it yet
  void demand(Demand demand, bool again);
  void join(std::uint64_t client);
  void leave(std::uint64_t client);
  void edit(std::uint64_t client, Edit edit);
  void play(bool playing);
  void seek(std::uint64_t frame);
  void ask(const Question& question);
  void why(const Why& question);
  void inquire(Inquired inquired);
  void fit(std::uint64_t client, std::string array);
  void query(std::uint64_t client, const Query& query);
  void order(std::uint64_t client, const Order& order);

  /// What the command says of scene and camera that is odd, for stderr.
  [[nodiscard]] std::string warnings() const;

 private:
  struct Mail;
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tofray::view
