// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/subprocess.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string_view>

#include "base/text.h"
#include "tofray/error.h"

extern char** environ;

namespace tofray::app {

namespace {

/// What a program says goes through files without a name, so that no pipe is ever full.
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File unnamed_file() {
  File file(std::tmpfile(), std::fclose);
  if (!file) throw Error(ErrorKind::io, "error: cannot make a temporary file\n  expected room in the folder for temporary files");
  return file;
}

std::string content(std::FILE* file) {
  std::string out;
  std::array<char, 4096> piece{};
  std::rewind(file);
  while (const std::size_t got = std::fread(piece.data(), 1, piece.size(), file)) out.append(piece.data(), got);
  return out;
}

}  // namespace

Finished run_program(const std::vector<std::string>& words, const std::string& input) {
  const File in = unnamed_file(), out = unnamed_file(), err = unnamed_file();
  std::fwrite(input.data(), 1, input.size(), in.get());
  std::rewind(in.get());
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const std::array<std::FILE*, 3> files = {in.get(), out.get(), err.get()};
  for (int i = 0; i < 3; ++i) posix_spawn_file_actions_adddup2(&actions, ::fileno(files[static_cast<std::size_t>(i)]), i);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int fault = ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  Finished done;
  if (fault != 0) {
    done.found = false, done.code = 127;
    return done;
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  done.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  done.out = content(out.get()), done.err = content(err.get());
  return done;
}

std::string shell_word(const std::string& word) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=:,@%+-";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string out = "'";
  for (const char c : word) c == '\'' ? out += "'\\''" : out += c;
  return out + "'";
}

}  // namespace tofray::app
