// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/budget.h"

#include <fmt/core.h>

#include <algorithm>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/remarks.h"
#include "cli/requests.h"
#include "commands/budget_text.h"
#include "commands/solved_key.h"
#include "files/atomic_file.h"
#include "files/text_file.h"
#include "load/builtin.h"
#include "load/load.h"
#include "run/input_kind.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

/// A profile's text, read once: a search sets one of its keys again and again.
struct Profile {
  std::string text, name, folder;
  [[nodiscard]] Camera camera(const CameraOptions& options) const { return load::camera_from_text(text, name, folder, options); }
};

Profile profile_of(const std::string& name) {
  if (const load::Builtin* builtin = load::find_builtin(load::builtin_profiles(), name)) return {std::string(builtin->text), name, ""};
  if (load::find_builtin(load::builtin_scenes(), name) != nullptr)
    throw Error(
        ErrorKind::bad_input,
        fmt::format("error: {} is a scene\n  expected a camera profile, as in `tofray budget pico-flexx`; `tofray check {}` says what its "
                    "camera can do",
                    name, name));
  run::refuse_folder(name, "budget");
  const run::NamedText read = run::named_text(name);
  run::refuse_data(read.text, read.name);
  if (!run::looks_like_a_profile(read.text, read.name))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: this is no camera profile\n  expected one, as in `tofray budget pico-flexx`", read.name));
  return {read.text, read.name, files::folder_of(read.name)};
}

BudgetRequest request_of(const Options& options) {
  BudgetRequest out;
  out.distances_m = options.at_m, out.reflectivities = options.reflectivities, out.ambients = options.ambients;
  out.angle_rad = options.angle_rad, out.temperature_celsius = options.temperature_celsius, out.auto_exposure = options.auto_exposure;
  if (options.pixel) out.pixel = {static_cast<double>(options.pixel->first), static_cast<double>(options.pixel->second)};
  return out;
}

struct Answer {
  Camera camera;
  std::vector<BudgetRow> rows;
  BudgetSummary summary;
  std::string found;     ///< what --solve found, or that it found nothing; else empty
  files::Json solution;  ///< what --solve found, as JSON
  bool reached = true;
};

/// A value in the unit that the key's example has: digits as people read them.
std::string shown(const SolvedKey& key, double value) {
  const std::string text = key.text(value);
  const std::size_t space = std::min(text.find(' '), text.size());
  return fmt::format("{:.6g}{}", std::stod(text.substr(0, space)), text.substr(space));
}

Answer solved(const Profile& profile, const Options& options, const CameraOptions& wanted, BudgetRequest request) {
  const BudgetNeed need = budget_need(options.need);
  const SolvedKey key = solved_key(options.solve);
  Answer out;
  out.camera = profile.camera(wanted);  // its faults are no reason why a number cannot be reached
  const auto with = [&](double value) {
    CameraOptions one = wanted;
    one.set.emplace_back(key.key, key.text(value));
    return profile.camera(one);
  };
  const BudgetSolution solution = solve_budget(with, key.guess, key.low, key.high, need, request);
  const std::string wall = fmt::format("{:g} m, {:g} %, {}", need.z_m, 100 * need.reflectivity, need.ambient.name);
  out.reached = solution.reached;
  out.solution = files::Json::object().set("key", key.key).set("reached", solution.reached);
  if (!solution.reached) {
    out.found = fmt::format("cannot be reached: {:.4g} mm at {} by {}\n  {}, with {} = {}; its range is {} to {}\n", 1e3 * need.sigma_m,
                            wall, key.key, solution.why, key.key, shown(key, solution.value), shown(key, key.low), shown(key, key.high));
    out.solution.set("why", solution.why);
    return out;
  }
  request.distances_m = {need.z_m}, request.reflectivities = {need.reflectivity}, request.ambients = {need.ambient};
  out.camera = with(solution.value), out.rows = {solution.row}, out.summary = budget_summary(out.camera, request);
  out.found = fmt::format("{} = {} makes the range noise {:.4g} mm at {}\n\n", key.key, shown(key, solution.value),
                          1e3 * solution.row.sigma_m, wall);
  out.solution.set("value", solution.value).set("text", key.text(solution.value));
  return out;
}

Answer answer_of(const Options& options, const std::string& name) {
  if (options.need.empty() != options.solve.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("error: {} needs {}\n  expected both, as in --need \"sigma 10mm at 3m, 10%, 50klx\" --solve "
                            "illumination.0.power",
                            options.need.empty() ? "--solve" : "--need", options.need.empty() ? "--need" : "--solve"));
  const Profile profile = profile_of(name);
  const CameraOptions wanted{options.mode, camera_settings(options), {}};
  const BudgetRequest request = request_of(options);
  if (!options.need.empty()) return solved(profile, options, wanted, request);
  Answer out;
  out.camera = profile.camera(wanted);
  out.rows = budget(out.camera, request), out.summary = budget_summary(out.camera, request);
  return out;
}

std::string json_of(const Answer& answer) {
  files::Json json = files::Json::object();
  if (answer.reached) json = budget_json(answer.camera, answer.rows, answer.summary);
  if (!answer.found.empty()) json.set("solution", answer.solution);
  return files::json_text(json, 2) + "\n";
}

}  // namespace

int run_budget(const Options& options) {
  Remarks remarks;
  const NameChoice chosen = choose_camera(options.words[0]);
  remarks.tell(run::note_of(chosen));
  const Answer answer = answer_of(options, chosen.name);
  if (!answer.reached) {
    say(answer.found);
    if (options.json) print(json_of(answer));
    return 1;
  }
  const std::string& file = options.output;
  if (!file.empty()) files::write_file_atomically(file, file.ends_with(".json") ? json_of(answer) : budget_csv(answer.rows));
  if (options.json)
    print(json_of(answer));
  else if (options.csv)
    print(budget_csv(answer.rows));
  else if (file.empty() || !answer.found.empty())
    print(answer.found + budget_text(answer.camera, answer.rows, answer.summary));
  return 0;
}

}  // namespace tofray::app
