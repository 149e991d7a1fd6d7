// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "base/parallel.h"

namespace tofray::base {

/// make(0) … make(count − 1) on several threads, and take(i, what was made) in order on the calling one. What is made and not yet taken is at most twice as many as
/// there are threads. The first error, by number, ends all of it and is thrown.
/// @param threads  0: one per core
template <class T>
void in_order(std::uint64_t count, int threads, const std::function<T(std::uint64_t)>& make,
              const std::function<void(std::uint64_t, T)>& take) {
  const auto wanted = static_cast<std::uint64_t>(threads_of(threads));
  if (wanted == 1 || count < 2) {
    for (std::uint64_t i = 0; i < count; ++i) take(i, make(i));
    return;
  }
  std::mutex mutex;
  std::condition_variable changed;
  std::uint64_t next = 0, taken = 0;
  bool ended = false;
  std::map<std::uint64_t, T> made;
  std::map<std::uint64_t, std::exception_ptr> failed;
  const auto work = [&] {
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [&] { return ended || next == count || next < taken + 2 * wanted; });
      if (ended || next == count) return;
      const std::uint64_t i = next++;
      lock.unlock();
      std::exception_ptr fault;
      std::optional<T> one;
      try {
        one.emplace(make(i));
      } catch (...) {
        fault = std::current_exception();
      }
      lock.lock();
      if (one)
        made.emplace(i, std::move(*one));
      else
        failed.emplace(i, fault);
      changed.notify_all();
    }
  };
  std::vector<std::jthread> workers;
  for (std::uint64_t i = 0; i < std::min(wanted, count); ++i) workers.emplace_back(work);
  const auto end = [&] {
    const std::lock_guard lock(mutex);
    ended = true;
    changed.notify_all();
  };
  try {
    for (std::uint64_t i = 0; i < count; ++i) {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return made.contains(i) || failed.contains(i); });
      if (failed.contains(i)) std::rethrow_exception(failed[i]);
      T one = std::move(made.extract(i).mapped());
      taken = i + 1;
      changed.notify_all();
      lock.unlock();
      take(i, std::move(one));
    }
  } catch (...) {
    end();
    throw;
  }
}

}  // namespace tofray::base
