// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "load/builtin.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

/// A folder with what a run leaves, a profile and a folder of numbered frames.
const Folder& files() {
  static const Folder folder;
  static const bool made = [] {
    std::ofstream(folder / "mycam.yaml") << load::find_builtin(load::builtin_profiles(), "pico-flexx")->text;
    fs::create_directory(folder / "empty");
    const Prepare here = in_folder(folder.path());
    return run(with_small_sensor({"render", "card", "-o", "out"}), here).code == 0 &&
           run(with_small_sensor({"render", "card", "-o", "many", "--frames", "3"}), here).code == 0;
  }();
  EXPECT_TRUE(made);
  return folder;
}

struct Other {
  Arguments arguments;
  int code;
  std::vector<std::string> says;
};

class other_file : public testing::TestWithParam<Other> {};

TEST_P(other_file, is_called_what_it_is_and_the_fitting_command_is_named) {
  const Result result = run(GetParam().arguments, in_folder(files().path()));
  EXPECT_EQ(result.code, GetParam().code) << result.err;
  EXPECT_EQ(result.out, "");
  for (const std::string& part : GetParam().says) EXPECT_TRUE(has(result.err, part)) << part << " in " << result.err;
}

INSTANTIATE_TEST_SUITE_P(
    all, other_file,
    testing::Values(
        Other{{"render", "mycam.yaml"}, 2, {"this is a camera profile", "camera: {profile: mycam.yaml}", "tofray check mycam.yaml"}},
        Other{{"inspect", "mycam.yaml"}, 2, {"this is a camera profile"}},
        Other{{"render", "out/frame.npz"}, 2, {"archive of arrays", "tofray inspect out/frame.npz", "tofray process out/frame.npz"}},
        Other{{"check", "out/frame.npz"}, 2, {"archive of arrays"}}, Other{{"bench", "out/frame.npz"}, 2, {"archive of arrays"}},
        Other{{"render", "out/preview.png"}, 2, {"a picture"}},
        Other{{"inspect", "out/cloud.ply"}, 2, {"no faces", "a cloud of points has no surface"}},
        Other{{"render", "out/manifest.json"}, 2, {"a manifest", "tofray render --from out/manifest.json"}},
        Other{{"render", "out"}, 3, {"this is a folder", "no .yaml file"}},
        Other{{"check", "."}, 3, {"this is a folder", "it holds mycam.yaml"}},
        Other{{"inspect", "many"},
              2,
              {"folder without frame.npz", "frame_0000.npz … frame_0002.npz (3 files)", "tofray inspect many/frame_0000.npz"}},
        Other{{"inspect", "empty"}, 2, {"no .npz"}}));

TEST(inspect, of_a_folder_is_that_of_its_frame) {
  const Prepare here = in_folder(files().path());
  const Result result = run({"inspect", "out"}, here);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, run({"inspect", "out/frame.npz"}, here).out);
}

TEST(warning, of_an_integration_time_above_the_modes_names_both) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  std::ofstream(folder / "long.yaml") << "camera: {integration_time: 2.5 ms}\nobjects: []\n";
  for (const Arguments& arguments :
       {Arguments{"check", "card", "--set", "camera.integration_time=2500 us"}, Arguments{"check", "long.yaml"}}) {
    const Result result = run(arguments, here);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(has(result.err, "warning: camera.integration_time is 2500 us, longer than the 2000 us of the mode MODE_9_5FPS_2000"))
        << result.err;
  }
  EXPECT_EQ(run({"check", "card", "--set", "camera.integration_time=2000 us"}, here).err, "");
  EXPECT_EQ(run({"check", "card", "--set", "camera.integration_time=450 us"}, here).err, "");
  // A manifest brings the scene's texts, not the files; the warning is the same.
  ASSERT_EQ(run(with_small_sensor({"render", "long.yaml", "-o", "out", "--emit", "npz"}), here).code, 0);
  EXPECT_TRUE(has(run({"render", "--from", "out/manifest.json", "-o", "again"}, here).err, "2500 us, longer than the 2000 us"));
}

TEST(warning, names_the_key_and_its_value) {
  const Folder folder;
  std::ofstream(folder / "empty.yaml") << "objects: []\n";
  std::string profile(load::find_builtin(load::builtin_profiles(), "pico-flexx")->text);
  std::ofstream(folder / "mycam.yaml") << profile << "\nrefractive_index: 1.0003\n";
  const std::vector<std::pair<Arguments, std::string>> cases = {
      {{"check", "empty.yaml"}, "objects is []"},
      {{"check", "mycam.yaml"}, "warning: refractive_index is 1.0003, and does not say where that comes from"},
      {{"check", "card", "--set", "camera.illumination=[]"}, "camera.illumination is []"},
      {{"check", "card", "--set", "camera.illumination.0.power=0 W"}, "camera.illumination.0.power is 0 W"},
      {{"check", "pico-flexx", "--set", "illumination.0.power=0 W"}, ": illumination.0.power is 0 W"},
      {{"check", "card", "--mode", "GREY", "--set",
        "camera.modes.GREY={frame_rate: 5 Hz, sequence: [{lit: false, integration_time: 1 ms}]}"},
       "camera.modes.GREY.sequence says lit: false throughout"}};
  for (const auto& [arguments, says] : cases) {
    const Result result = run(arguments, in_folder(folder.path()));
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(has(result.err, says)) << says << " in " << result.err;
  }
}

}  // namespace
}  // namespace tofray::test
