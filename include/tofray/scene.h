// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// What the user describes: objects, materials, ambient light and where the camera stands.
///
/// World frame: right-handed, metres. SI units throughout; a member's name ends in its unit where it is not metres.
namespace tofray {

using Vec3 = std::array<double, 3>;

/// A rotation as x, y, z and w, the scalar part last: cos(angle/2) is w, the axis of unit length times sin(angle/2) the others. q and −q are the
/// same rotation. Where a struct holds one, its length may be 1e-3 from 1.
using Quaternion = std::array<double, 4>;

/// A picture of how much a surface sends back: 1 where it is its material's `diffuse`, 0 where it is black. Meshes show it where their
/// vertices have texture coordinates.
struct ReflectivityMap {
  enum class Wrap { repeat, mirror, clamp };
  int width = 0, height = 0;
  std::vector<float> values;  ///< [height][width], 0…1; (u, v) = (0, 0) is the corner of the first, v grows with the rows
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;  ///< beyond 0…1
};

/// A picture of three numbers, which its user gives a meaning. Otherwise as a ReflectivityMap.
struct VectorMap {
  int width = 0, height = 0;
  std::vector<std::array<float, 3>> values;                                                              ///< [height][width]
  ReflectivityMap::Wrap wrap_u = ReflectivityMap::Wrap::repeat, wrap_v = ReflectivityMap::Wrap::repeat;  ///< beyond 0…1
};

/// How a surface sends light back, at the illumination wavelength.
struct Material {
  enum class Brdf { lambert, phong, oren_nayar, ggx, retro };
  std::string name;  ///< empty for a material written inside an object
  Brdf brdf = Brdf::lambert;
  double diffuse = 0.0;        ///< k_d, 0…1: Lambertian reflectivity (Lambert, Oren–Nayar: the reflectivity rho; GGX: its ground's)
  double specular = 0.0;       ///< Phong: k_s, the lobe's share, k_d + k_s <= 1; GGX: F_0, of one of its mirrors at normal incidence
  double exponent = 1.0;       ///< n >= 1: the Phong lobe's exponent
  double roughness_rad = 0.0;  ///< σ, 0…π/2: Oren–Nayar's spread of the slopes of a matt surface's facets
  double alpha = 0.5;          ///< α, 0.001…1: GGX's spread of the slopes of small mirrors (glTF's roughness squared)
  double retro = 0.0;          ///< k_r, 0…1 with k_d + k_r <= 1: the share that a retro-reflector sends back toward the light
  double spread_rad = 0.01;    ///< σ, 1e-3…π/4: angle between light and camera at which half of the retro-reflector's peak is left
  std::shared_ptr<const ReflectivityMap> map = {};  ///< scales `diffuse` from place to place; none: it is the same everywhere
  /// How a mesh's normal leans from place to place: its parts along growing u, against growing v, and along the normal that the mesh has,
  /// −1…1, the last one above 0, of length 0.5…1.5. None: it does not.
  std::shared_ptr<const VectorMap> normals = {};
  /// GGX, of a mesh: k_d, F_0 and α from place to place, in place of `diffuse`, `specular` and `alpha`, which then are a mean for
  /// callers; `map` scales k_d, too. None: they are the same everywhere.
  std::shared_ptr<const VectorMap> finish = {};
  /// Where a mesh has a surface at all: where this is ½ or more, between texels bilinear; light and camera look through the rest. Texels of the
  /// other pictures that lie where it is less count in no mean. None: everywhere.
  std::shared_ptr<const ReflectivityMap> opacity = {};
};

struct Plane {
  Vec3 point{};
  Vec3 normal{0, 0, -1};
};  ///< infinite; the normal need not be of unit length
/// A ball's surface.
struct Sphere {
  Vec3 center{};
  double radius = 1;
};
struct Box {
  Vec3 min{};
  Vec3 max{};
};  ///< along the axes before its rotation
/// Flat, between its corners; both sides reflect.
struct Triangle {
  std::array<Vec3, 3> vertices{};
};
struct Cylinder {
  Vec3 center{};
  Vec3 axis{0, 1, 0};
  double radius = 1;
  double height = 1;
};  ///< with caps; the axis need not be of unit length
struct Rectangle {
  Vec3 center{};
  std::array<double, 2> size{1, 1};  ///< along x and y before its rotation
};                                   ///< flat, in the x-y plane before its rotation
struct Disk {
  Vec3 center{};
  Vec3 normal{0, 0, -1};
  double radius = 1;
};  ///< flat; the normal need not be of unit length
struct Capsule {
  Vec3 start{};
  Vec3 end{0, 1, 0};
  double radius = 1;
};  ///< all points within `radius` of the line between its two points, which differ
struct Cone {
  Vec3 base{};
  Vec3 axis{0, -1, 0};
  double radius = 1;
  double height = 1;
};  ///< with a base, whose middle is `base`; the axis, which need not be of unit length, goes from there to the tip

/// Triangles that share vertices, both sides of which reflect.
struct TriangleMesh {
  std::vector<std::array<float, 3>> vertices;          ///< [m], in the mesh's own frame
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< three indices of `vertices` each
  /// Of unit length, outward or inward, 0 where there is none: light and camera see the mean of a triangle's three. Empty, or one for each
  /// vertex.
  std::vector<std::array<float, 3>> normals = {};
  std::vector<std::array<float, 2>> texcoords = {};  ///< (u, v) in the material's map. Empty, or one for each vertex
  std::vector<float> shades = {};  ///< 0…1: scale the material's matt part, as its map does. Empty, or one for each vertex
};

/// How a mesh changes its shape with time, in its own frame.
class MeshMotion {
 public:
  MeshMotion() = default;
  MeshMotion(const MeshMotion&) = delete;
  MeshMotion& operator=(const MeshMotion&) = delete;
  virtual ~MeshMotion() = default;
  /// The mesh's vertices at a time, and its normals where it has any, in place of what the vectors hold: as many as Mesh::triangles has, in
  /// the same order. The triangles stay, and their texture coordinates. One thread at a time calls it, of each simulator.
  virtual void at(double time_s, std::vector<std::array<float, 3>>& vertices, std::vector<std::array<float, 3>>& normals) const = 0;
};

/// Many triangles, about the zero of their own frame. In files: those of an OBJ, PLY, STL or glTF file, turned and scaled when it is read;
/// of a glTF or OBJ file those of one material, unless the object has a material of its own.
struct Mesh {
  enum class Up { automatic, y, z, minus_y, none };
  enum class Play { still, once, loop };
  std::string file;              ///< empty if built in code
  double scale = 1;              ///< scale from the file's numbers to metres
  Up up = Up::automatic;         ///< the file's axis that is up, turned to Scene::world_up; automatic: y in OBJ and glTF, z in PLY and STL;
                                 ///< none: the file's axes are the world's
  std::string animation;         ///< animation of a glTF file: a name, a number from 0 on, or "all" at once; empty: the first
  std::optional<double> time_s;  ///< time of that animation; none: the file's rest pose
  Play play = Play::still;       ///< whether that animation plays, from `time_s` (or its start) at t = 0
  std::string sha256;  ///< SHA-256 of the file's bytes and those of the files that it names, as hexadecimal digits; empty if built in code
  int left_out = 0;    ///< triangles of the file with a corner that is no finite number, or beyond 1e5 m
  int guessed = 0;     ///< materials of the file whose visible colour stands for their reflectivity
  std::vector<std::string> notices;               ///< sentences: what else of the file is left out, or mended
  std::shared_ptr<const TriangleMesh> triangles;  ///< the triangles, turned and scaled already; objects may share them
  std::shared_ptr<const MeshMotion> motion;       ///< motion of the vertices; none: the mesh keeps its shape
};

/// A turn by the right-hand rule about `axis` (any length but zero).
struct Rotation {
  Vec3 axis{0, 0, 1};
  double angle_rad = 0;
  std::optional<Quaternion> quaternion = {};  ///< rotation in place of axis and angle: x, y, z, w
};

/// Where an object is at a time. Between two of them its shift changes evenly, and it turns evenly: where both rotations are about the same
/// axis from the one angle to the other, however far that is, else the shortest way. Before the first and after the last it stands still.
struct Keyframe {
  double time_s = 0;
  Vec3 position{0, 0, 0};  ///< shift [m], as Object::position
  Rotation rotation{};
};

/// One thing in the scene. Order of operations: rotation about its own centre (sphere, box, cylinder, rectangle, disk: the centre;
/// triangle: the centroid; capsule: halfway between its points; plane: its point; cone: the middle of its base; mesh: its zero), then the
/// shift `position`; then, both with time, a turn about the centre and a shift: by angular velocity · t and velocity · t.
struct Object {
  std::string name;
  std::variant<Plane, Sphere, Box, Triangle, Cylinder, Rectangle, Disk, Capsule, Cone, Mesh> shape;
  int material = 0;        ///< index in Scene::materials
  Vec3 position{0, 0, 0};  ///< shift [m]
  Rotation rotation{};
  Vec3 velocity_m_per_s{0, 0, 0};
  Vec3 angular_velocity_rad_per_s{0, 0, 0};  ///< its axis, in the world, times how fast it turns by the right-hand rule
  std::vector<Keyframe> keyframes = {};      ///< poses in place of position, rotation and both velocities; ascending in time
  std::string class_name = {};               ///< class of the object, for Truth::class_id; empty: none
  std::string key = {};                      ///< address in its file, e.g. "objects.2"; empty if built in code
  std::string where = {};                    ///< file:line:col for messages; empty if built in code
};

/// Ambient light: all but the camera's illumination. One of level, illuminance and band irradiance says how much.
struct Ambient {
  enum class Spectrum { none, sun_am15, equal_energy, table };
  enum class Quantity {
    level,                     ///< 1 = the spectrum as it is tabulated (sun_am15: the global standard sun, 1000 W/m2 in all)
    illuminance_lx,            ///< photometric, through the CIE photopic curve
    band_irradiance_w_per_m2,  ///< E_B itself: the irradiance within the camera's filter
  };
  Spectrum spectrum = Spectrum::none;
  Quantity quantity = Quantity::level;
  double amount = 0;                              ///< amount in the quantity's unit
  std::vector<double> table_wavelength_m;         ///< spectrum `table`: ascending
  std::vector<double> table_irradiance_w_per_m3;  ///< spectral irradiance per metre of wavelength (1 W m-2 nm-1 = 1e9 W m-3)
  std::optional<Vec3> direction;                  ///< direction in which the light travels (a sun); none: uniform from everywhere
};

/// Light by the length of its path, as histograms (Truth::transient_e_per_s): bin k is centred at first + (k + ½)·width. Light of a path is
/// shared between the two bins whose centres are nearest.
struct TransientBins {
  int bins = 0;           ///< 0…1e6; 0: there are no histograms
  double first_m = 0;     ///< 0…1e6: path length at which the first bin begins, from the light by all surfaces to the camera
  double width_m = 1e-3;  ///< 1e-6…1e6: width of a bin in path length
};

/// Multipath: light that meets 1, 2 … 1 + bounces surfaces before it reaches the camera. Light paths are Monte Carlo samples, the same for
/// all frames: their error is no noise of the camera. Arrays in place of the scene bounce nothing.
struct Transport {
  int bounces = 0;              ///< 0…64: maximum number of bounces, surfaces beyond the first one; 0: no multipath
  int samples = 16;             ///< 1…65536: light paths per pixel (Monte Carlo samples); an odd number is rounded up
  unsigned long long seed = 0;  ///< seed of the light paths: another one draws other paths of the same light
  int max_samples = 0;          ///< most light paths per pixel: their number is doubled until path_noise_m is reached; 0: samples
  double path_noise_m = 0;      ///< standard error of the half path at which a pixel has enough paths; 0: a fifth of its depth noise
  bool smooth = false;          ///< whether light that bounces is smoothed over neighbours that see the same surface
  TransientBins transient = {};
};

/// Where the camera stands. Camera frame: x right, y down, z forward (the optical frame of ROS and OpenCV).
struct Pose {
  Vec3 position{0, 0, 0};
  Vec3 look_at{0, 0, 1};                      ///< a point on the optical axis
  Vec3 up{0, -1, 0};                          ///< direction in the world that is up in the image
  std::optional<Quaternion> quaternion = {};  ///< rotation from camera to world, as x, y, z, w; in place of look_at and up
};

/// Where the camera stands at a time. Between two of them its position changes evenly. Where one has a quaternion it turns evenly, the
/// shortest way; else look_at and up change evenly: a camera that looks at one point goes on doing so. Before the first and after the last
/// it stands still.
struct CameraKeyframe {
  double time_s = 0;
  Pose pose;
};

/// A key of the profile that the scene changes: dotted path and the text of the value, e.g. {"lens.f_number", "1.2"} or
/// {"integration_time", "500 us"}.
struct Override {
  std::string key;
  std::string value;
  std::string where = {};  ///< file:line:col for messages; empty if built in code
};

/// The scene's `camera` section: which profile and mode to take, and what to change in it.
struct CameraChoice {
  std::string profile = "pico-flexx";  ///< a built-in name or a file
  std::string mode;                    ///< empty: the profile's first
  Pose pose;
  std::vector<CameraKeyframe> keyframes = {};  ///< poses in place of the pose; ascending in time
  std::vector<Override> overrides = {};
  std::string profile_where, mode_where;  ///< file:line:col for messages; empty if built in code
};

/// A file that a scene was read from, beside its own and those of meshes.
struct SceneFile {
  std::string file;    ///< name in the scene
  std::string sha256;  ///< SHA-256 of its bytes, as hexadecimal digits
};

/// All that is seen, in which light, and which camera looks at it.
struct Scene {
  enum class Up { minus_y, y, z };
  std::string name;    ///< the file's stem, or a built-in name
  std::string source;  ///< the file it came from, empty if built in code
  CameraChoice camera;
  Ambient ambient;
  Transport transport = {};
  std::vector<Material> materials;
  std::vector<Object> objects;
  /// The world's axis that is up. In files, what is not said follows from it: where a camera looks, what is up in its image, how the axes of
  /// meshes are turned. In code nothing does.
  Up world_up = Up::minus_y;
  std::vector<SceneFile> files = {};  ///< files of keyframes
  /// Classes of objects: Truth::class_id counts them. Empty: those that objects have, by the order of their letters.
  std::vector<std::string> classes = {};
};

}  // namespace tofray
