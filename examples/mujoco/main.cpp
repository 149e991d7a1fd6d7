// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A MuJoCo model seen by a time-of-flight camera: mujoco_film pendulum.xml eye
// (or arm.xml hand). Physics goes on while a frame's raw frames are exposed, one after the other; what moves is at another place in each.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "mirror.h"

namespace {

/// This stands for the robot's program: joints that have motors swing, each faster than the one before.
void drive(const mjModel* model, mjData* data) {
  for (int i = 0; i < model->nu; ++i) data->ctrl[i] = 0.2 * std::sin((3 + i) * data->time);
}

void step_until(const mjModel* model, mjData* data, double time_s) {
  while (data->time < time_s - 0.5 * model->opt.timestep) drive(model, data), mj_step(model, data);
  mj_forward(model, data);  // where things are now: mj_step leaves where they were
}

/// Of the depths of what moves, how far they are off in the median [m].
double error_of(const tofray::Frame& frame, const tofray::FrameRequest& request, const tofray::Scene& scene) {
  std::vector<float> errors;
  for (std::size_t i = 0; i < frame.depth.z_m.size(); ++i) {
    const int object = frame.truth.object_id[i];
    if (object < 0 || std::isnan(frame.depth.z_m[i])) continue;
    const std::string& name = scene.objects[static_cast<std::size_t>(object)].name;
    if (std::any_of(request.objects.begin(), request.objects.end(), [&](const tofray::PlacedObject& one) { return one.name == name; }))
      errors.push_back(std::abs(frame.depth.z_m[i] - frame.truth.z_m[i]));
  }
  if (errors.empty()) return 0;
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return static_cast<double>(*middle);
}

void film(const char* file, const char* camera_name) {
  char fault[1000] = "";
  const std::unique_ptr<mjModel, void (*)(mjModel*)> model(mj_loadXML(file, nullptr, fault, sizeof fault), mj_deleteModel);
  if (model == nullptr) throw std::runtime_error(fault);
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(model.get()), mj_deleteData);
  if (model->nv > 0 && model->nu == 0) data->qvel[0] = 2;  // rad/s: something moves

  Mirror mirror(model.get(), camera_name, {{"wood", tofray::load_material("wood")}});
  const tofray::Camera camera = tofray::load_camera("pico-flexx", {.mode = "MODE_9_10FPS_1000"});
  tofray::Simulator simulator(mirror.scene(), camera, {.seed = 7});
  tofray::McapWriter messages("film.mcap", mirror.scene(), camera, {}, {.seed = 7});
  tofray::Frame frame;
  for (std::uint64_t i = 0; i < 10; ++i) {
    const double start = static_cast<double>(i) / camera.mode.frame_rate_hz;
    for (const double when : tofray::exposure_times(camera, start)) step_until(model.get(), data.get(), when), mirror.look(data.get());
    const tofray::FrameRequest request = mirror.request(i, start);
    simulator.frame(request, frame);
    messages.write(frame, tofray::placed_scene(mirror.scene(), camera, request));
    std::printf("%.3f s: what moves is off by %.1f mm in the median\n", start, 1e3 * error_of(frame, request, mirror.scene()));
  }
  messages.close();
}

}  // namespace

int main(int count, char** words) try {
  if (count != 3) throw std::runtime_error("expected a model and one of its cameras: mujoco_film pendulum.xml eye");
  film(words[1], words[2]);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
