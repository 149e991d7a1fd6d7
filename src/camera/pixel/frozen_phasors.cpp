// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/pixel/frozen_phasors.h"

#include <algorithm>

#include "base/constants.h"
#include "base/limits.h"
#include "camera/pixel/spread_spectrum.h"
#include "camera/pixel/waveform.h"
#include "num/setup_math.h"
#include "tofray/error.h"

namespace tofray::camera {

namespace setup = num::setup;
using base::speed_of_light;
using num::single;

static_assert(flow::max_lights == base::limit::lights.value);

FrozenPhasors::FrozenPhasors(const ImageCamera& camera, const Modulations& modulations) {
  const std::size_t lights = camera.illumination.size(), frequencies = modulations.frequency_hz.size();
  std::vector<std::vector<Harmonic>> harmonics;  // [modulation][light]
  std::size_t most = 0;
  for (const double frequency : modulations.frequency_hz) {
    for (const Illumination& light : camera.illumination) {
      harmonics.push_back(correlation_harmonics(light, camera.pixel, frequency));
      most = std::max(most, harmonics.back().size());
    }
  }
  if (most > flow::max_harmonics) throw Error(ErrorKind::limit, "error: more than 8 harmonics in a waveform");
  const std::size_t orders = most <= 4 ? 4 : flow::max_harmonics;
  sources_.assign(frequencies * lights * orders * 2, 0.0f);
  for (std::size_t i = 0; i < frequencies * lights; ++i) {
    for (const Harmonic& h : harmonics[i]) {
      float* const source = &sources_[2 * (i * orders + static_cast<std::size_t>(h.order / 2))];
      const double phase = h.phase_rad + h.order * first_phase(camera.mode, modulations, i / lights);
      source[0] = single(h.amplitude * setup::cos(phase)), source[1] = single(h.amplitude * setup::sin(phase));
    }
  }
  for (std::size_t i = 0; i < frequencies; ++i) {
    ModulationView m{};
    const double frequency = mean_frequency(camera.spread_spectrum, modulations.frequency_hz[i]);
    const double per_speed = camera.refractive_index / speed_of_light;
    m.frequency = single(frequency);
    m.swept_turns_per_metre = single(swept_half_width(camera.spread_spectrum, modulations.frequency_hz[i]) * per_speed);
    const double turns_per_metre = frequency * per_speed;
    m.turns_per_metre_high = single(turns_per_metre);
    m.turns_per_metre_low = single(turns_per_metre - static_cast<double>(m.turns_per_metre_high));
    m.source = sources_.data() + i * lights * orders * 2;
    modulations_.push_back(m);
  }
  view_ = {static_cast<std::int32_t>(frequencies), static_cast<std::int32_t>(orders), modulations_.data(), 0};
}

}  // namespace tofray::camera
