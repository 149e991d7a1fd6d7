// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <set>

#include "base/text.h"
#include "base/version.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "cli/requests.h"
#include "commands/results.h"
#include "results/manifest.h"
#include "run/input_kind.h"
#include "run/run.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

void refuse_other_settings(const Options& now) {
  if (!now.words.empty() || !now.set.empty() || !now.mode.empty() || now.seed || now.noise || now.exposure_samples || now.subpixel ||
      now.emit || now.mcap_compression || now.messages != MessageOptions{} || !now.arrays.empty() || now.compress || now.scale != 1 ||
      now.frames || now.first_frame != 0)
    throw Error(ErrorKind::bad_input,
                "error: --from makes the same bytes again and takes no other scene and no other settings\n"
                "  with it there may be -o, --threads, --backend, --device, --json and --quiet");
}

void say_other_version(const results::Manifest& manifest, Remarks& remarks) {
  if (manifest.tofray_version != base::version())
    remarks.tell(fmt::format("warning: tofray {} wrote this manifest, this is {}\n  the bytes may differ\n", manifest.tofray_version,
                             base::version()));
}

/// The files whose bytes are not those of the manifest.
std::vector<std::string> changed_files(const results::Manifest& before, const RunResult& now) {
  std::set<std::pair<std::string, std::string>> written;
  for (const FileRecord& file : now.files) written.emplace(file.name, file.sha256);
  std::vector<std::string> changed;
  for (const FileRecord& old : before.files)
    if (!written.contains({old.name, old.sha256})) changed.push_back(old.name);
  return changed;
}

/// Drawn for people, with the letters that the machine has: on another one it may have other bytes. What it shows is in other files, too.
bool is_figure(const std::string& name) { return name.ends_with(".png") && (name.starts_with("preview") || name.starts_with("raw")); }

/// Whether a run made the files that its manifest lists; says what it did not make.
bool made_again(const std::string& from, const results::Manifest& before, const RunResult& now, Remarks& remarks) {
  const std::vector<std::string> changed = changed_files(before, now);
  if (changed.empty()) return true;
  if (std::all_of(changed.begin(), changed.end(), is_figure)) {
    remarks.tell(fmt::format("note: {} {} letters of other fonts than {} lists; all else has the same bytes\n",
                             base::listed(changed, "and"), changed.size() == 1 ? "has" : "have", from));
    return true;
  }
  say(fmt::format("error: {} of {} files are not the bytes that {} lists: {}\n  it was written by tofray {} on {} ({})\n", changed.size(),
                  before.files.size(), from, base::listed(changed, "and"), before.tofray_version, before.cpu_model, before.isa));
  return false;
}

/// What lies there after an interruption, and how to make the rest with the same names and kinds of files.
void say_interrupted(const RunRequest& request, const RunResult& result) {
  const std::uint64_t frames = *request.frames, next = request.first_frame + result.frames, rest = frames - result.frames;
  const std::string all = fmt::format("interrupted: {} of {} frames are complete", result.frames, frames);
  const std::string listed = fmt::format(", {} lists them\n", (result.folder / "manifest.json").native());
  const std::vector<std::string> kinds = run::kinds_of(request.files, frames);
  std::string emit;
  for (const std::string& kind : kinds) emit += (emit.empty() ? " --emit " : ",") + kind;
  say(all + listed +
      fmt::format("  the others: the same command with --first-frame {} --frames {}{}\n", next, rest,
                  run::kinds_of(request.files, rest) == kinds ? "" : emit));
}

}  // namespace

int run_render(const Options& options) {
  run::Stopwatch stopwatch;
  results::Manifest before;
  Remarks remarks;
  const bool again = !options.from.empty();
  if (again) {
    before = results::read_manifest(options.from);
    refuse_other_settings(options);
    say_other_version(before, remarks);
  }
  const NameChoice chosen = again ? NameChoice() : choose_scene(options.words[0]);
  remarks.tell(run::note_of(chosen));
  const RunRequest request = run_request(chosen.name, options);
  const run::Loaded in = run::load(request.inputs);
  const std::uint64_t frames = request.frames.value_or(1);

  FrameProgress now;
  std::optional<StopRequest> stop;
  std::optional<Progress> progress;
  RunWatch watch;
  watch.progress = &now;
  watch.remark = [&](const Remark& one) { remarks.tell({one}); };
  watch.started = [&](const RanOn& machine) {
    say_fallback(options, machine, remarks);
    if (frames > 1) stop.emplace(&now.stop);
    progress.emplace(frames, "frames", options.quiet, &now);
  };
  watch.frame_done = [&](const Frame&, std::uint64_t done) {
    progress->step();
    if (done == frames) progress.reset();
  };
  const RunResult result = run::perform(request, in, watch, stopwatch);
  progress.reset();
  if (result.frames == 0) {
    say("interrupted before the first frame was complete\n");
    return 128 + stop->signal();
  }
  if (result.interrupted) say_interrupted(request, result);
  const bool stopped = stop && stop->signal() != 0;
  const bool same = !again || stopped || made_again(options.from, before, result, remarks);
  if (options.json)
    print(files::json_text(summary_json(result, remarks).set("interrupted", result.interrupted), 2) + "\n");
  else
    Talk(options.quiet)(summary_text(result));
  return stopped ? 128 + stop->signal() : same ? 0 : 1;
}

}  // namespace tofray::app
