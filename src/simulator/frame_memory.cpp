// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/frame_memory.h"

#include "camera/frozen_camera.h"

namespace tofray::simulator {

namespace {

template <class T>
void resize(std::vector<T>& array, ArrayShape shape, const flow::FrameSize& size) {
  array.resize(static_cast<std::size_t>(flow::values_of(shape, size)));
}

template <class T>
T* place_of(std::vector<T>& array, Stage stage, Stage last) {
  return stage <= last && !array.empty() ? array.data() : nullptr;
}

}  // namespace

void prepare(Depth& depth, int width, int height) {
  depth.width = width, depth.height = height;
#define TOFRAY_RESIZE(name, part, member, element, shape, ...) resize(part.member, ArrayShape::shape, size);
  const flow::FrameSize size{std::int64_t{width} * height, 1, 0};
  TOFRAY_DEPTH_ARRAYS(TOFRAY_RESIZE)
}

void prepare(Frame& frame, const Camera& camera, const SimulatorOptions& options, const Transport& transport) {
  const int width = camera.sensor.width, height = camera.sensor.height, phases = static_cast<int>(camera.mode.sequence.size());
  const flow::FrameSize size{std::int64_t{width} * height, phases, transport.transient.bins};
  Raw& raw = frame.raw;
  raw.width = width, raw.height = height, raw.phases = phases;
  TOFRAY_RAW_ARRAYS(TOFRAY_RESIZE)
  raw.modulation_frequency_hz.clear(), raw.reference_phase_rad.clear(), raw.integration_time_s.clear(), raw.lit.clear();
  for (const RawFrame& k : camera.mode.sequence) {
    raw.modulation_frequency_hz.push_back(k.lit ? k.modulation_frequency_hz : 0);
    raw.reference_phase_rad.push_back(camera::reference_phase_of(k));
    raw.integration_time_s.push_back(k.integration_time_s);
    raw.lit.push_back(k.lit);
  }
  prepare(frame.depth, width, height);
  Truth& truth = frame.truth;
  if (!options.truth) {
    truth = {};
    return;
  }
  truth.width = width, truth.height = height, truth.phases = phases, truth.bins = transport.transient.bins;
  TOFRAY_TRUTH_ARRAYS(TOFRAY_RESIZE)
#undef TOFRAY_RESIZE
  // Of what nobody looks at, nothing is known.
  if (options.subpixel == 1) truth.mixed.clear(), truth.object_share.clear();
  if (truth.bins == 0) truth.transient_lost_e_per_s.clear();
  if (transport.bounces > 0) return;
  truth.direct_e.clear(), truth.indirect_e.clear(), truth.multipath_m.clear(), truth.path_noise_m.clear(), truth.path_count.clear();
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

FrameArrays arrays_of(const flow::FrameView& view, const Camera& camera, std::int64_t bins, std::uint64_t index, int device) {
  FrameArrays arrays;
  arrays.index = index, arrays.device = device;
  arrays.bins = view.transient_e_per_s != nullptr ? static_cast<int>(bins) : 0;
  arrays.width = camera.sensor.width, arrays.height = camera.sensor.height, arrays.phases = static_cast<int>(camera.mode.sequence.size());
#define TOFRAY_SHOW(name, ...) arrays.name = view.name;
  TOFRAY_IMAGE_ARRAYS(TOFRAY_SHOW)
#undef TOFRAY_SHOW
  return arrays;
}

}  // namespace tofray::simulator
