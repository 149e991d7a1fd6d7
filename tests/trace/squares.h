// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/tile_squares.h"

/// What the rays of a tile meet among all forms of a scene, compiled once for each instruction set: one form after the other or, where
/// there are packs, as a tile looks for it.
extern "C" {

/// Rays of a tile, and what they have met.
struct SquareTile {
  using Array = tofray::shape::TileRays::Array;
  alignas(64) Array x, y, z;                            ///< the way from the forms' origin, or where the way to the sun begins
  alignas(64) Array range;                              ///< of the latter, from the camera
  alignas(64) Array wanted;                             ///< 1 or 0
  std::int32_t object[tofray::shape::TileRays::count];  ///< on which a shadow falls
  alignas(64) Array w, dark;
  std::int32_t facet[tofray::shape::TileRays::count], triangle[tofray::shape::TileRays::count];
};

/// One of the forms is null.
struct SquareSearch {
  const tofray::scene::Forms* from_point;
  const tofray::scene::Alongs* parallel;
  bool shadow;                             ///< whether something stands before the end of the way, in place of where it stands
  const tofray::shape::Vec* toward_sun;    ///< where parallel
  const float* sun;                        ///< the same
  const tofray::scene::Bounds* rectangle;  ///< of the rays; null: each of them is held against one form after the other
  tofray::trace::Marks marks;
  unsigned char* room;  ///< for what is picked
  SquareTile* tile;
  bool by_squares;  ///< out: some forms were looked for in squares
};
using SquareSearchFunction = void (*)(SquareSearch*);
void square_search_scalar_fma(SquareSearch*);
void square_search_avx2(SquareSearch*);
void square_search_avx512(SquareSearch*);
void square_search_neon(SquareSearch*);
}
