// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "arrays.h"
#include "inputs.h"

/// One pixel's light, bounce by bounce. Ways of light are chosen by pixel, bounce and sample alone, so that frames with fewer bounces
/// follow the beginnings of the same ways: what a bounce adds is the difference of two frames, without error of chance between them.
namespace tofray::app {

/// What a file's frame was simulated from.
struct FrameOrigin {
  std::optional<Inputs> in;
  SimulatorOptions wanted;
  std::string unknown;  ///< why the scene cannot be made again, where there is none
};

/// The origin of a file of arrays, out of the manifest.json beside it, which has to list the file with these very bytes.
/// @param options  root, threads, backend and device; anything else comes from the manifest
FrameOrigin origin_of_file(const std::string& path, const Options& options);

/// Light that came by way of 1 + b surfaces, b = first … last.
struct BounceShare {
  int first = 0, last = 0;
  double share = 0;                 ///< of the electrons of all lit raw frames, 0 … 1
  std::vector<double> electrons;    ///< by raw frame, before the lens scatters them [e]
  std::vector<double> multipath_m;  ///< by raw frame: what it adds to the half path once all before it are there [m]  [theory: eq. 7.8]
};

struct PixelBounces {
  std::vector<BounceShare> list;  ///< direct light first; together gt_direct_e + gt_indirect_e and gt_multipath_m; may be empty
  std::string unknown;            ///< why it is empty although light bounced
};

/// Simulates with one bounce, two, …, until less than 1/1000 of the pixel's light is left; the last element has the rest. Frame number b
/// takes b/B of the time that the file's frame with its B bounces took. Empty where no light bounced.
PixelBounces pixel_bounces(const Arrays& arrays, const FrameOrigin& origin, int u, int v);

}  // namespace tofray::app
