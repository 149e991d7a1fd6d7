// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/read_mesh.h"

#include "base/text.h"
#include "mesh/formats.h"
#include "mesh/other_formats.h"

namespace tofray::mesh {

std::string suffix_of(const std::string& path) {
  const std::string file = path.substr(path.rfind('/') + 1);  // npos + 1 is 0
  const std::size_t dot = file.rfind('.');
  std::string suffix = dot == std::string::npos ? std::string() : file.substr(dot);
  for (char& c : suffix)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return suffix;
}

Format format_of(const std::string& path, const base::Place& place) {
  const std::string file = path.substr(path.rfind('/') + 1), suffix = suffix_of(path);
  if (suffix == ".obj") return Format::obj;
  if (suffix == ".ply") return Format::ply;
  if (suffix == ".stl") return Format::stl;
  const std::optional<OtherFormat> other = other_format_of(path);
  base::fail(place, base::in_quotes(file) + " is no mesh that can be read",
             "got " +
                 (suffix.empty() ? "a name without suffix"
                  : other        ? other->what + " (" + suffix + ")"
                                 : "the suffix " + base::in_quotes(suffix)) +
                 ", expected " + formats_read + (other ? "; " + other->way : std::string()));
}

ReadMesh parse(Format format, std::string_view bytes, const std::string& name) {
  constexpr const char* names[] = {"OBJ", "PLY", "STL"};
  // A binary STL file may begin with anything.
  if (const auto other = other_format_in(bytes); other && !(format == Format::stl && is_binary_stl(bytes)))
    base::fail(base::whole(name), std::string("this is no ") + names[static_cast<int>(format)] + " file, but " + other->what, other->way);
  switch (format) {
    case Format::obj: return parse_obj(bytes, name);
    case Format::ply: return parse_ply(bytes, name);
    case Format::stl: break;
  }
  return parse_stl(bytes, name);
}

}  // namespace tofray::mesh
