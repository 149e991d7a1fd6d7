// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/sweep.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

#include "base/text.h"
#include "run/stopwatch.h"
#include "sweep/cells.h"
#include "sweep/metrics.h"
#include "tofray/error.h"
#include "tofray/kept.h"

namespace tofray {

namespace sweeps {

namespace {

constexpr std::uint64_t most_frames = 1'000'000;
constexpr std::size_t most_kept_bytes = 256'000'000;  // of raw frames: beyond, a frame begins with its light
const std::vector<std::string> raw_arrays = {"tap_a", "tap_b", "raw"};

using Numbers = std::vector<std::uint64_t>;

std::string region_name(const ImageRegion& region) {
  if (region.width == 0) return "all";
  return fmt::format("{},{},{},{}", region.u, region.v, region.width, region.height);
}

/// What cells have in common before they differ.
struct Common {
  Inputs inputs;  ///< of the first of them
  KeptLight light;
  std::vector<KeptRaw> raw;  ///< by frame
};

/// What of a cell the next ones may begin with.
enum class Keeps { nothing, light, light_and_raw };

class Run {
 public:
  Run(const SweepRequest& request, const SweepWatch& watch)
      : request_(request), watch_(watch), cells_(request), wanted_(wanted_metrics(request.metrics)), options_(request.simulator) {
    if (request.repeat < 1 || request.repeat > most_frames)
      throw Error(ErrorKind::bad_input,
                  fmt::format("error: cells of {} frames were asked for\n  expected 1 to {}", request.repeat, most_frames));
    options_.arrays = arrays_for(wanted_, request.by_object);
    options_.arrays.insert(options_.arrays.end(), request.simulator.arrays.begin(), request.simulator.arrays.end());
    const bool late = std::any_of(request.axes.begin(), request.axes.end(), [](const SweepAxis& one) { return one.stage == Stage::depth; });
    if (late) options_.arrays.insert(options_.arrays.end(), raw_arrays.begin(), raw_arrays.end());
    options_.progress = watch.progress, options_.backend = Backend::cpu;
    threads_ =
        request.simulator.threads > 0 ? request.simulator.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }

  Sweep result() {
    run::Stopwatch stopwatch;
    Sweep out;
    out.axes = request_.axes, out.repeat = request_.repeat;
    for (const std::size_t metric : wanted_.metrics) out.metrics.push_back(sweep_metrics()[metric].name);
    const std::vector<Numbers> by_light = cells_.alike(cells_.all(), Stage::raw);
    name_regions(cells_.inputs(by_light.front().front()), out);
    values_.assign(cells_.count() * out.regions.size() * out.metrics.size(), std::nan(""));
    const bool alone = std::all_of(by_light.begin(), by_light.end(), [](const Numbers& one) { return one.size() == 1; });
    if (alone) {
      Common nothing;
      each(cells_.all(), [&](std::uint64_t cell, int threads, Frame& frame) {
        const Inputs inputs = cells_.inputs(cell);
        compute(cell, inputs.scene, inputs.camera, threads, nothing, Keeps::nothing, frame);
      });
    } else {
      for (const Numbers& group : by_light) run_group(group);
    }
    out.interrupted = stopped(), out.values = std::move(values_);
    out.traced = traced_, out.from_light = from_light_, out.from_raw = from_raw_;
    leave_out_unseen(out);
    out.ran_on.backend = "cpu", out.ran_on.threads = threads_;
    out.files = std::move(files_);
    stopwatch.lap("sweep"), out.seconds = stopwatch.total();
    return out;
  }

 private:
  void name_regions(const Inputs& first, Sweep& out) {
    files_ = first.files;
    for (const Remark& one : first.remarks)
      if (watch_.remark) watch_.remark(one);
    out.regions = {region_name(request_.region)};
    std::map<std::string, int> known;
    for (std::size_t i = 0; request_.by_object && i < first.scene.objects.size(); ++i) {
      const Object& object = first.scene.objects[i];
      const std::string key = object.key.empty() ? fmt::format("objects.{}", i) : object.key;
      const auto [at, fresh] = known.emplace(key, static_cast<int>(out.regions.size()));
      part_of_.push_back(at->second);
      if (fresh) out.regions.push_back(object.name.empty() ? key : fmt::format("{} ({})", key, base::printable(object.name.substr(0, 60))));
    }
    numbers_ = out.regions.size() * out.metrics.size(), regions_ = out.regions.size();
  }

