// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "files/json.h"
#include "rows.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

using namespace tofray::app;

Timing made_up(const std::string& code, int threads, int block_size, double ms) {
  Timing run;
  run.code = code, run.threads = threads, run.block_size = block_size;
  run.ms_median = ms, run.ms_p10 = 0.9 * ms;
  run.sha256 = "same";
  return run;
}

/// 8 ms of sequential code, 1 ms of vector code, and a GPU that is fastest at the block size given.
Group made_up_group(const std::string& scene, const std::string& stage, int fastest) {
  Group group{scene, 16, stage, made_up("scalar_fma", 1, 0, 8), made_up("avx512", 2, 0, 1), {}};
  for (int size = 32; size <= 1024; size += 32) {
    const double octaves = std::log2(static_cast<double>(size) / fastest);
    group.runs.push_back(made_up("cuda", 0, size, 0.02 * (1 + 0.1 * octaves * octaves)));
    group.runs.back().occupancy = 0.5;
  }
  return group;
}

Experiment made_up_experiment() {
  Experiment experiment;
  experiment.backend = "cuda", experiment.cpu = "Some CPU", experiment.gpu = "Some GPU", experiment.noise = "exact";
  experiment.frames = 30, experiment.width = 224, experiment.height = 172, experiment.raw_frames = 9;
  for (const auto& [scene, fastest] : {std::pair<const char*, int>{"bench-spheres", 64}, {"bench-planes", 256}}) {
    experiment.groups.push_back(made_up_group(scene, "power", fastest));
    experiment.groups.push_back(made_up_group(scene, "all", 512));
  }
  return experiment;
}

std::string line_with(const std::string& text, const std::string& part) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (has(line, part)) return line;
  }
  return {};
}

TEST(experiment, speed_up_is_the_ratio_of_medians) {
  EXPECT_DOUBLE_EQ(speed_up(made_up("scalar_fma", 1, 0, 8), made_up("cuda", 0, 32, 0.02)), 400);
  Timing broken = made_up("cuda", 0, 1024, 0.02);
  broken.fault = "too many registers";
  EXPECT_TRUE(std::isnan(speed_up(made_up("scalar_fma", 1, 0, 8), broken)));
}

TEST(experiment, best_block_size_of_a_stage_is_that_of_the_geometric_mean) {
  const Experiment experiment = made_up_experiment();
  EXPECT_EQ(experiment.groups[0].runs[static_cast<std::size_t>(best_run(experiment.groups[0]))].block_size, 64);
  const std::vector<Best> best = best_of_stages(experiment);
  ASSERT_EQ(best.size(), 2u);
  EXPECT_EQ(best[0].stage, "power");
  EXPECT_EQ(best[0].x, 128);  // one octave from both scenes' own best
  EXPECT_NEAR(best[0].speed_up, 400 / 1.1, 1e-9);
  EXPECT_EQ(best[1].x, 512);
  EXPECT_NEAR(best[1].speed_up, 400, 1e-9);
}

TEST(experiment, a_block_size_that_one_scene_cannot_have_is_not_best_for_the_stage) {
  Experiment experiment = made_up_experiment();
  for (Timing& run : experiment.groups[2].runs) {
    if (run.block_size != 128) continue;
    run.fault = "no registers left";
    run.ms_median = std::nan("");
  }
  EXPECT_NE(best_of_stages(experiment)[0].x, 128);
  EXPECT_TRUE(has(line_with(experiment_table(experiment), "cannot run"), "no registers left"));
  const std::string svg = pictures::chart_svg(experiment_chart(experiment));
  EXPECT_FALSE(has(svg, "nan"));
}

TEST(experiment, table_has_a_line_for_each_run_with_its_gain) {
  Experiment experiment = made_up_experiment();
  experiment.groups[0].runs[1].ms_median = 1.88;  // 8 ms less 76.5 %
  experiment.groups[0].runs[3].sha256 = "other";
  const std::string table = experiment_table(experiment);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4 * (2 + 32) + 8);
  EXPECT_TRUE(has(table, "224 x 172 pixels, 9 raw frames, noise exact, medians of 30 frames\nCPU  Some CPU\nGPU  Some GPU\n"));
  const std::string line = line_with(table, "power  cuda              -     64");
  for (const char* part : {"bench-spheres", "16", "50 %", "1.8800", "4.26", "0.53", "76.5 %", "yes"}) EXPECT_TRUE(has(line, part)) << line;
  EXPECT_TRUE(line_with(table, "cuda              -    128").ends_with("NO"));
  EXPECT_EQ(other_bytes(experiment), (std::vector<std::string>{"bench-spheres power cuda 128"}));
}

