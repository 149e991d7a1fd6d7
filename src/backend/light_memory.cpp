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

/// What light that bounces needs beside the direct light.
/// @param several  a pixel has several samples within it
template <class Put>
void place_bounces(const pipeline::Setup& setup, const flow::FrameView& wanted, std::size_t values, bool several, const Put& put,
                   flow::LightImage& image) {
  const std::size_t pixels = pixels_of(setup), by_modulation = pixels * static_cast<std::size_t>(setup.decoder.modulations);
  const bool noise = pipeline::wants_path_noise(setup, wanted, Stage::trace), smooth = setup.bounces.smooth != 0;
  const std::size_t all = noise ? 2 * values : values;
  image.halves = noise ? 1 : 0;
  put(image.indirect, all);
  if (several || smooth || setup.bounces.rounds > 1) put(image.indirect_before, all);
  if (pipeline::wants_guide(setup, wanted, Stage::trace)) put(image.guide, flow::guide_planes * pixels);
  if (noise) put(image.error, by_modulation), put(image.noise, by_modulation);
  if (noise && smooth) put(image.smoothed_noise, by_modulation);
  if (setup.bounces.rounds > 1) put(image.goal, pixels);
}

}  // namespace

std::size_t place_light(const pipeline::Setup& setup, const flow::FrameView& wanted, const pipeline::Input* input, unsigned char* base,
                        flow::LightImage& image, bool kept) {
  image = {};
  if (!kept && !pipeline::has_light_image(setup, entry_of(input))) return 0;
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
  if (bounces) place_bounces(setup, wanted, values, several, put, image);
  if (setup.scatter.terms > 0) put(image.rows, values), put(image.scattered, values);
  if (compared) put(image.object, pixels), put(image.range, pixels);
  return used;
}

LightOrigin light_origin(const pipeline::Setup& setup, const flow::FrameView& wanted, const pipeline::Input* input) {
  if (input != nullptr || setup.scene.moments > 0) return {};
  const bool noise = pipeline::wants_path_noise(setup, wanted, Stage::trace);
  if (noise && setup.sensor.drifts != 0)
    return {};  // how well a half path is known is a matter of the gates, which are others in each frame
  return {true, pipeline::wants_mixed(setup, wanted), noise, setup.scene.camera};
}

}  // namespace tofray::backend
