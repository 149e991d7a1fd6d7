// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Linked to libtofray alone, as a user's program is: every function of the public headers must be there (cmake/tofray.map shows them).
#include <tofray/tofray.h>

#include <cstdio>
#include <stdexcept>

namespace {

void expect(bool held, const char* what) {
  if (!held) throw std::runtime_error(what);
}

void on_device(tofray::Simulator& simulator) {
  tofray::DeviceFrames frames, moved(std::move(frames));
  frames = std::move(moved);
  const tofray::FrameRequest requests[] = {{3, {}, {}}};
  try {
    simulator.frames_on_device(0, 2, frames);
    simulator.frames_on_device(requests, frames);
    expect(frames.size() == 1 && frames[0].z_m != nullptr && frames.seconds() > 0, "frames_on_device");
  } catch (const tofray::Error& error) {
    expect(error.kind() == tofray::ErrorKind::device, error.what());   // no GPU here
  }
}

void own_arrays(tofray::Simulator& simulator, const tofray::Camera& camera, const tofray::Frame& frame) {
  tofray::Frame again;
  tofray::Geometry seen;
  seen.width = camera.sensor.width, seen.height = camera.sensor.height;
  seen.z_m = frame.truth.z_m, seen.normal = frame.truth.normal, seen.diffuse = frame.truth.reflectivity;
  simulator.frame(0, seen, again);
  expect(simulator.frame(0, seen).raw.raw == again.raw.raw, "geometry");
  tofray::PixelLight light;
  light.width = seen.width, light.height = seen.height;
  light.power_w = frame.truth.power_w, light.path_length_m.assign(light.power_w.size(), 2.0f);
  simulator.frame(0, light, again);
  expect(simulator.frame(0, light).raw.raw == again.raw.raw, "light");
  expect(tofray::pixel_rays(camera).size() == 2 * light.power_w.size(), "pixel_rays");
}

void all() {
  const tofray::Scene scene = tofray::load_scene("card");
  const tofray::Camera camera = tofray::load_camera(scene);
  expect(tofray::load_camera("pico-flexx").sensor.width == 224, "load_camera");
  tofray::Simulator first(scene, camera), simulator(std::move(first));
  first = tofray::Simulator(scene, camera);
  tofray::Frame frame = simulator.frame(0);
  simulator.frame(1, frame);
  int taken = 0;
  const auto take = [&](const tofray::FrameArrays&) { ++taken; };
  const tofray::FrameRequest requests[] = {{3, {}, {}}};
  simulator.frames(0, 2, take);
  simulator.frames(requests, take);
  expect(taken == 3, "frames");
  expect(tofray::process(frame.raw, camera).z_m.size() == frame.depth.z_m.size(), "process");
  const tofray::RanOn machine = simulator.ran_on();
  expect(!machine.backend.empty() && !machine.device.empty() && !machine.isa.empty() && machine.threads > 0, "ran_on");
  on_device(simulator);
  own_arrays(simulator, camera, frame);
}

}  // namespace

int main() try {
  all();
  return 0;
} catch (const std::exception& fault) {
  std::fprintf(stderr, "%s\n", fault.what());
  return 1;
}
