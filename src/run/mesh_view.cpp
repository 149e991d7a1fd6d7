// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/mesh_view.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "base/text.h"
#include "base/units.h"
#include "camera/readout/image_camera.h"
#include "tofray/camera_report.h"

namespace tofray::run {

namespace {

using base::operator+;
using base::operator-;
using base::operator*;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Shows each triangle's corners to `see`.
template <class See>
void for_each_triangle(const Scene& scene, const See& see) {
  for (const Object& object : scene.objects) {
    const TriangleMesh& mesh = *std::get<Mesh>(object.shape).triangles;
    const auto corner = [&](std::int32_t i) {
      const auto& at = mesh.vertices[static_cast<std::size_t>(i)];
      return Vec3{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
    };
    for (const auto& [a, b, c] : mesh.triangles) see(std::array<Vec3, 3>{corner(a), corner(b), corner(c)});
  }
}

/// Shows each triangle's corners to `see`, those that triangles share several times.
template <class See>
void for_each_corner(const Scene& scene, const See& see) {
  for_each_triangle(scene, [&](const std::array<Vec3, 3>& triangle) { std::for_each(triangle.begin(), triangle.end(), see); });
}

MeshBox box_along(const Scene& scene, const std::array<Vec3, 3>& axes) {
  MeshBox out{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for_each_corner(scene, [&](const Vec3& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = base::dot(axes[k], p);
      out.low[k] = std::min(out.low[k], x), out.high[k] = std::max(out.high[k], x);
    }
  });
  return out;
}

/// Tangents of the angles that a camera sees on both sides of its axis: to the right and left, up and down; and the area of the image in
/// pixels at distance 1.
struct View {
  double x, y, pixels;
};

View view_of(const Camera& camera) {
  const camera::ImageCamera read_out(camera);
  const Sensor& sensor = read_out.sensor;
  const Lens& lens = read_out.lens;
  const auto half = [](double center, int pixels, double focal) {
    return std::max(0.05, std::min(center + 0.5, pixels - 0.5 - center) / focal);
  };
  return {half(lens.cx_px, sensor.width, lens.fx_px), half(lens.cy_px, sensor.height, lens.fy_px), lens.fx_px * lens.fy_px};
}

/// A mesh as a camera sees it from far away.
struct Sight {
  Vec3 aside, middle;  ///< the direction to the camera; the middle of the mesh's box along the image's axes
  double whole_m;      ///< from the middle: as near as all of it stays in the image
  double front_m;      ///< how far it reaches to the camera from its middle
  double area_m2;      ///< of all triangles across the direction: a closed body covers half of it
};

Sight sight_of(const Scene& scene, const View& view) {
  const Scene::Up up = scene.world_up;
  const Vec3 aside = base::normalized(in_world({0.5, -0.4, -1}, up)), forward = -1.0 * aside;
  const Vec3 right = base::normalized(base::cross(in_world({0, 1, 0}, up), forward)), down = base::cross(forward, right);
  const MeshBox box = box_along(scene, {right, down, forward});
  const Vec3 middle = 0.5 * (box.low + box.high);
  constexpr double used = 0.9;
  Sight out{aside, middle[0] * right + middle[1] * down + middle[2] * forward, 0, middle[2] - box.low[2], 0};
  for_each_triangle(scene, [&](const std::array<Vec3, 3>& triangle) {
    for (const Vec3& p : triangle) {
      const double x = std::abs(base::dot(right, p) - middle[0]), y = std::abs(base::dot(down, p) - middle[1]);
      out.whole_m = std::max(out.whole_m, std::max(x / view.x, y / view.y) / used - (base::dot(forward, p) - middle[2]));
    }
    out.area_m2 += 0.5 * std::abs(base::dot(forward, base::cross(triangle[1] - triangle[0], triangle[2] - triangle[0])));
  });
  return out;
}

/// From where to where a camera has depth of a surface.
struct Reach {
  double near_m = 0, far_m = infinity, reflectivity = 1;
};

/// Of the brightest material where it faces the camera, and where it is six tenths as bright, slanted or towards the image's rim.
Reach reach_of(const Scene& scene, const Camera& camera) {
  double brightest = 0;
  for (const Object& object : scene.objects)
    brightest = std::max(brightest, scene.materials[static_cast<std::size_t>(object.material)].diffuse);
  const double diffuse = std::clamp(brightest, 0.01, 1.0);
  CameraQuestion question;
  for (double z = 0.125; z < 130; z *= 1.1) question.distances_m.push_back(z);
  question.reflectivities = {diffuse, 0.6 * diffuse};
  question.ambients = {AmbientCase()};
  const CameraReport report = camera_report(camera, question);
  if (report.noise.size() != 2) return {};  // no light: all else says so
  Reach out{report.noise[0].saturated_up_to_m, 0, diffuse};
  for (const NoiseAt& one : report.noise[1].at)
    if (!one.saturated && one.sigma_m <= report.low_signal_m && one.z_m <= report.ambiguity_range_m)
      out.far_m = std::max(out.far_m, one.z_m);
  if (!(out.near_m < NoiseAtDistances::everywhere_m) || !(out.far_m > out.near_m)) return {};  // it has no depth of such a surface anywhere
  return out;
}

/// What a file's numbers may be in place of metres, likeliest first.
struct Unit {
  const char* name;
  double metres;
};
constexpr Unit likely_units[] = {
    {"millimetres", 1e-3}, {"centimetres", 1e-2}, {"inches", 0.0254}, {"micrometres", 1e-6}, {"kilometres", 1e3}};

/// To so many digits.
double rounded(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string scaled_size(const MeshBox& box, double by) { return base::size_text(by * box.low, by * box.high); }

constexpr double least_pixels = 60;  // of an estimate that may be twice what is seen: fewer show nothing of a shape

/// A mesh of another size: where the camera stands, and how many pixels it covers at most.
struct Scaled {
  double distance_m, pixels;
};
Scaled scaled(const Sight& sight, const View& view, const Reach& reach, double by) {
  constexpr double least_m = 2e-3;  // of any scene
  const double distance = std::max({least_m, by * sight.whole_m, reach.near_m + by * sight.front_m});
  return {distance, view.pixels * sight.area_m2 * (by / distance) * (by / distance)};
}

/// What unit the numbers may have, and a scale at which all of the mesh has depth.
std::string advice(const Sight& sight, const View& view, const Reach& reach, const MeshBox& box, double scale) {
  const auto set = [&](double factor) { return "--set objects.0.mesh.scale=" + base::number_text(rounded(scale * factor, 3)); };
  const auto fits = [&](double factor) {
    const Scaled it = scaled(sight, view, reach, factor);
    return it.distance_m <= reach.far_m && it.pixels >= 2 * least_pixels;
  };
  const auto units_that = [&](const auto& do_it) {
    return scale == 1 ? std::find_if(std::begin(likely_units), std::end(likely_units), [&](const Unit& unit) { return do_it(unit.metres); })
                      : std::end(likely_units);
  };
  if (const Unit* const unit = units_that(fits); unit != std::end(likely_units))
    return fmt::format("are its numbers {}? {} makes it {}", unit->name, set(unit->metres), scaled_size(box, unit->metres));
  const double nearest = reach.near_m / std::max(sight.whole_m - sight.front_m, 1e-3 * sight.whole_m),
               farthest = reach.far_m / sight.whole_m;
  const double wanted = rounded(std::sqrt(nearest * farthest), 1);
  const Unit* const likely = units_that([&](double factor) { return factor * box.largest() >= 0.02 && factor * box.largest() <= 20; });
  if (likely != std::end(likely_units))
    return fmt::format("are its numbers {}, which make it {}? What fits this camera: {} makes it {}", likely->name,
                       scaled_size(box, likely->metres), set(wanted), scaled_size(box, wanted));
  return fmt::format("what fits this camera: {} makes it {}", set(wanted), scaled_size(box, wanted));
}

std::string metres_text(double m) {
  return m < 0.1 ? fmt::format("{:.3g} mm", 1e3 * m) : fmt::format("{:.{}f} m", m, m < 1 ? 2 : m < 10 ? 1 : 0);
}

}  // namespace

double MeshBox::largest() const { return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}); }

MeshBox box_round(const Scene& scene) { return box_along(scene, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}); }

