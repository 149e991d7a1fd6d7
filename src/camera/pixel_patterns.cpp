// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Gains, offsets, delays and phases that differ from pixel to pixel.                                    [theory: eq. 3.17, 4.26]
#include <algorithm>
#include <limits>

#include "base/constants.h"
#include "base/shared.h"
#include "camera/frozen_camera.h"
#include "num/philox.h"
#include "num/setup_math.h"

namespace tofray::camera {

using base::pi;
using num::single;

namespace {

/// What a pattern over the image depends on.
struct PatternKey {
  double sigma, mean, least;
  std::uint32_t stream;
  std::uint64_t seed;
  int sensor_width, left, top, binning;
  int width, height;  ///< of the image
  bool operator==(const PatternKey&) const = default;
};

/// Of pixels of the specimen, each one its own draw from a stream of the sensor's seed; the mean over those that are read together.
///                                                                                                              [theory: eq. 4.26]
std::vector<float> pattern(const PatternKey& of) {
  const auto keys = num::round_keys(static_cast<std::uint32_t>(of.seed), static_cast<std::uint32_t>(of.seed >> 32));
  const auto of_pixel = [&](int x, int y) {
    const auto words = num::philox<float>(static_cast<std::uint32_t>(y * of.sensor_width + x), of.stream, 0, 0, keys);
    float z, other;
    num::normal_pair<float>(words.w[0], words.w[1], z, other);
    return std::max(of.mean + of.sigma * static_cast<double>(z), of.least);
  };
  const int n = of.binning;
  std::vector<float> map;
  for (int y = 0; y < of.height; ++y) {
    for (int x = 0; x < of.width; ++x) {
      double sum = 0;
      for (int i = 0; i < n * n; ++i) sum += of_pixel(of.left + x * n + i % n, of.top + y * n + i / n);
      map.push_back(single(sum / (n * n)));
    }
  }
  return map;
}

}  // namespace

FrozenCamera::Map FrozenCamera::drawn(double sigma, double mean, double least, std::uint32_t stream) const {
  if (sigma == 0) return nullptr;
  const PatternKey key{sigma,
                       mean,
                       least,
                       stream,
                       one_pixel_.pattern_seed,
                       sensor_pixels_.width,
                       readout_.left,
                       readout_.top,
                       readout_.binning,
                       camera_.sensor.width,
                       camera_.sensor.height};
  return base::shared<PatternKey, std::vector<float>>().get(
      key, [&] { return pattern(key); }, [](const std::vector<float>& map) { return map.size() * sizeof(float); });
}

void FrozenCamera::freeze_patterns() {
  const Pixel& pixel = one_pixel_;
  const std::size_t pixels = static_cast<std::size_t>(camera_.sensor.width) * static_cast<std::size_t>(camera_.sensor.height);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto data = [](const Map& map) { return map == nullptr ? nullptr : map->data(); };
  const int together = readout_.binning * readout_.binning;
  gain_ = drawn(pixel.prnu, 1, 0, 0x50524e55);
  offset_ = drawn(pixel.dsnu_dn * together, 0, -infinite, 0x44534e55);  // offsets are charge, which adds
  delay_ = drawn(pixel.delay_s, 0, -infinite, 0x44454c41);
  sensor_.gain = data(gain_), sensor_.offset = data(offset_), sensor_.delay = data(delay_);
  if (pixel.phase_offset_rad == 0 || modulations_.frequency_hz.empty()) return;
  // A phase at one modulation frequency is a delay there.                                                  [theory: eq. 3.17]
  for (std::size_t j = 0; j < modulations_.frequency_hz.size(); ++j) {
    const Map phase = drawn(pixel.phase_offset_rad, 0, -infinite, 0x50480000u + static_cast<std::uint32_t>(j));
    for (std::size_t i = 0; i < pixels; ++i) {
      const double delay = delay_ == nullptr ? 0.0 : static_cast<double>((*delay_)[i]);
      late_.push_back(single(delay + static_cast<double>((*phase)[i]) / (2 * pi * modulations_.frequency_hz[j])));
    }
  }
  sensor_.delay = late_.data(), sensor_.delay_stride = static_cast<std::int32_t>(pixels);
}

}  // namespace tofray::camera
