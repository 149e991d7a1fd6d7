// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/item.h"
#include "gltf/read.h"

namespace tofray::gltf {

/// The bytes of a file's buffers and of views of them.
class Buffers {
 public:
  /// Reads all buffers and checks all views.
  /// @param binary  the binary file's own bytes, which the first buffer may be
  Buffers(const Item& root, std::optional<std::string_view> binary, const Resources& other_files);

  [[nodiscard]] std::size_t views() const { return views_.size(); }
  [[nodiscard]] std::uint64_t length(int view) const { return views_[static_cast<std::size_t>(view)].length; }
  /// Bytes from one element to the next; none where the view leaves it to the accessor.
  [[nodiscard]] std::optional<std::uint64_t> stride(int view) const { return views_[static_cast<std::size_t>(view)].stride; }
  /// @throws Error where its buffer has no bytes
  [[nodiscard]] std::string_view bytes(int view) const;
  /// Of all buffers that have bytes.
  [[nodiscard]] std::uint64_t total() const { return total_; }

 private:
  struct Buffer {
    std::uint64_t length = 0;
    std::optional<std::string_view> bytes;
  };
  struct View {
    Item item;
    int buffer;
    std::uint64_t offset, length;
    std::optional<std::uint64_t> stride;
  };
  void read_buffer(const Item& item, std::optional<std::string_view> binary, const Resources& other_files);
  void read_view(const Item& item);

  std::vector<Buffer> buffers_;
  std::vector<View> views_;
  std::vector<std::unique_ptr<const std::string>> owned_;  ///< what was read: the views' bytes stay where they are
  std::uint64_t total_ = 0;
};

}  // namespace tofray::gltf
