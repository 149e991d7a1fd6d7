// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "io/array_table.h"

#include <fmt/format.h>

#include "tofray/frame_arrays.h"

namespace tofray::io {
namespace {

const char* shape_of(ArrayShape shape) {
  switch (shape) {
    case ArrayShape::image: return "[height, width]";
    case ArrayShape::vectors: return "[height, width, 3]";
    case ArrayShape::stack: return "[phase, height, width]";
    case ArrayShape::list: return "[phase]";
  }
  return "";
}

const char* name_of(Stage stage) {
  switch (stage) {
    case Stage::trace: return "trace";
    case Stage::power: return "power";
    case Stage::raw: return "raw";
    case Stage::depth: return "depth";
  }
  return "";
}

std::vector<ArrayRow> make_table() {
  std::vector<ArrayRow> rows;
  const NpyType number = npy_type_of<double>();
#define TOFRAY_ROW(name, part, member, element, shape, stage, unit, what) \
  rows.push_back({#name, npy_type_of<element>(), shape_of(ArrayShape::shape), unit, name_of(Stage::stage), what});
  TOFRAY_RAW_ARRAYS(TOFRAY_ROW)
  TOFRAY_EXPOSURE_ARRAYS(TOFRAY_ROW)
  rows.back().type = npy_type_of<bool>();   // `lit`: a byte in memory, which has no arrays of bool
  TOFRAY_DEPTH_ARRAYS(TOFRAY_ROW)
  rows.push_back({"gt_time_s", number, "[]", "s", "trace", "when the ground truth holds: the middle of the middle raw frame"});
  TOFRAY_TRUTH_ARRAYS(TOFRAY_ROW)
#undef TOFRAY_ROW
  rows.push_back({"camera_matrix", number, "[3, 3]", "px", "camera", "fx, 0, cx; 0, fy, cy; 0, 0, 1"});
  rows.push_back({"distortion", number, "[5]", "1", "camera", "k1, k2, p1, p2, k3"});
  rows.push_back({"camera_pose", number, "[4, 4]", "m", "scene", "camera to world; the last row is 0, 0, 0, 1"});
  return rows;
}

}  // namespace

const std::vector<ArrayRow>& array_table() {
  static const std::vector<ArrayRow> table = make_table();
  return table;
}

const ArrayRow* find_array(std::string_view name) {
  for (const ArrayRow& row : array_table()) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

std::string array_reference() {
  std::string text =
      "<!-- SPDX-FileCopyrightText: 2026 The tofray authors -->\n"
      "<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
      "<!-- Written by tofray list arrays --markdown. -->\n"
      "# Arrays of frame.npz\n\n";
  text += "| array | type | shape | unit | from | what it is |\n|---|---|---|---|---|---|\n";
  for (const ArrayRow& row : array_table())
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", row.name, row.type.name(), row.shape, row.unit, row.from, row.what);
  return text;
}

}  // namespace tofray::io
