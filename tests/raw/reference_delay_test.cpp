// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Sequences by delays in place of phases: τ = 2πf·t.                                                       [theory: reference-delay]
#include <gtest/gtest.h>

#include <cmath>

#include "support/bench.h"
#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double delay_frequency = 60.24e6;
/// So many delays within a period, from a first one on.
Camera delayed(int phases, double first_turns, Waveform::Kind waveform = Waveform::Kind::sine) {
  Camera camera = bench_camera({delay_frequency}, phases, 0.7);
  camera.illumination[0].waveform.kind = waveform, camera.illumination[0].waveform.harmonics = 4;
  for (int k = 0; k < phases; ++k) {
    RawFrame& raw = camera.mode.sequence[static_cast<std::size_t>(k)];
    raw.reference_phase_rad = 0, raw.reference_delay_s = (first_turns + static_cast<double>(k) / phases) / delay_frequency;
  }
  return camera;
}

}  // namespace

// Light that is late by t has come as a path that is longer by ct: D(ℓ, t) = D(ℓ + ct, 0). Single precision: 1e-6 of the charge.
TEST(reference_delay, is_a_path_that_is_longer_by_as_much) {
  for (const auto waveform : {Waveform::Kind::sine, Waveform::Kind::rectangular}) {
    const auto late = Bench(delayed(5, 0.13, waveform)).expose({20000, 0.4, 100});
    for (std::size_t k = 0; k < 5; ++k) {
      const double delay = (0.13 + static_cast<double>(k) / 5) / delay_frequency;
      // One raw frame is all that is looked at; the three evenly spaced phases are the decoder's need.
      Camera any = bench_camera({delay_frequency}, 3, 0.7);
      any.illumination[0].waveform.kind = waveform, any.illumination[0].waveform.harmonics = 4;
      const auto longer = Bench(any).expose({20000, 0.4 + 0.5 * c * delay, 100});
      EXPECT_NEAR(static_cast<double>(late[k].difference), static_cast<double>(longer[0].difference), 0.05) << k;
    }
  }
}

TEST(reference_delay, measures_what_phases_measure) {
  for (const int phases : {3, 4, 5, 6, 8}) {
    const auto depth = Bench(delayed(phases, 0.31)).measure({20000, 1.234, 3000}).depth;
    EXPECT_NEAR(static_cast<double>(depth.range), 1.234, 2e-6) << phases;
  }
}

// A frame says the phases that the delays are.
TEST(reference_delay, is_said_as_the_phase_that_it_is) {
  Camera camera = lit_camera();
  camera.adc = {16, 100, 32768, 0, 65535};
  for (std::size_t k = 0; k < 4; ++k)
    camera.mode.sequence[k].reference_phase_rad = 0, camera.mode.sequence[k].reference_delay_s = static_cast<double>(k) / 240e6;
  const Frame frame = expected_frame(wall(1), camera);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(frame.raw.reference_phase_rad[k], static_cast<double>(k) * pi / 2, 1e-12);
  EXPECT_NEAR(static_cast<double>(frame.depth.range_m[0]), 1, 2e-6);
  EXPECT_EQ(RawFrame().reference_delay_s, 0);
}
