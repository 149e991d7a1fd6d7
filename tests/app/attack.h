// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <functional>
#include <string>

#include "base/limits.h"
#include "base/text.h"
#include "support/sanitizers.h"
#include "support/tool.h"

/// Input of somebody who means harm: it ends soon, in little memory, with a short message that steers no terminal.
namespace tofray::test {

struct Attack : Result {
  long peak_bytes = 0;
  double processor_seconds = 0;
};

// What took more than 5 s takes less than one now; sanitizers and busy machines get ten.
constexpr rlim_t most_seconds = with_sanitizers ? 60 : 10;

/// Sanitizers keep books of all memory.
constexpr long most_memory(long bytes) { return with_sanitizers ? 100 * bytes : bytes; }

/// Runs the program in a folder: SIGXCPU ends one that computes on, SIGALRM one that waits for ever.
inline Attack attack(const Folder& folder, const Arguments& arguments, const Prepare& more = {}) {
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

inline std::string repeated(int count, const std::function<std::string(int)>& piece) {
  std::string text;
  for (int i = 0; i < count; ++i) text += piece(i);
  return text;
}

/// No control character but the end of a line, and nothing that is not UTF-8.
inline bool is_printable(const std::string& text) {
  std::string joined = text;
  std::replace(joined.begin(), joined.end(), '\n', ' ');
  return base::printable(joined) == joined;
}

inline void expect_refused(const Attack& result, int code, const std::string& part) {
  EXPECT_EQ(result.code, code) << result.err.substr(0, 500);
  EXPECT_TRUE(has(result.err, part)) << result.err.substr(0, 2000);
  EXPECT_LE(result.err.size(), static_cast<std::size_t>(base::limit::message_bytes.value) + 300);
  EXPECT_TRUE(is_printable(result.err)) << result.err.substr(0, 2000);
}

/// Objects of a scene: one wall.
inline const std::string wall_yaml = "objects: [{plane: {point: [0, 0, 1], normal: [0, 0, -1], reflectivity: 0.5}}]\n";
/// The text of the built-in profile.
inline const std::string pico_yaml = content(fs::path(TOFRAY_SOURCE_DIR) / "profiles" / "pico-flexx.yaml");

/// `text` with `to` in the place of `from`; empty where that is not in it.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? std::string() : text.replace(at, from.size(), to);
}

}  // namespace tofray::test
