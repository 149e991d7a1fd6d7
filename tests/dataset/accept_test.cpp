// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Samples that are drawn again until they show what they should.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/samples.h"
#include "support/text.h"
#include "tofray/tofray.h"

namespace {

using namespace tofray;
using out_test::write_file;
using test::has;

class AcceptSet {
 public:
  explicit AcceptSet(const std::string& more) {
    write_file(folder_.file("set.yaml"),
               "name: trial\nsamples: 300\nseed: 3\n" + more +
                   "scene:\n  objects:\n"
                   "    - plane: {name: wall, point: [0, 0, {uniform: [1 m, 8 m]}], reflectivity: 0.5}\n"
                   "    - sphere: {name: ball, center: [{uniform: [-1 m, 1 m]}, 0, 80 cm], radius: 8 cm, reflectivity: 0.5}\n");
  }
  [[nodiscard]] Dataset get() const { return Dataset(folder_.file("set.yaml")); }

 private:
  out_test::TemporaryFolder folder_;
};

Frame frame_of(const Dataset& set, std::uint64_t sample) {
  const Scene scene = set.scene(sample);
  SimulatorOptions options;
  options.seed = set.noise_seed(sample);
  return Simulator(scene, load_camera(scene), options).frame(0);
}
double valid_share(const Frame& frame) {
  const auto& z = frame.depth.z_m;
  return static_cast<double>(std::count_if(z.begin(), z.end(), [](float one) { return std::isfinite(one); })) /
         static_cast<double>(z.size());
}
std::ptrdiff_t pixels_of_ball(const Frame& frame) { return std::count(frame.truth.object_id.begin(), frame.truth.object_id.end(), 1); }

TEST(accept, takes_samples_that_show_what_they_should) {
  const AcceptSet file("accept: [{seen: ball, pixels: 400}, {valid: 60 %}]\n"), free("");
  const Dataset set = file.get(), all = free.get();
  int refused = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const Frame frame = frame_of(set, i);
    // A look at every fourth column and row: some pixels of a ball's rim, some percent of noisy ones more or less.
    EXPECT_GE(pixels_of_ball(frame), 300) << i;
    EXPECT_GE(valid_share(frame), 0.55) << i;
    const Drawn last = set.drawn(i).back();
    EXPECT_EQ(last.path, "accept");
    refused += last.value > 0 ? 1 : 0;
    if (last.value == 0) {
      EXPECT_EQ(set.scene_yaml(i), all.scene_yaml(i)) << "the first attempt is what it is without the rules";
    }
  }
  EXPECT_GT(refused, 10);
  EXPECT_LT(refused, 40);
}

TEST(accept, of_one_sample_hangs_on_no_other_one) {
  const AcceptSet file("accept: [{valid: 60 %}]\n");
  const std::string alone = file.get().scene_yaml(17);
  const Dataset set = file.get();
  for (std::uint64_t i = 20; i-- > 10;) (void)set.scene_yaml(i);
  EXPECT_EQ(set.scene_yaml(17), alone);
}

TEST(accept, that_takes_none_says_which_rule) {
  const AcceptSet file("attempts: 4\naccept: [{valid: 1 %}, {seen: ball, pixels: 30000}]\n");
  const Error error = out_test::error_of([&] { (void)file.get().scene_yaml(5); });
  EXPECT_TRUE(has(error.what(), "set.yaml:5:24: error: accept takes no attempt at sample 5")) << error.what();
  EXPECT_TRUE(has(error.what(), "of 4, this rule refused 4")) << error.what();
}

TEST(accept, that_is_no_rule_is_refused) {
  for (const auto& [rules, message] :
       std::vector<std::pair<std::string, std::string>>{{"[{valid: 2}]", "valid"},
                                                        {"[{valid: 60 %, seen: ball}]", "valid"},
                                                        {"[{pixels: 20}]", "seen"},
                                                        {"[{valid: 10 %, pixels: 20}]", "`pixels` stands beside valid"},
                                                        {"[]", "accept"},
                                                        {"60 %", "accept"},
                                                        {"[{vaild: 60 %}]", "did you mean"}}) {
    const AcceptSet file("accept: " + rules + "\n");
    const Error error = out_test::error_of([&] { (void)file.get(); });
    EXPECT_TRUE(has(error.what(), message) && has(error.what(), "set.yaml:4:")) << rules << "\n" << error.what();
  }
}

}  // namespace
