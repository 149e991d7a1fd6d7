// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/bench.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "cli/remarks.h"
#include "cli/requests.h"
#include "commands/results.h"
#include "results/meta.h"

namespace tofray::app {

namespace {

/// Times of one kind of batch, a value for each repetition [s].
struct Times {
  std::vector<double> device;    ///< the GPU's own clock, results left in its memory
  std::vector<double> resident;  ///< the host's clock for the same: preparing, launching, computing
  std::vector<double> host;      ///< the host's clock, every frame taken to host memory
};

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <class Call>
double seconds_of(const Call& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Frames that follow each other ("index"); first frames of other seeds; these with a camera that stands up to 3 cm aside ("poses").
std::vector<FrameRequest> requests_of(const run::Loaded& in, std::uint64_t count, std::uint64_t seed, std::string_view differing) {
  std::vector<FrameRequest> requests(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    requests[i].index = differing == "index" ? i : 0;
    if (differing != "index") requests[i].seed = seed + i;
    if (differing != "poses") continue;
    Pose pose = pose_from_matrix(camera_pose(in.scene, 0));
    const double x = 0.01 * (static_cast<double>(i % 7) - 3), y = 0.01 * (static_cast<double>(i / 7 % 5) - 2);
    pose.position[0] += x, pose.position[1] += y;
    if (!pose.quaternion) pose.look_at[0] += x, pose.look_at[1] += y;
    requests[i].pose = pose;
  }
  return requests;
}

Times measure(Simulator& simulator, const std::vector<FrameRequest>& requests, std::uint64_t repeats) {
  Times times;
  const auto ignore = [](const FrameArrays&) {};
  DeviceFrames frames;
  const bool gpu = simulator.ran_on().backend == "cuda";
  for (std::uint64_t i = 0; i <= repeats; ++i) {  // the first one is not counted: memory is taken, the GPU's clock goes up
    const double resident = gpu ? seconds_of([&] { simulator.frames_on_device(requests, frames); }) : 0;
    const double host = seconds_of([&] { simulator.frames(requests, ignore); });
    if (i == 0) continue;
    times.host.push_back(host);
    if (!gpu) continue;
    times.resident.push_back(resident);
    times.device.push_back(frames.seconds());
  }
  return times;
}

files::Json row_of(const run::Loaded& in, Simulator& simulator, const SimulatorOptions& options, const char* differing,
                   const std::vector<FrameRequest>& requests, std::uint64_t repeats) {
  const Times times = measure(simulator, requests, repeats);
  const auto count = static_cast<double>(requests.size());
  const auto rate = [&](const std::vector<double>& seconds) { return files::Json(count / median(seconds)); };
  const bool gpu = simulator.ran_on().backend == "cuda";
  DeviceFrames frames;
  const Energy energy = energy_per_frame(gpu_bus_id(simulator, options), requests.size(), [&] {
    if (gpu)
      simulator.frames_on_device(requests, frames);
    else
      simulator.frames(requests, [](const FrameArrays&) {});
  });
  files::Json row = files::Json::object();
  const RanOn machine = simulator.ran_on();
  row.set("scene", in.scene.name).set("backend", machine.backend).set("device", machine.device).set("isa", machine.isa);
  row.set("threads", machine.threads).set("noise", results::noise_name(options.noise)).set("differing", differing);
  row.set("batch", requests.size()).set("repeats", repeats);
  row.set("frames_per_s_device", rate(times.device)).set("frames_per_s_resident", rate(times.resident));
  return row.set("frames_per_s_host", rate(times.host)).set("energy", energy_json(energy));
}

std::string text_of(const files::Json& row) {
  const auto rate = [&](const char* key) {
    double value = 0;
    return row.find(key)->number(value) && std::isfinite(value) ? fmt::format("{:.0f}", value) : std::string("-");
  };
  double batch = 0;
  row.find("batch")->number(batch);
  return fmt::format("{:<24} {:<20} {:<6} {:<6} {:>7.0f} {:>13} {:>13} {:>13}\n", *row.find("scene")->string(),
                     *row.find("device")->string(), *row.find("noise")->string(), *row.find("differing")->string(), batch,
                     rate("frames_per_s_device"), rate("frames_per_s_resident"), rate("frames_per_s_host"));
}

}  // namespace

int run_batch_bench(const Options& options) {
  const run::Loaded in = run::load(input_request(options.words.empty() ? "bench-primitives" : options.words[0], options));
  say(texts(in.remarks));
  SimulatorOptions wanted = bench_options(options);
  if (wanted.device < 0) wanted.device = 0;  // one GPU, also where frames would be spread over several: its energy is measured
  Simulator simulator(in.scene, in.camera, wanted);
  Remarks remarks;
  say_fallback(options, simulator.ran_on(), remarks);
  const std::uint64_t repeats = options.frames.value_or(20);
  files::Json results = files::Json::array();
  for (const char* differing : {"index", "seeds", "poses"}) {
    results.push(row_of(in, simulator, wanted, differing, requests_of(in, *options.batch, wanted.seed, differing), repeats));
  }
  if (options.json) {
    print(files::json_text(files::Json::object().set("results", std::move(results)), 2) + "\n");
    return 0;
  }
  std::string text = fmt::format("frames per second, medians of {} batches\n{:<24} {:<20} {:<6} {:<6} {:>7} {:>13} {:>13} {:>13}\n",
                                 repeats, "scene", "device", "noise", "differ", "batch", "device clock", "left there", "to the host");
  std::vector<std::string> energy;
  for (const files::Json& row : *results.items()) {
    text += text_of(row);
    const std::string one = fmt::format("energy per frame: {}\n", energy_text(*row.find("energy")));
    if (energy.empty() || energy.back() != one) energy.push_back(one);  // what cannot be read is said once
  }
  for (const std::string& one : energy) text += one;
  print(text);
  return 0;
}

}  // namespace tofray::app
