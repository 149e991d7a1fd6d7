// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "scene/clustering.h"
#include "scene/hierarchy.h"
#include "scene/map_levels.h"
#include "scene/motion.h"
#include "scene/vector_maps.h"
#include "scene/view.h"

/// The scene, frozen for rendering: its shapes in the world, and everything in the camera frame as seen from the camera and from each light.
namespace tofray::scene {

template <class T>
struct BodyList {
  std::vector<Body<T>> bodies;
};
using BodyLists = shape::ByShape<BodyList>;

/// When a frame looks at the scene.
struct Times {
  std::vector<double> moments;  ///< [s]
  std::size_t truth = 0;        ///< that of the ground truth
  double period_s = 0;          ///< from a frame to the next
  bool to_truth = false;        ///< how all moves from each moment to the truth is asked, too
  [[nodiscard]] double truth_s() const { return moments[truth]; }
  bool operator==(const Times&) const = default;
};

/// A scene's bodies and, in memory of its own, all that is derived from them. It stands in one place: views point into it.
class FrozenScene {
 public:
  /// @param lights     light positions, camera frame [m]
  /// @param moments    at which a frame looks at what moves
  /// @param scene      stays where it is
  /// @param bounces    rays leave from anywhere, too
  /// @param threads    that put boxes around large meshes; 0: one per core
  FrozenScene(const Scene& scene, const std::vector<Vec3>& lights, int moments, bool bounces = false, int threads = 0);
  FrozenScene(const FrozenScene&) = delete;
  FrozenScene& operator=(const FrozenScene&) = delete;

  /// Where all things are at the times of a frame. Derives nothing.
  /// @param pose  the camera stands there; none: where the scene has it at each time
  void look(const std::optional<Pose>& pose, const Times& times);
  /// Forgets what moves: the scene's keyframes have changed, and what has any still has.
  void forget_motion() { moving_known_ = false; }
  /// Forms and facets for the last look(), as far as they are not known.
  void derive();
  [[nodiscard]] const SceneView& view() const { return view_; }
  [[nodiscard]] bool moves() const { return moves_; }
  /// Unit vector toward a directional ambient light, camera frame, at the time of the truth; zero if there is none.
  [[nodiscard]] const Vec3& toward_sun() const { return toward_sun_; }

 private:
  /// What moves, or what the camera moves past.
  struct Mover {
    std::size_t object;
    Vec center;  ///< what it turns about, before it moves
  };
  /// A mesh that changes its shape.
  struct Changing {
    const TriangleMesh* mesh;
    const MeshMotion* motion;
    const Hierarchy* built;
    std::vector<Hierarchy> at;                            ///< [moment]
    std::vector<shape::MeshSteps> steps;                  ///< at the time of the truth
    std::vector<std::vector<shape::MeshSteps>> to_truth;  ///< [moment] where asked
  };
  struct ChangingBody {
    std::size_t body, object, which;  ///< among the moving meshes, the scene's objects, and `changing_`
  };
  void add_bodies(int moments, int threads);
  void add_changing(std::size_t object);
  void add_materials(const std::vector<Material>& materials);
  /// The first of what make() makes of a picture, once for all materials that share it and what of it is cut out.
  template <class Make>
  int number_of_maps(const void* map, const ReflectivityMap* opacity, const Make& make);
  void cut_out(const std::vector<int>& map_of_material);
  /// The shape in the world.
  template <class T, class Said>
  T placed(const Said& said, const shape::Placement& at, int threads);
  void lay_out();
  void look_for_sun(const CameraFrame& at_truth);
  void place_movers();
  void look_at_motion(const std::optional<Pose>& pose);
  void look_to_truth(const std::optional<Pose>& pose);
  void change_shapes();

  const Scene& scene_;
  std::vector<CameraFrame> cameras_;  ///< [moment]
  Times times_;
  bool posed_ = false;  ///< they stand where somebody asked for
  Vec3 toward_sun_{0, 0, 0};
  bool moves_ = false;
  std::vector<Mover> movers_;
  BodyLists still_, moving_;
  /// One for all objects that share the triangles.
  std::map<std::shared_ptr<const TriangleMesh>, std::shared_ptr<const Hierarchy>> hierarchies_;
  std::map<std::pair<const void*, const void*>, int> map_numbers_;  ///< one for all materials that share a picture
  Levels map_levels_;
  std::vector<brdf::MapView> maps_;
  std::vector<shape::Vec> lights_;
  std::vector<Changing> changing_;
  std::vector<ChangingBody> changing_bodies_;
  std::vector<MotionView> motions_, to_truth_;
  std::vector<std::int32_t> motion_of_, class_of_;
  std::vector<shape::CoordinateFrame> frames_;
  std::vector<Vec> toward_suns_;
  std::vector<float> sun_directions_;
  std::vector<brdf::MaterialView> materials_;
  std::unique_ptr<unsigned char[]> memory_;  ///< what is derived
  Clustering still_clusters_, moving_clusters_;
  SceneView view_{};
  bool still_known_ = false, moving_known_ = false;
};

}  // namespace tofray::scene
