// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <new>

#include "base/limits.h"
#include "base/text.h"
#include "base/version.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/fault_json.h"
#include "cli/without_memory.h"
#include "files/json.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

bool has(const std::vector<std::string>& words, const char* word) { return std::find(words.begin(), words.end(), word) != words.end(); }

void print_version(bool json) {
  if (json) return print(files::json_text(files::Json::object().set("tofray", base::version())) + "\n");
  print(fmt::format("tofray {}\n", base::version()));
}

void print_limits(bool json) {
  files::Json all = files::Json::object();
  std::string text;
  for (const base::Limit& limit : base::all_limits) {
    all.set(limit.name, limit.value);
    text += fmt::format("{:<20}{:>12}  {}\n", limit.name, limit.value, limit.what);
  }
  print(json ? files::json_text(all, 2) + "\n" : text);
}

[[noreturn]] void unknown_command(const std::string& word) {
  if (word == "fit")
    throw Error(ErrorKind::bad_input,
                "error: fit is a command of the Python package\n  expected python3 -m tofray fit PROFILE FILE --free KEYS; it needs numpy "
                "and scipy");
  if (word == "calibrate")
    throw Error(ErrorKind::bad_input,
                "error: calibrate is a command of the Python package\n  expected python3 -m tofray calibrate phase PROFILE "
                "DISTANCE=FOLDER … -o FILE; it needs numpy.\n  An OpenCV or ROS file as a profile's lens: tofray calibration FILE");
  if (word == "dask")
    throw Error(ErrorKind::bad_input,
                "error: dask is a command of the Python package\n  expected python3 -m tofray dask FOLDER --scheduler ADDRESS; it needs "
                "Debian's python3-distributed");
  std::vector<std::string> names;
  for (const Command& command : all_commands()) {
    if (!command.hidden) names.emplace_back(command.name);
  }
  if (word.starts_with('-')) {
    std::vector<std::string> options = {"--help", "--version", "--limits"};
    for (const OptionSpec& one : all_options()) {
      if (word == one.name)
        throw Error(ErrorKind::bad_input,
                    fmt::format("error: option {} stands before the command\n  expected tofray COMMAND {} …", word, word));
      options.emplace_back(one.name);
    }
    throw Error(ErrorKind::bad_input, fmt::format("error: unknown option {}{}\n  expected a command: {}", base::in_quotes(word),
                                                  base::did_you_mean(word, options), base::listed(names)));
  }
  throw Error(ErrorKind::bad_input, fmt::format("error: unknown command {}{}\n  expected {}", base::in_quotes(word),
                                                base::did_you_mean(word, names), base::listed(names)));
}

int help(const std::vector<std::string>& rest) {
  if (rest.empty()) {
    print(overview_text());
  } else if (const Command* command = find_command(rest[0])) {
    print(help_text(*command));
  } else {
    unknown_command(rest[0]);
  }
  return 0;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 2) {
    say(overview_text());
    return static_cast<int>(ErrorKind::bad_input);
  }
  const std::string& word = arguments[1];
  const std::vector<std::string> rest(arguments.begin() + 2, arguments.end());
  if (word == "--help" || word == "-h" || word == "help") return help(rest);
  if (word == "--version" || word == "-V" || word == "version") return print_version(has(rest, "--json")), 0;
  if (word == "--limits") return print_limits(has(rest, "--json")), 0;
  const Command* command = find_command(word);
  if (command == nullptr) unknown_command(word);
  const auto end = std::find(rest.begin(), rest.end(), "--");
  if (std::any_of(rest.begin(), end, [](const std::string& one) { return one == "--help" || one == "-h"; })) return help({word});
  Options options = parse(*command, rest);
  options.typed = arguments;
  return command->run(options);
}

bool wants_json(const std::vector<std::string>& arguments) {
  return std::any_of(arguments.begin(), std::find(arguments.begin(), arguments.end(), "--"),
                     [](const auto& one) { return one == "--json"; });
}

/// Says what went wrong, to people and, where JSON was asked for, to programs. @return the exit code
int failed(const std::vector<std::string>& arguments, const std::string& text, ErrorKind kind) {
  say(text + "\n");
  if (kind == ErrorKind::bug) say("  this is a fault of tofray's: please report it with the output of `tofray doctor`\n");
  try {
    if (wants_json(arguments)) print(files::json_text(fault_json(text, kind), 2) + "\n");
  } catch (...) {  // people know by now, and the exit code says it, too
  }
  return static_cast<int>(kind);
}

int guarded(const std::vector<std::string>& arguments) {
  try {
    return run(arguments);
  } catch (const Error& error) {
    yield_to_signal();
    return failed(arguments, error.what(), error.kind());
  } catch (const std::bad_alloc&) {
    return failed(arguments, std::string(out_of_memory, sizeof out_of_memory - 2), ErrorKind::limit);  // without the line's end
  } catch (const std::exception& error) {
    return failed(arguments, fmt::format("error: unexpected: {}", error.what()), ErrorKind::bug);
  } catch (...) {
    return failed(arguments, "error: unexpected", ErrorKind::bug);
  }
}

}  // namespace

}  // namespace tofray::app

int main(int argc, char** argv) {
  tofray::app::secure_standard_files();
  return tofray::app::guarded(std::vector<std::string>(argv, argv + argc));
}
