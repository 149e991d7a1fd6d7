// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Linked to libtofray alone, as a user's program is that reads no files: every function of the public headers but depth_file.h, load.h, save.h, run.h and sweep.h must be there
// (cmake/tofray.map shows them).
#include <tofray/tofray.h>

#include <cstdio>
#include <stdexcept>
#include <vector>

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
    expect(error.kind() == tofray::ErrorKind::device, error.what());  // no GPU here
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
  const tofray::Transient by_length{seen.width, seen.height, 2, 1, 0.5, std::vector<float>(2 * seen.z_m.size(), 1e5f), {}};
  simulator.frame(0, by_length, again);
  expect(simulator.frame(0, by_length).raw.raw == again.raw.raw, "light by path length");
  expect(tofray::pixel_rays(camera).size() == 2 * light.power_w.size(), "pixel_rays");
  const tofray::ImageSize image = tofray::image_size(camera);
  expect(image.width == seen.width && image.height == seen.height, "image_size");
}

void pictures(const tofray::Camera& camera) {
  const tofray::Pinhole pinhole = tofray::pinhole_for(camera);
  const std::vector<float> z(static_cast<std::size_t>(pinhole.width) * static_cast<std::size_t>(pinhole.height), 1.5f);
  tofray::RenderedPictures drawn;
  drawn.pinhole = pinhole, drawn.z_m = z, drawn.other_reflectivity = 0.5;
  expect(tofray::from_pictures(camera, drawn).geometry.z_m.front() == 1.5f, "pinhole_for, from_pictures");
}

tofray::Scene wall() {
  tofray::Scene scene;
  tofray::Material paper;
  paper.diffuse = 0.8;
  scene.materials.push_back(paper);
  tofray::Object object;
  object.shape = tofray::Plane{{0, 0, 1}, {0, 0, -1}};
  scene.objects.push_back(object);
  return scene;
}

tofray::Camera small_camera() {
  tofray::Camera camera;
  camera.sensor = {32, 24, 12e-6, 1};
  camera.lens.fx_px = camera.lens.fy_px = 30;
  camera.lens.cx_px = 15.5, camera.lens.cy_px = 11.5;
  camera.illumination.emplace_back().power_w = 0.2;
  camera.pixel.quantum_efficiency = {{850e-9}, {0.3}};
  camera.pixel.contrast = {{0}, {0.8}};
  camera.mode.frame_rate_hz = 5;
  for (int k = 0; k < 4; ++k) camera.mode.sequence.push_back({true, 60e6, k * 1.5707963267948966, 1e-3});
  return camera;
}

void budgets(const tofray::Camera& camera) {
  expect(tofray::budget(camera).size() == 8, "budget");
  expect(tofray::budget_summary(camera).ambiguity_range_m > 2, "budget_summary");
  const auto with_power = [&](double power) {
    tofray::Camera out = camera;
    out.illumination[0].power_w = power;
    return out;
  };
  expect(tofray::solve_budget(with_power, 1, 1e-3, 1e3, {0.01, 1, 0.5, {}}).value > 0, "solve_budget");
}

void pixels(const tofray::Frame& frame, const tofray::Scene& scene, const tofray::Camera& camera) {
  const tofray::PixelArrays arrays = tofray::pixel_arrays(frame);
  expect(arrays.width == 32 && arrays.phases == 4, "pixel_arrays");
  expect(tofray::pixel_chain(frame, camera, 3, 4).range_m == tofray::pixel_chain(arrays, &camera, false, 3, 4).range_m, "pixel_chain");
  expect(tofray::correlation_curves(tofray::pixel_chain(frame, camera, 3, 4), camera, 8)[0].size() == 8, "correlation_curves");
  expect(tofray::error_causes(scene, camera, {}, frame.index, {3, 4, 3, 4}).causes[0].cause == "noise", "error_causes");
  tofray::ErrorCauses first(scene, camera, {}, frame.index, {3, 4, 4, 4}), causes(std::move(first));
  while (causes.step()) {}
  expect(causes.result().valid == 2, "ErrorCauses");
  expect(!tofray::has_bounces(arrays, 3, 4), "has_bounces");
  expect(tofray::object_places(scene, 0).size() == scene.objects.size(), "object_places");
  expect(tofray::pixel_bounces(arrays, frame.index, scene, camera, {}, 3, 4).shares.empty(), "pixel_bounces");
  expect(tofray::validity(frame, camera).pixels.pixels == tofray::invalid_pixels(frame, camera).pixels, "validity, invalid_pixels");
}

