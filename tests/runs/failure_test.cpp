// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "files/npz.h"
#include "support/sanitizers.h"
#include "support/temporaries.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

Prepare stdout_to(const char* path) {
  return [path] { ::dup2(::open(path, O_WRONLY), 1); };
}

TEST(full_disk, on_stdout_ends_with_3) {
  for (const Arguments& arguments :
       {Arguments{"list", "scenes"}, Arguments{"schema", "scene"}, Arguments{"--help"}, Arguments{"completion", "zsh"}}) {
    const Result result = run(arguments, stdout_to("/dev/full"));
    EXPECT_EQ(result.code, 3);
    EXPECT_TRUE(has(result.err, "No space left on device")) << result.err;
  }
}

TEST(full_disk, leaves_the_old_file_and_no_temporary) {
  const Folder folder;
  fs::create_directory(folder / "out");
  std::ofstream(folder / "out" / "frame.npz") << "old";
  const auto limited = [&] {
    in_folder(folder.path())();
    const rlimit limit{20'000, 20'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  };
  const Result result = run(with_small_sensor({"render", "card", "-o", "out"}), limited);
  EXPECT_EQ(result.code, 3);
  EXPECT_TRUE(has(result.err, "frame.npz")) << result.err;
  EXPECT_EQ(content(folder / "out" / "frame.npz"), "old");
  EXPECT_EQ(temporaries(folder.path()), std::vector<std::string>());
}

/// Runs the program under strace, which makes the call number `which` of a kind fail.
Prepare failing(const fs::path& folder, const std::string& call, const std::string& error, int which, const Arguments& arguments) {
  return [=] {
    in_folder(folder)();
    const std::string inject = "inject=" + call + ":error=" + error + ":when=" + std::to_string(which);
    std::vector<std::string> words = {"strace", "-f", "-qqq", "-o", "/dev/null", "-e", "trace=" + call, "-e", inject, TOFRAY_TOOL};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& one : words) pointers.push_back(one.data());
    pointers.push_back(nullptr);
    ::execvp("strace", pointers.data());
    ::_exit(127);
  };
}

// The disk is full or breaks at any of the calls that write. One frame is there from an earlier run.
TEST(broken_disk, at_any_call_ends_with_3_and_leaves_whole_files) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers do not run under strace";
#endif
  // strace counts the calls of each thread: of 24 frames one of the six that write has four at least.
  const Arguments arguments = with_small_sensor({"render", "card", "-o", "out", "--frames", "24", "--threads", "1"});
  const Folder none;
  if (run({}, failing(none.path(), "fsync", "EIO", 1000, {"list", "scenes"})).code != 0)
    GTEST_SKIP() << "no strace here, or it may not trace";
  for (const char* call : {"write", "fsync", "renameat", "mkdir"}) {
    int refused = 0, last_refused = 0;
    for (int which = 1; which <= last_refused + 3; ++which) {
      const std::string error = which % 2 == 0 ? "EIO" : "ENOSPC";
      const Folder folder;
      if (std::string(call) != "mkdir") {
        fs::create_directory(folder / "out");
        std::ofstream(folder / "out" / "frame_0001.npz") << "old";
      }
      const Result result = run({}, failing(folder.path(), call, error, which, arguments));
      EXPECT_TRUE(result.code == 0 || result.code == 3) << call << " " << which << ": " << result.code << " " << result.err;
      EXPECT_EQ(temporaries(folder.path()), std::vector<std::string>()) << call << " " << which;
      if (result.code == 3) {
        ++refused, last_refused = which;
        // of `write` the message's own may be the one that fails
        const bool told = has(result.err, error == "EIO" ? "Input/output error" : "No space left on device");
        EXPECT_TRUE(told || (std::string(call) == "write" && result.err.empty())) << result.err;
      }
      if (!fs::exists(folder / "out")) continue;
      for (const auto& entry : fs::directory_iterator(folder / "out")) {
        if (entry.path().extension() != ".npz" || content(entry.path()) == "old") continue;
        EXPECT_NO_THROW(files::read_npz(entry.path())) << call << " " << which << ": " << entry.path();
      }
    }
    // Each file is written, made safe and renamed; one folder.
    EXPECT_GE(refused, std::string(call) == "mkdir" ? 1 : 4) << call;
  }
}

