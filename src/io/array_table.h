// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "io/npy.h"

/// The arrays of frame.npz: those of a frame (tofray/frame_arrays.h) and what goes with them into the file. (`meta`, a text, is always there.)
namespace tofray::io {

struct ArrayRow {
  std::string name;
  NpyType type;
  std::string shape;   ///< "[phase, height, width]"; "[]": one number
  std::string unit;    ///< "W/(m2 sr)"; "1": none
  std::string from;    ///< what it comes from: a stage of the pipeline, or "scene", "camera"
  std::string what;    ///< one sentence
};

/// In the order of the file.
const std::vector<ArrayRow>& array_table();
/// The row of that name, or none.
const ArrayRow* find_array(std::string_view name);

/// docs/reference/arrays.md.
std::string array_reference();

}  // namespace tofray::io
