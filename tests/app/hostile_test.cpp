// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Input of somebody who means harm: it ends soon, in little memory, with a short message that steers no terminal, and touches no other file.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cctype>
#include <cmath>

#include "base/limits.h"
#include "base/text.h"
#include "files/npz.h"
#include "support/sanitizers.h"
#include "tool.h"

namespace tofray::test {
namespace {

struct Attack : Result {
  long peak_bytes = 0;
  double processor_seconds = 0;
};

// What took more than 5 s takes less than one now; sanitizers and busy machines get ten.
constexpr rlim_t most_seconds = with_sanitizers ? 60 : 10;

/// Sanitizers keep books of all memory.
constexpr long most_memory(long bytes) { return with_sanitizers ? 100 * bytes : bytes; }

/// Runs the program in a folder: SIGXCPU ends one that computes on, SIGALRM one that waits for ever.
Attack attack(const Folder& folder, const Arguments& arguments, const Prepare& more = {}) {
  const Folder outputs;
  const auto prepare = [&] {
    in_folder(folder.path())();
    const rlimit limit{most_seconds, most_seconds};
    ::setrlimit(RLIMIT_CPU, &limit);
    ::alarm(120);
    if (more) more();
  };
  const pid_t child = start(arguments, outputs / "out", outputs / "err", prepare);
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {}
  Attack result;
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  result.out = content(outputs / "out");
  result.err = content(outputs / "err");
  result.peak_bytes = 1024 * usage.ru_maxrss;
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  result.processor_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  return result;
}

std::string repeated(int count, const std::function<std::string(int)>& piece) {
  std::string text;
  for (int i = 0; i < count; ++i) text += piece(i);
  return text;
}

/// No control character but the end of a line, and nothing that is not UTF-8.
bool is_printable(const std::string& text) {
  std::string joined = text;
  std::replace(joined.begin(), joined.end(), '\n', ' ');
  return base::printable(joined) == joined;
}

void expect_refused(const Attack& result, int code, const std::string& part) {
  EXPECT_EQ(result.code, code) << result.err.substr(0, 500);
  EXPECT_TRUE(has(result.err, part)) << result.err.substr(0, 2000);
  EXPECT_LE(result.err.size(), static_cast<std::size_t>(base::limit::message_bytes.value) + 300);
  EXPECT_TRUE(is_printable(result.err)) << result.err.substr(0, 2000);
}

const std::string wall = "objects: [{plane: {point: [0, 0, 1], normal: [0, 0, -1], reflectivity: 0.5}}]\n";
const std::string pico = content(fs::path(TOFRAY_SOURCE_DIR) / "profiles" / "pico-flexx.yaml");

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? std::string() : text.replace(at, from.size(), to);
}

TEST(hostile_yaml, a_dotted_key_of_400000_parts_is_over_a_limit_and_no_signal) {
  const Folder folder;
  const auto scene = [](int parts) {
    return "camera:\n  profile: pico-flexx\n  ? " + repeated(parts - 1, [](int) { return "lens."; }) + "b\n  : 1\n" + wall;
  };
  write(folder / "deep.yaml", scene(400'000));
  expect_refused(attack(folder, {"check", "deep.yaml"}), 4, "the key has too many parts");
  const auto most = static_cast<int>(base::limit::nesting_depth.value);
  write(folder / "deep.yaml", scene(most + 1));
  expect_refused(attack(folder, {"check", "deep.yaml"}), 4, "got 65, at most 64");
  write(folder / "deep.yaml", scene(most));
  expect_refused(attack(folder, {"check", "deep.yaml"}), 2, "unknown key \"lens\"");
}

TEST(hostile_yaml, aliases_and_anchors_take_no_more_memory_than_a_file_may_have) {
  const Folder folder;
  write(folder / "text.yaml", "x: &a " + std::string(8000, 'b') + "\nobjects: [" + repeated(390'000, [](int) { return "*a,"; }) + "]\n");
  // 60 anchors around the same values: each keeps them all.
  write(folder / "anchors.yaml", "x: " + repeated(60, [](int i) { return "&a" + std::to_string(i) + " ["; }) +
                                     repeated(300'000, [](int) { return "1,"; }) + std::string(60, ']') + "\n" + wall);
  for (const char* name : {"text.yaml", "anchors.yaml"}) {
    const Attack result = attack(folder, {"check", name});
    expect_refused(result, 4, name[0] == 't' ? "too much text" : "too many values");
    // 400,000 values of about 200 bytes, twice where a list grows; the file; the program. 3.2 GB and 4 GB without the limits.
    EXPECT_LT(result.peak_bytes, most_memory(400'000'000)) << name;
  }
}

TEST(hostile_yaml, a_name_is_at_most_as_long_as_the_limit_and_does_not_make_pictures_larger) {
  const Folder folder;
  const auto most = static_cast<std::size_t>(base::limit::text_bytes.value);
  for (const std::size_t length : {most, most + 1, std::size_t{100'000}}) {
    write(folder / "camera.yaml", changed(pico, "name: pico-flexx", "name: " + std::string(length, 'n')));
    write(folder / "scene.yaml", "camera: {profile: camera.yaml}\n" + wall);
    const Attack result = attack(folder, with_small_sensor({"render", "scene.yaml", "-o", "out"}));
    if (length > most) {
      expect_refused(result, 4, "name is too long");
      EXPECT_FALSE(fs::exists(folder / "out"));
      continue;
    }
    EXPECT_EQ(result.code, 0) << result.err;
    const std::string png = content(folder / "out" / "preview.png");
    fs::remove_all(folder / "out");
    ASSERT_GT(png.size(), 24U);
    const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(png[i])); };
    EXPECT_LT(byte(16) << 24 | byte(17) << 16 | byte(18) << 8 | byte(19), 1700U) << "pixels of its width";
  }
}

TEST(hostile_yaml, many_faults_and_many_keys_end_soon) {
  const Folder folder;
  const auto sphere = [](int i) { return "  - sphere: {center: [0, 0, 1], radius: 0.1, material: q" + std::to_string(i) + "}\n"; };
  const auto material = [](int i) { return "  m" + std::to_string(i) + std::string(50, 'x') + ": {brdf: lambert, reflectivity: 0.5}\n"; };
  write(folder / "overrides.yaml", "camera:\n  profile: pico-flexx\n" +
                                       repeated(often(40'000), [](int i) { return "  lens.k" + std::to_string(i) + ": 1\n"; }) + wall);
  write(folder / "strangers.yaml",
        "camera:\n  profile: pico-flexx\n" + repeated(often(40'000), [](int i) { return "  k" + std::to_string(i) + ": 1\n"; }) + wall);
  write(folder / "materials.yaml", "materials:\n" + repeated(often(10'000), material) + "objects:\n" + repeated(often(20'000), sphere));
  write(folder / "keys.yaml", repeated(often(190'000), [](int i) { return "k" + std::to_string(i) + ": 1\n"; }));
  expect_refused(attack(folder, {"check", "overrides.yaml"}), 4,
                 "too many keys are changed\n  got " + std::to_string(often(40'000)) + ", at most 1000");
  expect_refused(attack(folder, {"check", "strangers.yaml"}), 4, "too many keys are changed");
  expect_refused(attack(folder, {"check", "materials.yaml"}), 2, "it was not read to its end");
  expect_refused(attack(folder, {"check", "keys.yaml"}), 2, "it was not read to its end");
}

TEST(hostile_yaml, eight_flat_tops_of_4096_by_4096_cells_are_over_a_limit) {
  const Folder folder;
  for (const auto& [columns, rows, code] : {std::tuple{4096, 4096, 4}, {1024, 1025, 4}, {1024, 1024, 0}}) {
    const std::string profile =
        changed(changed(pico, "columns: 172", "columns: " + std::to_string(columns)), "rows: 168", "rows: " + std::to_string(rows));
    ASSERT_FALSE(profile.empty());
    write(folder / "camera.yaml", profile);
    const Attack result = attack(folder, {"check", "camera.yaml"});
    if (code == 0) {
      EXPECT_EQ(result.code, 0) << result.err;
    } else {
      expect_refused(result, 4, "the pattern has too many samples");
    }
  }
}

/// The profile with that many modes in place of its own.
std::string with_modes(const std::string& profile, int count) {
  const std::size_t modes = profile.find("\nmodes:\n");
  EXPECT_NE(modes, std::string::npos);
  return profile.substr(0, modes) + "\nmodes:\n" + repeated(count, [](int i) {
           return "  m" + std::to_string(i) +
                  ": {frame_rate: 5 Hz, sequence: [{modulation_frequency: 80 MHz, reference_phase: [0 deg, 90 deg, 180 deg, 270 deg], "
                  "integration_time: {value: 1 ms, source: x}}]}\n";
         });
}

// 0.2 s, without light sources whose set-up would take more; 8 s where the profile is read anew for each mode.
TEST(hostile_yaml, as_many_modes_as_there_may_be_are_read_once) {
  const Folder folder;
  write(folder / "camera.yaml", with_modes(pico, static_cast<int>(base::limit::modes.value)));
  const Attack result = attack(folder, {"check", "camera.yaml", "--set", "illumination=[]"});
  EXPECT_EQ(result.code, 0) << result.err.substr(0, 500);
  EXPECT_TRUE(has(result.out, "256 modes")) << result.out;
  EXPECT_LT(result.processor_seconds, with_sanitizers ? 20 : 2);
}

// Tables by pixel are those of the sensor, made once: fifteen more modes cost less than five more tables would.
TEST(hostile_yaml, megapixels_in_many_modes_cost_those_of_one) {
  const Folder folder;
  const std::string large = changed(changed(pico, "width: 224", "width: 2000"), "height: 172", "height: 1500");
  const auto seconds = [&](int count) {
    write(folder / "camera.yaml", with_modes(large, count));
    const Attack result = attack(folder, {"check", "camera.yaml"});
    EXPECT_EQ(result.code, 0) << result.err;
    return result.processor_seconds;
  };
  const double one = seconds(1), many = seconds(16);
  EXPECT_LT(many, 6 * one + 1);
}

TEST(hostile_message, what_is_quoted_is_cut) {
  const Folder folder;
  write(
      folder / "names.yaml",
      "materials:\n" +
          repeated(20, [](int i) { return "  m" + std::to_string(i) + std::string(900, 'x') + ": {brdf: lambert, reflectivity: 0.5}\n"; }) +
          "objects:\n" +
          repeated(60, [](int i) { return "  - sphere: {center: [0, 0, 1], radius: 0.1, material: q" + std::to_string(i) + "}\n"; }));
  write(folder / "duplicates.yaml", std::string(50'000, 'k') + ": 1\n" + std::string(50'000, 'k') + ": 1\n");
  for (const char* name : {"names.yaml", "duplicates.yaml"}) expect_refused(attack(folder, {"check", name}), 2, "error: ");
  expect_refused(attack(folder, {"render", std::string(50'000, 'f')}), 3, "error: ");
  expect_refused(attack(folder, {"render", "card", "--set", std::string(100'000, 'f') + "=1"}), 2, "error: ");
  expect_refused(attack(folder, {std::string(100'000, 'c')}), 2, "error: ");
  expect_refused(attack(folder, {"render", "--" + std::string(100'000, 'c')}), 2, "error: ");
}

// --- data files ---------------------------------------------------------------------------------------------------------------

/// A frame of 4 by 3 pixels whose `meta` says what it is told.
std::vector<files::NpyView> small_frame(const std::string& meta_bytes, const std::vector<std::uint16_t>& codes) {
  return {files::npy_view("raw", {1, 3, 4}, codes), {"meta", {'U', static_cast<int>(meta_bytes.size())}, {}, meta_bytes}};
}

TEST(hostile_npz, the_camera_of_meta_has_to_be_that_of_the_arrays) {
  const Folder folder;
  ASSERT_EQ(attack(folder, with_small_sensor({"render", "card", "-o", "out", "--emit", "npz"})).code, 0);
  auto arrays = files::read_npz((folder / "out" / "frame.npz").native());
  const auto meta = std::find_if(arrays.begin(), arrays.end(), [](const files::NamedArray& one) { return one.name == "meta"; });
  ASSERT_NE(meta, arrays.end());
  std::string text = meta->array.text();
  for (const char* key : {"\"width\":28", "\"height\":22"}) {
    ASSERT_TRUE(has(text, key));
    text = changed(text, key, has(key, "width") ? "\"width\":2" : "\"height\":2");
  }
  meta->array.bytes = files::utf32_of(text);
  std::vector<files::NpyView> views;
  for (const auto& one : arrays) {
    files::NpyType type = one.array.type;
    if (one.name == "meta") type.size = static_cast<int>(one.array.bytes.size());
    views.push_back({one.name, type, one.array.shape, one.array.bytes});
  }
  write(folder / "small.npz", files::npz_bytes(views));
  expect_refused(attack(folder, {"inspect", "small.npz", "--pixel", "27,21"}), 2, "got a sensor of 2 x 2 pixels with");
  EXPECT_EQ(attack(folder, {"inspect", "out/frame.npz", "--pixel", "27,21"}).code, 0);
}

TEST(hostile_npz, raw_frames_that_are_fewer_than_the_camera_s_are_bad_input_for_inspect) {
  const Folder folder;
  ASSERT_EQ(attack(folder, with_small_sensor({"demo", "-o", "out"})).code, 0);
  std::vector<files::NamedArray> arrays = files::parse_npz(content(folder / "out" / "frame.npz"), "frame.npz");
  std::vector<files::NpyView> views;
  for (auto& one : arrays) {
    if (!one.array.shape.empty() && one.array.shape[0] == 9) {
      one.array.bytes.resize(one.array.bytes.size() / 9 * 8);
      one.array.shape[0] = 8;
    }
    views.push_back({one.name, one.array.type, one.array.shape, one.array.bytes});
  }
  write(folder / "eight.npz", files::npz_bytes(views));
  expect_refused(attack(folder, {"inspect", "eight.npz", "--pixel", "7,5"}), 2, "with 9 raw frames, and arrays of 28 x 22 pixels with 8");
}

TEST(hostile_npz, flags_of_another_kind_are_bad_input) {
  const Folder folder;
  const std::vector<std::uint16_t> codes(12, 7);
  const std::string words = files::utf32_of("abc");
  const std::vector<double> numbers(12, -1e300);
  const std::vector<std::int64_t> negative(12, -5);
  write(folder / "text.npz", files::npz_bytes({files::npy_view("raw", {1, 3, 4}, codes), {"flags", {'U', 12}, {}, words}}));
  write(folder / "float.npz", files::npz_bytes({files::npy_view("raw", {1, 3, 4}, codes), files::npy_view("flags", {3, 4}, numbers)}));
  write(folder / "negative.npz", files::npz_bytes({files::npy_view("raw", {1, 3, 4}, codes), files::npy_view("flags", {3, 4}, negative)}));
  for (const char* name : {"text.npz", "float.npz"}) {
    expect_refused(attack(folder, {"inspect", name}), 2, "array \"flags\" has the wrong type");
    expect_refused(attack(folder, {"inspect", name, "--json"}), 2, "array \"flags\" has the wrong type");
    expect_refused(attack(folder, {"inspect", name, "--pixel", "1,1"}), 2, "array \"flags\" has the wrong type");
  }
  EXPECT_EQ(attack(folder, {"inspect", "negative.npz"}).code, 0);
  EXPECT_EQ(attack(folder, {"inspect", "negative.npz", "--pixel", "1,1"}).code, 0);
}

TEST(hostile_npz, raw_frames_that_no_camera_has_get_no_phases) {
  const Folder folder;
  const std::vector<std::uint16_t> codes(4 * 12, 7);
  const double nan = std::nan("");
  for (const double hz : {0.0, -80e6, 5e-324, 1e300, nan, static_cast<double>(INFINITY)}) {
    for (const double reference : {0.0, 1e300, nan}) {
      const std::vector<double> modulation(4, hz), phase(4, reference), time(4, hz);
      const std::vector<std::uint8_t> yes(4, 1);
      write(folder / "odd.npz",
            files::npz_bytes({files::npy_view("raw", {4, 3, 4}, codes), files::npy_view("lit", {4}, yes),
                              files::npy_view("modulation_frequency_hz", {4}, modulation),
                              files::npy_view("reference_phase_rad", {4}, phase), files::npy_view("integration_time_s", {4}, time)}));
      const Attack result = attack(folder, {"inspect", "odd.npz", "--pixel", "1,1"});
      EXPECT_EQ(result.code, 0) << hz << " Hz, reference phase " << reference << ": " << result.err;
      EXPECT_FALSE(has(result.out, "phase  ")) << result.out;
    }
  }
}

TEST(hostile_npz, statistics_take_no_eight_bytes_for_each) {
  const Folder folder;
  const std::vector<std::uint8_t> grey(64 << 20, 3);
  write(folder / "grey.npz", files::npz_bytes({files::npy_view("grey", {8192, 8192}, grey)}));
  const Attack result = attack(folder, {"inspect", "grey.npz"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has(result.out, "uint8"));
  // The file, its entry, the array, the statistics: four times; 12 times with a double for each.
  EXPECT_LT(result.peak_bytes, most_memory(6 * (64L << 20)));
}

TEST(hostile_npz, many_keys_in_meta_end_soon) {
  const Folder folder;
  const std::string meta = "{" + repeated(100'000, [](int i) { return "\"key" + std::to_string(i) + "\":1,"; }) + "\"end\":1}";
  write(folder / "meta.npz", files::npz_bytes(small_frame(files::utf32_of(meta), std::vector<std::uint16_t>(12, 7))));
  for (const Arguments& arguments : {Arguments{"inspect", "meta.npz"}, Arguments{"inspect", "meta.npz", "--json"}})
    EXPECT_EQ(attack(folder, arguments).code, 0);
  expect_refused(attack(folder, {"process", "meta.npz"}), 2, "meta does not say which camera made it");
}

TEST(hostile_npz, text_of_meta_steers_no_terminal) {
  const Folder folder;
  const std::string meta =
      R"({"tofray": "\u001b[2J", "seed": 1, "noise": "\u001b]0;owned\u0007", "frame": 0, "units": {"raw": "\u001b[31m"},
      "scene": {"name": "a\nb\u202e", "objects": [{"name": "\u009b31m"}]}, "camera": {"name": "\u001b[1m", "mode": {"name": "\r"}}})";
  const std::vector<std::int32_t> ids(12, 0);
  const std::vector<double> ranges(12, 1);
  const std::string bytes = files::utf32_of(meta);
  const std::vector<std::uint16_t> codes(12, 7);
  std::vector<files::NpyView> views = small_frame(bytes, codes);
  views.push_back(files::npy_view("gt_object_id", {3, 4}, ids));
  views.push_back(files::npy_view("gt_range_m", {3, 4}, ranges));
  views.push_back(files::npy_view("naXme", {3, 4}, ids));
  std::string archive = files::npz_bytes(views);
  for (std::size_t at = archive.find("naXme"); at != std::string::npos; at = archive.find("naXme", at)) archive[at + 2] = '\x1b';
  write(folder / "m\x1b[5meta.npz", archive);
  for (const Arguments& arguments : {Arguments{"inspect", "m\x1b[5meta.npz"}, Arguments{"inspect", "m\x1b[5meta.npz", "--pixel", "1,1"},
                                     Arguments{"process", "m\x1b[5meta.npz"}, Arguments{"inspect", "m\x1b[5meta.npz", "--json"}}) {
    const Attack result = attack(folder, arguments);
    EXPECT_TRUE(is_printable(result.out)) << result.out;
    EXPECT_TRUE(is_printable(result.err)) << result.err;
  }
}

// --- the terminal -------------------------------------------------------------------------------------------------------------

TEST(hostile_names, of_files_and_of_the_environment_steer_no_terminal) {
  const Folder folder;
  const std::string name = "a\x1b]0;owned\x07\xff\xc2\x9b.yaml";
  write(folder / name, "camera: {profile: pico-flexx}\n" + wall);
  write(folder / ("bad" + name), "objects: {");
  write(folder / "bytes.npz", "no zip");
  fs::copy_file(folder / "bytes.npz", folder / (name + ".npz"));
  fs::create_directory(folder / (name + ".d.npz"));
  const std::vector<Arguments> all = {with_small_sensor({"render", name}),
                                      {"check", name},
                                      {"check", "bad" + name},
                                      {"inspect", name + ".npz"},
                                      {"inspect", name + ".d.npz"},
                                      {"process", name + ".npz"},
                                      {"render", "missing" + name},
                                      {"render", "--from", name},
                                      {"render", "card", "-o", name},
                                      {"render", "card", "-o", name + "/below"},
                                      {"render", "card", "--set", name + "=1"},
                                      {"render", "card", "--mode", name},
                                      {name},
                                      {"render", "card", "--" + name},
                                      {"process", "bytes.npz", "--camera", name},
                                      {"render", "card", "--threads", name},
                                      {"schema", name},
                                      {"completion", name},
                                      {"list", name},
                                      {"help", name},
                                      {"inspect", "bytes.npz", "--pixel", name}};
  for (const Arguments& arguments : all) {
    const Attack result = attack(folder, arguments);
    EXPECT_TRUE(is_printable(result.out)) << arguments[0] << " " << arguments.back() << "\n" << result.out;
    EXPECT_TRUE(is_printable(result.err)) << arguments[0] << " " << arguments.back() << "\n" << result.err;
    EXPECT_NE(result.code, 70) << result.err;
  }
  const auto forced = [&] { ::setenv("TOFRAY_ISA", "\x1b[31m\xff", 1); };
  for (const Arguments& arguments : {Arguments{"render", "card"}, Arguments{"doctor"}, Arguments{"bench"}}) {
    const Attack result = attack(folder, arguments, forced);
    EXPECT_TRUE(is_printable(result.out) && is_printable(result.err)) << result.out << result.err;
  }
}

// --- manifests ----------------------------------------------------------------------------------------------------------------

std::string in_json(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\n' ? "\\n" : c == '"' ? "\\\"" : std::string(1, c);
  return "\"" + out + "\"";
}

std::string manifest(const std::string& inputs, const std::string& more = {}) {
  return "{\"tofray\": \"1\", \"command\": [], \"inputs\": [" + inputs +
         "], \"set\": [], \"options\": [[\"emit\", \"npz\"]], \"seed\": 0, \"backend\": \"cpu\", "
         "\"device\": {\"cpu\": \"x\", \"isa\": \"x\"}, \"threads\": 1, \"timings_s\": {}, \"files\": []" +
         more + "}";
}

std::string input(const std::string& role, const std::string& name, const std::string& text) {
  return "{\"role\": \"" + role + "\", \"name\": " + in_json(name) + ", \"text\": " + in_json(text) + "}";
}

TEST(hostile_manifest, a_scene_called_dot_dot_writes_neither_beside_nor_above_the_folder) {
  for (const char* name : {"..", ".", "...", "a/..", "/..", "../.."}) {
    const Folder folder;
    fs::create_directory(folder / "here");
    write(folder / "here" / "manifest.json", manifest(input("scene", name, wall)));
    const Attack result = attack(folder, {"render", "--from", "manifest.json"}, [&] { in_folder(folder / "here")(); });
    EXPECT_EQ(result.code, 0) << name << " " << result.err;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1) << name;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "here"), fs::directory_iterator()), 2) << name << ": the manifest and a folder";
  }
}

TEST(hostile_manifest, reads_no_files_and_waits_for_no_pipe) {
  const Folder folder;
  write(folder / "secret.yaml", "password: hunter2\n");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  const std::string borrowed = "camera: {profile: secret.yaml}\n" + wall;
  for (const std::string& inputs :
       {input("scene", "secret.yaml", ""), input("scene", (folder / "secret.yaml").native(), ""), input("scene", "pipe", ""),
        input("scene", "here.yaml", borrowed), input("scene", (folder / "x.yaml").native(), borrowed)}) {
    write(folder / "manifest.json", manifest(inputs));
    const Attack result = attack(folder, {"render", "--from", "manifest.json"});
    expect_refused(result, 2, "does not hold the text of the");
    EXPECT_FALSE(has(result.err, "hunter2") || has(result.err, "password")) << result.err;
  }
}

TEST(hostile_manifest, many_keys_and_inputs_end_soon_and_are_counted) {
  const Folder folder;
  write(folder / "keys.json",
        manifest(input("scene", "card", ""), repeated(100'000, [](int i) { return ", \"key" + std::to_string(i) + "\": 1"; })));
  write(folder / "inputs.json", manifest(repeated(100'000, [](int) { return "{}, "; }) + "{}"));
  write(folder / "files.json", changed(manifest(input("scene", "card", "")), "\"files\": []",
                                       "\"files\": [" + repeated(100'000, [](int) { return "{}, "; }) + "{}]"));
  write(folder / "sets.json", changed(manifest(input("scene", "card", "")), "\"set\": []", "\"set\": [" + repeated(100'000, [](int i) {
                                                                                             return "[\"camera.lens.k" + std::to_string(i) +
                                                                                                    "\", \"1\"], ";
                                                                                           }) + "[\"a\", \"1\"]]"));
  EXPECT_EQ(attack(folder, {"render", "--from", "keys.json", "-o", "out", "--threads", "1"}).code, 0);
  expect_refused(attack(folder, {"render", "--from", "inputs.json"}), 2, "it was not read to its end");
  expect_refused(attack(folder, {"render", "--from", "files.json"}), 2, "it was not read to its end");
  expect_refused(attack(folder, {"render", "--from", "sets.json"}), 4, "too many keys are changed");
}

// --- outputs and the system -----------------------------------------------------------------------------------------------------

TEST(hostile_output, a_pipe_a_device_and_links_to_them_are_refused) {
  const Folder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  fs::create_directory(folder / "out");
  for (const char* target : {"../pipe", "/dev/null", "/dev/full"}) {
    fs::create_symlink(target, folder / "out" / "frame.npz");
    const Attack result = attack(folder, with_small_sensor({"render", "card", "-o", "out"}));
    expect_refused(result, 3, std::string(target) == "../pipe" ? "this is a pipe" : "this is a device");
    EXPECT_FALSE(fs::exists(folder / "out" / "manifest.json"));
    EXPECT_TRUE(fs::is_symlink(folder / "out" / "frame.npz"));
    fs::remove(folder / "out" / "frame.npz");
  }
  fs::create_symlink("pipe", folder / "link");
  for (const char* place : {"pipe", "link", "/dev/null"})
    expect_refused(attack(folder, with_small_sensor({"render", "card", "-o", place})), 3, "error: ");
}

TEST(hostile_output, what_a_killed_run_left_goes_with_the_next_run) {
  const Folder folder;
  fs::create_directory(folder / "out");
  write(folder / "out" / ".tofray-123-4.tmp", "half a file");
  write(folder / "out" / ".other-123-4.tmp", "somebody else's");
  EXPECT_EQ(attack(folder, with_small_sensor({"render", "card", "-o", "out"})).code, 0);
  EXPECT_FALSE(fs::exists(folder / "out" / ".tofray-123-4.tmp"));
  EXPECT_TRUE(fs::exists(folder / "out" / ".other-123-4.tmp"));
}

TEST(hostile_system, threads_that_cannot_be_made_end_with_4_and_say_so) {
  if (with_sanitizers) GTEST_SKIP() << "sanitizers need all the address space for themselves";
  const Folder folder;
  // 512 stacks of 4 MB do not fit.
  const auto limited = [] {
    const rlimit limit{1'000'000'000, 1'000'000'000};
    ::setrlimit(RLIMIT_AS, &limit);
  };
  for (int round = 0; round < 5; ++round)
    expect_refused(attack(folder, with_small_sensor({"render", "card", "-o", "out", "--threads", "512"}), limited), 4,
                   "the system refuses 512 threads");
  EXPECT_FALSE(fs::exists(folder / "out"));
  EXPECT_EQ(attack(folder, with_small_sensor({"render", "card", "-o", "out", "--threads", "16"}), limited).code, 0);
}

}  // namespace
}  // namespace tofray::test
