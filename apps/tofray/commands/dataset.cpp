// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/dataset.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "cli/remarks.h"
#include "commands/shards.h"
#include "files/atomic_file.h"
#include "files/json.h"
#include "pictures/pictures.h"
#include "tofray/analysis.h"
#include "tofray/error.h"
#include "tofray/load.h"
#include "tofray/simulator.h"

namespace tofray::app {

namespace {

/// "12" or "12-3".
struct Which {
  std::uint64_t sample = 0, view = 0;
};

Which which_of(const Options& options) {
  Which out;
  if (options.words.size() < 3) return out;
  const std::string& word = options.words[2];
  const char* const end = word.data() + word.size();
  auto read = std::from_chars(word.data(), end, out.sample);
  if (read.ec == std::errc() && read.ptr != end && *read.ptr == '-') read = std::from_chars(read.ptr + 1, end, out.view);
  if (read.ec != std::errc() || read.ptr != end)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: {} is no sample\n  expected its number, as in `tofray dataset scene {} 12`, or with a view, as in 12-3",
                            base::in_quotes(word), base::printable(options.words[1])));
  return out;
}

/// What a text says of itself behind its line.
std::string header(const Dataset& set, const Options& options, const Which& which) {
  const std::string view = set.views() > 1 ? fmt::format(", view {}", which.view) : "";
  return fmt::format("# sample {}{} of {} ({}). Its noise: --seed {}\n", which.sample, view, base::printable(set.name()),
                     base::printable(options.words[1]), set.noise_seed(which.sample, which.view));
}

files::Json drawn_json(const std::vector<Drawn>& drawn) {
  files::Json all = files::Json::array();
  for (const Drawn& one : drawn)
    all.push(files::Json::object().set("path", one.path).set("form", one.form).set("text", one.text).set("value", one.value));
  return all;
}

int run_scene(const Dataset& set, const Options& options) {
  const Which which = which_of(options);
  const std::string text = header(set, options, which) + set.scene_yaml(which.sample, which.view);
  if (!options.output.empty()) files::write_file_atomically(options.output, text);
  if (options.json) {
    files::Json json = files::Json::object();
    json.set("sample", which.sample).set("view", which.view).set("seed", set.noise_seed(which.sample, which.view));
    print(files::json_text(json.set("drawn", drawn_json(set.drawn(which.sample, which.view))).set("scene", text), 2) + "\n");
  } else if (options.output.empty()) {
    print(text);
  }
  return 0;
}

/// What was drawn for one path in all samples that were looked at.
struct Column {
  std::string form, lowest_text, highest_text;
  std::uint64_t count = 0, absent = 0;
  double lowest = 0, highest = 0, sum = 0;
  struct Word {
    std::string text;
    std::uint64_t count = 0;
  };
  std::map<double, Word> words;  ///< by which one it is
  void add(const Drawn& one) {
    form = one.form;
    if (one.text.empty()) ++absent;
    if (count == 0 || one.value < lowest) lowest = one.value, lowest_text = one.text;
    if (count == 0 || one.value > highest) highest = one.value, highest_text = one.text;
    ++count, sum += one.value;
    if (!by_word()) return;
    Word& word = words[one.value];
    if (word.count++ == 0) word.text = one.text;
    if (word.text != one.text)
      word.text = fmt::format("[{:.0f}]", one.value);  // what stands there is drawn, too: the line of that path says it
  }
  [[nodiscard]] bool by_word() const {
    return form == "choice" || form == "grid" || form == "files" || form == "table" || form == "chance";
  }
};

/// The table's numbers in four digits and their unit.
std::string short_text(double value, const std::string& with_unit) {
  const std::size_t space = with_unit.find(' ');
  return fmt::format("{:.4g}{}", value, space == std::string::npos ? "" : with_unit.substr(space));
}

std::string cut(const std::string& text, std::size_t longest) {
  return text.size() <= longest ? text : text.substr(0, longest - 3) + "...";
}

