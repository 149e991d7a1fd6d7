// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "gltf/accessors.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/bytes.h"
#include "base/limits.h"
#include "base/text.h"
#include "gltf/accessor_form.h"

namespace tofray::gltf {
namespace {

/// A number as it is meant. In double, rounded once.
template <class Out, class In>
Out meant(In value, bool normalized) {
  if constexpr (std::is_floating_point_v<In>) {
    return static_cast<Out>(value);
  } else {
    if (!normalized) return static_cast<Out>(value);
    return static_cast<Out>(std::max(static_cast<double>(value) / static_cast<double>(std::numeric_limits<In>::max()), -1.0));
  }
}

/// Elements of `bytes`, `stride` apart, to where `place(i)` says.
template <class In, class Out, class Place>
void copy(const Accessor& accessor, const char* bytes, std::uint64_t count, std::uint64_t stride, const Place& place,
          std::vector<Out>& out) {
  const std::size_t column = column_bytes(accessor);
  for (std::uint64_t i = 0; i < count; ++i) {
    Out* to = out.data() + place(i) * accessor.width;
    for (std::size_t k = 0; k < accessor.width; ++k) {
      const char* at = bytes + i * stride + k / accessor.column * column + k % accessor.column * sizeof(In);
      to[k] = meant<Out>(base::read_bytes_as<In>(at), accessor.normalized);
    }
  }
}

template <class Out, class Place>
void copy_as_written(const Accessor& accessor, const char* bytes, std::uint64_t count, std::uint64_t stride, const Place& place,
                     std::vector<Out>& out) {
  switch (accessor.component) {
    case Component::int8: return copy<std::int8_t>(accessor, bytes, count, stride, place, out);
    case Component::uint8: return copy<std::uint8_t>(accessor, bytes, count, stride, place, out);
    case Component::int16: return copy<std::int16_t>(accessor, bytes, count, stride, place, out);
    case Component::uint16: return copy<std::uint16_t>(accessor, bytes, count, stride, place, out);
    case Component::uint32: return copy<std::uint32_t>(accessor, bytes, count, stride, place, out);
    case Component::float32:
      if constexpr (std::is_same_v<Out, float>) copy<float>(accessor, bytes, count, stride, place, out);
  }
}

std::uint32_t index_at(const char* bytes, Component component, std::uint64_t i) {
  if (component == Component::uint8) return base::read_bytes_as<std::uint8_t>(bytes + i);
  if (component == Component::uint16) return base::read_bytes_as<std::uint16_t>(bytes + 2 * i);
  return base::read_bytes_as<std::uint32_t>(bytes + 4 * i);
}

/// Which elements a sparse accessor has values for: rising, and within the accessor.
std::vector<std::uint32_t> sparse_indices(const Accessor& accessor, const char* bytes) {
  std::vector<std::uint32_t> out;
  out.reserve(accessor.sparse->count);
  for (std::uint64_t i = 0; i < accessor.sparse->count; ++i) {
    const std::uint32_t index = index_at(bytes, accessor.sparse->indices, i);
    if (index >= accessor.count)
      accessor.item.fail_at(
          "sparse.indices", "has an index that is none of an element",
          fmt::format("got {} as number {}, and there are {} elements, of which the first is 0", index, i, accessor.count));
    if (!out.empty() && index <= out.back())
      accessor.item.fail_at("sparse.indices", "do not rise", fmt::format("got {} behind {} as number {}", index, out.back(), i));
    out.push_back(index);
  }
  return out;
}

unsigned kind_of(const Accessor& accessor) {
  switch (accessor.component) {
    case Component::float32: return written::real;
    case Component::uint32: return written::whole_of_4_bytes;
    case Component::int8:
    case Component::int16: return accessor.normalized ? written::normalized_signed : written::whole_signed;
    default: return accessor.normalized ? written::normalized_unsigned : written::whole_unsigned;
  }
}

const char* name_of(const Accessor& accessor) {
  constexpr const char* names[] = {"bytes", "unsigned bytes", "shorts", "unsigned shorts", "unsigned ints", "floats"};
  return names[static_cast<std::size_t>(accessor.component)];
}

}  // namespace

Accessors::Accessors(const Item& root, const Buffers& buffers) : buffers_(buffers), items_(root.objects("accessors")) {
  accessors_.resize(items_.size());
  taken_.resize(items_.size());
}

const Accessor& Accessors::operator[](int i) const {
  auto& accessor = accessors_[static_cast<std::size_t>(i)];
  if (!accessor) accessor = read_accessor(items_[static_cast<std::size_t>(i)], buffers_);
  return *accessor;
}

void Accessors::check(const Accessor& accessor, const Wanted& wanted, const Item& user) const {
  const bool type = accessor.type == wanted.type || (wanted.other_type != nullptr && accessor.type == wanted.other_type);
  if (type && (kind_of(accessor) & wanted.as) != 0) return;
  accessor.item.fail(
      "is not what " + user.path() + " needs",
      fmt::format("got {} of {}{}, expected {}", accessor.type, accessor.normalized ? "normalized " : "", name_of(accessor), wanted.text));
}

void Accessors::charge(const Accessor& accessor) {
  const auto least = static_cast<std::uint64_t>(base::limit::gltf_number_bytes.value);
  const std::uint64_t most = std::max(least, static_cast<std::uint64_t>(base::limit::gltf_number_ratio.value) * buffers_.total());
  const std::uint64_t each = accessor.width * sizeof(float);
  if (accessor.count > (most - bytes_) / each)
    accessor.item.fail("has too many elements",
                       fmt::format("got {}; the numbers of this file may take {} bytes (`tofray --limits`), of which {} are left",
                                   accessor.count, most, most - bytes_),
                       ErrorKind::limit);
  bytes_ += accessor.count * each;
}

template <class Out>
std::vector<Out> Accessors::decode(const Accessor& accessor) const {
  std::vector<Out> out(accessor.count * accessor.width);
  if (accessor.view != none && accessor.count > 0) {
    const std::uint64_t stride = buffers_.stride(accessor.view).value_or(element_bytes(accessor));
    const char* bytes = buffers_.bytes(accessor.view).data() + accessor.offset;
    copy_as_written(
        accessor, bytes, accessor.count, stride, [](std::uint64_t i) { return i; }, out);
  }
  if (accessor.sparse && accessor.sparse->count > 0) {
    const auto& sparse = *accessor.sparse;
    const auto indices = sparse_indices(accessor, buffers_.bytes(sparse.indices_view).data() + sparse.indices_offset);
    const char* values = buffers_.bytes(sparse.values_view).data() + sparse.values_offset;
    copy_as_written(
        accessor, values, sparse.count, element_bytes(accessor), [&](std::uint64_t i) { return indices[i]; }, out);
  }
  return out;
}

Floats Accessors::floats(int accessor, const Wanted& wanted, const Item& user) {
  const Accessor& form = (*this)[accessor];
  check(form, wanted, user);
  Taken& taken = taken_[static_cast<std::size_t>(accessor)];
  if (!taken.floats) {
    charge(form);
    taken.floats = std::make_shared<const std::vector<float>>(decode<float>(form));
    for (std::size_t i = taken.floats->size(); i-- > 0;)
      if (!std::isfinite((*taken.floats)[i])) ++taken.not_finite, taken.first_not_finite = i;
  }
  return taken.floats;
}

Floats Accessors::finite_floats(int accessor, const Wanted& wanted, const Item& user) {
  const Floats all = floats(accessor, wanted, user);
  const Taken& taken = taken_[static_cast<std::size_t>(accessor)];
  if (taken.not_finite > 0)
    (*this)[accessor].item.fail("has numbers that are not finite",
                                fmt::format("got {} in element {} for {}", (*all)[taken.first_not_finite],
                                            taken.first_not_finite / (*this)[accessor].width, user.path()));
  return all;
}

Floats Accessors::mended_floats(int accessor, const Wanted& wanted, const Item& user, std::size_t& count) {
  const Floats all = floats(accessor, wanted, user);
  Taken& taken = taken_[static_cast<std::size_t>(accessor)];
  if (taken.not_finite == 0) return all;
  count += taken.not_finite;
  if (!taken.mended) {
    charge((*this)[accessor]);
    std::vector<float> mended = *all;
    std::replace_if(
        mended.begin(), mended.end(), [](float x) { return !std::isfinite(x); }, 0.F);
    taken.mended = std::make_shared<const std::vector<float>>(std::move(mended));
  }
  return taken.mended;
}

Wholes Accessors::wholes_below(int accessor, const Wanted& wanted, const Item& user, std::uint64_t limit, std::string_view things) {
  const Accessor& form = (*this)[accessor];
  check(form, wanted, user);
  Taken& taken = taken_[static_cast<std::size_t>(accessor)];
  if (!taken.wholes) {
    charge(form);
    taken.wholes = std::make_shared<const std::vector<std::uint32_t>>(decode<std::uint32_t>(form));
    if (!taken.wholes->empty()) taken.largest = *std::max_element(taken.wholes->begin(), taken.wholes->end());
  }
  if (!taken.wholes->empty() && taken.largest >= limit)
    form.item.fail(fmt::format("has an index that is none of the {} of {}", things, user.path()),
                   fmt::format("got {}, and there are {}, of which the first is 0", taken.largest, limit));
  return taken.wholes;
}

}  // namespace tofray::gltf
