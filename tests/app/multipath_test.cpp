// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Light that bounces, on the command line: --bounces, --samples, their ends, and what goes without the other.
#include <gtest/gtest.h>

#include <cmath>

#include "files/json.h"
#include "files/npz.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

/// The folder of a test with a corner's scene of its own in it.
struct CornerFolder {
  explicit CornerFolder(const std::string& transport = {}) {
    write(folder / "nook.yaml", "camera: {profile: pico-flexx, mode: MODE_5_35FPS_600}\n" + transport +
                                    "objects:\n"
                                    "  - plane: {point: [0, 0, 1.5], normal: [1, 0, -1], reflectivity: 0.8}\n"
                                    "  - plane: {point: [0, 0, 1.5], normal: [-1, 0, -1], reflectivity: 0.8}\n");
  }
  [[nodiscard]] Result run(const Arguments& arguments) const { return test::run(with_small_sensor(arguments), in_folder(folder.path())); }
  /// All numbers of one array.
  [[nodiscard]] std::vector<double> numbers(const std::string& file, const char* name) const { return numbers_of(folder / file, name); }
  Folder folder;
};

/// Within a ball of 1 m, with camera and lamp in its middle: all of it gets the same light, and each bounce sends the same share on.
std::string ball_scene(double reflectivity, int bounces) {
  return "camera:\n  profile: pico-flexx\n  mode: MODE_5_35FPS_600\n"
         "  illumination: [{position: [0, 0, 0], axis: [0, 0, 1], illumination_wavelength: 850 nm, power: 20 mW, "
         "pattern: {kind: cone, half_angle: 180 deg}, waveform: {kind: sine}}]\n"
         "transport: {bounces: " +
         std::to_string(bounces) +
         ", samples: 4}\nobjects: [sphere: {center: [0, 0, 0], radius: 1 m, reflectivity: " + std::to_string(reflectivity) + "}]\n";
}

/// What inspect says of a pixel, as JSON.
struct Inspection {
  explicit Inspection(const Result& result) : code(result.code), json(files::parse_json(result.out, "stdout")) {}
  [[nodiscard]] const std::vector<files::Json>& list(const char* name) const { return *json.find(name)->items(); }
  [[nodiscard]] double number(const files::Json& of, const char* key) const {
    double out = std::nan("");
    if (of.find(key) != nullptr) of.find(key)->number(out);
    return out;
  }
  /// Of raw frame k.
  [[nodiscard]] double raw(std::size_t k, const char* key) const { return number(list("raw_frames").at(k), key); }
  [[nodiscard]] double bounce(std::size_t i, const char* key) const { return number(list("bounces").at(i), key); }
  [[nodiscard]] double bounce(std::size_t i, const char* key, std::size_t k) const {
    double out = std::nan("");
    list("bounces").at(i).find(key)->items()->at(k).number(out);
    return out;
  }
  [[nodiscard]] std::string unknown() const {
    return json.find("bounces_unknown") == nullptr ? "" : *json.find("bounces_unknown")->string();
  }
  int code;
  files::Json json;
};

}  // namespace

TEST(multipath, of_the_options_is_that_of_the_keys) {
  const CornerFolder typed, said("transport: {bounces: 2, samples: 4}\n");
  ASSERT_EQ(typed.run({"render", "nook.yaml", "-o", "out", "--bounces", "2", "--samples", "4"}).code, 0);
  ASSERT_EQ(said.run({"render", "nook.yaml", "-o", "out"}).code, 0);
  for (const char* name : {"gt_indirect_e", "raw"})
    EXPECT_EQ(typed.numbers("out/frame.npz", name), said.numbers("out/frame.npz", name)) << name;
  // What is typed later counts, and --bounces 0 is none.
  ASSERT_EQ(said.run({"render", "nook.yaml", "-o", "none", "--bounces", "3", "--bounces", "0", "--emit", "npz"}).code, 0);
  EXPECT_TRUE(files::read_npz(said.folder / "none/frame.npz", {"gt_indirect_e"}).empty());
}

