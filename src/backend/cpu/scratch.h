// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

namespace tofray::backend {

/// Bytes of memory aligned to 64.
class ScratchMemory {
 public:
  explicit ScratchMemory(std::size_t bytes) : memory_(std::aligned_alloc(64, (bytes + 63) / 64 * 64), &std::free) {
    if (memory_ == nullptr) throw std::bad_alloc();
  }
  [[nodiscard]] void* data() const { return memory_.get(); }

 private:
  std::unique_ptr<void, void (*)(void*)> memory_;
};

}  // namespace tofray::backend
