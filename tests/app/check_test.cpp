// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What `check` says of a camera before anything is rendered, and what `render` says where little came of it.
#include <gtest/gtest.h>

#include <cmath>

#include "files/json.h"
#include "rows.h"
#include "support/files.h"
#include "support/pi.h"
#include "support/tool.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// 200 × 100 pixels of 10 µm, f = 1 mm, N = 1; a lamp of 1 W into a cone of 120°, in the lens's middle; a pure sine of 20 MHz.
std::string simple_profile(const std::string& more = {}) {
  return "name: simple\n"
         "sensor: {source: this test, width: 200, height: 100, pixel_pitch: 10 um}\n"
         "lens: {source: this test, fx: 100 px, fy: 100 px, cx: 99.5 px, cy: 49.5 px, f_number: 1, vignetting: off" +
         more +
         "}\n"
         "filter: {source: this test, center: 850 nm, half_width: 1 nm}\n"
         "illumination:\n"
         "  - {source: this test, position: [0, 0, 0], axis: [0, 0, 1], illumination_wavelength: 850 nm, power: 1 W,\n"
         "     pattern: {kind: cone, half_angle: 60 deg}, waveform: {kind: sine}}\n"
         "pixel: {source: this test, quantum_efficiency: 0.5, contrast: 0.8, read_noise: 20 e, full_well: 60000 e}\n"
         "adc: {source: this test, bits: 16, step: 12 e/DN}\n"
         "modes:\n"
         "  source: this test\n"
         "  ONE: {frame_rate: 10 Hz, sequence: [{modulation_frequency: 20 MHz, reference_phase: [0 deg, 90 deg, 180 deg, 270 deg], "
         "integration_time: 1 ms}]}\n";
}

struct ProfileFolder {
  explicit ProfileFolder(const std::string& profile = simple_profile()) { write(folder / "simple.yaml", profile); }
  [[nodiscard]] Result run(const Arguments& arguments) const { return test::run(arguments, in_folder(folder.path())); }
  [[nodiscard]] files::Json report(const Arguments& arguments) const {
    const Result result = run(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return *files::parse_json(result.out, "stdout").find("camera_report");
  }
  Folder folder;
};

double value(const files::Json& json) {
  double out = std::nan("");
  json.number(out);
  return out;
}
const files::Json& item(const files::Json& json, const char* key, std::size_t i) { return json.find(key)->items()->at(i); }

constexpr double electrons_per_joule = 850e-9 * 0.5 / 1.98644586e-25;
double expected_electrons(double reflectivity, double z) {
  const double intensity = 1 / (2 * pi * (1 - 0.5)), watts = reflectivity * intensity / (4 * z * z) * 1e-10;
  return watts * 1e-3 * electrons_per_joule;
}
/// By hand, from watts to electrons to metres: S = ρ·I/(4N²z²)·pitch²·t·λ·QE/hc, σ = c/(4πf)·√(S + 2σ_r² + s²/12)/(√2·S·C).
double expected_noise(double reflectivity, double z) {
  const double electrons = expected_electrons(reflectivity, z), contrast = 2 / pi * 0.8;
  const double variance = electrons + 2 * 20.0 * 20 + 12.0 * 12 / 12;
  return 299792458 / (4 * pi * 20e6) * std::sqrt(variance / 2) / (electrons * contrast);
}

}  // namespace

TEST(check, says_what_a_camera_can_do_by_closed_forms) {
  const ProfileFolder folder;
  const files::Json report = folder.report({"check", "simple.yaml", "--json"});
  const auto& view = *report.find("field_of_view_deg")->items();
  EXPECT_NEAR(value(view[0]), 90, 1e-9);
  EXPECT_NEAR(value(view[1]), 2 * std::atan(0.5) * 180 / pi, 1e-9);
  EXPECT_NEAR(number(report, "diagonal_deg"), 2 * std::atan(std::sqrt(1.25)) * 180 / pi, 1e-9);
  EXPECT_EQ(value(item(report, "pixel_at_1_m_m", 0)), 0.01);
  EXPECT_NEAR(number(report, "ambiguity_range_m"), 299792458 / 40e6, 1e-9);
  EXPECT_EQ(number(report, "share_unlit"), 0);
  const auto& noise = *report.find("noise")->items();
  ASSERT_EQ(noise.size(), 4U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(*noise[i].find("ambient")->string(), "none");
    EXPECT_EQ(*noise[i + 2].find("ambient")->string(), "sun_am15");
    const double reflectivity = number(noise[i], "reflectivity");
    for (const files::Json& at : *noise[i].find("at")->items()) {
      const double expected = expected_noise(reflectivity, number(at, "z_m"));
      // Single precision, and the half path's table: far below a per mille.
      EXPECT_NEAR(number(at, "noise_m"), expected, 1e-3 * expected) << reflectivity << " at " << number(at, "z_m");
    }
    // In the sun σ² has B electrons more, shared by all four raw frames as S is: (ρ·E_B/4)·pitch²·t·λ·QE/hc, E_B some 0.98 W/m² for each
    // nanometre; the spectrum has lines of its own.
    const double dark = number(item(noise[i], "at", 1), "noise_m"), sun = number(item(noise[i + 2], "at", 1), "noise_m");
    const double per_electron = dark * dark / (expected_electrons(reflectivity, 1) + 2 * 20.0 * 20 + 12.0 * 12 / 12);
    const double ambient = (sun * sun - dark * dark) / per_electron;
    EXPECT_NEAR(ambient / (reflectivity * 0.982 * 2 / 4 * 1e-10 * electrons_per_joule * 1e-3), 1, 0.3);
  }
}

