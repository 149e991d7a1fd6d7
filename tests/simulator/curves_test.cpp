// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Curves of a camera that a program set: what lies between samples, and samples that cannot be.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// Why a camera is refused.
std::string refusal(const Camera& camera) {
  try {
    Simulator(wall(1), camera, {.threads = 1});
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_input);
    return error.what();
  }
  return "not refused";
}

/// Electrons of the middle pixel, one path of light.
double signal(const Camera& camera) {
  const std::vector<float> all = Simulator(wall(1), camera, {.noise = Noise::off, .threads = 1}).frame(0).truth.signal_e;
  return static_cast<double>(all[all.size() / 8]);
}

}  // namespace

// An edge 1 nm wide between samples 40 nm apart, where a free cubic swings.
TEST(quantum_efficiency, is_flat_before_and_behind_an_edge_where_its_samples_are) {
  Camera camera = lit_camera(5, 5, 10);
  for (const auto& [wavelength_m, expected] : {std::pair{830e-9, 0.1}, {851e-9, 0.9}}) {
    camera.illumination[0].illumination_wavelength_m = wavelength_m;
    camera.pixel.quantum_efficiency = {{700e-9, 800e-9, 840e-9, 841e-9, 881e-9, 981e-9}, {0, 0.1, 0.1, 0.9, 0.9, 1}};
    const double table = signal(camera);
    camera.pixel.quantum_efficiency = {{850e-9}, {expected}};
    EXPECT_NEAR(table / signal(camera), 1, 1e-6) << wavelength_m;
  }
}

TEST(curves_set_in_code, are_refused_where_their_samples_cannot_be_and_say_which) {
  const Camera good = lit_camera(5, 5, 10);
  Camera camera = good;
  camera.pixel.quantum_efficiency = {{800e-9, 900e-9}, {0.4, 1.2}};
  EXPECT_EQ(refusal(camera), "error: pixel.quantum_efficiency.y[1] is out of range\n  got 1.2, expected 0 to 1");
  camera = good;
  camera.pixel.contrast = {{20e6, 90e6}, {-0.1, 0.7}};
  EXPECT_EQ(refusal(camera), "error: pixel.contrast.y[0] is out of range\n  got -0.1, expected 0 to 1");
  camera = good;
  camera.filter.table = {{800e-9, 900e-9}, {0.4, 1.01}};
  EXPECT_EQ(refusal(camera), "error: filter.table.y[1] is out of range\n  got 1.01, expected 0 to 1");
  camera = good;
  camera.lens.vignetting = Lens::Vignetting::table;
  camera.lens.vignetting_table = {{0, 0.5}, {1, 2.5}};
  EXPECT_EQ(refusal(camera), "error: lens.vignetting_table.y[1] is out of range\n  got 2.5, expected 0 to 2");
}

TEST(vignetting, of_a_table_with_one_sample_is_the_same_everywhere) {
  Camera camera = lit_camera(5, 5, 10);
  camera.lens.vignetting = Lens::Vignetting::off;
  const double off = signal(camera);
  camera.lens.vignetting = Lens::Vignetting::table;
  camera.lens.vignetting_table = {{0.1}, {0.5}};
  EXPECT_NEAR(signal(camera), 0.5 * off, 1e-6 * off);
}