TEST(multipath, takes_one_bounce_to_64_and_one_way_to_65536) {
  const CornerFolder corner;
  ASSERT_EQ(corner.run({"render", "nook.yaml", "-o", "most", "--bounces", "64", "--samples", "1", "--emit", "npz"}).code, 0);
  ASSERT_EQ(corner.run({"render", "nook.yaml", "-o", "least", "--bounces", "1", "--samples", "1", "--emit", "npz"}).code, 0);
  // Two walls at a right angle send light on, if the dice will: more bounces, more light.
  const std::vector<double> most = corner.numbers("most/frame.npz", "gt_indirect_e"),
                            least = corner.numbers("least/frame.npz", "gt_indirect_e");
  double more = 0;
  for (std::size_t i = 0; i < most.size(); ++i) {
    if (std::isnan(most[i])) continue;
    ASSERT_GE(most[i], least[i] * (1 - 1e-5)) << i;  // the same ways, and what comes behind them
    more += most[i] - least[i];
  }
  EXPECT_GT(more, 0);
  const Result many = run({"check", "nook.yaml", "--bounces", "1"}, in_folder(corner.folder.path()));
  EXPECT_EQ(many.code, 2) << "check takes --set alone";
  EXPECT_EQ(
      run({"check", "nook.yaml", "--set", "transport.bounces=1", "--set", "transport.samples=65536"}, in_folder(corner.folder.path())).code,
      0);
}

TEST(multipath, of_numbers_out_of_range_is_refused_with_the_range) {
  const CornerFolder corner;
  for (const char* wrong : {"-1", "65", "1.5", "many", "", "99999999999999999999"}) {
    const Result result = corner.run({"render", "nook.yaml", "-o", "out", "--bounces", wrong});
    EXPECT_EQ(result.code, 2) << wrong;
    EXPECT_TRUE(has(result.err, "error: --bounces cannot be \"" + std::string(wrong) + "\"\n  expected a whole number of 0 to 64"))
        << result.err;
  }
  for (const char* wrong : {"0", "-1", "65537", "2.5", "many", ""}) {
    const Result result = corner.run({"render", "nook.yaml", "-o", "out", "--bounces", "1", "--samples", wrong});
    EXPECT_EQ(result.code, 2) << wrong;
    EXPECT_TRUE(has(result.err, "error: --samples cannot be \"" + std::string(wrong) + "\"\n  expected ")) << result.err;
  }
  // Each in its range, together too many.
  const Result much = run({"render", "nook.yaml", "-o", "out", "--bounces", "64", "--samples", "65536"}, in_folder(corner.folder.path()));
  EXPECT_EQ(much.code, 4);
  EXPECT_TRUE(has(much.err, "error: too many light paths are to be followed")) << much.err;
  EXPECT_TRUE(has(much.err, "lower transport.samples (--samples)")) << much.err;
  EXPECT_FALSE(fs::exists(corner.folder / "out"));
}

TEST(multipath, of_ways_without_bounces_is_refused_with_what_to_add) {
  const CornerFolder corner;
  const auto where = in_folder(corner.folder.path());
  for (const Arguments& arguments :
       {Arguments{"render", "nook.yaml", "-o", "out", "--samples", "64"}, Arguments{"render", "nook.yaml", "--set", "transport.samples=64"},
        Arguments{"inspect", "nook.yaml", "--samples", "64"}, Arguments{"check", "nook.yaml", "--set", "transport.samples=64"},
        Arguments{"bench", "nook.yaml", "--samples", "64"}, Arguments{"demo", "--samples", "64"}}) {
    const Result result = run(arguments, where);
    EXPECT_EQ(result.code, 2) << arguments[0];
    EXPECT_TRUE(has(result.err, "error: --samples (transport.samples) is of light that bounces, and none does in the scene")) << result.err;
    EXPECT_TRUE(has(result.err, "\n  expected --bounces N with it, as in --bounces 4 --samples 64, or neither\n")) << result.err;
  }
  EXPECT_FALSE(fs::exists(corner.folder / "out"));
  // Who types --bounces 0 compares, and a scene that has bounces needs no other word.
  EXPECT_EQ(corner.run({"render", "nook.yaml", "-o", "out", "--bounces", "0", "--samples", "64"}).code, 0);
  EXPECT_EQ(corner.run({"render", "sphere", "-o", "ball", "--samples", "1"}).code, 0);
}

// What else is of light that bounces: typed it is refused, in a file it is told of.
TEST(multipath, of_other_words_without_bounces_is_none) {
  const CornerFolder corner;
  for (const auto& [key, value] : {std::pair{"max_samples", "64"}, {"path_noise", "2 mm"}, {"smooth", "true"}}) {
    const std::string name = std::string("transport.") + key;
    const bool alone = std::string(key) != "path_noise";  // which needs max_samples, too
    const Result typed = corner.run({"render", "nook.yaml", "-o", "out", "--set", name + "=" + value});
    EXPECT_EQ(typed.code, 2) << key;
    if (alone) {
      EXPECT_TRUE(has(typed.err, "(" + name + ") is of light that bounces, and none does in the scene")) << typed.err;
    }
    const CornerFolder said(std::string("transport: {") + key + ": " + value + (alone ? "}\n" : ", max_samples: 64}\n"));
    EXPECT_TRUE(has(said.run({"render", "nook.yaml", "-o", "out"}).err, "is given, but no light bounces: transport.bounces is 0")) << key;
  }
}

