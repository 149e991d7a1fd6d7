// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/measure.h"

#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <vector>

#include "analysis/samples.h"
#include "base/vec.h"
#include "tofray/error.h"

namespace tofray::view {

namespace {

using base::operator-, base::operator*;
using files::Json;

Json point_json(const std::optional<Vec3>& point) { return point ? Json::list(*point) : Json(); }

Vec3 at(const std::vector<float>& points, std::size_t pixel) {
  return {static_cast<double>(points[3 * pixel]), static_cast<double>(points[3 * pixel + 1]), static_cast<double>(points[3 * pixel + 2])};
}

/// One end of the distance, in the camera's frame.
struct End {
  std::optional<Vec3> measured, truth;
  double noise_m = std::nan("");  ///< along the ray
  std::int64_t object = -1;
};

End end_of(const Frame& frame, int u, int v) {
  const Depth& depth = frame.depth;
  if (u < 0 || v < 0 || u >= depth.width || v >= depth.height)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: pixel {},{} is outside the image\n  expected columns of 0 to {} and rows of 0 to {}", u, v,
                            depth.width - 1, depth.height - 1));
  const std::size_t pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width) + static_cast<std::size_t>(u);
  End out;
  if (analysis::has_depth(depth, pixel)) out.measured = at(depth.points_m, pixel), out.noise_m = depth.noise_m[pixel];
  const Truth& truth = frame.truth;  // of files there may be none
  if (!truth.position_m.empty())
    if (const Vec3 point = at(truth.position_m, pixel); std::isfinite(point[2]) && point[2] > 0) out.truth = point;
  if (!truth.object_id.empty()) out.object = truth.object_id[pixel];
  return out;
}

/// The share of a distance that lies along a point's ray.
double along_ray(const Vec3& way, const Vec3& point) { return base::dot(base::normalized(way), base::normalized(point)); }

double distance(const std::optional<Vec3>& a, const std::optional<Vec3>& b) { return a && b ? base::length(*b - *a) : std::nan(""); }

}  // namespace

void put_measure(Json& json, const Frame& frame, const Scene& scene, const Measure& measure) {
  const End ends[] = {end_of(frame, measure.u[0], measure.v[0]), end_of(frame, measure.u[1], measure.v[1])};
  const char* const names[] = {"a", "b"};
  for (std::size_t i = 0; i < 2; ++i) {
    Json one = Json::object();
    one.set("u", measure.u[i]).set("v", measure.v[i]).set("measured", point_json(ends[i].measured)).set("true", point_json(ends[i].truth));
    const bool shows = ends[i].object >= 0 && static_cast<std::size_t>(ends[i].object) < scene.objects.size();
    one.set("object", ends[i].object).set("name", shows ? scene.objects[static_cast<std::size_t>(ends[i].object)].name : std::string());
    json.set(names[i], std::move(one));
  }
  double sigma = std::nan("");
  if (const auto& a = ends[0].measured, &b = ends[1].measured; a && b) {
    const Vec3 way = *b - *a;
    sigma = base::length(way) > 0 ? std::hypot(along_ray(way, *a) * ends[0].noise_m, along_ray(way, *b) * ends[1].noise_m) : 0;
  }
  json.set("measured_m", distance(ends[0].measured, ends[1].measured)).set("true_m", distance(ends[0].truth, ends[1].truth));
  json.set("sigma_m", sigma);
}

}  // namespace tofray::view
