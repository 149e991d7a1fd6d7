// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/experiment.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "backend/cpu/cpu.h"
#include "base/readout.h"
#include "base/text.h"
#include "bench/bench.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "cli/remarks.h"
#include "cli/requests.h"
#include "commands/results.h"
#include "files/output_folder.h"
#include "results/manifest.h"
#include "results/meta.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

constexpr std::uint64_t burst = 5;  ///< timed frames of one contender before the next one's turn

/// One scene of each kind of shape.
const std::vector<std::string> shape_scenes = {"bench-spheres", "bench-boxes", "bench-planes", "bench-triangles"};

/// What is compared: the two yardsticks first, then block sizes or numbers of threads.
std::vector<SimulatorOptions> variants(const Options& options, bool gpu) {
  SimulatorOptions cpu = bench_options(options);
  cpu.backend = Backend::cpu;
  SimulatorOptions scalar = cpu;
  scalar.isa = backend::can_run(Isa::scalar_fma) ? Isa::scalar_fma : Isa::scalar;
  scalar.threads = 1;
  std::vector<SimulatorOptions> all = {scalar, cpu};
  if (gpu) {
    for (const int size : options.block_sizes) {
      all.push_back(bench_options(options));
      all.back().backend = Backend::cuda;
      all.back().block_size = size;
    }
    return all;
  }
  const int most = cpu.threads > 0 ? cpu.threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  for (int threads = 1;; threads = std::min(2 * threads, most)) {
    all.push_back(cpu);
    all.back().threads = threads;
    if (threads == most) return all;
  }
}

void stop_after(SimulatorOptions& options, const std::string& stage) {
  options.last_stage = stage == "trace" ? Stage::trace : stage == "power" ? Stage::power : stage == "raw" ? Stage::raw : Stage::depth;
  // What these stages find is ground truth: range, reflectivity, position and normal, then power. Without it nothing would be written.
  options.truth = options.last_stage == Stage::trace || options.last_stage == Stage::power;
}

/// A contender, or why there is none.
struct Entry {
  Timing run;
  std::unique_ptr<Contender> contender;
};

Entry enter(const run::Loaded& in, const SimulatorOptions& options) {
  Entry entry;
  const bool gpu = options.backend == Backend::cuda;
  entry.run.block_size = gpu ? options.block_size : 0;
  entry.run.code = "cuda";
  try {
    entry.contender = std::make_unique<Contender>(in, options);
    const Simulator& simulator = entry.contender->simulator();
    if (!gpu) entry.run.code = simulator.ran_on().isa, entry.run.threads = simulator.ran_on().threads;
    if (gpu) entry.run.occupancy = simulator.ran_on().occupancy;
    entry.run.sha256 = arrays_sha256(entry.contender->first_frame());
  } catch (const Error& error) {
    // A block size that this GPU, or the kernel's registers, do not allow; without any GPU the run ended before.
    if (!gpu || error.kind() != ErrorKind::device) throw;
    entry.contender.reset();
    const std::string text = error.what();
    entry.run.fault = text.substr(0, text.find('\n'));
  }
  return entry;
}

/// Runs all in turn, a few frames each, so that the machine's moods meet all alike. The first frame of a turn is not timed: the others'
/// data are in the caches then.
void measure(std::vector<Entry>& entries, std::uint64_t frames, std::uint64_t warmup, Progress& progress) {
  const auto turn = [&](std::uint64_t count, bool timed) {
    for (Entry& entry : entries) {
      if (entry.contender != nullptr) entry.contender->step(false);
      for (std::uint64_t i = 0; entry.contender != nullptr && i < count; ++i) entry.contender->step(timed);
      progress.step();
    }
  };
  turn(warmup, false);
  for (std::uint64_t done = 0; done < frames; done += std::min(burst, frames - done)) turn(std::min(burst, frames - done), true);
  for (Entry& entry : entries) {
    if (entry.contender == nullptr) continue;
    entry.run.ms_median = entry.contender->median_ms();
    entry.run.ms_p10 = entry.contender->percentile_ms(0.1);
  }
}

