// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <utility>

#include "backend/cuda/runtime.h"

/// What is taken from the runtime and given back in the end.
namespace tofray::backend::gpu {

/// A handle that is given back by `give_back`.
template <void (Runtime::*give_back)(void*)>
class Held {
 public:
  Held() = default;
  Held(Runtime& runtime, void* handle) : runtime_(&runtime), handle_(handle) {}
  Held(Held&& other) noexcept : runtime_(other.runtime_), handle_(std::exchange(other.handle_, nullptr)) {}
  Held& operator=(Held&& other) noexcept {
    std::swap(runtime_, other.runtime_), std::swap(handle_, other.handle_);
    return *this;
  }
  ~Held() {
    if (handle_ != nullptr) (runtime_->*give_back)(handle_);
  }
  [[nodiscard]] void* get() const { return handle_; }

 private:
  Runtime* runtime_ = nullptr;
  void* handle_ = nullptr;
};

using Stream = Held<&Runtime::destroy_stream>;
using Event = Held<&Runtime::destroy_event>;
using Graph = Held<&Runtime::destroy_graph>;
using DeviceMemory = Held<&Runtime::release>;
using PinnedMemory = Held<&Runtime::release_pinned>;

}  // namespace tofray::backend::gpu
