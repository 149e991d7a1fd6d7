// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Any bytes as a mesh; the first says which format: an Error, or triangles of vertices that are there and finite.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "fuzz/shown.h"
#include "mesh/read_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr tofray::mesh::Format formats[] = {tofray::mesh::Format::obj, tofray::mesh::Format::ply, tofray::mesh::Format::stl};
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    const tofray::mesh::ReadMesh read = tofray::mesh::parse(formats[data[0] % 3], bytes, "<fuzz>");
    if (read.mesh.triangles.empty()) std::abort();
    for (const auto& vertex : read.mesh.vertices)
      for (const float coordinate : vertex)
        if (!std::isfinite(coordinate)) std::abort();
    for (const auto& triangle : read.mesh.triangles)
      for (const std::int32_t index : triangle)
        if (index < 0 || static_cast<std::size_t>(index) >= read.mesh.vertices.size()) std::abort();
  } catch (const tofray::Error& e) {
    if (e.kind() == tofray::ErrorKind::bug || std::string(e.what()).find(": error: ") == std::string::npos) std::abort();
    if (!tofray::fuzz::may_be_shown(e)) std::abort();
  }
  return 0;
}
