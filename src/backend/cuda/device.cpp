// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cuda/device.h"

#include "backend/cuda/part.h"

namespace tofray::backend::gpu {

namespace {

/// Looked for once.
const Part& part() {
  static const Part found = find_part();
  return found;
}

Runtime*& current_runtime() {
  static Runtime* current = part().runtime;
  return current;
}

std::string in_megabytes(std::size_t bytes) { return std::to_string((bytes + 999'999) / 1'000'000) + " MB"; }

}  // namespace

Runtime* runtime() { return current_runtime(); }
Runtime* replace_runtime(Runtime* stand_in) { return std::exchange(current_runtime(), stand_in); }

Fault::Fault(const std::string& reason, bool gpu_present)
    : Error(ErrorKind::device,
            "error: no GPU can be used: " + reason + "\n  take the backend cpu, or auto: the results are what they would be"),
      reason_(reason),
      gpu_present_(gpu_present) {}

Device::Device(int number) : runtime_(gpu::runtime()), number_(number) {
  if (runtime_ == nullptr) throw Fault(part().lack, part().is_installed);
  int count = 0;
  check(runtime_->count_devices(count), "looking for GPUs");
  if (count < 1) throw Fault("there is no GPU", false);
  if (number_ >= count) {
    throw Fault("there is no GPU number " + std::to_string(number_) + "; the machine has " + std::to_string(count) + ", counted from 0",
                true);
  }
  check(runtime_->describe(number_, info_), "asking for its properties");
  use();
  check(runtime_->find_code(), "looking for its code");
}

void Device::check(Status status, const char* doing) const {
  if (status != 0) fail(status, doing);
}

void Device::fail(Status status, const char* doing) const {
  const std::string which = info_.name.empty() ? "the GPU" : info_.name;
  switch (runtime_->cause(status)) {
    case Cause::no_driver: throw Fault("no NVIDIA driver is installed", false);
    case Cause::old_driver:
      throw Fault(
          "the NVIDIA driver is too old: it knows CUDA " + runtime_->driver_version() + ", this build needs " + runtime_->runtime_version(),
          true);
    case Cause::no_device: throw Fault("there is no GPU", false);
    case Cause::busy: throw Fault(which + " is taken by another program", true);
    case Cause::no_memory: throw Fault(which + " or its host has too little memory (" + doing + ")", true);
    case Cause::no_code:
      throw Fault(
          "this build has no code for " + which + ", compute capability " + std::to_string(info_.major) + "." + std::to_string(info_.minor),
          true);
    case Cause::other: break;
  }
  throw Fault(which + " failed while " + doing + ": " + runtime_->text(status), true);
}

DeviceMemory Device::allocate(std::size_t bytes) const {
  use();
  void* memory = nullptr;
  const std::string doing = "taking " + in_megabytes(bytes) + " of the GPU's memory";
  check(runtime_->allocate(bytes, memory), doing.c_str());
  return {*runtime_, memory};
}

PinnedMemory Device::allocate_pinned(std::size_t bytes) const {
  use();
  void* memory = nullptr;
  const std::string doing = "taking " + in_megabytes(bytes) + " of pinned memory";
  check(runtime_->allocate_pinned(bytes, memory), doing.c_str());
  return {*runtime_, memory};
}

Stream Device::stream() const {
  use();
  void* handle = nullptr;
  check(runtime_->create_stream(handle), "making a stream");
  return {*runtime_, handle};
}

Event Device::event() const {
  use();
  void* handle = nullptr;
  check(runtime_->create_event(handle), "making an event");
  return {*runtime_, handle};
}

Device open_device(int number) {
  if (number >= 0) return Device(number);
  try {
    return Device(0);
  } catch (const Fault&) {
    for (int i = 1; i < count_devices(); ++i) {
      try {
        return Device(i);
      } catch (const Fault&) {
        continue;  // the first one's reason is told
      }
    }
    throw;
  }
}

int count_devices() {
  int count = 0;
  return runtime() != nullptr && runtime()->count_devices(count) == 0 ? count : 0;
}

}  // namespace tofray::backend::gpu
