// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pixel_bounces.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text.h"
#include "base/version.h"
#include "files/data_limits.h"
#include "files/read_bytes.h"
#include "files/sha256.h"
#include "progress.h"
#include "recall.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

constexpr double little = 1e-3;  ///< of a pixel's light: bounces behind it are told together

/// The pixel's light up to some bounce, by raw frame.
struct Light {
  std::vector<double> direct_e, indirect_e, multipath_m;
};

double at(const std::vector<float>& array, std::size_t i) { return i < array.size() ? static_cast<double>(array[i]) : std::nan(""); }

/// @param of  (name or array, element) → number
template <class Of>
Light light_of(std::size_t raw_frames, std::size_t pixels, std::size_t pixel, const Of& of) {
  Light out;
  for (std::size_t k = 0; k < raw_frames; ++k) {
    const auto [direct, indirect, multipath] = of(k * pixels + pixel);
    out.direct_e.push_back(direct), out.indirect_e.push_back(indirect), out.multipath_m.push_back(multipath);
  }
  return out;
}

Light light_of(const Arrays& arrays, std::size_t pixel) {
  return light_of(arrays.phases(), arrays.width() * arrays.height(), pixel, [&](std::size_t i) {
    return std::array{arrays.at("gt_direct_e", i), arrays.at("gt_indirect_e", i), arrays.at("gt_multipath_m", i)};
  });
}

Light light_of(const Frame& frame, std::size_t pixel) {
  const Truth& truth = frame.truth;
  return light_of(frame.raw.lit.size(), static_cast<std::size_t>(truth.width) * static_cast<std::size_t>(truth.height), pixel,
                  [&](std::size_t i) {
                    return std::array{at(truth.direct_e, i), at(truth.indirect_e, i), at(truth.multipath_m, i)};
                  });
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

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Whether a manifest lists a file with these bytes.
bool lists(const results::Manifest& manifest, const std::filesystem::path& path) {
  const std::string name = path.filename().native();
  const auto record = std::find_if(manifest.files.begin(), manifest.files.end(), [&](const auto& one) { return one.name == name; });
  return record != manifest.files.end() && record->sha256 == files::sha256_hex(files::read_bytes(path, files::max_data_file_bytes));
}

std::uint64_t index_of(const Arrays& arrays) {
  const files::Json* found = arrays.meta().find("frame");
  double index = 0;
  if (found != nullptr) found->number(index);
  return index >= 0 && index < 9e15 ? static_cast<std::uint64_t>(index) : 0;
}

}  // namespace

FrameOrigin origin_of_file(const std::string& path, const Options& options) {
  FrameOrigin out;
  Options now;
  now.root = options.root, now.threads = options.threads, now.backend = options.backend, now.device = options.device;
  now.from = std::filesystem::path(path).replace_filename("manifest.json").native();
  try {
    if (!std::filesystem::exists(now.from)) {
      out.unknown = fmt::format("the scene is in manifest.json, which is not beside {}", path);
      return out;
    }
    const results::Manifest manifest = results::read_manifest(now.from);
    if (!lists(manifest, path)) {
      out.unknown = fmt::format("{} does not list {} with the bytes that it has", now.from, path);
    } else if (manifest.tofray_version != base::version()) {
      out.unknown = fmt::format("tofray {} made {}, this is {}", manifest.tofray_version, path, base::version());
    } else {
      const Options then = recalled(now, manifest);
      out.in = inputs_of(manifest, then);
      out.wanted = simulator_options(then);
    }
  } catch (const Error& error) {
    out.unknown = first_line(error.what());
  }
  return out;
}

PixelBounces pixel_bounces(const Arrays& arrays, const FrameOrigin& origin, int u, int v) {
  const std::size_t pixel = static_cast<std::size_t>(v) * arrays.width() + static_cast<std::size_t>(u);
  const Light all = light_of(arrays, pixel);
  const double total = sum(all.direct_e) + sum(all.indirect_e);
  PixelBounces out;
  if (!(sum(all.indirect_e) > 0) || arrays.find("gt_direct_e") == nullptr || arrays.find("gt_multipath_m") == nullptr) return out;
  out.unknown = origin.unknown;
  if (!origin.in) return out;
  const auto add = [&](int first, int last, const Light& upto, const Light& before) {
    BounceShare one{first, last, 0, difference(upto.indirect_e, before.indirect_e), difference(upto.multipath_m, before.multipath_m)};
    one.share = sum(one.electrons) / total;
    out.list.push_back(one);
  };
  Light before{all.direct_e, std::vector<double>(all.direct_e.size(), 0), no_multipath(all)};
  out.list.push_back({0, 0, sum(all.direct_e) / total, before.direct_e, before.multipath_m});
  Scene scene = origin.in->scene;
  scene.transport.transient = {};
  const int most = scene.transport.bounces;
  FrameProgress now;
  SimulatorOptions wanted = origin.wanted;
  wanted.progress = &now;
  Progress progress(static_cast<std::uint64_t>(most), "bounces", false, &now);
  // Where pixels had ways until they were enough, those of other bounces would be others: this pixel's number for all of them.
  const bool goes_on = scene.transport.max_samples > 0;
  const double ways = arrays.at("gt_path_count", pixel);
  if (goes_on && !(ways >= 1)) return {{}, "the file does not say how many ways its light took: it lacks gt_path_count"};
  if (goes_on) {
    scene.transport.samples = static_cast<int>(std::min(ways, 65536.0));
    scene.transport.max_samples = 0, scene.transport.path_noise_m = 0;
  }
  const auto simulated = [&](int bounces) {
    scene.transport.bounces = bounces;
    return light_of(Simulator(scene, origin.in->camera, wanted).frame(index_of(arrays)), pixel);
  };
  for (int b = 1; b < most && sum(all.indirect_e) - sum(before.indirect_e) > little * total; ++b) {
    const Light upto = simulated(b);
    if (!std::equal(upto.direct_e.begin(), upto.direct_e.end(), all.direct_e.begin(), all.direct_e.end()))
      return {{}, "simulated again, the pixel has another direct light than in the file"};
    add(b, b, upto, before);
    before = upto;
    progress.step();
  }
  add(out.list.back().last + 1, most, goes_on ? simulated(most) : all, before);
  return out;
}

}  // namespace tofray::app
