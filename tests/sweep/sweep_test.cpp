// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Axes out of words, numbers of cells by another way than the sweep's, and the cells that nothing beats.
#include "tofray/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "files/npz.h"
#include "support/tool.h"
#include "sweep/metrics.h"
#include "sweep/sweep_files.h"
#include "tofray/error.h"

namespace tofray {
namespace {

using test::has;

using Words = std::vector<std::string>;
const InputRequest card{"card", {}, "", "", {}};

std::string fault_of(const std::string& axis) {
  try {
    (void)sweep_axis(axis, card);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(axes, are_lists_ranges_and_all_that_a_choice_may_be) {
  EXPECT_EQ(sweep_axis("lens.f_number=1.2, 1.4,2", card).values, (Words{"1.2", "1.4", "2"}));
  EXPECT_EQ(sweep_axis("lens.f_number=1.2,1.4,2", card).key, "camera.lens.f_number");
  EXPECT_EQ(sweep_axis("illumination.0.power=100mW:1W:4", card).values, (Words{"100mW", "400 mW", "700 mW", "1W"}));
  const SweepAxis log = sweep_axis("camera.illumination.*.power=0.1W:10W:log3", card);
  EXPECT_EQ(log.values, (Words{"0.1W", "1 W", "10W"}));
  EXPECT_EQ(log.numbers, (std::vector<double>{0.1, 1, 10}));
  EXPECT_EQ(log.unit, "W");
  EXPECT_EQ(log.stage, Stage::power);
  EXPECT_EQ(sweep_axis("illumination.0.waveform.duty=10%:50%:3", card).values, (Words{"10%", "30 %", "50%"}));
  EXPECT_EQ(sweep_axis("adc.bits=10:12:3", card).values, (Words{"10", "11", "12"}));
  EXPECT_EQ(sweep_axis("decoding.filter.kind=@all", card).values, (Words{"none", "gaussian", "median", "bilateral", "adaptive"}));
  EXPECT_EQ(sweep_axis("decoding.wiggling_correction=@all", card).values, (Words{"true", "false"}));
  EXPECT_EQ(sweep_axis("mode=@all", card).values, load_inputs(card).camera.mode_names);
  EXPECT_EQ(sweep_axis_of_numbers("integration_time", {1e-4, 2e-4}, card).values, (Words{"0.0001 s", "0.0002 s"}));
  EXPECT_EQ(sweep_axis_of_numbers("adc.bits", {12}, card).values, (Words{"12"}));
  EXPECT_THROW(sweep_axis_of_numbers("mode", {12}, card), Error);
  EXPECT_EQ(sweep_axis("profile=@all", card).key, "camera.profile");
  EXPECT_EQ(sweep_axis("objects.0.rectangle.material={diffuse: 0.2},paper", card).values, (Words{"{diffuse: 0.2}", "paper"}));
  EXPECT_EQ(sweep_axis("camera.pose.position=[0, 0, 0],[0, 0, 0.1]", card).values, (Words{"[0, 0, 0]", "[0, 0, 0.1]"}));
  EXPECT_EQ(sweep_axis("pixel.read_noise=0e:10e:2", card).numbers, (std::vector<double>{0, 10}));
}

TEST(axes, say_what_is_wrong_with_them) {
  EXPECT_TRUE(has(fault_of("lens.f_numbr=1"),
                  "error: --vary has an unknown key \"lens.f_numbr\"; did you mean \"lens.f_number\"?\n  expected a key"));
  EXPECT_TRUE(has(fault_of("illumination.*.powr=1W"), "did you mean \"illumination.0.power\"?"));
  EXPECT_TRUE(has(fault_of("lens.f_number"), "error: --vary cannot be \"lens.f_number\"\n  expected KEY=VALUES"));
  EXPECT_TRUE(has(fault_of("=1"), "expected KEY=VALUES"));
  EXPECT_TRUE(has(fault_of("lens.f_number=1.2,,2"), "expected a value between two commas"));
  EXPECT_TRUE(has(fault_of("illumination.0.power=nan W"),
                  "error: --vary camera.illumination.0.power cannot be \"nan W\"\n  expected 0 W to 10000 W"));
  EXPECT_TRUE(has(fault_of("illumination.0.power=1"), "as in 0.2 W"));
  EXPECT_TRUE(has(fault_of("illumination.0.power=0W:1W:log5"), "expected both ends of a logarithmic range above 0"));
  EXPECT_TRUE(has(fault_of("illumination.0.power=1W:2W:1"), "expected 2 to 100000 values"));
  EXPECT_TRUE(has(fault_of("illumination.0.power=1W:2m:3"), "cannot be \"2m\""));
  EXPECT_TRUE(has(fault_of("adc.bits=10:12:4"), "expected whole numbers alone, and 10.6666666667 is none"));
  EXPECT_TRUE(has(fault_of("mode=1:2:3"), "only numbers have ranges"));
  EXPECT_TRUE(has(fault_of("lens.f_number=@all"), "@all is for choices, switches, mode and profile"));
}

std::string fault_of(const SweepRequest& request) {
  try {
    (void)sweep(request);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(sweeps_of_cells, refuse_what_cannot_be) {
  SweepRequest request;
  request.inputs = card;
  EXPECT_TRUE(has(fault_of(request), "error: nothing varies"));
  const SweepAxis noise = sweep_axis("pixel.read_noise=1e:100e:1000", card), other = sweep_axis("lens.f_number=1:2:1000", card);
  request.axes = {noise, noise};
  EXPECT_TRUE(has(fault_of(request), "error: --vary has camera.pixel.read_noise twice"));
  request.axes = {noise, other};
  EXPECT_TRUE(has(fault_of(request), "error: a sweep of 1000000 cells is too large\n  at most 100000"));
  request.axes = {sweep_axis("pixel.read_noise=1e,2e", card)};
  request.metrics = {"sigmaa"};
  EXPECT_TRUE(has(fault_of(request), "error: no metric is called \"sigmaa\"; did you mean \"sigma\"?\n  expected bias, median, sigma"));
  request.metrics = {}, request.region = {220, 0, 20, 20};
  EXPECT_TRUE(has(fault_of(request), "error: the region is not in the image") &&
              has(fault_of(request), "in the cell camera.pixel.read_noise=1e"));
  request.region = {}, request.repeat = 0;
  EXPECT_TRUE(has(fault_of(request), "error: cells of 0 frames"));
  request.repeat = 1, request.axes = {sweep_axis("adc.bits=8,12", card)};
  EXPECT_TRUE(has(fault_of(request), "in the cell camera.adc.bits=8"));
  request.axes = {sweep_axis("objects.*.sphere.radius=1cm,2cm", card)};
  EXPECT_TRUE(has(fault_of(request), "* means no element of this scene"));
}

TEST(sweeps_of_cells, set_a_key_of_all_elements_of_a_list) {
  SweepRequest request;
  const test::Folder folder;
  test::write(folder / "scene.yaml", R"(camera: {profile: pico-flexx}
objects:
  - plane: {point: [0, 0, 2], normal: [0, 0, -1], reflectivity: 0.5}
  - sphere: {center: [0, 0, 1], radius: 10 cm, reflectivity: 0.5}
  - plane: {point: [0.4, 0, 0], normal: [-1, 0, 0], reflectivity: 0.5, name: side}
)");
  request.inputs = {(folder / "scene.yaml").native(), {}, "", "", {}};
  request.axes = {sweep_axis("objects.*.plane.reflectivity=20%,90%", request.inputs)};
  request.simulator.noise = Noise::off, request.metrics = {"amplitude"}, request.by_object = true;
  const Sweep found = sweep(request);
  EXPECT_EQ(found.regions, (Words{"all", "objects.0", "objects.1", "objects.2 (side)"}));
  const auto ratio = [&](std::size_t region) { return found.value(1, region, 0) / found.value(0, region, 0); };
  EXPECT_NEAR(ratio(1), 4.5, 0.01);
  EXPECT_NEAR(ratio(2), 1, 1e-6);
  EXPECT_NEAR(ratio(3), 4.5, 0.01);
}

TEST(sweeps_of_cells, have_cameras_of_other_sizes_side_by_side) {
  SweepRequest request;
  request.inputs = card;
  request.axes = {sweep_axis("profile=pico-flexx,o3d303", card), sweep_axis("illumination.*.power=10mW,1W", card)};
  request.metrics = {"fill", "sigma"}, request.simulator.noise = Noise::off;
  const Sweep found = sweep(request);
  ASSERT_EQ(found.cells(), 4U);
  for (std::uint64_t cell = 0; cell < 4; cell += 2) EXPECT_GT(found.value(cell, 0, 1), found.value(cell + 1, 0, 1)) << cell;
}

TEST(sweeps_of_cells, trace_once_where_only_the_sensor_varies_and_expose_once_where_only_decoding_does) {
  SweepRequest request;
  request.inputs = card;
  request.axes = {sweep_axis("pixel.read_noise=1e:100e:5", card)};
  const Sweep sensor = sweep(request);
  EXPECT_EQ(sensor.traced, 1U);
  EXPECT_EQ(sensor.from_light, 4U);
  request.axes = {sweep_axis("decoding.noise_threshold=5mm:50mm:5", card)};
  request.repeat = 3;
  const Sweep decoding = sweep(request);
  EXPECT_EQ(decoding.traced, 1U);
  EXPECT_EQ(decoding.from_light, 2U);
  EXPECT_EQ(decoding.from_raw, 12U);
  request.axes = {sweep_axis("lens.f_number=1,2", card)};
  EXPECT_EQ(sweep(request).traced, 6U);
}

/// A frame of 4 x 3 pixels with errors in mm row by row; NaN: no depth.
Frame frame_of(const std::vector<double>& errors_mm) {
  Frame out;
  out.depth.width = out.truth.width = out.raw.width = 4, out.depth.height = out.truth.height = out.raw.height = 3, out.raw.phases = 1;
  out.raw.lit = {1};
  for (const double error : errors_mm) {
    const bool valid = !std::isnan(error);
    const float z = valid ? static_cast<float>(1 + 1e-3 * error) : std::numeric_limits<float>::quiet_NaN();
    out.depth.z_m.push_back(z), out.depth.range_m.push_back(2 * z), out.depth.noise_m.push_back(0.004f);
    out.depth.amplitude_e.push_back(valid ? 100 : 0), out.depth.flags.push_back(valid ? 0 : flag_saturated);
    out.truth.z_m.push_back(1), out.truth.range_m.push_back(2), out.truth.object_id.push_back(out.truth.object_id.size() < 4 ? 0 : 1);
    out.raw.tap_a.push_back(500), out.raw.tap_b.push_back(250), out.raw.raw.push_back(1000);
  }
  return out;
}

Camera small_camera() {
  Camera out;
  out.mode.sequence = {{true, 30e6, 0, 1e-3}};
  out.pixel.full_well_e = 1000;
  out.adc.mid_code = 2048, out.adc.valid_min = 48, out.adc.valid_max = 4095;
  return out;
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();
const std::vector<double> errors = {1, 2, 3, 10, none, -4, 5, 2000, 7, 8, 9, none};

double number_of(const std::string& metric, const ImageRegion& region, const std::vector<std::vector<double>>& frames,
                 std::size_t part = 0) {
  static const std::vector<int> parts = {1, 2};
  const sweeps::Wanted wanted = sweeps::wanted_metrics({metric});
  sweeps::Measuring measuring(wanted, small_camera(), region, parts, frames.size());
  for (const std::vector<double>& one : frames) measuring.take(frame_of(one));
  return measuring.values()[part];
}

TEST(metrics_of_cells, are_those_of_their_definitions) {
  const ImageRegion all{0, 0, 4, 3};
  EXPECT_NEAR(number_of("bias", all, {errors}), 1e-3 * 2041 / 10, 1e-6);
  EXPECT_NEAR(number_of("median", all, {errors}), 6e-3, 1e-6);  // between 5 and 7
  EXPECT_NEAR(number_of("rmse", all, {errors}), 1e-3 * std::sqrt((1 + 4 + 9 + 100 + 16 + 25 + 4e6 + 49 + 64 + 81) / 10.0), 1e-5);
  EXPECT_NEAR(number_of("p95", all, {errors}), 1e-3 * (10 + 0.55 * 1990), 1e-5);
  EXPECT_NEAR(number_of("fill", all, {errors}), 100 * 10 / 12.0, 1e-12);
  // 30 MHz: half a cycle is 2.498 m of range, a whole one 4.997 m, and 2 m of z are 4 m of range.
  EXPECT_NEAR(number_of("wrong_cycle", all, {errors}), 10, 1e-12);
  EXPECT_NEAR(number_of("saturated", all, {errors}), 100 * 2 / 12.0, 1e-12);
  EXPECT_NEAR(number_of("amplitude", all, {errors}), 100, 1e-12);
  EXPECT_NEAR(number_of("noise", all, {errors}), 4e-3, 1e-9);
  EXPECT_NEAR(number_of("sigma", all, {errors}), 2e-3, 1e-9);  // of z: half of the range's
  EXPECT_NEAR(number_of("tap_filling", all, {errors}), 50, 1e-9);
  EXPECT_NEAR(number_of("adc_filling", all, {errors}), 100 * 1048 / 2000.0, 1e-3);
}

TEST(metrics_of_cells, are_of_the_regions_pixels_alone) {
  EXPECT_NEAR(number_of("bias", {1, 1, 2, 2}, {errors}), 1e-3 * (-4 + 5 + 8 + 9) / 4, 1e-6);
  EXPECT_NEAR(number_of("bias", {0, 0, 1, 3}, {errors}), 1e-3 * (1 + 7) / 2, 1e-6);
  EXPECT_NEAR(number_of("fill", {0, 1, 1, 1}, {errors}), 0, 0);
  EXPECT_TRUE(std::isnan(number_of("bias", {0, 1, 1, 1}, {errors})));
  EXPECT_NEAR(number_of("median", {0, 0, 4, 3}, {errors}, 1), 2.5e-3, 1e-6);  // the first object's
  EXPECT_NEAR(number_of("fill", {0, 0, 4, 3}, {errors}, 2), 100 * 6 / 8.0, 1e-9);
}

TEST(metrics_of_cells, over_frames_are_of_pixels_with_a_depth_in_all_with_the_divisor_n_minus_1) {
  std::vector<double> second = errors, third = errors;
  second[0] = 4, third[0] = 1;       // variance 3 by n − 1
  second[1] = none, third[1] = 100;  // not in all
  const ImageRegion first_row{0, 0, 4, 1};
  EXPECT_NEAR(number_of("sigma", first_row, {errors, second, third}), 1e-3 * std::sqrt(3 / 3.0), 1e-6);  // of three pixels
  EXPECT_NEAR(number_of("fill", first_row, {errors, second, third}), 100 * 11 / 12.0, 1e-9);
  EXPECT_NEAR(number_of("sigma", first_row, {errors, second, third}, 1), 1e-3, 1e-6);
}

TEST(best_cells, are_those_that_nothing_beats) {
  Sweep of;
  of.axes = {{"camera.illumination.0.power", {"1 W", "2 W", "3 W", "4 W", "5 W"}, {1, 2, 3, 4, 5}, "W", Stage::power}};
  of.regions = {"all"}, of.metrics = {"sigma_m", "fill_percent", "bias_m"};
  of.values = {0.05, 90, -0.001, 0.03, 96, 0.003, 0.02, 99, none, 0.02, 97, 0, 0.01, 94, -0.02};
  using Cells = std::vector<std::uint64_t>;
  EXPECT_EQ(best_cells(of, "sigma"), (Cells{4}));
  EXPECT_EQ(best_cells(of, "sigma, fill>95%"), (Cells{2, 3}));
  EXPECT_EQ(best_cells(of, "sigma, illumination.0.power, fill > 95 %"), (Cells{2, 1}));
  EXPECT_EQ(best_cells(of, "sigma, fill"), (Cells{4, 2}));
  EXPECT_EQ(best_cells(of, "bias"), (Cells{3}));            // nearest to 0; NaN is none
  EXPECT_EQ(best_cells(of, "fill, bias<5mm"), (Cells{3}));  // either way
  EXPECT_EQ(best_cells(of, "sigma_m, illumination.0.power<2500 mW"), (Cells{1}));
  EXPECT_EQ(best_cells(of, "sigma, fill>99.5%"), (Cells{}));
  const auto fault = [&](const std::string& wish) {
    try {
      (void)best_cells(of, wish);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_TRUE(has(fault("sigm"), "error: --best: the sweep has no \"sigm\"; did you mean \"sigma\"?"));
  EXPECT_TRUE(has(fault("fill>95%"), "has no aim"));
  EXPECT_TRUE(has(fault("sigma, fill>95mm"), "fill cannot be held against \"95mm\"\n  expected a number with a unit, as in 5 %"));
  EXPECT_TRUE(has(fault("sigma, sigma<5"), "as in 5 mm"));
}

TEST(files_of_a_sweep, have_the_axes_by_name) {
  Sweep of;
  of.axes = {{"mode", {"A", "B,C"}, {}, "", Stage::trace}, {"camera.lens.f_number", {"1", "2", "4"}, {1, 2, 4}, "", Stage::power}};
  of.regions = {"all", "objects.0 (ball)"}, of.metrics = {"sigma_m", "fill_percent"};
  for (int i = 0; i < 24; ++i) of.values.push_back(i == 5 ? none : i);
  const std::string csv = sweeps::csv_text(of);
  EXPECT_TRUE(csv.starts_with("mode,camera.lens.f_number,region,sigma_m,fill_percent\nA,1,all,0,1\nA,1,objects.0 (ball),2,3\nA,2,all,4,\n"))
      << csv;
  EXPECT_TRUE(has(csv, "\"B,C\",4,all,20,21\n")) << csv;
  const auto arrays = files::parse_npz(sweeps::npz_bytes(of), "sweep.npz");
  const auto array = [&](const std::string& name) {
    return std::find_if(arrays.begin(), arrays.end(), [&](const auto& one) { return one.name == name; })->array;
  };
  EXPECT_EQ(array("sigma_m").shape, (files::NpyShape{2, 3, 2}));
  EXPECT_EQ(array("sigma_m").number(11), 22);
  EXPECT_EQ(array("axes").shape, (files::NpyShape{2}));
  EXPECT_EQ(array("camera.lens.f_number").number(2), 4);
  EXPECT_EQ(array("mode").type.kind, 'U');
}

}  // namespace
}  // namespace tofray
