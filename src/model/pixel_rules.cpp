// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What has to hold between the numbers of the pixel, the waveform and their temperature.
#include <algorithm>
#include <cmath>
#include <string>

#include "base/constants.h"
#include "base/curve.h"
#include "base/periodic.h"
#include "base/text.h"
#include "model/rules.h"

namespace tofray::model {

using base::number_text;

namespace {
constexpr double most_even = 0.01;  // of even harmonics beside the odd ones
}

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

void gains_are_those_of_the_adc(const Camera& camera, Complaints& complaints) {
  const std::vector<double>& gains = camera.adc.gains;
  const double gain = camera.mode.gain, step = camera.adc.step_e_per_dn / gain;
  const auto complain = [&](const std::string& what, const std::string& more) {
    complaints.add(camera.mode, &camera.mode.gain, what, more);
  };
  std::string known;
  for (const double one : gains) known += (known.empty() ? "" : ", ") + number_text(one);
  if (gains.empty() ? gain != 1 : std::find(gains.begin(), gains.end(), gain) == gains.end())
    return complain(
        "the ADC does not have the mode's gain",
        "got " + number_text(gain) + ", expected " + (known.empty() ? "1, since adc.gains is not given" : "one of adc.gains: " + known));
  if (!(step >= 1e-6 && step <= 1e9))
    complain("the step of the mode's gain is none that an ADC has",
             "got " + number_text(step) + " e/DN, adc.step over the gain; expected 1e-06 e/DN to 1e+09 e/DN");
}

void cameras_make_sense(const Camera& camera, Complaints& complaints) {
  cameras_are_within_the_limits(camera, complaints);
  dark_current_stays_one(camera, complaints);
  gains_are_those_of_the_adc(camera, complaints);
  something_is_read(camera, complaints);
  exposures_fit(camera, complaints);
  calibration_is_of_the_camera(camera, complaints);
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
  if (charge.back() < 1) return complain("the nonlinearity ends below 1 e", "got " + number_text(charge.back()) + " e");
  // What no line of the kernels' table can follow would be gone without a word.                       [theory: nonlinearity]
  const double end = std::min(charge.back(), pixel.full_well_e), cell = end / base::read_cells;
  for (std::size_t i = 1; i < charge.size() && charge[i - 1] < end; ++i)
    if (charge[i] - charge[i - 1] < cell * (1 - 1e-9))
      return complain("samples of the nonlinearity are closer than the lines that stand for it",
                      "got " + number_text(charge[i - 1]) + " e, then " + number_text(charge[i]) + " e, of " +
                          std::to_string(base::read_cells) + " lines up to " + number_text(end) + " e; put them at least " +
                          number_text(cell) + " e apart, or end the curve (or full_well) sooner");
}

namespace {
/// Of the period's samples: where they are.
bool phases_are_sound(const Waveform& waveform, const std::vector<double>& samples, Complaints& complaints) {
  const std::vector<double>& phases = waveform.sample_phases_rad;
  const auto complain = [&](const std::string& what, const std::string& more) {
    complaints.add(waveform, &phases, what, more);
    return false;
  };
  if (phases.empty()) return true;
  if (phases.size() != samples.size())
    return complain("there are not as many phases as samples",
                    "got " + std::to_string(phases.size()) + " phases of " + std::to_string(samples.size()) + " samples");
  for (std::size_t i = 1; i < phases.size(); ++i)
    if (!(phases[i] > phases[i - 1]))
      return complain("the phases of the samples do not ascend",
                      "got " + number_text(phases[i]) + " rad after " + number_text(phases[i - 1]) + " rad");
  const double span = phases.back() - phases.front();
  if (!(span < base::two_pi))
    return complain("the phases of the samples reach over more than a period",
                    "got " + number_text(span) + " rad from the first to the last; the period's end is the first sample again");
  return true;
}

/// Of a measured correlation, beside the odd ones. A gate that is open for half the period has none: what a pixel shows of them, this model has
/// not.                                                                                             [theory: even-harmonics]
double even_harmonics_of(const Waveform& waveform) {
  const std::vector<double>& measured = waveform.correlation;
  if (waveform.sample_phases_rad.empty() && measured.size() % 2 == 0) return base::even_share(measured);
  const std::vector<double> even = base::over_a_period(waveform.sample_phases_rad, measured);
  const std::vector<double>& equal = waveform.sample_phases_rad.empty() ? measured : even;
  const auto most = 2 * static_cast<std::size_t>(waveform.harmonics);
  return std::min(base::even_share(even),
                  base::even_share_of_few(equal, measured.size(), most));  // a spline of few samples may know better
}
}  // namespace

void samples_carry_their_harmonics(const Waveform& waveform, Complaints& complaints) {
  const bool correlation = waveform.kind == Waveform::Kind::measured;
  if (!correlation && waveform.kind != Waveform::Kind::emission) return;
  const std::vector<double>& samples = correlation ? waveform.correlation : waveform.emission;
  const std::string what = correlation ? "the correlation" : "the emission";
  const auto complain = [&](const std::string& fault, const std::string& more) { complaints.add(waveform, &samples, fault, more); };
  double largest = 0;
  for (const double sample : samples) largest = std::max(largest, std::abs(sample));
  if (!(largest > 0)) complain(what + " is nowhere above 0", correlation ? "expected (A-B)/(A+B)" : "expected light");
  const int needed = 2 * (2 * waveform.harmonics - 1);  // harmonic m needs more than 2 m samples
  if (static_cast<long long>(samples.size()) <= needed)
    return complain("too few samples of " + what + " for its harmonics",
                    "got " + std::to_string(samples.size()) + " samples, expected more than " + std::to_string(needed) + " for " +
                        std::to_string(waveform.harmonics) + " odd harmonics");
  if (!phases_are_sound(waveform, samples, complaints) || !correlation || !(largest > 0)) return;
  const double of_odd_ones = even_harmonics_of(waveform);
  if (!(of_odd_ones > most_even)) return;
  const bool opposite = waveform.sample_phases_rad.empty() && samples.size() % 2 == 0;
  complain("the correlation has even harmonics, which the pixel's model has not",
           "got " + number_text(std::round(1e4 * of_odd_ones) / 100) + " % of the odd ones, at most 1 %; " +
               (opposite ? "put (D(t) - D(t + 180 deg))/2 in the place of D(t)"
                         : "measure at an even number of equally spaced phases and put (D(t) - D(t + 180 deg))/2 in the place of D(t)") +
               " where they may be left out, which for an even number of reference phases they are in the camera, too");
}

}  // namespace tofray::model
