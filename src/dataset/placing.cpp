// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dataset/placing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/faults.h"
#include "base/rotation.h"
#include "base/text.h"
#include "dataset/solids.h"
#include "num/setup_math.h"
#include "shape/list.h"
#include "tofray/load.h"
#include "tofray/simulator.h"

namespace tofray::dataset {

namespace {

using yaml::Node;

Node number_node(double value, const base::Place& place) {
  Node out;
  out.kind = Node::Kind::scalar, out.text = base::number_text(value + 0.0), out.place = place;
  return out;
}

template <class Numbers>
Node numbers_node(const Numbers& numbers, const base::Place& place) {
  Node out;
  out.kind = Node::Kind::list, out.place = place, out.height = 1;
  for (const double one : numbers) out.items.push_back(number_node(one, place));
  return out;
}

void set_key(Node& map, const std::string& key, Node value) {
  map.height = std::max(map.height, value.height + 1);
  if (Node* there = map.find(key)) return *there = std::move(value), void();
  map.keys.push_back({key, map.place});
  map.items.push_back(std::move(value));
}

Mat transposed(const Mat& m) {
  return {{{m.row[0].x, m.row[1].x, m.row[2].x}, {m.row[0].y, m.row[1].y, m.row[2].y}, {m.row[0].z, m.row[1].z, m.row[2].z}}};
}

Vec up_of(const Scene& scene) {
  switch (scene.world_up) {
    case Scene::Up::minus_y: return {0, -1, 0};
    case Scene::Up::y: return {0, 1, 0};
    case Scene::Up::z: return {0, 0, 1};
  }
  return {0, -1, 0};
}

/// An endless plane.
struct Wall {
  const Object* object;
  Vec point, normal;
};

class Placer {
 public:
  Placer(const Scene& scene, const std::vector<Scatter>& scatters, const Chance& chance, bool camera_stands, Node& tree)
      : scene_(scene), chance_(chance), objects_(*tree.find("objects")), up_(up_of(scene)) {
    scattered_.assign(scene.objects.size(), false);
    for (const Scatter& one : scatters)
      for (std::size_t i = one.first; i < one.first + one.count; ++i) scattered_[i] = true;
    if (camera_stands) eye_ = vec(scene.camera.keyframes.empty() ? scene.camera.pose.position : scene.camera.keyframes[0].pose.position);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      if (scattered_[i]) continue;
      const Object& object = scene.objects[i];
      if (const auto* plane = std::get_if<Plane>(&object.shape)) {
        const shape::Plane placed = shape::Plane::placed(*plane, shape::Placement{matrix_of(object.rotation), vec(object.position)});
        const Vec normal = shape::normalized(placed.normal);
        walls_.push_back({&object, placed.point, normal});
      } else if (const auto box = own_box(object)) {
        standing_.push_back({&object, solid_of(object, *box)});
      }
    }
  }

  void place(const Scatter& scatter) {
    std::optional<Surface> surface;
    const Object* under = nullptr;
    if (!scatter.surface.empty()) {
      std::vector<std::string> names;
      for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
        if (scattered_[i] || scene_.objects[i].name.empty()) continue;
        names.push_back(scene_.objects[i].name);
        if (names.back() == scatter.surface) under = &scene_.objects[i];
      }
      if (under == nullptr)
        base::fail(
            scatter.place,
            "there is no object " + base::in_quotes(scatter.surface) + " for things to lie on" + base::did_you_mean(scatter.surface, names),
            names.empty() ? "expected the name of one" : "the scene has " + base::listed(names, "and"));
      surface = surface_of(*under, up_);
      if (!surface)
        base::fail(scatter.place, base::in_quotes(scatter.surface) + " has no flat side for things to lie on",
                   "expected a plane, a rectangle, a disk or a box");
      if (surface->half_x == 0 && scatter.within_m == 0)
        base::fail(scatter.place, base::in_quotes(scatter.surface) + " has no end, and things would lie anywhere on it",
                   "expected `within: 1 m`, how far from the point of the plane");
    }
    for (std::size_t k = 0; k < scatter.count; ++k) put(scatter, k, surface ? &*surface : nullptr, under);
  }

