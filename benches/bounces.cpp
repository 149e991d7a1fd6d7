// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Light that bounces: how long it takes to follow it, and how far off it is, against the number of ways for each pixel. The camera is moved
// by a hair's breadth from frame to frame, so that nothing is kept.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "tofray/load.h"
#include "tofray/tofray.h"

using namespace tofray;

namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Two walls, a floor and a box.
Scene corner_with_box() {
  Scene scene = load_scene("corner");
  scene.name = "corner, floor, box";
  Object floor, box;
  floor.shape = Plane{{0, 0.5, 0}, {0, -1, 0}}, box.shape = Box{{-0.15, 0.2, 1.0}, {0.15, 0.5, 1.25}};
  scene.objects.push_back(floor), scene.objects.push_back(box);
  return scene;
}

double frame_ms(const Scene& scene, const Camera& camera, int rounds) {
  Simulator simulator(scene, camera, {.noise = Noise::off, .truth = false});
  std::vector<FrameRequest> requests;
  for (int i = 0; i <= rounds; ++i) {
    Pose pose = scene.camera.pose;
    pose.position[0] += 1e-6 * i;
    requests.push_back({0, {}, pose});
  }
  std::vector<double> times;
  double before = seconds();
  simulator.frames(requests, [&](const FrameArrays&) {
    const double now = seconds();
    times.push_back(now - before), before = now;
  });
  std::sort(times.begin() + 1, times.end());
  return 1e3 * times[1 + static_cast<std::size_t>(rounds) / 2];
}

Truth truth_of(Scene scene, const Camera& camera, int samples, unsigned long long seed) {
  scene.transport.samples = samples, scene.transport.seed = seed;
  return Simulator(scene, camera, {.noise = Noise::off}).frame(0).truth;
}

/// Root of the mean square of what two sets of ways differ by, over the pixels that see something: of the indirect light, relative to the
/// direct, and of what it does to the half path [mm].
struct Off {
  double share, shift_mm;
};
Off difference(const Truth& a, const Truth& b, std::size_t at) {
  double share = 0, shift = 0;
  int count = 0;
  for (std::size_t i = at; i < at + a.range_m.size(); ++i) {
    const double direct = static_cast<double>(a.direct_e[i]);
    if (!(direct > 1)) continue;
    const double of_light = static_cast<double>(a.indirect_e[i] - b.indirect_e[i]) / direct;
    const double of_path = 1e3 * static_cast<double>(a.multipath_m[i] - b.multipath_m[i]);
    share += of_light * of_light, shift += of_path * of_path, ++count;
  }
  return {std::sqrt(share / count), std::sqrt(shift / count)};
}

/// Scenes by name, numbers of ways, and whether errors are measured, too.
struct Asked {
  std::vector<std::string> scenes;
  std::vector<int> ways;
  bool errors = true;
};

Asked asked_by(int count, char** words) {
  Asked out;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "times")
      out.errors = false;
    else if (const int ways = std::atoi(words[i]); ways > 0)
      out.ways.push_back(ways);
    else
      out.scenes.push_back(word);
  }
  if (out.ways.empty()) out.ways = {1, 4, 16, 64, 256};
  return out;
}

/// A row for light that does not bounce, and one for each number of ways.
void measure(Scene scene, int bounces, const Asked& asked) {
  const Camera camera = load_camera(scene);
  const char* name = scene.name.c_str();
  scene.transport = {0, 1, 0};
  std::printf("%-20s  %7d  %4s  %8.2f\n", name, 0, "-", frame_ms(scene, camera, 41));
  scene.transport.bounces = bounces;
  const Truth known = asked.errors ? truth_of(scene, camera, 4096, 1) : Truth();
  const auto lit = known.range_m.size();  // the first raw frame is the grey one
  for (const int ways : asked.ways) {
    scene.transport.samples = ways;
    std::printf("%-20s  %7d  %4d  %8.2f", name, bounces, ways, frame_ms(scene, camera, ways > 64 ? 5 : 11));
    if (asked.errors) {
      const Off off = difference(truth_of(scene, camera, ways, 0), known, lit);
      std::printf("  %30.2f  %6.2f", 100 * off.share, off.shift_mm);
    }
    std::printf("\n");
    std::fflush(stdout);
  }
}

}  // namespace

/// @param words  names of scenes and numbers of ways, in place of all of them; `times` for no errors, which take most of the time
int main(int count, char** words) {
  const Asked asked = asked_by(count, words);
  std::printf("scene                 bounces  ways        ms   off by [%% of the direct light]  [mm]\n");
  for (const auto& [scene, bounces] : {std::pair{corner_with_box(), 7}, {load_scene("room"), 7}, {load_scene("bench-mesh"), 3}}) {
    const bool wanted = asked.scenes.empty() || std::find(asked.scenes.begin(), asked.scenes.end(), scene.name) != asked.scenes.end();
    if (wanted) measure(scene, bounces, asked);
  }
}
