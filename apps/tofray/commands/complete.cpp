// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include "cli/commands.h"
#include "cli/console.h"
#include "commands/solved_key.h"
#include "load/builtin.h"
#include "model/lines.h"
#include "results/array_table.h"
#include "tofray/load.h"
#include "tofray/sweep.h"

/// What can stand at the cursor of a command line: the scripts of `tofray completion` ask here. All of it comes from the tables of commands,
/// options, keys, arrays, scenes and profiles.
namespace tofray::app {

namespace {

struct Offer {
  std::string word, about;
};
using Offers = std::vector<Offer>;

constexpr const char* files = ":files";

Offers commands() {
  Offers out;
  for (const Command& one : all_commands()) {
    if (!one.hidden) out.push_back({one.name, one.summary});
  }
  return out;
}

Offers options_as_offers(const Command& command) {
  Offers out;
  for (const OptionSpec* one : options_of(command))
    if (!one->hidden) out.push_back({one->name, one->help});
  out.push_back({"--help", "examples and options"});
  return out;
}

Offers builtins(const std::vector<load::Builtin>& all) {
  Offers out;
  for (const load::Builtin& one : all) out.push_back({one.name, one.description});
  return out;
}

Offers keys() {
  Offers out;
  for (const model::Line& one : model::lines_of(model::scene_form())) out.push_back({one.key + "=", one.doc});
  for (const model::Line& one : model::lines_of(model::camera_form())) out.push_back({"camera." + one.key + "=", one.doc});
  return out;
}

/// Keys of a profile that are numbers.
Offers numbers() {
  Offers out;
  for (const model::Line& one : model::lines_of(model::camera_form()))
    if (is_number_key(one.key)) out.push_back({one.key, one.doc});
  return out;
}

/// What may vary in a sweep.
Offers varied() {
  Offers out = {{"mode=", "the camera's mode: @all, or names"}, {"profile=", "the camera: @all, or names"}};
  for (Offer& one : keys()) out.push_back(std::move(one));
  return out;
}

Offers metrics() {
  Offers out;
  for (const SweepMetric& one : sweep_metrics()) out.push_back({one.name.substr(0, one.name.rfind('_')), one.what});
  return out;
}

Offers arrays() {
  Offers out = {{"gt_*", "all of the ground truth"}};
  for (const results::ArrayRow& one : results::array_table()) out.push_back({one.name, one.what});
  return out;
}

Offers modes() {
  Offers out;
  for (const load::Builtin& one : load::builtin_profiles()) {
    for (const std::string& mode : load_camera(one.name).mode_names) out.push_back({mode, "of " + one.name});
  }
  return out;
}

/// What one word of a table's `completes` stands for.
Offers offers_of(const std::string& word) {
  if (word == "<commands>") return commands();
  if (word == "<scenes>") return builtins(load::builtin_scenes());
  if (word == "<profiles>") return builtins(load::builtin_profiles());
  if (word == "<keys>") return keys();
  if (word == "<numbers>") return numbers();
  if (word == "<arrays>") return arrays();
  if (word == "<modes>") return modes();
  if (word == "<varied>") return varied();
  if (word == "<metrics>") return metrics();
  return {{word == "<files>" ? files : word, ""}};
}

Offers offers_of_all(std::string_view completes) {
  Offers out;
  for (std::size_t from = 0; from < completes.size();) {
    const std::size_t end = std::min(completes.find(' ', from), completes.size());
    for (Offer& one : offers_of(std::string(completes.substr(from, end - from)))) out.push_back(std::move(one));
    from = end + 1;
  }
  return out;
}

/// Each offer with `before` in front.
Offers behind(const std::string& before, Offers offers) {
  for (Offer& one : offers) {
    if (one.word != files) one.word = before + one.word;
  }
  return offers;
}

/// Values of an option; of a list, where some stand already, those that can follow.
Offers values_of(const OptionSpec& one, const std::string& typed) {
  const std::size_t comma = one.list ? typed.rfind(',') : std::string::npos;
  return behind(comma == std::string::npos ? "" : typed.substr(0, comma + 1), offers_of_all(one.completes));
}

/// The option of a command that takes a value and is called so, or none.
const OptionSpec* valued(const Command& command, const std::string& name) {
  for (const OptionSpec* one : options_of(command)) {
    const bool short_name = one->letter != 0 && name == std::string("-") + one->letter;
    if (one->value != nullptr && (name == one->name || short_name)) return one;
  }
  return nullptr;
}

/// bash takes "=" for a word of its own: "--noise = ex". @return whether the last word stood behind one, which is taken out
bool take_equals(std::vector<std::string>& words) {
  if (words.size() > 2 && words.back() == "=") return words.back().clear(), true;
  if (words.size() < 4 || words[words.size() - 2] != "=") return false;
  words.erase(words.end() - 2);
  return true;
}

/// What a command's words, options and their values can be.
Offers offers_of(const Command& command, const std::vector<std::string>& words, bool equals_before) {
  const std::string &word = words.back(), &last = words[words.size() - 2];
  const auto end = std::find(words.begin(), words.end() - 1, "--");
  if (end != words.end() - 1) return offers_of_all(command.completes);
  if (const OptionSpec* one = valued(command, last)) return values_of(*one, word);
  if (equals_before) return {};
  const std::size_t equals = word.find('=');
  if (word.starts_with("--") && equals != std::string::npos) {
    const OptionSpec* one = valued(command, word.substr(0, equals));
    return one == nullptr ? Offers() : behind(word.substr(0, equals + 1), values_of(*one, word.substr(equals + 1)));
  }
  return word.starts_with('-') ? options_as_offers(command) : offers_of_all(command.completes);
}

/// @param words  all behind "tofray", the last one as far as it is typed
Offers offers_at(const std::vector<std::string>& words, bool equals_before) {
  if (words.size() == 1) {
    Offers out = commands();
    for (const char* option : {"help", "version", "--help", "--version", "--limits"}) out.push_back({option, ""});
    return out;
  }
  if (words[0] == "help") return commands();
  const Command* command = find_command(words[0]);
  return command == nullptr ? Offers() : offers_of(*command, words, equals_before);
}

}  // namespace

int run_complete(const Options& options) {
  std::vector<std::string> words = options.words;
  if (words.empty()) return 0;
  const bool equals_before = take_equals(words);
  std::string text;
  std::set<std::string> said;
  for (const Offer& one : offers_at(words, equals_before)) {
    const bool fits = one.word == files || one.word.starts_with(words.back());
    if (fits && said.insert(one.word).second) text += one.word + (one.about.empty() ? "" : "\t" + one.about) + "\n";
  }
  print(text);
  return 0;
}

}  // namespace tofray::app
