// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "base/faults.h"
#include "tofray/scene.h"

namespace tofray::assets {

/// What triangles without a material are called.
inline constexpr const char* no_material = "no material";

/// A material of a mesh's file, as a scene has them.
struct FileMaterial {
  enum class From {
    nothing,         ///< the triangles have none
    colourless,      ///< they name one of which nothing is known
    file,            ///< the file says it of near-infrared light
    visible_colour,  ///< a guess
  };
  std::string name;  ///< or its place among the file's
  Material material{"", Material::Brdf::lambert, 0.5};
  From from = From::nothing;
  bool mean_finish = false;    ///< its metal and roughness are means of a picture
  bool varying_color = false;  ///< its vertices have several colours, which its mesh has as shades
  bool mean_color = false;     ///< its vertices have several colours, of which the mean is used, since it is metal
  bool lost_normals = false;   ///< it has a picture of normals that cannot be used
  bool lets_through = false;   ///< it would let light through in part, and is a surface or none
  bool lost_alpha = false;     ///< it would be cut out by what cannot be used: alphas of vertices, or a picture that lies nowhere
  bool nowhere = false;        ///< it is cut out everywhere
};

/// Sentences: what is guessed of these materials, each once.
std::vector<std::string> notices_of(const std::vector<const FileMaterial*>& materials);

/// What one object shows of a mesh's file: all of it, or the triangles of one material.
struct MeshPiece {
  TriangleMesh mesh;  ///< vertices, and normals and texture coordinates where the file has any
  std::size_t left_out = 0;
  FileMaterial of = {};
  bool by_material = false;                       ///< the triangles of one material of a glTF file
  int number = -1;                                ///< the material of these triangles; −1: those without a material
  std::shared_ptr<const MeshMotion> motion = {};  ///< in the file's own axes and unit
};

/// Adds the pixels of a material's pictures to those that the meshes of a scene wear. @throws Error as count_texels()
void count_pictures(const Material& material, const base::Place& place, std::size_t& texels);

/// Adds a picture's pixels to those that the meshes of a scene wear. @throws Error (limit) beyond limit::map_pixels
void count_texels(int width, int height, const base::Place& place, std::size_t& texels);

/// What a listing may show of a material's name, which a stranger gave.
std::string shown_name(const std::string& name);

}  // namespace tofray::assets
