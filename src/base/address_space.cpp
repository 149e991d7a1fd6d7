// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/address_space.h"

#include <sys/mman.h>

#include <new>

namespace tofray::base {

void require_address_space(std::size_t bytes) {
  void* const there = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (there == MAP_FAILED) throw std::bad_alloc();
  ::munmap(there, bytes);
}

}  // namespace tofray::base