TEST(experiment, json_says_the_same) {
  Experiment experiment = made_up_experiment();
  experiment.groups[0].runs[31].fault = "no registers left";
  const files::Json json = files::parse_json(files::json_text(experiment_json(experiment)), "experiment");
  const files::Json::Array& rows = *json.find("results")->items();
  ASSERT_EQ(rows.size(), 4u * 34);
  EXPECT_EQ(*rows[0].find("role")->string(), "scalar");
  EXPECT_EQ(*rows[1].find("role")->string(), "vector");
  EXPECT_EQ(*rows[3].find("role")->string(), "best");  // block size 64
  EXPECT_EQ(number(rows[3], "block_size"), 64);
  EXPECT_TRUE(rows[3].find("threads")->is_null());
  EXPECT_NEAR(number(rows[3], "speed_up_scalar"), 400, 1e-9);
  EXPECT_NEAR(number(rows[3], "speed_up_vector"), 50, 1e-9);
  EXPECT_NEAR(number(rows[3], "less_time"), 1 - 1 / 400., 1e-12);
  EXPECT_EQ(number(rows[3], "occupancy"), 0.5);
  EXPECT_EQ(*rows[33].find("fault")->string(), "no registers left");
  EXPECT_TRUE(rows[33].find("speed_up_scalar")->is_null());
  EXPECT_EQ(number((*json.find("best")->items())[0], "block_size"), 128);
}

TEST(experiment, chart_has_a_curve_for_each_scene_and_stage_with_its_best_marked) {
  const pictures::Chart chart = experiment_chart(made_up_experiment());
  ASSERT_EQ(chart.curves.size(), 4u);
  EXPECT_EQ(chart.curves[0].name, "spheres, power");
  EXPECT_EQ(chart.curves[3].name, "planes, all");
  EXPECT_EQ(chart.curves[0].color, chart.curves[1].color);  // a scene, a colour
  EXPECT_FALSE(chart.curves[0].color == chart.curves[2].color);
  EXPECT_FALSE(chart.curves[2].dashed);
  EXPECT_TRUE(chart.curves[3].dashed);
  EXPECT_EQ(chart.curves[2].x[static_cast<std::size_t>(chart.curves[2].marked)], 256);
  EXPECT_NEAR(chart.curves[2].y[static_cast<std::size_t>(chart.curves[2].marked)], 400, 1e-9);
  EXPECT_EQ(chart.x_ticks, (std::vector<double>{32, 128, 256, 384, 512, 640, 768, 896, 1024}));
  EXPECT_EQ(chart.x_label, "threads per block");
  EXPECT_TRUE(pictures::chart_png(chart).starts_with("\x89PNG"));
}

TEST(experiment, on_the_processor_really_measures_and_writes_all_files) {
  const Folder folder;
  const Result result =
      run(with_small_sensor({"bench", "--backend", "cpu", "--stage", "power,all", "--frames", "7", "--threads", "3", "--json"}),
          in_folder(folder.path()));
  ASSERT_EQ(result.code, 0) << result.err;
  const files::Json json = files::parse_json(result.out, "stdout");
  EXPECT_EQ(content(folder / "tofray-bench" / "experiment.json"), result.out);
  std::map<std::string, int> rows_of;
  for (const files::Json& row : *json.find("results")->items()) {
    ++rows_of[*row.find("scene")->string() + " " + *row.find("stage")->string()];
    EXPECT_EQ(number(row, "objects"), 16);
    EXPECT_GT(number(row, "ms_median"), 0);
    EXPECT_LE(number(row, "ms_p10"), number(row, "ms_median"));
    EXPECT_GT(number(row, "speed_up_scalar"), 0);
    EXPECT_EQ(row.find("sha256")->string()->size(), 64u);
  }
  EXPECT_EQ(rows_of.size(), 8u);                                          // four scenes, two stages
  for (const auto& [name, count] : rows_of) EXPECT_EQ(count, 5) << name;  // two yardsticks, then 1, 2 and 3 threads
  EXPECT_TRUE(content(folder / "tofray-bench" / "speed-up.png").starts_with("\x89PNG"));
  EXPECT_TRUE(content(folder / "tofray-bench" / "speed-up.svg").starts_with("<svg "));
  EXPECT_TRUE(has(content(folder / "tofray-bench" / "experiment.txt"), "best threads for power: "));
}

TEST(experiment, each_stage_goes_further_than_the_one_before) {
  const Folder folder;
  const Result result =
      run({"bench", "room", "--backend", "cpu", "--stage", "trace,power,raw,all", "--frames", "5", "--threads", "1", "--json", "-o", "out"},
          in_folder(folder.path()));
  ASSERT_EQ(result.code, 0) << result.err;
  const files::Json json = files::parse_json(result.out, "stdout");
  std::map<std::string, std::string> hash_of;
  std::map<std::string, double> scalar_ms;
  for (const files::Json& row : *json.find("results")->items()) {
    if (*row.find("role")->string() != "scalar") continue;
    hash_of[*row.find("sha256")->string()] = *row.find("stage")->string();  // what a stage gives, no other one does
    scalar_ms[*row.find("stage")->string()] = number(row, "ms_p10");
  }
  EXPECT_EQ(hash_of.size(), 4u);
  // Tracing is about a tenth of a frame; the fastest of five frames is no victim of other work on the machine.
  EXPECT_LT(scalar_ms["trace"], scalar_ms["all"]);
}

