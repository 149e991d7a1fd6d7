// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tofray/camera.h"
#include "tofray/camera_report.h"

/// Where a camera's light goes and what its range noise is made of, as numbers: no scene is needed, and nothing is drawn at random.
namespace tofray {

/// What a budget is asked: one pixel looks at a matt wall, at each of these.
struct BudgetRequest {
  std::vector<double> distances_m;     ///< z of the wall where the pixel sees it, 1e-3 to 1e5; empty: 0.5, 1, 2 and 4 m
  std::vector<double> reflectivities;  ///< reflectivities of the wall, 0 to 1; empty: 0.2 and 0.8
  std::vector<AmbientCase> ambients;   ///< empty: darkness
  double angle_rad = 0;                ///< the wall is turned by this about the camera's y; 0: it faces the camera; below a right angle
  std::optional<double> temperature_celsius;   ///< temperature in place of Temperature::celsius
  std::optional<std::array<double, 2>> pixel;  ///< column and row in the image; none: where the optical axis is
  bool auto_exposure = false;                  ///< exposures as AutoExposure leaves them of that wall; false: those of the mode
};

/// Shares of the range's variance by cause; their sum is 1.                                 [theory: noise-by-cause]
struct VarianceShares {
  double signal_shot = 0;   ///< shot noise of the camera's illumination
  double ambient_shot = 0;  ///< shot noise of ambient light
  double dark_shot = 0;     ///< shot noise of dark charge
  double read = 0;          ///< reset and read noise of both taps
  double adc = 0;           ///< rounding to whole codes
  double suppression = 0;   ///< noise that background suppression adds
  double lines = 0;         ///< noise of columns and rows
};

/// One modulation frequency of a row. Electrons are those of both taps together, in one raw frame.
struct BudgetFrequency {
  double modulation_frequency_hz = 0;
  double integration_time_s = 0;  ///< integration time of one raw frame
  double signal_e = 0;            ///< electrons of the camera's illumination
  double ambient_e = 0;           ///< electrons of ambient light
  double dark_e = 0;              ///< electrons of dark current
  double amplitude_e = 0;         ///< Â, of the taps' difference as it is read
  double contrast = 0;            ///< amplitude over signal
  double sigma_m = 0;             ///< noise of the range by this frequency alone, 1 sigma
};

/// One pixel, one wall: expected values of light, charge and range noise.
struct BudgetRow {
  double z_m = 0;                      ///< z of the wall, along the optical axis
  double range_m = 0;                  ///< along the pixel's ray
  double reflectivity = 0;             ///< reflectivity of the wall
  std::string ambient;                 ///< name of the ambient light
  double exposure = 1;                 ///< longest lit integration time over the mode's own
  double irradiance_w_m2 = 0;          ///< irradiance of the wall by the camera's illumination
  double ambient_irradiance_w_m2 = 0;  ///< irradiance by ambient light of a surface that faces it, in the band of the filter
  double power_w = 0;                  ///< power on the pixel by the camera's illumination, mean of a lit raw frame
  double ambient_power_w = 0;          ///< power on the pixel by ambient light
  double signal_e = 0;                 ///< electrons of the camera's illumination, both taps together, in the raw frame that has most
  double ambient_e = 0;                ///< electrons of ambient light, both taps together, in the raw frame that has most
  double dark_e = 0;                   ///< electrons of dark current, both taps together, in the raw frame that has most
  double contrast = 0;                 ///< mean of the modulation frequencies
  double amplitude_e = 0;              ///< mean of the modulation frequencies, as Depth::amplitude_e
  double tap_filling = 0;              ///< charge of the fuller tap of a lit raw frame over the full well; may be above 1
  double adc_filling = 0;       ///< how far the code is from the middle, over the way to the nearer end of the valid codes; may be above 1
  double sigma_m = 0;           ///< noise of the range, 1 sigma, before filters and means over frames; NaN: there is no range
  double sigma_z_m = 0;         ///< noise of z, 1 sigma, before filters and means over frames; NaN: there is no range
  double noise_estimate_m = 0;  ///< the camera's estimate of sigma_m (Depth::noise_m); NaN: there is no range
  VarianceShares share;         ///< shares of sigma_m squared
  double exponent = 0;          ///< σ grows with the distance to this power: 1 where signal shot noise rules, 2 where all else does
  double wrong_cycle = 0;       ///< probability that the range is whole cycles off; NaN: no range [theory: noisy-phasor, wrong-cycle-share]
  double bias_m = 0;            ///< range without noise less the true one: drift, wiggling, whole ambiguity ranges; NaN: no range
  bool saturated = false;       ///< a lit tap or code is at its end
  bool low_signal = false;      ///< σ is above the decoding's noise threshold, or the amplitude below its own
  bool no_return = false;       ///< nothing comes back
  bool beyond_ambiguity = false;             ///< the wall is farther than the ambiguity range: its range comes out too short
  std::vector<BudgetFrequency> frequencies;  ///< modulation frequencies, in the order in which the sequence first has them
};

/// Rows: ambient by ambient, in each by reflectivity, in each by distance. Their physics is the simulator's own: light and charge are those
/// of a simulated frame without noise, and σ follows of the variance of each raw frame through phase, correction and fusion.
/// Left out are filters, means over frames, multipath, scattered light, crosstalk, patterns and another camera's light.
/// @throws Error as a Simulator of the camera does; (bad_input) for a number out of range, a pixel without a ray, no lit raw frame
std::vector<BudgetRow> budget(const Camera& camera, const BudgetRequest& request = {});

/// How far the camera sees one kind of wall in one light.
struct BudgetReach {
  double reflectivity = 0;
  std::string ambient;
  /// Largest distance at which σ is no more than the decoding's noise threshold, up to 1000 m; 0: nowhere from 1 cm on.
  double reach_m = 0;
  double nearest_m = 0;                         ///< nothing nearer than this is without saturation; 0: nothing saturates from 1 cm on
  static constexpr double everywhere_m = 1000;  ///< value of nearest_m that means: it saturates at all distances
};

/// The part of a budget that does not depend on the distance.
struct BudgetSummary {
  double ambiguity_range_m = 0;
  double low_signal_m = 0;            ///< the decoding's noise threshold
  std::vector<BudgetReach> reach;     ///< ambient by ambient, in each by reflectivity
  double energy_per_frame_j = 0;      ///< optical, of all lit raw frames
  double mean_power_w = 0;            ///< energy_per_frame_j times the frame rate
  double radiant_intensity_w_sr = 0;  ///< toward what the pixel sees, mean of a lit raw frame, from 10 m
  double noise_at_1_m_m = 0;          ///< noise-equivalent distance: σ of a white wall (100 %) at 1 m in the dark; NaN: no range there
  double correlated_e_per_j = 0;      ///< amplitude per joule of the camera's illumination on the pixel, mean of the modulation frequencies
  double uncorrelated_e_per_j = 0;    ///< offset of the taps' difference per joule of light of that wavelength without modulation
  std::optional<double> rejection;    ///< background-light rejection ratio: the one over the other; none: nothing is off
};

/// @throws Error as budget() does
BudgetSummary budget_summary(const Camera& camera, const BudgetRequest& request = {});

/// A range noise that is asked for, of one wall.
struct BudgetNeed {
  double sigma_m = 0;
  double z_m = 0;
  double reflectivity = 0;
  AmbientCase ambient;
};

/// The number that was looked for.
struct BudgetSolution {
  bool reached = false;  ///< false: none of the numbers makes σ what is needed
  double value = 0;      ///< not reached: the one that comes nearest, if any has a range noise
  BudgetRow row;         ///< the budget with that number
  std::string why;       ///< not reached: what σ comes to, and what stands in the way, with figures
};

/// Finds a number of the camera with which σ is what is needed: by powers of two about a first guess, then by halving.
/// @param camera_of  the camera with that number; may throw an Error where there cannot be one
/// @param guess      where to begin, not 0
/// @param low, high  of the number, both included
/// @param request    its angle, temperature, pixel and auto_exposure hold; distances, reflectivities and light are the need's
/// @throws Error (bad_input) for a need, a guess or a range that cannot be, and as budget() does
BudgetSolution solve_budget(const std::function<Camera(double)>& camera_of, double guess, double low, double high, const BudgetNeed& need,
                            const BudgetRequest& request = {});

}  // namespace tofray
