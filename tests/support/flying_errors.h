// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "tofray/load.h"
#include "tofray/tofray.h"

/// Both errors of the check for flying pixels: what it takes away from a surface, and what it leaves of edges. Used by tests and by the
/// program that makes the table of docs/theory/04-depth.md.
namespace tofray::test {

/// pico-flexx, nine raw frames, as fast as its mode allows.
inline Camera flying_camera(double integration_time_s) {
  Camera camera = load_camera("pico-flexx", {.mode = "MODE_9_5FPS_2000"});
  for (RawFrame& raw : camera.mode.sequence)
    if (raw.lit) raw.integration_time_s = integration_time_s;
  return camera;
}

/// A wall that faces the camera; with a step, a triangle stands before it, whose three edges have three tilts.
inline Scene wall_at(double z, double reflectivity, double step = 0) {
  Scene scene = load_scene("card");
  std::get<Plane>(scene.objects[0].shape).point = {0, 0, z + step};
  scene.materials[static_cast<std::size_t>(scene.objects[0].material)].diffuse = reflectivity;
  if (step <= 0) return scene;
  Object front = scene.objects[0];
  front.shape = Triangle{{{{-0.35 * z, -0.28 * z, z}, {0.38 * z, -0.1 * z, z}, {-0.05 * z, 0.3 * z, z}}}};
  front.name = "front";
  scene.objects.push_back(front);
  return scene;
}

struct FlatLoss {
  double valid = 0, low_signal = 0;
  double valid_middle = 0;  ///< of the pixels in the middle half of rows and columns, where there is light
  double flying = 0;        ///< of all pixels, those that fly though nothing else is wrong with them
  double flat = 0;          ///< flying pixels whose z is within 5σ̂ + limit of the wall: noise, taken for an edge
};

/// Shares of all pixels of a wall, over some frames.
inline FlatLoss flat_loss(const Camera& camera, double z, double reflectivity, int frames) {
  Simulator simulator(wall_at(z, reflectivity), camera, {.seed = 11, .truth = false});
  Camera unchecked = camera;
  unchecked.decoding.flying_check = false;
  Simulator plain(wall_at(z, reflectivity), unchecked, {.seed = 11, .truth = false});
  FlatLoss out;
  double all = 0, middle = 0;
  const std::size_t width = static_cast<std::size_t>(camera.sensor.width), height = static_cast<std::size_t>(camera.sensor.height);
  const auto in_middle = [](std::size_t i, std::size_t n) { return i >= n / 4 && i < n - n / 4; };
  for (int n = 0; n < frames; ++n) {
    const Depth got = simulator.frame(static_cast<std::uint64_t>(n)).depth, raw = plain.frame(static_cast<std::uint64_t>(n)).depth;
    all += static_cast<double>(got.flags.size());
    for (std::size_t i = 0; i < got.flags.size(); ++i) {
      const double valid = (got.flags[i] & flags_invalid) == 0 ? 1 : 0;
      out.valid += valid, out.low_signal += (got.flags[i] & flag_low_signal) != 0 ? 1 : 0;
      if (in_middle(i % width, width) && in_middle(i / width, height)) out.valid_middle += valid, middle += 1;
      if ((got.flags[i] & flags_invalid) != flag_flying_pixel) continue;
      out.flying += 1;
      out.flat += std::abs(static_cast<double>(raw.z_m[i]) - z) < 5 * static_cast<double>(raw.noise_m[i]) + 0.14 ? 1 : 0;
    }
  }
  out.valid /= all, out.low_signal /= all, out.flying /= all, out.flat /= all, out.valid_middle /= middle;
  return out;
}

/// The limit on |Δz| by itself, in double.                                                    [theory: flying-pixel-limit]
inline double step_limit(double z) { return 0.018 + (0.14 - 0.018) * std::clamp((z - 1) / 3.5, 0.0, 1.0); }

struct EdgesFound {
  double mixed = 0;   ///< pixels that see both
  double flying = 0;  ///< pixels that see both, whose z without noise is off from both by more than the limit
  double quiet = 0;   ///< share of those that are found where there is no noise
  double noisy = 0;   ///< share of those that are found where there is noise, or are invalid for another reason
};

/// With 9 samples in each pixel.
inline EdgesFound edges_found(const Camera& camera, double z, double reflectivity, double step, int frames) {
  const Scene scene = wall_at(z, reflectivity, step);
  Camera unchecked = camera;
  unchecked.decoding.flying_check = false;
  const Frame truth = Simulator(scene, unchecked, {.noise = Noise::off, .subpixel = 3}).frame(0);
  const Depth quiet = Simulator(scene, camera, {.noise = Noise::off, .truth = false, .subpixel = 3}).frame(0).depth;
  Simulator simulator(scene, camera, {.seed = 12, .truth = false, .subpixel = 3});
  EdgesFound out;
  const auto flies = [&](std::size_t i) {
    const double here = static_cast<double>(truth.depth.z_m[i]);
    return truth.truth.mixed[i] != 0 && std::abs(here - z) > step_limit(here) && std::abs(here - z - step) > step_limit(here);
  };
  for (std::size_t i = 0; i < quiet.flags.size(); ++i) {
    out.mixed += truth.truth.mixed[i];
    if (!flies(i)) continue;
    out.flying += 1, out.quiet += (quiet.flags[i] & flags_invalid) != 0 ? 1 : 0;
  }
  for (int n = 0; n < frames; ++n) {
    const Depth got = simulator.frame(static_cast<std::uint64_t>(n)).depth;
    for (std::size_t i = 0; i < got.flags.size(); ++i) out.noisy += flies(i) && (got.flags[i] & flags_invalid) != 0 ? 1 : 0;
  }
  out.quiet /= out.flying, out.noisy /= out.flying * frames;
  return out;
}

}  // namespace tofray::test
