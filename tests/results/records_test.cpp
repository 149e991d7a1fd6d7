// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <clocale>
#include <cmath>
#include <cstring>
#include <locale>

#include "base/version.h"
#include "files/json.h"
#include "files/npz.h"
#include "files/output_folder.h"
#include "files/sha256.h"
#include "pictures/pictures.h"
#include "pictures/terminal_picture.h"
#include "results/frame_file.h"
#include "results/manifest.h"
#include "results/meta.h"
#include "results/ply.h"
#include "support/samples.h"

using namespace tofray;
using namespace tofray::files;
using namespace tofray::results;
using namespace tofray::pictures;
using out_test::error_of;
using out_test::Python;
using out_test::TemporaryFolder;

namespace {

Scene sample_scene() {
  Scene scene;
  scene.name = "box";
  scene.source = "/home/somebody/box.yaml";
  scene.ambient.spectrum = Ambient::Spectrum::sun_am15;
  scene.ambient.amount = 0.05;
  scene.ambient.direction = Vec3{0, 1, 0.1};
  scene.materials = {{"paper", Material::Brdf::lambert, 0.85, 0, 1}, {"paint", Material::Brdf::phong, 0.4, 0.3, 20}};
  scene.objects = {{"wall", Plane{{0, 0, 2}, {0, 0, -1}}, 0, {}, {}, {}},
                   {"ball", Sphere{{0.1, 0, 1.3}, 0.25}, 1, {0, 0, 0.1}, {}, {0, 0, -1}},
                   {"crate", Box{{-0.6, -0.1, 1.2}, {-0.3, 0.3, 1.5}}, 1, {}, {{0, 1, 0}, 0.5}, {}},
                   {"sail", Triangle{{{{0.4, 0.3, 1.6}, {0.8, 0.3, 1.6}, {0.6, -0.2, 1.7}}}}, 0, {}, {}, {}}};
  return scene;
}

Manifest sample_manifest() {
  Manifest manifest;
  manifest.tofray_version = base::version();
  manifest.command = {"tofray", "render", "box.yaml", "--seed", "7", "-o", "out \xC3\xA9"};
  manifest.inputs = {{"scene", "box.yaml", "# a box: \"quoted\"\n\tobjects: []\n"}, {"profile", "pico-flexx", ""}};
  manifest.set = {{"camera.lens.f_number", "1.2"}};
  manifest.options = {{"noise", "exact"}, {"emit", "npz,png"}};
  manifest.seed = 18446744073709551615ULL;
  manifest.backend = "cuda";
  manifest.gpu = "NVIDIA H200";
  manifest.cpu_model = cpu_model();
  manifest.isa = "avx2";
  manifest.threads = 4;
  manifest.timings_s = {{"trace", 0.0123}, {"raw", 1e-9}};
  manifest.files = {{"frame.npz", 5000000000ULL, sha256_hex("abc")}};
  return manifest;
}

}  // namespace

TEST(cpu_model, is_the_first_processor_s_by_its_name_or_by_its_numbers) {
  EXPECT_EQ(cpu_model_in("processor\t: 0\nmodel\t\t: 17\nmodel name\t: A CPU @ 2.10GHz: fast\nprocessor\t: 1\nmodel name\t: Another\n"),
            "A CPU @ 2.10GHz: fast");
  EXPECT_EQ(cpu_model_in("processor\t: 0\nBogoMIPS\t: 50.00\nCPU implementer\t: 0x41\nCPU architecture: 8\nCPU variant\t: 0x3\n"
                         "CPU part\t: 0xd0c\nprocessor\t: 1\nCPU implementer\t: 0x42\nCPU part\t: 0xd0d\n"),
            "ARM, implementer 0x41, part 0xd0c");
  for (const char* text : {"", "\n", "model name", "model name\t", "processor: 0\nCPU part\t: 0xd0c", "x model name\t: no"})
    EXPECT_EQ(cpu_model_in(text), "unknown") << text;
}

TEST(meta, says_what_made_the_frame_and_nothing_of_where) {
  const Scene scene = sample_scene();
  const Camera camera = out_test::sample_camera(24, 16);
  const std::string text = frame_meta(scene, camera, {.seed = 18446744073709551615ULL, .noise = Noise::off}, 3);
  EXPECT_EQ(text, frame_meta(scene, camera, {.seed = 18446744073709551615ULL, .noise = Noise::off}, 3));
  Scene elsewhere = scene;
  elsewhere.source = "C:/other/box.yaml";
  EXPECT_EQ(text, frame_meta(elsewhere, camera, {.seed = 18446744073709551615ULL, .noise = Noise::off}, 3));
  const Json meta = parse_json(text, "meta");
  std::uint64_t seed = 0;
  EXPECT_TRUE(meta.find("seed")->unsigned_integer(seed));
  EXPECT_EQ(seed, 18446744073709551615ULL);
  EXPECT_EQ(*meta.find("noise")->string(), "off");
  EXPECT_EQ(*meta.find("tofray")->string(), base::version());
  EXPECT_EQ(meta.find("scene")->find("objects")->items()->size(), 4U);
  EXPECT_EQ(meta.find("camera")->find("mode")->find("sequence")->items()->size(), 9U);
}