std::string range_text(const Column& of) {
  if (of.form == "cap" || of.form == "any") return "directions";
  if (of.form == "attempt")
    return fmt::format("taken after {:.3g} attempts, {} at most", 1 + of.sum / static_cast<double>(of.count), of.highest + 1);
  if (of.form == "look") return fmt::format("a place after {:.3g} tries", 1 + of.sum / static_cast<double>(of.count));
  if (of.form == "scatter")
    return fmt::format("{:.4g} % find room, after {:.3g} tries", 100 * (1 - static_cast<double>(of.absent) / static_cast<double>(of.count)),
                       1 + of.sum / static_cast<double>(of.count));
  if (!of.by_word())
    return fmt::format("{} ... {}, mean {}", short_text(of.lowest, of.lowest_text), short_text(of.highest, of.highest_text),
                       short_text(of.sum / static_cast<double>(of.count), of.lowest_text));
  std::string text;
  std::size_t told = 0;
  for (const auto& [which, word] : of.words) {
    constexpr std::size_t most = 6;
    if (told++ == most) return text + fmt::format(", and {} more", of.words.size() - most);
    text += fmt::format("{}{}: {:.3g} %", text.empty() ? "" : ", ", word.text.empty() ? "left out" : cut(base::printable(word.text), 24),
                        100 * static_cast<double>(word.count) / static_cast<double>(of.count));
  }
  return text;
}

/// What was drawn for objects of one scatter stands under one path: "objects/clutter[*]/of".
std::vector<Drawn> with_scatters_joined(std::vector<Drawn> drawn) {
  std::vector<std::string> scatters;
  for (const Drawn& one : drawn)
    if (one.form == "scatter") scatters.push_back(one.path.substr(0, one.path.rfind('[')) + "[");
  for (Drawn& one : drawn)
    for (const std::string& scatter : scatters)
      if (one.path.starts_with(scatter)) {
        one.path = scatter + "*" + one.path.substr(one.path.find(']'));
        break;
      }
  return drawn;
}

/// What is seldom meant of a scene, and in how many samples it is so: in the words of the first of them.
class Oddities {
 public:
  void add(std::uint64_t sample, const Scene& scene, const Camera& camera) {
    for (const SceneFinding& one : scene_report(scene, camera).findings) {
      if (!one.warning) continue;
      const std::string name = one.objects.empty() ? "" : scene.objects[static_cast<std::size_t>(one.objects.front())].name;
      Oddity& same = all_.try_emplace({one.kind, name}, Oddity{one, {}}).first->second;
      if (same.samples.empty() || same.samples.back() != sample) same.samples.push_back(sample);
    }
    ++looked_at_;
  }
  void tell(Remarks& remarks) const {
    for (const auto& [key, one] : all_)
      remarks.tell(fmt::format("warning: {}\n  so in {} of {} samples that were looked at, first in {}; {}\n",
                               base::printable(one.said.what), one.samples.size(), looked_at_, one.samples.front(),
                               base::printable(one.said.more)));
  }

 private:
  struct Oddity {
    SceneFinding said;
    std::vector<std::uint64_t> samples;
  };
  std::map<std::pair<SceneFinding::Kind, std::string>, Oddity> all_;
  std::uint64_t looked_at_ = 0;
};

