// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/bench.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>
#include <string_view>

#include "backend/cuda/cuda.h"
#include "base/readout.h"
#include "base/shared.h"
#include "bench/experiment.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "cli/remarks.h"
#include "cli/requests.h"
#include "commands/results.h"
#include "files/sha256.h"
#include "results/meta.h"
#include "run/input_kind.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

template <class Vector>
std::string_view bytes_of(const Vector& array) {
  return {reinterpret_cast<const char*>(array.data()), array.size() * sizeof(array[0])};
}

double number(const files::Json& row, const char* key) {
  double value = 0;
  row.find(key)->number(value);
  return value;
}

/// What a row is of, as its lines of the table begin.
std::string name_of(const files::Json& row) {
  const bool gpu = *row.find("backend")->string() != "cpu";
  return fmt::format("{:<24} {:<11} {:>7.0f} {:<6}", *row.find("scene")->string(), *row.find(gpu ? "backend" : "isa")->string(),
                     number(row, "threads"), *row.find("noise")->string());
}

/// A line for each run, or a single one where all say the same: that nothing can be read.
std::string energy_lines(const files::Json& results) {
  std::set<std::string> texts;
  std::string lines;
  for (const files::Json& row : *results.items()) {
    const std::string text = energy_text(*row.find("energy"));
    texts.insert(text);
    lines += fmt::format("{} energy per frame: {}\n", name_of(row), text);
  }
  return texts.size() == 1 && results.items()->size() > 1 ? "energy per frame: " + *texts.begin() + "\n" : lines;
}

std::string table_of(const files::Json& results, const std::vector<Ratio>& ratios) {
  std::string text = fmt::format("{:<24} {:<11} {:>7} {:<6} {:>10} {:>10} {:>9} {:>9} {:>8}  {}\n", "scene", "code", "threads", "noise",
                                 "frames/s", "median ms", "p10 ms", "p99 ms", "peak MB", "SHA-256 of frame 0");
  for (const files::Json& row : *results.items()) {
    text += fmt::format("{} {:>10.2f} {:>10.3f} {:>9.3f} {:>9.3f} {:>8.1f}  {}\n", name_of(row), number(row, "frames_per_s"),
                        number(row, "ms_median"), number(row, "ms_p10"), number(row, "ms_p99"), 1e-6 * number(row, "peak_bytes"),
                        row.find("sha256")->string()->substr(0, 16));
  }
  for (const files::Json& row : *results.items()) {
    const files::Json& stages = *row.find("stage_ms");
    text += fmt::format("{} stages, ms: trace {:.3f}, power {:.3f}, raw {:.3f}, depth {:.3f}\n", name_of(row), number(stages, "trace"),
                        number(stages, "power"), number(stages, "raw"), number(stages, "depth"));
  }
  for (const files::Json& row : *results.items()) {
    const files::Json& others = *row.find("other_places");
    text += fmt::format("{} each frame to another place: {:.2f} frames/s, median {:.3f} ms, p10 {:.3f} ms\n", name_of(row),
                        number(others, "frames_per_s"), number(others, "ms_median"), number(others, "ms_p10"));
  }
  for (const files::Json& row : *results.items()) {
    const files::Json& ms = *row.find("set_up_ms");
    text += fmt::format(
        "{} a simulator made anew, ms: from nothing {:.2f}, another lens {:.2f}, another number of the sensor {:.2f}, another scene "
        "{:.2f}\n",
        name_of(row), number(ms, "from_nothing"), number(ms, "another_lens"), number(ms, "another_sensor_number"),
        number(ms, "another_scene"));
  }
  text += energy_lines(results);
  if (!ratios.empty()) text += "\n";
  for (const Ratio& one : ratios) text += fmt::format("{:<62} {:>8.3f}\n", one.name, one.value);
  return text;
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void move_aside(Object& object, double by_m) {
  if (object.keyframes.empty()) object.position[0] += by_m;
  for (Keyframe& key : object.keyframes) key.position[0] += by_m;
}

double pixels_of(const base::ImageExtent& image) { return static_cast<double>(image.width) * image.height; }

}  // namespace

std::chrono::steady_clock::time_point Contender::begin() {
  base::forget_kept();
  return std::chrono::steady_clock::now();
}

