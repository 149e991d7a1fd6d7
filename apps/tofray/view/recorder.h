// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "view/outbox.h"
#include "view/state.h"

namespace tofray::view {

/// Writes files that pages order into the folder of -o, one order at a time, on a thread of its own, while the view goes on. Their names are
/// chosen here and are new; until all is written they end in .part, and what is given up goes.
class Recorder {
 public:
  /// @param folder  made when it is needed
  explicit Recorder(std::filesystem::path folder);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// A page's own order that is under way is given up.
  /// @throws Error where another page's is under way
  void take(std::uint64_t client, const Order& order, const State& state, Outbox& outbox);
  /// Gives up what the page ordered.
  void stop(std::uint64_t client);
  /// Gives up what is under way, and removes what there is of it without waiting for its end. From any thread.
  void abandon();

 private:
  struct Job;
  static void run(Job& job);
  static void record(Job& job);
  static void write_page(Job& job);
  [[nodiscard]] std::shared_ptr<Job> job();
  std::filesystem::path folder_;
  std::mutex mutex_;
  std::shared_ptr<Job> job_;  ///< guarded by it
  std::thread thread_;
};

}  // namespace tofray::view
