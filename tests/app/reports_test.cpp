// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>

#include "backend/cpu/sets.h"
#include "files/json.h"
#include "files/npz.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

TEST(inspect, shows_one_pixel_from_light_to_depth) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run({"render", "card", "-o", "out", "--noise", "off"}, here).code, 0);
  const Result from_file = run({"inspect", "out/frame.npz", "--pixel", "112,86", "--json"}, here);
  const Result simulated = run({"inspect", "card", "--pixel", "112,86", "--noise", "off", "--json"}, here);
  ASSERT_EQ(from_file.code, 0) << from_file.err;
  const auto after_name = [](const std::string& text) { return text.substr(text.find("\"pixel\"")); };
  EXPECT_EQ(after_name(from_file.out), after_name(simulated.out));
  const files::Json json = files::parse_json(from_file.out, "stdout");
  EXPECT_EQ(*json.find("truth")->find("object")->string(), "card");
  EXPECT_EQ(json.find("raw_frames")->items()->size(), 9u);
  // Noise-free, both modulation frequencies agree with half the true path to float precision: some 1e-5 m.
  double range = 0;
  ASSERT_TRUE(json.find("truth")->find("range_m")->number(range));
  ASSERT_EQ(json.find("phases")->items()->size(), 2u);
  for (const files::Json& phase : *json.find("phases")->items()) {
    double half_path = 0;
    ASSERT_TRUE(phase.find("half_path_m")->number(half_path));
    EXPECT_NEAR(half_path, range, 2e-4);  // the light stands 15 mm beside the lens: half the path is 0.12 mm longer at 1 m
    EXPECT_GT(half_path, range);
  }
}

TEST(inspect, lists_every_array_with_its_unit) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "out"}), here).code, 0);
  const Result result = run({"inspect", "out/frame.npz"}, here);
  EXPECT_EQ(result.code, 0);
  for (const files::NamedArray& one : files::read_npz(folder / "out" / "frame.npz"))
    EXPECT_TRUE(has(result.out, "\n" + one.name + " ")) << one.name;
  EXPECT_TRUE(has(result.out, "W/(m2 sr)"));
  EXPECT_TRUE(has(result.out, "pixels with a depth"));
}

TEST(doctor, finds_this_machine_well) {
  const Result result = run({"doctor"});
  EXPECT_EQ(result.code, 0) << result.out;
  EXPECT_TRUE(has(result.out, "all good"));
  EXPECT_EQ(has(result.out, "trials: on 64-bit ARM"), backend::isas_here.back() == Isa::neon) << "what nobody has tried is said";
}

TEST(bench, measures_what_it_says) {
  const Result result = run(with_small_sensor({"bench", "card", "--frames", "3", "--noise", "off", "--threads", "1", "--json"}));
  ASSERT_EQ(result.code, 0) << result.err;
  const files::Json json = files::parse_json(result.out, "stdout");
  ASSERT_EQ(json.find("results")->items()->size(), 1u);
  const files::Json& row = json.find("results")->items()->front();
  double median = 0, rate = 0, peak = 0, fast = 0, slow = 0;
  ASSERT_TRUE(row.find("ms_median")->number(median) && row.find("frames_per_s")->number(rate) && row.find("peak_bytes")->number(peak));
  ASSERT_TRUE(row.find("ms_p10")->number(fast) && row.find("ms_p99")->number(slow));
  EXPECT_GT(fast, 0);
  EXPECT_LE(fast, median);
  EXPECT_LE(median, slow);
  EXPECT_NEAR(rate * median, 1000, 1e-6);
  EXPECT_GT(peak, 1e6);
  EXPECT_EQ(row.find("sha256")->string()->size(), 64u);
  const files::Json& others = *row.find("other_places");
  ASSERT_TRUE(others.find("ms_median")->number(median) && others.find("frames_per_s")->number(rate) && others.find("ms_p10")->number(fast));
  EXPECT_GT(fast, 0);
  EXPECT_LE(fast, median);
  EXPECT_NEAR(rate * median, 1000, 1e-6);
  const files::Json& set_up = *row.find("set_up_ms");
  for (const char* name : {"from_nothing", "another_lens", "another_sensor_number", "another_scene"}) {
    double ms = 0;
    ASSERT_TRUE(set_up.find(name) != nullptr && set_up.find(name)->number(ms)) << name;
    EXPECT_GT(ms, 0) << name;
  }
}

TEST(bench, takes_objects_that_have_keyframes_or_a_velocity) {
  const Folder folder;
  std::ofstream(folder / "moved.yaml") << "camera: {profile: pico-flexx}\nobjects:\n"
                                          "  - sphere: {center: [0, 0, 1], radius: 10 cm, reflectivity: 0.5, keyframes: [{time: 0 s, "
                                          "position: [0, 0, 0]}, {time: 1 s, position: "
                                          "[0.1, 0, 0]}]}\n"
                                          "  - sphere: {center: [0, 0, 2], radius: 10 cm, reflectivity: 0.5, velocity: [0, 1 m/s, 0]}\n";
  const Result result =
      run(with_small_sensor({"bench", "moved.yaml", "--frames", "2", "--threads", "1", "--json"}), in_folder(folder.path()));
  EXPECT_EQ(result.code, 0) << result.err;
}

TEST(bench, compares_variants_that_give_the_same_bytes) {
  const Result result = run(with_small_sensor({"bench", "--compare", "--frames", "2", "--warmup", "0", "--json"}));
  ASSERT_EQ(result.code, 0) << result.err;
  const files::Json json = files::parse_json(result.out, "stdout");
  EXPECT_EQ(json.find("ratios")->items()->size(), 7u);
  const auto hash = [&](std::size_t i) { return *(*json.find("results")->items())[i].find("sha256")->string(); };
  EXPECT_EQ(hash(0), hash(1));    // scalar and vector code
  EXPECT_EQ(hash(2), hash(3));    // one thread and two
  EXPECT_NE(hash(4), hash(5));    // with noise and without
  EXPECT_EQ(hash(10), hash(11));  // to other places and to the same
}

}  // namespace
}  // namespace tofray::test
