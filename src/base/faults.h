// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <compare>
#include <memory>
#include <string>
#include <vector>

#include "tofray/error.h"

/// Faults in what a user wrote: all of a file are collected, then reported at once.
namespace tofray::base {

/// Where something stands. Lines and columns count from 1; line 0: the source as a whole (e.g. "--set lens.f_number").
struct Place {
  std::shared_ptr<const std::string> source;
  int line = 0;
  int column = 0;
};

/// file:line:col
std::string to_string(const Place& place);

/// A place that is a whole source.
Place whole(const std::string& source);

class Faults {
 public:
  /// Adds a fault. @throws Error as raise() does where limit::faults_counted is reached: the reading ends there
  /// @param what   the first line, complete in itself
  /// @param more   what was got, what is expected, how to mend it; may have several lines
  void add(const Place& place, const std::string& what, const std::string& more = {}, ErrorKind kind = ErrorKind::bad_input);
  [[nodiscard]] std::size_t size() const { return faults_.size(); }
  [[nodiscard]] bool empty() const { return faults_.empty(); }
  /// All faults in the order of their places, at most limit::faults_shown of them.
  [[nodiscard]] std::string text() const;
  /// @throws Error where there are faults; of kind `limit` if all are over limits, else `bad_input`.
  void raise() const;

 private:
  struct Fault {
    Place place;
    std::string text;
    ErrorKind kind;
  };
  std::vector<Fault> faults_;
};

/// A value given in code that cannot be taken. @throws Error (bad input): "error: " and the message
[[noreturn]] void refuse(const std::string& message);

/// One fault that ends the reading at once.
[[noreturn]] void fail(const Place& place, const std::string& what, const std::string& more = {}, ErrorKind kind = ErrorKind::bad_input);

}  // namespace tofray::base
