// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/frame_writer.h"

#include <algorithm>
#include <system_error>

namespace tofray::run {

namespace {

/// Writing waits for the disk more than it computes: more threads than cores, so that there is always something for the disk to do.
constexpr std::uint64_t most_writers = 6;
/// Of all frames that are under way, and of the files they become.
constexpr std::size_t most_bytes = 512'000'000;

std::size_t bytes_of(const Frame& frame) {
  std::size_t bytes = 0;
#define TOFRAY_COUNT(name, part, member, element, ...) bytes += frame.part.member.size() * sizeof(element);
  TOFRAY_FRAME_ARRAYS(TOFRAY_COUNT)
#undef TOFRAY_COUNT
  return bytes;
}

}  // namespace

FrameWriter::FrameWriter(files::OutputFolder& folder, const FrameFiles& what, std::uint64_t frames, McapSink* film)
    : folder_(folder), what_(what), frames_(frames), film_(film) {}

FrameWriter::~FrameWriter() { stop(); }

/// The first frame says how many there is memory for: one is computed while each worker has one, and the file that it becomes. Where
/// there is not enough for two, and where no thread can be made, whoever computes writes.
void FrameWriter::start_workers(const Frame& frame) {
  const std::size_t room = most_bytes / std::max<std::size_t>(1, bytes_of(frame));
  const std::uint64_t workers = frames_ == 1 || room < 3 ? 0 : std::min<std::uint64_t>({most_writers, frames_, (room - 1) / 2});
  try {
    while (workers_.size() < workers) workers_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {
    // fewer will do
  }
  while (memory_.size() < workers_.size() + 1) free_.push_back(memory_.emplace_back(std::make_unique<Frame>()).get());
}

Frame& FrameWriter::next() {
  std::unique_lock lock(mutex_);
  if (memory_.empty()) free_.push_back(memory_.emplace_back(std::make_unique<Frame>()).get());
  changed_.wait(lock, [this] { return !free_.empty() || !failed_.empty(); });
  if (!failed_.empty()) {
    lock.unlock();
    finish();
  }
  current_ = free_.back();
  free_.pop_back();
  return *current_;
}

void FrameWriter::write(const std::string& suffix) {
  const Task task{given_++, current_, suffix};
  std::unique_lock lock(mutex_);
  if (task.number == 0) start_workers(*current_);
  if (workers_.empty()) {
    lock.unlock();
    done(task, file_);
  } else {
    waiting_.push_back(task);
    changed_.notify_all();
  }
}

/// Writes a frame and gives its memory back.
void FrameWriter::done(const Task& task, std::string& file) {
  std::vector<FileRecord> records;
  std::exception_ptr failure;
  try {
    records = write_frame(folder_, what_, task.suffix, *task.frame, file);
    if (film_ != nullptr) film_->write(task.number, *task.frame);
  } catch (...) {
    failure = std::current_exception();
    if (film_ != nullptr) film_->give_up(task.number);
  }
  const std::lock_guard lock(mutex_);
  if (failure)
    failed_[task.number] = failure, waiting_.clear();
  else
    written_[task.number] = std::move(records);
  free_.push_back(task.frame);
  changed_.notify_all();
}

void FrameWriter::work() {
  std::string file;
  for (;;) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const Task task = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    done(task, file);
  }
}

/// What waits is still written, unless something failed.
void FrameWriter::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
  }
  for (std::thread& worker : workers_) worker.join();
  workers_.clear();
}

void FrameWriter::finish() {
  stop();
  for (const auto& [frame, records] : written_) {
    for (const FileRecord& record : records) folder_.add(record);
  }
  written_.clear();
  if (!failed_.empty()) std::rethrow_exception(failed_.begin()->second);
}

}  // namespace tofray::run
