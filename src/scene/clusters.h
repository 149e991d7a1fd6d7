// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "flow/flow.h"

/// Bodies that are near each other, 32 to a cluster, and the rectangles in which they are seen: whoever asks which of many bodies a bundle
/// of rays can meet looks at 32 clusters at once, and then at the 32 bodies of those that are left.
namespace tofray::scene {

constexpr int cluster_size = 32;

/// Rectangles side by side, and from which depth on something is in them. One that overlaps nothing begins at infinity.
struct alignas(64) ManyBounds {
  float x_min[cluster_size], x_max[cluster_size], y_min[cluster_size], y_max[cluster_size];
  float near[cluster_size];  ///< as shape::begins_at
};

/// Boxes side by side. One that holds nothing is a point that no ray comes to.
struct alignas(64) ManyBoxes {
  float low[3][cluster_size], high[3][cluster_size];
};

/// One shape's clusters in space, for rays that leave from anywhere.
struct Boxes {
  const std::int32_t* bodies;    ///< [cluster][32] numbers; −1: none
  const ManyBoxes* of_bodies;    ///< [cluster]
  const ManyBoxes* of_clusters;  ///< [cluster/32]
  std::int32_t count;            ///< of clusters; 0: each body is looked at
};

/// One shape's clusters as seen from one point, or along parallel light.
struct Clusters {
  const std::int32_t* bodies;     ///< [cluster][32] numbers, −1: none; then the ranks and the order
  const ManyBounds* of_bodies;    ///< [cluster]
  const ManyBounds* of_clusters;  ///< [cluster/32], then of these, [cluster/1024]
  std::int32_t count;             ///< of clusters; 0: there are so few bodies that each is looked at

  /// What holds 32 clusters each.
  TOFRAY_INLINE const ManyBounds* of_groups() const { return of_clusters + (count + cluster_size - 1) / cluster_size; }
  /// [cluster][32] what place each of them has where they are sorted by how near the camera they begin
  TOFRAY_INLINE const std::int32_t* ranks() const { return bodies + count * cluster_size; }
  /// [rank] … and which one, 32·cluster + i, has that place
  TOFRAY_INLINE const std::int32_t* order() const { return bodies + 2 * count * cluster_size; }
};

/// All of them.
template <class T>
struct ClustersOf {
  const std::int32_t* bodies;
  const ManyBounds *bodies_seen, *clusters_seen;     ///< [moment][eye][…] as forms are
  const ManyBounds *bodies_along, *clusters_along;   ///< [moment][…]
  const ManyBoxes *bodies_around, *clusters_around;  ///< [moment][…] where light bounces
  std::int32_t count;
  std::int32_t upper;  ///< rectangles for each view in clusters_seen and clusters_along: of clusters, by 32, and of 32 of these groups each

  TOFRAY_INLINE Clusters seen_from(int row) const { return {bodies, bodies_seen + row * count, clusters_seen + row * upper, count}; }
  TOFRAY_INLINE Clusters seen_along(int row) const { return {bodies, bodies_along + row * count, clusters_along + row * upper, count}; }
  TOFRAY_INLINE Boxes around(int moment) const {
    return {bodies, bodies_around + moment * count, clusters_around + moment * groups(), bodies_around == nullptr ? 0 : count};
  }
  /// How often 32 clusters are looked at.
  TOFRAY_INLINE int groups() const { return (count + cluster_size - 1) / cluster_size; }
  bool operator==(const ClustersOf&) const = default;
};

}  // namespace tofray::scene
