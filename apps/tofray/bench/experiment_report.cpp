// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bench/experiment.h"
#include "num/setup_math.h"

namespace tofray::app {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const char* x_name(const Experiment& experiment) { return experiment.backend == "cuda" ? "threads per block" : "threads"; }

std::vector<std::string> stages_of(const Experiment& experiment) {
  std::vector<std::string> stages;
  for (const Group& group : experiment.groups) {
    if (std::find(stages.begin(), stages.end(), group.stage) == stages.end()) stages.push_back(group.stage);
  }
  return stages;
}

const Timing* run_at(const Group& group, int x) {
  const auto found = std::find_if(group.runs.begin(), group.runs.end(), [&](const Timing& run) { return run.x() == x && run.ran(); });
  return found == group.runs.end() ? nullptr : &*found;
}

/// Every run of a group, the two yardsticks first.
std::vector<const Timing*> all_runs(const Group& group) {
  std::vector<const Timing*> all = {&group.scalar, &group.vector};
  for (const Timing& run : group.runs) all.push_back(&run);
  return all;
}

/// Geometric mean of the speed-ups of one stage's scenes at x; NaN where it did not run in all of them.
double mean_speed_up(const Experiment& experiment, const std::string& stage, int x) {
  double sum = 0;
  int scenes = 0;
  for (const Group& group : experiment.groups) {
    if (group.stage != stage) continue;
    const Timing* const run = run_at(group, x);
    sum += run == nullptr ? nan : num::setup::log(speed_up(group.scalar, *run));
    ++scenes;
  }
  return num::setup::exp(sum / scenes);
}

std::string count_or_dash(int count) { return count > 0 ? std::to_string(count) : "-"; }

std::string row_of(const Group& group, const Timing& run) {
  const std::string start = fmt::format("{:<18} {:>7}  {:<6} {:<11} {:>7} {:>6} ", group.scene, group.objects, group.stage, run.code,
                                        count_or_dash(run.threads), count_or_dash(run.block_size));
  if (!run.ran()) return start + " cannot run: " + run.fault + "\n";
  const std::string occupancy = run.occupancy ? fmt::format("{:.0f} %", 100 * *run.occupancy) : "-";
  return start + fmt::format("{:>9} {:>10.4f} {:>10.4f} {:>9.2f} {:>9.2f} {:>9.1f} %  {}\n", occupancy, run.ms_median, run.ms_p10,
                             speed_up(group.scalar, run), speed_up(group.vector, run), 100 * (1 - 1 / speed_up(group.scalar, run)),
                             run.sha256 == group.scalar.sha256 ? "yes" : "NO");
}

/// A line for each run whose energy was asked for, or a single one where all say the same: that nothing can be read.
std::string energy_lines(const Experiment& experiment) {
  std::string lines;
  std::set<std::string> texts;
  for (const Group& group : experiment.groups) {
    for (const Timing* run : all_runs(group)) {
      if (!run->energy) continue;
      texts.insert(energy_text(energy_json(*run->energy)));
      lines += fmt::format("energy per frame, {} {} {} {}: {}\n", group.scene, group.stage, run->code, run->x(),
                           energy_text(energy_json(*run->energy)));
    }
  }
  return texts.size() == 1 ? "energy per frame: " + *texts.begin() + "\n" : lines;
}

files::Json json_of(const Group& group, const Timing& run, const char* role) {
  files::Json row = files::Json::object();
  row.set("scene", group.scene).set("objects", group.objects).set("stage", group.stage).set("role", role).set("code", run.code);
  row.set("threads", run.threads > 0 ? files::Json(run.threads) : files::Json());
  row.set("block_size", run.block_size > 0 ? files::Json(run.block_size) : files::Json());
  row.set("occupancy", run.occupancy ? files::Json(*run.occupancy) : files::Json());
  row.set("ms_median", run.ms_median).set("ms_p10", run.ms_p10);
  row.set("speed_up_scalar", speed_up(group.scalar, run)).set("speed_up_vector", speed_up(group.vector, run));
  row.set("less_time", 1 - 1 / speed_up(group.scalar, run));
  row.set("energy", run.energy ? energy_json(*run.energy) : files::Json());
  return row.set("sha256", run.sha256).set("fault", run.ran() ? files::Json() : files::Json(run.fault));
}

/// First, last and round values between: labels of an axis.
std::vector<double> ticks_of(const std::set<int>& values) {
  if (values.size() <= 12) return {values.begin(), values.end()};
  std::vector<double> ticks = {static_cast<double>(*values.begin())};
  for (int tick = 128; tick < *values.rbegin(); tick += 128) {
    if (tick > *values.begin()) ticks.push_back(tick);
  }
  ticks.push_back(*values.rbegin());
  return ticks;
}

std::string short_name(const std::string& scene) { return scene.starts_with("bench-") ? scene.substr(6) : scene; }

pictures::Curve curve_of(const Group& group) {
  pictures::Curve curve;
  curve.name = short_name(group.scene) + ", " + group.stage;
  for (const Timing& run : group.runs) {
    curve.x.push_back(run.x());
    curve.y.push_back(speed_up(group.scalar, run));
  }
  curve.marked = best_run(group);
  return curve;
}

}  // namespace

double speed_up(const Timing& base, const Timing& run) { return base.ran() && run.ran() ? base.ms_median / run.ms_median : nan; }

