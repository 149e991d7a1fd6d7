// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "base/text.h"
#include "cli/console.h"
#include "cli/subprocess.h"
#include "commands/shards.h"
#include "files/json.h"
#include "tofray/error.h"
#include "tofray/shards.h"

/// `tofray dataset submit`: the shards that are missing as an array of jobs of Slurm, and a merge behind them.
namespace tofray::app {

namespace {

/// Where this program is: on the nodes it has to be at the same place.
std::string own_path() {
  std::error_code fault;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", fault);
  return fault ? "tofray" : path.native();
}

/// What Slurm says, or an Error with what it says of a fault.
std::string asked(const std::vector<std::string>& words, const std::string& input = "") {
  const Finished done = run_program(words, input);
  if (!done.found)
    throw Error(
        ErrorKind::device,
        fmt::format("error: there is no {} here\n  expected Slurm's commands on this machine; --print shows the script, for another one",
                    words[0]));
  if (done.code != 0)
    throw Error(
        ErrorKind::io,
        fmt::format("error: {} failed with exit code {}: {}\n  nothing was submitted by it; `tofray dataset status` says what is missing",
                    words[0], done.code, base::printable(done.err.empty() ? done.out : done.err)));
  return done.out;
}

/// Slurm's MaxArraySize: an array's largest index is one less.
std::uint64_t largest_array() {
  const std::string text = asked({"scontrol", "show", "config"});
  constexpr std::uint64_t usual = 1001;
  const std::size_t at = text.find("MaxArraySize");
  if (at == std::string::npos) return usual;
  const std::size_t digit = text.find_first_of("0123456789", at);
  std::uint64_t out = usual;
  if (digit != std::string::npos) std::from_chars(text.data() + digit, text.data() + text.size(), out);
  return std::max<std::uint64_t>(out, 1);
}

/// The job's number out of what `sbatch --parsable` says: "123" or "123;cluster".
std::string job_of(const std::string& said) { return said.substr(0, said.find_first_not_of("0123456789")); }

std::string head(const std::string& name, const std::string& log, const Options& options) {
  std::string out = fmt::format("#!/bin/sh\n#SBATCH --job-name={}\n#SBATCH --output={}\n#SBATCH --open-mode=append\n#SBATCH --requeue\n",
                                shell_word(name), shell_word(log));
  if (options.threads > 0) out += fmt::format("#SBATCH --cpus-per-task={}\n", options.threads);
  for (const std::string& one : options.shards.sbatch) out += fmt::format("#SBATCH {}\n", one);
  return out;
}

}  // namespace

int run_dataset_submit(const Options& options) {
  const std::filesystem::path folder = std::filesystem::absolute(options.words[1]);
  const DatasetPlan plan = read_plan(folder);
  const DatasetStatus status = dataset_status(folder);
  if (status.missing.empty() && !options.shards.print_only) {
    if (options.json)
      print(files::json_text(files::Json::object().set("tasks", 0)) + "\n");
    else
      print(fmt::format("all {} shards are there: nothing to submit\n", status.shards));
    return 0;
  }
  constexpr std::uint64_t usual_tasks = 100;
  std::uint64_t tasks = options.shards.tasks != 0 ? options.shards.tasks : usual_tasks;
  tasks = std::clamp<std::uint64_t>(tasks, 1, status.shards);
  if (!options.shards.print_only) {
    const std::uint64_t most = largest_array();
    if (tasks > most)
      throw Error(ErrorKind::bad_input,
                  fmt::format("error: {} tasks are more than this cluster's MaxArraySize takes\n  expected at most {}", tasks, most));
  }
  std::string name;
  for (const char c : plan.name)
    name += (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '_' ? c : '_';
  const std::string tool = shell_word(own_path()), set = shell_word(folder.native());
  // The shell becomes srun, which hands signals on to the step: bash would keep them until its child ends.
  std::string work = head("tofray-" + name, (folder / "log/slurm-%A_%a.out").native(), options);
  work += fmt::format(
      "#SBATCH --array=0-{}\n#SBATCH --signal=B:TERM@60\nexec srun {} dataset run {} --part \"$SLURM_ARRAY_TASK_ID/{}\" --threads "
      "\"${{SLURM_CPUS_PER_TASK:-1}}\" --quiet\n",
      tasks - 1, tool, set, tasks);
  std::string merge = head("tofray-merge-" + name, (folder / "log/slurm-merge-%j.out").native(), options);
  merge += fmt::format("exec srun {} dataset merge {}\n", tool, set);
  if (options.shards.print_only) {
    print(work);
    return 0;
  }
  std::error_code fault;
  std::filesystem::create_directories(folder / "log", fault);
  const std::string job = job_of(asked({"sbatch", "--parsable"}, work));
  // Also where a task failed, so that what is missing is told.
  const std::string merging = job_of(asked({"sbatch", "--parsable", "--dependency=afterany:" + job}, merge));
  if (options.json)
    print(files::json_text(
              files::Json::object().set("tasks", tasks).set("job", job).set("merge", merging).set("missing", status.missing.size())) +
          "\n");
  else
    print(
        fmt::format("job {}: {} tasks for {} missing shards; job {} merges them\n  squeue says how far they are, tofray dataset status {} "
                    "what is there; what failed is submitted "
                    "by the same command\n",
                    job, tasks, status.missing.size(), merging, base::printable(options.words[1])));
  return 0;
}

}  // namespace tofray::app
