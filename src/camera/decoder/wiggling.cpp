// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/decoder/wiggling.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/constants.h"
#include "base/faults.h"
#include "base/shared.h"
#include "num/setup_math.h"
#include "tofray/error.h"

namespace tofray::camera {

namespace {

namespace setup = num::setup;
using base::two_pi;

std::complex<double> unit(double angle_rad) { return {setup::cos(angle_rad), setup::sin(angle_rad)}; }

/// The forward curve φ̂(φ) = φ + ε(φ) on a grid over one period, proved to grow.
struct Forward {
  std::vector<double> phase, measured;  // [rad], both ascending; measured spans exactly one period
};

Forward sample(const PhaseResponse& response, int highest_order, int nodes) {
  const int count = std::max(nodes, 64 * highest_order);
  Forward forward;
  for (int i = 0; i <= count; ++i) {
    const double phase = two_pi * i / count;
    const PhaseResponse::Value value = response.at(phase);
    forward.phase.push_back(phase);
    forward.measured.push_back(phase + value.error_rad);
    const bool grows = i == 0 || forward.measured[static_cast<std::size_t>(i)] > forward.measured[static_cast<std::size_t>(i) - 1];
    if (!(value.slope > 0) || !grows)
      base::refuse("the measured phase does not grow with distance throughout, so that no wiggling table can be made\n  near a phase of " +
                   std::to_string(phase) + " rad; the higher harmonics are too strong for these reference phases");
  }
  return forward;
}

/// The phase between `low` and `high` whose measured phase is `target`: Newton, with bisection where that would leave the bracket.
double solve(const PhaseResponse& response, double target, double low, double high) {
  double phase = 0.5 * (low + high);
  for (int step = 0; step < 60; ++step) {
    const PhaseResponse::Value value = response.at(phase);
    const double excess = phase + value.error_rad - target;
    (excess > 0 ? high : low) = phase;
    double next = phase - excess / value.slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double moved = std::fabs(next - phase);
    phase = next;
    if (moved < 1e-15) break;
  }
  return phase;
}

}  // namespace

PhaseResponse::PhaseResponse(const std::vector<Harmonic>& harmonics, const std::vector<double>& reference_phases_rad) {
  const auto n = static_cast<double>(reference_phases_rad.size());
  if (n < 3) base::refuse("a phase needs at least 3 reference phases\n  got " + std::to_string(reference_phases_rad.size()));
  std::complex<double> first{0, 0};
  for (const Harmonic& h : harmonics) {
    std::complex<double> forward{0, 0}, backward{0, 0};
    for (const double tau : reference_phases_rad) {
      forward += unit((h.order - 1) * tau);
      backward += unit(-(h.order + 1) * tau);
    }
    const std::complex<double> wave = h.amplitude * unit(h.phase_rad);
    leaks_.push_back({h.order, wave * forward / n, std::conj(wave) * backward / n});
    if (h.order == 1) first = wave;
  }
  if (first == std::complex<double>{0, 0}) base::refuse("a waveform without its first harmonic measures no phase");
  offset_ = setup::atan2(first.imag(), first.real());
  turn_back_ = unit(-offset_);
}

PhaseResponse::Value PhaseResponse::at(double phase_rad) const {
  std::complex<double> z{0, 0}, derivative{0, 0};  // derivative: (1/i)·dẐ/dφ
  for (const Leak& leak : leaks_) {
    const std::complex<double> turn = unit(leak.order * phase_rad);
    const std::complex<double> forward = leak.forward * turn;
    const std::complex<double> backward = leak.backward * std::conj(turn);
    z += forward + backward;
    derivative += static_cast<double>(leak.order) * (forward - backward);
  }
  // Turned back by φ and ψ_1, the phasor stays near the positive real axis: its angle has no jump.
  const std::complex<double> rest = z * std::conj(unit(phase_rad)) * turn_back_;
  const double square = std::norm(z);
  return {offset_ + setup::atan2(rest.imag(), rest.real()), (derivative * std::conj(z)).real() / square, std::sqrt(square)};
}

WigglingTable wiggling_table(const std::vector<Harmonic>& harmonics, const std::vector<double>& reference_phases_rad, int nodes) {
  if (nodes < 2) base::refuse("a wiggling table needs at least 2 nodes\n  got " + std::to_string(nodes));
  const PhaseResponse response(harmonics, reference_phases_rad);
  int highest_order = 1;
  for (const Harmonic& h : harmonics) highest_order = std::max(highest_order, h.order);
  const Forward forward = sample(response, highest_order, nodes);

  WigglingTable out;
  for (int j = 0; j < nodes; ++j) {
    // Bring the node into the period that the samples span, and find its two neighbours.
    const double node = two_pi * j / nodes;
    const double start = forward.measured.front();
    const double target = node - two_pi * std::floor((node - start) / two_pi);
    const auto right = std::upper_bound(forward.measured.begin() + 1, forward.measured.end() - 1, target);
    const auto i = static_cast<std::size_t>(right - forward.measured.begin());
    const double phase = solve(response, target, forward.phase[i - 1], forward.phase[i]);
    out.correction.push_back((phase - target) / two_pi), out.amplitude.push_back(response.at(phase).amplitude);
  }
  return out;
}

namespace {

struct WigglingKey {
  std::vector<Harmonic> harmonics;
  std::vector<double> reference_phases_rad;
  int nodes;
  bool operator==(const WigglingKey&) const = default;
};

}  // namespace

std::shared_ptr<const WigglingTable> shared_wiggling_table(const std::vector<Harmonic>& harmonics,
                                                           const std::vector<double>& reference_phases_rad, int nodes) {
  return base::shared<WigglingKey, WigglingTable>().get(
      {harmonics, reference_phases_rad, nodes}, [&] { return wiggling_table(harmonics, reference_phases_rad, nodes); },
      [](const WigglingTable& made) { return (made.correction.size() + made.amplitude.size()) * sizeof(double); });
}

}  // namespace tofray::camera
