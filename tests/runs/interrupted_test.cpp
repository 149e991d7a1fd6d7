// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "files/json.h"
#include "files/npz.h"
#include "files/sha256.h"
#include "support/sanitizers.h"
#include "support/temporaries.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

// 50 of each signal; programs with sanitizers start slowly.
constexpr int interruptions = with_sanitizers ? 10 : 50;

/// An interrupted run's manifest lists what lies there, says so, and stderr says how to go on.
void expect_complete(const Folder& folder, const std::map<std::string, std::string>& files) {
  const files::Json manifest = files::parse_json(content(folder / "out" / "manifest.json"), "manifest.json");
  std::map<std::string, std::string> hashes, listed;
  for (const auto& [name, bytes] : files) hashes[name] = files::sha256_hex(bytes);
  for (const files::Json& file : *manifest.find("files")->items()) listed[*file.find("name")->string()] = *file.find("sha256")->string();
  EXPECT_EQ(hashes, listed);
  ASSERT_NE(manifest.find("interrupted_after_frames"), nullptr);
  std::uint64_t complete = 0;
  EXPECT_TRUE(manifest.find("interrupted_after_frames")->unsigned_integer(complete));
  EXPECT_EQ(complete, files.size());
  EXPECT_TRUE(has(content(folder / "stderr"), "--first-frame " + std::to_string(files.size()) + " ")) << content(folder / "stderr");
}

const Arguments long_run = with_small_sensor({"render", "flying-ball", "-o", "out", "--frames", "2000"});