TEST(unwritable, places_end_with_3_and_name_the_place) {
  const Folder folder;
  std::ofstream(folder / "file") << "x";
  const std::string long_name(300, 'n');
  std::vector<std::string> places = {"/proc/tofray", "file", "file/below", long_name};
  if (fs::exists("/sys/kernel")) places.emplace_back("/sys/tofray");  // a bare chroot has an empty folder there
  for (const std::string& place : places) {
    const Result result = run(with_small_sensor({"render", "card", "-o", place}), in_folder(folder.path()));
    EXPECT_EQ(result.code, 3) << place;
    EXPECT_TRUE(has(result.err, place + ": error: ")) << result.err;
  }
  EXPECT_EQ(content(folder / "file"), "x");
}

TEST(unreadable, files_end_with_3) {
  const Folder folder;
  fs::create_directory(folder / "folder.yaml");
  EXPECT_EQ(run({"render", "folder.yaml"}, in_folder(folder.path())).code, 3);
  EXPECT_EQ(run({"inspect", "folder.npz"}, in_folder(folder.path())).code, 3);
  EXPECT_EQ(run({"render", "--from", "folder.yaml"}, in_folder(folder.path())).code, 3);
}

TEST(malformed, files_end_with_2) {
  const Folder folder;
  for (const char* name : {"bad.npz", "bad.npy", "bad.yaml", "bad.json"}) std::ofstream(folder / name) << "{[}";
  const Prepare here = in_folder(folder.path());
  for (const Arguments& arguments : {Arguments{"inspect", "bad.npz"}, Arguments{"inspect", "bad.npy"}, Arguments{"process", "bad.npz"},
                                     Arguments{"render", "bad.yaml"}, Arguments{"check", "bad.yaml"},
                                     Arguments{"render", "--from", "bad.json"}, Arguments{"process", "bad.npz", "--camera", "bad.yaml"}}) {
    const Result result = run(arguments, here);
    EXPECT_EQ(result.code, 2) << arguments[0] << " " << arguments[1];
    EXPECT_TRUE(has(result.err, "bad.")) << result.err;
  }
}

/// As `ulimit -v` does it, in bytes.
Prepare with_address_space(const fs::path& folder, rlim_t most) {
  return [folder, most] {
    in_folder(folder)();
    const rlimit limit{most, most};
    ::setrlimit(RLIMIT_AS, &limit);
  };
}

#define SKIP_WHERE_SANITIZERS_NEED_THE_ADDRESS_SPACE() \
  if (with_sanitizers) GTEST_SKIP() << "sanitizers need all the address space for themselves"

TEST(memory, that_does_not_suffice_ends_with_4) {
  SKIP_WHERE_SANITIZERS_NEED_THE_ADDRESS_SPACE();
  const Folder folder;
  // Too little for the frame itself, for the file's bytes, or for something in between: about 100 MB each.
  for (const rlim_t most : {200'000'000, 300'000'000, 400'000'000}) {
    const Result result = run({"render", "card", "--set", "camera.sensor.width=1200", "--set", "camera.sensor.height=800", "--set",
                               "camera.lens.distortion={k1: 0}", "--threads", "1"},
                              with_address_space(folder.path(), most));
    EXPECT_EQ(result.code, 4) << most << " " << result.err;
    EXPECT_TRUE(has(result.err, "out of memory")) << result.err;
  }
}

// From too little to load the program up to enough, in steps: wherever it ends, files are old or new and whole.
TEST(memory, that_does_not_suffice_leaves_whole_files) {
  SKIP_WHERE_SANITIZERS_NEED_THE_ADDRESS_SPACE();
  const Folder folder;
  const Arguments arguments = {"render",    "card",
                               "--set",     "camera.sensor.width=400",
                               "--set",     "camera.sensor.height=300",
                               "--set",     "camera.lens.distortion={k1: 0}",
                               "--threads", "1",
                               "-o",        "out"};
  ASSERT_EQ(run(arguments, in_folder(folder.path())).code, 0);
  const auto whole = files_of(folder / "out");
  int failed = 0, good = 0;
  // Less than the program itself takes, and the kernel ends it before it begins.
  const auto least = static_cast<rlim_t>(fs::file_size(TOFRAY_TOOL)) + 10'000'000;
  for (rlim_t most = least; most < 400'000'000 && good < 2; most += 3'000'000) {
    SCOPED_TRACE(most);
    fs::remove_all(folder / "out");
    fs::create_directory(folder / "out");
    std::ofstream(folder / "out" / "frame.npz") << "old";
    const Result result = run(arguments, with_address_space(folder.path(), most));
    if (result.code == 0) {
      ++good;
      continue;
    }
    EXPECT_FALSE(fs::exists(folder / "out" / "manifest.json"));
    EXPECT_EQ(temporaries(folder.path()), std::vector<std::string>());
    for (const auto& [name, bytes] : files_of(folder / "out")) EXPECT_TRUE(bytes == whole.at(name) || bytes == "old") << name;
    if (result.code == 127 && has(result.err, "shared librar")) continue;  // the loader's word: the program never began
    EXPECT_EQ(result.code, 4) << result.err;
    EXPECT_TRUE(has(result.err, "error: out of memory\n")) << result.err;
    ++failed;
  }
  EXPECT_EQ(good, 2);
  EXPECT_GT(failed, 5);
}

