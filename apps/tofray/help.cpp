// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include "base/version.h"
#include "commands.h"

namespace tofray::app {

namespace {

std::string indented(const std::string& lines) {
  std::string out;
  for (std::size_t from = 0; from < lines.size();) {
    const std::size_t end = lines.find('\n', from);
    out += "  " + lines.substr(from, end - from) + "\n";
    from = end == std::string::npos ? lines.size() : end + 1;
  }
  return out;
}

std::string option_line(const OptionSpec& one) {
  std::string left = one.letter != 0 ? fmt::format("-{}, {}", one.letter, one.name) : fmt::format("    {}", one.name);
  if (one.value != nullptr) left += fmt::format(" {}", one.value);
  return fmt::format("  {:<26} {}\n", left, one.help);
}

}  // namespace

std::string overview_text() {
  std::string text =
      "tofray simulates time-of-flight cameras: from a scene to raw frames, depth and ground truth.\n\n"
      "Examples:\n"
      "  tofray demo                                # see what it does, no files needed\n"
      "  tofray render scene.yaml -o out            # simulate your own scene\n"
      "  tofray inspect out/frame.npz               # what came out\n"
      "  tofray list scenes                         # scenes to start from\n\n"
      "Commands:\n";
  for (const Command& command : all_commands()) {
    if (!command.hidden) text += fmt::format("  {:<12} {}\n", command.name, command.summary);
  }
  text +=
      "\n"
      "  tofray COMMAND --help                      # a command's examples and options\n"
      "  tofray --version                           # tofray " +
      std::string(base::version()) +
      "\n"
      "  tofray --limits                            # the largest inputs that are taken\n\n"
      "Exit codes: 0 good, 1 a check was not met, 2 bad usage or input, 3 cannot read or write, 4 out of memory or over a limit,\n"
      "5 device, 70 a fault of tofray's, 130 interrupted.\n";
  return text;
}

std::string help_text(const Command& command) {
  std::string text =
      fmt::format("Examples:\n{}\nUsage: tofray {} {}\n\n  {}\n", indented(command.examples), command.name, command.usage, command.summary);
  if (*command.more != '\0') text += "\n" + indented(command.more);
  if (command.options.empty()) return text;
  text += "\nOptions:\n";
  for (const OptionSpec* one : options_of(command)) text += option_line(*one);
  return text;
}

}  // namespace tofray::app
