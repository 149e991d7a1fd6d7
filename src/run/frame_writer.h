// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "run/frame_files.h"
#include "run/mcap_sink.h"

namespace tofray::run {

/// Writes the frames of a sequence while the next ones are computed, several at once. Frames and files lie in memory that goes round: there
/// is no more of it than a few frames, and none for a frame that is too large to have several of.
class FrameWriter {
 public:
  /// @param what  which files, and of whom; all of it must live as long as the writer
  /// @param frames  how many there will be
  /// @param film    where frames go besides, in their order; null: nowhere
  FrameWriter(files::OutputFolder& folder, const FrameFiles& what, std::uint64_t frames, McapSink* film = nullptr);
  /// What was handed over is written, unless some of it could not be.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Memory for the next frame; waits until some is free. @throws Error of the first frame that could not be written
  Frame& next();
  /// Hands over the frame that next() gave last. It may be read (and nothing else) until next() is called.
  void write(const std::string& suffix);
  /// Waits until all is written, and tells the folder in the frames' order. @throws Error as next()
  void finish();

 private:
  struct Task {
    std::uint64_t number;
    Frame* frame;
    std::string suffix;
  };
  void work();
  void done(const Task& task, std::string& file);
  void start_workers(const Frame& frame);
  void stop();

  files::OutputFolder& folder_;
  const FrameFiles& what_;
  std::uint64_t frames_, given_ = 0;
  McapSink* film_;
  std::vector<std::thread> workers_;
  std::vector<std::unique_ptr<Frame>> memory_;
  Frame* current_ = nullptr;
  std::string file_;  ///< of whoever computes, where there are no workers

  std::mutex mutex_;
  std::condition_variable changed_;
  // guarded by it:
  std::vector<Frame*> free_;
  std::deque<Task> waiting_;
  std::map<std::uint64_t, std::vector<FileRecord>> written_;  ///< by frame
  std::map<std::uint64_t, std::exception_ptr> failed_;
  bool stopping_ = false;
};

}  // namespace tofray::run
