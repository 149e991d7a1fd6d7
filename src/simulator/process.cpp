// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/engines.h"
#include "base/calibration.h"
#include "base/readout.h"
#include "base/recording.h"
#include "camera/frozen_camera.h"
#include "camera/readout/image_camera.h"
#include "num/setup_math.h"
#include "simulator/check.h"
#include "simulator/filter.h"
#include "simulator/frame_memory.h"
#include "simulator/input.h"
#include "tofray/error.h"
#include "tofray/simulator.h"

namespace tofray {

namespace {

/// The camera with the sequence that the raw data says it was taken with.
Camera camera_of(const Raw& raw, const Camera& profile) {
  const auto complain = [](const std::string& what) { throw Error(ErrorKind::bad_input, "error: " + what); };
  const base::ImageExtent image = base::image_extent(profile);
  if (raw.width != image.width || raw.height != image.height) {
    complain("raw data has " + std::to_string(raw.width) + " × " + std::to_string(raw.height) + " pixels, the camera profile " +
             std::to_string(image.width) + " × " + std::to_string(image.height));
  }
  const std::size_t phases = static_cast<std::size_t>(raw.phases);
  const std::size_t all = phases * static_cast<std::size_t>(raw.width) * static_cast<std::size_t>(raw.height);
  if (raw.phases < 1) complain("raw data has no raw frames");
  if (raw.raw.empty() ? raw.tap_a.size() != all || raw.tap_b.size() != all : raw.raw.size() != all) {
    complain("raw data needs raw, or tap_a and tap_b, of shape [phase][height][width]");
  }
  if (raw.tap_a.size() != raw.tap_b.size() || (!raw.tap_a.empty() && raw.tap_a.size() != all))
    complain("tap_a and tap_b must have the shape of raw");
  if (raw.modulation_frequency_hz.size() != phases || raw.reference_phase_rad.size() != phases || raw.integration_time_s.size() != phases ||
      raw.lit.size() != phases) {
    complain("raw data needs modulation_frequency_hz, reference_phase_rad, integration_time_s and lit, one value for each raw frame");
  }
  for (const base::RecordingFault& one : base::faults_of_recording(raw)) complain(one.what + "\n  " + one.more);
  Camera camera = profile;
  camera.auto_exposure = {};  // integration times are known
  camera.mode.sequence.clear();
  for (std::size_t k = 0; k < phases; ++k) {
    camera.mode.sequence.push_back(
        {raw.lit[k] != 0, raw.modulation_frequency_hz[k], raw.reference_phase_rad[k], raw.integration_time_s[k]});
  }
  return camera;
}

}  // namespace

Depth process(const Raw& raw, const Camera& profile, const SimulatorOptions& options, RanOn* ran_on) {
  const Camera camera = camera_of(raw, profile);
  simulator::check(options);
  simulator::check(camera);
  camera::FrozenCamera frozen(base::with_offsets(camera), options.noise != Noise::off, options.seed, 1, options.threads);
  pipeline::Setup setup{};
  setup.last_stage = Stage::depth;
  setup.lens = frozen.lens();
  setup.power = frozen.power();
  setup.phasors = frozen.phasors();
  setup.sensor = frozen.sensor(0);
  setup.decoder = frozen.decoder();
  pipeline::Job job{};
  simulator::set_filter(camera.decoding.filter, job);
  Depth depth;
  simulator::prepare(depth, camera::ImageCamera(camera), options);
  std::vector<float> scratch(static_cast<std::size_t>(pipeline::scratch_floats(setup, job.filter)));
  job.scratch = scratch.data();
  job.out = simulator::view_of(depth);
  const simulator::OwnInput own = simulator::input_of(raw);
  backend::Engines engines(options, setup);
  const backend::Own drifts = setup.sensor.drifts != 0 ? backend::Own::moving : backend::Own::number;
  engines.run([&](backend::Engine& engine) { engine.run(setup, job, drifts, &own.input); });
  if (ran_on != nullptr) *ran_on = engines.ran_on();
  return depth;
}

}  // namespace tofray
