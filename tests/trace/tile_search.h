// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/mesh_square.h"

/// What a tile's rays meet of a mesh, compiled once for each instruction set: ray by ray where it has no packs, else by
/// squares, or each ray alone.
extern "C" {

/// One of the forms is null. \p any  as of MeshSquare
/// \p all_blocks  above 0: so many blocks of triangles are all looked at, one triangle after the other, without boxes (a form from a
/// point, and not \p any)
struct TileSearch {
  const tofray::shape::MeshForm* from_point;
  const tofray::shape::MeshAlong* parallel;
  bool any;
  tofray::shape::TileRays* rays;
  int all_blocks = 0;
  bool alone = false;  ///< as rays that have nothing in common, not by squares
};
using TileSearchFunction = void (*)(const TileSearch*);
void tile_search_scalar(const TileSearch*);
void tile_search_scalar_fma(const TileSearch*);
void tile_search_avx2(const TileSearch*);
void tile_search_avx512(const TileSearch*);
void tile_search_neon(const TileSearch*);
}
