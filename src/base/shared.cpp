// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/shared.h"

#include <algorithm>
#include <list>

namespace tofray::base {

namespace {

struct Kept {
  std::shared_ptr<const void> result;
  std::size_t bytes;
};

struct Keeper {
  std::mutex mutex;
  std::list<Kept> results;  ///< the one used last in front
  std::size_t bytes = 0;    ///< of all of them
};

Keeper& keeper() {
  static auto* const the_one = new Keeper;
  return *the_one;
}

}  // namespace

void keep(const std::shared_ptr<const void>& result, std::size_t bytes) {
  std::list<Kept> gone;  // destroyed once the lock is
  Keeper& all = keeper();
  const std::lock_guard lock(all.mutex);
  const auto known = std::find_if(all.results.begin(), all.results.end(), [&](const Kept& one) { return one.result == result; });
  if (known != all.results.end()) {
    all.results.splice(all.results.begin(), all.results, known);
    return;
  }
  if (bytes > kept_bytes) return;
  all.results.push_front({result, bytes});
  all.bytes += bytes;
  while (all.bytes > kept_bytes) {
    all.bytes -= all.results.back().bytes;
    gone.splice(gone.begin(), all.results, std::prev(all.results.end()));
  }
}

void forget_kept() {
  std::list<Kept> gone;
  Keeper& all = keeper();
  const std::lock_guard lock(all.mutex);
  gone.swap(all.results);
  all.bytes = 0;
}

}  // namespace tofray::base
