// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// frames SCENE COUNT [no-truth]: milliseconds per frame of Simulator::frame as C++ calls it, for benches/python_frames.py and recording.py:
// into a frame that is made anew each time, into one that is kept, and into two in turn, as Python's `frame = simulator.frame(i)` has them.
#include <tofray/tofray.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point since, std::uint64_t count) {
  return std::chrono::duration<double, std::milli>(Clock::now() - since).count() / static_cast<double>(count);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3 && argc != 4) return 2;
  const bool truth = argc == 3 || std::string_view(argv[3]) != "no-truth";
  const tofray::Scene scene = tofray::load_scene(argv[1]);
  const std::uint64_t count = std::strtoull(argv[2], nullptr, 10);
  tofray::Simulator simulator(scene, tofray::load_camera(scene), {.threads = 2, .truth = truth});
  tofray::Frame kept = simulator.frame(0);
  Clock::time_point since = Clock::now();
  for (std::uint64_t i = 0; i < count; ++i) kept = simulator.frame(i);
  const double anew = milliseconds(since, count);
  since = Clock::now();
  for (std::uint64_t i = 0; i < count; ++i) simulator.frame(i, kept);
  const double one = milliseconds(since, count);
  std::array<tofray::Frame, 2> both{kept, kept};
  since = Clock::now();
  for (std::uint64_t i = 0; i < count; ++i) simulator.frame(i, both[i % 2]);
  std::printf("%.6f %.6f %.6f\n", anew, one, milliseconds(since, count));
  return 0;
} catch (const std::exception& fault) {
  std::fprintf(stderr, "%s\n", fault.what());
  return 1;
}
