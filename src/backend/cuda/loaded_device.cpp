// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cuda/loaded_device.h"

#include "pipeline/pass/list.h"

namespace tofray::backend::gpu {

LoadedDevice::LoadedDevice(const Device& device, int block_size, const pipeline::Setup& setup) : device_(device), block_size_(block_size) {
  device_.use();
  load(setup);
  find_occupancy(setup);
}

void LoadedDevice::load(const pipeline::Setup& setup) {
  const auto pack = [&](Packer& packer) {
    pipeline::Setup to = setup;
    resident_.sample_lenses = pack_lenses(packer, setup, to);
    resident_.modulations = pack_camera(packer, setup, to);
    pack_scene(packer, setup.scene, to.scene);
    return to;
  };
  resident_.shares.assign(setup.subpixel.share, setup.subpixel.share + (setup.subpixel.lens != nullptr ? setup.subpixel.count : 0));
  Packer measure;
  (void)pack(measure);
  const PinnedMemory staged = device_.allocate_pinned(measure.used());
  resident_.memory = device_.allocate(measure.used());
  Packer packer(staged.get(), resident_.memory.get());
  resident_.setup = pack(packer);
  const Stream stream = device_.stream();
  device_.check(device_.runtime().copy(resident_.memory.get(), staged.get(), packer.used(), Way::to_device, stream.get()),
                "copying the scene to the GPU");
  device_.check(device_.runtime().synchronize(stream.get()), "copying the scene to the GPU");
}

void LoadedDevice::find_occupancy(const pipeline::Setup& setup) {
  const pipeline::Pass longest =
      pipeline::bounces(setup, Stage::trace) ? pipeline::pass<pipeline::Bounces> : pipeline::pass<pipeline::FromRays>;
  int threads = 0;
  device_.check(device_.runtime().occupancy(longest, block_size_, threads), "asking for the occupancy");
  occupancy_ = static_cast<double>(threads) / device_.info().threads_per_processor;
}

FrameStream& LoadedDevice::stream(std::size_t i) {
  device_.use();
  while (streams_.size() <= i) streams_.emplace_back(device_, block_size_);
  return streams_[i];
}

}  // namespace tofray::backend::gpu