Contender::Contender(const run::Loaded& in, const SimulatorOptions& options, Places places)
    : in_(in),
      scene_(in.scene.name),
      options_(options),
      pixels_(pixels_of(base::image_extent(in.camera))),
      simulator_(in.scene, in.camera, options_),
      from_nothing_ms_(milliseconds_since(begun_)),
      frames_(1) {
  if (places == Places::same) return;
  constexpr double enough = 150e6;  // bytes: several times the largest caches
  const double values = 10 + 10 * static_cast<double>(in.camera.mode.sequence.size());
  frames_.resize(static_cast<std::size_t>(std::clamp(enough / (values * pixels_), 2.0, 64.0)));
  for (std::size_t i = 0; i < frames_.size(); ++i) step(false);  // all of it is there before anything is timed
}

void Contender::step(bool timed) { step_into(frames_[next_ % frames_.size()], timed); }

void Contender::step_into(Frame& place, bool timed) {
  const auto start = std::chrono::steady_clock::now();
  simulator_.frame(next_, place);
  ++next_;
  if (timed) ms_.push_back(milliseconds_since(start));
}

double Contender::percentile_ms(double share) const {
  std::vector<double> sorted = ms_;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty()) return std::nan("");
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double Contender::pixel_rate() const { return pixels_ / (1e-3 * median_ms()); }

files::Json Contender::stage_ms() {
  // A run that stops after a stage takes as long as this and all before it: each stage is the difference to the one before.
  constexpr Stage stages[] = {Stage::trace, Stage::power, Stage::raw, Stage::depth};
  constexpr const char* names[] = {"trace", "power", "raw", "depth"};
  std::vector<Contender> upto;
  for (const Stage stage : stages) {
    SimulatorOptions options = options_;
    options.last_stage = stage;
    upto.emplace_back(in_, options);
  }
  for (std::size_t i = 0; i <= std::clamp<std::size_t>(ms_.size(), 1, 50); ++i) {
    for (Contender& one : upto) one.step_into(frames_[0], i > 0);
  }
  std::vector<double> medians;
  for (const Contender& one : upto) medians.push_back(one.median_ms());
  const std::vector<double> spent = stage_times(medians);
  files::Json row = files::Json::object();
  for (std::size_t i = 0; i < spent.size(); ++i) row.set(names[i], spent[i]);
  return row;
}

std::vector<double> stage_times(const std::vector<double>& upto) {
  std::vector<double> spent;
  double before = 0;
  for (const double one : upto) {
    const double here = std::max(before, one);
    spent.push_back(here - before);
    before = here;
  }
  return spent;
}

files::Json Contender::other_places() {
  Contender others(in_, options_, Places::others);
  for (std::size_t i = 0; i < std::clamp<std::size_t>(ms_.size(), 1, 200); ++i) others.step(true);
  return files::Json::object()
      .set("frames_per_s", 1000 / others.median_ms())
      .set("ms_median", others.median_ms())
      .set("ms_p10", others.percentile_ms(0.1));
}

files::Json Contender::set_up_ms() const {
  // A millionth more each time: nothing that is there already; meshes are as they were.
  const auto median = [&](const auto& change) {
    std::vector<double> ms;
    for (int i = 1; i <= 9; ++i) {
      Camera camera = in_.camera;
      Scene scene = in_.scene;
      change(camera, scene, 1 + 1e-6 * i);
      const auto start = std::chrono::steady_clock::now();
      const Simulator another(scene, camera, options_);
      ms.push_back(milliseconds_since(start));
    }
    std::nth_element(ms.begin(), ms.begin() + 4, ms.end());
    return ms[4];
  };
  return files::Json::object()
      .set("from_nothing", from_nothing_ms_)
      .set("another_lens", median([](Camera& camera, Scene&, double by) { camera.lens.fx_px *= by; }))
      .set("another_sensor_number", median([](Camera& camera, Scene&, double by) { camera.adc.step_e_per_dn *= by; }))
      .set("another_scene", median([](Camera&, Scene& scene, double by) {
             for (Object& object : scene.objects) move_aside(object, by - 1);
           }));
}

const Frame& Contender::first_frame() {
  simulator_.frame(0, frames_[0]);
  return frames_[0];
}

