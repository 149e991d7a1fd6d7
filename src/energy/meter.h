// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

/// How much energy the machine takes, as far as it says so.
namespace tofray::energy {

/// Joules that something has taken between two moments, from counters that the hardware keeps.
///
/// Where a counter cannot be read, `reason` says why and `joules` is NaN: never a guess. That can also happen half-way.
class Meter {
 public:
  Meter() = default;
  virtual ~Meter() = default;
  Meter(const Meter&) = delete;
  Meter& operator=(const Meter&) = delete;

  /// Why nothing can be read here; empty where it can.
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] bool readable() const { return reason_.empty(); }
  /// What is measured, e.g. "package-0, package-1" or the GPU's name.
  [[nodiscard]] const std::string& what() const { return what_; }

  /// Counts from now on.
  void start();
  /// Joules since `start`, or NaN. To be called at least once in the time in which a counter wraps around: a minute is often enough.
  double joules();

 protected:
  /// Joules since the last call of this function (any number on the first one). Sets the reason where a counter cannot be read.
  virtual double advance() = 0;
  void cannot(const std::string& reason) { reason_ = reason; }
  void measures(const std::string& what) { what_ = what; }

 private:
  std::string reason_, what_;
  double sum_ = 0;
};

}  // namespace tofray::energy
