// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// `tofray sweep` says what the library says, writes whole files or none, and its cells are those of `tofray render`.
#include <gtest/gtest.h>

#include <cmath>

#include "files/json.h"
#include "support/tool.h"
#include "tofray/depth_file.h"
#include "tofray/sweep.h"

namespace tofray::test {
namespace {

const Arguments powers = {"sweep", "card", "--vary", "illumination.0.power=0.05W,0.2W,1W"};

Result with(const Arguments& more, const Folder& folder) {
  Arguments all = powers;
  all.insert(all.end(), more.begin(), more.end());
  return run(all, in_folder(folder.path()));
}

TEST(sweep_command, prints_what_the_library_finds) {
  const Folder folder;
  const Result result = with({"--metric", "bias,fill", "--region", "92,66,40,40", "--seed", "3", "--json"}, folder);
  ASSERT_EQ(result.code, 0) << result.err;
  SweepRequest request;
  request.inputs = {"card", {}, "", "", {}};
  request.axes = {sweep_axis("illumination.0.power=0.05W,0.2W,1W", request.inputs)};
  request.metrics = {"bias", "fill"}, request.region = {92, 66, 40, 40}, request.simulator.seed = 3;
  const Sweep expected = sweep(request);
  const files::Json json = files::parse_json(result.out, "sweep");
  for (std::size_t cell = 0; cell < 3; ++cell) {
    double bias = 0;
    ASSERT_TRUE((*json.find("cells")->items())[cell].find("regions")->find("92,66,40,40")->find("bias_m")->number(bias));
    EXPECT_EQ(bias, expected.value(cell, 0, 0));
  }
  const std::string text = with({"--metric", "sigma,fill"}, folder).out;
  EXPECT_TRUE(text.starts_with("illumination.0.power     sigma     fill\n0.05W                 ")) << text;
}

TEST(sweep_command, makes_cells_of_the_frames_that_render_makes) {
  const Folder folder;
  const Result swept = with({"--metric", "bias,fill,rmse", "--csv", "--seed", "7"}, folder);
  ASSERT_EQ(swept.code, 0) << swept.err;
  ASSERT_EQ(
      run({"render", "card", "--set", "camera.illumination.0.power=0.2W", "--seed", "7", "-o", "one", "-q"}, in_folder(folder.path())).code,
      0);
  const DepthFile file = load_depth((folder / "one/frame.npz").native());
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < file.depth.z_m.size(); ++i) {
    if (!std::isfinite(file.depth.z_m[i])) continue;
    sum += static_cast<double>(file.depth.z_m[i]) - static_cast<double>(file.truth.z_m[i]), count += 1;
  }
  std::istringstream lines(swept.out);
  std::string line;
  for (int i = 0; i < 3; ++i) std::getline(lines, line);
  ASSERT_TRUE(line.starts_with("0.2,all,")) << line;
  EXPECT_NEAR(std::stod(line.substr(8)), sum / count, 1e-12);
}

TEST(sweep_command, writes_tables_arrays_and_a_manifest) {
  const Folder folder;
  const Result result = with({"-o", "out"}, folder);
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(content(folder / "out/sweep.csv"), with({"--csv"}, folder).out);
  EXPECT_EQ(numbers_of(folder / "out/sweep.npz", "camera.illumination.0.power"), (std::vector<double>{0.05, 0.2, 1}));
  EXPECT_EQ(numbers_of(folder / "out/sweep.npz", "fill_percent").size(), 3U);
  const std::string manifest = content(folder / "out/manifest.json");
  EXPECT_TRUE(has(manifest, "camera.illumination.0.power=0.05W,0.2W,1W") && has(manifest, "sweep.npz")) << manifest;
  const Result again = run({"render", "--from", "out/manifest.json", "-o", "again"}, in_folder(folder.path()));
  EXPECT_EQ(again.code, 2);
  EXPECT_TRUE(has(again.err, "out/manifest.json: error: this is the manifest of a sweep")) << again.err;
}

TEST(sweep_command, shows_the_cells_that_nothing_beats) {
  const Folder folder;
  const Result best = with({"--best", "sigma, illumination.0.power, fill>97%", "--metric", "sigma,fill"}, folder);
  EXPECT_EQ(best.code, 0) << best.err;
  EXPECT_TRUE(has(best.out, "\n1W ") && has(best.out, "\n0.2W ") && !has(best.out, "\n0.05W ")) << best.out;
  const Result none = with({"--best", "sigma, fill>100.5%"}, folder);
  EXPECT_EQ(none.code, 1);
  EXPECT_TRUE(has(none.err, "no cell holds all conditions")) << none.err;
  EXPECT_TRUE(has(with({"--best", "sigma", "--json"}, folder).out, "\"best\": [\n    2\n  ]"));
}

TEST(sweep_command, tells_what_is_wrong_with_the_option_and_its_value) {
  const Folder folder;
  const auto error_of = [&](const Arguments& more, int code) {
    Arguments all = {"sweep", "card"};
    all.insert(all.end(), more.begin(), more.end());
    const Result result = run(all, in_folder(folder.path()));
    EXPECT_EQ(result.code, code) << result.err;
    return result.err;
  };
  EXPECT_TRUE(has(error_of({}, 2), "error: nothing varies\n  expected --vary KEY=VALUES"));
  EXPECT_TRUE(has(error_of({"--vary", "lens.f_numbr=1,2"}, 2),
                  "error: --vary has an unknown key \"lens.f_numbr\"; did you mean \"lens.f_number\"?"));
  EXPECT_TRUE(has(error_of({"--vary", "lens.f_number=1:2:1000", "--vary", "pixel.read_noise=1e:2e:1000"}, 4),
                  "error: a sweep of 1000000 cells is too large"));
  EXPECT_TRUE(has(error_of({"--vary", "lens.f_number=1,2", "--metric", "fil"}, 2), "did you mean \"fill\"?"));
  EXPECT_TRUE(has(error_of({"--vary", "lens.f_number=1,2", "--best", "nois"}, 2), "did you mean \"noise\"?"));
  EXPECT_TRUE(has(error_of({"--vary", "mode=MODE_9_5FPS_2000,NO_MODE"}, 2), "in the cell mode=NO_MODE"));
}

TEST(sweep_command, that_is_interrupted_leaves_nothing_half_done) {
  const Folder folder;
  Running child(start({"sweep", "room", "--vary", "illumination.0.power=0.01W:1W:90000", "-o", "out"}, folder / "stdout", folder / "stderr",
                      in_folder(folder.path())));
  // Once it counts cells, it notes signals.
  for (int i = 0; i < 600 && !has(content(folder / "stderr"), "/90000 cells"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  child.send(SIGINT);
  EXPECT_EQ(child.finish(), 130);
  const std::string told = content(folder / "stderr");
  EXPECT_TRUE(has(told, "interrupted: nothing is written; the same command begins anew")) << told;
  EXPECT_FALSE(fs::exists(folder / "out/sweep.csv"));
}

}  // namespace
}  // namespace tofray::test
