// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/dataset.h"

#include "dataset/scenes.h"
#include "files/text_file.h"

namespace tofray {

struct Dataset::Impl {
  dataset::Scenes scenes;
};

Dataset::Dataset(const std::string& file) : impl_(new Impl{.scenes = {files::read_text(file), file}}) {}

const std::string& Dataset::name() const { return impl_->scenes.set().name; }
const std::string& Dataset::license() const { return impl_->scenes.set().license; }
std::uint64_t Dataset::samples() const { return impl_->scenes.set().samples; }
std::uint64_t Dataset::views() const { return impl_->scenes.set().views; }
std::uint64_t Dataset::combinations() const { return impl_->scenes.fixed().combinations; }

std::string Dataset::scene_yaml(std::uint64_t sample, std::uint64_t view) const { return impl_->scenes.yaml(sample, view); }
Scene Dataset::scene(std::uint64_t sample, std::uint64_t view) const { return impl_->scenes.scene(sample, view); }
std::vector<Drawn> Dataset::drawn(std::uint64_t sample, std::uint64_t view) const { return impl_->scenes.drawn(sample, view); }
std::uint64_t Dataset::noise_seed(std::uint64_t sample, std::uint64_t view) const { return impl_->scenes.noise_seed(sample, view); }
std::string Dataset::split(std::uint64_t sample) const { return dataset::split_name(impl_->scenes.split(sample)); }

}  // namespace tofray
