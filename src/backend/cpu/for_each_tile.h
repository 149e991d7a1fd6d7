// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace tofray::backend {

/// Threads over independent pieces of work; each worker has scratch memory of its own, aligned to 64 bytes.
/// oneTBB does it, or std::thread where ThreadSanitizer watches (it knows nothing of TBB's own synchronisation).
class TileRunner {
 public:
  /// @throws Error (limit) where the system refuses that many threads
  TileRunner(int threads, std::size_t scratch_bytes);
  ~TileRunner();
  TileRunner(TileRunner&&) noexcept;
  /// Calls `piece(index, scratch)` for 0 <= index < count, in any order, and waits. An exception in a piece surfaces here.
  void for_each_tile(int count, const std::function<void(int, void*)>& piece);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tofray::backend
