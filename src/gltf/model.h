// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gltf/matrix.h"
#include "tofray/scene.h"

/// What a glTF 2.0 file holds, checked: each index is one of something that is there, or `none`.
/// Right-handed, y up, metres, seconds, radians.
namespace tofray::gltf {

inline constexpr int none = -1;

/// Numbers of an accessor; who uses the same accessor shares them.
using Floats = std::shared_ptr<const std::vector<float>>;
using Wholes = std::shared_ptr<const std::vector<std::uint32_t>>;

/// KHR_texture_transform: texture = offset + turn(rotation_rad) · (scale · coordinates).
struct TextureUse {
  int texture = none;
  int texcoord = 0;  ///< which set of the primitive: 0 or 1
  std::array<double, 2> offset{0, 0}, scale{1, 1};
  double rotation_rad = 0;
};

struct Material {
  enum class Alpha { opaque, mask, blend };
  std::string name;
  std::array<double, 4> base_color{1, 1, 1, 1};
  bool has_metallic_roughness = false;  ///< whether it says pbrMetallicRoughness at all
  double metallic = 1, roughness = 1;
  TextureUse base_color_texture, metallic_roughness_texture, normal_texture;
  double normal_scale = 1;
  Alpha alpha = Alpha::opaque;
  double alpha_cutoff = 0.5;
  bool double_sided = false;
  bool unlit = false;                       ///< KHR_materials_unlit
  double ior = 1.5;                         ///< KHR_materials_ior: at least 1, or 0: a mirror
  double specular = 1;                      ///< KHR_materials_specular: the factor
  std::optional<double> nir_reflectivity;   ///< of the material's extras
  std::optional<std::string> nir_material;  ///< name of a built-in material, in the material's extras
};

struct Texture {
  enum class Wrap { repeat, mirror, clamp };
  int image = none;
  Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
};

struct Image {
  std::string name, mime_type;  ///< "image/png", "image/jpeg", or empty where the file does not say
  std::string bytes;            ///< as encoded; only of images that a material's texture uses
};

/// What is added to a primitive's positions and normals, times a weight; null where there is nothing.
struct MorphTarget {
  Floats positions, normals;
};

/// Corners are vertices in the order of `indices`, or of the vertices themselves where that is null.
struct Primitive {
  enum class Mode { triangles, strip, fan };
  Mode mode = Mode::triangles;
  int material = none;
  Wholes indices;
  Floats positions, normals;        ///< three for each vertex; normals may be null
  std::array<Floats, 2> texcoords;  ///< two for each vertex, or null
  Floats colors;                    ///< color_width for each vertex, or null
  std::size_t color_width = 4;      ///< 3 or 4
  Wholes joints;                    ///< four for each vertex, or null: indices of a skin's joints
  Floats joint_weights;             ///< four for each vertex, or null: weights of the joints
  std::vector<MorphTarget> targets;

  [[nodiscard]] std::size_t vertices() const { return positions->size() / 3; }
  [[nodiscard]] std::size_t corners() const { return indices ? indices->size() : vertices(); }
  [[nodiscard]] std::size_t triangles() const { return mode == Mode::triangles ? corners() / 3 : corners() < 3 ? 0 : corners() - 2; }
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;  ///< those that have triangles
  std::vector<double> weights;        ///< one for each morph target, unless a node has its own
  bool has_joints = false;            ///< whether each primitive has
  std::uint32_t most_joint = 0;       ///< the largest that a vertex names
};

struct Camera {
  std::string name;
  bool perspective = true;
  double yfov_rad = 0;
  std::optional<double> aspect_ratio;  ///< of a perspective camera
  double xmag = 0, ymag = 0;           ///< of an orthographic one
  double znear_m = 0;
  std::optional<double> zfar_m;  ///< infinity where a perspective camera has none
};

struct Skin {
  std::string name;
  std::vector<int> joints;           ///< nodes
  std::vector<Matrix> inverse_bind;  ///< one for each joint
  int skeleton = none;               ///< a node
};

struct Node {
  std::string name;
  int parent = none;
  std::vector<int> children;
  int mesh = none, skin = none, camera = none;
  std::optional<Matrix> matrix;  ///< else translation, rotation and scale
  Vec3 translation{0, 0, 0}, scale{1, 1, 1};
  Quaternion rotation{0, 0, 0, 1};  ///< of unit length
  std::vector<double> weights;      ///< one for each morph target of its mesh, or none: those of the mesh
  /// EXT_mesh_gpu_instancing: where its mesh stands, each in the node's own frame; none: once, in that frame.
  std::optional<std::vector<Matrix>> instances;

  [[nodiscard]] std::size_t shown() const { return instances ? instances->size() : 1; }  ///< how often it shows its mesh
};

/// Values at keyframes; of a cubic spline three for each: in-tangent, value, out-tangent.
struct Channel {
  enum class Path { translation, rotation, scale, weights };
  enum class Interpolation { linear, step, cubic_spline };
  int node = none;
  Path path = Path::translation;
  Interpolation interpolation = Interpolation::linear;
  Floats times_s;         ///< finite, rising
  Floats values;          ///< finite; `width` for each value
  std::size_t width = 3;  ///< 3, of a rotation 4, of weights the number of targets
};

struct Animation {
  std::string name;
  std::vector<Channel> channels;
  double start_s = 0, end_s = 0;  ///< first and last keyframe of all
};

struct Scene {
  std::string name;
  std::vector<int> nodes;  ///< without parents
};

struct Model {
  std::vector<Scene> scenes;  ///< at least one
  int scene = 0;              ///< the default one
  std::vector<Node> nodes;
  std::vector<int> parents_first;  ///< all nodes in an order in which each stands behind its parent
  std::vector<Mesh> meshes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Image> images;
  std::vector<Camera> cameras;
  std::vector<Skin> skins;
  std::vector<Animation> animations;
  std::vector<std::string> notices;  ///< a sentence each: what was left out, or mended
};

}  // namespace tofray::gltf