// --samples auto: 16 ways where they are enough, and more where they are not.
TEST(multipath, of_as_many_ways_as_are_enough) {
  const CornerFolder corner;
  const auto ways = [&](const char* noise, const char* out) {
    EXPECT_EQ(corner
                  .run({"render", "nook.yaml", "-o", out, "--bounces", "1", "--samples", "auto", "--set",
                        std::string("transport.path_noise=") + noise})
                  .code,
              0);
    return corner.numbers(std::string(out) + "/frame.npz", "gt_path_count");
  };
  for (const double n : ways("1 m", "few")) ASSERT_EQ(n, 16);
  for (const double n : ways("1 nm", "many")) ASSERT_EQ(n, 1024);
  const Result wrong = corner.run({"render", "nook.yaml", "--bounces", "1", "--samples", "automatic"});
  EXPECT_TRUE(has(wrong.err, "expected a whole number of 1 to 65536, or auto")) << wrong.err;
  // A pixel's bounces are followed with its own number of ways, which its file has to say.
  const Result told = run({"inspect", "few/frame.npz", "--pixel", "3,3"}, in_folder(corner.folder.path()));
  EXPECT_TRUE(has(told.out, " +- ")) << told.out;
  EXPECT_TRUE(has(told.out, "bounces      light %")) << told.out;
  ASSERT_EQ(corner
                .run({"render", "nook.yaml", "-o", "silent", "--bounces", "2", "--samples", "auto", "--set", "transport.path_noise=1 m",
                      "--arrays", "raw,lit,modulation_frequency_hz,gt_direct_e,gt_indirect_e,gt_multipath_m"})
                .code,
            0);
  EXPECT_TRUE(has(run({"inspect", "silent/frame.npz", "--pixel", "3,3"}, in_folder(corner.folder.path())).out, "it lacks gt_path_count"));
}

TEST(multipath, of_a_file_that_asks_for_ways_without_bounces_is_told) {
  const CornerFolder idle("transport: {samples: 64}\n"), busy("transport: {bounces: 1, samples: 64}\n");
  const auto warned = [](const Result& result) {
    EXPECT_EQ(result.code, 0) << result.err;
    return has(
        result.err,
        "warning: transport.samples is given, but no light bounces: transport.bounces is 0\n  nothing comes of it without bounces, as in "
        "transport: {bounces: 4, samples: 64}\n");
  };
  EXPECT_TRUE(warned(idle.run({"render", "nook.yaml", "-o", "out", "--quiet"})));
  EXPECT_TRUE(warned(run({"check", "nook.yaml"}, in_folder(idle.folder.path()))));
  EXPECT_FALSE(warned(idle.run({"render", "nook.yaml", "-o", "out", "--bounces", "0"})));
  EXPECT_FALSE(warned(idle.run({"render", "nook.yaml", "-o", "out", "--bounces", "1"})));
  EXPECT_FALSE(warned(run({"check", "nook.yaml"}, in_folder(busy.folder.path()))));
}

