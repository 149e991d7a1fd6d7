// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What films take: one frame of the scene room, of a pico flexx (224 x 172, nine raw frames), as messages alone, and into an MCAP file packed
// and not, again and again on one thread. Bytes are those
// of the messages; rates are by the clock, and by the processor's time, which a busy machine and a slow disk change less. Words: folder [.], how many frames [300], rounds [3].
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "tofray/load.h"
#include "tofray/mcap.h"
#include "tofray/simulator.h"

namespace {

using namespace tofray;

/// By the clock, and the processor's [s].
struct Time {
  double clock, processor;
};
Time now() {
  timespec used{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return {std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(),
          static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec)};
}
Time since(const Time& before) {
  const Time after = now();
  return {after.clock - before.clock, after.processor - before.processor};
}

struct Film {
  const Scene& scene;
  const Camera& camera;
  const Frame& frame;
  int frames;
};

std::size_t bytes_of(const std::vector<Message>& all) {
  std::size_t out = 0;
  for (const Message& one : all) out += one.data.size();
  return out;
}

/// Making the messages of all frames.
Time make(const Film& of) {
  const Messages messages(of.scene, of.camera);
  std::vector<Message> memory;
  const Time before = now();
  for (int i = 0; i < of.frames; ++i) messages.of(of.frame, of.scene, memory);
  return since(before);
}

/// Writing them, with making them, the sums, SHA-256 and the disk (the file is synced before it counts).
Time write(const Film& of, const std::filesystem::path& file, McapCompression compression, std::uint64_t& size) {
  Frame frame = of.frame;
  const Time before = now();
  McapOptions options;
  options.compression = compression;
  McapWriter film(file, of.scene, of.camera, options);
  for (int i = 0; i < of.frames; ++i) {
    frame.index = static_cast<std::uint64_t>(i);
    film.write(frame);
  }
  size = film.close().bytes;
  const Time took = since(before);
  std::filesystem::remove(file);
  return took;
}

void measure(const std::filesystem::path& folder, int frames, int rounds) {
  const Scene scene = load_scene("room");
  const Camera camera = load_camera(scene);
  const Frame frame = Simulator(scene, camera).frame(0);
  const Film film{scene, camera, frame, frames};
  const double megabytes = 1e-6 * static_cast<double>(bytes_of(Messages(scene, camera).of(frame))) * frames;
  std::printf("%d frames, %.1f MB of messages, %.2f MB each\n", frames, megabytes, megabytes / frames);
  for (int round = 0; round < rounds; ++round) {
    const Time made = make(film);
    std::printf("made %.0f MB/s (processor %.0f)", megabytes / made.clock, megabytes / made.processor);
    for (const McapCompression compression : {McapCompression::none, McapCompression::zstd}) {
      if (compression == McapCompression::zstd && usual_mcap_compression() != compression) continue;
      std::uint64_t size = 0;
      const Time took = write(film, folder / "bench.mcap", compression, size);
      std::printf(", %s %.0f MB/s (processor %.0f; %.1f MB, %.0f frames/s)", compression == McapCompression::none ? "stored" : "zstd",
                  megabytes / took.clock, megabytes / took.processor, 1e-6 * static_cast<double>(size), frames / took.clock);
    }
    std::printf("\n");
  }
}

}  // namespace

int main(int count, char** words) {
  try {
    measure(count > 1 ? words[1] : ".", count > 2 ? std::atoi(words[2]) : 300, count > 3 ? std::atoi(words[3]) : 3);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
