// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tofray/camera.h"
#include "tofray/frame.h"
#include "tofray/scene.h"
#include "tofray/simulator.h"

/// One pixel of a frame: its way from light to depth, number by number, and which light bounced how often.
namespace tofray {

/// A frame's arrays, wherever they lie. They must stay there as long as this is used.
struct PixelArrays {
  int width = 0, height = 0, phases = 0;
  /// An array by its name in files, and an element of it in row-major order → its value; NaN where there is no such array or element.
  std::function<double(std::string_view name, std::size_t element)> at;
};
/// The arrays of a frame in memory.
PixelArrays pixel_arrays(const Frame& frame);

/// One pixel in one raw frame.
struct ChainRawFrame {
  bool lit = false;
  double modulation_frequency_hz = 0, reference_phase_rad = 0, integration_time_s = 0;
  double signal_e = 0;                  ///< ground truth S, both taps
  double direct_e = 0, indirect_e = 0;  ///< electrons by one surface and by several, before the lens scatters them
  double multipath_m = 0;               ///< what that does to the half path            [theory: multipath-error]
  double path_noise_m = 0;              ///< the standard error of that                       [theory: path-noise]
  double tap_a_e = 0, tap_b_e = 0;
  double code_dn = 0;
  double difference_e = 0;  ///< D_k that depth comes from: out of the code, or unrounded where noise is off
};

/// One pixel's phase at one modulation frequency.
struct ChainPhase {
  double modulation_frequency_hz = 0;
  double amplitude_e = 0;       ///< |Z|                                           [theory: phase-estimate]
  double measured_turns = 0;    ///< arg Z / 2 pi, with the wiggling in it [turns]
  double calibrated_turns = 0;  ///< with the wiggling and the pixel's delay taken out [turns]  [theory: wiggling-correction]
  double half_wave_m = 0;       ///< R, the unambiguous half path               [theory: half-path]
  double cycles = 0;            ///< whole cycles that unwrapping added [1]
  double half_path_m = 0;       ///< R (cycles + turns)
  double noise_e = 0;           ///< 1 sigma of each part of Z, as the camera estimates it  [theory: noise-estimate]
};

/// One way to unwrap: a cycle of the modulation frequency with the fewest, and of each other one the half path nearest to it.
struct UnwrapCandidate {
  std::vector<double> cycles;  ///< whole cycles of each of the chain's phases [1]
  double range_m = 0;          ///< that they mean                                  [theory: fusion, range-and-z]
  double cost_m2 = 0;          ///< sum of the squares of how far the other half paths are off [m2] [theory: unwrapping]
  bool chosen = false;         ///< its cost is the least: what unwrapping takes
};

/// One pixel's way from light to depth. What the arrays do not have is NaN or empty.
struct PixelChain {
  int u = 0, v = 0;
  // ground truth
  std::int64_t object = -1;
  double true_range_m = 0, true_z_m = 0;
  double reflectivity = 0;  ///< reflectivity of the surface [1]
  double incidence_rad = 0;
  double object_share = 0, mixed = 0;  ///< truth of samples within the pixel [1]
  std::array<double, 3> position_m{};
  std::array<double, 3> normal{};  ///< normal of unit length [1]
  double irradiance_w_m2 = 0;      ///< irradiance on the surface [W/m2]
  double radiance_w_m2_sr = 0;     ///< radiance back from it [W/(m2 sr)]
  double power_w = 0;              ///< power on the pixel
  // measured
  std::vector<ChainRawFrame> raw_frames;
  std::vector<ChainPhase> phases;  ///< one for each modulation frequency
  /// Of all cycles, by cost, the one chosen first; empty where there is one modulation frequency, no phase or no camera.
  std::vector<UnwrapCandidate> candidates;
  double range_m = 0, z_m = 0, noise_m = 0, noise_threshold_m = 0, amplitude_e = 0, ambient_e = 0;
  double confidence = 0;  ///< 0 to 255 [1]
  std::array<double, 3> point_m{};
  int flags = 0;  ///< bits of Flag
};

/// @param camera      that made the frame; none: phases are estimated without its calibration, and nothing is unwrapped
/// @param noise_free  whether the frame has expected values (Noise::off): depth comes from the unrounded taps then
/// @param where       what messages call the arrays: a file
/// @throws Error (bad_input) where the pixel is outside the image, there is no image, or the camera is of another size or sequence
PixelChain pixel_chain(const PixelArrays& arrays, const Camera* camera, bool noise_free, int u, int v,
                       const std::string& where = "the frame");
/// One pixel of a frame that a camera made.
PixelChain pixel_chain(const Frame& frame, const Camera& camera, int u, int v, Noise noise = Noise::exact);

/// What the samples of a pixel lie on: A−B over the reference phase τ, at each of the chain's modulation frequencies,
///
///     D(τ) = o + S Σ_m a_m cos(m (τ + φ) + ψ_m)                                              [theory: correlation]
///
/// with the camera's harmonics (a_m, ψ_m), S and φ such that it has the phasor that was measured [theory: phase-estimate], and o the mean
/// of what the samples are off. Light of several paths, a bent read-out and wells that are full have other curves; this is the nearest to
/// theirs.
/// @param points  evenly spaced over a turn, from 0 on
/// @return [phase][point] e; NaN where there is no phase
/// @throws Error (bad_input) where the camera has another sequence
std::vector<std::vector<double>> correlation_curves(const PixelChain& chain, const Camera& camera, int points = 64);

/// Light that came by way of 1 + b surfaces, b = first … last.
struct BounceShare {
  int first = 0, last = 0;
  double share = 0;                 ///< share of the electrons of all lit raw frames, 0 … 1 [1]
  std::vector<double> electrons;    ///< electrons by raw frame, before the lens scatters them [e]
  std::vector<double> multipath_m;  ///< by raw frame: what it adds to the half path once all before it are there [m]
                                    ///<                                                                       [theory: multipath-error]
};

/// One pixel's light, bounce by bounce. Light paths are chosen by pixel, bounce and sample alone, so that frames with fewer bounces follow
/// the beginnings of the same paths: what a bounce adds is the difference of two frames, without Monte Carlo error between them.
struct PixelBounces {
  std::vector<BounceShare> shares;  ///< direct light first; together gt_direct_e + gt_indirect_e and gt_multipath_m; may be empty
  std::string unknown;              ///< why it is empty although light bounced
};

/// Simulates with one bounce, two, …, until less than 1/1000 of the pixel's light is left; the last element has the rest. Frame number b
/// takes b/B of the time that the frame with its B bounces took. Empty where no light bounced, or where the arrays do not have it.
/// @param index      of the frame, of `scene` by `camera` with `simulated`
/// @param each_done  where not empty: called after each frame
PixelBounces pixel_bounces(const PixelArrays& arrays, std::uint64_t index, const Scene& scene, const Camera& camera,
                           const SimulatorOptions& simulated, int u, int v, const std::function<void()>& each_done = {});
/// Whether any light of the pixel bounced, and the arrays know how it bends the half path.
bool has_bounces(const PixelArrays& arrays, int u, int v);

}  // namespace tofray
