// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// `tofray quality` and `tofray compare` say what the library says of files, and hold limits.
#include <gtest/gtest.h>

#include <cmath>

#include "files/json.h"
#include "pictures/png_file.h"
#include "support/tool.h"
#include "tofray/compare.h"
#include "tofray/depth_file.h"
#include "tofray/error.h"

namespace tofray::test {
namespace {

double figure_of(const files::Json& json, const char* key) {
  double out = std::nan("");
  EXPECT_TRUE(json.find(key) != nullptr && json.find(key)->number(out)) << key;
  return out;
}

/// A folder with three frames of a wall, and one of a step: made once.
const Folder& frames() {
  static const Folder folder;
  static const bool made = [] {
    for (const Arguments& more : {Arguments{"card", "-o", "wall", "--frames", "3"}, Arguments{"step-and-rod", "-o", "step"}}) {
      Arguments all = {"render"};
      all.insert(all.end(), more.begin(), more.end()), all.emplace_back("-q");
      EXPECT_EQ(run(all, in_folder(folder.path())).code, 0);
    }
    return true;
  }();
  EXPECT_TRUE(made);
  return folder;
}

Result in_frames(const Arguments& arguments) { return run(arguments, in_folder(frames().path())); }

TEST(quality_command, says_what_the_library_says_of_all_frames_of_a_folder) {
  const Result result = in_frames({"quality", "wall", "--region", "92,66,40,41", "--truth", "1001mm", "--json"});
  ASSERT_EQ(result.code, 0) << result.err;
  const files::Json json = files::parse_json(result.out, "quality");
  std::vector<Depth> depths;
  const std::vector<DepthFile> found = load_depths((frames() / "wall").native());
  for (const DepthFile& one : found) depths.push_back(one.depth);
  ASSERT_EQ(depths.size(), 3U);
  const Depth truth = depth_of(found[0].truth);
  const Quality expected = quality(depths, {{92, 66, 40, 41}, "", 1.001}, &truth);
  const files::Json& metrics = *json.find("metrics");
  EXPECT_EQ(figure_of(metrics, "temporal_noise_percent"), expected.temporal_noise_percent);
  EXPECT_EQ(figure_of(metrics, "z_accuracy_percent"), expected.z_accuracy_percent);
  EXPECT_EQ(figure_of(metrics, "bias_m"), expected.bias_m);
  EXPECT_EQ(figure_of(metrics, "noise_chi2"), expected.noise_chi2);
  EXPECT_EQ(figure_of(json, "frames"), 3);
  EXPECT_TRUE(has(result.out, "\"edge_step_m\": null")) << result.out;
}

TEST(quality_command, tells_people_what_is_unknown_and_what_would_make_it_known) {
  const std::string text = in_frames({"quality", "wall/frame_0000.npz", "--as", "basler"}).out;
  EXPECT_TRUE(has(text, "conditions of Basler blaze: a flat white target of 90 %")) << text;
  EXPECT_TRUE(has(text, "columns 92 to 131, rows 66 to 105")) << text;
  EXPECT_TRUE(has(text, "temporal_noise_percent    needs two frames or more")) << text;
  const std::string step = in_frames({"quality", "step"}).out;
  EXPECT_TRUE(has(step, "edge_width_px")) << step;
}

TEST(quality_command, exits_with_1_where_a_limit_does_not_hold) {
  const Result good = in_frames({"quality", "wall", "--limit", "fill_rate=95%,temporal_noise=50mm", "--limit", "noise_chi2=1.2"});
  EXPECT_EQ(good.code, 0) << good.err;
  const Result noisy = in_frames({"quality", "wall", "--limit", "temporal_noise=0.01mm"});
  EXPECT_EQ(noisy.code, 1);
  EXPECT_TRUE(has(noisy.err, "limit: temporal_noise is ") && has(noisy.err, ", beyond 0.01 mm")) << noisy.err;
  const Result empty = in_frames({"quality", "wall", "--limit", "fill_rate=100.5%"});
  EXPECT_EQ(empty.code, 1);
  EXPECT_TRUE(has(empty.err, ", below 100.5 %")) << empty.err;
  EXPECT_EQ(in_frames({"quality", "wall", "--limit", "temporal_noise=0.0001%"}).code, 1);  // the other of that name
  EXPECT_EQ(in_frames({"quality", "wall", "--limit", "bias_m=1"}).code, 0);
}

TEST(quality_command, says_what_a_limit_may_be) {
  const Result unit = in_frames({"quality", "wall", "--limit", "bias=5%"});
  EXPECT_EQ(unit.code, 2);
  EXPECT_TRUE(has(unit.err, "error: the limit of bias cannot be \"5%\"\n  expected a number with its unit, as in --limit bias=5mm"))
      << unit.err;
  const Result name = in_frames({"quality", "wall", "--limit", "fill_rat=5%"});
  EXPECT_EQ(name.code, 2);
  EXPECT_TRUE(has(name.err, "did you mean \"fill_rate\"?")) << name.err;
  const Result unknown = in_frames({"quality", "wall/frame_0000.npz", "--limit", "temporal_noise=5mm"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(has(unknown.err, "error: temporal_noise has a limit and is not known\n  expected two frames or more")) << unknown.err;
}

TEST(quality_command, writes_csv_and_json) {
  const Folder folder;
  const std::string wall = (frames() / "wall").native();
  EXPECT_EQ(run({"quality", wall, "-o", "quality.csv"}, in_folder(folder.path())).out, "");
  EXPECT_EQ(content(folder / "quality.csv"), run({"quality", wall, "--csv"}).out);
  EXPECT_TRUE(content(folder / "quality.csv").starts_with("name,value\nfill_rate_percent,")) << content(folder / "quality.csv");
  EXPECT_EQ(run({"quality", wall, "-o", "quality.json"}, in_folder(folder.path())).code, 0);
  EXPECT_EQ(content(folder / "quality.json"), run({"quality", wall, "--json"}).out);
}

TEST(quality_command, reads_pictures_matrices_and_arrays_of_z) {
  const Folder folder;
  write(folder / "a.png", pictures::png_grey16(3, 2, {1000, 0, 1001, 1002, 1003, 1004}));
  write(folder / "a.csv", "1, nan,1.001\n1.002,1.003,1.004\n");
  write(folder / "spaces.csv", "# z\n1000 0 1001\r\n1002 1003 1004\n");
  const Result picture = run({"compare", "a.png", "a.csv", "--json"}, in_folder(folder.path()));
  ASSERT_EQ(picture.code, 0) << picture.err;
  const files::Json json = files::parse_json(picture.out, "compare");
  EXPECT_EQ(figure_of(json, "both"), 5);
  EXPECT_EQ(figure_of(json, "neither"), 1);
  EXPECT_LT(figure_of(*json.find("all"), "rmse_m"), 1e-6);
  const DepthFile spaces = load_depth((folder / "spaces.csv").native(), {1e-3, {{50, 60, 1, 0.5}}});
  EXPECT_NEAR(spaces.depth.z_m[5], 1.004, 1e-6);
  EXPECT_NEAR(spaces.depth.points_m[15], 1.004 * (2 - 1) / 50, 1e-6);
  EXPECT_NEAR(spaces.depth.points_m[16], 1.004 * (1 - 0.5) / 60, 1e-6);
  EXPECT_TRUE(std::isnan(spaces.depth.z_m[1]));
  // Without the lens's numbers there is no plane; with them there is.
  EXPECT_TRUE(has(run({"quality", "a.png"}, in_folder(folder.path())).out, "plane_distance_m          needs points"));
  EXPECT_TRUE(
      has(run({"quality", "a.png", "--intrinsics", "50,60,1,0.5"}, in_folder(folder.path())).out, "plane_distance_m               1."));
}

TEST(quality_command, says_what_is_wrong_with_a_file) {
  const Folder folder;
  const auto error_of = [&](const std::string& name, const std::string& bytes) {
    write(folder / name, bytes);
    const Result result = run({"quality", name}, in_folder(folder.path()));
    EXPECT_EQ(result.code, 2) << result.out;
    return result.err;
  };
  EXPECT_TRUE(has(error_of("cloud.ply", "ply\n"),
                  "cloud.ply: error: depth is not read of this kind of file\n  the points of a cloud have no pixels"));
  EXPECT_TRUE(has(error_of("a.csv", "1,2\n3\n"), "a.csv:2: error: this row has 1 numbers\n  expected 2"));
  EXPECT_TRUE(has(error_of("b.csv", "z,y\n"), "b.csv:1: error: \"z\" is no number"));
  EXPECT_TRUE(has(error_of("eight.png", pictures::png_grey8(2, 1, {1, 2})), "got 1 channel of 8 bits, expected grey of 16 bits"));
  EXPECT_TRUE(has(error_of("invalid.csv", "nan,0\n"), "no pixel of the region has a depth"));
  const Result missing = run({"quality", "no.npz"}, in_folder(folder.path()));
  EXPECT_TRUE(has(missing.err, "no.npz: error: there is no such file")) << missing.err;
  fs::create_directory(folder / "empty");
  EXPECT_TRUE(has(run({"quality", "empty"}, in_folder(folder.path())).err, "empty: error: there are no frames in this folder"));
  ASSERT_EQ(run({"render", "card", "-o", "raw", "--arrays", "raw", "-q", "--emit", "npz"}, in_folder(folder.path())).code, 0);
  EXPECT_TRUE(has(run({"quality", "raw"}, in_folder(folder.path())).err,
                  "there is no depth in it\n  it has raw frames; `tofray process raw/frame.npz -o out`"));
  const Result sizes =
      run({"quality", "x.csv", "y.csv"}, [&] { in_folder(folder.path())(), write("x.csv", "1,1\n"), write("y.csv", "1,1,1\n"); });
  EXPECT_TRUE(has(sizes.err, "frame 1 has another size than frame 0")) << sizes.err;
}

TEST(quality_command, tells_of_frames_in_which_something_moves) {
  const Folder folder;
  ASSERT_EQ(run({"render", "flying-ball", "-o", "ball", "--frames", "2", "-q"}, in_folder(folder.path())).code, 0);
  EXPECT_TRUE(has(run({"quality", "ball"}, in_folder(folder.path())).err, "warning: the truth of the frames differs: something moves"));
  EXPECT_FALSE(has(in_frames({"quality", "wall"}).err, "something moves"));
}

TEST(compare_command, compares_a_frame_with_its_truth_or_with_another) {
  const Result own = in_frames({"compare", "step", "--json"});
  ASSERT_EQ(own.code, 0) << own.err;
  const DepthFile step = load_depth((frames() / "step/frame.npz").native());
  const Comparison expected = compare(step.depth, depth_of(step.truth));
  const files::Json json = files::parse_json(own.out, "compare");
  EXPECT_EQ(figure_of(*json.find("all"), "bias_m"), expected.all.bias_m);
  EXPECT_EQ(figure_of(*json.find("edges"), "p95_m"), expected.edges.p95_m);
  EXPECT_EQ(figure_of(json, "chi2"), expected.chi2);
  const Result pair =
      in_frames({"compare", "wall/frame_0000.npz", "wall/frame_0001.npz:truth", "--quantity", "range", "--shift", "fit", "--json"});
  ASSERT_EQ(pair.code, 0) << pair.err;
  CompareRequest request;
  request.range = request.fit_shift = true;
  const Comparison shifted = compare(load_depth((frames() / "wall/frame_0000.npz").native()).depth,
                                     depth_of(load_depth((frames() / "wall/frame_0001.npz").native()).truth), request);
  EXPECT_EQ(figure_of(files::parse_json(pair.out, "compare"), "shift_m"), shifted.shift_m);
}

TEST(compare_command, shows_tables_and_writes_the_map) {
  const std::string text = in_frames({"compare", "step", "--distance", "0.5m,1.1m,2m", "--region", "10,10,100,80"}).out;
  EXPECT_TRUE(has(text, "A step/frame.npz\nB step/frame.npz:truth\nz of columns 10 to 109, rows 10 to 89: depth in both ")) << text;
  EXPECT_TRUE(has(text, "\n  at edges ") && has(text, "\n  0.5 to 1.1 m ") && has(text, "chi2 of noise_m ")) << text;
  const Folder folder;
  const std::string step = (frames() / "step").native();
  for (const char* name : {"map.png", "map.svg", "map.pdf", "map.csv", "map.json"})
    ASSERT_EQ(run({"compare", step, "-o", name}, in_folder(folder.path())).code, 0) << name;
  EXPECT_TRUE(content(folder / "map.png").starts_with("\x89PNG"));
  EXPECT_TRUE(has(content(folder / "map.svg"), "pixels by difference"));
  EXPECT_TRUE(content(folder / "map.pdf").starts_with("%PDF"));
  EXPECT_TRUE(content(folder / "map.csv").starts_with("of,low_m,high_m,pixels,bias_m,"));
  EXPECT_EQ(content(folder / "map.json"), run({"compare", step, "--json"}).out);
}

TEST(compare_command, holds_limits_and_says_what_is_missing) {
  EXPECT_EQ(in_frames({"compare", "wall/frame_0000.npz", "--limit", "bias=50mm,both=90%,chi2=1.2"}).code, 0);
  const Result beyond = in_frames({"compare", "wall/frame_0000.npz", "--limit", "flat_p95=0.1mm"});
  EXPECT_EQ(beyond.code, 1);
  EXPECT_TRUE(has(beyond.err, "limit: flat_p95 is ") && has(beyond.err, "beyond 0.1 mm")) << beyond.err;
  const Folder folder;
  write(folder / "a.csv", "1,1\n");
  write(folder / "b.csv", "1\n1\n");
  const Result sizes = run({"compare", "a.csv", "b.csv"}, in_folder(folder.path()));
  EXPECT_EQ(sizes.code, 2);
  EXPECT_TRUE(has(sizes.err, "error: A and B have different sizes\n  got 2 x 1 and 1 x 2")) << sizes.err;
  const Result truth = run({"compare", "a.csv"}, in_folder(folder.path()));
  EXPECT_EQ(truth.code, 2);
  EXPECT_TRUE(has(truth.err, "a.csv: error: there is no ground truth in it\n  expected gt_z_m")) << truth.err;
}

}  // namespace
}  // namespace tofray::test
