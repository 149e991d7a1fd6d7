// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "results/meta_camera.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "load/builtin.h"
#include "results/meta.h"
#include "support/sanitizers.h"
#include "tofray/error.h"

namespace tofray {
namespace {

/// What meta says of a camera that was read back from meta is what it said before.
void expect_to_come_back(const std::string& profile, const CameraOptions& options) {
  const std::string meta = results::frame_meta(Scene(), load_camera(profile, options), {.seed = 3}, 0);
  EXPECT_EQ(meta, results::frame_meta(Scene(), results::camera_of_meta(meta, "frame.npz"), {.seed = 3}, 0));
}

TEST(camera_of_meta, gives_back_every_mode_of_every_builtin_profile) {
  for (const load::Builtin& profile : load::builtin_profiles())
    for (const std::string& mode : load_camera(profile.name).mode_names) expect_to_come_back(profile.name, {mode, {}, {}});
}

TEST(camera_of_meta, gives_back_kinds_that_no_builtin_profile_has) {
  const std::vector<std::vector<std::pair<std::string, std::string>>> changes = {
      {{"illumination.0.waveform", "{kind: sine, jitter: 10 ps, modulation_depth: 87 %}"}},
      {{"illumination.0.waveform", "{kind: measured, correlation: [1, 0.8, 0.1, -0.7, -1, -0.8, -0.1, 0.7], harmonics: 2}"}},
      {{"illumination.0.waveform", "{kind: trapezoid, duty: 30 %, rise_time: 1 ns, fall_time: 2 ns}"}},
      {{"illumination.0.waveform", "{kind: gaussian, sigma: 1 ns}"}},
      {{"lens.distortion", "{model: fisheye, k1: 0.01, k2: 0.002, k3: 0.0003, k4: 0.00004}"}},
      {{"lens.distortion", "{k1: 0.6, k2: 0.1, p1: 0.001, p2: 0.002, k3: 0.01, k4: 0.9, k5: 0.2, k6: 0.02}"}},
      {{"pixel.nonlinearity", "{charge: [0 e, 50 ke, 100 ke], read: [0 e, 48 ke, 90 ke]}"}, {"pixel.row_noise", "7 e"}},
      {{"interference", "{share: 5 %, frequency_difference: -30 Hz, active: 60 %, phase: 90 deg}"}},
      {{"interference", "{share: 120 %}"}, {"pixel.crosstalk", "{left_right: 2 %, up_down: 1 %}"}},
      {{"decoding.temporal", "{frames: 3, sigmas: 4}"}},
      {{"pixel.taps", "{gain_mismatch: 1 %, offset_mismatch: 30 e}"}, {"pixel.dark_current_doubling", "8 K"}},
      {{"decoding.filter", "{kind: bilateral, sigma: 1 px, sigmas: 4, range: 5 mm}"}, {"decoding.lower_saturation", "300"}},
      {{"decoding.filter", "{kind: adaptive, radius: 3, goal: 5 mm}"}, {"decoding.asymmetry", "{limit: 30 e, sigmas: 4, reject: true}"}},
      {{"illumination.0.pattern", "{kind: table, half_range_x: 30 deg, half_range_y: 20 deg, samples: [[1, 2, 3], [4, 5, 6]]}"}},
      {{"illumination.0.pattern", "{kind: cone, half_angle: 30 deg}"}},
      {{"illumination.0.pattern", "{kind: cosine_lobe, exponent: 4}"}},
      {{"illumination.0.pattern", "{kind: lambertian}"}},
      {{"illumination.0.area", "{kind: disk, radius: 8 cm, points: 5}"}},
      {{"illumination.0.area", "{kind: rectangle, width: 4 cm, height: 1 cm}"}, {"illumination.0.ring_leds", "2"}},
      {{"sensor.mask", "{kind: table, samples: [[1, 2, 3], [4, 5, 6]]}"}},
      {{"lens.scatter", "{kind: gaussians, share: 3 %, sigma: [3 px, 30 px], weights: [1, 2]}"}},
      {{"lens.scatter", "{kind: gaussians, share: 3 %, sigma: [3 px]}"}},
      {{"lens.scatter", "{kind: kernel, share: 5 %, kernel: [[1, 2, 3], [4, 5, 6], [7, 8, 9], [1, 1, 1], [2, 2, 2]]}"}},
      {{"lens.vignetting", "{angle: [0 deg, 20 deg, 40 deg], factor: [1, 0.8, 0.5]}"}},
      {{"filter", "{wavelength: [840 nm, 850 nm, 861 nm], transmission: [0.1, 0.9, 0.2]}"}},
      {{"pixel.quantum_efficiency", "{wavelength: [700 nm, 850 nm, 950 nm], value: [0.5, 0.4, 0.1]}"}},
      {{"pixel.suppression", "{threshold: 30 ke, budget: 100 ke, noise_factor: 1.5}"}},
      {{"pixel.patterns", "{prnu: 1 %, dsnu: 2 DN, delay: 20 ps, seed: 77}"}},
      {{"decoding.filter", "{kind: gaussian, sigma: 1.3 px}"}, {"decoding.flying_pixel.near_limit", "17 mm"}},
      {{"decoding.filter", "{kind: median, radius: 2}"}, {"decoding.wiggling_correction", "false"}},
      {{"temperature", "{actual: 41.3 degC, drift: 0.2 mm/K, warm_up: 3 mm, warm_up_time: 100 s, since_start: 7 s}"}},
      {{"power_model", "paper_literal"}, {"refractive_index", "1.0003"}, {"timing.readout_time", "3.3 ms"}}};
  for (const auto& set : changes) {
    SCOPED_TRACE(set[0].first + " " + set[0].second);
    expect_to_come_back("pico-flexx", {{}, set, {}});
  }
}

TEST(camera_of_meta, takes_changes) {
  const std::string meta = results::frame_meta(Scene(), load_camera("pico-flexx"), {.seed = 0}, 0);
  EXPECT_EQ(results::camera_of_meta(meta, "frame.npz", {{"decoding.filter.kind", "median"}}).decoding.filter.kind,
            ImageFilter::Kind::median);
  EXPECT_THROW(results::camera_of_meta(meta, "frame.npz", {{"decoding.filtre", "median"}}), Error);
}

// Whatever of it is called otherwise, or is of another type: a camera or an error. ("l*t" for the "lit" of a raw frame ended with a signal.)
TEST(camera_of_meta, of_which_one_thing_is_wrong_is_refused_or_read) {
  using Json = nlohmann::json;
  const Json meta = Json::parse(results::frame_meta(Scene(), load_camera("pico-flexx"), {.seed = 0}, 0));
  const Json places = Json{{"camera", meta["camera"]}}.flatten();
  int refused = 0, read = 0, cases = 0;
  constexpr int each = test::with_sanitizers ? 5 : 1;  // which six types do not share
  const auto attempt = [&](const Json& wrong, const std::string& what) {
    if (++cases % each != 0) return;
    try {
      results::camera_of_meta(wrong.dump(), "frame.npz");
      ++read;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_input) << what << ": " << error.what();
      ++refused;
    }
  };
  for (const auto& [key, value] : places.items()) {
    const Json::json_pointer place(key);
    for (const Json& other : {Json(nullptr), Json(3), Json("x"), Json(true), Json::array(), Json::object()}) {
      Json wrong = meta;
      wrong[place] = other;
      attempt(wrong, key + " " + other.dump());
    }
    Json without = meta;
    Json& around = without[place.parent_pointer()];
    if (!around.is_object()) continue;
    around.erase(place.back());
    attempt(without, "no " + key);
  }
  EXPECT_GT(refused, 500 / each);
  EXPECT_GT(read, 100 / each);
}

TEST(camera_of_meta, without_a_word_on_the_light_has_lit_raw_frames_as_files_have) {
  using Json = nlohmann::json;
  Json meta = Json::parse(results::frame_meta(Scene(), load_camera("pico-flexx"), {.seed = 0}, 0));
  meta["camera"]["mode"]["sequence"][1].erase("lit");
  const RawFrame got = results::camera_of_meta(meta.dump(), "frame.npz").mode.sequence[1];
  EXPECT_TRUE(got.lit);
  EXPECT_EQ(got.modulation_frequency_hz, 80.32e6);
}

TEST(camera_of_meta, names_what_is_missing) {
  for (const char* meta : {"{}", "[]", "3", R"({"camera": 3})"}) {
    try {
      results::camera_of_meta(meta, "frame.npz");
      ADD_FAILURE() << meta;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_input);
      EXPECT_NE(std::string(error.what()).find("--camera"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(results::camera_of_meta(R"({"camera": {}})", "frame.npz"), Error);
  EXPECT_THROW(results::camera_of_meta("", "frame.npz"), Error);
}

}  // namespace
}  // namespace tofray