  /// Takes out what found no room.
  void finish() {
    std::sort(left_out_.begin(), left_out_.end());
    for (auto one = left_out_.rbegin(); one != left_out_.rend(); ++one)
      objects_.items.erase(objects_.items.begin() + static_cast<std::ptrdiff_t>(*one));
  }

  std::vector<Drawn> drawn;

 private:
  struct Standing {
    const Object* object;
    Solid solid;
  };

  /// A point on the surface, evenly, whose distance from its ends is looked at afterwards.
  Vec point_on(const Surface& surface, const Scatter& scatter, const std::string& path) const {
    const double u = chance_(path + "[0]"), v = chance_(path + "[1]");
    if (surface.round || surface.half_x == 0 || scatter.within_m > 0) {
      const double radius = scatter.within_m > 0 ? scatter.within_m : surface.half_x;
      constexpr double two_pi = 6.283185307179586;
      const double r = radius * std::sqrt(u), turn = two_pi * v;
      return surface.middle + (r * num::setup::cos(turn)) * surface.x + (r * num::setup::sin(turn)) * surface.y;
    }
    return surface.middle + (surface.half_x * (2 * u - 1)) * surface.x + (surface.half_y * (2 * v - 1)) * surface.y;
  }

  /// Whether all that stands on it, its box's lower corners, is on the surface.
  static bool is_on(const Surface& surface, const Solid& solid) {
    if (surface.half_x == 0) return true;
    const Vec from = solid.center - surface.middle;
    const double u = shape::dot(from, surface.x), v = shape::dot(from, surface.y);
    const double a = shape::reach_of_box(solid.axes, solid.half, surface.x), b = shape::reach_of_box(solid.axes, solid.half, surface.y);
    if (surface.round) return num::setup::hypot(std::abs(u) + a, std::abs(v) + b) <= surface.half_x;
    return std::abs(u) + a <= surface.half_x && std::abs(v) + b <= surface.half_y;
  }

  Vec floating(const Scatter& scatter, const std::string& path) {
    const double u = chance_(path + "[0]"), v = chance_(path + "[1]"), w = chance_(path + "[2]");
    if (!scatter.box.empty()) {
      const double* b = scatter.box.data();
      return {b[0] + u * (b[3] - b[0]), b[1] + v * (b[4] - b[1]), b[2] + w * (b[5] - b[2])};
    }
    if (!camera_) camera_ = load_camera(scene_);
    const Lens& lens = camera_->lens;
    const double z = scatter.near_m + w * (scatter.far_m - scatter.near_m);
    // A pinhole's; distortion moves what is near the rim.
    const Vec seen{z * (u * camera_->sensor.width - 0.5 - lens.cx_px) / lens.fx_px,
                   z * (v * camera_->sensor.height - 0.5 - lens.cy_px) / lens.fy_px, z};
    const std::array<double, 16> pose = camera_pose(scene_, 0);  // camera to world
    const auto world = [&](std::size_t row) {
      return pose[4 * row] * seen.x + pose[4 * row + 1] * seen.y + pose[4 * row + 2] * seen.z + pose[4 * row + 3];
    };
    return {world(0), world(1), world(2)};
  }

  [[nodiscard]] bool has_room(const Solid& solid, const Object* under, double gap) const {
    for (const Standing& one : standing_)
      if (one.object != under && !apart(solid, one.solid, gap)) return false;
    // The side of the camera; where that is put later, the side of the place itself.
    const auto side = [&](const Wall& wall) {
      return shape::dot((eye_ ? *eye_ : solid.center) - wall.point, wall.normal) < 0 ? -1 * wall.normal : wall.normal;
    };
    return std::all_of(walls_.begin(), walls_.end(),
                       [&](const Wall& wall) { return wall.object == under || beyond(solid, wall.point, side(wall), gap); });
  }

