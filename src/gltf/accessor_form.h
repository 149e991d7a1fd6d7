// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "gltf/accessors.h"

namespace tofray::gltf {

constexpr std::size_t size_of(Component component) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4};
  return sizes[static_cast<std::size_t>(component)];
}

/// Bytes from a column of an element to the next; only matrices have several.
constexpr std::size_t column_bytes(const Accessor& accessor) {
  const std::size_t bytes = accessor.column * size_of(accessor.component);
  return accessor.width == accessor.column ? bytes : (bytes + 3) / 4 * 4;
}

constexpr std::size_t element_bytes(const Accessor& accessor) { return accessor.width / accessor.column * column_bytes(accessor); }

/// Reads what an accessor says. @throws Error where it does not lie within its views
Accessor read_accessor(const Item& item, const Buffers& buffers);

}  // namespace tofray::gltf