void measured(const tofray::Frame& frame) {
  const tofray::Depth truth = tofray::depth_of(frame.truth);
  expect(tofray::quality({frame.depth}, {}, &truth).fill_rate_percent > 90, "quality, depth_of");
  expect(tofray::quality_presets().front().name == "realsense", "quality_presets");
  expect(tofray::compare(frame.depth, truth).all.pixels > 700, "compare");
}

void refusal() {
  try {
    const tofray::Simulator simulator({}, tofray::Camera());
  } catch (const tofray::Error& error) {
    return expect(error.kind() == tofray::ErrorKind::bad_input && error.what()[0] != 0, "kind of an Error");
  }
  expect(false, "a camera without pixels is refused");
}

void all() {
  const tofray::Scene scene = wall();
  const tofray::Camera camera = small_camera();
  tofray::Simulator first(scene, camera), simulator(std::move(first));
  first = tofray::Simulator(scene, camera);
  expect(!simulator.plan().empty(), "a frame has a plan");
  tofray::Frame frame = simulator.frame(0);
  simulator.frame(1, frame);
  int taken = 0;
  const auto take = [&](const tofray::FrameArrays&) { ++taken; };
  const tofray::FrameRequest requests[] = {{3, {}, {}}};
  simulator.frames(0, 2, take);
  simulator.frames(requests, take);
  simulator.frame(requests[0], frame);
  expect(frame.index == 3, "frame of a request");
  tofray::FrameRequest placed;
  placed.objects.push_back({"objects.0", {{0, 0, 0.1}, {}}, {}, {}});
  expect(tofray::placed_scene(scene, camera, placed).objects[0].keyframes.size() == 1, "placed_scene");
  expect(tofray::exposure_times(camera, 2)[0] == 2 + 0.5e-3, "exposure_times");
  expect(taken == 3, "frames");
  tofray::KeptFrames other(scene, camera), kept(std::move(other));
  tofray::KeptLight light;
  tofray::KeptRaw raw;
  kept.frame_to(0, light, frame), kept.keep(raw);
  expect(light.filled() && raw.filled() && kept.can_keep_light() && kept.can_keep_raw() && kept.stands_still(),
         "KeptFrames, KeptLight, KeptRaw");
  const std::vector<float> z = frame.depth.z_m;
  expect(kept.frame_from(0, light, frame) && frame.depth.z_m == z, "KeptFrames::frame_from light");
  kept.frame_from(0, raw, frame);
  expect(frame.depth.z_m == z, "KeptFrames::frame_from raw");
  kept.frame(0, frame);
  other = tofray::KeptFrames(scene, camera);
  expect(tofray::process(frame.raw, camera).z_m.size() == frame.depth.z_m.size(), "process");
  const tofray::RanOn machine = simulator.ran_on();
  expect(!machine.backend.empty() && !machine.device.empty() && !machine.isa.empty() && machine.threads > 0, "ran_on");
  const auto pose = tofray::camera_pose(scene, 0);
  expect(tofray::pose_matrix(tofray::pose_from_matrix(pose)) == pose, "pose_matrix, pose_from_matrix: there and back");
  expect(pose[0] == 1 && pose[10] == 1 && pose[15] == 1 && pose[3] == 0, "camera_pose: the world's frame is the camera's");
  expect(tofray::version()[0] != 0, "version");
  on_device(simulator);
  own_arrays(simulator, camera, frame);
  pictures(camera);
  budgets(camera);
  pixels(frame, scene, camera);
  measured(frame);
  refusal();
}

}  // namespace

int main() try {
  all();
  return 0;
} catch (const std::exception& fault) {
  std::fprintf(stderr, "%s\n", fault.what());
  return 1;
}
