// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <condition_variable>
#include <cstdint>
#include <limits>
#include <mutex>

#include "run/frame_files.h"
#include "tofray/mcap.h"

namespace tofray::run {

/// run.mcap of a run. Several threads make messages at once; they are written in the frames' order.
class McapSink {
 public:
  /// @param what  must live as long. @throws Error as McapWriter
  McapSink(const files::OutputFolder& folder, const FrameFiles& what, const RunRequest& request);
  /// Waits until the frames before have been written. @param number  of the frame in the run, from 0 on
  /// @throws Error as McapWriter::write, and where a frame before was given up
  void write(std::uint64_t number, const Frame& frame);
  /// A frame will not come: those behind it wait no longer.
  void give_up(std::uint64_t number);
  FileRecord finish() { return writer_.close(); }

 private:
  const FrameFiles& what_;
  McapWriter writer_;
  std::mutex mutex_;
  std::condition_variable changed_;
  // guarded by it, as the writer is:
  std::uint64_t next_ = 0;
  std::uint64_t given_up_ = std::numeric_limits<std::uint64_t>::max();  ///< the first of them
};

}  // namespace tofray::run