TEST(experiment, with_a_gpu_each_block_size_is_measured) {
  const Folder folder;
  const Result result = run(with_small_sensor({"bench", "card", "--backend", "cuda", "--block-size", "32:1024:32", "--stage", "power,all",
                                               "--frames", "3", "--json"}),
                            in_folder(folder.path()));
  if (result.code == 5) {
    EXPECT_TRUE(has(result.err, "error: no GPU can be used: ")) << result.err;
    EXPECT_FALSE(*files::parse_json(result.out, "stdout").find("good")->boolean());
    EXPECT_TRUE(fs::is_empty(folder.path()));
    GTEST_SKIP() << result.err;
  }
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(files::parse_json(result.out, "stdout").find("results")->items()->size(), 2u * 34);
}

TEST(bench_batch, on_the_processor_frames_go_to_the_host_only) {
  const Result result = run(with_small_sensor({"bench", "--backend", "cpu", "--batch", "3", "--frames", "2", "--json"}));
  ASSERT_EQ(result.code, 0) << result.err;
  const files::Json json = files::parse_json(result.out, "stdout");
  const files::Json& row = (*json.find("results")->items())[0];
  EXPECT_GT(number(row, "frames_per_s_host"), 0);
  EXPECT_TRUE(row.find("frames_per_s_device")->is_null());
  const Result table = run(with_small_sensor({"bench", "--backend", "cpu", "--batch", "3", "--frames", "2"}));
  EXPECT_TRUE(has(line_with(table.out, "poses"), "bench-primitives")) << table.out;
}

/// A counter that goes up by 2 J whenever it is read.
class FakeMeter : public energy::Meter {
 public:
  explicit FakeMeter(const std::string& reason = {}) { measures("fake"), cannot(reason); }
  void break_down() { cannot("gone"); }
  int reads = 0;

 protected:
  double advance() override { return ++reads, 2; }
};

TEST(bench_energy, is_joules_by_frames) {
  FakeMeter cpu, gpu;
  int frames = 0;
  const Energy energy = energy_per_frame(cpu, &gpu, 0, 1, [&] { ++frames; });
  EXPECT_EQ(frames, 10);  // least
  EXPECT_DOUBLE_EQ(energy.cpu.joules, 0.2);
  EXPECT_DOUBLE_EQ(energy.gpu.joules, 0.2);
  EXPECT_EQ(energy_text(energy_json(energy)), "CPU 0.2 J (fake); GPU 0.2 J (fake)");
}

TEST(bench_energy, runs_no_frame_where_nothing_can_be_read_and_says_why) {
  FakeMeter cpu("no counter"), gpu("no driver");
  int frames = 0;
  const Energy energy = energy_per_frame(cpu, &gpu, 100, 1, [&] { ++frames; });
  EXPECT_EQ(frames, 0);
  const files::Json json = energy_json(energy);
  EXPECT_TRUE(json.find("cpu_j_per_frame")->is_null());
  EXPECT_EQ(*json.find("gpu_not_readable")->string(), "no driver");
  EXPECT_EQ(energy_text(json), "CPU not readable here: no counter; GPU not readable here: no driver");
}

TEST(bench_energy, a_counter_that_goes_half_way_is_not_readable) {
  FakeMeter cpu, gpu;
  int frames = 0;
  const Energy energy = energy_per_frame(cpu, &gpu, 0, 1, [&] {
    if (++frames == 3) cpu.break_down();
  });
  EXPECT_EQ(energy_text(energy_json(energy)), "CPU not readable here: gone; GPU 0.2 J (fake)");
  EXPECT_TRUE(has(energy_text(energy_json(energy_per_frame(gpu, nullptr, 0, 1, [] {}))), "CPU 0.2 J"));
}

TEST(bench_energy, is_in_the_table_and_in_json) {
  const Result table = run(with_small_sensor({"bench", "--frames", "2", "--backend", "cpu"}));
  EXPECT_TRUE(has(line_with(table.out, "energy per frame: "), "bench-primitives")) << table.out;
  const files::Json json =
      files::parse_json(run(with_small_sensor({"bench", "--frames", "2", "--backend", "cpu", "--json"})).out, "stdout");
  const files::Json& energy = *(*json.find("results")->items())[0].find("energy");
  EXPECT_NE(energy.find("cpu_j_per_frame")->is_null(), energy.find("cpu_not_readable")->is_null());
  EXPECT_EQ(energy.find("gpu_j_per_frame"), nullptr);  // no GPU takes part
}

}  // namespace
}  // namespace tofray::test