Group group_of(const run::Loaded& in, const std::string& stage, const std::vector<SimulatorOptions>& all, std::uint64_t frames,
               std::uint64_t warmup, Progress& progress) {
  std::vector<Entry> entries;
  for (SimulatorOptions options : all) {
    stop_after(options, stage);
    entries.push_back(enter(in, options));
  }
  measure(entries, frames, warmup, progress);
  Group group{in.scene.name, in.scene.objects.size(), stage, {}, {}, {}};
  for (std::size_t i = 2; i < entries.size(); ++i) group.runs.push_back(entries[i].run);
  // Energy of the yardsticks and of the best: a counter needs seconds for each.
  const int best = best_run(group);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    Timing& run = i < 2 ? entries[i].run : group.runs[i - 2];
    if (i < 2 || static_cast<int>(i) == best + 2) run.energy = entries[i].contender->energy();
  }
  group.scalar = entries[0].run, group.vector = entries[1].run;
  return group;
}

/// Whether a GPU is what is measured. @throws Error (bad_input) for options that do not go together, (device) where a GPU is needed
bool takes_gpu(Options& options, const run::Loaded& in) {
  const bool sizes = !options.block_sizes.empty();
  if (sizes && options.backend == Backend::cpu)
    throw Error(ErrorKind::bad_input, "error: --block-size is a GPU's\n  it goes with --backend cuda, or auto");
  if (options.backend == Backend::cpu) return false;
  SimulatorOptions wanted = bench_options(options);
  if (sizes) wanted.backend = Backend::cuda;
  const Simulator probe(in.scene, in.camera, wanted);
  Remarks remarks;
  if (probe.ran_on().backend != "cuda") return say_fallback(options, probe.ran_on(), remarks), false;
  for (int size = 32; !sizes && size <= 1024; size += 32) options.block_sizes.push_back(size);
  return true;
}

Experiment described(const Options& options, const run::Loaded& in, bool gpu) {
  Experiment out;
  out.backend = gpu ? "cuda" : "cpu";
  out.cpu = results::cpu_model();
  SimulatorOptions wanted = bench_options(options);
  wanted.backend = Backend::cuda;
  if (gpu) out.gpu = Simulator(in.scene, in.camera, wanted).ran_on().device;
  out.noise = results::noise_name(wanted.noise);
  out.frames = options.frames.value_or(30);
  const base::ImageExtent image = base::image_extent(in.camera);
  out.width = image.width, out.height = image.height;
  out.raw_frames = static_cast<int>(in.camera.mode.sequence.size());
  return out;
}

int report(const Experiment& experiment, const Options& options) {
  const std::string table = experiment_table(experiment), json = files::json_text(experiment_json(experiment), 2) + "\n";
  const pictures::Chart chart = experiment_chart(experiment);
  files::OutputFolder folder(options.output.empty() ? "tofray-bench" : options.output);
  folder.write("experiment.txt", table);
  folder.write("experiment.json", json);
  folder.write("speed-up.png", pictures::chart_png(chart));
  folder.write("speed-up.svg", pictures::chart_svg(chart));
  print(options.json ? json : table);
  if (!options.json) say(fmt::format("\n{} files in {}\n", folder.files().size(), folder.path().native()));
  const std::vector<std::string> others = other_bytes(experiment);
  if (others.empty()) return 0;
  say(fmt::format("error: {} runs do not give the bytes of sequential code: {}\n  please report this with the output of `tofray doctor`\n",
                  others.size(), base::listed(others, "and")));
  return 1;
}

}  // namespace

int run_experiment(const Options& typed) {
  Options options = typed;
  if (options.stages.empty()) options.stages = {"all"};
  std::vector<run::Loaded> scenes;
  for (const std::string& name : options.words.empty() ? shape_scenes : options.words)
    scenes.push_back(run::load(input_request(name, options)));
  for (const run::Loaded& in : scenes) say(texts(in.remarks));
  const bool gpu = takes_gpu(options, scenes[0]);

  Experiment experiment = described(options, scenes[0], gpu);
  const std::vector<SimulatorOptions> all = variants(options, gpu);
  const std::uint64_t turns = 1 + (experiment.frames + burst - 1) / burst;
  Progress progress(scenes.size() * options.stages.size() * turns * all.size(), "turns", options.json);
  for (const run::Loaded& in : scenes) {
    for (const std::string& stage : options.stages)
      experiment.groups.push_back(group_of(in, stage, all, experiment.frames, options.warmup, progress));
  }
  return report(experiment, options);
}

}  // namespace tofray::app
