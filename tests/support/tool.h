// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <fcntl.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "files/npz.h"
#include "support/text.h"

/// Drives the real program, TOFRAY_TOOL, as a shell would.
namespace tofray::test {

namespace fs = std::filesystem;

/// A folder of its own that goes with the test.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "tofray-test-XXXXXX").native();
    path_ = ::mkdtemp(pattern.data());
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }
  [[nodiscard]] fs::path operator/(const fs::path& name) const { return path_ / name; }

 private:
  fs::path path_;
};

/// All numbers of one array of an npz file.
inline std::vector<double> numbers_of(const fs::path& file, const char* name) {
  const auto arrays = files::read_npz(file, {name});
  std::vector<double> out;
  for (std::size_t i = 0; i < arrays.at(0).array.count(); ++i) out.push_back(arrays[0].array.number(i));
  return out;
}

struct Result {
  int code = -1;  ///< exit code; 1000 + signal where one ended the process
  std::string out, err;
};

using Arguments = std::vector<std::string>;

/// What is done in the child before the program starts: change of folder, limits, closed files, environment.
using Prepare = std::function<void()>;

inline std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline void write(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

/// Starts the program; stdout and stderr go to files of these names.
inline pid_t start(const Arguments& arguments, const fs::path& out, const fs::path& err, const Prepare& prepare = {}) {
  std::vector<char*> words = {const_cast<char*>(TOFRAY_TOOL)};
  for (const std::string& one : arguments) words.push_back(const_cast<char*>(one.c_str()));
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that fails leaves nothing running behind it
  ::dup2(::open("/dev/null", O_RDONLY), 0);
  ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
  ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
  for (int file = 3; file < 64; ++file) ::close(file);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::signal(signal, SIG_DFL);  // a shell ignores some for what it starts with &
  if (prepare) prepare();
  ::execv(TOFRAY_TOOL, words.data());
  ::_exit(127);
}

inline int finish(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

/// Ends a program that a test gave up on, before the test's folder goes.
class Running {
 public:
  explicit Running(pid_t child) : child_(child) {}
  ~Running() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    finish();
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  void send(int signal) const { ::kill(child_, signal); }
  int finish() { return test::finish(std::exchange(child_, 0)); }

 private:
  pid_t child_;
};

/// Runs the program to its end.
inline Result run(const Arguments& arguments, const Prepare& prepare = {}) {
  const Folder folder;
  Result result;
  result.code = finish(start(arguments, folder / "out", folder / "err", prepare));
  result.out = content(folder / "out");
  result.err = content(folder / "err");
  return result;
}

inline Prepare in_folder(const fs::path& path) {
  return [path] {
    if (::chdir(path.c_str()) != 0) ::_exit(126);
  };
}

/// A small sensor with the view of the large one, so that a run takes milliseconds.
inline Arguments with_small_sensor(Arguments arguments) {
  for (const char* set : {"camera.sensor.width=28", "camera.sensor.height=22", "camera.lens.fx=26.5 px", "camera.lens.fy=26.5 px",
                          "camera.lens.cx=13.5 px", "camera.lens.cy=10.5 px", "camera.sensor.pixel_pitch=96 um"}) {
    arguments.emplace_back("--set");
    arguments.emplace_back(set);
  }
  return arguments;
}

/// Every file of a folder with its bytes; manifest.json, which says where and when, is left out.
inline std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() != "manifest.json") files[entry.path().filename().native()] = content(entry.path());
  }
  return files;
}

}  // namespace tofray::test
