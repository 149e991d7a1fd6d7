// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Both errors of the check for flying pixels, as the table of docs/theory/04-depth.md: share of a wall's pixels that are lost, share of the
// edges' flying pixels that are found, against distance and integration time, by the limit alone (k = 0), with noise looked at (k = 4), and that after the
// adaptive filter over 25 pixels at most.
#include <fmt/core.h>

#include <cstdio>

#include "support/flying_errors.h"

using namespace tofray;
using namespace tofray::test;

int main() {
  constexpr int frames = 4;
  constexpr double reflectivity = 0.3, step = 0.3;
  fmt::print(
      "| z | exposure | low signal | valid, k = 0 | valid, k = 4 | flat lost, k = 4 | edges found, quiet | k = 0 | k = 4 | k = 4, adaptive "
      "|\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|\n");
  for (const double z : {0.5, 1.0, 1.5, 2.0}) {
    for (const double microseconds : {2000.0, 1000.0, 700.0, 450.0}) {
      Camera camera = flying_camera(1e-6 * microseconds), by_limit = camera, filtered = camera;
      by_limit.decoding.flying_sigmas = 0;
      filtered.decoding.filter.kind = ImageFilter::Kind::adaptive, filtered.decoding.filter.radius_px = 2;
      const FlatLoss before = flat_loss(by_limit, z, reflectivity, frames), after = flat_loss(camera, z, reflectivity, frames);
      const EdgesFound all = edges_found(by_limit, z, reflectivity, step, frames),
                       some = edges_found(camera, z, reflectivity, step, frames);
      fmt::print("| {} m | {:.0f} µs | {:.1f} % | {:.1f} % | {:.1f} % | {:.4f} % | {:.0f} % of {:.0f} | {:.0f} % | {:.0f} % | {:.0f} % |\n",
                 z, microseconds, 100 * after.low_signal, 100 * before.valid, 100 * after.valid, 100 * after.flat, 100 * some.quiet,
                 some.flying, 100 * all.noisy, 100 * some.noisy, 100 * edges_found(filtered, z, reflectivity, step, frames).noisy);
      std::fflush(stdout);
    }
  }
}
