// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What has to hold of what decoding knows of a specimen.
#include <algorithm>
#include <cmath>
#include <string>

#include "base/calibration.h"
#include "base/readout.h"
#include "base/text.h"
#include "base/units.h"
#include "model/rules.h"

namespace tofray::model {

namespace {

std::string megahertz(double hz) { return base::quantity_text(hz, "1 MHz"); }

void check_pixels(const FrequencyCalibration& one, const base::ImageExtent& image, Complaints& complaints) {
  const std::vector<double>& phases = one.pixel_phase_rad;
  const std::string at = " at " + megahertz(one.modulation_frequency_hz);
  if (one.pixel_phase_file.empty() != phases.empty()) {
    const bool named = phases.empty();
    return complaints.add(
        one, &one.pixel_phase_file,
        (named ? "the pixels' phases" : "the file of the pixels' phases") + at + (named ? " are not here" : " has no name"),
        named ? "got the name of their file alone, " + base::in_quotes(one.pixel_phase_file) +
                    "; set decoding.calibration to the calibration's file"
              : "expected pixel_phase_file, which is all that meta says of them, e.g. \"phases.npy\"");
  }
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (!phases.empty() && phases.size() != pixels)
    complaints.add(one, &one.pixel_phase_file, "the pixels' phases" + at + " are of another image",
                   "got " + std::to_string(phases.size()) + " of them, the image that is read out has " + std::to_string(image.width) +
                       " x " + std::to_string(image.height) + " = " + std::to_string(pixels) + " pixels");
  const auto good = [](double phase) { return std::abs(phase) <= 100; };
  const auto bad = std::find_if_not(phases.begin(), phases.end(), good);
  if (bad != phases.end())
    complaints.add(
        one, &one.pixel_phase_file, "a pixel's phase" + at + " is none",
        "got " + base::number_text(*bad) + " rad of pixel " + std::to_string(bad - phases.begin()) + ", expected -100 to 100 rad");
}

}  // namespace

void wiggling_stays_in_order(const FrequencyCalibration& one, Complaints& complaints) {
  const std::vector<double>&cosines = one.wiggling_cos_rad, &sines = one.wiggling_sin_rad;
  if (cosines.size() != sines.size())
    return complaints.add(one, cosines.size() < sines.size() ? &cosines : &sines, "the wiggling has not as many sines as cosines",
                          "got " + std::to_string(cosines.size()) + " cosines and " + std::to_string(sines.size()) + " sines");
  double slope = 0;
  for (std::size_t i = 0; i < cosines.size(); ++i) slope += static_cast<double>(i + 1) * std::hypot(cosines[i], sines[i]);
  if (!(slope < 1))
    complaints.add(one, &cosines, "the wiggling is so steep that phases may change their order",
                   "got " + base::number_text(slope) + " rad per rad, the sum of all orders; expected less than 1");
}

void calibration_is_of_the_camera(const Camera& camera, Complaints& complaints) {
  const DecoderCalibration& known = camera.decoding.calibration;
  if (known.kind != DecoderCalibration::Kind::specimen) return;
  std::vector<std::string> all;
  for (const FrequencyCalibration& one : known.frequencies) {
    all.push_back(megahertz(one.modulation_frequency_hz));
    if (base::calibration_at(known, one.modulation_frequency_hz) != &one)
      complaints.add(one, &one.modulation_frequency_hz, "the calibration has " + all.back() + " twice",
                     "expected each modulation frequency once");
    check_pixels(one, base::image_extent(camera), complaints);
  }
  for (const RawFrame& frame : camera.mode.sequence)
    if (frame.lit && base::calibration_at(known, frame.modulation_frequency_hz) == nullptr)
      return complaints.add(known, &known.frequencies, "the calibration has no " + megahertz(frame.modulation_frequency_hz),
                            "got " + base::listed(all, "and") + "; the mode" +
                                (camera.mode.name.empty() ? "" : " " + base::in_quotes(camera.mode.name)) + " needs it");
}

}  // namespace tofray::model
