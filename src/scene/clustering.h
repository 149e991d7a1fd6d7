// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "scene/derive.h"

namespace tofray::scene {

/// One shape's bodies sorted into clusters, and where these are seen, and are.
template <class T>
struct ClusterMemory {
  std::vector<std::int32_t> bodies;  ///< then their ranks and their order, as of Clusters
  std::vector<ManyBounds> bodies_seen, clusters_seen, bodies_along, clusters_along;
  std::vector<ManyBoxes> bodies_around, clusters_around;
};

/// The clusters of a group. Bodies of the same cluster are near each other when they are built; whether they stay so decides how much is
/// left out later, not what is seen.
class Clustering {
 public:
  Clustering() = default;
  Clustering(const Clustering&) = delete;
  Clustering& operator=(const Clustering&) = delete;

  /// Sorts the bodies by where they are in the first moment, and makes room; the group gets its pointers. Shapes of few bodies, or without
  /// an end, have no clusters.
  /// @param group    of the scene
  /// @param moments  that it has forms for
  void build(const SceneView& scene, Group& group, int moments);
  /// Takes the rectangles out of the forms and, where light bounces, the boxes out of the shapes; and sorts the bodies by depth.
  void update(const SceneView& scene, const Group& group);

 private:
  shape::ByShape<ClusterMemory> memory_;
};

}  // namespace tofray::scene