int run_check_of_set(const Dataset& set, const Options& options) {
  constexpr std::uint64_t most_drawn = 1000, most_read = 20;
  const std::uint64_t drawn = std::min(set.samples(), most_drawn), read = std::min(set.samples(), most_read);
  // Every scene is written, and so looked at by its table; the first ones are read as a whole, with camera and meshes.
  std::vector<std::string> order;
  std::map<std::string, Column> columns;
  for (std::uint64_t i = 0; i < drawn; ++i) {
    const std::uint64_t sample = drawn == set.samples() ? i : i * (set.samples() / drawn), view = i % set.views();
    for (const Drawn& one : with_scatters_joined(set.drawn(sample, view))) {
      if (!columns.contains(one.path)) order.push_back(one.path);
      columns[one.path].add(one);
    }
  }
  Oddities odd;
  for (std::uint64_t i = 0; i < read; ++i) {
    const Scene scene = set.scene(i, i % set.views());
    odd.add(i, scene, load_camera(scene));
  }
  Remarks remarks;
  odd.tell(remarks);
  if (options.json) {
    files::Json all = files::Json::array();
    for (const std::string& path : order) {
      const Column& one = columns[path];
      files::Json json = files::Json::object();
      json.set("path", path).set("form", one.form).set("count", one.count).set("lowest", one.lowest).set("highest", one.highest);
      json.set("mean", one.sum / static_cast<double>(one.count));
      if (one.by_word()) {
        files::Json words = files::Json::object();
        for (const auto& [which, word] : one.words) words.set(word.text, word.count);
        json.set("counts", std::move(words));
      }
      all.push(std::move(json));
    }
    files::Json json = files::Json::object();
    json.set("good", true)
        .set("name", set.name())
        .set("license", set.license())
        .set("samples", set.samples())
        .set("views", set.views())
        .set("combinations", set.combinations());
    print(files::json_text(remarks.put(json.set("looked_at", drawn).set("drawn", std::move(all))), 2) + "\n");
    return 0;
  }
  std::string text = fmt::format("{}: {} samples", base::printable(set.name()), set.samples());
  if (set.views() > 1) text += fmt::format(" of {} views", set.views());
  if (!set.license().empty()) text += ", " + base::printable(set.license());
  if (set.combinations() > 1) text += fmt::format(", {} combinations of its grids", set.combinations());
  text += fmt::format("; good in {} that were drawn\n", drawn);
  std::size_t widest = 4, form = 4;
  for (const std::string& path : order) widest = std::max(widest, cut(path, 48).size()), form = std::max(form, columns[path].form.size());
  if (!order.empty()) text += fmt::format("\n  {:<{}}  {:<{}}  drawn\n", "key", widest, "form", form);
  for (const std::string& path : order)
    text += fmt::format("  {:<{}}  {:<{}}  {}\n", cut(path, 48), widest, columns[path].form, form, range_text(columns[path]));
  print(text);
  if (order.empty()) remarks.tell("warning: nothing varies in this set\n  a value may be a form, such as {uniform: [1 m, 3 m]}\n");
  if (set.combinations() > set.samples())
    remarks.tell(
        fmt::format("warning: the set has fewer samples than its grids have combinations\n  {} of {} occur; expected samples: {}, or a "
                    "multiple of it\n",
                    set.samples(), set.combinations(), set.combinations()));
  return 0;
}

int run_preview_of_set(const Dataset& set, const Options& options) {
  const std::string file = options.output;
  if (file.empty())
    throw Error(ErrorKind::bad_input,
                "error: a preview needs a file\n  expected -o with it, as in `tofray dataset preview corners.yaml -o corners.png`");
  const auto format = pictures::format_of(file);
  if (!format)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: {} is no picture\n  expected a name that ends in .png, .svg or .pdf", base::in_quotes(file)));
  constexpr std::uint64_t most = 16;
  const std::uint64_t count = std::min(set.samples(), most);
  std::vector<pictures::SheetImage> images;
  Progress progress(count, "samples", options.quiet || options.json);
  std::uint64_t dark = 0;
  for (std::uint64_t i = 0; i < count; ++i, progress.step()) {
    const Scene scene = set.scene(i);
    SimulatorOptions wanted;
    wanted.threads = options.threads, wanted.seed = set.noise_seed(i), wanted.arrays = {"z_m", "flags"};
    Frame frame = Simulator(scene, load_camera(scene), wanted).frame(0);
    const auto valid =
        static_cast<std::size_t>(std::count_if(frame.depth.z_m.begin(), frame.depth.z_m.end(), [](float z) { return std::isfinite(z); }));
    if (valid == 0) ++dark;
    const double share = static_cast<double>(valid) / static_cast<double>(std::max<std::size_t>(1, frame.depth.z_m.size()));
    images.push_back({fmt::format("{}  {:.0f} % valid", i, 100 * share), std::move(frame.depth)});
  }
  const std::string picture = pictures::contact_sheet(
      images, fmt::format("{}: samples 0 to {} of {}", set.name(), count - 1, set.samples()), {options.theme, options.scale, *format});
  files::write_file_atomically(file, picture);
  Remarks remarks;
  if (dark > 0)
    remarks.tell(
        fmt::format("warning: {} of {} samples have no valid pixel\n  `tofray check` on their scenes says why: tofray dataset scene {} "
                    "NUMBER | tofray check -\n",
                    dark, count, base::printable(options.words[1])));
  if (options.json)
    print(files::json_text(remarks.put(files::Json::object().set("file", file).set("samples", count)), 2) + "\n");
  else
    Talk(options.quiet)(fmt::format("open {}\n", base::printable(file)));
  return 0;
}

}  // namespace

