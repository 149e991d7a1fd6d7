// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/tool.h"

namespace tofray::test {
namespace {

constexpr const char* scene_text =
    "camera: {integration_time: 1.5 ms}\n"
    "objects:\n"
    "  - sphere: {center: [0.05, 0, 1.25], radius: 25.5 cm, reflectivity: 62.5 %}\n"
    "  - plane: {point: [0, 0, 1.75], normal: [0, 0.1, -1], reflectivity: 0.8}\n";

struct Surroundings {
  std::string name;
  Prepare prepare;
  int code = 0;
};

/// All files of a run in a folder of this name.
std::map<std::string, std::string> rendered(const fs::path& folder, const Prepare& prepare, int code) {
  fs::create_directories(folder);
  std::ofstream(folder / "scene.yaml") << scene_text;
  const Result result = run(with_small_sensor({"render", "scene.yaml", "-o", "out", "--seed", "11", "--quiet"}), [&] {
    in_folder(folder)();
    if (prepare) prepare();
  });
  EXPECT_EQ(result.code, code) << result.err;
  return files_of(folder / "out");
}

const std::map<std::string, std::string>& expected() {
  static const std::map<std::string, std::string> files = [] {
    const Folder folder;
    return rendered(folder.path(), {}, 0);
  }();
  return files;
}

Prepare with(const char* name, const char* value) {
  return [=] { ::setenv(name, value, 1); };
}

class surroundings : public testing::TestWithParam<Surroundings> {};

TEST_P(surroundings, do_not_change_the_bytes) {
  const Folder folder;
  EXPECT_EQ(expected().size(), 6u);
  EXPECT_EQ(rendered(folder.path(), GetParam().prepare, GetParam().code), expected());
}

INSTANTIATE_TEST_SUITE_P(
    all, surroundings,
    testing::Values(Surroundings{"decimal_comma", [] { ::setenv("LC_ALL", "de_DE.UTF-8", 1), ::setenv("LANG", "de_DE.UTF-8", 1); }},
                    Surroundings{"unknown_locale", with("LC_ALL", "xx_YY.nonsense")},
                    Surroundings{"time_zone", with("TZ", "Pacific/Kiritimati")}, Surroundings{"strict_umask", [] { ::umask(077); }},
                    Surroundings{"no_home", [] { ::unsetenv("HOME"); }}, Surroundings{"read_only_home", with("HOME", "/proc")},
                    Surroundings{"no_environment", [] { ::clearenv(); }}, Surroundings{"closed_stdout", [] { ::close(1); }},
                    Surroundings{"closed_stdin_and_stderr", [] { ::close(0), ::close(2); }},
                    Surroundings{"all_files_closed", [] { ::close(0), ::close(1), ::close(2); }},
                    Surroundings{"dumb_terminal",
                                 [] { ::setenv("TERM", "dumb", 1), ::setenv("COLUMNS", "1", 1), ::setenv("NO_COLOR", "1", 1); }},
                    Surroundings{"one_instruction_set", with("TOFRAY_ISA", "scalar")}),
    [](const testing::TestParamInfo<Surroundings>& one) { return one.param.name; });

TEST(surroundings_of_paths, bytes_that_are_not_utf_8) {
  const Folder folder;
  EXPECT_EQ(rendered(folder / "\xff\xfe\x80 caf\xe9", {}, 0), expected());
}

TEST(surroundings_of_paths, nearly_4_kB) {
  const Folder folder;
  // PATH_MAX is 4096 with the final zero; a file's temporary name and "out/" have to fit, too.
  fs::path deep = folder.path();
  while (deep.native().size() < 3800) deep /= std::string(100, 'd');
  fs::create_directories(deep);
  std::ofstream(deep / "scene.yaml") << scene_text;
  const Result result = run(with_small_sensor({"render", deep / "scene.yaml", "-o", deep / "out", "--seed", "11", "--quiet"}));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(files_of(deep / "out"), expected());
}

TEST(surroundings_of_paths, a_scene_whose_name_is_not_utf_8_comes_again_from_its_manifest) {
  const Folder folder;
  std::ofstream(folder / "caf\xe9.yaml") << scene_text;
  const Result result = run(with_small_sensor({"render", "caf\xe9.yaml", "-o", "out"}), in_folder(folder.path()));
  ASSERT_EQ(result.code, 0) << result.err;
  const Result again = run({"render", "--from", "out/manifest.json", "-o", "again"}, in_folder(folder.path()));
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(files_of(folder / "out"), files_of(folder / "again"));
}

TEST(surroundings_of_paths, a_scene_through_a_pipe) {
  const Folder folder;
  std::ofstream(folder / "scene.yaml") << scene_text;
  const std::string command =
      "cd " + folder.path().native() + " && cat scene.yaml | " TOFRAY_TOOL " render /dev/stdin -o out --quiet --emit ply";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_GT(content(folder / "out" / "cloud.ply").size(), 1000u);
}

TEST(closed_stdout, ends_with_3_where_data_was_to_come) {
  EXPECT_EQ(run({"list", "scenes"}, [] { ::close(1); }).code, 3);
  EXPECT_EQ(run({"--version"}, [] { ::close(1); }).code, 3);
}

TEST(umask, decides_who_may_read_the_results) {
  const Folder folder;
  ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "out"}),
                [&] {
                  in_folder(folder.path())();
                  ::umask(027);
                })
                .code,
            0);
  struct stat status {};
  ASSERT_EQ(::stat((folder / "out" / "frame.npz").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0640u);
}

}  // namespace
}  // namespace tofray::test
