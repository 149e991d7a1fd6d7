// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cerrno>

#include "files/atomic_file.h"

namespace tofray::files {

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number, const FileCalls& calls = system_file_calls()) : number_(number), calls_(calls) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) calls_.close(number_);
  }
  [[nodiscard]] int number() const { return number_; }
  /// Closes now and says whether that went well. Linux closes on EINTR, too.
  bool close() {
    const int result = calls_.close(number_);
    number_ = -1;
    return result == 0 || errno == EINTR;
  }

 private:
  int number_;
  const FileCalls& calls_;
};

}  // namespace tofray::files