namespace {

/// The part of a command line behind `dataset`.
struct Verb {
  const char* name;
  int (*of_set)(const Dataset&, const Options&);  ///< or
  int (*of_shards)(const Options&);
  std::vector<std::string_view> options;  ///< besides --json, --quiet and --threads
};

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all = {
      {"check", run_check_of_set, nullptr, {}},
      {"scene", run_scene, nullptr, {"--output"}},
      {"preview", run_preview_of_set, nullptr, {"--output", "--theme", "--scale"}},
      {"plan", nullptr, run_dataset_plan, {"--output", "--pilot", "--shard-samples"}},
      {"run", nullptr, run_dataset_run, {"--part", "--shards"}},
      {"submit", nullptr, run_dataset_submit, {"--tasks", "--sbatch", "--engine", "--print"}},
      {"status", nullptr, run_dataset_status, {}},
      {"verify", nullptr, run_dataset_verify, {"--part", "--shards", "--recompute"}},
      {"merge", nullptr, run_dataset_merge, {"--partial"}},
  };
  return all;
}

/// An option that means nothing to the verb is a mistake.
void refuse_other_options(const Verb& verb, const Options& options) {
  for (const char* option : {"--output", "--pilot", "--shard-samples", "--part", "--shards", "--recompute", "--partial", "--tasks",
                             "--sbatch", "--engine", "--print", "--theme", "--scale"}) {
    const bool typed = std::any_of(options.typed.begin(), options.typed.end(), [&](const std::string& word) {
      return word == option || word.starts_with(std::string(option) + "=") ||
             (option == std::string_view("--output") && word.starts_with("-o"));
    });
    if (typed && std::find(verb.options.begin(), verb.options.end(), option) == verb.options.end())
      throw Error(ErrorKind::bad_input,
                  fmt::format("error: dataset {} takes no {}\n  `tofray help dataset` says what each option is of", verb.name, option));
  }
}

}  // namespace

int run_dataset(const Options& options) {
  const std::string& what = options.words[0];
  const auto verb = std::find_if(verbs().begin(), verbs().end(), [&](const Verb& one) { return what == one.name; });
  if (verb == verbs().end()) {
    std::vector<std::string> names;
    for (const Verb& one : verbs()) names.emplace_back(one.name);
    throw Error(ErrorKind::bad_input, fmt::format("error: {} is nothing that dataset does{}\n  expected {}", base::in_quotes(what),
                                                  base::did_you_mean(what, names), base::listed(names)));
  }
  if (what != "scene" && options.words.size() > 2)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: dataset {} takes a {} alone\n  got {} behind it", what,
                            verb->of_set != nullptr || what == "plan" ? "set" : "folder", base::in_quotes(options.words[2])));
  refuse_other_options(*verb, options);
  return verb->of_set != nullptr ? verb->of_set(Dataset(options.words[1]), options) : verb->of_shards(options);
}

}  // namespace tofray::app
