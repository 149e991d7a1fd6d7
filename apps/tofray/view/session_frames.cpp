// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "cli/requests.h"
#include "view/session_impl.h"
#include "view/wire.h"

namespace tofray::view {

namespace {

bool has_transient(const std::vector<std::uint16_t>& arrays) {
  return std::any_of(arrays.begin(), arrays.end(),
                     [](std::uint16_t one) { return std::string_view(wire_arrays()[one].name).starts_with("transient_"); });
}

}  // namespace

std::vector<std::uint16_t> joined(const std::vector<std::vector<std::uint16_t>>& wants) {
  std::vector<std::uint16_t> all;
  for (const auto& one : wants) all.insert(all.end(), one.begin(), one.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool can_be_drafted(const State& state) {
  const app::Options& o = state.options;
  if (state.recorded) return false;
  return state.in.scene.transport.bounces > 0 || o.subpixel.value_or(1) > 1 || o.exposure_samples.value_or(1) > 1;
}

/// The simulator of the state, with these arrays; with all of them where none is named.
Simulator& Session::Impl::simulator_of(Simulating& of, const State& state, const std::vector<std::uint16_t>& arrays, Manner manner) {
  if (of.simulator && of.generation == state.generation && of.arrays == arrays) return *of.simulator;
  SimulatorOptions wanted = app::simulator_options(state.options);
  wanted.arrays = sources_of(arrays);
  wanted.progress = &progress_;
  const bool without_transient = !arrays.empty() && !has_transient(arrays) && state.in.scene.transport.transient.bins > 0;
  of.simulator.reset();
  if (manner == Manner::expected) wanted.noise = Noise::off;
  if (manner != Manner::whole || without_transient) {
    Scene scene = state.in.scene;
    scene.transport.transient = {};
    if (manner != Manner::whole) scene.transport = {};
    if (manner == Manner::draft) wanted.subpixel = wanted.exposure_samples = 1;
    of.simulator.emplace(scene, state.in.camera, wanted);
  } else {
    of.simulator.emplace(state.in.scene, state.in.camera, wanted);
  }
  of.generation = state.generation, of.arrays = arrays;
  return *of.simulator;
}

/// @return whether the frame came to its end
bool Session::Impl::computed(Simulating& of, const State& state, const std::vector<std::uint16_t>& arrays, Frame& into, double& took_ms,
                             std::uint64_t index, Manner manner) {
  Simulator* const simulator = state.recorded ? nullptr : &simulator_of(of, state, arrays, manner);
  {
    const std::lock_guard lock(mutex_);
    if (mail_.stop) return false;
    // What came since the thread looked into its mailbox.
    if (may_give_up() && mail_.outdates()) return interrupted_before_ = true, false;
    computing_ = true, progress_.stop = false;
  }
  const Clock::time_point start = Clock::now();
  const auto fault = fault_of([&] {
    if (simulator != nullptr)
      simulator->frame(index, into);
    else
      into = state.recorded->frame(index, state.in.camera, app::simulator_options(state.options));
  });
  counts_.compute_ms = took_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  const std::lock_guard lock(mutex_);
  computing_ = false, interrupted_before_ = progress_.stop;
  if (fault) throw Error(ErrorKind::bug, *fault);
  if (!progress_.stop) ++counts_.computed;
  return !progress_.stop;
}

/// The frames that are due, computed and handed over: of both sides the same.
void Session::Impl::show() {
  const bool tick = all_shown();
  if (tick) {
    set_frame(frame_after(a_.state));
    for (SideOfSession* one : sides()) one->shown = false;
  }
  for (SideOfSession* one : sides())
    if (!one->shown && !show(*one)) return;
  const Clock::time_point now = Clock::now();
  next_ = !at_once_ ? std::max(next_ + period(demand_now_), now) : now + period(demand_now_);
  at_once_ = false;
}

bool Session::Impl::show(SideOfSession& of) {
  constexpr double long_ms = 50;
  const std::vector<std::uint16_t> arrays = joined(demand_now_.wants);
  if (at_once_ && of.frame_ms > long_ms && can_be_drafted(of.state) && !of.drafted) {
    double took = 0;
    if (!computed(of.draft, of.state, arrays, of.draft_frame, took, of.state.frame, Manner::draft)) return false;
    publish(of, of.draft_frame, true);
    of.drafted = true;
  }
  double took = 0;
  const bool whole = computed(of.live, of.state, arrays, of.frame, took, of.state.frame);
  of.frame_ms = whole ? took : std::max(of.frame_ms, took);
  if (!whole) return false;
  publish(of, of.frame, false);
  of.shown = true;
  return true;
}

void Session::Impl::publish(SideOfSession& of, const Frame& frame, bool draft) {
  auto published = std::make_shared<Published>();
  published->side = of.side, published->at_once = at_once_;
  published->generation = of.state.generation, published->sequence = ++of.sequence, published->frame = of.state.frame;
  const double hz = of.state.in.camera.mode.frame_rate_hz;
  const WireHead head{static_cast<std::uint8_t>(of.side),
                      static_cast<std::uint8_t>(draft ? 1 : 0),
                      of.state.generation,
                      of.sequence,
                      hz > 0 ? static_cast<double>(of.state.frame) / hz : 0,
                      static_cast<float>(counts_.compute_ms)};
  for (const auto& want : demand_now_.wants)
    published->messages.emplace_back(want, std::make_shared<const std::string>(encoded(head, frame, want)));
  {
    // Whether there is room for more is told anew once this one was offered.
    const std::lock_guard lock(mutex_);
    demand_.ready = false;
  }
  out_->publish(std::move(published), counts_);
}

/// A frame of the state, computed unless it is the last one; null where it was given up.
const Whole* Session::Impl::frame_of(SideOfSession& of, std::optional<Whole>& last, Simulating& simulating, std::uint64_t index,
                                     const std::vector<std::uint16_t>& arrays, Manner manner) {
  if (last && last->generation == of.state.generation && last->index == index) return &*last;
  Whole fresh;
  if (last) fresh.frame = std::move(last->frame);
  last.reset();
  double took = 0;
  if (!computed(simulating, of.state, arrays, fresh.frame, took, index, manner)) return nullptr;
  fresh.generation = of.state.generation, fresh.index = index;
  return &last.emplace(std::move(fresh));
}

/// A frame of the state with all its arrays.
const Whole* Session::Impl::whole(SideOfSession& of, std::uint64_t index) {
  return frame_of(of, of.last, of.whole, index, {}, Manner::whole);
}

/// What it shows where, and when: the truth alone.
const Whole* Session::Impl::seen(SideOfSession& of, std::uint64_t index) {
  const std::vector<std::uint16_t> arrays{*find_wire_array("gt_object_id"), *find_wire_array("gt_z_m")};
  return frame_of(of, of.last_seen, of.seen, index, arrays, Manner::expected);
}

/// Its raw frames as they are expected of direct light.
const Whole* Session::Impl::expected(SideOfSession& of, std::uint64_t index) {
  const std::vector<std::uint16_t> arrays{*find_wire_array("tap_a"), *find_wire_array("tap_b")};
  return frame_of(of, of.last_expected, of.expected, index, arrays, Manner::expected);
}

}  // namespace tofray::view
