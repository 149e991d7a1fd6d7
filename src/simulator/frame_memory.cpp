// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/frame_memory.h"

#include <algorithm>
#include <string_view>

#include "camera/frozen_camera.h"
#include "camera/readout/image_camera.h"
#include "flow/flow.h"

namespace tofray::simulator {

namespace {

template <class Vector>
void resize(Vector& array, ArrayShape shape, const flow::FrameSize& size, bool wanted) {
  array.resize(wanted ? static_cast<std::size_t>(flow::values_of(shape, size)) : 0);
}

template <std::size_t N>
bool among(const std::string_view (&names)[N], std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// Whether frames have an array.
class Wanted {
 public:
  Wanted(const camera::ImageCamera& camera, const SimulatorOptions& options, const Transport& transport)
      : camera_(camera), options_(options), transport_(transport) {}

  [[nodiscard]] bool has(std::string_view name, std::string_view part, ArrayWhen when) const {
    if (part == "truth" && !options_.truth) return false;
    if (when == ArrayWhen::samples && options_.subpixel == 1) return false;
    if ((when == ArrayWhen::bounces || name == "gt_raw_direct_dn") && transport_.bounces == 0) return false;
    if (when == ArrayWhen::transient && transport_.transient.bins == 0) return false;
    if (options_.arrays.empty()) return when != ArrayWhen::asked;
    return asks_for(name) || is_needed(name);
  }

 private:
  [[nodiscard]] bool asks_for(std::string_view name) const { return simulator::asks_for(options_, name); }
  /// Others need it on their way: what the passes over a depth image look at, what exposures follow, what samples are compared with.
  [[nodiscard]] bool is_needed(std::string_view name) const {
    constexpr std::string_view of_passes[] = {"z_m", "range_m", "noise_m", "flags"}, of_exposures[] = {"tap_a", "tap_b", "raw"};
#define TOFRAY_ASKED(name, ...) || asks_for(#name)
    if (among(of_passes, name)) return false TOFRAY_DEPTH_ARRAYS(TOFRAY_ASKED);
#undef TOFRAY_ASKED
    if (among(of_exposures, name)) return camera_.auto_exposure.speed > 0;
    return name == "gt_object_id" && options_.subpixel > 1 && (asks_for("gt_mixed") || asks_for("gt_object_share"));
  }

  const camera::ImageCamera& camera_;
  const SimulatorOptions& options_;
  const Transport& transport_;
};

int modulations_of(const camera::ImageCamera& camera) { return static_cast<int>(camera::modulations_of(camera.mode).frequency_hz.size()); }

template <class Vector>
auto* place_of(Vector& array, Stage stage, Stage last) {
  return stage <= last && !array.empty() ? array.data() : static_cast<typename Vector::value_type*>(nullptr);
}

}  // namespace

void prepare(Depth& depth, const camera::ImageCamera& camera, const SimulatorOptions& options) {
  const Wanted wanted(camera, options, {});
  depth.width = camera.sensor.width, depth.height = camera.sensor.height, depth.modulations = modulations_of(camera);
  const flow::FrameSize size{std::int64_t{depth.width} * depth.height, 1, 0, depth.modulations};
#define TOFRAY_RESIZE(name, part, member, element, shape, stage, when, ...) \
  resize(part.member, ArrayShape::shape, size, ArrayWhen::when != ArrayWhen::asked || wanted.has(#name, #part, ArrayWhen::when));
  TOFRAY_DEPTH_ARRAYS(TOFRAY_RESIZE)
#undef TOFRAY_RESIZE
}

void prepare(Frame& frame, const camera::ImageCamera& camera, const SimulatorOptions& options, const Transport& transport) {
  const int width = camera.sensor.width, height = camera.sensor.height, phases = static_cast<int>(camera.mode.sequence.size());
  const flow::FrameSize size{std::int64_t{width} * height, phases, transport.transient.bins, modulations_of(camera)};
  const Wanted wanted(camera, options, transport);
  auto& [index, raw, depth, truth] = frame;
  raw.width = width, raw.height = height, raw.phases = phases;
  raw.modulation_frequency_hz.clear(), raw.reference_phase_rad.clear(), raw.integration_time_s.clear(), raw.lit.clear();
  for (const RawFrame& k : camera.mode.sequence) {
    raw.modulation_frequency_hz.push_back(k.lit ? k.modulation_frequency_hz : 0);
    raw.reference_phase_rad.push_back(camera::reference_phase_of(k));
    raw.integration_time_s.push_back(k.integration_time_s);
    raw.lit.push_back(k.lit);
  }
  depth.width = width, depth.height = height, depth.modulations = static_cast<int>(size.modulations);
  if (!options.truth) truth = {};
  if (options.truth) truth.width = width, truth.height = height, truth.phases = phases, truth.bins = transport.transient.bins;
#define TOFRAY_RESIZE(name, part, member, element, shape, stage, when, ...) \
  resize(part.member, ArrayShape::shape, size, wanted.has(#name, #part, ArrayWhen::when));
  TOFRAY_IMAGE_ARRAYS(TOFRAY_RESIZE)
#undef TOFRAY_RESIZE
}

bool asks_for(const SimulatorOptions& options, std::string_view array) {
  return std::find(options.arrays.begin(), options.arrays.end(), array) != options.arrays.end();
}

Stage last_stage_of(const camera::ImageCamera& camera, const SimulatorOptions& options, const Transport& transport) {
  const Wanted wanted(camera, options, transport);
  Stage last = Stage::trace;
#define TOFRAY_LAST(name, part, member, element, shape, stage, when, ...) \
  if (wanted.has(#name, #part, ArrayWhen::when)) last = std::max(last, Stage::stage);
  TOFRAY_IMAGE_ARRAYS(TOFRAY_LAST)
#undef TOFRAY_LAST
  return std::min(last, options.last_stage);
}

#define TOFRAY_PLACE(name, part, member, element, shape, stage, ...) view.name = place_of(part.member, Stage::stage, last);

flow::FrameView view_of(Depth& depth) {
  constexpr Stage last = Stage::depth;
  flow::FrameView view{};
  TOFRAY_DEPTH_ARRAYS(TOFRAY_PLACE)
  return view;
}

flow::FrameView view_of(Frame& frame, Stage last) {
  auto& [index, raw, depth, truth] = frame;
  flow::FrameView view{};
  TOFRAY_IMAGE_ARRAYS(TOFRAY_PLACE)
  return view;
}

#undef TOFRAY_PLACE

pipeline::TapStores tap_stores(const flow::FrameView& out, const float* before, int width, const flow::FrameSize& size) {
  using enum pipeline::TapStores;
  constexpr std::uintptr_t line = 64;
  constexpr std::int64_t most_in_caches = 8'000'000;  // a core's share of the last one is some 2 to 16 MB
  constexpr std::int64_t each = sizeof *out.tap_a + sizeof *out.tap_b + sizeof *out.raw;
  const std::uintptr_t places[] = {reinterpret_cast<std::uintptr_t>(out.tap_a), reinterpret_cast<std::uintptr_t>(out.tap_b),
                                   reinterpret_cast<std::uintptr_t>(out.raw)};
  if (std::any_of(std::begin(places), std::end(places), [](std::uintptr_t place) { return place == 0; })) return some;
  const bool whole_lines = width % flow::tile_width == 0 &&
                           std::all_of(std::begin(places), std::end(places), [](std::uintptr_t place) { return place % line == 0; });
  const bool is_lost = out.tap_a != before || each * flow::values_of(ArrayShape::stack, size) > most_in_caches;
  return whole_lines && is_lost ? past_caches : all;
}

FrameArrays arrays_of(const flow::FrameView& view, const camera::ImageCamera& camera, std::int64_t bins, std::uint64_t index, int device) {
  FrameArrays arrays;
  arrays.index = index, arrays.device = device;
  arrays.modulations = modulations_of(camera);
  arrays.bins = view.transient_e_per_s != nullptr ? static_cast<int>(bins) : 0;
  arrays.width = camera.sensor.width, arrays.height = camera.sensor.height, arrays.phases = static_cast<int>(camera.mode.sequence.size());
#define TOFRAY_SHOW(name, ...) arrays.name = view.name;
  TOFRAY_IMAGE_ARRAYS(TOFRAY_SHOW)
#undef TOFRAY_SHOW
  return arrays;
}

}  // namespace tofray::simulator
