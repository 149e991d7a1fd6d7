// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "shards/canary.h"

#include <memory>

#include "files/sha256.h"
#include "results/frame_file.h"
#include "results/meta.h"
#include "tofray/load.h"
#include "tofray/simulator.h"

namespace tofray::shards {

namespace {

constexpr const char* scene_text = R"(
camera: {profile: pico-flexx, mode: MODE_9_15FPS_700}
ambient: {spectrum: sun_am15, illuminance: 5 klx, direction: [0.3, 1, 0.4]}
transport: {bounces: 2, samples: 4, seed: 3}
materials:
  paint: {brdf: phong, diffuse: 0.4, specular: 0.1, exponent: 12}
  clay: {brdf: oren_nayar, reflectivity: 0.6, roughness: 20 deg}
  steel: {brdf: ggx, diffuse: 0.2, specular: 0.5, alpha: 0.3}
objects:
  - plane: {point: [0, 0, 1.5], normal: [0, 0.05, -1], reflectivity: 0.7}
  - plane: {point: [0, 0.3, 0], normal: [0, -1, 0], material: clay}
  - sphere: {name: ball, center: [-0.2, 0.05, 0.9], radius: 12 cm, material: paint, velocity: [0.8 m/s, 0 m/s, -0.4 m/s]}
  - box: {min: [0.1, 0, 1], max: [0.3, 0.3, 1.2], rotation: {axis: [0, 1, 0], angle: 33 deg}, material: steel, angular_velocity: [0 deg/s, 90 deg/s, 0 deg/s]}
  - cylinder: {center: [0.05, 0.05, 0.75], axis: [0, 1, 0.1], height: 50 cm, radius: 3 cm, reflectivity: 0.3}
)";

const std::vector<std::pair<std::string, std::string>> camera_settings = {
    {"sensor.width", "32"},
    {"sensor.height", "24"},
    {"lens.fx", "30 px"},
    {"lens.fy", "30 px"},
    {"lens.cx", "15.5 px"},
    {"lens.cy", "11.5 px"},
    {"pixel.patterns.prnu", "1 %"},
    {"pixel.patterns.dsnu", "2 DN"},
    {"pixel.patterns.delay", "20 ps"},
    {"pixel.crosstalk.left_right", "1 %"},
    {"lens.scatter", "{kind: gaussians, share: 5 %, sigma: [2 px]}"},
};

/// A sheet of 2·12·12 triangles in waves, so that a hierarchy of boxes takes part.
Object waves() {
  constexpr int n = 12;
  auto sheet = std::make_shared<TriangleMesh>();
  for (int v = 0; v <= n; ++v)
    for (int u = 0; u <= n; ++u)
      sheet->vertices.push_back({-0.35F + 0.05F * static_cast<float>(u), -0.45F + 0.03F * static_cast<float>(v),
                                 1.1F + 0.01F * static_cast<float>((3 * u + 5 * v) % 7)});
  for (int v = 0; v < n; ++v)
    for (int u = 0; u < n; ++u) {
      const int at = v * (n + 1) + u;
      sheet->triangles.push_back({at, at + 1, at + n + 1}), sheet->triangles.push_back({at + 1, at + n + 2, at + n + 1});
    }
  Mesh mesh;
  mesh.triangles = std::move(sheet);
  Object out;
  out.name = "waves", out.shape = std::move(mesh);
  return out;
}

}  // namespace

std::string canary_sha256() {
  Scene scene = load_scene_text(scene_text, "<canary>");
  scene.objects.push_back(waves());
  const Camera camera = load_camera(scene, {"", camera_settings, ""});
  files::Sha256 sum;
  for (const bool samples : {false, true}) {
    SimulatorOptions options;
    options.seed = 11, options.threads = 1, options.backend = Backend::cpu;
    if (samples) options.subpixel = 2, options.exposure_samples = 2, scene.transport.bounces = 0;
    const Frame frame = Simulator(scene, camera, options).frame(1);
    const results::FrameArrays arrays(frame, camera, camera_pose(scene, frame.truth.time_s), results::ArrayChoice());
    for (const files::NpyView& view : arrays.views()) sum.add(view.name), sum.add(view.bytes);
  }
  return sum.hex();
}

}  // namespace tofray::shards