  void put(const Scatter& scatter, std::size_t k, const Surface* surface, const Object* under) {
    const std::size_t at = scatter.first + k;
    const Object& object = scene_.objects[at];
    const std::string path = scatter.path + "[" + std::to_string(k) + "]/place";
    const auto own = own_box(object);
    if (!own)
      base::fail(scatter.place, "a plane has no end and cannot be scattered", "expected rectangle, disk or another shape with an end");
    const Vec axis = surface != nullptr ? surface->normal : up_;
    const Mat turn = product(turn_about(axis, scatter.turns_rad[k]), turn_between(up_, axis));
    // What goes to the point that is drawn: the middle of its underside, or its middle.
    const Vec middle = 0.5 * (own->low + own->high), half = 0.5 * (own->high - own->low);
    const Vec stands = surface != nullptr ? middle - shape::reach_of_box(Solid{}.axes, half, up_) * up_ : middle;
    for (int attempt = 0; attempt < scatter.tries; ++attempt) {
      const std::string draw = path + "/" + std::to_string(attempt);
      const Vec target = surface != nullptr ? point_on(*surface, scatter, draw) : floating(scatter, draw);
      const Solid solid{target + turn * (middle - stands), transposed(turn), half};
      if ((surface != nullptr && !is_on(*surface, solid)) || !has_room(solid, under, scatter.gap_m)) continue;
      standing_.push_back({&object, solid});
      write(at, object, turn, target - own->about - turn * stands);
      drawn.push_back({path, "scatter", yaml::flow_text(numbers_node(std::vector<double>{target.x, target.y, target.z}, scatter.place)),
                       static_cast<double>(attempt)});
      return;
    }
    if (scatter.unplaced == Scatter::Unplaced::again) throw NoRoom{scatter.place};
    if (scatter.unplaced == Scatter::Unplaced::fail)
      base::fail(scatter.place,
                 "object " + std::to_string(k) + " of " + std::to_string(scatter.count) + " finds no room in " +
                     std::to_string(scatter.tries) + " tries",
                 "expected fewer or smaller ones, a larger place, more `tries`, or `unplaced: drop`");
    left_out_.push_back(at);
    drawn.push_back({path, "scatter", "", static_cast<double>(scatter.tries)});
  }

  void write(std::size_t at, const Object& object, const Mat& turn, const Vec& position) {
    Node& map = objects_.items[at].items[0];
    set_key(map, "position", numbers_node(std::vector<double>{position.x, position.y, position.z}, map.place));
    const Mat all = product(turn, matrix_of(object.rotation));
    base::Mat3 rows{};
    for (std::size_t i = 0; i < 3; ++i) rows[i] = {all.row[i].x, all.row[i].y, all.row[i].z};
    Node rotation;
    rotation.kind = Node::Kind::map, rotation.place = map.place, rotation.height = 2;
    rotation.keys.push_back({"quaternion", map.place});
    const Quaternion q = base::quaternion_of(rows);
    rotation.items.push_back(numbers_node(q, map.place));
    set_key(map, "rotation", std::move(rotation));
    objects_.items[at].height = map.height + 1;
  }

  const Scene& scene_;
  const Chance& chance_;
  Node& objects_;
  Vec up_;
  std::optional<Vec> eye_;
  std::vector<bool> scattered_;  ///< by object
  std::vector<Wall> walls_;
  std::vector<Standing> standing_;
  std::vector<std::size_t> left_out_;
  std::optional<Camera> camera_;
};

/// How far a point is from a box; 0 in it.
double distance_to(const Solid& solid, const Vec& point) {
  const Vec from = point - solid.center;
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double beyond = std::max(0.0, std::abs(shape::dot(from, solid.axes.row[k])) - solid.half[k]);
    sum += beyond * beyond;
  }
  return std::sqrt(sum);
}

