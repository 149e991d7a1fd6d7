// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "pipeline/setup.h"

namespace tofray::backend {

/// One frame's arrays in one piece of memory, so that a frame is copied by one call.
class Slab {
 public:
  Slab() = default;
  /// @param wanted   arrays that are null here get no place
  /// @param scratch  floats beside them
  Slab(const pipeline::Setup& setup, const flow::FrameView& wanted, std::int64_t scratch);

  /// Bytes from one frame to the next; of them those that the caller wants to see come first.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] std::size_t shown_bytes() const { return shown_bytes_; }
  /// The arrays of the frame that begins at `base`.
  [[nodiscard]] flow::FrameView view(void* base) const;
  [[nodiscard]] float* scratch(void* base) const;
  /// A part of an array, and where it belongs.
  struct Piece {
    void* to;
    const void* from;
    std::size_t bytes;
  };
  /// The arrays of the frame that begins at `base`, as pieces for several threads to copy to those of `to` that are not null.
  [[nodiscard]] std::vector<Piece> pieces(const void* base, const flow::FrameView& to) const;
  [[nodiscard]] const flow::FrameSize& size() const { return size_; }
  bool operator==(const Slab&) const = default;

 private:
  [[nodiscard]] std::size_t count(ArrayShape shape) const;

  flow::FrameSize size_{};
  std::size_t bytes_ = 0, shown_bytes_ = 0;
  std::size_t offset_[flow::array_count] = {};  // +1; 0: no place
  std::size_t scratch_offset_ = 0;
};

}  // namespace tofray::backend