// In steps of a megabyte, from what the program needs to begin to 80 MB: wherever memory ends, in a thread, before main() or on the stack.
TEST(memory, of_up_to_80_megabytes_never_ends_in_a_signal) {
  SKIP_WHERE_SANITIZERS_NEED_THE_ADDRESS_SPACE();
  const Folder folder;
  ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "recorded", "--emit", "npz"}), in_folder(folder.path())).code, 0);
  const std::vector<Arguments> all = {{"process", "recorded/frame.npz", "-o", "depth"},
                                      with_small_sensor({"render", "card", "-o", "film", "--frames", "4"}),
                                      {"schema", "scene"},
                                      {"inspect", "recorded/frame.npz"}};
  int ended = 0;
  const auto least = static_cast<rlim_t>(fs::file_size(TOFRAY_TOOL) / 1'000'000 + 15);
  // oneTBB 2022 (Debian 13) crashes while it is loaded, before there is a program, in some of the first ones.
  std::set<rlim_t> not_begun;
  for (rlim_t megabytes = least; megabytes <= 80; ++megabytes)
    if (run({"--version"}, with_address_space(folder.path(), megabytes << 20)).code > 128) not_begun.insert(megabytes);
  EXPECT_LE(not_begun.size(), 4U);
  for (const Arguments& arguments : all) {
    for (rlim_t megabytes = least; megabytes <= 80; ++megabytes) {
      if (not_begun.contains(megabytes)) continue;
      const Result result = run(arguments, with_address_space(folder.path(), megabytes << 20));
      if (result.code == 0 || (result.code == 127 && has(result.err, "shared librar"))) continue;
      EXPECT_EQ(result.code, 4) << arguments[0] << " with " << megabytes << " MB: " << result.err;
      EXPECT_TRUE(has(result.err, "out of memory") || has(result.err, "error: the system refuses "))
          << arguments[0] << " with " << megabytes << " MB: " << result.err;
      EXPECT_EQ(temporaries(folder.path()), std::vector<std::string>());
      ++ended;
    }
  }
  EXPECT_GT(ended, 20);
}

/// A .npy file whose header promises more than there is.
std::string promising(const std::string& shape) {
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': " + shape + ", }";
  header.resize(117, ' ');
  header += '\n';
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header + "0123456789abcdef";
}

/// Both headers of a zip's entry say how long it is, unpacked.
std::string with_entry_size(std::string zip, std::uint32_t is, std::uint32_t said) {
  const std::string before(reinterpret_cast<const char*>(&is), 4);
  for (std::size_t at = zip.find(before); at != std::string::npos; at = zip.find(before, at + 4))
    zip.replace(at, 4, reinterpret_cast<const char*>(&said), 4);
  return zip;
}

