// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Light by the length of its path in the place of the scene: what it came from, and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "backend/cpu/cpu.h"
#include "support/own_arrays.h"
#include "support/pixels.h"
#include "support/random_scene.h"
#include "support/text.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// What a frame's truth says of its light, as input.
Transient transient_of(const Scene& scene, const Frame& frame) {
  const TransientBins& bins = scene.transport.transient;
  return {frame.truth.width,          frame.truth.height, bins.bins, bins.first_m, bins.width_m, frame.truth.transient_e_per_s,
          frame.truth.ambient_e_per_s};
}

/// Histograms of one pixel.
Transient of_one_pixel(const std::vector<float>& values, double first_m, double bin_width_m) {
  return {1, 1, static_cast<int>(values.size()), first_m, bin_width_m, values, {}};
}

/// The part of a camera's picture that `width` × `height` pixels see coarsely.
Camera coarse(Camera camera, int width, int height) {
  const double x = 1.0 * width / camera.sensor.width, y = 1.0 * height / camera.sensor.height;
  camera.lens.fx_px *= x, camera.lens.cx_px = (camera.lens.cx_px + 0.5) * x - 0.5;
  camera.lens.fy_px *= y, camera.lens.cy_px = (camera.lens.cy_px + 0.5) * y - 0.5;
  camera.sensor.width = width, camera.sensor.height = height;
  return camera;
}

/// The camera's amplitude by pixel in electrons: the longest A−B that any lit raw frame would show, of the light as it is.
double amplitude(const Raw& raw, std::size_t pixel) {
  const std::size_t pixels = static_cast<std::size_t>(raw.width) * static_cast<std::size_t>(raw.height);
  double square = 0;
  int lit = 0;
  for (std::size_t k = 0; k < raw.lit.size(); ++k) {
    const double d = static_cast<double>(raw.tap_a[k * pixels + pixel]) - static_cast<double>(raw.tap_b[k * pixels + pixel]);
    if (raw.lit[k] != 0) square += d * d, ++lit;
  }
  return std::sqrt(2 * square / lit);
}

/// T10: histograms put back in give the frame that they came from.
/// @return pixels that have light
int expect_back(const Scene& scene, const Camera& camera, SimulatorOptions options, double relative) {
  options.noise = Noise::off;
  Simulator simulator(scene, camera, options);
  const Frame frame = simulator.frame(0);
  EXPECT_EQ(*std::max_element(frame.truth.transient_lost_e_per_s.begin(), frame.truth.transient_lost_e_per_s.end()), 0) << scene.name;
  const Frame back = simulator.frame(0, transient_of(scene, frame));
  const std::size_t pixels = frame.truth.range_m.size();
  int seen = 0;
  double worst = 0;
  for (std::size_t p = 0; p < pixels; ++p) {
    const double most = amplitude(frame.raw, p);
    if (!(most > 1)) continue;
    ++seen;
    for (std::size_t k = 0; k < frame.raw.lit.size(); ++k) {
      const std::size_t i = k * pixels + p;
      worst = std::max({worst, std::abs(static_cast<double>(back.raw.tap_a[i]) - static_cast<double>(frame.raw.tap_a[i])) / most,
                        std::abs(static_cast<double>(back.raw.tap_b[i]) - static_cast<double>(frame.raw.tap_b[i])) / most});
    }
  }
  EXPECT_LT(worst, relative) << scene.name;
  EXPECT_TRUE(std::isnan(back.truth.power_w[0]) && back.truth.transient_e_per_s.empty());
  return seen;
}

Scene ready(Scene scene, int bins) {
  scene.transport.transient = {bins, 0, 1e-3};
  scene.transport.samples = 8;
  return scene;
}

}  // namespace

TEST(transient_input, gives_the_frame_that_it_came_from) {
  const Scene demo = load_scene("demo"), cornell = load_scene("cornell-nir");
  EXPECT_GT(cornell.transport.bounces, 0);
  Camera square = coarse(load_camera(cornell), 28, 22);
  EXPECT_GT(expect_back(ready(demo, 12000), coarse(load_camera(demo), 28, 22), {}, 1e-4), 400);
  EXPECT_GT(expect_back(ready(cornell, 40000), square, {}, 1e-4), 400);
  EXPECT_GT(expect_back(ready(cornell, 40000), square, {.subpixel = 2}, 1e-4), 400);
  // A square wave with all its harmonics, gates anywhere, pixels that are late, a lens that scatters.
  for (Illumination& light : square.illumination) light.waveform = {Waveform::Kind::rectangular, 0.4, 0, 0, 0, 7, 1, {}};
  for (RawFrame& k : square.mode.sequence) k.reference_phase_rad += 0.3;
  square.pixel.bandwidth_hz = 0, square.pixel.delay_s = 1e-10, square.refractive_index = 1.33;
  square.lens.scatter = {Scatter::Kind::gaussians, 0.2, {1.5}};
  // (2π·13·f·n·width/c)²/8 of the thirteenth harmonic is 10⁻⁴ of its own light, a thirteenth of it all.
  EXPECT_GT(expect_back(ready(cornell, 40000), square, {}, 1e-4), 400);
}