  /// Calls work(cell, threads, frame) for each, several at once.
  template <class Work>
  void each(const Numbers& cells, const Work& work) {
    const auto workers = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(threads_), cells.size()));
    std::atomic<std::size_t> next = 0;
    std::exception_ptr fault;
    std::size_t faulty = cells.size();
    const auto run = [&] {
      Frame frame;
      for (std::size_t i = next++; i < cells.size() && !stopped(); i = next++) {
        try {
          work(cells[i], threads_ / workers, frame);
        } catch (...) {
          const std::lock_guard hold(mutex_);
          if (i < faulty) fault = std::current_exception(), faulty = i;
          next = cells.size();
        }
      }
    };
    std::vector<std::jthread> others;
    for (int i = 1; i < workers; ++i) others.emplace_back(run);
    run();
    others.clear();
    if (fault) std::rethrow_exception(fault);
  }

  /// Cells of the same light.
  void run_group(const Numbers& group) {
    Common common;
    common.inputs = cells_.inputs(group.front());
    Frame frame;
    const std::vector<Numbers> by_raw = cells_.alike(group, Stage::depth);
    const bool pairs = std::any_of(by_raw.begin(), by_raw.end(), [](const Numbers& one) { return one.size() > 1; });
    Numbers rest(group.begin() + 1, group.end());
    if (!pairs) {
      compute(group.front(), common.inputs.scene, common.inputs.camera, threads_, common, Keeps::light, frame);
      each(rest, [&](std::uint64_t cell, int threads, Frame& own) { compute_late(cell, threads, common, Keeps::nothing, own); });
      return;
    }
    for (const Numbers& same : by_raw) {
      common.raw.clear();
      if (stopped()) return;
      compute_late(same.front(), threads_, common, same.size() > 1 ? Keeps::light_and_raw : Keeps::light, frame);
      each({same.begin() + 1, same.end()},
           [&](std::uint64_t cell, int threads, Frame& own) { compute_late(cell, threads, common, Keeps::nothing, own); });
    }
  }

  void compute_late(std::uint64_t cell, int threads, Common& common, Keeps keeps, Frame& frame) {
    compute(cell, common.inputs.scene, cells_.camera(cell, common.inputs), threads, common, keeps, frame);
  }

  /// @param keeps  what of this cell the next ones may begin with: then no other is computed at the same time
  void compute(std::uint64_t cell, const Scene& scene, const Camera& camera, int threads, Common& common, Keeps keeps, Frame& frame) {
    try {
      const ImageRegion region = region_in(camera);
      SimulatorOptions options = options_;
      options.threads = threads;
      KeptFrames frames(scene, camera, options);
      const bool one_light = request_.repeat == 1 || frames.stands_still();
      const bool light = frames.can_keep_light() && one_light;
      Measuring measuring(wanted_, camera, region, part_of_, request_.repeat);
      for (std::uint64_t i = 0; i < request_.repeat && !stopped(); ++i) {
        if (i < common.raw.size() && frames.can_keep_raw()) {
          frames.frame_from(i, common.raw[i], frame), ++from_raw_;
        } else if (light && common.light.filled() && frames.frame_from(i, common.light, frame)) {
          ++from_light_;
        } else if (light && keeps != Keeps::nothing && !common.light.filled()) {
          frames.frame_to(i, common.light, frame), ++traced_;
        } else {
          frames.frame(i, frame), ++traced_;
        }
        if (stopped()) return;
        if (keeps == Keeps::light_and_raw && frames.can_keep_raw() && bytes_of(frame) * request_.repeat <= most_kept_bytes)
          frames.keep(common.raw.emplace_back());
        measuring.take(frame);
        if (watch_.frame) {
          const std::lock_guard hold(mutex_);
          watch_.frame(cell, frame);
        }
      }
      done(cell, measuring.values());
    } catch (const Error& error) {
      if (std::string_view(error.what()).find("\n  in the cell ") != std::string_view::npos) throw;
      throw cells_.in_cell(error, cell);
    }
  }

