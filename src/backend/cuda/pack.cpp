// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cuda/pack.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "backend/cuda/pixel.h"

namespace tofray::backend::gpu {

namespace {

std::size_t count_of(std::int32_t number) { return static_cast<std::size_t>(number); }

template <class Forms>
Forms packed(Packer& packer, const Forms& from) {
  Forms to = from;
  to.planes = packer.put(from.planes, count_of(from.plane_count));
  to.spheres = packer.put(from.spheres, count_of(from.sphere_count));
  to.boxes = packer.put(from.boxes, count_of(from.box_count));
  to.triangles = packer.put(from.triangles, count_of(from.triangle_count));
  return to;
}

/// An array of forms, and what each points to.
template <class Forms>
const Forms* packed(Packer& packer, const Forms* from, std::int32_t count) {
  if (from == nullptr) return nullptr;
  std::vector<Forms> to;
  for (std::int32_t i = 0; i < count; ++i) to.push_back(packed(packer, from[i]));
  return packer.put(static_cast<const Forms*>(to.data()), to.size());
}

/// What each patch of pixels sees.
std::vector<flow::Bounds> patch_bounds(const camera::LensView& lens) {
  constexpr float far = std::numeric_limits<float>::max();
  std::vector<flow::Bounds> out(count_of(patch_count(lens)), flow::Bounds{far, -far, far, -far});
  for (int y = 0; y < lens.height; ++y) {
    for (int x = 0; x < lens.width; ++x) {
      flow::Bounds& b = out[count_of(y / patch_height * patches_across(lens) + x / patch_width)];
      const std::size_t i = count_of(y) * count_of(lens.width) + count_of(x);
      b = {std::min(b.x_min, lens.ray_x[i]), std::max(b.x_max, lens.ray_x[i]), std::min(b.y_min, lens.ray_y[i]), std::max(b.y_max, lens.ray_y[i])};
    }
  }
  return out;
}

}  // namespace

void pack_camera(Packer& packer, const pipeline::Setup& from, pipeline::Setup& to) {
  const std::size_t pixels = count_of(from.lens.width) * count_of(from.lens.height);
  to.lens.ray_x = packer.put(from.lens.ray_x, pixels), to.lens.ray_y = packer.put(from.lens.ray_y, pixels);
  to.lens.inverse_length = packer.put(from.lens.inverse_length, pixels);
  to.lens.vignetting = packer.put(from.lens.vignetting, pixels);
  const std::vector<flow::Bounds> patches = patch_bounds(from.lens);
  to.lens.tile = packer.put(patches.data(), patches.size());
  for (int l = 0; l < flow::max_lights; ++l) {
    const camera::PatternView& pattern = from.lights[l].pattern;
    to.lights[l].pattern.samples = packer.put(pattern.samples, count_of(pattern.columns) * count_of(pattern.rows));
  }
  to.sensor.gain = packer.put(from.sensor.gain, pixels), to.sensor.offset = packer.put(from.sensor.offset, pixels);
  to.sensor.delay = packer.put(from.sensor.delay, pixels), to.decoder.delay = packer.put(from.decoder.delay, pixels);
  for (int i = 0; i < from.decoder.modulations; ++i) {
    to.decoder.modulation[i].wiggling = packer.put(from.decoder.modulation[i].wiggling, 2 * count_of(from.decoder.wiggling_nodes));
  }
}

void pack_still(Packer& packer, const scene::SceneView& from, scene::SceneView& to) {
  to.camera_still = packed(packer, from.camera_still);
  to.light_still = packed(packer, from.light_still, from.lights);
  to.sun_still = packed(packer, from.sun_still);
}

void pack_moving(Packer& packer, const scene::SceneView& from, scene::SceneView& to) {
  to.facets = packer.put(from.facets, count_of(from.facet_count));
  to.camera_moving = packed(packer, from.camera_moving, from.slots);
  to.light_moving = packed(packer, from.light_moving, from.slots * from.lights);
  to.sun_moving = packed(packer, from.sun_moving, from.slots);
}

}  // namespace tofray::backend::gpu
