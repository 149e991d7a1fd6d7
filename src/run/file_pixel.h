// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "results/file_arrays.h"
#include "run/inputs.h"
#include "tofray/pixel.h"

/// One pixel of a frame that lies in a file.
namespace tofray::run {

PixelArrays pixel_arrays(const results::Arrays& arrays);

/// Its way from light to depth; the camera is the one in `meta`. What a file does not have is NaN or empty.
/// @throws Error (bad_input) where the pixel is outside the image, or the camera in `meta` is another one
PixelChain pixel_chain(const results::Arrays& arrays, int u, int v);

/// What the scene in `meta` calls an object: its name, or its shape; empty where it says nothing.
std::string object_name(const files::Json& meta, std::int64_t object);

/// What a file's frame was simulated from.
struct FrameOrigin {
  std::optional<Loaded> in;
  SimulatorOptions simulated;
  std::string unknown;  ///< why the scene cannot be made again, where there is none
};

/// The origin of a file of arrays, out of the manifest.json beside it, which has to list the file with these very bytes.
/// @param root       for meshes and keyframes that the scene names
/// @param simulated  threads, backend and device; all else comes from the manifest
FrameOrigin origin_of_file(const std::string& path, const std::string& root, const SimulatorOptions& simulated);

/// As the function of that name in tofray/pixel.h; where nobody knows the origin, it says why.
PixelBounces pixel_bounces(const results::Arrays& arrays, const FrameOrigin& origin, int u, int v,
                           const std::function<void()>& each_done = {});

}  // namespace tofray::run
