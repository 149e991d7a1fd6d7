// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What it takes to place things from outside: frames of ten shapes and of a mesh of 100,000 triangles, at rest and placed anew each frame, in
// turn. Words: how many frames of each [300].
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tofray/load.h"
#include "tofray/simulator.h"

namespace {

using namespace tofray;

Object object(const std::string& name, const decltype(Object::shape)& shape) {
  Object out;
  out.name = name, out.shape = shape;
  return out;
}

Scene wall() {
  Scene out;
  Material grey;
  grey.diffuse = 0.6;
  out.materials.push_back(grey);
  out.objects.push_back(object("wall", Plane{{0, 0, 2}, {0, 0, -1}}));
  return out;
}

/// Ten of them, apart, before a wall.
Scene shapes() {
  Scene out = wall();
  for (int i = 0; i < 10; ++i) {
    const double x = 0.25 * (i % 5 - 2), y = i < 5 ? -0.15 : 0.15;
    const std::string name = "part" + std::to_string(i);
    if (i % 3 == 0) out.objects.push_back(object(name, Sphere{{x, y, 1}, 0.08}));
    if (i % 3 == 1) out.objects.push_back(object(name, Box{{x - 0.07, y - 0.07, 0.95}, {x + 0.07, y + 0.07, 1.05}}));
    if (i % 3 == 2) out.objects.push_back(object(name, Capsule{{x, y - 0.06, 1}, {x, y + 0.06, 1}, 0.04}));
  }
  return out;
}

/// A ball with bumps, of 2 · n² triangles.
Scene bumpy(int n) {
  TriangleMesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < n; ++j) {
      const double up = 3.14159265358979 * i / n, around = 2 * 3.14159265358979 * j / n;
      const double r = 0.4 + 0.02 * std::sin(9 * around) * std::sin(7 * up);
      mesh.vertices.push_back({static_cast<float>(r * std::sin(up) * std::cos(around)), static_cast<float>(r * std::cos(up)),
                               static_cast<float>(r * std::sin(up) * std::sin(around))});
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * n + j, b = i * n + (j + 1) % n;
      mesh.triangles.push_back({a, b, a + n}), mesh.triangles.push_back({b, b + n, a + n});
    }
  Mesh shape;
  shape.triangles = std::make_shared<const TriangleMesh>(std::move(mesh));
  Scene out = wall();
  Object one = object("part0", shape);
  one.position = {0, 0, 1};
  out.objects.push_back(one);
  return out;
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double median(std::vector<double> all) {
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

FrameRequest placed(std::uint64_t i, int parts, bool mesh) {
  FrameRequest out{.index = i};
  const double t = 0.01 * static_cast<double>(i);
  for (int k = 0; k < parts; ++k) {
    const Vec3 from{0.05 * std::sin(t + k), 0.03 * std::cos(t), mesh ? 1.0 : 0.05 * std::sin(3 * t)};
    const Vec3 to{from[0] + 0.005, from[1], from[2] - 0.003};
    out.objects.push_back({"part" + std::to_string(k), {from, {{0, 1, 0}, t}}, Placement{to, {{0, 1, 0}, t + 0.02}}, {}});
  }
  return out;
}

struct Took {
  double wall_s, cpu_s;
};

/// Medians of as many frames of each kind, in turn.
std::vector<Took> in_turn(std::uint64_t frames, const std::vector<std::function<void(std::uint64_t)>>& kinds) {
  std::vector<std::vector<double>> wall(kinds.size()), cpu(kinds.size());
  for (std::uint64_t i = 0; i < frames + 5; ++i)
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const double begin = now();
      const std::clock_t busy = std::clock();
      kinds[k](i);
      if (i < 5) continue;
      cpu[k].push_back(static_cast<double>(std::clock() - busy) / CLOCKS_PER_SEC), wall[k].push_back(now() - begin);
    }
  std::vector<Took> out;
  for (std::size_t k = 0; k < kinds.size(); ++k) out.push_back({median(wall[k]), median(cpu[k])});
  return out;
}

/// Of so few pixels that what is left is what does not depend on rays.
Camera few_pixels(Camera camera) {
  camera.sensor.width = camera.sensor.height = 8, camera.lens.cx_px = camera.lens.cy_px = 3.5;
  return camera;
}

void say(const char* what, const Scene& scene, const Camera& camera, int parts, bool mesh, std::uint64_t frames) {
  Scene moving = scene;  // the same, by the scene itself
  for (Object& one : moving.objects)
    if (one.name != "wall") one.velocity_m_per_s = {1e-3, 0, 0}, one.angular_velocity_rad_per_s = {0, 0.1, 0};
  Simulator at_rest(scene, camera, {.threads = 2}), by_itself(moving, camera, {.threads = 2}), outside(scene, camera, {.threads = 2});
  Frame a, b, c;
  const std::vector<Took> took =
      in_turn(frames, {[&](std::uint64_t i) { at_rest.frame(i, a); }, [&](std::uint64_t i) { by_itself.frame(i, b); },
                       [&](std::uint64_t i) { outside.frame(placed(i, parts, mesh), c); }});
  std::printf("%s\n", what);
  const char* const kinds[] = {"at rest", "moved by the scene", "placed anew each frame"};
  for (std::size_t k = 0; k < took.size(); ++k)
    std::printf("  %-23s %7.3f ms, %5.0f frames/s; %7.3f ms of processors\n", kinds[k], 1e3 * took[k].wall_s, 1 / took[k].wall_s,
                1e3 * took[k].cpu_s);
}

}  // namespace

int main(int count, char** words) try {
  const std::uint64_t frames = count > 1 ? std::strtoull(words[1], nullptr, 10) : 300;
  const Camera camera = load_camera("pico-flexx"), few = few_pixels(camera);
  say("10 shapes", shapes(), camera, 10, false, frames);
  say("a mesh of 100,352 triangles", bumpy(224), camera, 1, true, frames);
  say("10 shapes, 8 x 8 pixels", shapes(), few, 10, false, 10 * frames);
  say("a mesh of 100,352 triangles, 8 x 8 pixels", bumpy(224), few, 1, true, 10 * frames);
  return 0;
} catch (const std::exception& fault) {
  std::fprintf(stderr, "%s\n", fault.what());
  return 1;
}