// An array of 80 kB whose header, and whose entry in the zip, promise 60 MB: memory is asked for what comes. Where zip and array
// contradict each other, none is.
TEST(memory, is_asked_for_what_an_npz_holds_not_for_what_it_promises) {
  SKIP_WHERE_SANITIZERS_NEED_THE_ADDRESS_SPACE();
  const Folder folder;
  std::string noise(80'000, 'x');
  std::uint32_t state = 1;
  for (char& one : noise) one = static_cast<char>((state = state * 1664525 + 1013904223) >> 24);
  const auto written = [&](const files::NpyShape& shape, std::uint32_t said) {
    const std::vector<files::NpyView> views = {{"a", {'f', 4}, shape, noise}};
    const std::string zip = files::npz_bytes(views, files::Packing::deflated), lies = with_entry_size(zip, 80'128, said);
    EXPECT_NE(zip, lies);
    std::ofstream(folder / "a.npz", std::ios::binary) << lies;
    return run({"inspect", "a.npz"}, with_address_space(folder.path(), rlim_t{70} << 20));
  };
  const Result promising = written({15'000'000}, 60'000'128);
  EXPECT_EQ(promising.code, 2) << promising.err;
  EXPECT_TRUE(has(promising.err, "a.npz[a]: error: the entry is cut short")) << promising.err;
  const Result contradicting = written({20'000}, 60'000'128);
  EXPECT_EQ(contradicting.code, 2) << contradicting.err;
  std::ofstream(folder / "empty.npz");
  const Result empty = run({"inspect", "empty.npz"}, in_folder(folder.path()));
  EXPECT_EQ(empty.code, 2);
  EXPECT_TRUE(has(empty.err, "empty.npz: error: the file is empty\n")) << empty.err;
}

// Counts are compared with their limits before memory is asked for: the address space given here holds the program and little else.
TEST(memory, is_not_asked_for_where_counts_are_beyond_their_limits) {
  SKIP_WHERE_SANITIZERS_NEED_THE_ADDRESS_SPACE();
  const Folder folder;
  std::ofstream(folder / "objects.yaml") << "objects: [" << [] {
    std::string list;
    for (int i = 0; i < 20'001; ++i) list += "{sphere: {center: [0, 0, 1], radius: 1 m, reflectivity: 1}}, ";
    return list;
  }() << "]\n";
  std::ofstream(folder / "long.yaml") << std::string((16 << 20) + 1, '#');
  std::vector<std::pair<Arguments, int>> cases = {
      {{"render", "objects.yaml"}, 4}, {{"render", "long.yaml"}, 4}, {{"check", "long.yaml"}, 4}};
  for (const char* shape :
       {"(1000000000,)", "(2147483648, 2147483648)", "(4294967296, 4294967296)", "(9223372036854775807, 2)", "(2000, 2000, 200)"}) {
    const std::string name = "array" + std::to_string(cases.size()) + ".npy";
    std::ofstream(folder / name) << promising(shape);
    cases.push_back({{"inspect", name}, 2});
  }
  for (const std::string huge : {"1000000000", "2147483648", "4294967296", "9223372036854775808"}) {
    for (const char* key : {"sensor.width", "sensor.height", "illumination.0.pattern.columns", "adc.bits"})
      cases.push_back({{"render", "card", "--set", std::string("camera.") + key + "=" + huge}, 2});
    for (const char* option : {"--threads", "--frames", "--first-frame"}) {
      if (huge != "1000000000" || std::string(option) == "--threads") cases.push_back({{"render", "card", option, huge}, 2});
    }
    cases.push_back({{"inspect", "card", "--pixel", huge + "," + huge}, 2});
  }
  cases.push_back({{"render", "card", "--set", "camera.sensor.width=4097", "--set", "camera.sensor.height=4097"}, 4});
  cases.push_back({{"render", "card", "--set", "camera.sensor.width=4096", "--set", "camera.sensor.height=4096"}, 4});
  for (const auto& [arguments, code] : cases) {
    const Result result = run(arguments, with_address_space(folder.path(), 250'000'000));
    const bool refused = result.code == code || (code == 2 && result.code == 4);
    EXPECT_TRUE(refused) << arguments[0] << " " << arguments.back() << ": " << result.code << " " << result.err;
    EXPECT_FALSE(has(result.err, "out of memory")) << arguments[0] << " " << arguments.back() << ": " << result.err;
    EXPECT_TRUE(has(result.err, "error: ")) << result.err;
    EXPECT_FALSE(fs::exists(folder / "card"));
  }
}

// Two at once into one folder would leave a manifest that is not that of the files. Who is killed leaves no lock.
TEST(two_runs, into_one_folder_are_not_let_in_at_once) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  Running first(
      start(with_small_sensor({"render", "flying-ball", "-o", "out", "--frames", "20000"}), folder / "stdout", folder / "stderr", here));
  for (int i = 0; i < 10'000 && !fs::exists(folder / "out" / "frame_00001.npz"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  for (const Arguments& arguments :
       {Arguments{"render", "card", "-o", "out"}, Arguments{"demo", "-o", "out"}, Arguments{"render", "card", "-o", "./out/"}}) {
    const Result second = run(with_small_sensor(arguments), here);
    EXPECT_EQ(second.code, 3) << second.err;
    EXPECT_TRUE(
        has(second.err, "error: another tofray is writing into this folder\n  wait until it is done, or choose another folder with -o"))
        << second.err;
  }
  EXPECT_FALSE(fs::exists(folder / "out" / "frame.npz"));
  EXPECT_EQ(run(with_small_sensor({"render", "card", "-o", "other"}), here).code, 0);
  first.send(SIGKILL);
  EXPECT_EQ(first.finish(), 1000 + SIGKILL);
  EXPECT_EQ(run(with_small_sensor({"render", "card", "-o", "out"}), here).code, 0);
}

}  // namespace
}  // namespace tofray::test
