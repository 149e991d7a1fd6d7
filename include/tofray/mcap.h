// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tofray/file_record.h"
#include "tofray/messages.h"
#include "tofray/simulator.h"

/// Films as MCAP files, which ROS 2 (rosbag2), Foxglove and others open: profile ros2, messages of tofray/messages.h. As load.h, of
/// libtofray_files.
namespace tofray {

/// How the chunks of an MCAP file are packed.
enum class McapCompression { none, zstd };
/// zstd, or none in a build without libzstd.
McapCompression usual_mcap_compression();

/// How a film is written.
struct McapOptions {
  MessageOptions messages;
  McapCompression compression = usual_mcap_compression();
  std::vector<std::pair<std::string, std::string>> attachments = {};  ///< name and text of further files in it
};

/// Writes frames into an MCAP file, one after the other, in little memory: a chunk of 1 MiB goes to the disk whole. Until close() the file is
/// called run.part.mcap for run.mcap; a program that ends early leaves it, and all of its whole chunks can be read. No clock is asked: the
/// same frames give the same bytes, for one version of libzstd.
///
/// Attached are camera.yaml (the camera with all its numbers, a profile) and what the options say; the metadata record `tofray` has version,
/// seed, scene, camera, and what the messages leave open (the amplitude's step).
class McapWriter {
 public:
  /// @param simulated  what the frames are simulated with: seed and noise are told
  /// @throws Error (io) where the file cannot be made; (bad_input) as Messages, and for zstd in a build without it
  McapWriter(const std::filesystem::path& file, const Scene& scene, const Camera& camera, const McapOptions& options = {},
             const SimulatorOptions& simulated = {});
  /// Unless it was closed: what was written stays under the name with .part; a file without a frame goes.
  ~McapWriter();
  McapWriter(McapWriter&&) noexcept;
  McapWriter& operator=(McapWriter&&) noexcept;

  [[nodiscard]] const Messages& messages() const;  ///< what makes its messages
  /// @throws Error (io) where the disk is full; (bad_input) as Messages::of
  void write(const Frame& frame);
  /// Writes a frame whose camera was placed from outside. @param seen  placed_scene() of its request
  void write(const Frame& frame, const Scene& seen);
  /// Messages of a frame that were made already, by messages().of(frame).
  void write(const Frame& frame, const std::vector<Message>& messages);
  /// Writes the summary and gives the file its name. @throws Error (io)
  FileRecord close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What is in an MCAP file, of any writer.
struct McapContents {
  /// A topic, and what came on it.
  struct Channel {
    std::string topic, type, encoding;  ///< encoding of the messages: "cdr"
    std::uint64_t messages = 0, bytes = 0;
    std::int64_t first_ns = 0, last_ns = 0;  ///< log times
    double rate_hz = 0;                      ///< messages a second between these; 0 of fewer than two
  };
  std::string file, profile, library;
  bool complete = true;          ///< false: it ends early, and what is here is all up to its last whole chunk
  std::uint64_t bytes = 0;       ///< size of the file
  std::uint64_t lost_bytes = 0;  ///< behind the last whole record of one that ends early
  std::uint64_t chunks = 0;
  std::uint64_t unpacked_bytes = 0, packed_bytes = 0;  ///< bytes of all chunks
  std::string compression;                             ///< "zstd", "none", or both with "," between
  std::uint64_t messages = 0;
  std::int64_t first_ns = 0, last_ns = 0;
  std::vector<Channel> channels;                                   ///< channels in the order of their topics
  std::vector<std::pair<std::string, std::uint64_t>> attachments;  ///< name, bytes
  std::vector<std::pair<std::string, std::vector<std::pair<std::string, std::string>>>> metadata;
};

/// Reads a whole MCAP file and its sums, and says what is in it.
/// @throws Error (io, bad_input, limit) where it cannot be read, is none, or is damaged
McapContents mcap_contents(const std::string& file);

}  // namespace tofray
