// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/calibration.h"
#include "base/constants.h"
#include "camera/decoder/wiggling.h"
#include "camera/frozen_camera.h"
#include "tofray/error.h"
#include "tofray/pixel.h"

namespace tofray {

namespace {

using Harmonics = std::vector<camera::Harmonic>;

double correlation(const Harmonics& harmonics, double phase_rad) {
  double out = 0;
  for (const camera::Harmonic& h : harmonics) out += h.amplitude * std::cos(h.order * phase_rad + h.phase_rad);
  return out;
}

/// A table of equidistant nodes over a turn, on a straight line between them.
double at_turns(const std::vector<double>& table, double turns) {
  const double place = (turns - std::floor(turns)) * static_cast<double>(table.size()), part = place - std::floor(place);
  const std::size_t node = static_cast<std::size_t>(place) % table.size();
  return (1 - part) * table[node] + part * table[(node + 1) % table.size()];
}

}  // namespace

std::vector<std::vector<double>> correlation_curves(const PixelChain& chain, const Camera& profile, int points) {
  constexpr int most_points = 100'000;
  if (points < 1 || points > most_points) throw Error(ErrorKind::bad_input, "error: expected 1 to 100000 points of a correlation curve");
  if (profile.mode.sequence.size() != chain.raw_frames.size())
    throw Error(ErrorKind::bad_input, "error: the camera has another sequence of raw frames than the pixel");
  const camera::FrozenCamera frozen(base::with_offsets(profile), false, 0);
  const camera::DecoderView& d = frozen.decoder();
  std::vector<std::vector<double>> out;
  for (std::size_t i = 0; i < chain.phases.size(); ++i) {
    const camera::DecodeModulation& m = d.modulation[i];
    const Harmonics harmonics = frozen.mean_harmonics(i);
    const auto sample = [&](int j) -> const ChainRawFrame& { return chain.raw_frames[static_cast<std::size_t>(m.raw_frame[j])]; };
    std::vector<double> tau;
    for (int j = 0; j < m.count; ++j)
      tau.push_back(camera::reference_phase_of(profile.mode.sequence[static_cast<std::size_t>(m.raw_frame[j])]));
    const camera::WigglingTable table = camera::wiggling_table(harmonics, tau);
    const double measured = chain.phases[i].measured_turns, none = std::nan("");
    const double signal = std::isfinite(measured) ? chain.phases[i].amplitude_e / at_turns(table.amplitude, measured) : none;
    const double phase = std::isfinite(measured) ? base::two_pi * (measured + at_turns(table.correction, measured)) : none;
    double offset = 0;
    for (int j = 0; j < m.count; ++j) offset += (sample(j).difference_e - signal * correlation(harmonics, tau[j] + phase)) / m.count;
    std::vector<double>& curve = out.emplace_back();
    for (int p = 0; p < points; ++p) curve.push_back(offset + signal * correlation(harmonics, base::two_pi * p / points + phase));
  }
  return out;
}

}  // namespace tofray
