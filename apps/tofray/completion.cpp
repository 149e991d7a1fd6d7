// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "base/text.h"
#include "commands.h"
#include "console.h"
#include "io/builtin.h"
#include "model/lines.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string scene_names() {
  std::vector<std::string> names;
  for (const io::Builtin& one : io::builtin_scenes()) names.push_back(one.name);
  return joined(names);
}

/// Words that can stand for a command's argument besides files.
std::string words_of(const Command& command) {
  const std::string_view what = command.completes;
  if (what == "scenes") return scene_names();
  return what == "files" ? "" : std::string(what);
}

bool takes_files(const Command& command) {
  const std::string_view what = command.completes;
  return what == "scenes" || what == "files";
}

std::string command_names() {
  std::vector<std::string> names;
  for (const Command& command : all_commands()) names.emplace_back(command.name);
  return joined(names);
}

/// Words that can stand for an option's value: its choices; of --set the keys of scenes and, as camera.…, of profiles.
std::vector<std::string> values_of(const OptionSpec& one) {
  if (std::string_view(one.name) != "--set") return one.choices;
  std::vector<std::string> keys;
  for (const model::Line& line : model::lines_of(model::scene_form())) keys.push_back(line.key + "=");
  for (const model::Line& line : model::lines_of(model::camera_form())) keys.push_back("camera." + line.key + "=");
  return keys;
}

std::string bash() {
  std::string values, commands;
  for (const OptionSpec& one : all_options()) {
    if (one.value == nullptr) continue;
    std::string names = one.letter != 0 ? fmt::format("{}|-{}", one.name, one.letter) : std::string(one.name);
    const std::string reply = one.file              ? "COMPREPLY=($(compgen -f -- \"$word\"))"
                              : values_of(one).empty() ? "COMPREPLY=()"
                                                       : fmt::format("COMPREPLY=($(compgen -W \"{}\" -- \"$word\"))", joined(values_of(one)));
    const bool goes_on = std::string_view(one.name) == "--set";  // the key's value follows
    values += fmt::format("    {}) {}{}; return ;;\n", names, reply, goes_on ? "; compopt -o nospace 2> /dev/null" : "");
  }
  for (const Command& command : all_commands()) {
    std::string options = "--help";
    for (const OptionSpec* one : options_of(command)) options += fmt::format(" {}", one->name);
    commands += fmt::format("    {}) options=\"{}\"; words=\"{}\"; files={} ;;\n", command.name, options, words_of(command),
                            takes_files(command) ? 1 : 0);
  }
  return fmt::format(
      R"(# tofray: completion for bash. To keep it: tofray completion bash > ~/.local/share/bash-completion/completions/tofray
_tofray() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD-1]}}" options="" words="" files=0
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W "{} --help --version --limits" -- "$word"))
    return
  fi
  case "$before" in
{}  esac
  case "${{COMP_WORDS[1]}}" in
{}  esac
  if [[ "$word" == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  else
    COMPREPLY=($(compgen -W "$words" -- "$word"))
    if ((files)); then COMPREPLY+=($(compgen -f -- "$word")); fi
  fi
}}
complete -o filenames -F _tofray tofray
)",
      command_names(), values, commands);
}

/// Text within single quotes of a shell.
std::string quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string zsh_value(const OptionSpec& one) {
  if (one.value == nullptr) return {};
  const std::string action = one.file ? "_files" : values_of(one).empty() ? "" : fmt::format("({})", joined(values_of(one)));
  return fmt::format(":{}:{}", one.value, action);
}

/// For _arguments: brackets and colons of the description are its own.
std::string zsh_option(const OptionSpec& one) {
  std::string help;
  for (const char c : std::string_view(one.help)) help += c == '[' || c == ']' || c == ':' ? std::string("\\") + c : std::string(1, c);
  const std::string repeat = std::string_view(one.name) == "--set" ? "*" : "";
  std::string text = fmt::format("      {}\n", quoted(fmt::format("{}{}[{}]{}", repeat, one.name, help, zsh_value(one))));
  if (one.letter != 0) text += fmt::format("      {}\n", quoted(fmt::format("-{}[{}]{}", one.letter, help, zsh_value(one))));
  return text;
}

std::string zsh() {
  std::string commands, cases;
  for (const Command& command : all_commands()) {
    commands += fmt::format("    {}\n", quoted(fmt::format("{}:{}", command.name, command.summary)));
    cases += fmt::format("    {})\n      arguments=(\n", command.name);
    for (const OptionSpec* one : options_of(command)) cases += zsh_option(*one);
    cases += "      '--help[examples and options]'\n";
    const std::string words = words_of(command);
    if (takes_files(command) && !words.empty())
      cases += fmt::format("      '1:file:{{compadd {}; _files}}'\n", words);
    else if (takes_files(command))
      cases += "      '1:file:_files'\n";
    else if (!words.empty())
      cases += fmt::format("      '1:what:({})'\n", words);
    cases += "      ) ;;\n";
  }
  return fmt::format(R"(#compdef tofray
# tofray: completion for zsh. To keep it: tofray completion zsh > _tofray in a folder of $fpath
_tofray() {{
  local -a commands arguments
  commands=(
{}  )
  if ((CURRENT == 2)); then
    if [[ $PREFIX == -* ]]; then compadd -- --help --version --limits; else _describe command commands; fi
    return
  fi
  case $words[2] in
{}  esac
  shift words
  ((CURRENT--))
  _arguments -s $arguments
}}
if [[ ${{funcstack[1]-}} == _tofray ]]; then
  _tofray "$@"
else
  compdef _tofray tofray
fi
)",
                     commands, cases);
}

std::string fish() {
  std::string text =
      "# tofray: completion for fish. To keep it: tofray completion fish > ~/.config/fish/completions/tofray.fish\n"
      "complete -c tofray -f\n"
      "complete -c tofray -l help -d 'examples and options'\n"
      "complete -c tofray -n __fish_use_subcommand -l version -d 'the version of tofray'\n"
      "complete -c tofray -n __fish_use_subcommand -l limits -d 'the largest inputs that are taken'\n";
  for (const Command& command : all_commands())
    text += fmt::format("complete -c tofray -n __fish_use_subcommand -a {} -d {}\n", command.name, quoted(command.summary));
  for (const Command& command : all_commands()) {
    const std::string seen = fmt::format("'__fish_seen_subcommand_from {}'", command.name);
    for (const OptionSpec* one : options_of(command)) {
      text += fmt::format("complete -c tofray -n {} -l {} -d {}", seen, one->name + 2, quoted(one->help));
      if (one->letter != 0) text += fmt::format(" -s {}", one->letter);
      if (one->value != nullptr)
        text += one->file ? " -r -F" : values_of(*one).empty() ? " -x" : fmt::format(" -x -a '{}'", joined(values_of(*one)));
      text += "\n";
    }
    const std::string words = words_of(command);
    if (!words.empty()) text += fmt::format("complete -c tofray -n {} -a '{}'\n", seen, words);
    if (takes_files(command)) text += fmt::format("complete -c tofray -n {} -F\n", seen);
  }
  return text;
}

}  // namespace

int run_completion(const Options& options) {
  const std::string& shell = options.words[0];
  if (shell == "bash")
    print(bash());
  else if (shell == "zsh")
    print(zsh());
  else if (shell == "fish")
    print(fish());
  else
    throw Error(ErrorKind::bad_input, fmt::format("error: no completion for {}{}\n  expected bash, zsh or fish", base::in_quotes(shell),
                                                  base::did_you_mean(shell, {"bash", "zsh", "fish"})));
  return 0;
}

}  // namespace tofray::app
