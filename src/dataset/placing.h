// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tofray/dataset.h"
#include "tofray/scene.h"
#include "yaml/tree.h"

/// Objects that are put where they have room: `scatter` of a set's file.
namespace tofray::dataset {

/// One `scatter`, its values drawn.
struct Scatter {
  enum class Unplaced : std::uint8_t { drop, again, fail };
  std::string path;                  ///< "objects/clutter"
  base::Place place;                 ///< in the set's file
  std::size_t first = 0, count = 0;  ///< its objects in the scene's list
  std::string surface;               ///< name of the object that they lie on; empty: they float
  std::vector<double> box;           ///< where they float [m]: low x, y, z, high x, y, z; empty: in what the camera sees
  double near_m = 0, far_m = 0;      ///< z of the camera from which to which they float, in what the camera sees
  double within_m = 0;               ///< from the middle of the surface; 0: all of it
  double gap_m = 0;
  int tries = 100;
  Unplaced unplaced = Unplaced::drop;
  std::vector<double> turns_rad;  ///< of each object, about the surface's normal, or about what is up
};

/// Thrown where an object finds no room and the whole sample is to be drawn again.
struct NoRoom {
  base::Place place;
};

/// `look` of a camera's pose, its values drawn: where it looks at, and from where.
struct Look {
  base::Place place;
  std::string at_name;       ///< an object, or a scatter; empty: a point
  std::vector<double> at_m;  ///< the point
  double radius_m = 0, elevation_rad = 0, azimuth_rad = 0, roll_rad = 0;
};
/// A try at it.
using LookDraw = std::function<Look(int attempt)>;

/// Whether an object is of that name, or one of the scatter of that name.
inline bool is_called(const std::string& object, const std::string& name) { return object == name || object.starts_with(name + "["); }

/// A uniform number of [0, 1) for each path.
using Chance = std::function<double(const std::string& path)>;

/// Puts the objects of all scatters, in order, where they overlap nothing that stands or was put before them: position and rotation of each
/// are written into the scene's tree, and those that find no room are taken out of it.
///
/// An object stands on a surface with its lowest point, exactly; what is told apart are boxes along each object's own axes, by separating
/// axes (Gottschalk et al. 1996), so that two of them may be farther apart than they look, never nearer than `gap`. All of it is + − × ÷ √
/// and num/setup_math.h.
///
/// @param scene  what `tree` says, read: scattered objects stand about their own zero in it
/// @param camera_stands  whether the camera's pose is known: otherwise things are put on the side of endless planes on which their place is
/// @return what was drawn: of each object its place, or that there is none
/// @throws Error (bad_input) where a surface is none, or an object has to be put and cannot; NoRoom
std::vector<Drawn> place_objects(const Scene& scene, const std::vector<Scatter>& scatters, const Chance& chance, bool camera_stands,
                                 yaml::Node& tree);

/// Puts the camera where it looks at a thing from, with nothing within `clear_m` of it: the first of some tries that finds such a place becomes the tree's `camera.pose`.
///
/// The camera is `radius` away from the middle of what it looks at, `elevation` above the horizon (about what is up), and `azimuth` about what is up from the direction of the
/// world's z axis, or of its x axis where z is up; what is up in the image is what is up in the world, turned by `roll`.
///
/// @param scene  what `tree` says, read, after its objects were put
/// @throws Error (bad_input) where there is no such object, or no place
Drawn place_camera(const Scene& scene, const LookDraw& draw, double clear_m, int tries, yaml::Node& tree);

}  // namespace tofray::dataset
