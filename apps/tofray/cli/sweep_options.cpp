// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/option_values.h"

namespace tofray::app {

std::vector<OptionSpec> sweep_specs() {
  return {
      {"--vary", 0, "KEY=VALUES",
       "a key and its values: a,b,c; A:B:n, n numbers evenly; A:B:logn, in even ratios; @all of a choice, mode or profile; as often as you "
       "like: all "
       "combinations",
       [](Options& o, const std::string& v) { o.vary.push_back(v); }, "<varied>"},
      {"--metric", 0, "LIST", "what is measured: bias,sigma,fill (all)",
       [](Options& o, const std::string& v) {
         for (const std::string& one : split(v, ',')) o.metrics.push_back(one);
       },
       "<metrics>", true},
      {"--repeat", 0, "N", "frames of each cell; from 2 on sigma is measured over them (1: what noise_m says)",
       [](Options& o, const std::string& v) { o.repeat = whole("--repeat", v, 1, 1'000'000, "a whole number of 1 to 1000000"); }},
      {"--by-object", 0, nullptr, "besides, each object's own pixels", [](Options& o, const std::string&) { o.by_object = true; }},
      {"--best", 0, "AIMS", "the cells that nothing beats (Pareto front): \"sigma, fill>95%\", \"rmse, illumination.0.power\"",
       [](Options& o, const std::string& v) { o.best = v; }},
      {"--output", 'o', "DIR", "folder for sweep.csv, sweep.npz and manifest.json; without it a table on stdout",
       [](Options& o, const std::string& v) { o.output = v; }, "<files>", false, "sweep"},
  };
}

}  // namespace tofray::app
