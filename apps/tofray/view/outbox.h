// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "view/control.h"

namespace tofray::view {

/// A frame on its way to pages: each set of arrays that is wanted encoded once, and shared by all who want it.
struct Published {
  Side side = Side::a;
  std::uint32_t generation = 0, sequence = 0;
  std::uint64_t frame = 0;
  bool at_once = false;  ///< the answer to a change: no page's own rate holds it up
  std::vector<std::pair<std::vector<std::uint16_t>, std::shared_ptr<const std::string>>> messages;  ///< by arrays
};

/// What a session did so far.
struct SessionCounts {
  std::uint64_t computed = 0;  ///< frames
  double compute_ms = 0;       ///< of the last one
};

/// Where a session puts what it has for pages. Called by the session's thread.
class Outbox {
 public:
  virtual ~Outbox() = default;
  virtual void publish(std::shared_ptr<const Published> frame, SessionCounts counts) = 0;
  virtual void greet(std::uint64_t client, std::string hello) = 0;
  virtual void tell(std::uint64_t client, std::string text) = 0;
  /// A text and the arrays that belong to it, a binary message right behind it. Of a page's arrays of one kind that still wait, the last ones
  /// go.
  virtual void give(std::uint64_t client, std::string text, std::string arrays, std::uint8_t kind) = 0;
  virtual void tell_all(std::string text) = 0;
  virtual void own_rate(double hz) = 0;
  /// Side B is there from now on, anew where it was there before, or no longer.
  virtual void other(bool open) = 0;
};

}  // namespace tofray::view
