// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "gltf/accessor_form.h"

#include <fmt/core.h>

#include "base/text.h"

namespace tofray::gltf {
namespace {

struct Type {
  std::string_view name;
  std::size_t width, column;
};
constexpr Type types[] = {{"SCALAR", 1, 1}, {"VEC2", 2, 2}, {"VEC3", 3, 3}, {"VEC4", 4, 4},
                          {"MAT2", 4, 2},   {"MAT3", 9, 3}, {"MAT4", 16, 4}};

void read_type(const Item& item, Accessor& accessor) {
  const std::string_view name = item.required_text("type");
  for (const Type& type : types)
    if (type.name == name) {
      accessor.type = type.name, accessor.width = type.width, accessor.column = type.column;
      return;
    }
  item.fail_at("type", "is none of an accessor",
               "got " + base::in_quotes(name) + ", expected SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
}

Component component_of(const Item& item) {
  switch (item.required_count("componentType")) {
    case 5120: return Component::int8;
    case 5121: return Component::uint8;
    case 5122: return Component::int16;
    case 5123: return Component::uint16;
    case 5125: return Component::uint32;
    case 5126: return Component::float32;
    default:
      item.fail_at("componentType", "is none of an accessor",
                   fmt::format("got {}, expected 5120 (byte), 5121, 5122 (short), 5123, 5125 (unsigned int) or 5126 (float)",
                               item.required_count("componentType")));
  }
}

/// @param element  bytes of one
/// @param stride   bytes from one to the next
void check_room(const Item& item, const Buffers& buffers, int view, std::uint64_t offset, std::uint64_t count, std::uint64_t element,
                std::uint64_t stride) {
  const std::uint64_t length = buffers.length(view);
  if (count == 0 || (offset <= length && element <= length - offset && count - 1 <= (length - offset - element) / stride)) return;
  item.fail("ends outside its view",
            fmt::format("got {} elements of {} bytes each from byte {} on, {} bytes apart; bufferViews[{}] has {} bytes", count, element,
                        offset, stride, view, length));
}

Accessor::Sparse read_sparse(const Item& item, const Accessor& accessor, const Buffers& buffers) {
  Accessor::Sparse out;
  out.count = item.required_count("count");
  if (out.count > accessor.count)
    item.fail_at("count", "is more than the accessor has", fmt::format("got {}, and there are {} elements", out.count, accessor.count));
  const Item indices = item.required_object("indices"), values = item.required_object("values");
  out.indices = component_of(indices);
  if (out.indices != Component::uint8 && out.indices != Component::uint16 && out.indices != Component::uint32)
    indices.fail_at("componentType", "is none of indices", "expected 5121, 5123 or 5125: unsigned whole numbers");
  out.indices_view = indices.required_index("bufferView", buffers.views(), "bufferViews");
  out.indices_offset = indices.count("byteOffset").value_or(0);
  out.values_view = values.required_index("bufferView", buffers.views(), "bufferViews");
  out.values_offset = values.count("byteOffset").value_or(0);
  const std::size_t index = size_of(out.indices), element = element_bytes(accessor);
  check_room(indices, buffers, out.indices_view, out.indices_offset, out.count, index, index);
  check_room(values, buffers, out.values_view, out.values_offset, out.count, element, element);
  return out;
}

}  // namespace

Accessor read_accessor(const Item& item, const Buffers& buffers) {
  Accessor out{item};
  read_type(item, out);
  out.component = component_of(item);
  out.normalized = item.flag_or("normalized", false);
  if (out.normalized && (out.component == Component::float32 || out.component == Component::uint32))
    item.fail_at("normalized", "is true of numbers that cannot be normalized", "expected whole numbers of 1 or 2 bytes");
  out.count = item.required_count("count");
  out.view = item.index("bufferView", buffers.views(), "bufferViews");
  out.offset = item.count("byteOffset").value_or(0);
  if (out.view != none) {
    const std::uint64_t element = element_bytes(out), stride = buffers.stride(out.view).value_or(element);
    if (stride < element)
      item.fail("has elements that overlap",
                fmt::format("each has {} bytes, and bufferViews[{}] has a byteStride of {}", element, out.view, stride));
    check_room(item, buffers, out.view, out.offset, out.count, element, stride);
  }
  if (const auto sparse = item.object("sparse")) out.sparse = read_sparse(*sparse, out, buffers);
  return out;
}

}  // namespace tofray::gltf