void wait_until_it_is_there(const fs::path& file) {
  for (int i = 0; i < 10'000 && !fs::exists(file); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

/// Starts a long run, waits until it has written a frame, and then ends it by a signal, a little later each time.
/// @param at_once  whether the run ends without finishing its frame and without a word
void interrupt(int signal, int expected, bool at_once) {
  for (int round = 0; round < interruptions; ++round) {
    const Folder folder;
    Running child(start(long_run, folder / "stdout", folder / "stderr", in_folder(folder.path())));
    const fs::path second = folder / "out" / "frame_0001.npz";
    wait_until_it_is_there(second);
    ASSERT_TRUE(fs::exists(second)) << content(folder / "stderr");
    std::this_thread::sleep_for(std::chrono::microseconds(137 * (round % 20)));
    child.send(signal);
    EXPECT_EQ(child.finish(), expected);
    EXPECT_EQ(temporaries(folder.path()), std::vector<std::string>());
    const auto files = files_of(folder / "out");
    for (const auto& [name, bytes] : files) EXPECT_NO_THROW(files::read_npz(folder / "out" / name)) << name;
    ASSERT_EQ(fs::exists(folder / "out" / "manifest.json"), !at_once);
    if (!at_once) expect_complete(folder, files);
  }
}

TEST(interrupted, run_goes_on_as_it_says_and_leaves_what_an_undisturbed_one_leaves) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  const Arguments whole = with_small_sensor({"render", "flying-ball", "--frames", "100", "--first-frame", "2"});
  const auto into = [&](const char* name, const Arguments& more) {
    Arguments all = whole;
    all.insert(all.end(), {"-o", name});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  Running child(start(into("out", {}), folder / "stdout", folder / "stderr", here));
  wait_until_it_is_there(folder / "out" / "frame_0003.npz");
  child.send(SIGINT);
  ASSERT_EQ(child.finish(), 130);
  const std::string said = content(folder / "stderr");
  const std::size_t first = said.find("--first-frame "), count = said.find("--frames ");
  ASSERT_TRUE(first != std::string::npos && count != std::string::npos) << said;
  const auto number_at = [&](std::size_t at) { return std::to_string(std::stoi(said.substr(at))); };
  ASSERT_EQ(run(into("out", {"--first-frame", number_at(first + 14), "--frames", number_at(count + 9)}), here).code, 0);
  ASSERT_EQ(run(into("whole", {}), here).code, 0);
  EXPECT_EQ(files_of(folder / "out"), files_of(folder / "whole"));
}

// Before main(), and before any library is initialised.
TEST(interrupted, politely_before_it_began_ends_with_143) {
  if (with_sanitizers) GTEST_SKIP() << "a sanitizer has to be first itself";
  const Folder folder;
  const Result result = run({"render", "card"}, [&] {
    in_folder(folder.path())();
    ::setenv("LD_PRELOAD", TOFRAY_SIGNAL_EARLY, 1);
  });
  EXPECT_EQ(result.code, 143);
}

TEST(interrupted, by_ctrl_c_ends_with_130_and_whole_files) { interrupt(SIGINT, 130, false); }
TEST(interrupted, politely_ends_with_143_and_whole_files) { interrupt(SIGTERM, 143, false); }
TEST(interrupted, by_hang_up_ends_with_129_and_whole_files) { interrupt(SIGHUP, 129, false); }

// timeout(1) and npm send the signal to the program and to its group.
TEST(interrupted, by_a_signal_that_comes_several_times_ends_as_by_one) {
  for (int round = 0; round < 5; ++round) {
    const Folder folder;
    Running child(start(long_run, folder / "stdout", folder / "stderr", in_folder(folder.path())));
    wait_until_it_is_there(folder / "out" / "frame_0001.npz");
    for (int i = 0; i < 4; ++i) {
      child.send(SIGINT);
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    EXPECT_EQ(child.finish(), 130);
    expect_complete(folder, files_of(folder / "out"));
  }
}

/// stdout is a pipe that is full and that nobody reads.
void stdout_blocks() {
  constexpr int reader = 5;
  int ends[2];
  if (::pipe2(ends, O_NONBLOCK) != 0 || ::dup2(ends[0], reader) < 0) ::_exit(126);
  const char bytes[4096] = {};
  while (::write(ends[1], bytes, sizeof bytes) > 0) {}
  ::fcntl(ends[1], F_SETFL, 0);
  ::dup2(ends[1], 1);
}

TEST(interrupted, by_a_second_signal_ends_at_once) {
#if defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "ThreadSanitizer hands a signal on once the call that waits has ended, and this one never does";
#endif
  const Folder folder;
  Arguments arguments = long_run;
  arguments.push_back("--json");
  const pid_t child = start(arguments, folder / "stdout", folder / "stderr", [&] { in_folder(folder.path())(), stdout_blocks(); });
  wait_until_it_is_there(folder / "out" / "frame_0001.npz");
  ::kill(child, SIGINT);
  wait_until_it_is_there(folder / "out" / "manifest.json");
  ASSERT_TRUE(fs::exists(folder / "out" / "manifest.json"));
  // What it prints now, nobody reads.
  int status = 0;
  pid_t ended = ::waitpid(child, &status, WNOHANG);
  EXPECT_EQ(ended, 0);
  for (int i = 0; i < 100 && ended == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    ::kill(child, SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    ended = ::waitpid(child, &status, WNOHANG);
  }
  EXPECT_EQ(ended, child);
  if (ended == 0) ::kill(child, SIGKILL), finish(child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130) << status;
}

TEST(interrupted, by_a_reader_that_went_away_ends_with_141_and_whole_files) {
#if defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "ThreadSanitizer takes SIGPIPE for a fault of the code under it and runs the handler within its own locks";
#endif
  interrupt(SIGPIPE, 141, true);
}

TEST(interrupted, output_to_a_closed_pipe_says_nothing) {
  for (int round = 0; round < interruptions; ++round) {
    const Result result = run({"schema", "scene"}, [] {
      int ends[2];
      if (::pipe(ends) != 0) ::_exit(126);
      ::close(ends[0]);
      ::dup2(ends[1], 1);
    });
    EXPECT_EQ(result.code, 141);
    EXPECT_EQ(result.err, "");
  }
}

TEST(interrupted, nohup_is_respected) {
  const Folder folder;
  const auto ignoring = [&] {
    in_folder(folder.path())();
    ::signal(SIGHUP, SIG_IGN);
  };
  const Arguments arguments = with_small_sensor({"render", "flying-ball", "-o", "out", "--frames", "40"});
  Running child(start(arguments, folder / "stdout", folder / "stderr", ignoring));
  wait_until_it_is_there(folder / "out" / "frame_0001.npz");
  child.send(SIGHUP);
  EXPECT_EQ(child.finish(), 0) << content(folder / "stderr");
}

}  // namespace
}  // namespace tofray::test