/// The middle of what a look is at: of a scatter, of all its things.
Vec aim_of(const Scene& scene, const Look& look) {
  if (look.at_name.empty()) return {look.at_m[0], look.at_m[1], look.at_m[2]};
  Vec sum{};
  double count = 0;
  std::vector<std::string> names;
  for (const Object& one : scene.objects) {
    if (!one.name.empty()) names.push_back(one.name);
    if (!is_called(one.name, look.at_name)) continue;
    const auto own = own_box(one);
    const auto* plane = std::get_if<Plane>(&one.shape);
    sum = sum + (own ? solid_of(one, *own).center : plane != nullptr ? vec(plane->point) + vec(one.position) : Vec{}), count += 1;
  }
  if (count == 0)
    base::fail(look.place, "there is no object " + base::in_quotes(look.at_name) + " to look at" + base::did_you_mean(look.at_name, names),
               names.empty() ? "expected the name of one, or a point" : "the scene has " + base::listed(names, "and"));
  return (1 / count) * sum;
}

bool is_clear(const Scene& scene, const Vec& eye, const Vec& aim, double clear_m) {
  for (const Object& one : scene.objects) {
    if (const auto* plane = std::get_if<Plane>(&one.shape)) {
      const shape::Plane placed = shape::Plane::placed(*plane, shape::Placement{matrix_of(one.rotation), vec(one.position)});
      const Vec normal = shape::normalized(placed.normal);
      const double here = shape::dot(eye - placed.point, normal), there = shape::dot(aim - placed.point, normal);
      // On the side of what it looks at; where that is the plane itself, on either.
      constexpr double on_it = 1e-9;
      if (std::abs(here) < clear_m || (std::abs(there) > on_it && here * there < 0)) return false;
    } else if (const auto own = own_box(one); own && distance_to(solid_of(one, *own), eye) < clear_m) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<Drawn> place_objects(const Scene& scene, const std::vector<Scatter>& scatters, const Chance& chance, bool camera_stands,
                                 Node& tree) {
  Placer placer(scene, scatters, chance, camera_stands, tree);
  for (const Scatter& one : scatters) placer.place(one);
  placer.finish();
  return std::move(placer.drawn);
}

Drawn place_camera(const Scene& scene, const LookDraw& draw, double clear_m, int tries, Node& tree) {
  const Vec up = up_of(scene), ahead = scene.world_up == Scene::Up::z ? Vec{1, 0, 0} : Vec{0, 0, 1}, aside = shape::cross(up, ahead);
  base::Place place;
  for (int attempt = 0; attempt < tries; ++attempt) {
    const Look look = draw(attempt);
    place = look.place;
    const Vec aim = aim_of(scene, look);
    const double level = num::setup::cos(look.elevation_rad), c = num::setup::cos(look.azimuth_rad), s = num::setup::sin(look.azimuth_rad);
    const Vec from = level * (c * ahead + s * aside) + num::setup::sin(look.elevation_rad) * up;
    const Vec eye = aim + look.radius_m * from;
    if (!is_clear(scene, eye, aim, clear_m)) continue;
    // What is up in the image, across the line of sight; straight above or below it, what is ahead.
    Vec above = up - shape::dot(up, from) * from;
    constexpr double upright = 1e-6;
    if (shape::length(above) < upright) above = ahead - shape::dot(ahead, from) * from;
    above = turn_about(from, look.roll_rad) * shape::normalized(above);
    Node pose;
    pose.kind = Node::Kind::map, pose.place = look.place;
    const auto put = [&](const char* key, const Vec& v) {
      set_key(pose, key, numbers_node(std::vector<double>{v.x, v.y, v.z}, look.place));
    };
    put("position", eye), put("look_at", aim), put("up", above);
    Node* camera = tree.find("camera");
    set_key(*camera, "pose", pose);
    tree.height = std::max(tree.height, camera->height + 1);
    return {"camera/pose/look", "look", yaml::flow_text(pose), static_cast<double>(attempt)};
  }
  base::fail(place, "the camera finds no place to look from in " + std::to_string(tries) + " tries",
             "expected a larger radius, other elevations, or a smaller `clear`");
}

}  // namespace tofray::dataset
