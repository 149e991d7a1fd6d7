// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/pixel/pixel_patterns.h"

#include <algorithm>
#include <limits>

#include "base/constants.h"
#include "base/shared.h"
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
///                                                                                                       [theory: binned-patterns]
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

/// A pattern over the image; null where sigma is 0.
std::shared_ptr<const std::vector<float>> drawn(PatternKey key, double sigma, double mean, double least, std::uint32_t stream) {
  if (sigma == 0) return nullptr;
  key.sigma = sigma, key.mean = mean, key.least = least, key.stream = stream;
  return base::shared<PatternKey, std::vector<float>>().get(
      key, [&] { return pattern(key); }, [](const std::vector<float>& map) { return map.size() * sizeof(float); });
}

/// The streams' names: "PRNU", "DSNU", "DELA" in ASCII, and "PH", which has the modulation's number after it.
constexpr std::uint32_t prnu = 0x50524e55, dsnu = 0x44534e55, delays = 0x44454c41, phases = 0x50480000;

}  // namespace

PixelPatterns::PixelPatterns(const Camera& profile, const ImageCamera& camera, const Modulations& modulations) {
  const Pixel& pixel = profile.pixel;
  const Readout& readout = profile.readout;
  pixels_ = static_cast<std::size_t>(camera.sensor.width) * static_cast<std::size_t>(camera.sensor.height);
  const PatternKey of{0,
                      0,
                      0,
                      0,
                      pixel.pattern_seed,
                      profile.sensor.width,
                      readout.left,
                      readout.top,
                      readout.binning,
                      camera.sensor.width,
                      camera.sensor.height};
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const int together = readout.binning * readout.binning;
  gain_ = drawn(of, pixel.prnu, 1, 0, prnu);
  offset_ = drawn(of, pixel.dsnu_dn * together, 0, -infinite, dsnu);  // offsets are charge, which adds
  delay_ = drawn(of, pixel.delay_s, 0, -infinite, delays);
  if (pixel.phase_offset_rad == 0) return;
  // A phase at one modulation frequency is a delay there.                                              [theory: phase-offset]
  for (std::size_t j = 0; j < modulations.frequency_hz.size(); ++j) {
    const Map phase = drawn(of, pixel.phase_offset_rad, 0, -infinite, phases + static_cast<std::uint32_t>(j));
    for (std::size_t i = 0; i < pixels_; ++i) {
      const double delay = delay_ == nullptr ? 0.0 : static_cast<double>((*delay_)[i]);
      late_.push_back(single(delay + static_cast<double>((*phase)[i]) / (2 * pi * modulations.frequency_hz[j])));
    }
  }
}

void PixelPatterns::set(SensorView& sensor) const {
  const auto data = [](const Map& map) { return map == nullptr ? nullptr : map->data(); };
  sensor.gain = data(gain_), sensor.offset = data(offset_), sensor.delay = data(delay_);
  if (late_.empty()) return;
  sensor.delay = late_.data(), sensor.delay_stride = static_cast<std::int32_t>(pixels_);
}

}  // namespace tofray::camera
