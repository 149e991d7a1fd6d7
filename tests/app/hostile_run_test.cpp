// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Names, manifests, outputs and systems that mean harm: no other file is touched, and no terminal steered.
#include "attack.h"

namespace tofray::test {
namespace {

TEST(hostile_names, of_files_and_of_the_environment_steer_no_terminal) {
  const Folder folder;
  const std::string name = "a\x1b]0;owned\x07\xff\xc2\x9b.yaml";
  write(folder / name, "camera: {profile: pico-flexx}\n" + wall_yaml);
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
    write(folder / "here" / "manifest.json", manifest(input("scene", name, wall_yaml)));
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
  const std::string borrowed = "camera: {profile: secret.yaml}\n" + wall_yaml;
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