TEST(check, counts_pixels_without_light_and_without_rays) {
  // A cone of 60° of the 200 pixels' 90°, seen at 1 m: a disk of radius tan 60° = 1.73 holds all; of 20° one of 36 pixels.
  const ProfileFolder folder;
  const files::Json narrow = folder.report({"check", "simple.yaml", "--json", "--set", "illumination.0.pattern.half_angle=20 deg"});
  const double radius = 100 * std::tan(20 * pi / 180);
  EXPECT_NEAR(number(narrow, "share_unlit"), 1 - pi * radius * radius / 20000, 0.01);
  // k1 = −0.5 ends at a distorted radius of ⅔·√(2/3) = 0.544.
  const ProfileFolder barrel(simple_profile(", distortion: {k1: -0.5}"));
  const files::Json bent = barrel.report({"check", "simple.yaml", "--json"});
  const double r = 100 * 2 / 3.0 * std::sqrt(2 / 3.0), half = 50, angle = std::acos(half / r);
  const double seen = pi * r * r - 2 * (r * r * angle - half * r * std::sin(angle));  // a disk between two lines
  EXPECT_NEAR(number(bent, "share_outside_lens"), 1 - seen / 20000, 0.01);
  EXPECT_TRUE(item(bent, "field_of_view_deg", 0).is_null());
  const std::string text = barrel.run({"check", "simple.yaml"}).out;
  EXPECT_TRUE(has(text, "field of view           wider than the lens model")) << text;
  EXPECT_TRUE(has(text, "outside the lens  ")) << text;
}

// A large sensor is looked at in coarser pixels, which see the same.
TEST(check, of_many_pixels_is_as_of_few) {
  const ProfileFolder folder;
  const Arguments large = {"check",
                           "simple.yaml",
                           "--json",
                           "--set",
                           "sensor.width=2400",
                           "--set",
                           "sensor.height=1200",
                           "--set",
                           "lens.fx=1200 px",
                           "--set",
                           "lens.fy=1200 px",
                           "--set",
                           "lens.cx=1199.5 px",
                           "--set",
                           "lens.cy=599.5 px",
                           "--set",
                           "illumination.0.pattern.half_angle=20 deg"};
  const files::Json fine = folder.report(large);
  const double radius = 100 * std::tan(20 * pi / 180);
  EXPECT_NEAR(number(fine, "share_unlit"), 1 - pi * radius * radius / 20000, 0.01);
  EXPECT_NEAR(value(item(fine, "field_of_view_deg", 0)), 90, 1e-9);
}

// What is a little nearer saturates when it is rendered, what is a little farther does not.
TEST(check, knows_where_a_wall_saturates) {
  const ProfileFolder folder;
  const files::Json report = folder.report({"check", "simple.yaml", "--json"});
  const double far = number(item(report, "noise", 1), "saturated_up_to_m");
  ASSERT_GT(far, 0.05);
  for (const double factor : {0.98, 1.02}) {
    write(folder.folder / "wall.yaml",
          "camera: {profile: simple.yaml, sensor: {width: 1, height: 1}, lens: {cx: 0 px, cy: 0 px}}\n"
          "objects: [{plane: {point: [0, 0, " +
              std::to_string(far * factor) + "], normal: [0, 0, -1], reflectivity: 0.8}}]\n");
    ASSERT_EQ(folder.run({"render", "wall.yaml", "-o", "out", "--noise", "off", "--emit", "npz"}).code, 0);
    EXPECT_EQ(numbers_of(folder.folder / "out/frame.npz", "flags").at(0), factor < 1 ? 1 : 0) << factor;
  }
}

