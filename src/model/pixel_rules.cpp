// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What has to hold between the numbers of the pixel, the waveform and their temperature.
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "model/rules.h"

namespace tofray::model {

using base::number_text;

namespace {
/// Dark current of the temperature: i·2^((T − T_ref)/d), bounded from above without a logarithm: 2^u ≤ (1 + u − ⌊u⌋)·2^⌊u⌋.
void dark_current_stays_one(const Camera& camera, Complaints& complaints) {
  const Pixel& pixel = camera.pixel;
  if (pixel.dark_current_doubling_k == 0 || pixel.dark_current_e_per_s == 0) return;
  const double warmer = camera.temperature.celsius - camera.temperature.reference_celsius;
  const double doublings = std::min(warmer / pixel.dark_current_doubling_k, 1e3), whole = std::floor(doublings);
  if (!(std::ldexp(pixel.dark_current_e_per_s * (1 + doublings - whole), static_cast<int>(std::max(whole, -1e3))) > 1e12)) return;
  complaints.add(pixel, &pixel.dark_current_doubling_k, "the dark current is more than any camera has",
                 "got " + number_text(pixel.dark_current_e_per_s) + " e/s, doubled every " + number_text(pixel.dark_current_doubling_k) +
                     " K over " + number_text(warmer) + " K; expected at most 1e12 e/s at the camera's temperature");
}
}  // namespace

void cameras_make_sense(const Camera& camera, Complaints& complaints) {
  cameras_are_within_the_limits(camera, complaints);
  dark_current_stays_one(camera, complaints);
}

void what_is_read_rises_with_the_charge(const Pixel& pixel, Complaints& complaints) {
  const std::vector<double>&charge = pixel.nonlinearity.x, &read = pixel.nonlinearity.y;
  if (charge.empty()) return;
  constexpr double steepest = 10;  // single precision carries what comes of it
  const auto complain = [&](const std::string& what, const std::string& more) { complaints.add(pixel, &charge, what, more); };
  if (charge.size() < 2) return complain("the nonlinearity has one sample", "expected two at least, the first at 0 e");
  if (charge.front() != 0 || read.front() != 0)
    return complain("the nonlinearity does not begin at 0 e",
                    "got " + number_text(read.front()) + " e read of " + number_text(charge.front()) + " e; begin with 0 e of 0 e");
  for (std::size_t i = 1; i < charge.size(); ++i) {
    const double rise = read[i] - read[i - 1], run = charge[i] - charge[i - 1];
    if (!(rise > 0) || rise > steepest * run)
      return complain("what is read does not rise with the charge as it should",
                      "got " + number_text(read[i - 1]) + " e, then " + number_text(read[i]) + " e at a charge of " +
                          number_text(charge[i]) + " e; expected more than before, by at most 10 e for each electron");
  }
  if (charge.back() < 1) complain("the nonlinearity ends below 1 e", "got " + number_text(charge.back()) + " e");
}

}  // namespace tofray::model
