// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "analysis/pixel_arrays.h"
#include "tofray/pixel.h"

namespace tofray {

namespace {

constexpr double little = 1e-3;  ///< of a pixel's light: bounces behind it are told together

/// The pixel's light up to some bounce, by raw frame.
struct Light {
  std::vector<double> direct_e, indirect_e, multipath_m;
};

Light light_of(const PixelArrays& arrays, std::size_t pixel) {
  Light out;
  const std::size_t pixels = static_cast<std::size_t>(arrays.width) * static_cast<std::size_t>(arrays.height);
  for (std::size_t k = 0; k < static_cast<std::size_t>(arrays.phases); ++k) {
    const std::size_t i = k * pixels + pixel;
    out.direct_e.push_back(arrays.at("gt_direct_e", i)), out.indirect_e.push_back(arrays.at("gt_indirect_e", i));
    out.multipath_m.push_back(arrays.at("gt_multipath_m", i));
  }
  return out;
}

double sum(const std::vector<double>& values) {
  double out = 0;
  for (const double value : values) out += std::isfinite(value) ? value : 0;
  return out;
}

/// What `to` has and `from` has not.
std::vector<double> difference(const std::vector<double>& to, const std::vector<double>& from) {
  std::vector<double> out;
  for (std::size_t i = 0; i < to.size(); ++i) out.push_back(to[i] - from[i]);
  return out;
}

/// The multipath of light that is direct alone: none, and none where there is no light.
std::vector<double> no_multipath(const Light& all) {
  std::vector<double> out;
  for (const double one : all.multipath_m) out.push_back(std::isnan(one) ? one : 0);
  return out;
}

bool any_number(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

bool bounced(const Light& all) { return sum(all.indirect_e) > 0 && any_number(all.direct_e) && any_number(all.multipath_m); }

}  // namespace

bool has_bounces(const PixelArrays& arrays, int u, int v) { return bounced(light_of(arrays, analysis::pixel_index(arrays, u, v))); }

PixelBounces pixel_bounces(const PixelArrays& arrays, std::uint64_t index, const Scene& of, const Camera& camera,
                           const SimulatorOptions& simulated, int u, int v, const std::function<void()>& each_done) {
  const std::size_t pixel = analysis::pixel_index(arrays, u, v);
  const Light all = light_of(arrays, pixel);
  const double total = sum(all.direct_e) + sum(all.indirect_e);
  PixelBounces out;
  if (!bounced(all)) return out;
  const auto add = [&](int first, int last, const Light& upto, const Light& before) {
    BounceShare one{first, last, 0, difference(upto.indirect_e, before.indirect_e), difference(upto.multipath_m, before.multipath_m)};
    one.share = sum(one.electrons) / total;
    out.shares.push_back(one);
  };
  Light before{all.direct_e, std::vector<double>(all.direct_e.size(), 0), no_multipath(all)};
  out.shares.push_back({0, 0, sum(all.direct_e) / total, before.direct_e, before.multipath_m});
  Scene scene = of;
  scene.transport.transient = {};
  const int most = scene.transport.bounces;
  // Where pixels had ways until they were enough, those of other bounces would be others: this pixel's number for all of them.
  const bool goes_on = scene.transport.max_samples > 0;
  const double ways = arrays.at("gt_path_count", pixel);
  if (goes_on && !(ways >= 1)) return {{}, "the frame does not say how many paths its light took: it lacks gt_path_count"};
  if (goes_on) {
    scene.transport.samples = static_cast<int>(std::min(ways, 65536.0));
    scene.transport.max_samples = 0, scene.transport.path_noise_m = 0;
  }
  const auto with_bounces = [&](int bounces) {
    scene.transport.bounces = bounces;
    const Frame frame = Simulator(scene, camera, simulated).frame(index);
    return light_of(pixel_arrays(frame), pixel);
  };
  for (int b = 1; b < most && sum(all.indirect_e) - sum(before.indirect_e) > little * total; ++b) {
    const Light upto = with_bounces(b);
    if (!std::equal(upto.direct_e.begin(), upto.direct_e.end(), all.direct_e.begin(), all.direct_e.end()))
      return {{}, "simulated again, the pixel has another direct light"};
    add(b, b, upto, before);
    before = upto;
    if (each_done) each_done();
  }
  add(out.shares.back().last + 1, most, goes_on ? with_bounces(most) : all, before);
  return out;
}

}  // namespace tofray
