// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/words.h"

namespace tofray::mesh {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}
constexpr bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

/// One number of each row, or a list of them.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool list = false;
  PlyType count = PlyType::uint8;  ///< of a list: the type of its length, which is an integer
  Mark mark = {};                  ///< of its name
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  Mark mark;  ///< of its name
};

/// What the header of a PLY file says, checked.
struct PlyHeader {
  enum class Encoding { ascii, little_endian, big_endian };
  Encoding encoding = Encoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t length = 0;  ///< bytes: the data start here
  std::size_t lines = 0;
  struct Picture {
    std::string file;
    Mark mark;
  };
  std::vector<Picture> pictures;  ///< that comments name: comment TextureFile wood.png

  [[nodiscard]] const PlyElement* find(std::string_view element) const;
};

inline constexpr std::size_t max_ply_header_bytes = 65536;

/// @throws Error (bad_input) where the header is malformed; (limit) where it is longer than max_ply_header_bytes
PlyHeader parse_ply_header(std::string_view bytes, const std::string& name);

}  // namespace tofray::mesh