int best_run(const Group& group) {
  int best = -1;
  for (std::size_t i = 0; i < group.runs.size(); ++i) {
    if (!group.runs[i].ran()) continue;
    if (best < 0 || group.runs[i].ms_median < group.runs[static_cast<std::size_t>(best)].ms_median) best = static_cast<int>(i);
  }
  return best;
}

std::vector<Best> best_of_stages(const Experiment& experiment) {
  std::vector<Best> all;
  std::set<int> values;
  for (const Group& group : experiment.groups) {
    for (const Timing& run : group.runs) values.insert(run.x());
  }
  for (const std::string& stage : stages_of(experiment)) {
    Best best{stage, 0, 0};
    for (const int x : values) {
      const double mean = mean_speed_up(experiment, stage, x);
      if (mean > best.speed_up) best.x = x, best.speed_up = mean;  // never where it is NaN
    }
    if (best.x > 0) all.push_back(best);
  }
  return all;
}

std::vector<std::string> other_bytes(const Experiment& experiment) {
  std::vector<std::string> all;
  for (const Group& group : experiment.groups) {
    for (const Timing* run : all_runs(group)) {
      if (run->ran() && run->sha256 != group.scalar.sha256)
        all.push_back(fmt::format("{} {} {} {}", group.scene, group.stage, run->code, run->x()));
    }
  }
  return all;
}

std::string experiment_table(const Experiment& experiment) {
  std::string text = fmt::format("{} x {} pixels, {} raw frames, noise {}, medians of {} frames\nCPU  {}\n", experiment.width,
                                 experiment.height, experiment.raw_frames, experiment.noise, experiment.frames, experiment.cpu);
  if (!experiment.gpu.empty()) text += fmt::format("GPU  {}\n", experiment.gpu);
  text += fmt::format("\n{:<18} {:>7}  {:<6} {:<11} {:>7} {:>6} {:>9} {:>10} {:>10} {:>9} {:>9} {:>11}  {}\n", "scene", "objects", "stage",
                      "code", "threads", "block", "occupancy", "median ms", "p10 ms", "x scalar", "x vector", "less time", "same bytes");
  for (const Group& group : experiment.groups) {
    for (const Timing* run : all_runs(group)) text += row_of(group, *run);
  }
  text += "\n";
  for (const Best& best : best_of_stages(experiment))
    text += fmt::format("best {} for {}: {}, {:.2f} times as fast as sequential code (geometric mean of the scenes)\n", x_name(experiment),
                        best.stage, best.x, best.speed_up);
  text += energy_lines(experiment);
  return text;
}

files::Json experiment_json(const Experiment& experiment) {
  files::Json results = files::Json::array(), bests = files::Json::array();
  for (const Group& group : experiment.groups) {
    results.push(json_of(group, group.scalar, "scalar"));
    results.push(json_of(group, group.vector, "vector"));
    const int best = best_run(group);
    for (std::size_t i = 0; i < group.runs.size(); ++i)
      results.push(json_of(group, group.runs[i], static_cast<int>(i) == best ? "best" : "run"));
  }
  for (const Best& best : best_of_stages(experiment))
    bests.push(files::Json::object()
                   .set("stage", best.stage)
                   .set(experiment.backend == "cuda" ? "block_size" : "threads", best.x)
                   .set("speed_up_scalar", best.speed_up));
  files::Json json = files::Json::object();
  json.set("backend", experiment.backend)
      .set("cpu", experiment.cpu)
      .set("gpu", experiment.gpu.empty() ? files::Json() : files::Json(experiment.gpu));
  json.set("width", experiment.width).set("height", experiment.height).set("raw_frames", experiment.raw_frames);
  json.set("noise", experiment.noise).set("frames", experiment.frames);
  return json.set("results", std::move(results)).set("best", std::move(bests));
}

pictures::Chart experiment_chart(const Experiment& experiment) {
  pictures::Chart chart;
  const bool gpu = experiment.backend == "cuda";
  chart.title = fmt::format("Speed-up over {}", x_name(experiment));
  chart.notes = {gpu ? fmt::format("{} against {}, one thread of sequential code", experiment.gpu, experiment.cpu)
                     : fmt::format("{}: vector code against one thread of sequential code", experiment.cpu),
                 fmt::format("{} x {} pixels, {} raw frames, noise {}, medians of {} frames; the rings are the best", experiment.width,
                             experiment.height, experiment.raw_frames, experiment.noise, experiment.frames)};
  chart.x_label = x_name(experiment);
  chart.y_label = "times as fast";
  const std::vector<std::string> stages = stages_of(experiment);
  std::set<int> values;
  double low = nan, high = nan;
  for (std::size_t i = 0; i < experiment.groups.size(); ++i) {
    const Group& group = experiment.groups[i];
    pictures::Curve curve = curve_of(group);
    // With two stages a scene has one colour, and the second stage is dashed; with more, each curve has its own.
    const auto stage = static_cast<std::size_t>(std::find(stages.begin(), stages.end(), group.stage) - stages.begin());
    curve.color = pictures::curve_color(stages.size() <= 2 ? i / stages.size() : i);
    curve.dashed = stages.size() == 2 && stage == 1;
    for (const Timing& run : group.runs) values.insert(run.x());
    for (const double y : curve.y) low = std::fmin(low, y), high = std::fmax(high, y);
    chart.curves.push_back(std::move(curve));
  }
  chart.x_ticks = values.empty() ? std::vector<double>{0} : ticks_of(values);
  chart.log_y = high > 10 * low;
  return chart;
}

}  // namespace tofray::app
