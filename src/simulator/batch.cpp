// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Many frames, to host memory or left on a GPU.
#include <algorithm>
#include <string>
#include <utility>

#include "simulator/frame_memory.h"
#include "simulator/impl.h"
#include "tofray/error.h"

namespace tofray {

/// Frames as requests say them.
class Simulator::Impl::RequestedFrames final : public backend::Batch {
 public:
  RequestedFrames(Impl& impl, std::uint64_t frames, const Request& request, const Take& take)
      : Batch(impl.setup, impl.job, frames, impl.options.batch_bytes), impl_(impl), request_(request), take_(take) {
    simulator::prepare(impl.scratch, impl.camera, impl.options, impl.scene.transport);
    impl.job.out = simulator::view_of(impl.scratch, impl.options.last_stage);
  }

  void set(std::uint64_t i, bool derive) override {
    impl_.set_frame(request_(i));
    if (derive) impl_.frozen_scene.derive();
  }
  void set_fixed() override {
    impl_.set_frame({0, {}, {}});
    impl_.frozen_scene.derive();
  }
  [[nodiscard]] std::uint64_t number_of(std::uint64_t i) const override { return request_(i).index; }
  [[nodiscard]] backend::Own own(std::uint64_t from, std::uint64_t frames) const override {
    backend::Own out = backend::Own::number;
    for (std::uint64_t i = from; i < from + frames; ++i) out = std::max(out, impl_.own_of(request_(i), impl_.frozen_scene.moves()));
    return out;
  }
  void take(std::uint64_t i, const flow::FrameView& arrays) override {
    take_(simulator::arrays_of(arrays, impl_.camera, impl_.setup.transient.bins, request_(i).index, -1));
  }

 private:
  Impl& impl_;
  const Request& request_;
  const Take& take_;
};

backend::Own Simulator::Impl::own_of(const FrameRequest& request, bool moves) const {
  if (request.pose && !placed.camera) return backend::Own::scene;
  if (request.seed || request.start_time_s || moves || setup.sensor.drifts != 0) return backend::Own::moving;
  return backend::Own::number;
}

/// Where a frame depends on those before, one follows the other.
void Simulator::Impl::frames_over_time(std::uint64_t count, const Request& request, const Take& take) {
  for (std::uint64_t i = 0; i < count; ++i) check_over_time(request(i));
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t index = request(i).index;
    frame_uncut({index, {}, {}}, nullptr, scratch);
    if (stopped()) return;  // the frame is no frame
    take(simulator::arrays_of(simulator::view_of(scratch, options.last_stage), camera, setup.transient.bins, index, -1));
  }
}

void Simulator::Impl::frames(std::uint64_t count, const Request& request, const Take& take) {
  if (!border.any()) {
    frames_uncut(count, request, take);
    return;
  }
  frames_uncut(count, request, [&](const FrameArrays& from) {
    flow::FrameView view{};
#define TOFRAY_SHOWN(name, part, member, element, ...) view.name = const_cast<element*>(from.name);  // only read
    TOFRAY_IMAGE_ARRAYS(TOFRAY_SHOWN)
#undef TOFRAY_SHOWN
    cut(view, whole);
    take(simulator::arrays_of(simulator::view_of(whole, options.last_stage), region_camera, setup.transient.bins, from.index, -1));
  });
}

void Simulator::Impl::frames_uncut(std::uint64_t count, const Request& request, const Take& take) {
  if (needs_earlier() != nullptr) {
    frames_over_time(count, request, take);
    return;
  }
  RequestedFrames batch(*this, count, request, take);
  engines.run([&](backend::Engine& engine) { engine.run(batch); });
}

void Simulator::Impl::frames_on_device(std::uint64_t count, const Request& request, DeviceFrames::Impl& into) {
  if (const char* const why = needs_earlier(); why != nullptr)
    throw Error(ErrorKind::bad_input, "error: " + std::string(why) + ", and frames that stay on the GPU are computed side by side");
  if (border.any())
    throw Error(ErrorKind::bad_input,
                "error: frames that stay on the GPU are not cut\n  a region (readout.region) gets scattered light, shared "
                "charge and what wells spill from pixels that are not read; read the whole sensor, or take the frames on the host");
  const Take none;
  RequestedFrames batch(*this, count, request, none);
  into.indices.clear();
  into.frames = engines.keep(batch, std::move(into.frames));
  into.camera = camera;
  for (std::uint64_t i = 0; i < count; ++i) into.indices.push_back(request(i).index);
}

DeviceFrames::DeviceFrames() : impl_(std::make_unique<Impl>()) {}
DeviceFrames::~DeviceFrames() = default;
DeviceFrames::DeviceFrames(DeviceFrames&&) noexcept = default;
DeviceFrames& DeviceFrames::operator=(DeviceFrames&&) noexcept = default;
std::uint64_t DeviceFrames::size() const { return impl_->indices.size(); }
double DeviceFrames::seconds() const { return impl_->frames == nullptr ? 0 : impl_->frames->seconds(); }
FrameArrays DeviceFrames::operator[](std::uint64_t i) const {
  const backend::KeptFrames& frames = *impl_->frames;
  return simulator::arrays_of(frames.view(i), impl_->camera, frames.size().bins, impl_->indices[i], frames.device());
}

}  // namespace tofray