// T2 for each pixel by itself: until less than a quarter of the light is left (0.8^7) nothing is left to chance.
TEST(multipath, of_each_bounce_in_a_white_ball_is_a_power_of_its_reflectivity) {
  const Folder folder;
  constexpr double rho = 0.8;
  write(folder / "ball.yaml", ball_scene(rho, 6));
  const Result text = run(with_small_sensor({"inspect", "ball.yaml", "--pixel", "20,3"}), in_folder(folder.path()));
  const Inspection pixel(run(with_small_sensor({"inspect", "ball.yaml", "--pixel", "20,3", "--json"}), in_folder(folder.path())));
  ASSERT_EQ(pixel.code, 0);
  ASSERT_EQ(pixel.list("bounces").size(), 7U);
  const double gain = (1 - std::pow(rho, 7)) / (1 - rho);
  for (std::size_t k = 1; k < 5; ++k) {
    double electrons = 0, shift = 0;
    for (std::size_t b = 0; b <= 6; ++b) {
      EXPECT_EQ(pixel.bounce(b, "first"), b);
      EXPECT_EQ(pixel.bounce(b, "last"), b);
      // A float has 7 digits, and each bounce is a difference of two of them that are up to 4 times as large.
      EXPECT_NEAR(pixel.bounce(b, "electrons_e", k) / pixel.bounce(0, "electrons_e", k), std::pow(rho, b), 4e-6) << b;
      EXPECT_NEAR(pixel.bounce(b, "share"), std::pow(rho, b) / gain, 2e-6) << b;
      electrons += pixel.bounce(b, "electrons_e", k), shift += pixel.bounce(b, "multipath_m", k);
    }
    EXPECT_GT(pixel.raw(k, "direct_e"), 100);
    EXPECT_EQ(pixel.bounce(0, "electrons_e", k), pixel.raw(k, "direct_e"));
    EXPECT_NEAR(electrons, pixel.raw(k, "direct_e") + pixel.raw(k, "indirect_e"), 1e-9 * electrons);
    EXPECT_NEAR(shift, pixel.raw(k, "multipath_m"), 1e-12);
    EXPECT_GT(std::abs(shift), 1e-3);
  }
  // 0.8^b (1 - 0.8) / (1 - 0.8^7) of the light, in per cent.
  for (const char* row : {"   direct     25.307\n", "        1     20.246 ", "        2     16.197 ", "        6      6.634 "})
    EXPECT_TRUE(has(text.out, row)) << row << "\n" << text.out;
  EXPECT_TRUE(has(text.out, "bounces      light %  mm at 60.24 MHz")) << text.out;
}

TEST(multipath, of_the_first_bounces_is_that_of_a_frame_that_has_no_more) {
  const CornerFolder corner;
  const auto at = [&](const char* bounces) {
    return Inspection(corner.run({"inspect", "nook.yaml", "--bounces", bounces, "--samples", "32", "--pixel", "13,10", "--json"}));
  };
  const Inspection all = at("4");
  double electrons = 0, shift = 0;
  for (const std::size_t b : {1U, 2U, 3U, 4U}) {
    const Inspection few = at(std::to_string(b).c_str());
    electrons += all.bounce(b, "electrons_e", 1), shift += all.bounce(b, "multipath_m", 1);
    EXPECT_NEAR(electrons, few.raw(1, "indirect_e"), 1e-9 * electrons) << b;
    EXPECT_NEAR(shift, few.raw(1, "multipath_m"), 1e-12) << b;
  }
  EXPECT_GT(all.bounce(1, "multipath_m", 1), 0.005);
  EXPECT_GT(all.bounce(1, "multipath_m", 1), all.bounce(2, "multipath_m", 1));
}

TEST(multipath, of_bounces_behind_the_last_thousandth_is_one_row) {
  const Folder folder;
  write(folder / "ball.yaml", ball_scene(0.05, 40));
  const Result text = run(with_small_sensor({"inspect", "ball.yaml", "--pixel", "20,3"}), in_folder(folder.path()));
  EXPECT_TRUE(has(text.out, "   direct     95.0")) << text.out;
  EXPECT_TRUE(has(text.out, "        2      0.2")) << text.out;  // 0.05^2 * 0.95; 0.05^3 is less than a thousandth
  EXPECT_TRUE(has(text.out, "  3 to 40      0.0")) << text.out;
  const Inspection pixel(run(with_small_sensor({"inspect", "ball.yaml", "--pixel", "20,3", "--json"}), in_folder(folder.path())));
  ASSERT_EQ(pixel.list("bounces").size(), 4U);
  EXPECT_EQ(pixel.bounce(3, "first"), 3);
  EXPECT_EQ(pixel.bounce(3, "last"), 40);
  double electrons = 0;
  for (std::size_t i = 1; i < 4; ++i) electrons += pixel.bounce(i, "electrons_e", 2);
  EXPECT_NEAR(electrons, pixel.raw(2, "indirect_e"), 1e-9 * electrons);
}

