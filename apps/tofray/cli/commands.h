// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "cli/options.h"

/// What the command line knows. Parsing, help, suggestions and shell completion all come from these tables.
namespace tofray::app {

/// An option that some commands have.
struct OptionSpec {
  const char* name;   ///< "--seed"
  char letter;        ///< 'o' for -o; 0: none
  const char* value;  ///< "N" as help shows it; a null pointer: a switch
  const char* help;
  /// Takes the value over. @throws Error (bad_input) where it is no good
  void (*take)(Options& options, const std::string& value);
  const char* completes = "";  ///< what a value can be, see Command::completes
  bool list = false;           ///< several of them with "," between
  const char* of = "";         ///< the one command that has it where others have one of the same name; empty: all others
  bool hidden = false;         ///< for tests: no help and no completion names it
};

struct Command {
  const char* name = "";
  const char* usage = "";                 ///< "SCENE [options]"
  const char* summary = "";               ///< one line
  const char* examples = "";              ///< lines "command      # what it does"
  const char* more = "";                  ///< further text
  std::vector<const char*> options = {};  ///< names of OptionSpecs
  std::size_t least_words = 0, most_words = 0;
  int (*run)(const Options& options) = nullptr;  ///< returns the exit code
  /// What a word can be, for completion: words, and <commands>, <scenes>, <profiles>, <modes>, <keys>, <numbers>, <varied>, <metrics>, <arrays> or <files>.
  const char* completes = "";
  bool hidden = false;    ///< for scripts: no help and no completion names it
  bool as_typed = false;  ///< all behind "--" are its words, whatever they look like
};

const std::vector<OptionSpec>& all_options();
const std::vector<Command>& all_commands();
/// The one of that name, or none.
const Command* find_command(std::string_view name);
/// @param command  where that one has its own of the name
const OptionSpec& option(std::string_view name, std::string_view command = "");
/// What help puts an option below: "Output", …
const char* group_of(const OptionSpec& one);
/// The options that a command has, by groups.
std::vector<const OptionSpec*> options_of(const Command& command);

/// Reads `arguments`, all that stands after the command's name.
/// @throws Error (bad_input) with a suggestion where a word is near to a known one
Options parse(const Command& command, const std::vector<std::string>& arguments);

/// `tofray --help` and `tofray COMMAND --help`.
std::string overview_text();
std::string help_text(const Command& command);

}  // namespace tofray::app
