// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace tofray::app {

struct Finished {
  bool found = true;  ///< whether there is such a program
  int code = 0;       ///< its exit code; 128 + signal where one ended it
  std::string out, err;
};

/// Runs a program, found as a shell finds it, to its end. @param input  what it reads from stdin
Finished run_program(const std::vector<std::string>& words, const std::string& input = "");

/// A word as a POSIX shell reads it back, whatever is in it.
std::string shell_word(const std::string& word);

}  // namespace tofray::app
