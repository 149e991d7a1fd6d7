// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The only file that sees CLI11, whose header takes seconds to compile: it takes the words apart, the tables say what they mean.
#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "base/text.h"
#include "base/units.h"
#include "cli/commands.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

[[noreturn]] void refuse(const Command& command, const std::string& what, const std::string& more = {}) {
  throw Error(ErrorKind::bad_input,
              fmt::format("error: {}\n{}  try `tofray {} --help`", what, more.empty() ? "" : "  " + more + "\n", command.name));
}

void refuse_unknown(const Command& command, const std::string& word) {
  std::vector<std::string> names;
  for (const OptionSpec* one : options_of(command))
    if (!one->hidden) names.emplace_back(one->name);
  names.emplace_back("--help");
  const std::string name = word.substr(0, word.find('='));
  for (const OptionSpec& one : all_options()) {
    if (name == one.name)
      refuse(command, fmt::format("`tofray {}` has no option {}", command.name, name), "it has " + base::listed(names, "and"));
  }
  if (word.starts_with('-')) refuse(command, fmt::format("unknown option {}{}", base::in_quotes(name), base::did_you_mean(name, names)));
  refuse(command, fmt::format("unexpected {}", base::in_quotes(word)), fmt::format("expected tofray {} {}", command.name, command.usage));
}

/// `-o=DIR` means what `-oDIR` and `--output=DIR` mean; CLI11 would take "=DIR" for the value. Words behind "--" stay.
std::vector<std::string> without_equals(const Command& command, std::vector<std::string> arguments) {
  for (std::string& word : arguments) {
    if (word == "--") break;
    if (word.size() < 3 || word[0] != '-' || word[1] == '-' || word[2] != '=') continue;
    for (const OptionSpec* one : options_of(command)) {
      if (one->letter != word[1]) continue;
      if (one->value == nullptr) refuse(command, fmt::format("-{} takes no value", one->letter));
      if (word.size() == 3)
        refuse(command, fmt::format("-{}= has no value", one->letter), fmt::format("expected -{} {}", one->letter, one->value));
      word.erase(2, 1);
    }
  }
  return arguments;
}

/// A word behind a --set that may be what a space cut off its value; empty where there is none.
std::string cut_off_value(const std::vector<std::string>& arguments, const std::string& word) {
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    const bool behind = arguments[i - 1].starts_with("--set=") || (i > 1 && arguments[i - 2] == "--set");
    if (!behind || arguments[i] != word) continue;
    const std::string& setting = arguments[i - 1];
    return setting.starts_with("--set=") ? setting.substr(6) : setting;
  }
  return {};
}

/// @param only_units  whether the word has to be a unit's name
void refuse_cut_off(const Command& command, const std::vector<std::string>& arguments, const std::string& word, bool only_units) {
  const std::string setting = cut_off_value(arguments, word);
  if (setting.empty() || (only_units && base::find_unit(word) == nullptr)) return;
  refuse(command, fmt::format("{} stands alone behind --set {}", base::in_quotes(word), base::printable(setting)),
         fmt::format("a value with a space is put in quotes: --set \"{} {}\"", base::printable(setting), base::printable(word)));
}

std::string names_of(const OptionSpec& one) {
  return one.letter != 0 ? fmt::format("-{},{}", one.letter, one.name) : std::string(one.name);
}

void add(CLI::App& app, const OptionSpec& one, Options& options) {
  if (one.value == nullptr) {
    app.add_flag_callback(names_of(one), [&one, &options] { one.take(options, {}); });
    return;
  }
  const auto take = [&one, &options](const std::vector<std::string>& values) {
    for (const std::string& value : values) one.take(options, value);
    return true;
  };
  app.add_option(names_of(one), take)
      ->type_name(one.value)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

}  // namespace

Options parse(const Command& command, const std::vector<std::string>& typed) {
  if (command.as_typed && !typed.empty() && typed[0] == "--") {
    Options words;
    words.words.assign(typed.begin() + 1, typed.end());
    return words;
  }
  const std::vector<std::string> arguments = without_equals(command, typed);
  Options options;
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  for (const OptionSpec* one : options_of(command)) add(app, *one, options);
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    app.parse(std::move(reversed));
  } catch (const CLI::ParseError& error) {
    refuse(command, error.what());
  }
  bool all_words = false, too_many = false;
  for (const std::string& word : app.remaining()) {
    if (!all_words && word == "--") {
      all_words = true;
    } else if (!all_words && word.size() > 1 && word.starts_with('-')) {
      refuse_unknown(command, word);
    } else {
      refuse_cut_off(command, arguments, word, true);
      too_many = too_many || options.words.size() == command.most_words;
      options.words.push_back(word);
    }
  }
  for (const std::string& word : too_many ? options.words : std::vector<std::string>()) refuse_cut_off(command, arguments, word, false);
  if (too_many) refuse_unknown(command, options.words[command.most_words]);
  if (options.words.size() < command.least_words && options.from.empty() && options.transient.empty())
    refuse(command, fmt::format("`tofray {}` needs {}", command.name, command.usage));
  return options;
}

}  // namespace tofray::app