TEST(check, notes_a_closed_object_around_the_camera) {
  const Folder folder;
  const auto note_of = [&](const std::string& object) {
    write(folder / "scene.yaml",
          "camera: {profile: pico-flexx, pose: {position: [1, 0, 0], look_at: [1, 0, 1]}}\nobjects:\n"
          "  - plane: {point: [0, 0, 2], normal: [0, 0, -1], reflectivity: 0.5}\n  - " +
              object + "\n");
    const Result result = test::run({"check", "scene.yaml"}, in_folder(folder.path()));
    EXPECT_EQ(result.code, 0) << result.err;
    return has(result.err, ": the camera stands inside objects.1");
  };
  EXPECT_TRUE(note_of("sphere: {center: [1.1, 0, 0], radius: 0.2 m, reflectivity: 0.5}"));
  EXPECT_FALSE(note_of("sphere: {center: [1.1, 0, 0], radius: 0.09 m, reflectivity: 0.5}"));
  EXPECT_TRUE(note_of("box: {min: [-0.1, -0.1, -0.1], max: [0.1, 0.1, 0.1], position: [1, 0, 0], reflectivity: 0.5}"));
  EXPECT_FALSE(note_of("box: {min: [-0.1, -0.1, -0.1], max: [0.1, 0.1, 0.1], reflectivity: 0.5}"));
  EXPECT_TRUE(note_of("cylinder: {center: [1, 0, 0.2], axis: [0, 0, 1], radius: 0.1 m, height: 0.5 m, reflectivity: 0.5}"));
  EXPECT_FALSE(note_of("cylinder: {center: [1, 0, 0.2], axis: [0, 0, 1], radius: 0.1 m, height: 0.3 m, reflectivity: 0.5}"));
  EXPECT_FALSE(note_of("disk: {center: [1, 0, 0], normal: [0, 0, 1], radius: 0.1 m, reflectivity: 0.5}"));
}

