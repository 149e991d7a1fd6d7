// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "backend/cuda/resource.h"
#include "tofray/error.h"

/// One GPU, every call to it checked.
namespace tofray::backend::gpu {

/// A GPU that cannot be used, or that failed.
class Fault : public Error {
 public:
  Fault(const std::string& reason, bool gpu_present);
  [[nodiscard]] const std::string& reason() const { return reason_; }
  /// There is a GPU or its driver.
  [[nodiscard]] bool gpu_present() const { return gpu_present_; }

 private:
  std::string reason_;
  bool gpu_present_;
};

class Device {
 public:
  /// @param number  from 0 on
  /// @throws Fault  with the reason where it cannot be used: no driver, driver too old, no such GPU, no code for it, busy
  explicit Device(int number);

  [[nodiscard]] Runtime& runtime() const { return *runtime_; }
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] const DeviceInfo& info() const { return info_; }
  /// Throws where a call did not go well. `doing`: "copying a frame to the host".
  void check(Status status, const char* doing) const;
  /// Calls of this thread from here on are for this GPU.
  void use() const { check(runtime_->use(number_), "choosing the GPU"); }

  // What is taken is this GPU's, which it leaves current in the calling thread.
  [[nodiscard]] DeviceMemory allocate(std::size_t bytes) const;
  [[nodiscard]] PinnedMemory allocate_pinned(std::size_t bytes) const;
  [[nodiscard]] Stream stream() const;
  [[nodiscard]] Event event() const;

 private:
  [[noreturn]] void fail(Status status, const char* doing) const;

  Runtime* runtime_;
  int number_;
  DeviceInfo info_;
};

/// @param number  −1: the first one that can be used
/// @throws Fault  with the reason where there is none; of several, the first one's
Device open_device(int number);

/// How many GPUs there are; 0 where there is no way to them.
int count_devices();

}  // namespace tofray::backend::gpu
