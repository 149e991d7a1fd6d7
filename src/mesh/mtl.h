// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/read_mesh.h"

/// Materials of OBJ files (MTL): of each what says how much it reflects.
namespace tofray::mesh {

/// The picture that scales a material's colour (map_Kd). It is seen at (u, v)·scale + offset, v upward as in OBJ files.
struct MtlPicture {
  Reference reference;
  std::array<double, 2> scale{1, 1}, offset{0, 0};
  bool clamp = false;  ///< its rim goes on beyond 0…1; else it repeats
};

struct MtlMaterial {
  std::string name;                            ///< may be empty: that of triangles whose material has no name
  std::optional<double> nir_reflectivity;      ///< at the illumination wavelength, 0…1
  std::optional<std::array<double, 3>> color;  ///< Kd: linear red, green, blue, 0…1 each
  std::optional<MtlPicture> picture;
};

struct Mtl {
  std::vector<MtlMaterial> materials;  ///< in the file's order; names may come twice
  std::vector<std::string> left_out;   ///< statements that are read past, each once; 20 at most
};

/// Reads an MTL file in linear time. Takes a few hundred bytes for each material beside the file's own.
///
/// Of a statement that comes twice the last one counts. Beside newmtl, Kd and map_Kd there is one of our own, which is a comment for all
/// other programs: a line `#!nir_reflectivity 0.6`. All other statements are read past, and so are options of map_Kd that nobody knows,
/// with one word behind them. Keywords may be in any case.
/// @param bytes  the whole file; who reads it sees that it has at most limit::mtl_bytes
/// @param most   materials
/// @throws Error (bad_input) for the first fault; (limit) beyond `most`
Mtl parse_mtl(std::string_view bytes, const std::string& name, std::size_t most);

}  // namespace tofray::mesh
