// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/exposure_control.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "num/setup_math.h"
#include "tofray/error.h"

namespace tofray::simulator {

namespace {

constexpr double most_change = 4;  // of a frame's times to the next one's, either way, at full speed
constexpr std::uint64_t most_frames = 1'000'000;
constexpr float saturates = 1e3f;  // stands for all that lies beyond the valid codes

}  // namespace

ExposureControl::ExposureControl(const Camera& camera, Stage last) : law_(camera.auto_exposure), mode_(camera.mode.sequence) {
  if (!on()) return;
  if (last < Stage::raw)
    throw Error(ErrorKind::bad_input,
                "error: exposures that follow the light need raw frames, and the last stage comes before them\n"
                "  set auto_exposure.speed to 0, or last_stage to raw");
  for (const RawFrame& raw : mode_) {
    if (raw.lit) of_mode_ = std::max(of_mode_, raw.integration_time_s);
  }
  if (!(law_.longest_s > 0)) law_.longest_s = of_mode_;
  law_.shortest_s = std::max(law_.shortest_s, camera.min_integration_time_s);
  longest_.push_back(std::clamp(of_mode_, law_.shortest_s, law_.longest_s));
}

void ExposureControl::check(std::uint64_t index) const {
  if (!on() || index < most_frames) return;
  throw Error(ErrorKind::limit, "error: exposures that follow the light begin with frame 0, and frame " + std::to_string(index) +
                                    " is too far from it\n  at most frame " + std::to_string(most_frames - 1) +
                                    "; begin earlier, or set auto_exposure.speed to 0");
}

std::vector<double> ExposureControl::times_of(std::uint64_t index) const {
  const double scale = longest_[static_cast<std::size_t>(index)] / of_mode_;
  std::vector<double> out;
  for (const RawFrame& raw : mode_) out.push_back(raw.lit ? scale * raw.integration_time_s : raw.integration_time_s);
  return out;
}

void ExposureControl::follow(const camera::SensorView& sensor, const flow::FrameView& frame, const Metered& pixels) {
  const double bright = brightness(sensor, frame, pixels, law_.bright);
  const double step = std::clamp(law_.aim / std::max(bright, 1e-9), 1 / most_change, most_change);
  longest_.push_back(std::clamp(longest_.back() * num::setup::pow(step, law_.speed), law_.shortest_s, law_.longest_s));
}

double brightness(const camera::SensorView& sensor, const flow::FrameView& frame, const Metered& pixels, double bright) {
  const pipeline::Region all{0, 0, pixels.width, pixels.height}, region = pixels.region.width > 0 ? pixels.region : all;
  const auto size = [](std::int32_t a) { return static_cast<std::size_t>(a); };
  std::vector<float> used(size(region.width) * size(region.height), 0.0f);
  const float lower = sensor.valid_middle - sensor.valid_half, upper = sensor.valid_middle + sensor.valid_half;
  const float reach = std::min(sensor.mid_code - lower, upper - sensor.mid_code);
  for (int k = 0; k < sensor.raw_frames; ++k) {
    if (sensor.frame[k].lit == 0) continue;
    const std::size_t first = (size(k) * size(pixels.height) + size(region.top)) * size(pixels.width) + size(region.left);
    for (std::size_t i = 0; i < used.size(); ++i) {
      const std::size_t at = first + i / size(region.width) * size(pixels.width) + i % size(region.width);
      const float code = static_cast<float>(frame.raw[at]);
      const float fill = std::max(frame.tap_a[at], frame.tap_b[at]) / sensor.full_read;
      const bool beyond = code < lower || code > upper || code <= 0 || code >= sensor.max_code;
      const float share = std::max(std::abs(code - sensor.mid_code) / reach, fill);
      used[i] = std::max(used[i], fill >= 1 || beyond || !(reach > 0) ? saturates : share);
    }
  }
  const auto at = static_cast<std::ptrdiff_t>(std::floor(bright * static_cast<double>(used.size() - 1)));
  std::nth_element(used.begin(), used.begin() + at, used.end());
  return static_cast<double>(used[static_cast<std::size_t>(at)]);
}

}  // namespace tofray::simulator
