// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/pixel/other_camera.h"

#include <cmath>

#include "base/constants.h"
#include "num/setup_math.h"

namespace tofray::camera {

using base::pi;
namespace setup = num::setup;
using num::single;

OtherLight other_light(const Interference& other, double middle_s, const num::Random4<float>* drawn) {
  const bool known = other.phase_rad.has_value();
  // Its phase falls behind that of the own gate by a turn with each period of the difference; of many turns the fraction is what counts.
  const double passed = other.frequency_difference_hz * middle_s;
  const double phase = known ? *other.phase_rad - 2 * pi * (passed - std::floor(passed)) : 0;
  if (drawn == nullptr) return {other.share * other.active, known ? other.share * other.active : 0, phase};
  const double of_chance = static_cast<double>(num::uniform<float>(drawn->w[0]));
  const double share = static_cast<double>(num::uniform<float>(drawn->w[1])) < other.active ? other.share : 0;
  return {share, share, known ? phase : 2 * pi * of_chance};
}

namespace {

/// What is left of a cosine's mean over so many turns.
double mean_over(double turns) { return turns == 0 ? 1.0 : setup::sin(pi * turns) / (pi * turns); }

}  // namespace

void write_other_gate(const OtherLight& light, double turns, double phase, int orders, float* gate) {
  for (int h = 0; h < orders; ++h) {
    const int m = 2 * h + 1;
    const double left = light.swing * mean_over(m * turns), angle = m * (phase + light.phase_rad);
    gate[2 * h] = single(left * setup::cos(angle)), gate[2 * h + 1] = single(left * setup::sin(angle));
  }
}

}  // namespace tofray::camera
