// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/scene_3d.h"

#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "analysis/bodies.h"
#include "analysis/image_geometry.h"
#include "analysis/stand.h"
#include "base/readout.h"
#include "base/vec.h"
#include "tofray/simulator.h"
#include "tofray/stages.h"
#include "view/answer_arrays.h"

namespace tofray::view {

namespace {

using base::operator+, base::operator*;
using files::Json;

Json rows_json(const base::Mat3& m) {
  Json out = Json::array();
  for (const Vec3& row : m) out.push(Json::list(row));
  return out;
}

Json vec_json(const analysis::Vec& a) { return Json::list(std::array{a.x, a.y, a.z}); }

/// The camera in the world: its axes are the columns.
struct Stands {
  base::Mat3 axes;
  Vec3 position;
};
Stands camera_at(const SceneAt& at) {
  const auto m = camera_pose(at.scene, at.time_s);
  return {{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}}, {m[3], m[7], m[11]}};
}

/// The rays of the image's four corners, x and y of x, y, 1; null where the lens has none.
Json frustum_json(const Camera& camera) {
  const base::ImageExtent image = base::image_extent(camera);
  const double right = image.width - 0.5, bottom = image.height - 0.5;
  Json out = Json::array();
  for (const auto& [u, v] : {std::array{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}}) {
    const auto direction = analysis::direction_through(camera, u, v);
    out.push(direction ? Json::list(*direction) : Json());
  }
  return out;
}

/// The angle to a light's axis at which it has fallen to half of its peak; a table's: to where it reaches.
double half_angle_of(const Pattern& pattern) {
  switch (pattern.kind) {
    case Pattern::Kind::cone: return pattern.half_angle_rad;
    case Pattern::Kind::lambertian: return std::acos(0.5);
    case Pattern::Kind::cosine_lobe: return pattern.exponent > 0 ? std::acos(std::pow(0.5, 1 / pattern.exponent)) : std::acos(0.0);
    case Pattern::Kind::flat_top: return 0.5 * std::max(pattern.width_rad, pattern.height_rad);
    case Pattern::Kind::table: return std::max(pattern.half_range_x_rad, pattern.half_range_y_rad);
  }
  return 0;
}

Json lights_json(const SceneAt& at) {
  const Stands camera = camera_at(at);
  Json out = Json::array();
  const std::vector<Illumination>& lights = at.camera.illumination;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    Json one = Json::object();
    one.set("name", lights.size() == 1 ? "light" : "light " + std::to_string(i));
    one.set("position", Json::list(camera.position + camera.axes * lights[i].position));
    one.set("direction", Json::list(base::normalized(camera.axes * lights[i].axis)));
    out.push(std::move(one.set("half_angle_rad", half_angle_of(lights[i].pattern)).set("camera", true)));
  }
  const Ambient& ambient = at.scene.ambient;
  if (ambient.direction && ambient.amount > 0) {
    Json sun = Json::object();
    sun.set("name", "sun").set("position", nullptr).set("direction", Json::list(base::normalized(*ambient.direction)));
    out.push(std::move(sun.set("half_angle_rad", nullptr).set("camera", false)));
  }
  return out;
}

Json bounds_json(const analysis::Body& body) {
  const std::array<double, 6> all{body.low.x, body.low.y, body.low.z, body.high.x, body.high.y, body.high.z};
  for (const double one : all)
    if (!std::isfinite(one)) return {};
  return Json::list(all);
}

const char* name_of(analysis::Drawn drawn) {
  switch (drawn) {
    case analysis::Drawn::shape: return "shape";
    case analysis::Drawn::box: return "box";
    case analysis::Drawn::none: break;
  }
  return "none";
}

/// Adds objects, and left_out where these would be too many for a text.
void put_objects(Json& json, const SceneAt& at, const Geometry& geometry) {
  constexpr std::size_t most_bytes = 800'000;  // a page that takes 1 MB too slowly is let go
  std::size_t bytes = 0, left_out = 0;
  const std::vector<analysis::Body> bodies = analysis::bodies_at(at.scene, at.time_s);
  Json out = Json::array();
  for (std::size_t i = 0; i < at.scene.objects.size(); ++i) {
    const Object& object = at.scene.objects[i];
    const analysis::ObjectPose pose = analysis::pose_of(object, at.time_s);
    const std::string why = why_fixed(object);
    Json rows = Json::array();
    for (const analysis::Vec& row : pose.turn.row) rows.push(vec_json(row));
    Json one = Json::object();
    one.set("id", i).set("name", object.name).set("key", object.key).set("kind", analysis::kind_of(object));
    one.set("position", vec_json(pose.origin)).set("rotation", std::move(rows));
    one.set("bounds", bounds_json(bodies[i])).set("movable", why.empty()).set("why", why);
    one.set("drawn", name_of(geometry.triangles.drawn[i]));
    bytes += files::json_text(one).size() + 1;
    if (bytes > most_bytes) {
      left_out = at.scene.objects.size() - i;
      break;
    }
    out.push(std::move(one));
  }
  json.set("objects", std::move(out));
  if (left_out > 0) json.set("left_out", left_out);
}

}  // namespace

Geometry geometry_of(const SceneAt& at) {
  const base::ImageExtent image = base::image_extent(at.camera);
  return {static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height), pixel_rays(at.camera),
          analysis::scene_triangles(at.scene, at.time_s)};
}

bool same(const Geometry& a, const Geometry& b) {
  // By their bytes: a ray that is no number is the same as another.
  return a.width == b.width && a.height == b.height && a.rays.size() == b.rays.size() &&
         std::memcmp(a.rays.data(), b.rays.data(), a.rays.size() * sizeof(float)) == 0 && a.triangles.corners == b.triangles.corners &&
         a.triangles.objects == b.triangles.objects && a.triangles.drawn == b.triangles.drawn;
}

void put_scene(Json& json, const SceneAt& at, const Geometry& geometry) {
  const Stands camera = camera_at(at);
  const std::string why = why_fixed(at.scene.camera);
  Json stands = Json::object();
  stands.set("position", Json::list(camera.position)).set("rotation", rows_json(camera.axes));
  stands.set("movable", why.empty()).set("why", why);
  json.set("time_s", at.time_s).set("camera", std::move(stands)).set("frustum", frustum_json(at.camera));
  json.set("lights", lights_json(at));
  put_objects(json, at, geometry);
}

std::string drawing_bytes(const WireHead& head, std::uint64_t frame, const Geometry& of) {
  const std::size_t triangles = of.triangles.corners.size();
  const StaticArray arrays[] = {array_of(f32_type, of.rays, 3, {of.height, of.width, 2}),
                                array_of(f32_type, of.triangles.corners, 3, {triangles, 3, 3}),
                                array_of(u32_type, of.triangles.objects, 1, {triangles, 0, 0})};
  return encoded(head, frame, of.width, of.height, arrays);
}

}  // namespace tofray::view