  static std::size_t bytes_of(const Frame& frame) { return 10 * frame.raw.tap_a.size(); }

  [[nodiscard]] ImageRegion region_in(const Camera& camera) const {
    const ImageSize size = image_size(camera);
    const ImageRegion& r = request_.region;
    if (r.width == 0 && r.height == 0) return {0, 0, size.width, size.height};
    if (r.u < 0 || r.v < 0 || r.width < 1 || r.height < 1 || r.width > size.width - r.u || r.height > size.height - r.v)
      throw Error(
          ErrorKind::bad_input,
          fmt::format(
              "error: the region is not in the image\n  got column {}, row {}, {} x {} pixels, expected some of an image of {} x {}", r.u,
              r.v, r.width, r.height, size.width, size.height));
    return r;
  }

  void done(std::uint64_t cell, const std::vector<double>& values) {
    const std::lock_guard hold(mutex_);
    std::copy(values.begin(), values.end(), values_.begin() + static_cast<std::ptrdiff_t>(cell * numbers_));
    ++done_;
    if (watch_.cell_done) watch_.cell_done(done_, cells_.count());
  }

  /// Objects that no cell sees.
  void leave_out_unseen(Sweep& out) const {
    const std::size_t metrics = out.metrics.size();
    std::vector<std::size_t> seen = {0};
    for (std::size_t region = 1; region < regions_; ++region) {
      bool any = false;
      for (std::size_t cell = 0; cell < cells_.count() && !any; ++cell)
        for (std::size_t i = 0; i < metrics && !any; ++i) any = !std::isnan(out.values[(cell * regions_ + region) * metrics + i]);
      if (any) seen.push_back(region);
    }
    std::vector<double> values;
    std::vector<std::string> names;
    for (const std::size_t region : seen) names.push_back(out.regions[region]);
    for (std::size_t cell = 0; cell < cells_.count(); ++cell)
      for (const std::size_t region : seen) {
        const auto from = out.values.begin() + static_cast<std::ptrdiff_t>((cell * regions_ + region) * metrics);
        values.insert(values.end(), from, from + static_cast<std::ptrdiff_t>(metrics));
      }
    out.values = std::move(values), out.regions = std::move(names);
  }

  [[nodiscard]] bool stopped() const { return watch_.progress != nullptr && watch_.progress->stop; }

  const SweepRequest& request_;
  const SweepWatch& watch_;
  Cells cells_;
  Wanted wanted_;
  SimulatorOptions options_;
  int threads_ = 1;
  std::vector<int> part_of_;
  std::vector<InputFile> files_;
  std::size_t numbers_ = 0, regions_ = 1;
  std::atomic<std::uint64_t> traced_ = 0, from_light_ = 0, from_raw_ = 0;
  std::mutex mutex_;  // of what follows, and of the watch
  std::vector<double> values_;
  std::uint64_t done_ = 0;
};

}  // namespace

}  // namespace sweeps

std::uint64_t Sweep::cells() const {
  std::uint64_t out = 1;
  for (const SweepAxis& axis : axes) out *= axis.values.size();
  return out;
}

std::size_t Sweep::place(std::uint64_t cell, std::size_t axis) const {
  for (std::size_t i = axes.size(); i-- > axis + 1;) cell /= axes[i].values.size();
  return cell % axes[axis].values.size();
}

double Sweep::value(std::uint64_t cell, std::size_t region, std::size_t metric) const {
  return values[(cell * regions.size() + region) * metrics.size() + metric];
}

Sweep sweep(const SweepRequest& request, const SweepWatch& watch) { return sweeps::Run(request, watch).result(); }

}  // namespace tofray