TEST(check, of_a_camera_without_light_says_no_noise) {
  const ProfileFolder folder;
  const Result result = folder.run({"check", "simple.yaml", "--set", "illumination.0.power=0"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has(result.out, "field of view")) << result.out;
  EXPECT_FALSE(has(result.out, "range noise")) << result.out;
}

// The share is that of the pixels, the noise the median of those that have too little light.
TEST(render, says_why_few_pixels_are_valid_and_what_helps) {
  const Folder folder;
  const auto where = in_folder(folder.path());
  const auto said = [&](const char* set, const char* value) {
    return test::run({"render", "card", "-o", "out", "--emit", "npz", "--set", std::string(set) + "=" + value}, where).err;
  };
  const std::string dark = said("camera.integration_time", "30 us");
  EXPECT_TRUE(has(dark, " % dark: noise 0.")) << dark;
  EXPECT_TRUE(has(dark, "m at the median; more light, a longer integration time, or a higher camera.decoding.noise_threshold (now 70 mm)"))
      << dark;
  const std::string bright = said("camera.illumination.0.power", "100 W");
  EXPECT_TRUE(has(bright, " % saturated: less light, a shorter integration time, or more distance\n")) << bright;
  const std::string rejected = said("camera.decoding.asymmetry", "{sigmas: 0, reject: true}");
  EXPECT_TRUE(has(rejected, " % inconsistent phases: something moves, or camera.decoding.asymmetry rejects too much\n")) << rejected;
  const std::string good = said("camera.integration_time", "2000 us");
  EXPECT_FALSE(has(good, "longer integration time")) << good;
}
TEST(check, answers_what_is_asked_of_distance_reflectivity_and_light) {
  const ProfileFolder in;
  const files::Json report =
      in.report({"check", "simple.yaml", "--at", "1m,50cm", "--reflectivity", "10%,0.9", "--ambient", "none,50klx,100%", "--json"});
  const auto* noise = report.find("noise")->items();
  ASSERT_EQ(noise->size(), 6U);
  EXPECT_EQ(value(*noise->at(1).find("reflectivity")), 0.9);
  ASSERT_EQ(noise->at(0).find("at")->items()->size(), 2U);
  EXPECT_EQ(value(*item(noise->at(0), "at", 0).find("z_m")), 1);
  EXPECT_EQ(value(*item(noise->at(0), "at", 1).find("z_m")), 0.5);
  std::vector<std::string> ambients;
  for (const files::Json& one : *noise) ambients.push_back(files::json_text(*one.find("ambient"), 0));
  EXPECT_EQ(ambients,
            (std::vector<std::string>{"\"none\"", "\"none\"", "\"at 50 klx\"", "\"at 50 klx\"", "\"at 100 % sun\"", "\"at 100 % sun\""}));
  EXPECT_LT(value(*item(noise->at(0), "at", 0).find("noise_m")), value(*item(noise->at(2), "at", 0).find("noise_m")));
}

// A range has its ends, and evenly spaced distances between them.
TEST(check, spreads_a_range_of_distances_evenly) {
  const ProfileFolder in;
  for (const auto& [typed, count] : {std::pair{"0.5m..4m", 8U}, std::pair{"0.5m..4m:15", 15U}, std::pair{"4m..50cm:2", 2U}}) {
    const files::Json report = in.report({"check", "simple.yaml", "--at", typed, "--reflectivity", "0.2", "--ambient", "none", "--json"});
    const auto* at = report.find("noise")->items()->at(0).find("at")->items();
    ASSERT_EQ(at->size(), count) << typed;
    const double first = value(*at->at(0).find("z_m")), step = value(*at->at(1).find("z_m")) - first;
    EXPECT_EQ(first, typed[0] == '4' ? 4 : 0.5);
    for (std::size_t i = 0; i < count; ++i) EXPECT_NEAR(value(*at->at(i).find("z_m")), first + static_cast<double>(i) * step, 1e-12);
  }
  const Result lines = in.run({"check", "simple.yaml", "--at", "0.5m..4m"});
  EXPECT_NE(lines.out.find("       0.5 m       1 m     1.5 m       2 m     2.5 m       3 m   saturates"), std::string::npos) << lines.out;
  EXPECT_NE(lines.out.find("       3.5 m       4 m   saturates"), std::string::npos) << lines.out;
}

TEST(check, refuses_distances_reflectivities_and_light_with_what_is_expected) {
  const ProfileFolder in;
  const struct {
    const char *option, *value, *expected;
  } wrong[] = {{"--at", "x", "0.3m..4m"},         {"--at", "0", "0.01 to 1000 m"},   {"--at", "1m..", "0.3m..4m"},
               {"--at", "1m..2m:1", "2 to 1000"}, {"--at", "3kg", "0.01 to 1000 m"}, {"--reflectivity", "80", "0 to 100 %"},
               {"--reflectivity", "", "10%,80%"}, {"--ambient", "50", "none,50klx"}, {"--ambient", "-1klx", "0 to 1000 klx"},
               {"--ambient", "2000 klx", "klx"},  {"--ambient", "sun", "none,50klx"}};
  for (const auto& one : wrong) {
    const Result result = in.run({"check", "simple.yaml", one.option, one.value});
    EXPECT_EQ(result.code, 2) << one.option << " " << one.value;
    EXPECT_NE(result.err.find(one.expected), std::string::npos) << result.err;
  }
}

/// A second modulation frequency, of which one pixel in so many is on a wrong cycle.
std::string with_second_frequency(const std::string& mhz) {
  std::string text = simple_profile();
  const std::string one = "[{modulation_frequency: 20 MHz";
  const std::string second =
      "[{modulation_frequency: " + mhz +
      " MHz, reference_phase: [0 deg, 90 deg, 180 deg, 270 deg], integration_time: 1 ms}, {modulation_frequency: 20 MHz";
  return text.replace(text.find(one), one.size(), second);
}

TEST(check, says_wrong_cycles_and_warns_of_incommensurate_frequencies) {
  const ProfileFolder good(with_second_frequency("15")), odd(with_second_frequency("19.95"));
  const Result fine = good.run({"check", "simple.yaml"});
  EXPECT_EQ(fine.err, "");
  EXPECT_NE(fine.out.find("by 15 MHz and 20 MHz, as 3 : 4"), std::string::npos) << fine.out;
  EXPECT_NE(fine.out.find("wrong cycle, %"), std::string::npos) << fine.out;
  const Result warned = odd.run({"check", "simple.yaml"});
  EXPECT_EQ(warned.code, 0);
  EXPECT_NE(warned.err.find("simple.yaml: warning: "), std::string::npos) << warned.err;
  EXPECT_NE(warned.err.find("are on a wrong cycle: the modulation frequencies 19.95 MHz and 20 MHz are as 399 to 400"), std::string::npos)
      << warned.err;
  const Result json = odd.run({"check", "simple.yaml", "--json"});
  EXPECT_NE(json.out.find("wrong cycle"), std::string::npos) << json.out;
}

TEST(check, has_rows_for_the_light_of_the_scene) {
  const ProfileFolder in;
  write(in.folder / "lit.yaml",
        "camera: {profile: simple.yaml}\nambient: {illuminance: 20 klx}\nobjects:\n  - plane: {point: [0, 0, 2], normal: [0, 0, -1], "
        "reflectivity: 0.5}\n");
  const files::Json own = in.report({"check", "lit.yaml", "--json"});
  const files::Json asked = in.report({"check", "simple.yaml", "--ambient", "20klx", "--json"});
  const auto* noise = own.find("noise")->items();
  ASSERT_EQ(noise->size(), 6U);
  EXPECT_EQ(files::json_text(*noise->at(2).find("ambient"), 0), "\"in scene's light\"");
  EXPECT_EQ(value(*item(noise->at(2), "at", 1).find("noise_m")),
            value(*item(asked.find("noise")->items()->at(0), "at", 1).find("noise_m")));
}
