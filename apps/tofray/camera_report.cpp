// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/limits.h"
#include "base/readout.h"
#include "base/text.h"
#include "base/units.h"
#include "camera/frozen_camera.h"
#include "camera/lens.h"
#include "tofray/simulator.h"
#include "tofray/stages.h"

namespace tofray::app {

namespace {

using base::pi;

constexpr double reflectivities[] = {0.2, 0.8};
constexpr double nearest_m = 0.05, farthest_m = 20;

SimulatorOptions without_noise(Stage last) {
  SimulatorOptions out;
  out.noise = Noise::off;
  out.backend = Backend::cpu;
  out.last_stage = last;
  return out;
}

/// A wall that faces all pixels at the same z.
Geometry wall(const Camera& camera, double z, double reflectivity) {
  Geometry out;
  out.width = camera.sensor.width, out.height = camera.sensor.height;
  const auto pixels = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
  out.z_m.assign(pixels, static_cast<float>(z)), out.diffuse.assign(pixels, static_cast<float>(reflectivity));
  out.normal.assign(3 * pixels, 0.0F);
  for (std::size_t i = 0; i < pixels; ++i) out.normal[3 * i + 2] = -1.0F;
  return out;
}

/// Angle between the rays of two places in the image; NaN where the lens has none.
double angle_between(const Lens& lens, const camera::Point2& one, const camera::Point2& other) {
  const double limit = camera::growing_radius_squared(lens);
  camera::Point2 a{}, b{};
  if (!camera::unproject(lens, limit, one, a) || !camera::unproject(lens, limit, other, b)) return std::nan("");
  const double cosine = (a.x * b.x + a.y * b.y + 1) / std::sqrt((a.x * a.x + a.y * a.y + 1) * (b.x * b.x + b.y * b.y + 1));
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / pi;
}

void report_view(const Camera& camera, CameraReport& out) {
  const Lens& lens = camera.lens;
  const double right = camera.sensor.width - 0.5, down = camera.sensor.height - 0.5;
  const double u = 0.5 * (right - 0.5), v = 0.5 * (down - 0.5);
  out.width_deg = angle_between(lens, {-0.5, v}, {right, v}), out.height_deg = angle_between(lens, {u, -0.5}, {u, down});
  out.diagonal_deg = angle_between(lens, {-0.5, -0.5}, {right, down});
  out.pixel_width_m = 1 / lens.fx_px, out.pixel_height_m = 1 / lens.fy_px;
}

/// The same view in fewer pixels, where it has very many: shares of them are all that is asked for.
Camera coarser(Camera camera) {
  constexpr double enough = 1 << 18;
  Sensor& sensor = camera.sensor;
  const int by = std::min({std::max(1, static_cast<int>(std::sqrt(sensor.width * (sensor.height / enough)))), sensor.width, sensor.height});
  sensor.width /= by, sensor.height /= by;
  camera.lens.fx_px /= by, camera.lens.fy_px /= by;
  camera.lens.cx_px = (camera.lens.cx_px + 0.5) / by - 0.5, camera.lens.cy_px = (camera.lens.cy_px + 0.5) / by - 0.5;
  return camera;
}

/// What of a wall at 1 m the light source reaches.
void report_light(const Camera& camera, CameraReport& out) {
  const Truth seen = Simulator(Scene(), camera, without_noise(Stage::power)).frame(0, wall(camera, 1, 1)).truth;
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

/// The camera with one pixel alone, which looks along the optical axis and is like the mean of all.
Camera pixel_on_the_axis(Camera camera) {
  camera.sensor.width = camera.sensor.height = 1;
  camera.lens.cx_px = camera.lens.cy_px = 0;
  camera.lens.scatter = {}, camera.interference = {}, camera.decoding.temporal_frames = 1;
  camera.pixel.crosstalk_left_right = camera.pixel.crosstalk_up_down = 0;
  camera.pixel.prnu = camera.pixel.dsnu_dn = camera.pixel.delay_s = camera.pixel.phase_offset_rad = 0;
  // Without an unlit raw frame the camera itself does not know how much noise the sun makes; who chooses one should.
  std::vector<RawFrame>& sequence = camera.mode.sequence;
  if (!has_unlit(camera.mode) && sequence.size() < static_cast<std::size_t>(base::limit::raw_frames.value))
    sequence.push_back({false, 0, 0, 0.05 * sequence.front().integration_time_s});
  return camera;
}

struct Seen {
  double sigma_m;
  bool saturated;
};
class Looker {
 public:
  Looker(const Camera& camera, bool in_the_sun) : camera_(camera), simulator_(scene(in_the_sun), camera, without_noise(Stage::depth)) {}
  Seen at(double z, double reflectivity) {
    const Depth depth = simulator_.frame(0, wall(camera_, z, reflectivity)).depth;
    return {static_cast<double>(depth.noise_m[0]), (depth.flags[0] & flag_saturated) != 0};
  }

 private:
  static Scene scene(bool in_the_sun) {
    Scene out;
    if (in_the_sun) out.ambient.spectrum = Ambient::Spectrum::sun_am15, out.ambient.amount = 1;
    return out;
  }
  const Camera& camera_;
  Simulator simulator_;
};

/// The farthest distance at which the pixel saturates.
double saturated_up_to(Looker& looker, double reflectivity) {
  double far = farthest_m, near = far;
  while (near > nearest_m && !looker.at(near, reflectivity).saturated) far = near, near /= 1.03;
  if (near <= nearest_m) return 0;
  if (near == far) return farthest_m;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (near + far);
    (looker.at(middle, reflectivity).saturated ? near : far) = middle;
  }
  return near;
}

void report_noise(const Camera& camera, CameraReport& out) {
  const Camera pixel = pixel_on_the_axis(camera);
  for (const bool in_the_sun : {false, true}) {
    Looker looker(pixel, in_the_sun);
    for (const double reflectivity : reflectivities) {
      NoiseAtDistances one{reflectivity, in_the_sun, {}, {}, saturated_up_to(looker, reflectivity)};
      for (std::size_t i = 0; i < report_distances_m.size(); ++i) {
        const Seen seen = looker.at(report_distances_m[i], reflectivity);
        one.sigma_m[i] = seen.sigma_m, one.saturated[i] = seen.saturated;
      }
      out.noise.push_back(one);
    }
  }
}

/// Three digits of a length in millimetres.
std::string millimetres(double metres) {
  const double mm = 1e3 * metres;
  return fmt::format("{:.{}f}", mm, mm < 9.995 ? 2 : mm < 99.95 ? 1 : 0);
}

std::string noise_text(const CameraReport& report) {
  std::string text = fmt::format("  {:<18}", "range noise, mm");
  for (const double z : report_distances_m) text += fmt::format("{:>10}", fmt::format("{:g} m", z));
  text += "   saturates\n";
  bool low = false;
  for (const NoiseAtDistances& one : report.noise) {
    text += fmt::format("  {:>4.0f} % {:<11}", 100 * one.reflectivity, one.in_the_sun ? "in the sun" : "in the dark");
    for (std::size_t i = 0; i < one.sigma_m.size(); ++i) {
      const bool weak = !(one.sigma_m[i] <= report.low_signal_m);
      low = low || (weak && !one.saturated[i]);
      text += fmt::format("{:>10}", one.saturated[i]             ? "saturated"
                                    : std::isnan(one.sigma_m[i]) ? "-"
                                                                 : millimetres(one.sigma_m[i]) + (weak ? "*" : ""));
    }
    text += one.saturated_up_to_m >= farthest_m ? "   everywhere\n"
            : one.saturated_up_to_m > 0         ? fmt::format("   nearer than {:.2f} m\n", one.saturated_up_to_m)
                                                : "   nowhere\n";
  }
  if (low) text += fmt::format("  {:<18}* low signal: above {}\n", "", base::quantity_text(report.low_signal_m, "1 mm"));
  if (!report.knows_ambient)
    text += fmt::format("  {:<18}The mode has no unlit raw frame: the camera's own estimate (noise_m) leaves out what the sun adds.\n", "");
  return text;
}

}  // namespace

CameraReport camera_report(const Camera& profile) {
  Camera camera = base::as_read_out(profile);
  camera.auto_exposure = {};  // exposures of the mode
  CameraReport out;
  out.width = camera.sensor.width, out.height = camera.sensor.height;
  report_view(camera, out);
  const camera::Modulations modulations = camera::modulations_of(camera.mode);
  out.modulation_frequency_hz = modulations.frequency_hz;
  out.low_signal_m = camera.decoding.noise_threshold_m;
  report_light(coarser(camera), out);
  if (modulations.frequency_hz.empty()) return out;
  out.ambiguity_range_m = base::speed_of_light / camera.refractive_index / (2 * modulations.base_hz);
  out.knows_ambient = has_unlit(camera.mode);
  if (std::any_of(camera.illumination.begin(), camera.illumination.end(), [](const Illumination& one) { return one.power_w > 0; }))
    report_noise(camera, out);
  return out;
}

std::string report_text(const CameraReport& report) {
  const auto share = [](double part) { return part < 5e-4 ? std::string("less than 0.1 %") : fmt::format("{:.1f} %", 100 * part); };
  const auto row = [](const char* what, const std::string& value) { return fmt::format("  {:<18}{}\n", what, value); };
  const std::string corners = std::isnan(report.diagonal_deg) ? "" : fmt::format(", {:.1f} deg from corner to corner", report.diagonal_deg);
  const std::string view = std::isnan(report.width_deg) || std::isnan(report.height_deg)
                               ? "wider than the lens model"
                               : fmt::format("{:.1f} x {:.1f} deg{}", report.width_deg, report.height_deg, corners);
  std::string text = row("field of view", view);
  text +=
      row("a pixel at 1 m", fmt::format("{} x {} mm on the axis", millimetres(report.pixel_width_m), millimetres(report.pixel_height_m)));
  if (report.outside > 0) text += row("outside the lens", share(report.outside) + " of the pixels have no ray");
  if (report.unlit > 0) text += row("unlit", share(report.unlit) + " of the pixels see nothing of the camera's light");
  if (report.darkest > 0)
    text += row("light on a wall", fmt::format("the darkest pixel gets {:.2g} % of the brightest one's", 100 * report.darkest));
  if (report.ambiguity_range_m > 0) {
    std::vector<std::string> frequencies;
    for (const double f : report.modulation_frequency_hz) frequencies.push_back(base::quantity_text(f, "1 MHz"));
    text += row("ambiguity range", fmt::format("{:.3f} m, by {}", report.ambiguity_range_m, base::listed(frequencies, "and")));
  }
  return report.noise.empty() ? text : text + noise_text(report);
}

files::Json report_json(const CameraReport& report) {
  const auto number = [](double value) { return std::isnan(value) ? files::Json() : files::Json(value); };
  files::Json json = files::Json::object(), frequencies = files::Json::array(), noise = files::Json::array();
  for (const double f : report.modulation_frequency_hz) frequencies.push(files::Json(f));
  for (const NoiseAtDistances& one : report.noise) {
    files::Json at = files::Json::array();
    for (std::size_t i = 0; i < one.sigma_m.size(); ++i)
      at.push(files::Json::object()
                  .set("z_m", report_distances_m[i])
                  .set("noise_m", number(one.sigma_m[i]))
                  .set("saturated", one.saturated[i]));
    noise.push(files::Json::object()
                   .set("reflectivity", one.reflectivity)
                   .set("ambient", one.in_the_sun ? "sun_am15" : "none")
                   .set("at", std::move(at))
                   .set("saturated_up_to_m", one.saturated_up_to_m));
  }
  return json.set("field_of_view_deg", files::Json::array().push(number(report.width_deg)).push(number(report.height_deg)))
      .set("diagonal_deg", number(report.diagonal_deg))
      .set("pixel_at_1_m_m", files::Json::array().push(report.pixel_width_m).push(report.pixel_height_m))
      .set("share_outside_lens", report.outside)
      .set("share_unlit", report.unlit)
      .set("darkest_over_brightest", report.darkest)
      .set("modulation_frequency_hz", std::move(frequencies))
      .set("ambiguity_range_m", report.ambiguity_range_m)
      .set("knows_ambient", report.knows_ambient)
      .set("noise", std::move(noise));
}

}  // namespace tofray::app
