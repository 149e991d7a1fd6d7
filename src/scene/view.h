// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "brdf/list.h"
#include "brdf/reflectivity_map.h"
#include "scene/clusters.h"
#include "shape/list.h"

/// The scene as kernels see it: shapes once, in the world's frame, and what is derived from them for each point that rays leave.
namespace tofray::scene {

using shape::Bounds;
using shape::Facet;

/// A shape in the world, where it stands or before it moves, and what its hits name.
template <class T>
struct Body {
  T shape;
  std::int32_t mover;  ///< its row of SceneView::frames; −1: it stands still
  std::int32_t facet;  ///< the first of its facets, counted within its group
  std::int32_t object, material;
};

/// Bodies of a shape; where some change theirs, as they are at each moment.
template <class T>
struct BodiesOf {
  const Body<T>* first;
  std::int32_t count, per_moment;  ///< per_moment: `count`, or 0 where they are the same at all of them
  TOFRAY_INLINE const Body<T>& at(int moment, int i) const { return first[moment * per_moment + i]; }
  bool operator==(const BodiesOf&) const = default;
};
template <class T>
struct FormsOf {
  const typename T::Form* at;
  std::int32_t count;
  Clusters clusters = {};
};
template <class T>
struct AlongsOf {
  const typename T::Along* at;
  std::int32_t count;
  Clusters clusters = {};
};

using Bodies = shape::ByShape<BodiesOf>;
/// One group seen from one point: the camera or a light.
using Forms = shape::ByShape<FormsOf>;
/// One group as parallel light sees it.
using Alongs = shape::ByShape<AlongsOf>;

/// Where a group's forms are.
template <class T>
struct DerivedOf {
  typename T::Form* forms;   ///< [moment][eye][body] eye 0: the camera; then the lights
  typename T::Along* along;  ///< [moment][body]
  typename T::Free* free;    ///< [moment][body] where light bounces
  bool operator==(const DerivedOf&) const = default;
};

/// Objects that stand still (one moment), or that move (a moment for each raw frame).
struct Group {
  Bodies bodies;
  shape::ByShape<DerivedOf> derived;
  shape::ByShape<ClustersOf> clusters;
  std::int32_t body_count, facet_count;

  /// One shape's forms as an eye sees them, or as parallel light does.
  /// @param row  moment·eyes + eye, or moment
  template <class T>
  TOFRAY_INLINE FormsOf<T> seen_from(int row) const {
    const int count = bodies.of<T>().count;
    return {derived.of<T>().forms + row * count, count, clusters.of<T>().seen_from(row)};
  }
  template <class T>
  TOFRAY_INLINE AlongsOf<T> seen_along(int row) const {
    const int count = bodies.of<T>().count;
    return {derived.of<T>().along + row * count, count, clusters.of<T>().seen_along(row)};
  }
  TOFRAY_INLINE Forms seen_from(int moment, int eye, int eyes) const { return seen_from(shape::Shapes{}, moment * eyes + eye); }
  TOFRAY_INLINE Alongs seen_along(int moment) const { return seen_along(shape::Shapes{}, moment); }
  bool operator==(const Group&) const = default;

 private:
  template <class... T>
  TOFRAY_INLINE Forms seen_from(shape::List<T...>, int row) const {
    Forms out;
    ((out.of<T>() = seen_from<T>(row)), ...);
    return out;
  }
  template <class... T>
  TOFRAY_INLINE Alongs seen_along(shape::List<T...>, int row) const {
    Alongs out;
    ((out.of<T>() = seen_along<T>(row)), ...);
    return out;
  }
};

/// How the points of an object move in the camera's frame at the time of the truth: with velocity + spin × P; one frame later they are at
/// P + step + turn·P.
struct MotionView {
  float velocity[3], spin[3];  ///< [m/s], [rad/s]
  float step[3], turn[9];      ///< [m]; rows, of the rotation without the identity
};
constexpr int motion_numbers = sizeof(MotionView) / sizeof(float);

/// Share of its distance by which a position may be elsewhere: some 32 roundings in single precision.
constexpr double position_error = 2e-6;

/// The frozen scene of one frame.
struct SceneView {
  Group still, moving;
  Facet* facets;  ///< still ones, then those of moment 0, 1 …
  const brdf::MaterialView* materials;
  const brdf::MapView* maps;
  const shape::Vec* light_positions;     ///< [light] camera frame [m]
  const MotionView* motions;             ///< [0] of what stands still, then [1 + mover]
  const MotionView* to_truth;            ///< [moment][as motions] step and turn from there to the time of the truth; null: not asked for
  const std::int32_t* motion_of;         ///< [object] its row of `motions`
  const std::int32_t* class_of;          ///< [object] number of its class; −1: none
  const shape::CoordinateFrame* frames;  ///< [moment][mover] the camera's, as what moves sees it: as if the camera moved the other way
  const shape::Vec* toward_sun;          ///< [moment] unit vector, camera frame; one at least
  const float* sun_directions;           ///< [moment][3] the same
  shape::CoordinateFrame camera;         ///< where the camera stands, if it does
  std::int32_t moments;                  ///< 0: nothing moves; else those of all raw frames, as many for each
  std::int32_t movers;
  std::int32_t lights;
  std::int32_t has_sun;  ///< light comes from one direction, too
  std::int32_t material_count;
  std::int32_t map_count;
  std::int32_t object_count;  ///< of `motion_of`; one at least
  std::int32_t any_details;   ///< of meshes
  float roughness;            ///< how well positions are known at all, by lights that are far away and meshes that are large [m]
  std::int32_t bounces;       ///< light goes from surface to surface, too: rays leave from anywhere

  TOFRAY_INLINE Forms camera_still() const { return still.seen_from(0, 0, 1 + lights); }
  TOFRAY_INLINE Forms camera_moving(int moment) const { return moving.seen_from(moment, 0, 1 + lights); }
  TOFRAY_INLINE Forms light_still(int light) const { return still.seen_from(0, 1 + light, 1 + lights); }
  TOFRAY_INLINE Forms light_moving(int moment, int light) const { return moving.seen_from(moment, 1 + light, 1 + lights); }
  /// Of a group's forms those that a light sees at a moment, 0 of what stands still.
  TOFRAY_INLINE int row_of_light(int moment, int light) const { return moment * (1 + lights) + 1 + light; }
  TOFRAY_INLINE Alongs sun_still() const { return still.seen_along(0); }
  TOFRAY_INLINE Alongs sun_moving(int moment) const { return moving.seen_along(moment); }
  TOFRAY_INLINE const float* sun(int moment) const { return sun_directions + 3 * moment; }
  bool operator==(const SceneView&) const = default;
};

}  // namespace tofray::scene
