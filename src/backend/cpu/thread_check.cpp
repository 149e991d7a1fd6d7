// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cpu/thread_check.h"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <string>
#include <system_error>
#include <vector>

#include "tofray/error.h"

namespace tofray::backend {

void refuse_threads(int threads, int code) {
  throw Error(ErrorKind::limit, "error: the system refuses " + std::to_string(threads) +
                                    " threads: " + std::generic_category().message(code) +
                                    "\n  fewer need less: --threads 1 needs none beside the one that is there");
}

void require_threads(int threads, std::size_t stack_bytes) {
  static std::atomic<int> granted{1};
  if (threads <= granted) return;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, stack_bytes);
  std::mutex gate;
  std::vector<pthread_t> crew;
  crew.reserve(static_cast<std::size_t>(threads - 1));
  int code = 0;
  {
    // All of them at once: each waits at the gate.
    const std::scoped_lock closed(gate);
    const auto wait = [](void* at) -> void* {
      const std::scoped_lock passed(*static_cast<std::mutex*>(at));
      return nullptr;
    };
    pthread_t one{};
    while (code == 0 && static_cast<int>(crew.size()) < threads - 1) {
      code = pthread_create(&one, &attributes, wait, &gate);
      if (code == 0) crew.push_back(one);
    }
  }
  for (const pthread_t one : crew) pthread_join(one, nullptr);
  pthread_attr_destroy(&attributes);
  if (code != 0) refuse_threads(threads, code);
  granted = std::max(granted.load(), threads);
}

}  // namespace tofray::backend
