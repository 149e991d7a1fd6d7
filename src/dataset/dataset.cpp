// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/dataset.h"

#include "base/faults.h"
#include "dataset/forms.h"
#include "files/text_file.h"
#include "load/controls.h"
#include "load/load.h"
#include "load/trees.h"
#include "model/form.h"
#include "yaml/reader.h"

namespace tofray {

struct Dataset::Impl {
  dataset::SetFile set;
  dataset::Fixed fixed;

  explicit Impl(const std::string& file) : set(dataset::parse_set(files::read_text(file), file)), fixed(dataset::fixed_of(set)) {}

  [[nodiscard]] dataset::Sample at(std::uint64_t sample, std::uint64_t view) const {
    if (sample >= set.samples)
      throw Error(ErrorKind::bad_input, "error: there is no sample " + std::to_string(sample) + "\n  " + set.source + " has " +
                                            std::to_string(set.samples) + ", numbered from 0");
    if (view >= set.views)
      throw Error(ErrorKind::bad_input, "error: there is no view " + std::to_string(view) + "\n  " + set.source + " has " +
                                            std::to_string(set.views) + " of each sample, numbered from 0");
    return {set, fixed, sample, view};
  }
  /// What messages call a sample's scene; its folder is the set's.
  [[nodiscard]] std::string source(std::uint64_t sample, std::uint64_t view) const {
    return set.source + " (sample " + std::to_string(sample) + (set.views > 1 ? ", view " + std::to_string(view) : "") + ")";
  }
  [[nodiscard]] std::string yaml(std::uint64_t sample, std::uint64_t view) const {
    dataset::Sample drawing = at(sample, view);
    const yaml::Node scene = drawing.scene();
    const auto settings = drawing.settings();
    // Faults are told where they stand in the set's file.
    base::Faults faults;
    yaml::read(model::scene_form(), scene, faults);
    faults.raise();
    return load::scene_yaml(load::block_yaml(scene), source(sample, view), settings);
  }
};

Dataset::Dataset(const std::string& file) : impl_(std::make_shared<const Impl>(file)) {}

const std::string& Dataset::name() const { return impl_->set.name; }
const std::string& Dataset::license() const { return impl_->set.license; }
std::uint64_t Dataset::samples() const { return impl_->set.samples; }
std::uint64_t Dataset::views() const { return impl_->set.views; }
std::uint64_t Dataset::combinations() const { return impl_->fixed.combinations; }

std::string Dataset::scene_yaml(std::uint64_t sample, std::uint64_t view) const { return impl_->yaml(sample, view); }

Scene Dataset::scene(std::uint64_t sample, std::uint64_t view) const {
  return load::scene_from_text(impl_->yaml(sample, view), impl_->source(sample, view));
}

std::vector<Drawn> Dataset::drawn(std::uint64_t sample, std::uint64_t view) const {
  dataset::Sample drawing = impl_->at(sample, view);
  drawing.scene();
  drawing.settings();
  return drawing.drawn();
}

std::uint64_t Dataset::noise_seed(std::uint64_t sample, std::uint64_t view) const {
  return impl_->at(sample, view).seed(dataset::Per::view, "noise");
}

}  // namespace tofray
