// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <gtest/gtest.h>

#include "base/constants.h"
#include "base/limits.h"
#include "load/builtin.h"
#include "load/load.h"
#include "support/text.h"
#include "tofray/tofray.h"

namespace {

using namespace tofray;
using test::has;

std::string pico() { return std::string(load::find_builtin(load::builtin_profiles(), "pico-flexx")->text); }

Camera with(const std::vector<std::pair<std::string, std::string>>& set) {
  CameraOptions options;
  options.set = set;
  return load_camera("pico-flexx", options);
}

std::string refusal(const std::vector<std::pair<std::string, std::string>>& set, ErrorKind kind = ErrorKind::bad_input) {
  try {
    with(set);
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), kind) << e.what();
    return e.what();
  }
  return {};
}

TEST(pico_flexx, has_the_numbers_of_its_table) {
  const Camera camera = load_camera("pico-flexx");
  EXPECT_EQ(camera.name, "pico-flexx");
  EXPECT_EQ(camera.sensor.width * camera.sensor.height, 38'528);
  EXPECT_EQ(camera.sensor.pixel_pitch_m, 12e-6);
  EXPECT_NEAR(camera.lens.fx_px * camera.sensor.pixel_pitch_m, 2.544e-3, 1e-15);  // focal length
  EXPECT_EQ(camera.lens.k1, -0.3);
  EXPECT_EQ(camera.lens.cx_px, 111.5);
  EXPECT_EQ(camera.lens.cy_px, 85.5);
  ASSERT_EQ(camera.illumination.size(), 1U);
  const Illumination& light = camera.illumination[0];
  EXPECT_EQ(light.position, (Vec3{0.01547, 0, 0}));
  EXPECT_EQ(light.power_w, 0.2);
  EXPECT_EQ(light.pattern.kind, Pattern::Kind::flat_top);
  EXPECT_EQ(light.pattern.columns, 172);
  EXPECT_EQ(light.pattern.rows, 168);
  EXPECT_NEAR(light.pattern.width_rad, 62 * base::pi / 180, 1e-15);
  EXPECT_NEAR(light.pattern.half_range_x_rad, 43 * base::pi / 180, 1e-15);
  EXPECT_NEAR(light.pattern.half_range_y_rad, 42 * base::pi / 180, 1e-15);
  EXPECT_EQ(light.waveform.duty, 0.25);
  EXPECT_EQ(light.waveform.rise_time_s, 1e-9);
  EXPECT_EQ(light.waveform.harmonics, 4);
  EXPECT_EQ(camera.pixel.quantum_efficiency.y, std::vector<double>{0.4});
  EXPECT_EQ(camera.pixel.contrast.y, std::vector<double>{0.75});
  EXPECT_EQ(camera.pixel.bandwidth_hz, 180e6);
  EXPECT_EQ(camera.pixel.full_well_e, 1e5);
  EXPECT_EQ(camera.pixel.read_noise_e, 50);
  EXPECT_EQ(camera.pixel.dark_current_e_per_s, 1000);
  EXPECT_EQ(camera.adc.step_e_per_dn, 20);
  EXPECT_EQ(camera.adc.valid_min, 400);
  EXPECT_EQ(camera.adc.valid_max, 3750);
  EXPECT_EQ(camera.readout_time_s, 3.5e-3);
  EXPECT_EQ(camera.min_integration_time_s, 27e-6);
  EXPECT_EQ(camera.decoding.noise_threshold_m, 0.07);
  EXPECT_EQ(camera.decoding.flying_far_limit_m, 0.14);
}

TEST(pico_flexx, has_the_six_modes_of_the_camera) {
  const char* names[] = {"MODE_9_5FPS_2000", "MODE_9_10FPS_1000", "MODE_9_15FPS_700",
                         "MODE_9_25FPS_450", "MODE_5_35FPS_600",  "MODE_5_45FPS_500"};
  EXPECT_EQ(load_camera("pico-flexx").mode.name, names[0]);
  for (const char* name : names) {
    const Camera camera = load_camera("pico-flexx", {.mode = name, .set = {}, .root = {}});
    int phases = 0, fps = 0, us = 0;
    ASSERT_EQ(std::sscanf(name, "MODE_%d_%dFPS_%d", &phases, &fps, &us), 3);
    EXPECT_EQ(camera.mode.sequence.size(), static_cast<std::size_t>(phases));
    EXPECT_EQ(camera.mode.frame_rate_hz, fps);
    EXPECT_FALSE(camera.mode.sequence[0].lit);
    EXPECT_EQ(camera.mode.sequence[0].integration_time_s, 200e-6);
    for (std::size_t k = 1; k < camera.mode.sequence.size(); ++k) {
      const RawFrame& raw = camera.mode.sequence[k];
      EXPECT_NEAR(raw.integration_time_s, us * 1e-6, 1e-18);
      EXPECT_EQ(raw.modulation_frequency_hz, phases == 9 && k < 5 ? 80.32e6 : 60.24e6);
      EXPECT_NEAR(raw.reference_phase_rad, static_cast<double>((k - 1) % 4) * base::pi / 2, 1e-15);
    }
  }
}

TEST(settings, change_any_key_and_names_them_where_they_are_wrong) {
  EXPECT_EQ(with({{"lens.f_number", "1.2"}}).lens.f_number, 1.2);
  EXPECT_EQ(with({{"illumination.0.power", "400 mW"}}).illumination[0].power_w, 0.4);
  EXPECT_EQ(with({{"mode", "MODE_5_45FPS_500"}}).mode.name, "MODE_5_45FPS_500");
  EXPECT_EQ(with({{"sensor.pixel_pitch", "{value: 10 um, assumed: a test}"}}).sensor.pixel_pitch_m, 10e-6);
  for (const char* word : {"source", "assumed", "note"})  // words, wherever they stand
    for (const std::string where : {"", "sensor.", "illumination.0.pattern.", "modes."})
      EXPECT_TRUE(has(refusal({{where + word, "[1, 2]"}}), "expected a text")) << where << word << refusal({{where + word, "[1, 2]"}});
  for (const char* index : {"0x", "1", "-0", "0 ", ""})
    EXPECT_TRUE(has(refusal({{std::string("illumination.") + index + ".power", "1 W"}}), "--set illumination.")) << index;
  const Camera cone = with({{"illumination.0.pattern.kind", "cone"}, {"illumination.0.pattern.half_angle", "30 deg"}});
  EXPECT_EQ(cone.illumination[0].pattern.kind, Pattern::Kind::cone);
  const Camera lobe = with({{"illumination.0.pattern", "{kind: cosine_lobe, exponent: 3}"}});
  EXPECT_EQ(lobe.illumination[0].pattern.exponent, 3);
  for (const auto& raw : with({{"integration_time", "300 us"}}).mode.sequence) EXPECT_EQ(raw.integration_time_s, raw.lit ? 300e-6 : 200e-6);
  EXPECT_TRUE(
      has(refusal({{"lens.f_nmber", "1.2"}}), "--set lens.f_nmber: error: unknown key \"f_nmber\" in lens; did you mean \"f_number\"?"));
  EXPECT_TRUE(has(refusal({{"integration_time", "300"}}), "--set integration_time: error: integration_time has no unit"));
  EXPECT_TRUE(has(refusal({{"illumination.1.power", "1 W"}}), "no such element: \"1\""));
  EXPECT_TRUE(has(refusal({{"f_number", "2"}}), "\"f_number\" stands elsewhere: as lens.f_number"));
}

// Single keys, in the place of the profile's; what is set for a run takes the place of both.
TEST(modes, may_have_a_decoding_of_their_own) {
  const std::string first = "modes.MODE_9_5FPS_2000.", second = "modes.MODE_9_10FPS_1000.";
  const std::vector<std::pair<std::string, std::string>> set = {{"decoding.amplitude_threshold", "50 e"},
                                                                {"decoding.filter", "{kind: median, radius: 2}"},
                                                                {first + "decoding.noise_threshold", "30 mm"},
                                                                {first + "decoding.filter", "{kind: gaussian, sigma: 2 px}"}};
  const Decoding own = with(set).decoding;
  EXPECT_EQ(own.noise_threshold_m, 0.03);
  EXPECT_EQ(own.amplitude_threshold_e, 50) << "what the mode does not say is the profile's";
  EXPECT_EQ(own.filter.kind, ImageFilter::Kind::gaussian);
  EXPECT_EQ(own.filter.sigma_px, 2);
  auto other = set;
  other.emplace_back("mode", "MODE_9_10FPS_1000");
  EXPECT_EQ(with(other).decoding.noise_threshold_m, 0.07) << "another mode knows nothing of it";
  EXPECT_EQ(with(other).decoding.filter.kind, ImageFilter::Kind::median);
  auto run = set;
  run.emplace_back("decoding.noise_threshold", "20 mm");
  EXPECT_EQ(with(run).decoding.noise_threshold_m, 0.02);
  EXPECT_EQ(with(run).decoding.filter.sigma_px, 2);
}

// Who is shown one mode after the other sees each as if it had been the only one.
TEST(modes, leave_nothing_of_themselves_behind) {
  std::size_t seen = 0;
  const Camera left = load::camera_from_text(pico(), "pico-flexx", "", {}, [&](const Camera& camera) {
    const Camera alone = load_camera("pico-flexx", {.mode = camera.mode.name});
    EXPECT_EQ(camera.decoding.filter.kind, alone.decoding.filter.kind) << camera.mode.name;
    EXPECT_EQ(camera.decoding.filter.goal_m, alone.decoding.filter.goal_m) << camera.mode.name;
    EXPECT_EQ(camera.mode.sequence.size(), alone.mode.sequence.size());
    ++seen;
  });
  EXPECT_EQ(seen, left.mode_names.size());
  EXPECT_EQ(left.mode.name, "MODE_9_5FPS_2000") << "the one that was asked for";
  EXPECT_EQ(left.decoding.filter.kind, ImageFilter::Kind::none);
}

TEST(no_light, is_a_camera_too) { EXPECT_TRUE(with({{"illumination", "[]"}}).illumination.empty()); }

TEST(no_lit_raw_frame, is_a_camera_too) {
  const Camera camera = with({{"modes.MODE_9_5FPS_2000.sequence", "[{lit: false, integration_time: 1 ms}]"}});
  ASSERT_EQ(camera.mode.sequence.size(), 1u);
  EXPECT_FALSE(camera.mode.sequence[0].lit);
}

TEST(checks, refuse_cameras_that_cannot_be) {
  const std::string mode = "modes.MODE_9_5FPS_2000.";
  const std::string phases = ", integration_time: 1 ms}]";
  const std::pair<std::vector<std::pair<std::string, std::string>>, const char*> cases[] = {
      {{{"integration_time", "30 ms"}}, "does not fit into a frame"},
      {{{mode + "frame_rate", "25 Hz"}}, "does not fit into a frame"},
      {{{"integration_time", "20 us"}}, "below the camera's shortest"},
      {{{mode + "sequence", "[{modulation_frequency: 1 MHz, reference_phase: [0, 180 deg]" + phases}}, "too few reference phases at 1 MHz"},
      {{{mode + "sequence", "[{modulation_frequency: 1 MHz, reference_phase: [0, 90 deg, 180 deg]" + phases}}, "not equally spaced"},
      {{{mode + "sequence", "[{modulation_frequency: 1 MHz, reference_phase: [0, 0, 180 deg, 270 deg]" + phases}}, "not equally spaced"},
      {{{mode + "sequence", "[{lit: false, reference_phase: 0, integration_time: 1 ms}]"}}, "an unlit raw frame has no reference_phase"},
      {{{mode + "sequence", "[{reference_phase: 0, integration_time: 1 ms}]"}}, "a lit raw frame lacks modulation_frequency"},
      {{{mode + "sequence", "[{lit: false, reference_delay: 0, integration_time: 1 ms}]"}}, "an unlit raw frame has no reference_delay"},
      {{{mode + "sequence", "[{modulation_frequency: 1 MHz, integration_time: 1 ms}]"}}, "a lit raw frame lacks reference_phase"},
      {{{mode + "sequence", "[{modulation_frequency: 1 MHz, reference_phase: 90 deg, reference_delay: 1 ns" + phases}},
       "a raw frame has reference_phase and reference_delay"},
      {{{mode + "sequence", "[{modulation_frequency: 1 MHz, reference_delay: [0, 250 ns, 500 ns]" + phases}}, "not equally spaced"},
      {{{mode + "gain", "2"}}, "expected 1, since adc.gains is not given"},
      {{{mode + "gain", "2"}, {"adc.gains", "[1, 4]"}}, "got 2, expected one of adc.gains: 1, 4"},
      {{{mode + "sequence.1.integration_time", "1 ms"},
        {mode + "sequence",
         "[{modulation_frequency: 1 MHz, reference_phase: [0, 120 deg], integration_time: 1 ms}, {modulation_frequency: 1 MHz, "
         "reference_phase: 240 deg, integration_time: 2 ms}]"}},
       "differ in integration_time"},
      {{{"adc.valid_min", "4000"}}, "valid_min is not below valid_max"},
      {{{"adc.bits", "10"}}, "above the largest code"},
      {{{"illumination.0.axis", "[0, 0, 0]"}}, "axis has no length"},
      {{{"illumination.0.waveform.rise_time", "4 ns"}}, "edges are longer than the pulse"},
      {{{"decoding.flying_pixel", "{near_z: 5 m}"}}, "far_z is not beyond near_z"},
      {{{mode + "decoding.flying_pixel", "{near_z: 5 m}"}}, "far_z is not beyond near_z"},
      {{{mode + "decoding.noise_treshold", "5 mm"}}, "did you mean \"noise_threshold\"?"},
      {{{"decoding.lower_saturation", "3750"}}, "lower_saturation is not below upper_saturation"},
      {{{"decoding.upper_saturation", "400"}}, "lower_saturation is not below upper_saturation"},
      {{{"pixel.quantum_efficiency", "{wavelength: [850 nm, 840 nm], value: [0.4, 0.4]}"}}, "wavelength does not ascend"},
      {{{"pixel.quantum_efficiency", "{wavelength: [850 nm, 860 nm], value: [0.4, 0.4, 0.4]}"}}, "value is not as long as wavelength"},
      {{{"illumination.0.pattern", "{kind: table, samples: [[1, 2], [1, 2, 3]], half_range_x: 1 rad, half_range_y: 1 rad}"}},
       "rows are not as long"},
      {{{"illumination.0.pattern", "{kind: table, samples: [[0, 0], [0, 0]], half_range_x: 1 rad, half_range_y: 1 rad}"}},
       "the pattern is dark"},
      {{{"illumination.0.pattern", "{kind: table, samples: [[1, 1]], half_range_x: 1 rad, half_range_y: 1 rad}"}},
       "samples has the wrong number of elements"},
      {{{"illumination.0.pattern", "{kind: table, samples: [[1], [1]], half_range_x: 1 rad, half_range_y: 1 rad}"}},
       "samples[0] has the wrong number of elements"},
      {{{"illumination.0.waveform", "{kind: measured, correlation: [1, 0, -1, 0]}"}}, "too few samples"},
      {{{"mode", "MODE"}}, "no mode \"MODE\""},
  };
  for (const auto& [set, expected] : cases) EXPECT_TRUE(has(refusal(set), expected)) << expected << "\n" << refusal(set);
}

TEST(three_phases, from_any_start_in_any_order_are_good) {
  const Camera camera = with({{"modes.MODE_9_5FPS_2000.sequence",
                               "[{modulation_frequency: 20 MHz, reference_phase: [250 deg, 10 deg, 130 deg], integration_time: 1 ms}]"}});
  EXPECT_EQ(camera.mode.sequence.size(), 3U);
}

TEST(delays, may_stand_in_the_place_of_phases) {
  const Camera camera =
      with({{"modes.MODE_9_5FPS_2000.sequence",
             "[{modulation_frequency: 20 MHz, reference_delay: [0 ns, 12.5 ns, 25 ns, 37.5 ns], integration_time: 1 ms}, {lit: false, "
             "integration_time: 1 ms}, {modulation_frequency: 10 MHz, reference_phase: [0, 120 deg, 240 deg], integration_time: 1 ms}]"}});
  ASSERT_EQ(camera.mode.sequence.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_NEAR(camera.mode.sequence[k].reference_delay_s, k < 4 ? 12.5e-9 * static_cast<double>(k) : 0, 1e-18);
    EXPECT_NEAR(camera.mode.sequence[k].reference_phase_rad, k > 5 ? static_cast<double>(k - 5) * 2 * base::pi / 3 : 0, 1e-12);
  }
}

TEST(gains, are_chosen_by_the_mode) {
  const Camera camera = with({{"adc.gains", "[1, 4]"}, {"modes.MODE_9_5FPS_2000.gain", "4"}});
  EXPECT_EQ(camera.mode.gain, 4);
  EXPECT_EQ(camera.adc.gains, (std::vector<double>{1, 4}));
  EXPECT_EQ(with({{"adc.gains", "[1, 4]"}}).mode.gain, 1);
}

TEST(counts, are_refused_before_anything_is_allocated) {
  for (const char* huge : {"1000000000", "2147483648", "4294967296", "9223372036854775808", "99999999999999999999"})
    for (const char* key : {"sensor.width", "sensor.height"}) EXPECT_TRUE(has(refusal({{key, huge}}), "is out of range")) << huge;
  EXPECT_TRUE(has(refusal({{"sensor.width", "16384"}, {"sensor.height", "16384"}}, ErrorKind::limit), "too many pixels"));
  EXPECT_TRUE(has(refusal({{"sensor.width", "4096"}, {"sensor.height", "4096"}}, ErrorKind::limit), "too many raw samples"));
  EXPECT_EQ(refusal({{"sensor.width", "4096"}, {"sensor.height", "2048"}}), "");
  std::string phases, lights;
  const auto sequence = [](int count) {
    std::string list;
    for (int k = 0; k < count; ++k) list += (k > 0 ? ", " : "") + std::to_string(360.0 * k / count) + " deg";
    return "[{modulation_frequency: 20 MHz, reference_phase: [" + list + "], integration_time: 30 us}]";
  };
  const auto most = static_cast<int>(base::limit::raw_frames.value);
  const std::pair<std::string, std::string> slow{"modes.MODE_9_5FPS_2000.frame_rate", "1 Hz"};
  EXPECT_EQ(refusal({slow, {"modes.MODE_9_5FPS_2000.sequence", sequence(most)}}), "");
  EXPECT_TRUE(has(refusal({slow, {"modes.MODE_9_5FPS_2000.sequence", sequence(most + 1)}}, ErrorKind::limit), "too many elements"));
  const std::string two = sequence(40);
  EXPECT_TRUE(
      has(refusal({slow, {"modes.MODE_9_5FPS_2000.sequence", two.substr(0, two.size() - 1) + ", " + two.substr(1)}}, ErrorKind::limit),
          "too many raw frames"));
  for (const int count : {64, 65}) {
    lights.clear();
    for (int i = 0; i < count; ++i)
      lights += std::string(i > 0 ? ", " : "") + "{illumination_wavelength: 850 nm, power: 1 W, pattern: lambertian, waveform: sine}";
    if (count == 64) {
      EXPECT_EQ(with({{"illumination", "[" + lights + "]"}}).illumination.size(), 64U);
    } else {
      EXPECT_TRUE(has(refusal({{"illumination", "[" + lights + "]"}}, ErrorKind::limit), "illumination has too many elements"));
    }
  }
}

TEST(area_of_light, is_read_and_refused_by_its_kind) {
  const auto area = [](const std::string& text) { return std::vector<std::pair<std::string, std::string>>{{"illumination.0.area", text}}; };
  EXPECT_EQ(with({}).illumination[0].area.kind, Area::Kind::none);
  const Area disk = with(area("{kind: disk, radius: 8 cm}")).illumination[0].area;
  EXPECT_EQ(disk.kind, Area::Kind::disk);
  EXPECT_EQ(disk.radius_m, 0.08);
  EXPECT_EQ(disk.points, 16);
  const Area card = with(area("{kind: rectangle, width: 4 cm, height: 5 mm, points: 37}")).illumination[0].area;
  EXPECT_EQ(card.kind, Area::Kind::rectangle);
  EXPECT_EQ(card.width_m, 0.04);
  EXPECT_EQ(card.height_m, 0.005);
  EXPECT_EQ(card.points, 37);
  for (const char* bad : {"0 mm", "-1 mm", "1e-9 m", "1 km", "1e300 m"}) {
    EXPECT_TRUE(has(refusal(area(std::string("{kind: disk, radius: ") + bad + "}")),
                    "--set illumination.0.area: error: radius is out of range\n  got \"" + std::string(bad) +
                        "\", expected a length such as \"10 mm\", 0.001 mm to 10000 mm"))
        << bad;
    EXPECT_TRUE(has(refusal(area(std::string("{kind: rectangle, height: 1 cm, width: ") + bad + "}")), "width is out of range")) << bad;
  }
  EXPECT_TRUE(has(refusal(area("{kind: disk, radius: .nan}")), "radius is not finite"));
  EXPECT_TRUE(has(refusal(area("{kind: disk, radius: 8}")), "radius has no unit"));
  EXPECT_TRUE(has(refusal(area("{kind: rectangle, width: 8 cm}")), "area lacks the key \"height\""));
  EXPECT_TRUE(has(refusal(area("{kind: disk, radius: 8 cm, height: 1 cm}")), "unknown key \"height\""));
  EXPECT_TRUE(has(refusal(area("{kind: square, width: 8 cm}")), "expected one of none, disk or rectangle"));
  for (const char* points : {"0", "-1", "65", "1.5", "1e9"})
    EXPECT_TRUE(has(refusal(area(std::string("{kind: disk, radius: 8 cm, points: ") + points + "}")), "points")) << points;
}

// Each number by itself is good, but not all together: the message stands at the light that has most of them.
TEST(area_of_light, makes_no_more_lights_than_the_limit) {
  std::string text = pico();
  const auto put = [&](const std::string& before, const std::string& added) { text.insert(text.find(before), added); };
  put("    power: {value: 0.2 W", "    ring_leds: 4\n    area: {kind: disk, radius: 1 cm, points: 17}\n");
  std::string said;
  try {
    (void)load::camera_from_text(text, "my.yaml", "");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    said = error.what();
  }
  EXPECT_EQ(said,
            "my.yaml:40:46: error: the camera has too many light sources\n  got 68, at most 64 (`tofray --limits`); each LED of a ring and "
            "each point of an area is a source; take fewer points or LEDs");
}

TEST(every_member_of_a_camera, can_be_written) {
  const Camera c =
      with({{"pixel.suppression", "{threshold: 50000 e, budget: 200000 e, noise_factor: 1.5}"},
            {"pixel.patterns", "{prnu: 1 %, dsnu: 2 DN, delay: 20 ps, seed: 9}"},
            {"decoding.filter", "{kind: gaussian, sigma: 1.5 px}"},
            {"decoding.wiggling_correction", "false"},
            {"lens.vignetting", "{angle: [0, 30 deg], factor: [1, 0.5]}"},
            {"filter", "{wavelength: [840 nm, 860 nm], transmission: [0.9, 80 %]}"},
            {"temperature", "{actual: 40 degC, drift: 0.2 mm/K, warm_up: 5 mm, since_start: 10 s}"},
            {"refractive_index", "1.33"},
            {"power_model", "paper_literal"},
            {"pixel.contrast", "{modulation_frequency: [20 MHz, 100 MHz], value: [0.9, 0.7]}"},
            {"illumination.0.waveform", "{kind: measured, harmonics: 2, correlation: [1, 0.7, 0, -0.7, -1, -0.7, 0, 0.7]}"},
            {"illumination.0.pattern", "{kind: table, samples: [[1, 2, 1], [2, 3, 2]], half_range_x: 30 deg, half_range_y: 20 deg}"}});
  EXPECT_EQ(c.pixel.suppression_threshold_e, 5e4);
  EXPECT_EQ(c.pixel.suppression_budget_e, 2e5);
  EXPECT_EQ(c.pixel.suppression_noise_factor, 1.5);
  EXPECT_EQ(c.pixel.prnu, 0.01);
  EXPECT_EQ(c.pixel.dsnu_dn, 2);
  EXPECT_EQ(c.pixel.delay_s, 20e-12);
  EXPECT_EQ(c.pixel.pattern_seed, 9U);
  EXPECT_EQ(c.decoding.filter.kind, ImageFilter::Kind::gaussian);
  EXPECT_EQ(c.decoding.filter.sigma_px, 1.5);
  EXPECT_FALSE(c.decoding.wiggling_correction);
  EXPECT_EQ(c.lens.vignetting, Lens::Vignetting::table);
  EXPECT_EQ(c.lens.vignetting_table.y, (std::vector<double>{1, 0.5}));
  EXPECT_EQ(c.filter.table.y, (std::vector<double>{0.9, 0.8}));
  EXPECT_EQ(c.temperature.celsius, 40);
  EXPECT_EQ(c.temperature.drift_m_per_kelvin, 0.2e-3);
  EXPECT_EQ(c.temperature.since_start_s, 10);
  EXPECT_EQ(c.refractive_index, 1.33);
  EXPECT_EQ(c.power_model, PowerModel::paper_literal);
  EXPECT_EQ(c.pixel.contrast.x, (std::vector<double>{20e6, 100e6}));
  EXPECT_EQ(c.illumination[0].waveform.correlation.size(), 8U);
  EXPECT_EQ(c.illumination[0].pattern.rows, 2);
  EXPECT_EQ(c.illumination[0].pattern.columns, 3);
  EXPECT_EQ(c.illumination[0].pattern.samples[4], 3);
}

TEST(every_effect_of_the_pixel, can_be_written) {
  const Camera c =
      with({{"pixel.row_noise", "7 e"},
            {"pixel.dark_current_doubling", "8 K"},
            {"pixel.taps", "{gain_mismatch: -2 %, offset_mismatch: 40 e}"},
            {"pixel.nonlinearity", "{charge: [0 e, 50 ke, 100 ke], read: [0 e, 47 ke, 88 ke]}"},
            {"pixel.patterns", "{phase_offset: 2 deg}"},
            {"pixel.contrast_by_wavelength", "{wavelength: [850 nm, 940 nm], factor: [1, 0.8]}"},
            {"pixel.crosstalk", "{left_right: 1 %, up_down: 0.5 %}"},
            {"decoding.temporal", "{frames: 4, sigmas: 5}"},
            {"interference", "{share: 5 %, frequency_difference: -30 Hz, active: 60 %, phase: 90 deg}"},
            {"illumination.0.waveform", "{kind: trapezoid, duty: 30 %, rise_time: 1 ns, fall_time: 2 ns, bandwidth: 200 MHz}"}});
  EXPECT_EQ(c.pixel.row_noise_e, 7);
  EXPECT_EQ(c.pixel.dark_current_doubling_k, 8);
  EXPECT_EQ(c.pixel.tap_gain_mismatch, -0.02);
  EXPECT_EQ(c.pixel.tap_offset_mismatch_e, 40);
  EXPECT_EQ(c.pixel.nonlinearity.y, (std::vector<double>{0, 47e3, 88e3}));
  EXPECT_DOUBLE_EQ(c.pixel.phase_offset_rad, 2 * 3.14159265358979323846 / 180);
  EXPECT_EQ(c.pixel.contrast_by_wavelength.y, (std::vector<double>{1, 0.8}));
  EXPECT_EQ(c.pixel.crosstalk_left_right, 0.01);
  EXPECT_EQ(c.pixel.crosstalk_up_down, 0.005);
  EXPECT_EQ(c.decoding.temporal_frames, 4);
  EXPECT_EQ(c.decoding.temporal_sigmas, 5);
  EXPECT_EQ(c.interference.share, 0.05);
  EXPECT_EQ(c.interference.frequency_difference_hz, -30);
  EXPECT_EQ(c.interference.active, 0.6);
  EXPECT_EQ(c.interference.phase_rad, 0.5 * 3.14159265358979323846);
  EXPECT_FALSE(with({{"interference.share", "1 %"}}).interference.phase_rad.has_value());
  EXPECT_EQ(c.illumination[0].waveform.fall_time_s, 2e-9);
  const Camera gaussian = with({{"illumination.0.waveform", "{kind: gaussian, sigma: 1.5 ns}"}});
  EXPECT_EQ(gaussian.illumination[0].waveform.sigma_s, 1.5e-9);
  const Camera emission = with(
      {{"illumination.0.waveform", "{kind: emission, harmonics: 1, emission: [3, 1, 0, 1], phases: [0 deg, 80 deg, 180 deg, 280 deg]}"}});
  EXPECT_EQ(emission.illumination[0].waveform.emission, (std::vector<double>{3, 1, 0, 1}));
  EXPECT_EQ(emission.illumination[0].waveform.sample_phases_rad.size(), 4U);
}

TEST(every_effect_of_the_pixel, that_makes_no_sense_is_refused_and_says_where) {
  EXPECT_TRUE(has(refusal({{"pixel.nonlinearity", "{charge: [0 e, 50 ke, 100 ke], read: [0 e, 47 ke, 46 ke]}"}}),
                  "--set pixel.nonlinearity: error: what is read does not rise with the charge as it should"));
  const std::string even = refusal({{"illumination.0.waveform", "{kind: measured, harmonics: 1, correlation: [1, 0, -0.8, 0]}"}});
  EXPECT_TRUE(has(even, "the correlation has even harmonics")) << even;
  EXPECT_TRUE(has(even, "put (D(t) - D(t + 180 deg))/2 in the place of D(t)")) << even;
  EXPECT_TRUE(has(refusal({{"pixel.taps", "{gain_mismatch: 101 %}"}}), "gain_mismatch is out of range"));
  EXPECT_TRUE(has(refusal({{"pixel.dark_current_doubling", "-1 K"}}), "dark_current_doubling is out of range"));
  EXPECT_TRUE(has(refusal({{"pixel.dark_current_doubling", "8 degC"}}), "expected a difference of temperatures such as \"8 K\""))
      << refusal({{"pixel.dark_current_doubling", "8 degC"}});
  EXPECT_TRUE(has(refusal({{"illumination.0.waveform", "{kind: gaussian}"}}), "sigma"));
}

TEST(tables_of_shares, are_refused_where_a_sample_is_none_and_say_where) {
  const std::string efficiency = refusal({{"pixel.quantum_efficiency", "{wavelength: [800 nm, 900 nm], value: [0.4, 1.2]}"}});
  EXPECT_TRUE(has(efficiency, "value[1] is out of range\n  got \"1.2\", expected a fraction such as \"0.4\", 0 to 1")) << efficiency;
  const std::string contrast = refusal({{"pixel.contrast", "{modulation_frequency: [20 MHz, 90 MHz], value: [-0.1, 0.7]}"}});
  EXPECT_TRUE(has(contrast, "value[0] is out of range\n  got \"-0.1\"")) << contrast;
  const std::string filter = refusal({{"filter", "{wavelength: [800 nm, 900 nm], transmission: [40 %, 120 %]}"}});
  EXPECT_TRUE(has(filter, "transmission[1] is out of range\n  got \"120 %\"")) << filter;
  const std::string vignetting = refusal({{"lens.vignetting", "{angle: [0, 30 deg], factor: [1, 2.5]}"}});
  EXPECT_TRUE(has(vignetting, "factor[1] is out of range\n  got \"2.5\", expected a number such as \"0.6\", 0 to 2")) << vignetting;
}

TEST(table_files, lie_beside_the_profile) {
  std::string folder = (std::filesystem::temp_directory_path() / "tofray_in_XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  std::ofstream(folder + "/pattern.csv") << "# rows of samples\n1, 2, 3\n4;5 6\n\n";
  std::ofstream(folder + "/row.csv") << "1, 2, 3\n";
  std::ofstream(folder + "/bad.csv") << "1, 2\n3, zebra\n";
  std::ofstream(folder + "/mine.yaml") << pico();
  const auto load = [&](const std::string& file) {
    try {
      const Camera camera =
          load_camera(folder + "/mine.yaml",
                      {.mode = {},
                       .set = {{"illumination.0.pattern", "{kind: table, file: " + file + ", half_range_x: 30 deg, half_range_y: 20 deg}"}},
                       .root = {}});
      EXPECT_EQ(camera.illumination[0].pattern.samples, (std::vector<double>{1, 2, 3, 4, 5, 6}));
      return std::string();
    } catch (const Error& e) {
      return std::string(e.what());
    }
  };
  EXPECT_EQ(load("pattern.csv"), "");
  std::ofstream(folder + "/kernel.csv") << "1 2 3\n4 5 6\n7 8 9\n";
  const Camera other = load_camera(folder + "/mine.yaml", {.mode = {},
                                                           .set = {{"sensor.mask", "{kind: table, file: pattern.csv}"},
                                                                   {"lens.scatter", "{kind: kernel, share: 5 %, file: kernel.csv}"}},
                                                           .root = {}});
  EXPECT_EQ(other.sensor.mask.samples, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(other.sensor.mask.columns, 3);
  EXPECT_EQ(other.lens.scatter.kernel, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_TRUE(has(load("bad.csv"), "bad.csv:2:4: error: not a number")) << load("bad.csv");
  EXPECT_TRUE(has(load("row.csv"), "the pattern has fewer than two rows or columns")) << load("row.csv");
  EXPECT_TRUE(has(load("none.csv"), "cannot open"));
  EXPECT_TRUE(has(load("../none.csv"), "leads out"));
  std::filesystem::remove_all(folder);
}

TEST(unreadable_files, are_of_kind_io) {
  for (const char* path : {"/nowhere/at/all.yaml", "no-such-camera", "/tmp"}) {
    try {
      load_camera(path);
      ADD_FAILURE() << path;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::io) << e.what();
    }
  }
}

}  // namespace
