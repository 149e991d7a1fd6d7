// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dataset/accept.h"

#include <algorithm>
#include <cmath>

#include "dataset/placing.h"
#include "tofray/load.h"
#include "tofray/simulator.h"

namespace tofray::dataset {

namespace {

constexpr int step = 4;  ///< of the camera's columns and rows one is looked at

/// The camera with fewer pixels of the same size, through a lens that is shorter by as much: each sees what 4 x 4 of them see, as brightly as one.
Camera coarse(Camera camera) {
  const Readout& read = camera.readout;
  const bool cut = read.binning != 1 || read.left != 0 || read.top != 0 || read.width != 0 || read.height != 0;
  if (cut || camera.sensor.width < 8 * step || camera.sensor.height < 8 * step) return camera;
  camera.sensor.width /= step, camera.sensor.height /= step;
  camera.lens.fx_px /= step, camera.lens.fy_px /= step;
  camera.lens.cx_px = (camera.lens.cx_px + 0.5) / step - 0.5, camera.lens.cy_px = (camera.lens.cy_px + 0.5) / step - 0.5;
  return camera;
}

}  // namespace

std::optional<std::size_t> broken_rule(const Scene& said, std::uint64_t seed, const std::vector<AcceptRule>& rules) {
  Scene scene = said;
  scene.transport.bounces = 0;
  const Camera whole = load_camera(scene), camera = coarse(whole);
  SimulatorOptions options;
  options.seed = seed, options.threads = 1, options.backend = Backend::cpu, options.arrays = {"z_m", "gt_object_id"};
  const Frame frame = Simulator(scene, camera, options).frame(0);
  const std::size_t pixels = frame.depth.z_m.size();
  const auto valid =
      static_cast<std::size_t>(std::count_if(frame.depth.z_m.begin(), frame.depth.z_m.end(), [](float z) { return std::isfinite(z); }));
  // How many pixels of the whole image one of these stands for.
  const double each =
      static_cast<double>(whole.sensor.width) * whole.sensor.height / (static_cast<double>(camera.sensor.width) * camera.sensor.height);
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const AcceptRule& rule = rules[i];
    if (rule.seen.empty()) {
      if (static_cast<double>(valid) < rule.valid * static_cast<double>(pixels)) return i;
      continue;
    }
    std::vector<bool> meant(scene.objects.size(), false);
    for (std::size_t k = 0; k < meant.size(); ++k) meant[k] = is_called(scene.objects[k].name, rule.seen);
    const auto seen = std::count_if(frame.truth.object_id.begin(), frame.truth.object_id.end(),
                                    [&](std::int32_t id) { return id >= 0 && meant[static_cast<std::size_t>(id)]; });
    if (each * static_cast<double>(seen) < static_cast<double>(rule.pixels)) return i;
  }
  return {};
}

}  // namespace tofray::dataset