TEST(multipath, of_a_file_is_told_by_the_manifest_beside_it) {
  const CornerFolder corner("transport: {bounces: 3, samples: 8, seed: 5}\n");
  const auto where = in_folder(corner.folder.path());
  const Arguments of_pixel = {"--pixel", "12,10", "--json"};
  const auto inspect = [&](const Arguments& file) {
    Arguments all = {"inspect"};
    for (const Arguments& more : {file, of_pixel}) all.insert(all.end(), more.begin(), more.end());
    return run(all, where);
  };
  ASSERT_EQ(corner.run({"render", "nook.yaml", "-o", "out", "--seed", "3", "--frames", "2", "--subpixel", "2"}).code, 0);
  const Inspection file(inspect({"out/frame_0001.npz"})),
      scene(inspect(with_small_sensor({"nook.yaml", "--seed", "3", "--subpixel", "2"})));
  EXPECT_EQ(file.list("bounces").size(), 4U);
  EXPECT_EQ(files::json_text(*file.json.find("bounces")), files::json_text(*scene.json.find("bounces")));
  EXPECT_EQ(file.unknown(), "");

  // Another file of that name, another scene, another version, none: each is said, and the sum is told all the same.
  const std::string manifest = content(corner.folder / "out/manifest.json"), frame = content(corner.folder / "out/frame_0001.npz");
  const auto with = [&](std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    write(corner.folder / "out/manifest.json", text);
    const Inspection out(inspect({"out/frame_0001.npz"}));
    EXPECT_EQ(out.code, 0);
    EXPECT_TRUE(out.json.find("bounces")->items() == nullptr) << to;
    EXPECT_GT(out.raw(1, "indirect_e"), 0);
    return out.unknown();
  };
  EXPECT_TRUE(has(with(manifest, "reflectivity: 0.8", "reflectivity: 0.7"), "simulated again, the pixel has another direct light"));
  EXPECT_TRUE(has(with(manifest, "\"tofray\": \"", "\"tofray\": \"9"), " made out/frame_0001.npz, this is "));
  EXPECT_TRUE(has(with(manifest, "frame_0001.npz", "frame_0002.npz"), "does not list out/frame_0001.npz with the bytes that it has"));
  write(corner.folder / "out/manifest.json", manifest);
  write(corner.folder / "out/frame_0000.npz", frame);
  EXPECT_TRUE(has(Inspection(inspect({"out/frame_0000.npz"})).unknown(), "out/manifest.json does not list out/frame_0000.npz"));
  write(corner.folder / "out/manifest.json", "{");
  EXPECT_TRUE(has(Inspection(inspect({"out/frame_0001.npz"})).unknown(), "out/manifest.json"));
  fs::remove(corner.folder / "out/manifest.json");
  const Result text = run({"inspect", "out/frame_0001.npz", "--pixel", "12,10"}, where);
  EXPECT_TRUE(has(text.out, "bounces     one by one unknown: the scene is in manifest.json, which is not beside out/frame_0001.npz\n"))
      << text.out;
  EXPECT_TRUE(has(text.out, " % of the light came by several surfaces, half path +")) << text.out;
}

// Each frame of what moves has other light: the pixel sees the wall that does.
TEST(multipath, of_a_film_is_that_of_its_frame) {
  const Folder folder;
  write(folder / "film.yaml",
        "camera: {profile: pico-flexx, mode: MODE_5_35FPS_600}\ntransport: {bounces: 2, samples: 8}\nobjects:\n"
        "  - plane: {point: [0, 0, 1.5], normal: [1, 0, -1], reflectivity: 0.8}\n"
        "  - plane: {point: [0, 0, 1.5], normal: [-1, 0, -1], reflectivity: 0.8, velocity: [0, 0, 0.5]}\n");
  ASSERT_EQ(run(with_small_sensor({"render", "film.yaml", "-o", "out", "--frames", "3"}), in_folder(folder.path())).code, 0);
  const Inspection last(run({"inspect", "out/frame_0002.npz", "--pixel", "15,10", "--json"}, in_folder(folder.path())));
  ASSERT_EQ(last.unknown(), "");
  ASSERT_EQ(last.list("bounces").size(), 3U);
  EXPECT_NEAR(last.bounce(1, "electrons_e", 2) + last.bounce(2, "electrons_e", 2), last.raw(2, "indirect_e"), 1e-3);
}

TEST(multipath, of_a_frame_without_bounces_is_not_told) {
  const CornerFolder corner;
  const Inspection pixel(corner.run({"inspect", "nook.yaml", "--pixel", "13,10", "--json"}));
  EXPECT_TRUE(pixel.list("bounces").empty());
  EXPECT_EQ(pixel.unknown(), "");
  const Result text = corner.run({"inspect", "nook.yaml", "--pixel", "12,10"});
  EXPECT_FALSE(has(text.out, "bounces")) << text.out;
  EXPECT_FALSE(has(text.out, "multipath")) << text.out;
}

}  // namespace tofray::test
