// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

#include "backend/cpu/for_each_tile.h"
#include "backend/cpu/scratch.h"
#include "backend/cpu/thread_check.h"

namespace tofray::backend {

struct TileRunner::Impl {
  int threads;
  std::vector<ScratchMemory> scratch;
};

TileRunner::TileRunner(int threads, std::size_t scratch_bytes) : impl_(new Impl{threads, {}}) {
  for (int i = 0; i < threads; ++i) impl_->scratch.emplace_back(scratch_bytes);
}

TileRunner::~TileRunner() = default;
TileRunner::TileRunner(TileRunner&&) noexcept = default;

void TileRunner::for_each_tile(int count, const std::function<void(int, void*)>& piece) {
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex failing;
  const auto work = [&](std::size_t worker) {
    try {
      for (int i = next++; i < count; i = next++) piece(i, impl_->scratch[worker].data());
    } catch (...) {
      const std::scoped_lock lock(failing);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  try {
    std::vector<std::jthread> crew;
    for (int i = 1; i < impl_->threads; ++i) crew.emplace_back(work, static_cast<std::size_t>(i));
    work(0);
  } catch (const std::system_error& refused) {
    refuse_threads(impl_->threads, refused.code().value());
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace tofray::backend
