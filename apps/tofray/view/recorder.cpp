// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/recorder.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <utility>

#include "cli/requests.h"
#include "files/atomic_file.h"
#include "files/sha256.h"
#include "run/run.h"
#include "tofray/error.h"
#include "view/export.h"
#include "view/fault.h"
#include "view/new_files.h"

namespace tofray::view {

namespace fs = std::filesystem;
using files::Json;
using Clock = std::chrono::steady_clock;

struct Recorder::Job {
  std::uint64_t client;
  Order order;
  State state;
  fs::path folder;
  Outbox& out;
  FrameProgress progress = {};
  std::atomic<bool> done = false;
  std::mutex mutex = {};
  std::optional<NewEntry> entry = {};  ///< guarded by it
  Clock::time_point told = Clock::now();

  [[nodiscard]] const char* type() const { return order.kind == Order::Kind::page ? "export" : "record"; }
  [[nodiscard]] Json answer(std::uint64_t frames_done) const {
    return Json::object()
        .set("type", type())
        .set("id", order.id)
        .set("side", name_of(order.side))
        .set("frames", order.frames)
        .set("done", frames_done);
  }
  /// How far it is, five times a second at most.
  void tell(std::uint64_t frames_done) {
    constexpr auto between_words = std::chrono::milliseconds(200);
    const Clock::time_point now = Clock::now();
    if (frames_done == order.frames || now - told < between_words) return;
    told = now;
    out.tell(client, files::json_text(answer(frames_done)));
  }
  void refuse_stopped() const {
    if (progress.stop) throw Error(ErrorKind::bad_input, "error: it was given up\n  what there was of it is removed");
  }
  NewEntry& make(const char* prefix, const char* ending, bool is_folder) {
    const std::lock_guard lock(mutex);
    refuse_stopped();
    return entry.emplace(folder, prefix, ending, is_folder);
  }
};

Recorder::Recorder(fs::path folder) : folder_(std::move(folder)) {}

Recorder::~Recorder() {
  abandon();
  if (thread_.joinable()) thread_.join();
}

std::shared_ptr<Recorder::Job> Recorder::job() {
  const std::lock_guard lock(mutex_);
  return job_;
}

void Recorder::take(std::uint64_t client, const Order& order, const State& state, Outbox& outbox) {
  const std::shared_ptr<Job> before = job();
  if (before && before->client != client && !before->done && !before->progress.stop)
    throw Error(ErrorKind::bad_input, "error: another page's frames are being written\n  wait for their end, or stop them there");
  stop(client);
  const std::shared_ptr<Job> fresh(new Job{client, order, state, folder_, outbox});
  {
    const std::lock_guard lock(mutex_);
    job_ = fresh;
  }
  thread_ = std::thread([fresh, earlier = std::move(thread_)]() mutable {
    if (earlier.joinable()) earlier.join();
    run(*fresh);
  });
}

void Recorder::stop(std::uint64_t client) {
  if (const std::shared_ptr<Job> now = job(); now && now->client == client) now->progress.stop = true;
}

void Recorder::abandon() {
  const std::shared_ptr<Job> now = job();
  if (!now) return;
  now->progress.stop = true;
  const std::lock_guard lock(now->mutex);
  if (now->entry) now->entry->remove();
}

void Recorder::run(Job& job) {
  const auto fault = fault_of([&] { job.order.kind == Order::Kind::page ? write_page(job) : record(job); });
  {
    const std::lock_guard lock(job.mutex);
    job.entry.reset();
  }
  job.done = true;
  if (fault) job.out.tell(job.client, fault_text(job.order.id, *fault));
}

/// As `tofray render` does it.
void Recorder::record(Job& job) {
  const Order& order = job.order;
  NewEntry& folder = job.make("recording", "", true);
  RunRequest request = app::run_request(job.state.options.words[0], job.state.options);
  request.frames = order.frames, request.first_frame = order.first;
  request.folder = folder.part(), request.files = {}, request.clean = false;
  request.command = recording_words(job.state, order.first, order.frames);
  RunWatch watch;
  watch.progress = &job.progress;
  watch.frame_done = [&job](const Frame&, std::uint64_t done) { job.tell(done); };
  run::Stopwatch stopwatch;
  const RunResult result = run::perform(request, job.state.in, watch, stopwatch);
  job.refuse_stopped();
  Json files = Json::array();
  constexpr std::size_t most_told = 3000;  // a page that takes 1 MB too slowly is let go; manifest.json, which comes last, lists all
  const std::size_t left_out = result.files.size() - std::min(result.files.size(), most_told);
  for (std::size_t i = 0; i < result.files.size() - left_out; ++i) {
    const FileRecord& one = result.files[i];
    files.push(Json::object().set("name", one.name).set("bytes", one.bytes).set("sha256", one.sha256));
  }
  Json json = job.answer(order.frames);
  if (left_out > 0) json.set("left_out", left_out);
  json.set("folder", fs::absolute(folder.keep()).native()).set("files", std::move(files));
  job.out.tell(job.client, files::json_text(json.set("command", shell_text(request.command))));
}

/// As `tofray view --export` does it.
void Recorder::write_page(Job& job) {
  const Order& order = job.order;
  NewEntry& file = job.make("view", ".html", false);
  const ExportRequest request{order.first, order.frames, {}, &job.progress, [&job](std::uint64_t done) { job.tell(done); }};
  const std::string page = exported_page(job.state, request);
  files::write_file_atomically(file.part(), page);
  job.refuse_stopped();
  const fs::path name = fs::absolute(file.keep());
  Json json = job.answer(order.frames);
  json.set("file", name.native()).set("bytes", page.size()).set("sha256", files::sha256_hex(page));
  json.set("command", shell_text(export_words(job.state, request, name.filename().native())));
  job.out.tell(job.client, files::json_text(json));
}

}  // namespace tofray::view
