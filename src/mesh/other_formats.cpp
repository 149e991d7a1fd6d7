// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/other_formats.h"

#include <algorithm>
#include <cstdint>

#include "base/bytes.h"
#include "mesh/read_mesh.h"

namespace tofray::mesh {
namespace {

constexpr const char* by_blender = "Blender imports it and exports glTF (.glb)";
constexpr const char* by_meshlab = "MeshLab imports it and exports PLY";
constexpr const char* by_cad = "its CAD program, or FreeCAD, exports a mesh of it as STL or OBJ";
constexpr const char* by_its_program = "the program that made it exports glTF or OBJ";
constexpr const char* no_surface = "points have no surface: make a mesh of them, as MeshLab and CloudCompare do, and export PLY";
constexpr const char* unpack = "unpack it first";

struct Suffix {
  std::string_view suffix;
  const char* what;
  const char* way;
};
constexpr Suffix suffixes[] = {{".dae", "a Collada file", by_blender},
                               {".fbx", "an FBX file", by_blender},
                               {".blend", "a file of Blender's", "Blender exports it as glTF (.glb)"},
                               {".usd", "a USD file", by_blender},
                               {".usda", "a USD file", by_blender},
                               {".usdc", "a USD file", by_blender},
                               {".usdz", "a USD file", by_blender},
                               {".abc", "an Alembic file", by_blender},
                               {".x3d", "an X3D file", by_blender},
                               {".wrl", "a VRML file", by_blender},
                               {".3ds", "a 3DS file", by_meshlab},
                               {".off", "an OFF file", by_meshlab},
                               {".3mf", "a 3MF file", by_meshlab},
                               {".amf", "an AMF file", "a slicer program imports it and exports STL"},
                               {".ctm", "an OpenCTM file", by_meshlab},
                               {".vtk", "a VTK file", "ParaView imports it and exports PLY"},
                               {".vtp", "a VTK file", "ParaView imports it and exports PLY"},
                               {".drc", "a mesh compressed by Draco", "draco_decoder makes an OBJ or PLY file of it"},
                               {".max", "a file of 3ds Max", by_its_program},
                               {".ma", "a file of Maya", by_its_program},
                               {".mb", "a file of Maya", by_its_program},
                               {".c4d", "a file of Cinema 4D", by_its_program},
                               {".skp", "a file of SketchUp", by_its_program},
                               {".stp", "a STEP file", by_cad},
                               {".step", "a STEP file", by_cad},
                               {".igs", "an IGES file", by_cad},
                               {".iges", "an IGES file", by_cad},
                               {".brep", "a BREP file", by_cad},
                               {".ifc", "an IFC file", by_cad},
                               {".dxf", "a DXF file", by_cad},
                               {".dwg", "a DWG file", by_cad},
                               {".3dm", "a file of Rhino's", "Rhino exports it as OBJ"},
                               {".fcstd", "a file of FreeCAD's", "FreeCAD exports it as STL or OBJ"},
                               {".sldprt", "a file of SolidWorks", "SolidWorks exports it as STL"},
                               {".pcd", "a cloud of points", no_surface},
                               {".las", "a cloud of points", no_surface},
                               {".laz", "a cloud of points", no_surface},
                               {".e57", "a cloud of points", no_surface},
                               {".xyz", "a cloud of points", no_surface},
                               {".pts", "a cloud of points", no_surface},
                               {".gz", "a compressed file", unpack},
                               {".bz2", "a compressed file", unpack},
                               {".xz", "a compressed file", unpack},
                               {".zst", "a compressed file", unpack},
                               {".zip", "an archive", unpack},
                               {".7z", "an archive", unpack}};

struct Beginning {
  std::string_view bytes;
  const char* what;
  const char* way;
};
constexpr Beginning beginnings[] = {
    {"Kaydara FBX Binary", "an FBX file", by_blender},
    {"; FBX", "an FBX file", by_blender},
    {"BLENDER", "a file of Blender's", "Blender exports it as glTF (.glb)"},
    {"PXR-USDC", "a USD file", by_blender},
    {"#usda", "a USD file", by_blender},
    {"#VRML", "a VRML file", by_blender},
    {"ISO-10303-21", "a STEP file", by_cad},
    {"3D Geometry File Format", "a file of Rhino's", "Rhino exports it as OBJ"},
    {"# vtk DataFile", "a VTK file", "ParaView imports it and exports PLY"},
    {"# .PCD", "a cloud of points", no_surface},
    {"DRACO", "a mesh compressed by Draco", "draco_decoder makes an OBJ or PLY file of it"},
    {"\x1F\x8B", "a compressed file", unpack},
    {"BZh", "a compressed file", unpack},
    {"\xFD"
     "7zXZ",
     "a compressed file", unpack},
    {"\x28\xB5\x2F\xFD", "a compressed file", unpack},
    {"\xFF\xD8\xFF", "a picture (JPEG)", "a surface wears it by a file of materials (map_Kd) or a glTF file"}};

bool begins_with_line(std::string_view bytes, std::string_view word) {
  return bytes.starts_with(word) && bytes.size() > word.size() && (bytes[word.size()] == '\n' || bytes[word.size()] == '\r');
}

}  // namespace

std::optional<OtherFormat> other_format_of(const std::string& path) {
  const std::string suffix = suffix_of(path);
  const auto* const found = std::find_if(std::begin(suffixes), std::end(suffixes), [&](const Suffix& one) { return one.suffix == suffix; });
  if (found == std::end(suffixes)) return std::nullopt;
  return OtherFormat{found->what, found->way};
}

std::optional<OtherFormat> other_format_in(std::string_view bytes) {
  for (const Beginning& one : beginnings)
    if (bytes.starts_with(one.bytes)) return OtherFormat{one.what, one.way};
  const std::string_view start = bytes.substr(0, 1000);
  if (start.find("<COLLADA") != std::string_view::npos) return OtherFormat{"a Collada file", by_blender};
  if (start.find("<X3D") != std::string_view::npos) return OtherFormat{"an X3D file", by_blender};
  for (const char* word : {"OFF", "COFF", "NOFF", "STOFF"})
    if (begins_with_line(bytes, word)) return OtherFormat{"an OFF file", by_meshlab};
  if (bytes.size() >= 6 && bytes.starts_with("MM") && base::read_bytes_as<std::uint32_t>(bytes.data() + 2) == bytes.size())
    return OtherFormat{"a 3DS file", by_meshlab};
  // Of UTF-16 without a mark every other byte of what is ASCII is 0.
  const auto zeros_at = [&](std::size_t from) {
    for (std::size_t i = from; i < 16; i += 2)
      if (bytes[i] != '\0' || bytes[i ^ 1U] == '\0') return false;
    return true;
  };
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF") || (bytes.size() >= 16 && (zeros_at(0) || zeros_at(1))))
    return OtherFormat{"text in UTF-16", "save it as UTF-8, as `iconv -f UTF-16 -t UTF-8` does"};
  return std::nullopt;
}

}  // namespace tofray::mesh
