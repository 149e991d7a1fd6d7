// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>

#include "base/version.h"
#include "cli/commands.h"
#include "cli/console.h"

namespace tofray::app {

namespace {

/// As wide as the terminal, but not so wide that lines are hard to read.
std::size_t help_width() { return static_cast<std::size_t>(std::clamp(terminal_columns(), 40, 110)); }

/// How many columns a text takes: bytes that continue a character take none.
std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & '\xC0') != '\x80'; }));
}

/// Words in lines, the first behind `first`, the others behind as many blanks as `indent`.
std::string wrapped(const std::string& first, const std::string& text, std::size_t indent) {
  std::string out, line = first;
  bool empty = true;  // the line has no word yet
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find(' ', from), text.size());
    const std::string word = text.substr(from, end - from);
    from = end + 1;
    if (word.empty()) continue;
    if (!empty && columns_of(line) + 1 + columns_of(word) > help_width()) {
      out += line + "\n";
      line = std::string(indent, ' ');
      empty = true;
    }
    line += (empty ? "" : " ") + word;
    empty = false;
  }
  return out + line + "\n";
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return lines;
}

/// Lines of commands; what one does stands above it where both are too long for a line.
std::string examples_text(const std::string& examples) {
  std::string out;
  for (const std::string& line : lines_of(examples)) {
    const std::size_t comment = line.find(" # ");
    if (comment == std::string::npos || columns_of(line) + 2 <= help_width()) {
      out += "  " + line + "\n";
      continue;
    }
    out += wrapped("  # ", line.substr(comment + 3), 4);
    out += "  " + line.substr(0, line.find_last_not_of(' ', comment) + 1) + "\n";
  }
  return out;
}

/// Paragraphs, between which there are empty lines.
std::string paragraphs(const std::string& text) {
  std::string out, words;
  for (const std::string& line : lines_of(text)) {
    if (!line.empty()) {
      words += (words.empty() ? "" : " ") + line;
      continue;
    }
    if (!words.empty()) out += wrapped("  ", words, 2);
    out += "\n";
    words.clear();
  }
  return words.empty() ? out : out + wrapped("  ", words, 2);
}

std::string option_lines(const OptionSpec& one) {
  constexpr std::size_t column = 29;
  std::string left = one.letter != 0 ? fmt::format("  -{}, {}", one.letter, one.name) : fmt::format("      {}", one.name);
  if (one.value != nullptr) left += fmt::format(" {}", one.value);
  if (left.size() + 1 > column) return left + "\n" + wrapped(std::string(column, ' '), one.help, column);
  return wrapped(fmt::format("{:<{}}", left, column), one.help, column);
}

/// By groups where there are many.
std::string options_text(const Command& command) {
  const std::vector<const OptionSpec*> all = options_of(command);
  const bool in_groups = all.size() > 8;
  std::string text = in_groups ? "" : "\nOptions:\n", last;
  for (const OptionSpec* one : all) {
    if (one->hidden) continue;
    if (const std::string group = group_of(*one); in_groups && group != last) text += fmt::format("\n{}:\n", last = group);
    text += option_lines(*one);
  }
  return text;
}

}  // namespace

std::string overview_text() {
  std::string text = wrapped("", "tofray simulates time-of-flight cameras: from a scene to raw frames, depth and ground truth.", 0) +
                     "\nExamples:\n"
                     "  tofray demo                                # see what it does, no files needed\n"
                     "  tofray render scene.yaml -o out            # simulate your own scene\n"
                     "  tofray inspect out/frame.npz               # what came out\n"
                     "  tofray list scenes                         # scenes to start from\n\n"
                     "Commands:\n";
  for (const Command& command : all_commands()) {
    if (!command.hidden) text += wrapped(fmt::format("  {:<12} ", command.name), command.summary, 15);
  }
  text +=
      "\n"
      "  tofray COMMAND --help                      # a command's examples and options\n"
      "  tofray --version                           # tofray " +
      std::string(base::version()) +
      "\n"
      "  tofray --limits                            # the largest inputs that are taken\n\n";
  return text +
         wrapped("",
                 "Exit codes: 0 good, 1 a check was not met, 2 bad usage or input, 3 cannot read or write, 4 out of memory or over a "
                 "limit, 5 device, 70 a fault of tofray's, 130 interrupted.",
                 0);
}

std::string help_text(const Command& command) {
  std::string text = fmt::format("Examples:\n{}\nUsage: tofray {} {}\n\n{}", examples_text(command.examples), command.name, command.usage,
                                 wrapped("  ", command.summary, 2));
  if (*command.more != '\0') text += "\n" + paragraphs(command.more);
  return command.options.empty() ? text : text + options_text(command);
}

}  // namespace tofray::app
