// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Linked to libtofray_files, as a user's program is: the functions of dataset.h, depth_file.h, load.h, mcap.h, messages.h, profile_file.h, run.h, save.h, shards.h and sweep.h must be there (cmake/tofray_files.map shows them), those of
// libtofray come along, and what either of them throws is one type.
#include <tofray/tofray.h>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace {

void expect(bool held, const char* what) {
  if (!held) throw std::runtime_error(what);
}

/// What kind of Error a call ends with; bug: with none.
template <class Call>
tofray::ErrorKind kind_of(const Call& call) {
  try {
    call();
  } catch (const tofray::Error& error) {
    expect(!std::string(error.what()).empty(), "an Error says what is wrong");
    return error.kind();
  }
  return tofray::ErrorKind::bug;
}

void all() {
  const tofray::Scene scene = tofray::load_scene("card");
  const tofray::Camera camera = tofray::load_camera(scene);
  expect(tofray::load_camera("pico-flexx").sensor.width == 224, "load_camera");
  const tofray::Frame frame = tofray::Simulator(scene, camera).frame(0);
  expect(!frame.depth.z_m.empty(), "frame");
  expect(tofray::frame_npz(frame, scene, camera).starts_with("PK"), "frame_npz");
  expect(tofray::load_scene_text("objects: [{sphere: {center: [0, 0, 1], radius: 10 cm, reflectivity: 0.5}}]", "here").objects.size() == 1,
         "load_scene_text");
  expect(tofray::load_material("skin").diffuse > 0.5, "load_material");
  expect(tofray::choose_scene("card").name == "card" && tofray::choose_scene("card").note.empty(), "choose_scene");
  expect(tofray::choose_camera("mine.yaml").name == "mine.yaml", "choose_camera");
  expect(tofray::profile_file("pico-flexx").source == "<pico-flexx>", "profile_file");
  const tofray::Inputs inputs =
      tofray::load_inputs({.scene = "card", .set = {{"camera.sensor.width", "8"}, {"camera.sensor.height", "6"}}});
  expect(inputs.camera.sensor.width == 8 && inputs.remarks.empty() && inputs.files.size() == 1, "load_inputs");
  expect(tofray::Remark{true, "a.yaml", "odd", "mend it"}.text() == "a.yaml: warning: odd\n  mend it\n", "Remark::text");
  const tofray::Messages messages(scene, camera);
  expect(messages.of(frame).size() > 5 && messages.before(frame).size() == 1 && !messages.arrays().empty() &&
             messages.options().name == "camera",
         "Messages");
  expect(tofray::message_definition(messages.topics().front().type).starts_with("std_msgs/Header header\n"), "message_definition");
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("tofray_library_" + std::to_string(getpid()));
  tofray::RunRequest request;
  request.inputs = {.scene = "card", .set = {{"camera.sensor.width", "8"}, {"camera.sensor.height", "6"}}};
  request.folder = folder / "one";
  const tofray::RunResult one = tofray::render(request);
  expect(one.frames == 1 && one.files.back().name == "manifest.json" && one.last.pixels.pixels == 48, "render");
  expect(tofray::load_depth((folder / "one/frame.npz").native()).depth.z_m.size() == 48, "load_depth");
  expect(tofray::load_depths((folder / "one").native()).size() == 1, "load_depths");
  {
    tofray::McapWriter film(folder / "one.mcap", scene, camera, {.compression = tofray::usual_mcap_compression()});
    film.write(frame), film.write(frame, scene), film.write(frame, film.messages().of(frame));
    expect(film.close().name == "one.mcap", "McapWriter");
  }
  expect(tofray::mcap_contents((folder / "one.mcap").native()).complete, "mcap_contents");
  tofray::RunRequest again = tofray::request_of_manifest((folder / "one/manifest.json").native());
  again.folder = folder / "two";
  expect(tofray::render(again).files.front().sha256 == one.files.front().sha256, "request_of_manifest");
  std::ofstream(folder / "set.yaml") << "{name: t, samples: 3, scene: {objects: [{sphere: {name: b, center: [0, 0, 1], "
                                        "radius: {uniform: [1 cm, 9 cm]}, reflectivity: 0.5}}]}}";
  const tofray::Dataset set((folder / "set.yaml").native());
  expect(set.license().empty() && set.name() == "t" && set.samples() == 3 && set.views() == 1 && set.combinations() == 1, "Dataset");
  expect(set.scene_yaml(1).find("radius: " + set.drawn(1).at(0).text) != std::string::npos, "Dataset::scene_yaml, drawn");
  expect(set.scene(1).objects.size() == 1 && set.noise_seed(1) != set.noise_seed(2) && set.split(1) == "train",
         "Dataset::scene, noise_seed, split");
  const tofray::DatasetPlan plan =
      tofray::plan_dataset({.set = (folder / "set.yaml").native(), .folder = folder / "set", .pilot = 1, .shard_samples = 2});
  expect(plan.shards == 2 && tofray::read_plan(folder / "set").id == plan.id, "plan_dataset, read_plan");
  expect(tofray::run_shards({.folder = folder / "set"}).made == 2 && tofray::dataset_status(folder / "set").complete == 2,
         "run_shards, dataset_status");
  expect(tofray::verify_shards({.folder = folder / "set"}).faults.empty() && tofray::merge_shards(folder / "set").samples == 3,
         "verify_shards, merge_shards");
  tofray::SweepRequest swept;
  swept.inputs = request.inputs;
  swept.axes = {tofray::sweep_axis("pixel.read_noise=10e:60e:3", swept.inputs), tofray::sweep_axis("adc.bits", {"12"}, swept.inputs),
                tofray::sweep_axis_of_numbers("lens.f_number", {1.5}, swept.inputs)};
  const tofray::Sweep sweep = tofray::sweep(swept);
  expect(sweep.cells() == 3 && sweep.place(2, 0) == 2 && sweep.value(0, 0, 0) == sweep.values[0], "sweep, sweep_axis, Sweep");
  expect(tofray::sweep_metrics().size() == sweep.metrics.size(), "sweep_metrics");
  expect(tofray::save_sweep(sweep, swept, (folder / "sweep").native()).size() == 3, "save_sweep");
  expect(tofray::best_cells(sweep, "sigma").size() == 1, "best_cells");
  std::filesystem::remove_all(folder);
  using tofray::ErrorKind;
  expect(kind_of([] { (void)tofray::load_scene("no such scene"); }) == ErrorKind::io, "a scene that is not there");
  const tofray::CameraOptions wrong{.set = {{"lens.f_number", "far"}}};
  expect(kind_of([&] { (void)tofray::load_camera("pico-flexx", wrong); }) == ErrorKind::bad_input, "a wrong value");
  expect(kind_of([] { (void)tofray::load_camera_text("sensor: 1", "here"); }) == ErrorKind::bad_input, "load_camera_text");
  expect(kind_of([&] { const tofray::Simulator simulator(scene, {}); }) == ErrorKind::bad_input, "a camera without pixels");
}

}  // namespace

int main() try {
  all();
  return 0;
} catch (const std::exception& fault) {
  std::fprintf(stderr, "%s\n", fault.what());
  return 1;
}
