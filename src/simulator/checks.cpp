// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/checks.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/limits.h"
#include "base/text.h"
#include "camera/frozen_camera.h"
#include "camera/readout/image_camera.h"
#include "flow/flow.h"
#include "model/check.h"
#include "pipeline/rounds.h"
#include "scene/motion.h"
#include "simulator/check.h"

namespace tofray::simulator {

namespace {

/// Objects that move, or that the camera moves past.
std::int64_t movers_of(const Scene& scene) {
  std::int64_t movers = 0;
  for (const Object& object : scene.objects) movers += !scene.camera.keyframes.empty() || scene::moves(object);
  return movers;
}

/// Images of light that a frame needs at once, at most (backend::place_light); none where light goes straight into raw frames.
std::int64_t light_images(const Scene& scene, const camera::ImageCamera& camera, const SimulatorOptions& options) {
  const Transport& transport = scene.transport;
  const bool several = options.subpixel > 1, bounces = transport.bounces > 0, scatters = camera::FrozenScatter::spreads(camera);
  if (!several && !bounces && !scatters) return 0;
  const int direct = several || bounces ? 2 : 1, scattered = scatters ? 2 : 0;
  const int halves = 2, twice = several || transport.smooth || transport.max_samples > 0 ? 2 : 1;
  return direct + scattered + (bounces ? halves * twice : 0);
}

}  // namespace

void refuse(const std::string& what, const std::string& more, ErrorKind kind) { throw Error(kind, "error: " + what + "\n  " + more); }

void within(double value, const base::Range& range, const std::string& path) {
  if (range.contains(value)) return;
  refuse(path + " is out of range",
         "got " + base::number_text(value) + ", expected " + base::number_text(range.low) + " to " + base::number_text(range.high));
}

void check(const Camera& camera) { model::check_in_code(camera); }

void check(const Scene& scene) { model::check_in_code(scene); }

void check(const SimulatorOptions& options) {
  const std::int64_t most = base::limit::threads.value;
  if (options.threads > most)
    refuse("too many threads", "got " + std::to_string(options.threads) + ", at most " + std::to_string(most), ErrorKind::limit);
  within(options.exposure_samples, {1, 1000}, "exposure_samples");
  within(options.subpixel, {1, 16}, "subpixel");
#define TOFRAY_NAME(name, ...) #name,
  const std::vector<std::string> known = {TOFRAY_IMAGE_ARRAYS(TOFRAY_NAME)};
#undef TOFRAY_NAME
  for (std::size_t i = 0; i < options.arrays.size(); ++i) {
    const std::string& word = options.arrays[i];
    if (std::find(known.begin(), known.end(), word) == known.end())
      refuse("arrays[" + std::to_string(i) + "]: frames have no array " + base::in_quotes(word) + base::did_you_mean(word, known),
             "expected names as in files: raw, z_m, gt_z_m …");
  }
}

void check_moving_views(const Scene& scene, const Camera& camera, const SimulatorOptions& options) {
  const std::int64_t movers = movers_of(scene);
  const auto raw_frames = static_cast<std::int64_t>(camera.mode.sequence.size()),
             eyes = static_cast<std::int64_t>(camera.illumination.size()) + 2;
  const std::int64_t views = movers * eyes * raw_frames * options.exposure_samples, most = base::limit::moving_views.value;
  if (views > most)
    refuse("too many things are seen at too many times",
           "got " + std::to_string(movers) + " that move, seen by " + std::to_string(eyes - 2) + " lights, camera and sun " +
               std::to_string(options.exposure_samples) + " times in each of " + std::to_string(raw_frames) + " raw frames, " +
               std::to_string(views) + " in all, at most " + std::to_string(most) + "\n  lower exposure_samples (--exposure-samples)",
           ErrorKind::limit);
}

void check_changing_triangles(const Scene& scene, const Camera& camera, const SimulatorOptions& options) {
  std::set<std::pair<const void*, const void*>> shared;
  std::int64_t triangles = 0;
  for (const Object& object : scene.objects)
    if (const auto* mesh = std::get_if<Mesh>(&object.shape); mesh != nullptr && mesh->motion != nullptr)
      if (shared.emplace(mesh->triangles.get(), mesh->motion.get()).second)
        triangles += static_cast<std::int64_t>(mesh->triangles->triangles.size());
  const std::int64_t times = static_cast<std::int64_t>(camera.mode.sequence.size()) * options.exposure_samples;
  const std::int64_t most = base::limit::changing_triangles.value;
  if (triangles * times > most)
    refuse("meshes that change their shape have too many triangles",
           "got " + std::to_string(triangles) + " at " + std::to_string(times) + " times of a frame, " + std::to_string(triangles * times) +
               " in all, at most " + std::to_string(most) + "\n  lower exposure_samples (--exposure-samples), or let less of them play",
           ErrorKind::limit);
}

void check_light_image(const Scene& scene, const camera::ImageCamera& camera, const SimulatorOptions& options) {
  const std::int64_t pixels = std::int64_t{camera.sensor.width} * camera.sensor.height, n = options.subpixel;
  const std::int64_t most_rays = base::limit::subpixel_rays.value;
  if (n > 1 && pixels * n * n > most_rays)
    refuse("too many samples within the pixels",
           "got " + std::to_string(n) + " x " + std::to_string(n) + " in each of " + std::to_string(pixels) + " pixels, " +
               std::to_string(pixels * n * n) + " in all, at most " + std::to_string(most_rays) + "\n  lower subpixel (--subpixel)",
           ErrorKind::limit);
  const Transport& transport = scene.transport;
  const std::int64_t times = movers_of(scene) > 0 ? static_cast<std::int64_t>(camera.mode.sequence.size()) * options.exposure_samples : 1;
  const std::int64_t first = n * n * pipeline::paths_at_first(transport.samples, static_cast<int>(n * n));
  const std::int64_t ways = std::max<std::int64_t>(first, transport.max_samples);
  const std::int64_t again = transport.transient.bins > 0 ? 1 : 0;  // histograms follow the ways of one time once more
  const std::int64_t surfaces = pixels * ways * transport.bounces * (times + again), most_surfaces = base::limit::path_surfaces.value;
  if (surfaces > most_surfaces)
    refuse("too many light paths are to be followed",
           "got " + std::to_string(ways) + " for each of " + std::to_string(pixels) + " pixels, to " + std::to_string(transport.bounces) +
               " surfaces each" + (times > 1 ? " at each of " + std::to_string(times) + " times" : "") +
               (again > 0 ? ", and once more for their histograms" : "") + ", " + std::to_string(surfaces) + " in all, at most " +
               std::to_string(most_surfaces) + "\n  lower transport.samples (--samples) or transport.max_samples",
           ErrorKind::limit);
  if (transport.bounces > 0 && transport.max_samples > 0 && transport.max_samples < 2 * first)
    refuse("transport.max_samples adds no light paths", "got " + std::to_string(transport.max_samples) + ", but each pixel begins with " +
                                                            std::to_string(first) +
                                                            ", an even number for each sample within it, and then doubles it");
  if (transport.bounces > 0 && camera.power_model == PowerModel::paper_literal)
    refuse("the paper's printed formula knows no light from surface to surface",
           "leave out transport.bounces, or power_model paper_literal");
  const std::int64_t images = light_images(scene, camera, options);
  if (images == 0) return;
  // At most: a plane for each part of each harmonic of each modulation frequency, or of one at the time of each raw frame.
  const auto raw_frames = static_cast<std::int64_t>(camera.mode.sequence.size());
  // Arrays of one's own, which a lens scatters as it does the scene's light, may have a time for each raw frame, too.
  const bool by_raw_frame = movers_of(scene) > 0 || camera::FrozenScatter::spreads(camera);
  const auto modulations = static_cast<std::int64_t>(camera::modulations_of(camera.mode).frequency_hz.size());
  const std::int64_t in_one = by_raw_frame ? (2 + 2 * flow::max_harmonics) * raw_frames : 2 + 2 * flow::max_harmonics * modulations;
  const std::int64_t values = pixels * in_one * images, most = base::limit::light_values.value;
  if (values > most)
    refuse("the light image is too large",
           "got " + std::to_string(pixels) + " pixels and up to " + std::to_string(in_one) + " values of each in " +
               std::to_string(images) + " images, " + std::to_string(values) + " in all, at most " + std::to_string(most) +
               "\n  sub-pixel samples, bounces, crosstalk and a lens that scatters need it",
           ErrorKind::limit);
}

void check_transient(const Scene& scene, const camera::ImageCamera& camera) {
  const std::int64_t pixels = std::int64_t{camera.sensor.width} * camera.sensor.height, bins = scene.transport.transient.bins;
  const std::int64_t most = base::limit::transient_values.value;
  if (pixels * bins > most)
    refuse("the histograms of light by path length are too large",
           "got " + std::to_string(bins) + " bins for each of " + std::to_string(pixels) + " pixels, " + std::to_string(pixels * bins) +
               " values, at most " + std::to_string(most) + "\n  lower transport.transient.bins, or let each be wider",
           ErrorKind::limit);
}

void check_one_waveform(const pipeline::Setup& setup) {
  const camera::PhasorView& s = setup.phasors;
  for (int j = 0; j < s.modulations; ++j) {
    const float* const first = s.modulation[j].source;
    for (int i = 0; i < setup.scene.lights * 2 * s.orders; ++i) {
      if (first[i] == first[i % (2 * s.orders)]) continue;
      refuse(
          "light source " + std::to_string(i / (2 * s.orders)) + " of the camera has another waveform than the first one",
          "a histogram by path length does not say which light comes from where\n  let all have one waveform, or leave the histogram out");
    }
  }
}

}  // namespace tofray::simulator
