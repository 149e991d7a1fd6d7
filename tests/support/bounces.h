// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "tofray/simulator.h"

/// Frames of light that goes from surface to surface.
namespace tofray::test {

inline Frame frame_with_bounces(Scene scene, const Camera& camera, int bounces, int samples, unsigned long long seed = 0) {
  scene.transport.bounces = bounces, scene.transport.samples = samples, scene.transport.seed = seed;
  return Simulator(scene, camera, {.noise = Noise::off}).frame(0);
}

inline double sum_over(const std::vector<float>& values, std::size_t first, std::size_t last) {
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) sum += static_cast<double>(values[i]);
  return sum;
}

}  // namespace tofray::test
