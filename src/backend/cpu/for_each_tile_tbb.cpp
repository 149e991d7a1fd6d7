// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>

#include "backend/cpu/for_each_tile.h"
#include "backend/cpu/scratch.h"
#include "backend/cpu/thread_check.h"
#include "base/address_space.h"

namespace tofray::backend {

struct TileRunner::Impl {
  int threads;
  // More threads than cores run only where the global limit allows them.
  tbb::global_control limit;
  tbb::task_arena arena;
  std::vector<ScratchMemory> scratch;
};

namespace {

int granted(int threads) {
  // oneTBB 2022 (Debian 13) waits for itself for ever where it finds no memory to begin with.
  if (threads > 1) base::require_address_space(base::library_bytes);
  require_threads(threads, tbb::global_control::active_value(tbb::global_control::thread_stack_size));
  return threads;
}

}  // namespace

TileRunner::TileRunner(int threads, std::size_t scratch_bytes)
    : impl_(new Impl{granted(threads),
                     tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                         std::max(static_cast<std::size_t>(threads),
                                                  tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))),
                     tbb::task_arena(threads),
                     {}}) {
  if (threads > 1) impl_->arena.initialize();  // at once, where the memory for it was seen
  for (int i = 0; i < threads; ++i) impl_->scratch.emplace_back(scratch_bytes);
}

TileRunner::~TileRunner() = default;
TileRunner::TileRunner(TileRunner&&) noexcept = default;

void TileRunner::for_each_tile(int count, const std::function<void(int, void*)>& piece) {
  if (impl_->threads == 1) {
    for (int i = 0; i < count; ++i) piece(i, impl_->scratch[0].data());
    return;
  }
  impl_->arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<int>(0, count, 1), [&](const tbb::blocked_range<int>& range) {
      void* scratch = impl_->scratch[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())].data();
      for (int i = range.begin(); i < range.end(); ++i) piece(i, scratch);
    });
  });
}

}  // namespace tofray::backend
