// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/temporal.h"

#include <algorithm>

#include "camera/readout/image_camera.h"
#include "depth/confidence.h"
#include "depth/temporal.h"
#include "pipeline/pass/write_depth.h"

namespace tofray::simulator {

Temporal::Temporal(const camera::ImageCamera& camera, Stage last)
    : factor_(static_cast<float>(camera.decoding.temporal_sigmas * camera.decoding.temporal_sigmas)) {
  if (camera.decoding.temporal_frames < 2 || last < Stage::depth) return;
  window_ = static_cast<std::uint64_t>(camera.decoding.temporal_frames) - 1;
  const std::size_t pixels = static_cast<std::size_t>(camera.sensor.width) * static_cast<std::size_t>(camera.sensor.height);
  kept_.resize(window_ + 1);
  for (Kept& one : kept_) one.range.resize(pixels), one.noise.resize(pixels);
}

std::uint64_t Temporal::missing_from(std::uint64_t index) {
  const std::uint64_t oldest = index < window_ ? 0 : index - window_;
  if (first_ <= oldest && oldest <= end_ && end_ <= index) return end_;
  first_ = end_ = oldest;
  return oldest;
}

void Temporal::keep(std::uint64_t index, const flow::FrameView& depth) {
  Kept& to = place_of(index);
  std::copy_n(depth.range_m, to.range.size(), to.range.data());
  std::copy_n(depth.noise_m, to.noise.size(), to.noise.data());
  end_ = index + 1;
}

void Temporal::settle(std::uint64_t index, const pipeline::Setup& setup, const pipeline::Job& job) {
  std::vector<depth::PastFrame> past;
  for (std::uint64_t age = 1; age <= window_ && age <= index; ++age) {
    const Kept& one = place_of(index - age);
    past.push_back({one.range.data(), one.noise.data()});
  }
  const Kept& own = place_of(index);
  const depth::RangeImage image{own.range.data(), own.noise.data(), job.out.flags, setup.lens.width, setup.lens.height};
  const std::size_t pixels = own.range.size();
  const float per_noise = setup.decoder.per_confidence_noise;
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto at = static_cast<std::int32_t>(i);
    const pipeline::Pixels p{at, 1};
    const depth::Filtered value = depth::mean_over_time(image, past.data(), static_cast<int>(past.size()), at, factor_);
    // How likely its own cycle is, at most, out of the byte that was made of it.
    const float own_share = 1.0f - own.noise[i] * per_noise, before = job.out.confidence != nullptr ? job.out.confidence[i] : 0.0f;
    const float trust = own_share > 0 ? std::min((before + 0.5f) / (255.0f * own_share), 1.0f) : 0.0f;
    const std::int32_t flags = job.out.flags[i] | pipeline::flags_of_filter(setup, job, at, value.range, value.noise);
    pipeline::store_range<float>(job.out, p, camera::ray<float>(setup.lens, p), value.range,
                                 depth::confidence(setup.decoder, value.noise, trust), flags);
    job.out.noise_m[i] = value.noise;
  }
}

}  // namespace tofray::simulator