TEST(transient_input, gives_the_frame_of_several_lights) {
  Random random(77);
  Camera camera = coarse(load_camera("pico-flexx"), 28, 22);
  camera.illumination.push_back(camera.illumination[0]);
  camera.illumination[1].position = {-0.2, 0.1, 0.05}, camera.illumination[1].illumination_wavelength_m = 900e-9;
  camera.illumination[1].ring_leds = 3, camera.illumination[1].ring_radius_m = 0.1;
  for (const int bounces : {0, 2}) {
    Scene scene = ready(random_scene(random, 12, false), 40000);
    scene.transport.bounces = bounces, scene.transport.seed = 1;  // of whose ways none is longer than 40 m
    EXPECT_GT(expect_back(scene, camera, {}, 1e-4), 200);
  }
}

// A single bin is a single path, two are two.
TEST(transient_input, of_bins_is_light_over_paths_of_their_middles_length) {
  Camera camera = pico();
  camera.sensor.width = camera.sensor.height = 1;
  camera.lens.cx_px = camera.lens.cy_px = 0;
  Simulator simulator({}, camera, {.noise = Noise::off});
  const double per_joule = 850e-9 * 0.5 / (6.62607015e-34 * 299792458.0);
  std::vector<float> values(400);
  values[60] = 3e6f;
  const Frame one = simulator.frame(0, of_one_pixel(values, 0.5, 0.01));
  EXPECT_NEAR(static_cast<double>(one.depth.range_m[0]), 0.5 * (0.5 + 60.5 * 0.01), 3e-6);
  EXPECT_NEAR(static_cast<double>(one.truth.signal_e[1]), 3e6 * one.raw.integration_time_s[1], 1);
  values[300] = 2e6f, values[301] = 1e6f;
  PixelLight light;
  light.width = light.height = 1;
  for (const std::size_t k : {60u, 300u, 301u}) {
    light.power_w.push_back(static_cast<float>(static_cast<double>(values[k]) / per_joule));
    light.path_length_m.push_back(static_cast<float>(0.5 + 0.01 * (static_cast<double>(k) + 0.5)));
    light.light_of_path.push_back(0);
  }
  const Frame several = simulator.frame(0, of_one_pixel(values, 0.5, 0.01)), paths = simulator.frame(0, light);
  EXPECT_NEAR(several.depth.range_m[0], paths.depth.range_m[0], 2e-6f);
  EXPECT_GT(std::abs(several.depth.range_m[0] - one.depth.range_m[0]), 0.05f);
  for (std::size_t i = 0; i < several.raw.tap_a.size(); ++i) EXPECT_NEAR(several.raw.tap_a[i] / paths.raw.tap_a[i], 1, 3e-6f) << i;
}

// A wide bin is a single length, an even histogram of a whole wavelength has no phase left, and n² times as many pixels change nothing.
TEST(transient_input, has_closed_forms_of_its_extremes) {
  Camera camera = pico();
  camera.sensor.width = 13, camera.sensor.height = 11;
  const auto pixels = static_cast<std::size_t>(13 * 11);
  Simulator simulator({}, camera, {.noise = Noise::off});
  Transient wide{13, 11, 1, 0, 3, std::vector<float>(pixels, 3e6f), {}};
  const Frame one = simulator.frame(0, wide);
  for (std::size_t p = 0; p < pixels; ++p) EXPECT_NEAR(one.depth.range_m[p], 0.75f, 1e-5f) << p;
  for (const RawFrame& k : camera.mode.sequence) {
    if (!k.lit) continue;
    const double wave = 299792458.0 / k.modulation_frequency_hz;
    Transient even{13, 11, 1000, 7, wave / 1000, std::vector<float>(1000 * pixels, 3e3f), {}};
    const Frame none = simulator.frame(0, even);
    for (std::size_t i = 0; i < camera.mode.sequence.size(); ++i) {
      if (camera.mode.sequence[i].modulation_frequency_hz != k.modulation_frequency_hz || !camera.mode.sequence[i].lit) continue;
      EXPECT_NEAR(none.raw.tap_a[i * pixels], none.raw.tap_b[i * pixels], 1e-5f * none.raw.tap_a[i * pixels]) << i;
    }
  }
  const Frame dark = simulator.frame(0, {13, 11, 3, 1e6, 1, std::vector<float>(3 * pixels), {}});
  for (std::size_t p = 0; p < pixels; ++p) EXPECT_TRUE((dark.depth.flags[p] & flag_no_return) != 0) << p;
}

