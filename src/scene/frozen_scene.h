// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <vector>

#include "base/vec.h"
#include "scene/forms.h"

/// The scene, frozen for rendering: everything in the camera frame, as seen from the camera and from each light.
namespace tofray::scene {

/// Rows: camera x, y, z axes in the world. camera = rotation · (world − position).
struct CameraFrame {
  base::Mat3 rotation;
  Vec3 position;
};
CameraFrame camera_frame(const Pose& pose);

/// Objects of one group (still, or moving at one time) in the camera frame, by kind, as plain numbers in double precision.
struct Placed {
  struct PlacedPlane { Vec3 normal; double offset; int object; };                    ///< n·P = offset
  struct PlacedSphere { Vec3 center; double radius; int object; };
  struct PlacedBox { Vec3 center; base::Mat3 axes; Vec3 half; int object; };         ///< axes: rows, in the camera frame
  struct PlacedTriangle { std::array<Vec3, 3> vertices; int object; };
  std::vector<PlacedPlane> planes;
  std::vector<PlacedSphere> spheres;
  std::vector<PlacedBox> boxes;
  std::vector<PlacedTriangle> triangles;
  [[nodiscard]] int facet_count() const;
};

/// Which objects to place.
enum class Group { still, moving };
Placed place(const Scene& scene, const CameraFrame& camera, Group group, double time_s);

/// Facets of the placed objects in the order planes, spheres, boxes (three each), triangles.
void append_facets(const Placed& placed, const Scene& scene, std::vector<Facet>& facets);

/// Forms of one group seen from one point; owns the arrays. `facet_base`: where the group's facets begin.
/// `camera_origin`: the camera is at the origin of the frame, `origin` is where the rays leave.
class View {
 public:
  View(const Placed& placed, const Vec3& origin, int facet_base);
  [[nodiscard]] Forms forms() const;

 private:
  std::vector<PlaneForm> planes_;
  std::vector<SphereForm> spheres_;
  std::vector<BoxForm> boxes_;
  std::vector<TriangleForm> triangles_;
};

/// Forms of one group for parallel light from the unit direction `toward_light` (camera frame); owns the arrays.
class ParallelView {
 public:
  ParallelView() = default;
  ParallelView(const Placed& placed, const Vec3& toward_light);
  [[nodiscard]] ParallelForms forms() const;

 private:
  std::vector<ParallelPlane> planes_;
  std::vector<ParallelSphere> spheres_;
  std::vector<ParallelBox> boxes_;
  std::vector<ParallelTriangle> triangles_;
};

/// All of a scene's views; update() moves what moves. view() stays valid until the next update().
class FrozenScene {
 public:
  /// @param lights     light positions, camera frame [m]
  /// @param slots      raw frames of a frame
  FrozenScene(const Scene& scene, const std::vector<Vec3>& lights, int slots);
  /// @param slot_times  time of each slot [s]
  void update(const std::vector<double>& slot_times);
  [[nodiscard]] const SceneView& view() const { return view_; }
  [[nodiscard]] bool moves() const { return moves_; }
  [[nodiscard]] const CameraFrame& camera() const { return camera_; }
  /// Unit vector toward a directional ambient light, camera frame; zero if there is none.
  [[nodiscard]] const Vec3& toward_sun() const { return toward_sun_; }

 private:
  void add_still();

  Scene scene_;
  std::vector<Vec3> lights_;
  CameraFrame camera_;
  Vec3 toward_sun_{0, 0, 0};
  bool moves_ = false;
  std::vector<View> still_views_, moving_views_;       // [camera, light 0, …] and [slot][camera, light 0, …]
  std::vector<ParallelView> sun_views_;                // still, then [slot]
  std::vector<Forms> light_still_, camera_moving_, light_moving_;
  std::vector<ParallelForms> sun_moving_;
  std::vector<Facet> facets_;
  std::size_t still_facets_ = 0;
  SceneView view_{};
};

}  // namespace tofray::scene
