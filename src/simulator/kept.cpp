// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/kept.h"

#include "pipeline/plan.h"
#include "simulator/frame_memory.h"
#include "simulator/impl.h"
#include "tofray/error.h"

namespace tofray {

namespace {

/// What has to be alike for light that is kept to be read: how it lies in memory, and when the scene was looked at.
struct LightForm {
  std::vector<std::int64_t> numbers;
  std::vector<double> times_s;  ///< of what moves
  bool operator==(const LightForm&) const = default;
};

SimulatorOptions on_processor(SimulatorOptions options) {
  if (options.backend == Backend::cuda)
    throw Error(ErrorKind::bad_input,
                "error: frames that keep their light are computed by the processor\n  got Backend::cuda, expected cpu or automatic");
  options.backend = Backend::cpu;
  return options;
}

/// What the stages up to `last` write of the truth.
void copy_truth(const Truth& from, Truth& to, Stage last) {
#define TOFRAY_COPY(name, part, member, element, shape, stage, ...) \
  if (Stage::stage <= last && from.member.size() == to.member.size()) to.member = from.member;
  TOFRAY_TRUTH_ARRAYS(TOFRAY_COPY)
#undef TOFRAY_COPY
}

}  // namespace

struct KeptLight::Impl {
  LightForm form;
  std::vector<unsigned char> memory;
  Truth truth;
};
KeptLight::KeptLight() = default;
KeptLight::~KeptLight() = default;
KeptLight::KeptLight(KeptLight&&) noexcept = default;
KeptLight& KeptLight::operator=(KeptLight&&) noexcept = default;

struct KeptRaw::Impl {
  Raw raw;
  Truth truth;
};
KeptRaw::KeptRaw() = default;
KeptRaw::~KeptRaw() = default;
KeptRaw::KeptRaw(KeptRaw&&) noexcept = default;
KeptRaw& KeptRaw::operator=(KeptRaw&&) noexcept = default;

struct KeptFrames::Impl {
  Simulator::Impl impl;
  Frame* last = nullptr;  ///< the frame that was computed last, with its border

  Impl(const Scene& scene, const Camera& camera, const SimulatorOptions& options) : impl(scene, camera, on_processor(options)) {}

  /// Where a frame is computed: with the border, if it has one.
  Frame& target(Frame& into) { return impl.border.any() ? impl.whole : into; }
  void done(Frame& computed, Frame& into) {
    last = &computed;
    if (impl.border.any()) impl.cut(computed, into);
  }

  [[nodiscard]] LightForm form(std::uint64_t index) const {
    const pipeline::Setup& s = impl.setup;
    LightForm out;
    out.numbers = {s.lens.width,      s.lens.height,        s.sensor.raw_frames, s.phasors.modulations,
                   s.phasors.orders,  s.phasors.sums_alone, s.scene.lights,      s.scene.moments,
                   s.subpixel.count,  s.scatter.terms,      s.bounces.most,      s.bounces.samples,
                   s.bounces.rounds,  s.bounces.smooth,     s.region.left,       s.region.top,
                   s.region.width,    s.region.height,      s.transient.bins,    pipeline::wants_mixed(s, impl.job.out),
                   impl.options.truth};
    if (!impl.frozen_scene.moves()) return out;
    const scene::Times times = impl.times_from(impl.start_of({index, {}, {}}));
    out.times_s = times.moments;
    out.times_s.push_back(times.truth_s()), out.times_s.push_back(times.period_s);
    return out;
  }
};

KeptFrames::KeptFrames(const Scene& scene, const Camera& camera, const SimulatorOptions& options)
    : impl_(std::make_unique<Impl>(scene, camera, options)) {}
KeptFrames::~KeptFrames() = default;
KeptFrames::KeptFrames(KeptFrames&&) noexcept = default;
KeptFrames& KeptFrames::operator=(KeptFrames&&) noexcept = default;

bool KeptFrames::can_keep_light() const {
  const Simulator::Impl& impl = impl_->impl;
  return impl.needs_earlier() == nullptr && impl.options.last_stage >= Stage::raw &&
         !(pipeline::bounces(impl.setup, Stage::trace) && (impl.setup.bounces.rounds > 1 || impl.setup.sensor.drifts != 0));
}
bool KeptFrames::can_keep_raw() const {
  const Simulator::Impl& impl = impl_->impl;
  return can_keep_light() && impl.options.noise != Noise::off && impl.options.last_stage == Stage::depth && impl.setup.sensor.blooms == 0 &&
         !pipeline::bounces(impl.setup, Stage::trace);
}
bool KeptFrames::stands_still() const { return !impl_->impl.frozen_scene.moves(); }

void KeptFrames::frame(std::uint64_t index, Frame& into) {
  impl_->impl.frame({index, {}, {}}, nullptr, into);
  impl_->last = &impl_->target(into);
}

void KeptFrames::frame_to(std::uint64_t index, KeptLight& light, Frame& into) {
  Simulator::Impl& impl = impl_->impl;
  Frame& to = impl_->target(into);
  impl.begin({index, {}, {}}, nullptr, impl.options, impl.scene.transport, to);
  auto kept = std::make_unique<KeptLight::Impl>();
  kept->form = impl_->form(index);
  impl.frozen_scene.derive();
  impl.engines.cpu().run_kept(impl.setup, impl.job, kept->memory);
  kept->truth = to.truth;
  light.impl_ = std::move(kept);
  impl_->done(to, into);
}

bool KeptFrames::frame_from(std::uint64_t index, const KeptLight& light, Frame& into) {
  Simulator::Impl& impl = impl_->impl;
  Frame& to = impl_->target(into);
  impl.begin({index, {}, {}}, nullptr, impl.options, impl.scene.transport, to);
  if (impl_->form(index) != light.impl_->form) return false;
  copy_truth(light.impl_->truth, to.truth, Stage::power);
  if (impl.setup.transient.bins > 0) impl.frozen_scene.derive();
  impl.engines.cpu().run_from(impl.setup, impl.job, light.impl_->memory);
  impl_->done(to, into);
  return true;
}

void KeptFrames::frame_from(std::uint64_t index, const KeptRaw& raw, Frame& into) {
  Simulator::Impl& impl = impl_->impl;
  Frame& to = impl_->target(into);
  const KeptRaw::Impl& kept = *raw.impl_;
  pipeline::Input input{};
  input.entry = Stage::depth;
  input.recording = {kept.raw.raw.data(), kept.raw.tap_a.data(), kept.raw.tap_b.data()};
  impl.begin({index, {}, {}}, &input, impl.options, impl.scene.transport, to);
  to.raw.tap_a = kept.raw.tap_a, to.raw.tap_b = kept.raw.tap_b, to.raw.raw = kept.raw.raw;
  copy_truth(kept.truth, to.truth, Stage::raw);
  impl.engines.cpu().run(impl.setup, impl.job, backend::Own::moving, &input);
  impl_->done(to, into);
}

void KeptFrames::keep(KeptRaw& raw) const {
  const Frame& last = *impl_->last;
  if (last.raw.tap_a.empty() || last.raw.tap_b.empty() || last.raw.raw.empty())
    throw Error(ErrorKind::bad_input, "error: raw frames without all of their arrays cannot be kept\n  expected tap_a, tap_b and raw");
  raw.impl_ = std::make_unique<KeptRaw::Impl>(KeptRaw::Impl{last.raw, last.truth});
}

}  // namespace tofray
