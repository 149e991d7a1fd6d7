// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/light_memory.h"

#include "pipeline/gather.h"

namespace tofray::backend {

namespace {

std::size_t pixels_of(const pipeline::Setup& setup) {
  return static_cast<std::size_t>(setup.lens.width) * static_cast<std::size_t>(setup.lens.height);
}

Stage entry_of(const pipeline::Input* input) { return input == nullptr ? Stage::trace : input->entry; }

/// Of which the image keeps the light.
int times_of(const pipeline::Setup& setup, const pipeline::Input* input) {
  if (input != nullptr) return input->moments;
  return setup.scene.moments > 0 ? setup.sensor.raw_frames : 1;
}

}  // namespace

std::size_t place_light(const pipeline::Setup& setup, const flow::FrameView& wanted, const pipeline::Input* input, unsigned char* base,
                        flow::LightImage& image) {
  image = {};
  if (!pipeline::has_light_image(setup, entry_of(input))) return 0;
  std::size_t used = 0;
  const auto put = [&]<class T>(T*& array, std::size_t count) {
    if (base != nullptr) array = reinterpret_cast<T*>(base + used);
    used += (count * sizeof(T) + 255) / 256 * 256;
  };
  image.times = times_of(setup, input);
  const std::size_t pixels = pixels_of(setup);
  const std::size_t values =
      static_cast<std::size_t>(image.times) * static_cast<std::size_t>(pipeline::light_planes(setup, image.times)) * pixels;
  const bool compared = input == nullptr && pipeline::wants_mixed(setup, wanted);
  const std::size_t all = values + (compared ? flow::compared_planes * pixels : 0);
  put(image.values, all);
  const bool several = input == nullptr && setup.subpixel.lens != nullptr, bounces = pipeline::bounces(setup, entry_of(input));
  if (several || bounces) put(image.before, all);
  if (bounces) put(image.indirect, values);
  if (bounces && several) put(image.indirect_before, values);
  if (setup.scatter.terms > 0) put(image.rows, values), put(image.scattered, values);
  if (compared) put(image.object, pixels), put(image.range, pixels);
  return used;
}

LightOrigin light_origin(const pipeline::Setup& setup, const pipeline::Input* input) {
  if (input != nullptr || setup.scene.moments > 0) return {};
  return {true, setup.scene.camera};
}

}  // namespace tofray::backend
