// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "gltf/buffers.h"

#include <fmt/core.h>

#include "base/limits.h"
#include "gltf/uri.h"

namespace tofray::gltf {
namespace {

constexpr auto most_bytes = static_cast<std::uint64_t>(base::limit::mesh_bytes.value);

/// Whether the bytes of a view exist packed alone.
const char* packed_by(const Item& item) {
  const auto extensions = item.object("extensions");
  if (!extensions) return nullptr;
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    if (extensions->has(name)) return name;
  return nullptr;
}

}  // namespace

Buffers::Buffers(const Item& root, std::optional<std::string_view> binary, const Resources& other_files) {
  for (const Item& item : root.objects("buffers")) read_buffer(item, binary, other_files);
  for (const Item& item : root.objects("bufferViews")) read_view(item);
}

void Buffers::read_buffer(const Item& item, std::optional<std::string_view> binary, const Resources& other_files) {
  Buffer& buffer = buffers_.emplace_back();
  buffer.length = item.required_count("byteLength");
  if (item.has("uri")) {
    std::string mime_type;
    owned_.push_back(std::make_unique<const std::string>(bytes_of_uri(item, other_files, most_bytes - total_, mime_type)));
    buffer.bytes = *owned_.back();
    total_ += buffer.bytes->size();
  } else if (buffers_.size() == 1 && binary) {
    buffer.bytes = binary;
    total_ += binary->size();
  }
  if (buffer.bytes && buffer.bytes->size() < buffer.length)
    item.fail("is cut short", fmt::format("its byteLength is {}, and there are {} bytes", buffer.length, buffer.bytes->size()));
}

void Buffers::read_view(const Item& item) {
  View view{item, item.required_index("buffer", buffers_.size(), "buffers"), item.count("byteOffset").value_or(0),
            item.required_count("byteLength"), item.count("byteStride")};
  const std::uint64_t there = buffers_[static_cast<std::size_t>(view.buffer)].length;
  if (view.offset > there || view.length > there - view.offset)
    item.fail("ends outside its buffer",
              fmt::format("got {} bytes from byte {} on, and buffers[{}] has {}", view.length, view.offset, view.buffer, there));
  if (view.stride && *view.stride == 0) item.fail_at("byteStride", "is 0", "expected 4 to 252, or none");
  views_.push_back(view);
}

std::string_view Buffers::bytes(int view) const {
  const View& wanted = views_[static_cast<std::size_t>(view)];
  const Buffer& buffer = buffers_[static_cast<std::size_t>(wanted.buffer)];
  if (!buffer.bytes) {
    if (const char* packed = packed_by(wanted.item))
      wanted.item.fail("is packed", fmt::format("{} cannot be read: export without meshopt compression", packed));
    wanted.item.fail("has no bytes",
                     fmt::format("buffers[{}] has no uri, and only the first buffer of a binary file needs none", wanted.buffer));
  }
  return buffer.bytes->substr(wanted.offset, wanted.length);
}

}  // namespace tofray::gltf
