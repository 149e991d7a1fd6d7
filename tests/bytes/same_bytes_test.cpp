// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The same version, scene, camera, options and seed give the same bytes: whatever the instruction set, the number of threads, the compiler,
// the level of optimisation, and the C library's choice of its own functions. golden_hashes.txt holds SHA-256 of each array of a frame;
// `tests/bytes/golden_hashes.sh` writes it anew when numbers change on purpose, which CHANGELOG.md then has to say.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "backend/cpu/cpu.h"
#include "files/sha256.h"
#include "results/frame_file.h"
#include "support/every_array.h"
#include "support/files.h"
#include "support/quarter.h"
#include "support/random_scene.h"
#include "support/whole_pixel.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

const std::string golden_path = TOFRAY_SOURCE_DIR "/tests/bytes/golden_hashes.txt";

/// "scene kind" → array → its SHA-256, of which the first 16 digits will do.
using Hashes = std::map<std::string, std::string>;

std::map<std::string, Hashes> golden() {
  std::map<std::string, Hashes> out;
  std::ifstream file(golden_path);
  for (std::string scene, kind, array, hash; file >> scene >> kind >> array >> hash;) out[scene + " " + kind][array] = hash;
  return out;
}

Hashes hashes_of(const std::string& npz) {
  Hashes out;
  for (const files::NamedArray& one : files::parse_npz(npz, "memory")) {
    if (one.name != "meta") out[one.name] = files::sha256_hex(one.array.bytes).substr(0, 16);
  }
  return out;
}

std::string bytes_of(const Scene& scene, const Camera& camera, const SimulatorOptions& options) {
  constexpr results::PoseMatrix pose{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  return results::frame_npz_bytes(Simulator(scene, camera, options).frame(1), camera, pose, "{}");
}

/// What no scene of tofray's has: things that turn and follow keyframes, a mesh, a camera that moves and a sun, three times in each exposure.
constexpr const char* in_motion = "in-motion";
Scene scene_in_motion() {
  Random random(4);
  Scene scene = wall(2, 0.5);
  scene.camera.mode = "MODE_5_35FPS_600";
  scene.camera.keyframes = {{0, {{-0.1, 0, 0}, {0, 0, 1.5}, {0, -1, 0}}}, {0.05, {{0.2, 0.05, 0.1}, {0.1, 0, 1.5}, {0.1, -1, 0}}}};
  scene.ambient = {Ambient::Spectrum::sun_am15, Ambient::Quantity::level, 0.1, {}, {}, Vec3{0.3, 0.4, 1}};
  scene.objects.push_back(object(Box{{-0.5, -0.2, 1}, {-0.2, 0.1, 1.3}}));
  scene.objects[1].angular_velocity_rad_per_s = {3, 20, -5};
  scene.objects.push_back(object(shared(single(stone(random, 2, 0.25, {0, 0, 0})))));
  scene.objects[2].keyframes = {{0, {0.2, -0.1, 1.2}, {{1, 0, 0}, 0.3}}, {0.06, {0.3, 0.1, 1.3}, {{0, 1, 0.2}, 1.7}}};
  scene.objects.push_back(object(Cone{{0, 0.35, 1.2}, {0, -1, 0}, 0.1, 0.3}));
  scene.objects[3].velocity_m_per_s = {-2, 0, 0.5}, scene.objects[3].angular_velocity_rad_per_s = {0, 0, 12};
  return scene;
}

Scene scene_of(const std::string& name) {
  Scene scene = name == in_motion ? scene_in_motion() : load_scene(name);
  scene.transport.samples = 2;  // more of them take their time, and go the same ways
  return scene;
}
/// What known hashes are of: a quarter of the pixels. (One scene keeps its whole tiles.)
Camera known_camera(const Scene& scene) {
  const Camera camera = load_camera(scene);
  return scene.name == "bench-primitives" ? camera : quarter(camera);
}
std::vector<std::string> all_scenes() {
  std::vector<std::string> names = scene_names();
  names.emplace_back(in_motion);
  return names;
}
SimulatorOptions options_of(const std::string& scene, Noise noise, int threads, Isa isa) {
  return {.seed = 7,
          .noise = noise,
          .threads = threads,
          .isa = isa,
          .arrays = every_array(),
          .exposure_samples = scene == in_motion ? 3 : 1,
          .subpixel = scene == "thin-rods" ? 3 : 1};
}

/// Without noise, with it, and with so little read noise that it is drawn apart from shot noise.
struct Kind {
  const char* name;
  Noise noise;
  bool quiet = false;
};
constexpr Kind kinds[] = {{"off", Noise::off}, {"exact", Noise::exact}, {"quiet", Noise::exact, true}};

/// The reference has one thread. More numbers for the fastest instruction set: which thread takes which tile does not depend on it.
std::vector<int> thread_numbers(Isa isa) {
  if (isa == backend::choose_isa(Isa::best)) return {1, 2, 7, 64};
  return {7};
}

class SameBytes : public testing::TestWithParam<std::string> {};
class KnownBytes : public testing::TestWithParam<std::string> {};

/// Where golden_hashes.sh asks for it, the scalar reference's hashes are written in place of a comparison.
void expect_known(const std::string& scene_name, Isa isa) {
  const Scene scene = scene_of(scene_name);
  Camera camera = known_camera(scene);
  const std::map<std::string, Hashes> known = golden();
  const char* write_to = isa == Isa::scalar ? std::getenv("TOFRAY_WRITE_GOLDEN") : nullptr;
  for (const auto& [name, noise, quiet] : kinds) {
    if (quiet) camera.pixel.read_noise_e = 3;
    const std::string key = scene_name + " " + name;
    const Hashes hashes = hashes_of(bytes_of(scene, camera, options_of(scene_name, noise, 2, isa)));
    if (write_to != nullptr) {
      for (const auto& [array, hash] : hashes) std::ofstream(write_to, std::ios::app) << key << " " << array << " " << hash << "\n";
      continue;
    }
    ASSERT_TRUE(known.count(key)) << golden_path << " does not have " << key;
    EXPECT_EQ(hashes, known.at(key)) << key << " by " << backend::isa_name(isa)
                                     << ": numbers have changed. If on purpose: tests/bytes/golden_hashes.sh, and a line in CHANGELOG.md";
  }
}

}  // namespace

