// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace tofray::base {

int threads_of(int wanted) { return wanted > 0 ? wanted : static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

void in_parallel(int count, int threads, const std::function<void(int)>& unit) {
  const int wanted = std::min(count, threads_of(threads));
  std::atomic<int> next = 0;
  std::atomic<bool> failed = false;
  std::exception_ptr fault;
  const auto work = [&] {
    try {
      for (int i = next++; i < count && !failed; i = next++) unit(i);
    } catch (...) {
      if (!failed.exchange(true)) fault = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (int i = 1; i < wanted; ++i) others.emplace_back(work);
    } catch (const std::system_error&) {
      // fewer will do
    }
    work();
  }
  if (fault) std::rethrow_exception(fault);
}

}  // namespace tofray::base