std::string gpu_bus_id(const Simulator& simulator, const SimulatorOptions& options) {
  return simulator.ran_on().backend == "cuda" ? backend::cuda_bus_id(options.device) : std::string();
}

Energy Contender::energy() {
  return energy_per_frame(gpu_bus_id(simulator_, options_), 1, [this] { step(false); });
}

files::Json Contender::result() {
  const std::string hash = arrays_sha256(first_frame());
  files::Json row = files::Json::object();
  const RanOn machine = simulator_.ran_on();
  row.set("scene", scene_).set("backend", machine.backend).set("device", machine.device).set("isa", machine.isa);
  row.set("threads", machine.threads).set("noise", results::noise_name(options_.noise));
  row.set("frames_per_s", 1000 / median_ms())
      .set("ms_median", median_ms())
      .set("ms_p10", percentile_ms(0.1))
      .set("ms_p99", percentile_ms(0.99))
      .set("stage_ms", stage_ms())
      .set("energy", energy_json(energy()));
  row.set("peak_bytes", peak_bytes()).set("sha256", hash);
  return row.set("other_places", other_places()).set("set_up_ms", set_up_ms());
}

std::uint64_t peak_bytes() {
  std::FILE* file = std::fopen("/proc/self/status", "re");
  if (file == nullptr) return 0;
  char line[256];
  std::uint64_t bytes = 0;
  while (std::fgets(line, sizeof line, file) != nullptr) {
    if (std::strncmp(line, "VmHWM:", 6) == 0) bytes = 1024 * std::strtoull(line + 6, nullptr, 10);
  }
  std::fclose(file);
  return bytes;
}

std::string arrays_sha256(const Frame& frame) {
#define TOFRAY_BYTES(name, part, member, ...) bytes_of(frame.part.member),
  const std::string_view arrays[] = {TOFRAY_IMAGE_ARRAYS(TOFRAY_BYTES)};
#undef TOFRAY_BYTES
  return files::sha256_hex(arrays);
}

SimulatorOptions bench_options(const Options& options) {
  SimulatorOptions out = simulator_options(options);
  out.truth = false;
  return out;
}

namespace {

/// With the file that a word means where it is also the name of a built-in scene.
Options with_chosen_scenes(Options options) {
  for (std::string& word : options.words) {
    const NameChoice chosen = choose_scene(word);
    say(run::note_of(chosen));
    word = chosen.name;
  }
  return options;
}

}  // namespace

int run_bench(const Options& typed) {
  const Options options = with_chosen_scenes(typed);
  const bool experiment = !options.stages.empty() || !options.block_sizes.empty();
  if (options.compare && (experiment || options.backend == Backend::cuda))
    throw Error(ErrorKind::bad_input,
                "error: --compare is of the processor's variants\n  it goes without --stage, --block-size and --backend cuda");
  if (options.batch && (experiment || options.compare))
    throw Error(ErrorKind::bad_input, "error: --batch measures whole batches\n  it goes without --stage, --block-size and --compare");
  if (options.batch) return run_batch_bench(options);
  if (experiment) return run_experiment(options);
  const std::string scene = options.words.empty() ? "bench-primitives" : options.words[0];
  const std::uint64_t frames = options.frames.value_or(100);
  files::Json results = files::Json::array(), ratios_json = files::Json::array();
  std::vector<Ratio> ratios;
  if (options.compare) {
    ratios = compare(options, scene, results);
  } else {
    const run::Loaded in = run::load(input_request(scene, options));
    say(texts(in.remarks));
    Contender one(in, bench_options(options));
    Remarks remarks;
    say_fallback(options, one.simulator().ran_on(), remarks);
    Progress progress(frames + options.warmup, "frames", options.json);
    for (std::uint64_t i = 0; i < frames + options.warmup; ++i) {
      one.step(i >= options.warmup);
      progress.step();
    }
    results.push(one.result());
  }
  for (const Ratio& one : ratios) ratios_json.push(files::Json::object().set("name", one.name).set("value", one.value));
  if (options.json)
    print(files::json_text(files::Json::object().set("results", std::move(results)).set("ratios", std::move(ratios_json)), 2) + "\n");
  else
    print(table_of(results, ratios));
  return 0;
}

}  // namespace tofray::app