TEST(meta, has_a_unit_for_every_array_of_the_file) {
  const Camera camera = out_test::sample_camera(6, 4);
  const std::string text = frame_meta(sample_scene(), camera, {.seed = 1}, 0);
  const Json units = *parse_json(text, "meta").find("units");
  const auto arrays = parse_npz(frame_npz_bytes(out_test::sample_frame(6, 4), camera, {}, text), "memory");
  for (const NamedArray& entry : arrays) {
    if (entry.name == "meta")
      EXPECT_EQ(entry.array.text(), text);
    else
      EXPECT_NE(units.find(entry.name), nullptr) << entry.name;
  }
  EXPECT_EQ(units.members()->size() + 1, arrays.size());
}

TEST(manifest, comes_back_as_it_was_written) {
  TemporaryFolder folder;
  const Manifest manifest = sample_manifest();
  out_test::write_file(folder.file("manifest.json"), manifest_text(manifest));
  const Manifest back = read_manifest(folder.file("manifest.json"));
  EXPECT_EQ(manifest_text(back), manifest_text(manifest));
  EXPECT_EQ(back.seed, manifest.seed);
  EXPECT_EQ(back.inputs[0].text, manifest.inputs[0].text);
  EXPECT_EQ(back.set, manifest.set);
  EXPECT_EQ(back.options, manifest.options);
  EXPECT_EQ(back.files[0].bytes, 5000000000ULL);
  EXPECT_FALSE(back.cpu_model.empty());
  EXPECT_EQ(back.backend, "cuda");
  EXPECT_EQ(back.gpu, "NVIDIA H200");
}

TEST(manifest, takes_as_many_threads_as_anybody_has) {
  TemporaryFolder folder;
  const std::string path = folder.file("m.json");
  Manifest manifest = sample_manifest();
  manifest.threads = 1'000'000;
  out_test::write_file(path, manifest_text(manifest));
  EXPECT_EQ(read_manifest(path).threads, 1'000'000);
  manifest.threads = 1'000'001;
  out_test::write_file(path, manifest_text(manifest));
  EXPECT_NE(std::string(error_of([&] { (void)read_manifest(path); }).what()).find("threads is missing or malformed"), std::string::npos);
}

TEST(manifest, every_missing_or_malformed_key_is_named_at_once) {
  TemporaryFolder folder;
  const std::string path = folder.file("m.json");
  out_test::write_file(
      path,
      R"({"tofray": 3, "command": ["a", 1], "inputs": [{"role": "scene", "name": "x"}], "set": [["a"]], "seed": -1, "device": {}, "files": {}})");
  const std::string text = error_of([&] { (void)read_manifest(path); }).what();
  for (const char* part : {"tofray is missing or malformed", "command is", "inputs[0].text is", "set is", "options is", "seed is",
                           "backend is", "device.cpu is", "threads is", "timings_s is", "files is"})
    EXPECT_NE(text.find(path + ": error: " + part), std::string::npos) << part << "\nin\n" << text;
  EXPECT_EQ(error_of([&] { (void)read_manifest(folder.file("none.json")); }).kind(), ErrorKind::io);
  EXPECT_EQ(error_of([&] { (void)read_manifest(folder.path().string()); }).kind(), ErrorKind::io);
}

TEST(manifest, mutated_files_give_errors_and_never_more) {
  TemporaryFolder folder;
  const std::string good = manifest_text(sample_manifest());
  out_test::Random random(17);
  int refused = 0;
  for (int trial = 0; trial < 600; ++trial) {
    std::string file = good;
    if (random.below(4) == 0) file.resize(random.below(file.size()));
    for (std::size_t changes = 1 + random.below(4); changes-- > 0 && !file.empty();)
      file[random.below(file.size())] = random.below(2) == 0 ? "{}[],:\"0-"[random.below(9)] : static_cast<char>(random.next());
    out_test::write_file(folder.file("m.json"), file);
    try {
      (void)read_manifest(folder.file("m.json"));
    } catch (const Error& error) {
      EXPECT_TRUE(error.kind() == ErrorKind::bad_input || error.kind() == ErrorKind::limit) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 300);
}

TEST(output, has_the_same_bytes_under_any_locale_and_umask) {
  // a comma as decimal sign, points between thousands: for C++ streams and, where the system has such a locale, for C
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const Frame frame = out_test::sample_frame(24, 16);
  const Camera camera = out_test::sample_camera(24, 16);
  const auto everything = [&] {
    const std::string meta = frame_meta(sample_scene(), camera, {.seed = 7}, 0);
    return frame_npz_bytes(frame, camera, {}, meta) + preview_png(frame.depth, frame.truth, frame.raw, "x") + raw_png(frame.raw) +
           cloud_ply(frame.depth) + terminal_picture(frame.depth, 24, TerminalColors::full) + manifest_text(sample_manifest());
  };
  const std::string plain = everything();
  const std::string before = std::setlocale(LC_ALL, nullptr);
  const std::locale classic = std::locale::global(std::locale(std::locale::classic(), new Comma));
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
    std::setlocale(LC_ALL, name);
    EXPECT_TRUE(everything() == plain) << name;
    EXPECT_EQ(manifest_text(sample_manifest()).find("0,0123"), std::string::npos);
  }
  std::locale::global(classic);
  std::setlocale(LC_ALL, before.c_str());
}
