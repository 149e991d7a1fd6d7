// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dataset/scenes.h"

#include <algorithm>
#include <optional>

#include "base/faults.h"
#include "dataset/accept.h"
#include "load/load.h"
#include "load/trees.h"
#include "model/form.h"
#include "tofray/error.h"
#include "yaml/reader.h"

namespace tofray::dataset {

Scenes::Scenes(std::string_view text, const std::string& source) : set_(parse_set(text, source)), fixed_(fixed_of(set_)) {}

void Scenes::refuse_unknown(std::uint64_t sample, std::uint64_t view) const {
  if (sample >= set_.samples)
    throw Error(ErrorKind::bad_input, "error: there is no sample " + std::to_string(sample) + "\n  " + set_.source + " has " +
                                          std::to_string(set_.samples) + ", numbered from 0");
  if (view >= set_.views)
    throw Error(ErrorKind::bad_input, "error: there is no view " + std::to_string(view) + "\n  " + set_.source + " has " +
                                          std::to_string(set_.views) + " of each sample, numbered from 0");
}

Sample Scenes::at(std::uint64_t sample, std::uint64_t view, std::uint32_t attempt) const {
  refuse_unknown(sample, view);
  return {set_, fixed_, sample, view, attempt};
}

std::string Scenes::source(std::uint64_t sample, std::uint64_t view) const {
  return set_.source + " (sample " + std::to_string(sample) + (set_.views > 1 ? ", view " + std::to_string(view) : "") + ")";
}

Scenes::Written Scenes::write(std::uint64_t sample, std::uint64_t view) const {
  const std::uint32_t attempt = accepted(sample);
  Written out = write_attempt(sample, view, attempt);
  if (set_.tries()) out.drawn.push_back({"accept", "attempt", std::to_string(attempt), static_cast<double>(attempt)});
  return out;
}

std::optional<std::size_t> Scenes::broken_rule_of(std::uint64_t sample, std::uint64_t view, std::uint32_t attempt) const {
  const Written written = write_attempt(sample, view, attempt);
  if (set_.accept.empty()) return {};
  return broken_rule(read(written, sample, view), noise_seed(sample, view), set_.accept);
}

std::uint32_t Scenes::accepted(std::uint64_t sample) const {
  if (!set_.tries()) return 0;
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = accepted_.find(sample); known != accepted_.end()) return known->second;
  }
  std::vector<std::uint64_t> refused(set_.accept.size(), 0);
  std::uint64_t crowded = 0;
  base::Place without_room;
  for (std::uint32_t attempt = 0; attempt < set_.attempts; ++attempt) {
    std::optional<std::size_t> broken;
    try {
      for (std::uint64_t view = 0; view < set_.views && !broken; ++view) broken = broken_rule_of(sample, view, attempt);
    } catch (const NoRoom& thrown) {
      without_room = thrown.place, ++crowded;
      continue;
    }
    if (broken) {
      ++refused[*broken];
      continue;
    }
    constexpr std::size_t most_known = 4096;
    const std::lock_guard lock(mutex_);
    if (accepted_.size() >= most_known) accepted_.clear();
    return accepted_[sample] = attempt;
  }
  if (crowded > 0 && (refused.empty() || crowded >= *std::max_element(refused.begin(), refused.end())))
    base::fail(without_room, "things of this scatter find no room in sample " + std::to_string(sample),
               "in " + std::to_string(crowded) + " of " + std::to_string(set_.attempts) +
                   " attempts; expected fewer or smaller ones, a larger place, more `attempts`, or `unplaced: drop`");
  const auto worst = static_cast<std::size_t>(std::max_element(refused.begin(), refused.end()) - refused.begin());
  base::fail(set_.accept[worst].place, "accept takes no attempt at sample " + std::to_string(sample),
             "of " + std::to_string(set_.attempts) + ", this rule refused " + std::to_string(refused[worst]) +
                 "; expected a weaker one, more `attempts`, or `holes`");
}

Scenes::Written Scenes::write_attempt(std::uint64_t sample, std::uint64_t view, std::uint32_t attempt) const {
  Sample drawing = at(sample, view, attempt);
  yaml::Node scene = drawing.scene();
  const auto settings = drawing.settings();
  // Faults are told where they stand in the set's file.
  base::Faults faults;
  yaml::read(model::scene_form(), scene, faults);
  faults.raise();
  std::vector<Drawn> drawn = drawing.drawn();
  Judgement judged;
  if (!set_.tries()) drawing.judge(judged);
  const bool looks = drawing.look() != nullptr;
  for (const Scatter& one : drawing.scatters())
    if (looks && one.far_m > 0)
      base::fail(one.place, "things are put into the view of a camera that is put by `look` after them",
                 "expected surface or box, or a pose without look");
  if (!drawing.scatters().empty()) {
    const Scene standing = read(scene, sample, view);
    const Chance chance = [&](const std::string& path) { return drawing.chance(path); };
    const std::vector<Drawn> placed = place_objects(standing, drawing.scatters(), chance, !looks, scene);
    drawn.insert(drawn.end(), placed.begin(), placed.end());
  }
  if (looks) {
    const Scene standing = read(scene, sample, view);
    const double clear = drawing.look_clear();
    const int tries = drawing.look_tries();
    drawn.push_back(place_camera(
        standing, [&](int at_try) { return drawing.draw_look(at_try); }, clear, tries, scene));
  }
  load::apply(scene, settings);
  return {std::move(scene), std::move(drawn), std::move(judged)};
}

Scene Scenes::read(yaml::Node tree, std::uint64_t sample, std::uint64_t view) const {
  const std::string name = source(sample, view);
  yaml::rename_source(tree, set_.source, name);
  return load::scene_from_tree(tree, name);
}

Scene Scenes::read(const Written& written, std::uint64_t sample, std::uint64_t view) const { return read(written.tree, sample, view); }

void Scenes::judge(std::uint64_t sample, std::uint64_t view, Judgement& into) const {
  std::optional<Sample> drawing;
  try {
    drawing.emplace(at(sample, view));
    drawing->scene(), drawing->settings();
  } catch (const Error&) {
    // A sample without a scene: what was drawn before that was seen counts.
    if (!drawing) return;
  }
  drawing->judge(into);
}

Split Scenes::split(std::uint64_t sample) const {
  refuse_unknown(sample, 0);
  return split_of(set_, sample);
}

std::string Scenes::yaml(std::uint64_t sample, std::uint64_t view) const { return load::block_yaml(write(sample, view).tree); }

Scene Scenes::scene(std::uint64_t sample, std::uint64_t view) const { return read(write(sample, view), sample, view); }

std::vector<Drawn> Scenes::drawn(std::uint64_t sample, std::uint64_t view) const {
  Sample drawing = at(sample, view);
  drawing.scene();
  drawing.settings();
  const bool as_drawn = drawing.scatters().empty() && drawing.look() == nullptr && !set_.tries();
  return as_drawn ? drawing.drawn() : write(sample, view).drawn;
}

std::uint64_t Scenes::noise_seed(std::uint64_t sample, std::uint64_t view) const { return at(sample, view).seed(Per::view, "noise"); }

}  // namespace tofray::dataset