TEST(transient_input, gives_the_same_bytes_on_every_machine) {
  Scene scene = load_scene("demo");
  scene.transport.transient = {700, 0, 0.01};
  Camera camera = coarse(load_camera(scene), 37, 29);
  camera.illumination.push_back(camera.illumination[0]);
  const Frame frame = Simulator(scene, camera, {.noise = Noise::off}).frame(0);
  const auto with = [&](Isa isa, int threads) {
    return Simulator(scene, camera, {.threads = threads, .isa = isa}).frame(3, transient_of(scene, frame));
  };
  const Frame reference = with(Isa::scalar, 1);
  EXPECT_GT(*std::max_element(reference.truth.signal_e.begin(), reference.truth.signal_e.end()), 100);
  for (const Isa isa : backend::machine_isas) {
    if (!backend::can_run(isa)) continue;
    EXPECT_EQ(first_difference(with(isa, 3), reference), "");
  }
}

TEST(transient_input, that_makes_no_sense_is_refused) {
  const auto message = [](const Camera& camera, const Transient& light) -> std::string {
    Simulator simulator({}, camera);
    try {
      (void)simulator.frame(0, light);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const Camera camera = lit_camera(2, 2);
  const Transient good{2, 2, 3, 0, 0.1, std::vector<float>(12, 1.0f), {}};
  EXPECT_EQ(message(camera, good), "");
  const auto with = [&](auto change) {
    Transient light = good;
    change(light);
    return message(camera, light);
  };
  constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(with([](Transient& t) { t.e_per_s[6] = not_a_number; }),
            "error: transient.e_per_s, bin 1, pixel (column 0, row 1) is out of range\n  got nan, expected 0 to 1e+20");
  EXPECT_TRUE(has(with([](Transient& t) { t.e_per_s[11] = -1; }), "transient.e_per_s, bin 2, pixel (column 1, row 1)"));
  EXPECT_TRUE(has(with([](Transient& t) { t.bins = 0, t.e_per_s.clear(); }), "transient.bins is out of range"));
  EXPECT_TRUE(has(with([](Transient& t) { t.bins = -3; }), "transient.bins is out of range"));
  EXPECT_TRUE(has(with([](Transient& t) { t.bin_width_m = 0; }), "transient.bin_width_m is out of range"));
  EXPECT_TRUE(has(with([](Transient& t) { t.bin_width_m = -0.1; }), "transient.bin_width_m is out of range"));
  EXPECT_TRUE(has(with([](Transient& t) { t.first_m = -1; }), "transient.first_m is out of range"));
  EXPECT_TRUE(has(with([](Transient& t) { t.e_per_s.pop_back(); }), "transient.e_per_s has the wrong size\n  got 11 values, expected 12"));
  EXPECT_TRUE(has(with([](Transient& t) { t.width = 4, t.height = 1; }), "transient has the wrong size"));
  EXPECT_TRUE(has(with([](Transient& t) { t.ambient_e_per_s = {1}; }), "transient.ambient_e_per_s has the wrong size"));
  EXPECT_TRUE(has(message(lit_camera(20, 20), {20, 20, 1'000'000, 0, 1, {}, {}}), "too large"));
  EXPECT_TRUE(has(message(plain_camera(2, 2), good), "the camera has no light source"));
  Camera unlit = camera;
  for (RawFrame& k : unlit.mode.sequence) k.lit = false;
  EXPECT_TRUE(has(message(unlit, good), "no lit raw frame"));
  Camera two = camera;
  two.illumination.push_back(two.illumination[0]);
  EXPECT_EQ(message(two, good), "");
  two.illumination[1].waveform.jitter_s = 1e-9;
  EXPECT_TRUE(has(message(two, good), "light source 1 of the camera has another waveform than the first one"));
}
