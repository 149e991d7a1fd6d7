// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tofray/frame.h"

/// Frames as binary messages (docs/reference/viewer-protocol.md): a head of 64 bytes, 32 bytes for each array, then the arrays' own bytes.
namespace tofray::view {

/// An array of a frame, as messages number and describe it. Its number is its place in the list. Behind those of frames stands z_error_m,
/// z_m − gt_z_m.
struct WireArray {
  const char* name;
  const char* unit;
  const char* what;
  const char* type;  ///< "f32", "u16", …
  std::uint8_t type_number;
  ArrayShape shape;
};
const std::vector<WireArray>& wire_arrays();
std::optional<std::uint16_t> find_wire_array(std::string_view name);
/// "image", "vectors", …
const char* shape_name(ArrayShape shape);

/// Where an array of a frame lies; null where the frame does not have it.
struct ArrayView {
  const void* data = nullptr;
  std::size_t bytes = 0;
  std::uint8_t rank = 0;
  std::uint32_t extents[3] = {};  ///< outermost first
};
/// @param made  memory for an array that is made of others
ArrayView view_of(const Frame& frame, std::uint16_t array, std::vector<float>& made);
bool has_array(const Frame& frame, std::uint16_t array);

/// The names of the frame's own arrays that these are made of, each once.
std::vector<std::string> sources_of(std::span<const std::uint16_t> arrays);

/// The values of one pixel: one for images, more for others; none where the frame does not have the array, and of lists.
std::vector<double> pixel_values(const Frame& frame, std::uint16_t array, std::size_t pixel);

struct WireHead {
  std::uint8_t channel = 0;  ///< 0, 1: frames of side A and B; 2, 3: answers of side A and B
  std::uint8_t flags = 0;
  std::uint32_t generation = 0, sequence = 0;
  double time_s = 0;
  float compute_ms = 0;
};

/// An array that is no frame's.
struct StaticArray {
  std::uint8_t type_number = 5;  ///< as WireArray::type_number: f32
  ArrayView view;
};
/// A message that answers a question: its arrays are numbered from 0 on.
/// @throws Error (limit) where it would be longer than 1 GB
std::string encoded(const WireHead& head, std::uint64_t frame, std::uint32_t width, std::uint32_t height,
                    std::span<const StaticArray> arrays);

/// The message of these arrays; those that the frame does not have are left out.
/// @throws Error (limit) where it would be longer than 1 GB
std::string encoded(const WireHead& head, const Frame& frame, std::span<const std::uint16_t> arrays);

}  // namespace tofray::view
