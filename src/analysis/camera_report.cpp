// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/camera_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "analysis/budget_request.h"
#include "analysis/one_pixel.h"
#include "analysis/reach.h"
#include "base/constants.h"
#include "base/text.h"
#include "base/units.h"
#include "camera/frozen_camera.h"
#include "camera/lens/lens.h"
#include "camera/readout/image_camera.h"
#include "tofray/error.h"
#include "tofray/simulator.h"
#include "tofray/stages.h"

namespace tofray {

namespace {

using base::pi;

constexpr double nearest_m = 0.05, farthest_m = NoiseAtDistances::everywhere_m;

/// Angle between the rays of two places in the image; NaN where the lens has none.
double angle_between(const Lens& lens, const camera::Point2& one, const camera::Point2& other) {
  const double limit = camera::growing_radius_squared(lens);
  camera::Point2 a{}, b{};
  if (!camera::unproject(lens, limit, one, a) || !camera::unproject(lens, limit, other, b)) return std::nan("");
  const double cosine = (a.x * b.x + a.y * b.y + 1) / std::sqrt((a.x * a.x + a.y * a.y + 1) * (b.x * b.x + b.y * b.y + 1));
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / pi;
}

void report_view(const camera::ImageCamera& camera, CameraReport& out) {
  const Lens& lens = camera.lens;
  const double right = camera.sensor.width - 0.5, down = camera.sensor.height - 0.5;
  const double u = 0.5 * (right - 0.5), v = 0.5 * (down - 0.5);
  out.width_deg = angle_between(lens, {-0.5, v}, {right, v}), out.height_deg = angle_between(lens, {u, -0.5}, {u, down});
  out.diagonal_deg = angle_between(lens, {-0.5, -0.5}, {right, down});
  out.pixel_width_m = 1 / lens.fx_px, out.pixel_height_m = 1 / lens.fy_px;
}

/// The camera with its view in fewer pixels, where it has very many: shares of them are all that is asked for.
camera::ImageCamera coarser(camera::ImageCamera camera) {
  constexpr double enough = 1 << 18;
  Sensor& sensor = camera.sensor;
  const int by = std::min({std::max(1, static_cast<int>(std::sqrt(sensor.width * (sensor.height / enough)))), sensor.width, sensor.height});
  sensor.width /= by, sensor.height /= by;
  camera.lens.fx_px /= by, camera.lens.fy_px /= by;
  camera.lens.cx_px = (camera.lens.cx_px + 0.5) / by - 0.5, camera.lens.cy_px = (camera.lens.cy_px + 0.5) / by - 0.5;
  return camera;
}

/// What of a wall at 1 m the light source reaches.
void report_light(const camera::ImageCamera& camera, CameraReport& out) {
  const Truth seen = Simulator(Scene(), camera, analysis::expected_values(Stage::power))
                         .frame(0, analysis::wall_at(camera.sensor.width, camera.sensor.height, 1, 1))
                         .truth;
  const float most = *std::max_element(seen.power_w.begin(), seen.power_w.end());
  float least = most;
  const double one = 1 / static_cast<double>(seen.power_w.size());
  for (std::size_t i = 0; i < seen.power_w.size(); ++i) {
    if (seen.object_id[i] < 0) {
      out.outside += one;
    } else if (!(seen.power_w[i] > 1e-6F * most)) {
      out.unlit += one;
    } else {
      least = std::min(least, seen.power_w[i]);
    }
  }
  if (most > 0) out.darkest = static_cast<double>(least / most);
}

bool has_unlit(const Mode& mode) {
  return std::any_of(mode.sequence.begin(), mode.sequence.end(), [](const RawFrame& one) { return !one.lit; });
}

void report_noise(const Camera& camera, const CameraQuestion& question, CameraReport& out) {
  BudgetRequest request;
  request.distances_m = question.distances_m, request.reflectivities = question.reflectivities, request.ambients = question.ambients;
  analysis::BudgetCamera pixel(camera, request);
  for (std::size_t light = 0; light < question.ambients.size(); ++light) {
    for (const double reflectivity : question.reflectivities) {
      NoiseAtDistances one;
      one.reflectivity = reflectivity, one.ambient = question.ambients[light].name;
      one.saturated_up_to_m = pixel.saturated_up_to(light, reflectivity, nearest_m, farthest_m);
      for (const double z : question.distances_m) {
        const BudgetRow row = pixel.at(light, z, reflectivity, true);
        one.at.push_back({z, row.sigma_m, row.wrong_cycle, row.saturated});
      }
      out.noise.push_back(one);
    }
  }
}

/// "80 MHz and 61.7 MHz"
std::string listed_frequencies(const std::vector<double>& frequency_hz) {
  std::vector<std::string> names;
  for (const double f : frequency_hz) names.push_back(base::quantity_text(f, "1 MHz"));
  return base::listed(names, "and");
}

/// A light wall that is near, in the dark, is the least that a camera has to do.
void warn_of_wrong_cycles(const Camera& camera, CameraReport& out) {
  if (out.cycles.size() < 2 || out.noise.empty()) return;
  constexpr double near_m = 1, grey = 0.2, limit = 0.01;
  BudgetRequest dark;
  dark.ambients = {AmbientCase()};
  const double share = analysis::BudgetCamera(camera, dark).at(0, near_m, grey, true).wrong_cycle;  // NaN where it saturates
  if (!(share > limit)) return;
  std::vector<std::string> ratio;
  for (const int one : out.cycles) ratio.push_back(std::to_string(one));
  out.warnings.push_back(
      fmt::format("{:.2g} % of the pixels of a 20 % wall at 1 m in the dark are on a wrong cycle: the modulation frequencies {} are as {}, "
                  "and their ambiguity "
                  "range of {:.3f} m is cut into {} steps, which noise confuses; choose frequencies whose ratio is of small whole numbers "
                  "(4 : 3, 5 : 4), or more light",
                  100 * share, listed_frequencies(out.modulation_frequency_hz), base::listed(ratio, "to"), out.ambiguity_range_m,
                  *std::max_element(out.cycles.begin(), out.cycles.end())));
}

void check_question(const CameraQuestion& question) {
  const auto refuse = [](const char* what, double got, const char* expected) {
    throw Error(ErrorKind::bad_input, fmt::format("error: {} is out of range\n  got {:g}, expected {}", what, got, expected));
  };
  for (const double z : question.distances_m)
    if (!(z >= 1e-3 && z <= 1e5)) refuse("distances_m", z, "0.001 to 100000");
  for (const double one : question.reflectivities)
    if (!(one >= 0 && one <= 1)) refuse("reflectivities", one, "0 to 1");
}

}  // namespace

AmbientCase full_sun() {
  AmbientCase out;
  out.name = "in the sun";
  out.ambient.spectrum = Ambient::Spectrum::sun_am15, out.ambient.amount = 1;
  return out;
}

CameraReport camera_report(const Camera& profile, const CameraQuestion& asked) {
  CameraQuestion question = asked;
  if (question.distances_m.empty()) question.distances_m = {0.5, 1, 2, 4};
  if (question.reflectivities.empty()) question.reflectivities = {0.2, 0.8};
  if (question.ambients.empty()) question.ambients = {AmbientCase(), full_sun()};
  check_question(question);
  camera::ImageCamera camera(profile);
  camera.auto_exposure = {};  // exposures of the mode
  CameraReport out;
  out.width = camera.sensor.width, out.height = camera.sensor.height;
  report_view(camera, out);
  const camera::Modulations modulations = camera::modulations_of(camera.mode);
  out.modulation_frequency_hz = modulations.frequency_hz, out.cycles = modulations.cycles;
  out.low_signal_m = camera.decoding.noise_threshold_m;
  report_light(coarser(camera), out);
  if (modulations.frequency_hz.empty()) return out;
  out.ambiguity_range_m = analysis::reach_of(camera).ambiguity_range_m;
  out.knows_ambient = has_unlit(camera.mode);
  if (std::any_of(camera.illumination.begin(), camera.illumination.end(), [](const Illumination& one) { return one.power_w > 0; }))
    report_noise(camera, question, out);
  warn_of_wrong_cycles(camera, out);
  return out;
}

}  // namespace tofray
