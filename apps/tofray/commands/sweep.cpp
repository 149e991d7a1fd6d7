// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/sweep.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "cli/remarks.h"
#include "cli/requests.h"
#include "commands/limits.h"
#include "run/input_kind.h"
#include "sweep/sweep_files.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

constexpr std::uint64_t most_lines = 40;  // of a table for people

SweepRequest request_of(const Options& options, const std::string& scene) {
  SweepRequest out;
  out.inputs = input_request(scene, options);
  out.simulator = simulator_options(options);
  out.repeat = options.repeat, out.region = options.region, out.by_object = options.by_object, out.metrics = options.metrics;
  for (const std::string& one : options.vary) out.axes.push_back(sweep_axis(one, out.inputs));
  return out;
}

/// What people first want to know; a table has no room for all of them.
std::vector<std::size_t> shown_metrics(const Sweep& sweep, bool chosen) {
  static const std::vector<std::string> first = {"bias_m",
                                                 "sigma_m",
                                                 "rmse_m",
                                                 "p95_m",
                                                 "fill_percent",
                                                 "wrong_cycle_percent",
                                                 "saturated_percent",
                                                 "amplitude_e",
                                                 "tap_filling_percent"};
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < sweep.metrics.size(); ++i)
    if (chosen || std::find(first.begin(), first.end(), sweep.metrics[i]) != first.end()) out.push_back(i);
  return out;
}

std::string heading(const std::string& metric) { return metric.substr(0, metric.rfind('_')); }

/// A table whose columns are as wide as what stands in them.
std::string table_text(const std::vector<std::vector<std::string>>& rows, std::size_t left) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string out;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string room(widths[i] - row[i].size(), ' ');
      line += (i == 0 ? "" : "  ") + (i < left ? row[i] + room : room + row[i]);
    }
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

std::string text_of(const Sweep& sweep, const std::vector<std::uint64_t>& cells, bool chosen) {
  const std::vector<std::size_t> metrics = shown_metrics(sweep, chosen);
  const bool by_region = sweep.regions.size() > 1;
  std::vector<std::vector<std::string>> rows(1);
  for (const SweepAxis& axis : sweep.axes) rows[0].push_back(axis.key.starts_with("camera.") ? axis.key.substr(7) : axis.key);
  if (by_region) rows[0].emplace_back("region");
  for (const std::size_t metric : metrics) rows[0].push_back(heading(sweep.metrics[metric]));
  const std::uint64_t lines = std::min<std::uint64_t>(cells.size(), std::max<std::uint64_t>(1, most_lines / sweep.regions.size()));
  for (std::uint64_t i = 0; i < lines; ++i)
    for (std::size_t region = 0; region < sweep.regions.size(); ++region) {
      std::vector<std::string>& row = rows.emplace_back();
      for (std::size_t axis = 0; axis < sweep.axes.size(); ++axis)
        row.push_back(region > 0 ? "" : base::printable(sweep.axes[axis].values[sweep.place(cells[i], axis)]));
      if (by_region) row.push_back(sweep.regions[region]);
      for (const std::size_t metric : metrics) row.push_back(measured_text(sweep.metrics[metric], sweep.value(cells[i], region, metric)));
    }
  std::string out = table_text(rows, sweep.axes.size() + (by_region ? 1 : 0));
  if (lines < cells.size()) out += fmt::format("… and {} more: -o DIR or --csv has all\n", cells.size() - lines);
  return out;
}

std::string how_text(const Sweep& sweep) {
  return fmt::format("{} cells in {:.2f} s; frames from rays {}, from light {}, from raw frames {}\n", sweep.cells(), sweep.seconds,
                     sweep.traced, sweep.from_light, sweep.from_raw);
}

}  // namespace

int run_sweep(const Options& options) {
  Remarks remarks;
  const NameChoice chosen = choose_scene(options.words[0]);
  remarks.tell(run::note_of(chosen));
  const SweepRequest request = request_of(options, chosen.name);
  std::uint64_t cells = 1;
  for (const SweepAxis& axis : request.axes) cells *= axis.values.size();
  FrameProgress now;
  const StopRequest stop(&now.stop);
  std::optional<Progress> progress;
  progress.emplace(cells, "cells", options.quiet);
  SweepWatch watch;
  watch.progress = &now;
  watch.remark = [&](const Remark& one) { remarks.tell({one}); };
  watch.cell_done = [&](std::uint64_t, std::uint64_t) { progress->step(); };
  const Sweep found = sweep(request, watch);
  progress.reset();
  if (found.interrupted) {
    say("interrupted: nothing is written; the same command begins anew\n");
    return 128 + stop.signal();
  }
  const bool best = !options.best.empty();
  std::vector<std::uint64_t> front;
  if (best) front = best_cells(found, options.best);
  if (!options.output.empty()) save_sweep(found, request, options.output, options.typed);
  std::vector<std::uint64_t> all;
  for (std::uint64_t i = 0; i < found.cells() && !best; ++i) all.push_back(i);
  if (options.json) {
    files::Json json = sweeps::json_of(found);
    if (best) json.set("best", files::Json::list(front));
    print(files::json_text(json, 2) + "\n");
  } else if (options.csv) {
    print(sweeps::csv_text(found));
  } else if (best && front.empty()) {
    say("no cell holds all conditions\n");
  } else if (best || options.output.empty()) {
    print(text_of(found, best ? front : all, !options.metrics.empty()));
  }
  Talk(options.quiet)(how_text(found) +
                      (options.output.empty() ? "" : fmt::format("{}/sweep.csv, sweep.npz, manifest.json\n", options.output)));
  return best && front.empty() ? 1 : 0;
}

}  // namespace tofray::app
