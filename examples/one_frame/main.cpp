// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Simulates one frame of a scene file and says how far away the middle of the picture is.
#include <tofray/tofray.h>

#include <cstddef>
#include <cstdio>

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: one_frame SCENE.yaml\n");
    return 2;
  }
  // What the user wrote: the scene, and the camera that the scene asks for.
  const tofray::Scene scene = tofray::load_scene(argv[1]);
  const tofray::Camera camera = tofray::load_camera(scene);

  // From light to depth: nine raw frames, and the depth frame that the camera makes of them.
  tofray::Simulator simulator(scene, camera, {.seed = 7});
  const tofray::Frame frame = simulator.frame(0);

  // Arrays are row-major, [height][width].
  const int row = frame.depth.height / 2;
  const int column = frame.depth.width / 2;
  const auto pixel = static_cast<std::size_t>(row * frame.depth.width + column);
  std::printf("centre pixel: z = %.3f m, noise %.1f mm, amplitude %.0f electrons\n", static_cast<double>(frame.depth.z_m[pixel]),
              1e3 * static_cast<double>(frame.depth.noise_m[pixel]), static_cast<double>(frame.depth.amplitude_e[pixel]));

  // The same decoder also takes raw data from elsewhere, a recording for instance.
  const tofray::Depth again = tofray::process(frame.raw, camera);
  std::printf("decoded again from the raw frames: z = %.3f m\n", static_cast<double>(again.z_m[pixel]));
  return 0;
} catch (const tofray::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return static_cast<int>(error.kind());
}
