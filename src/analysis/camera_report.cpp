// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/camera_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "analysis/reach.h"
#include "analysis/wrong_cycles.h"
#include "base/constants.h"
#include "base/limits.h"
#include "base/readout.h"
#include "base/text.h"
#include "base/units.h"
#include "camera/frozen_camera.h"
#include "camera/lens.h"
#include "tofray/error.h"
#include "tofray/simulator.h"
#include "tofray/stages.h"

namespace tofray {

namespace {

using base::pi;

constexpr double nearest_m = 0.05, farthest_m = NoiseAtDistances::everywhere_m;

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

/// The camera with its view in fewer pixels, where it has very many: shares of them are all that is asked for.
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

struct SeenWall {
  double sigma_m;
  bool saturated;
};
class Looker {
 public:
  Looker(const Camera& camera, const AmbientCase& light) : camera_(camera), simulator_(scene(light), camera, without_noise(Stage::depth)) {}
  SeenWall at(double z, double reflectivity) {
    const Depth depth = simulator_.frame(0, wall(camera_, z, reflectivity)).depth;
    return {static_cast<double>(depth.noise_m[0]), (depth.flags[0] & flag_saturated) != 0};
  }

 private:
  static Scene scene(const AmbientCase& light) {
    Scene out;
    out.ambient = light.ambient, out.camera.pose = light.pose;
    return out;
  }
  const Camera& camera_;
  Simulator simulator_;
};

/// The camera with one modulation frequency alone, and its unlit raw frames. Its lights are at the pupil: range and half path are the same then,
/// also where the range has wrapped to next to nothing.
Camera with_one_frequency(Camera camera, const camera::Modulations& modulations, std::size_t which) {
  std::vector<RawFrame> kept;
  for (std::size_t k = 0; k < modulations.of_raw_frame.size(); ++k) {
    const int of = modulations.of_raw_frame[k];
    if (of < 0 || of == static_cast<int>(which)) kept.push_back(camera.mode.sequence[k]);
  }
  camera.mode.sequence = kept;
  for (Illumination& one : camera.illumination) one.position = {0, 0, 0};
  return camera;
}

/// ℓ of a surface on the axis: light to surface to camera, with the lights where they are on the mean [m].
double path_length_on_the_axis(const Camera& camera, double z) {
  double power = 0, x = 0, y = 0, along = 0;
  for (const Illumination& one : camera.illumination) {
    power += one.power_w;
    x += one.power_w * one.position[0], y += one.power_w * one.position[1], along += one.power_w * one.position[2];
  }
  if (power > 0) x /= power, y /= power, along /= power;
  return z + std::sqrt(x * x + y * y + (z - along) * (z - along));
}

/// The table by which the camera takes wiggling out of a modulation frequency's phase.                    [theory: eq. 4.3]
class Correction {
 public:
  explicit Correction(const Camera& camera) {
    const camera::FrozenCamera frozen(camera, false, 0);
    const camera::DecoderView& decoder = frozen.decoder();
    for (int j = 0; j < decoder.wiggling_nodes; ++j) value_.push_back(static_cast<double>(decoder.modulation[0].wiggling[2 * j]));
  }
  /// φ by φ̂ [rad], not held to one turn.
  [[nodiscard]] double operator()(double measured) const {
    const double turns = measured / base::two_pi, nodes = static_cast<double>(value_.size());
    const double place = (turns - std::floor(turns)) * nodes, part = place - std::floor(place);
    const std::size_t node = std::min(static_cast<std::size_t>(place), value_.size() - 1), next = (node + 1) % value_.size();
    return measured + base::two_pi * ((1 - part) * value_[node] + part * value_[next]);
  }
  /// φ̂ by φ: by halving, since the one grows with the other.
  [[nodiscard]] double measured(double phase) const {
    double low = phase - 2 * base::two_pi, high = phase + 2 * base::two_pi;  // (corrections are within a turn, ψ_1 included)
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      ((*this)(middle) < phase ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  /// dφ/dφ̂ between two nodes, as the camera has it.
  [[nodiscard]] double slope(double measured) const {
    const double turns = measured / base::two_pi, nodes = static_cast<double>(value_.size());
    const std::size_t node = std::min(static_cast<std::size_t>((turns - std::floor(turns)) * nodes), value_.size() - 1);
    return 1 + (value_[(node + 1) % value_.size()] - value_[node]) * nodes;
  }

 private:
  std::vector<double> value_;  // φ − φ̂ in turns, at equidistant φ̂
};

/// Which share of the pixels is whole cycles off, by the noise that each modulation frequency has alone.
class WrongCycles {
 public:
  WrongCycles(const Camera& pixel, const AmbientCase& light) : pixel_(pixel), modulations_(camera::modulations_of(pixel.mode)) {
    const std::size_t count = modulations_.frequency_hz.size();
    if (count < 2) return;
    cameras_.reserve(count), alone_.reserve(count);  // (a Looker keeps its camera's address)
    for (std::size_t i = 0; i < count; ++i) {
      alone_.emplace_back(cameras_.emplace_back(with_one_frequency(pixel, modulations_, i)), light);
      corrections_.emplace_back(cameras_.back());
    }
  }
  double at(double z, double reflectivity) {
    if (alone_.empty()) return 0;
    const double length = path_length_on_the_axis(pixel_, z);
    std::vector<analysis::NoisyPhase> phases;
    for (std::size_t i = 0; i < alone_.size(); ++i) {
      const double per_metre = base::two_pi * modulations_.frequency_hz[i] * pixel_.refractive_index / base::speed_of_light;  // of ℓ
      const Correction& correction = corrections_[i];
      const double phase = per_metre * length, measured = correction.measured(phase);
      const double noise = alone_[i].at(z, reflectivity).sigma_m * 2 * per_metre;
      if (!std::isfinite(noise)) return 1;
      phases.push_back({noise / correction.slope(measured),
                        [&correction, measured](double error) { return correction(measured + error) - correction(measured); }});
    }
    return analysis::wrong_cycle_probability(phases, modulations_.cycles);
  }

 private:
  const Camera& pixel_;
  camera::Modulations modulations_;
  std::vector<Camera> cameras_;
  std::vector<Looker> alone_;
  std::vector<Correction> corrections_;
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

void report_noise(const Camera& camera, const CameraQuestion& question, CameraReport& out) {
  const Camera pixel = pixel_on_the_axis(camera);
  for (const AmbientCase& light : question.ambients) {
    Looker looker(pixel, light);
    WrongCycles cycles(pixel, light);
    for (const double reflectivity : question.reflectivities) {
      NoiseAtDistances one;
      one.reflectivity = reflectivity, one.ambient = light.name, one.saturated_up_to_m = saturated_up_to(looker, reflectivity);
      for (const double z : question.distances_m) {
        const SeenWall seen = looker.at(z, reflectivity);
        const bool no_phase = seen.saturated || std::isnan(seen.sigma_m);
        one.at.push_back({z, seen.sigma_m, no_phase ? std::nan("") : cycles.at(z, reflectivity), seen.saturated});
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
  const Camera pixel = pixel_on_the_axis(camera);
  const AmbientCase dark;
  const double share = Looker(pixel, dark).at(near_m, grey).saturated ? 0 : WrongCycles(pixel, dark).at(near_m, grey);
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
  Camera camera = base::as_read_out(profile);
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
