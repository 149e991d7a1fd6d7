// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "foxglove/protocol.h"

namespace tofray::foxglove {

class Reader;

/// A message that is kept for who comes later.
struct Kept {
  std::shared_ptr<const std::string> cdr;
  std::int64_t time_ns = 0;
};

/// What the thread of the stream and that of the sockets share. All of it, and all that Reader says so of, under `mutex`.
struct Board {
  std::mutex mutex;
  std::condition_variable changed;  ///< a reader has all that was sent to it, or is gone
  std::vector<Channel> channels;
  std::vector<std::deque<Kept>> kept;  ///< by channel, the oldest one first
  std::set<std::shared_ptr<Reader>> readers;
  std::string session;
  std::int64_t time_ns = -1;  ///< of the latest message; −1: none was sent
};

}  // namespace tofray::foxglove
