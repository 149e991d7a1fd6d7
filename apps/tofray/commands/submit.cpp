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

/// `tofray dataset submit`: the shards that are missing as an array of jobs of Slurm, and a merge behind them; for other engines what they take, to print.
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

/// Each line behind "# ".
std::string as_comment(const std::string& text) {
  std::string out = "# ";
  for (std::size_t i = 0; i < text.size(); ++i)
    out += text[i] == '\n' && i + 1 < text.size() ? std::string("\n# ") : std::string(1, text[i]);
  return out;
}

/// An array of jobs, whatever runs it.
struct JobArray {
  std::string name;  ///< letters, digits, - and _
  std::string folder;
  std::uint64_t tasks = 1;
  int threads = 1;
  /// What one of them runs, in a shell. @param index  where its number stands
  [[nodiscard]] std::string command(const char* index) const {
    return fmt::format("exec tofray dataset run {} --part \"${}/{}\" --threads {} --quiet", shell_word(folder), index, tasks, threads);
  }
};

std::string kubernetes_job(const JobArray& of) {
  std::string name = "tofray-" + of.name;
  for (char& c : name) c = c == '_' ? '-' : static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  using files::Json;
  // Wrong use, exit code 2, is the same again however often it is tried.
  Json rule = Json::object()
                  .set("action", "FailIndex")
                  .set("onExitCodes", Json::object().set("operator", "In").set("values", Json::array().push(std::uint64_t{2})));
  Json mount = Json::object().set("name", "set").set("mountPath", of.folder);
  Json container = Json::object().set("name", "tofray").set("image", "IMAGE");
  container.set("command", Json::array().push("sh").push("-c").push(of.command("JOB_COMPLETION_INDEX")));
  container.set("volumeMounts", Json::array().push(std::move(mount)));
  Json volume = Json::object().set("name", "set").set("persistentVolumeClaim", Json::object().set("claimName", "CLAIM"));
  Json pod = Json::object().set("restartPolicy", "Never").set("containers", Json::array().push(std::move(container)));
  pod.set("volumes", Json::array().push(std::move(volume)));
  Json spec = Json::object().set("completions", of.tasks).set("parallelism", of.tasks).set("completionMode", "Indexed");
  spec.set("backoffLimitPerIndex", std::uint64_t{3})
      .set("podFailurePolicy", Json::object().set("rules", Json::array().push(std::move(rule))));
  spec.set("template", Json::object().set("spec", std::move(pod)));
  Json job = Json::object().set("apiVersion", "batch/v1").set("kind", "Job").set("metadata", Json::object().set("name", name));
  return files::json_text(job.set("spec", std::move(spec)), 2) + "\n";
}

std::string aws_batch_job(const JobArray& of) {
  constexpr std::uint64_t fewest = 2, most = 10'000;
  if (of.tasks < fewest || of.tasks > most)
    throw Error(
        ErrorKind::bad_input,
        fmt::format("error: an array of AWS Batch has 2 to 10000 jobs, not {}\n  expected --tasks within, and as many shards at least",
                    of.tasks));
  using files::Json;
  Json last = Json::object().set("onExitCode", "2").set("action", "EXIT"),
       others = Json::object().set("onExitCode", "*").set("action", "RETRY");
  Json retries =
      Json::object().set("attempts", std::uint64_t{3}).set("evaluateOnExit", Json::array().push(std::move(last)).push(std::move(others)));
  Json command = Json::array().push("sh").push("-c").push(of.command("AWS_BATCH_JOB_ARRAY_INDEX"));
  Json job = Json::object().set("jobName", "tofray-" + of.name).set("jobQueue", "QUEUE").set("jobDefinition", "DEFINITION");
  job.set("arrayProperties", Json::object().set("size", of.tasks)).set("retryStrategy", std::move(retries));
  return files::json_text(job.set("containerOverrides", Json::object().set("command", std::move(command))), 2) + "\n";
}

/// Engines whose programs are not here.
int print_for_other_engine(const JobArray& of, const Options& options) {
  if (!options.shards.print_only)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: submit hands jobs to Slurm alone\n  expected --print, for what {} takes", options.shards.engine));
  if (!options.shards.sbatch.empty())
    throw Error(ErrorKind::bad_input, fmt::format("error: --sbatch is of Slurm\n  expected none with --engine {}", options.shards.engine));
  print(options.shards.engine == "kubernetes" ? kubernetes_job(of) : aws_batch_job(of));
  return 0;
}

}  // namespace

int run_dataset_submit(const Options& options) {
  const std::filesystem::path folder = std::filesystem::absolute(options.words[1]);
  const DatasetPlan plan = read_plan(folder);
  const DatasetStatus status = dataset_status(folder);
  if (status.missing.empty() && options.shards.engine == "slurm" && !options.shards.print_only) {
    if (options.json)
      print(files::json_text(files::Json::object().set("tasks", 0)) + "\n");
    else
      print(fmt::format("all {} shards are there: nothing to submit\n", status.shards));
    return 0;
  }
  constexpr std::uint64_t usual_tasks = 100;
  std::uint64_t tasks = options.shards.tasks != 0 ? options.shards.tasks : usual_tasks;
  tasks = std::clamp<std::uint64_t>(tasks, 1, status.shards);
  const bool slurm = options.shards.engine == "slurm";
  if (slurm && !options.shards.print_only) {
    const std::uint64_t most = largest_array();
    if (tasks > most)
      throw Error(ErrorKind::bad_input,
                  fmt::format("error: {} tasks are more than this cluster's MaxArraySize takes\n  expected at most {}", tasks, most));
  }
  std::string name;
  for (const char c : plan.name)
    name += (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '_' ? c : '_';
  if (!slurm) return print_for_other_engine({name, folder.native(), tasks, std::max(1, options.threads)}, options);
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
    print(work + as_comment("what merges behind it, as a script of its own: sbatch --dependency=afterany:JOB\n" + merge));
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