Vec3 in_world(const Vec3& v, Scene::Up up) {
  if (up == Scene::Up::y) return {v[0], -v[1], -v[2]};
  if (up == Scene::Up::z) return {v[0], v[2], -v[1]};
  return v;
}

MeshView view_of_meshes(const Scene& scene, const Camera& camera, const std::string& path) {
  const View view = view_of(camera);
  const Sight sight = sight_of(scene, view);
  const Reach reach = reach_of(scene, camera);
  const auto [distance, pixels] = scaled(sight, view, reach, 1);
  MeshView out{{sight.middle + distance * sight.aside, sight.middle}, {}};
  const bool small = pixels < least_pixels && distance > sight.whole_m, large = distance > reach.far_m;
  if (!small && !large) return out;
  const MeshBox box = box_round(scene);
  Remark remark{true, path, "", advice(sight, view, reach, box, std::get<Mesh>(scene.objects[0].shape).scale)};
  remark.what = fmt::format("it measures {}, {}", base::size_text(box.low, box.high),
                            small ? fmt::format("and covers {}: nearer than {} this camera saturates",
                                                pixels < 1 ? "less than a pixel" : fmt::format("{:.0f} pixels at most", std::ceil(pixels)),
                                                metres_text(reach.near_m))
                                  : fmt::format("and is seen whole from {} away: of reflectivity {:.2g} this camera has depth to some {}",
                                                metres_text(distance), reach.reflectivity, metres_text(reach.far_m)));
  out.odd_size = std::move(remark);
  return out;
}

}  // namespace tofray::run
