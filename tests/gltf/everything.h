// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "gltf_files.h"

namespace tofray::gltf_test {

/// The accessors of everything_file(), by what they hold.
struct Everything {
  enum Accessor { positions, normals, coordinates, colors, joints, weights, indices, target, matrices, times, shifts, turns, morphs };
};

inline void add_mesh(File& file) {
  file.floats(corner_positions, "VEC3");
  file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  file.floats({0, 0, 1, 0, 0, 1}, "VEC2");
  file.accessor<std::uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 255}, "VEC3", true);
  file.accessor<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
  file.accessor<std::uint8_t>({128, 127, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}, "VEC4", true);
  file.accessor<std::uint8_t>({0, 1, 2}, "SCALAR");
  file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int sparse_indices = file.view(bytes_of<std::uint8_t>({2})), sparse_values = file.view(bytes_of<float>({3, 3, 3}));
  file.json["accessors"][Everything::target]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", sparse_indices}, {"byteOffset", 0}, {"componentType", 5121}}},
      {"values", {{"bufferView", sparse_values}, {"byteOffset", 0}}}};
  file.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1}, "MAT4");
  file.mesh({{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}, {"COLOR_0", 3}, {"JOINTS_0", 4}, {"WEIGHTS_0", 5}}, Everything::indices);
  file.primitive(0)["targets"] = Document::array({{{"POSITION", 7}}});
  file.primitive(0)["material"] = 0;
  file.primitive(0)["mode"] = 4;
  file.json["meshes"][0]["weights"] = {0.5};
  file.json["meshes"][0]["name"] = "m";
}

inline void add_material(File& file) {
  file.json["images"] = Document::array({{{"bufferView", file.view("\x89PNG\r\n\x1A\n")}, {"mimeType", "image/png"}}});
  file.json["samplers"] = Document::array({{{"wrapS", 33071}, {"wrapT", 33648}}});
  file.json["textures"] = Document::array({{{"source", 0}, {"sampler", 0}}});
  file.add("materials", {{"name", "wood"},
                         {"pbrMetallicRoughness",
                          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                           {"metallicFactor", 0.5},
                           {"roughnessFactor", 0.25},
                           {"baseColorTexture", {{"index", 0}, {"texCoord", 0}}},
                           {"metallicRoughnessTexture", {{"index", 0}}}}},
                         {"normalTexture",
                          {{"index", 0},
                           {"scale", 2},
                           {"extensions", {{"KHR_texture_transform", {{"offset", {0, 0}}, {"rotation", 0}, {"scale", {1, 1}}}}}}}},
                         {"emissiveFactor", {0, 0, 1}},
                         {"alphaMode", "MASK"},
                         {"alphaCutoff", 0.75},
                         {"doubleSided", true},
                         {"extensions", {{"KHR_materials_ior", {{"ior", 1.4}}}, {"KHR_materials_specular", {{"specularFactor", 0.5}}}}},
                         {"extras", {{"nir_reflectivity", 0.8}}}});
}

inline void add_animation(File& file) {
  file.floats({0, 1}, "SCALAR");
  file.floats({0, 0, 0, 0, 0, 2}, "VEC3");
  file.floats({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
  file.floats({0, 0, 0, 0, 1, 0}, "SCALAR");
  file.add("animations", {{"name", "walk"},
                          {"samplers",
                           {{{"input", Everything::times}, {"output", Everything::shifts}, {"interpolation", "STEP"}},
                            {{"input", Everything::times}, {"output", Everything::turns}},
                            {{"input", Everything::times}, {"output", Everything::morphs}, {"interpolation", "CUBICSPLINE"}}}},
                          {"channels",
                           {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}},
                            {{"sampler", 1}, {"target", {{"node", 2}, {"path", "rotation"}}}},
                            {{"sampler", 2}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
}

/// A file that has all that is read: each fault of the tests is one change of it.
inline File everything_file() {
  File file;
  add_mesh(file);
  add_material(file);
  add_animation(file);
  file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}, {"zfar", 10}, {"aspectRatio", 1.5}}}},
                          {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 7}}}}};
  file.json["skins"] = Document::array({{{"joints", {1, 2}}, {"inverseBindMatrices", Everything::matrices}, {"skeleton", 1}}});
  file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"weights", {0.25}}},
                        {{"children", {2}}, {"translation", {0, 0, 0}}, {"rotation", {0, 0, 0, 1}}, {"scale", {1, 1, 1}}},
                        {{"translation", {1, 0, 0}}},
                        {{"camera", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1}}}};
  file.json["scenes"] = Document::array({{{"nodes", {0, 1, 3}}, {"name", "s"}}});
  file.json["scene"] = 0;
  file.json["extensionsUsed"] = {"KHR_texture_transform"};
  return file;
}

}  // namespace tofray::gltf_test
