// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "base/vec.h"
#include "scene/hierarchy.h"
#include "scene/map_levels.h"
#include "scene/view.h"

/// The scene, frozen for rendering: its shapes in the world, and everything in the camera frame as seen from the camera and from each light.
namespace tofray::scene {

/// Rows: camera x, y, z axes in the world. camera = rotation · (world − position).
struct CameraFrame {
  base::Mat3 rotation;
  Vec3 position;
};
CameraFrame camera_frame(const Pose& pose);

template <class T>
struct BodyList {
  std::vector<Body<T>> bodies;
};
using BodyLists = shape::ByShape<BodyList>;

/// A scene's bodies and, in memory of its own, all that is derived from them. It stands in one place: views point into it.
class FrozenScene {
 public:
  /// @param lights     light positions, camera frame [m]
  /// @param moments      raw frames of a frame
  FrozenScene(const Scene& scene, const std::vector<Vec3>& lights, int moments);
  FrozenScene(const FrozenScene&) = delete;
  FrozenScene& operator=(const FrozenScene&) = delete;

  /// Where the camera stands and when its raw frames are. Derives nothing.
  /// @param moment_times  time of each moment [s]
  void look(const Pose& pose, const std::vector<double>& moment_times);
  /// Forms and facets for the last look(), as far as they are not known.
  void derive();
  [[nodiscard]] const SceneView& view() const { return view_; }
  [[nodiscard]] bool moves() const { return moves_; }
  [[nodiscard]] const CameraFrame& camera() const { return camera_; }
  /// Unit vector toward a directional ambient light, camera frame; zero if there is none.
  [[nodiscard]] const Vec3& toward_sun() const { return toward_sun_; }

 private:
  void add_bodies(const Scene& scene);
  void add_materials(const std::vector<Material>& materials);
  /// The shape in the world.
  template <class T, class Said>
  T placed(const Said& said, const shape::Placement& at);
  void lay_out();

  std::optional<Vec3> sun_;  ///< in which its light travels, world
  CameraFrame camera_{};
  Vec3 toward_sun_{0, 0, 0};
  bool moves_ = false;
  BodyLists still_, moving_;
  std::map<std::shared_ptr<const TriangleMesh>, Hierarchy> hierarchies_;  ///< one for all objects that share the triangles
  std::map<std::shared_ptr<const ReflectivityMap>, int> map_numbers_;     ///< one for all materials that share it
  std::vector<std::unique_ptr<const MapLevels>> map_levels_;
  std::vector<brdf::MapView> maps_;
  std::vector<shape::Vec> lights_;
  std::vector<float> velocities_;
  std::vector<double> moment_times_;
  std::vector<brdf::MaterialView> materials_;
  std::unique_ptr<unsigned char[]> memory_;  ///< what is derived
  SceneView view_{};
  bool still_known_ = false, moving_known_ = false;
};

}  // namespace tofray::scene
