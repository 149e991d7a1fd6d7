// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What instructions.sh counts: frames of a scene up to a stage, and nothing else. One thread, AVX2 (valgrind knows no AVX-512).
//     instructions SCENE STAGE NOISE FRAMES      STAGE 0 to 3: trace, power, raw, depth; NOISE 0 or 1: off, exact
#include <cstdio>
#include <cstdlib>

#include "tofray/tofray.h"

int main(int count, char** words) {
  using namespace tofray;
  if (count != 5) return 2;
  const Scene scene = load_scene(words[1]);
  SimulatorOptions options;
  options.noise = std::atoi(words[3]) == 0 ? Noise::off : Noise::exact;
  options.threads = 1, options.isa = Isa::avx2, options.backend = Backend::cpu, options.truth = false;
  options.last_stage = static_cast<Stage>(std::atoi(words[2]));
  Simulator simulator(scene, load_camera(scene), options);
  Frame frame;
  for (int i = 0; i < std::atoi(words[4]); ++i) simulator.frame(static_cast<std::uint64_t>(i), frame);
  std::printf("%zu\n", frame.truth.z_m.size() + frame.depth.z_m.size());
}