TEST_P(SameBytes, on_every_machine_and_with_any_number_of_threads) {
  const Scene scene = scene_of(GetParam());
  Camera camera = load_camera(scene);
  for (const auto& [name, noise, quiet] : kinds) {
    if (quiet) camera.pixel.read_noise_e = 3;
    const std::string reference = bytes_of(scene, camera, options_of(GetParam(), noise, 1, Isa::scalar));
    for (const Isa isa : backend::isas_here) {
      if (!backend::can_run(isa)) continue;  // named by skipped_on_this_machine
      for (const int threads : thread_numbers(isa)) {
        const std::string bytes = bytes_of(scene, camera, options_of(GetParam(), noise, threads, isa));
        EXPECT_TRUE(bytes == reference) << name << ", " << backend::isa_name(isa) << " with " << threads << " threads";
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(all, SameBytes, testing::ValuesIn(all_scenes()), [](const auto& which) { return test_name(which.param); });

// In tests of their own, so that they can be run for each scene under whatever surroundings.
TEST_P(KnownBytes, come_from_the_fastest_machine_code) { expect_known(GetParam(), Isa::best); }
TEST_P(KnownBytes, come_from_the_scalar_reference) { expect_known(GetParam(), Isa::scalar); }
TEST_P(KnownBytes, come_from_what_lies_between) {
  for (const Isa isa : backend::machine_isas)
    if (backend::can_run(isa) && isa != backend::choose_isa(Isa::best)) expect_known(GetParam(), isa);
}

INSTANTIATE_TEST_SUITE_P(all, KnownBytes, testing::ValuesIn(all_scenes()), [](const auto& which) { return test_name(which.param); });

// Filters, all effects of the pixel and a second light, which no scene has.
TEST(same_bytes, with_everything_switched_on) {
  const Scene scene = load_scene("demo");
  Camera camera = load_camera(scene);
  turn_on_every_effect(camera);
  camera.illumination.push_back(camera.illumination[0]);
  camera.illumination[1].position = {-0.02, 0.01, 0.003}, camera.illumination[1].axis = {0.1, -0.2, 1};
  camera.illumination[1].waveform.jitter_s = 3e-10;
  camera.sensor.width = 219, camera.sensor.height = 163;  // no whole tiles
  for (const auto kind :
       {ImageFilter::Kind::gaussian, ImageFilter::Kind::median, ImageFilter::Kind::bilateral, ImageFilter::Kind::adaptive}) {
    camera.decoding.filter.kind = kind;
    for (const PowerModel model : {PowerModel::tofray, PowerModel::paper_literal}) {
      camera.power_model = model;
      const std::string reference = bytes_of(scene, camera, {.threads = 1, .isa = Isa::scalar});
      for (const Isa isa : backend::machine_isas) {
        if (!backend::can_run(isa)) continue;
        EXPECT_TRUE(bytes_of(scene, camera, {.threads = 3, .isa = isa}) == reference) << backend::isa_name(isa);
        EXPECT_TRUE(bytes_of(scene, camera, {.threads = 2, .isa = isa, .culling = false}) == reference)
            << backend::isa_name(isa) << " without culling";
      }
    }
  }
}

TEST(same_bytes, change_with_the_seed_and_the_frame) {
  const Scene scene = load_scene("card");
  const Camera camera = load_camera(scene);
  Simulator simulator(scene, camera, {.seed = 7});
  const Frame one = simulator.frame(0);
  EXPECT_NE(one.raw.raw, simulator.frame(1).raw.raw);
  EXPECT_NE(one.raw.raw, Simulator(scene, camera, {.seed = 8}).frame(0).raw.raw);
  EXPECT_NE(one.raw.raw, Simulator(scene, camera, {.seed = 7 + (1ull << 32)}).frame(0).raw.raw);
  EXPECT_NE(one.raw.raw, simulator.frame(1ull << 32).raw.raw);
  EXPECT_EQ(one.raw.raw, Simulator(scene, camera, {.seed = 7}).frame(0).raw.raw);
}

class SkippedOnThisMachine : public testing::TestWithParam<Isa> {};

TEST_P(SkippedOnThisMachine, is_what_it_cannot_run) {
  if (!backend::can_run(GetParam())) GTEST_SKIP() << backend::isa_name(GetParam()) << " does not run here: its bytes were not compared";
  EXPECT_EQ(Simulator(load_scene("card"), load_camera(load_scene("card")), {.isa = GetParam()}).ran_on().isa,
            backend::isa_name(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(same_bytes, SkippedOnThisMachine, testing::ValuesIn(backend::every_isa),
                         [](const auto& which) { return backend::isa_name(which.param); });
