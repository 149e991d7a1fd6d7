// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/budget.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "analysis/budget_request.h"
#include "analysis/one_pixel.h"
#include "analysis/pixel_budget.h"
#include "base/constants.h"
#include "camera/lens/lens.h"
#include "camera/readout/image_camera.h"
#include "simulator/exposure_control.h"
#include "tofray/error.h"

namespace tofray {

namespace analysis {

namespace {

void refuse_budget(const std::string& what, const std::string& got, const std::string& expected) {
  throw Error(ErrorKind::bad_input, fmt::format("error: {}\n  got {}, expected {}", what, got, expected));
}

void within_budget(const char* what, double got, double low, double high) {
  if (!(got >= low && got <= high))
    refuse_budget(fmt::format("{} is out of range", what), fmt::format("{:g}", got), fmt::format("{:g} to {:g}", low, high));
}

bool is_lit(const RawFrame& one) { return one.lit; }

/// Longest lit integration time.
double longest_of(const Camera& camera) {
  double out = 0;
  for (const RawFrame& one : camera.mode.sequence) out = is_lit(one) ? std::max(out, one.integration_time_s) : out;
  return out;
}

/// The camera with the exposures that its own law leaves after many frames of a wall.         [theory: brightness, auto-exposure]
Camera exposed_for(const Camera& pixel, const AutoExposure& law, const AmbientCase& light, const Geometry& wall) {
  constexpr int most_frames = 40;
  constexpr double still = 1e-3;
  Camera camera = pixel, following = pixel;
  following.auto_exposure = law, following.auto_exposure.speed = 1;  // each frame goes all of the way
  simulator::Exposure exposure(following, Stage::depth);
  Scene scene;
  scene.ambient = light.ambient, scene.camera.pose = light.pose;
  double before = 0;
  for (std::uint64_t i = 0; i < most_frames; ++i) {
    const std::vector<double> times = exposure.times_of(i);
    for (std::size_t k = 0; k < times.size(); ++k) camera.mode.sequence[k].integration_time_s = times[k];
    const double longest = longest_of(camera);
    if (std::fabs(longest - before) < still * longest) break;
    before = longest;
    const Frame frame = Simulator(scene, camera, expected_values(Stage::raw)).frame(0, wall);
    camera::FrozenCamera frozen(camera, false, 0);
    flow::FrameView view{};
    view.raw = const_cast<std::uint16_t*>(frame.raw.raw.data());
    view.tap_a = const_cast<float*>(frame.raw.tap_a.data()), view.tap_b = const_cast<float*>(frame.raw.tap_b.data());
    exposure.follow(frozen.sensor(0), view, {1, 1, {0, 0, 1, 1}});
  }
  return camera;
}

}  // namespace

BudgetRequest complete_request(BudgetRequest request) {
  if (request.distances_m.empty()) request.distances_m = {0.5, 1, 2, 4};
  if (request.reflectivities.empty()) request.reflectivities = {0.2, 0.8};
  if (request.ambients.empty()) request.ambients = {AmbientCase()};
  constexpr double steepest = 0.5 * base::pi * (1 - 1e-9);
  for (const double z : request.distances_m) within_budget("distances_m", z, 1e-3, 1e5);
  for (const double one : request.reflectivities) within_budget("reflectivities", one, 0, 1);
  within_budget("angle_rad", request.angle_rad, -steepest, steepest);
  return request;
}

BudgetCamera::BudgetCamera(const Camera& profile, const BudgetRequest& request) {
  Camera warmed = profile;
  if (request.temperature_celsius) warmed.temperature.celsius = *request.temperature_celsius;
  (void)image_size(warmed);  // what is wrong with the camera is said here
  const camera::ImageCamera camera(warmed);
  if (std::none_of(camera.mode.sequence.begin(), camera.mode.sequence.end(), is_lit))
    throw Error(ErrorKind::bad_input, "error: no raw frame of the mode is lit\n  expected some, for there is no range without");
  law_ = camera.auto_exposure;
  double u = camera.lens.cx_px, v = camera.lens.cy_px;
  if (request.pixel) {
    u = (*request.pixel)[0], v = (*request.pixel)[1];
    within_budget("the pixel's column", u, 0, camera.sensor.width - 1);
    within_budget("the pixel's row", v, 0, camera.sensor.height - 1);
    camera::Point2 ray{};
    if (!camera::unproject(camera.lens, camera::growing_radius_squared(camera.lens), {u, v}, ray))
      refuse_budget("the pixel is outside the lens", fmt::format("column {:g}, row {:g}", u, v), "one that has a ray");
  }
  pixel_ = pixel_alone(camera, u, v);
  request_ = request;
}

BudgetRow BudgetCamera::at(std::size_t light, double z, double reflectivity, bool wrong_cycles) {
  if (in_light_.size() < request_.ambients.size()) in_light_.resize(request_.ambients.size());
  const AmbientCase& ambient = request_.ambients[light];
  std::unique_ptr<PixelBudget> exposed;
  PixelBudget* of = nullptr;
  BudgetRow row;
  double exposure = 1;
  if (request_.auto_exposure) {
    const Camera camera = exposed_for(pixel_, law_, ambient, wall_at(1, 1, z, reflectivity, request_.angle_rad));
    exposure = longest_of(camera) / longest_of(pixel_);
    exposed = std::make_unique<PixelBudget>(camera, ambient), of = exposed.get();
  } else {
    if (in_light_[light] == nullptr) in_light_[light] = std::make_unique<PixelBudget>(pixel_, ambient);
    of = in_light_[light].get();
  }
  row = of->at(z, reflectivity, request_.angle_rad);
  row.ambient = ambient.name, row.exposure = exposure;
  if (wrong_cycles) row.wrong_cycle = of->wrong_cycle();
  return row;
}

BudgetCamera::~BudgetCamera() = default;

double BudgetCamera::saturated_up_to(std::size_t light, double reflectivity, double nearest_m, double farthest_m) {
  const auto saturated = [&](double z) { return at(light, z, reflectivity, false).saturated; };
  double far = farthest_m, near = far;
  while (near > nearest_m && !saturated(near)) far = near, near /= 1.03;
  if (near <= nearest_m) return 0;
  if (near == far) return farthest_m;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (near + far);
    (saturated(middle) ? near : far) = middle;
  }
  return near;
}

double BudgetCamera::reach(std::size_t light, double reflectivity, double nearest_m, double farthest_m) {
  const auto good = [&](double z) { return at(light, z, reflectivity, false).sigma_m <= pixel_.decoding.noise_threshold_m; };
  double far = farthest_m, near = far;
  while (near > nearest_m && !good(near)) far = near, near /= 1.03;
  if (near <= nearest_m) return 0;
  for (int i = 0; i < 30 && near < far; ++i) {
    const double middle = 0.5 * (near + far);
    (good(middle) ? near : far) = middle;
  }
  return near;
}

}  // namespace analysis

std::vector<BudgetRow> budget(const Camera& camera, const BudgetRequest& request) {
  const BudgetRequest complete = analysis::complete_request(request);
  analysis::BudgetCamera of(camera, complete);
  std::vector<BudgetRow> out;
  for (std::size_t light = 0; light < complete.ambients.size(); ++light)
    for (const double reflectivity : complete.reflectivities)
      for (const double z : complete.distances_m) out.push_back(of.at(light, z, reflectivity, true));
  return out;
}

}  // namespace tofray
