// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tofray/scene.h"

/// The camera profile: lens, light sources, pixel, ADC, sequence and decoding. SI units throughout.
namespace tofray {

/// A function of one variable given by samples; a not-a-knot cubic spline goes through them, limited so that it turns only at samples.
struct Curve {
  std::vector<double> x;  ///< ascending [any unit]
  std::vector<double> y;  ///< one for each [any unit]
  bool operator==(const Curve&) const = default;
};

/// Where within a pixel light is collected, for samples within it (SimulatorOptions::subpixel).
struct PixelMask {
  enum class Kind { square, table };
  Kind kind = Kind::square;          ///< square: evenly in a square of area fill_factor·pitch² in its middle
  std::vector<double> samples = {};  ///< table: sensitivity over the whole pixel, any unit; rows from the top, columns from the left
  int columns = 0, rows = 0;
};

/// The pixel array.
struct Sensor {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  double pixel_pitch_m = 0;
  double fill_factor = 1;  ///< 0…1
  PixelMask mask = {};
};

/// Light that lens and filter scatter over the sensor before it is collected: (1 − share)·δ + share·K, ΣK = 1.
struct Scatter {
  enum class Kind { none, gaussians, kernel };
  Kind kind = Kind::none;
  double share = 0;                   ///< 0…1 of the light that is scattered
  std::vector<double> sigma_px = {};  ///< gaussians: standard deviation of each
  std::vector<double> weights = {};   ///< gaussians: weight of each, any unit; empty: equal
  /// kernel: weights, any unit, rows from the top, columns from the left; odd numbers of both. The middle is the pixel itself.
  std::vector<double> kernel = {};
  int columns = 0, rows = 0;
  bool operator==(const Scatter&) const = default;
};

/// Pinhole with distortion, OpenCV's conventions (theory 1); pixel (0,0)'s centre is at (0.0, 0.0).
struct Lens {
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  /// brown_conrady: radial (1 + k1r² + k2r⁴ + k3r⁶)/(1 + k4r² + k5r⁴ + k6r⁶), r = tan θ, and tangential p1, p2.
  /// fisheye: radius θ(1 + k1θ² + k2θ⁴ + k3θ⁶ + k4θ⁸), and nothing else.
  enum class Distortion { brown_conrady, fisheye };
  Distortion distortion = Distortion::brown_conrady;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0, k4 = 0, k5 = 0, k6 = 0;
  double f_number = 1;
  double transmission = 1;  ///< T, 0…1, lens and filter at the illumination wavelength
  enum class Vignetting { cos4, off, table };
  Vignetting vignetting = Vignetting::cos4;
  Curve vignetting_table;  ///< angle to the optical axis [rad] → factor
  Scatter scatter = {};
  bool operator==(const Lens&) const = default;
};

/// Optical filter before the sensor, for ambient light only (the camera's illumination has Lens::transmission).
struct Filter {
  double center_m = 850e-9;
  double half_width_m = 15e-9;  ///< passes centre ± half width, transmission `peak`
  double peak = 1;
  Curve table;  ///< wavelength [m] → transmission; takes the place of the above where not empty
};

/// How light of one source is spread over directions; integral over the sphere is 1 (theory 2.1).
struct Pattern {
  enum class Kind { cone, lambertian, cosine_lobe, flat_top, table };
  Kind kind = Kind::lambertian;
  double half_angle_rad = 0;  ///< cone
  double exponent = 1;        ///< cosine_lobe: cos^exponent
  double width_rad = 0;       ///< flat_top: full width across θx at half its peak
  double height_rad = 0;      ///< flat_top: across θy
  /// table: samples over θx (columns) and θy (rows), cell centres on a regular grid centred on the axis, f-theta. Of a flat top, only
  /// the paper's printed formula reads such a grid; 0: 172 × 168.
  int columns = 0, rows = 0;
  /// The grid covers ±this across its columns (edges of the outer cells); beyond, the light is dark. Of a flat top, 0 takes its width,
  /// where the light has fallen to nothing (2⁻²⁵⁶).
  double half_range_x_rad = 0;
  double half_range_y_rad = 0;  ///< half range across its rows; 0: the height
  std::vector<double> samples;  ///< [rows][columns], any unit
  bool operator==(const Pattern&) const = default;
};

/// Light modulation over one period (theory 3).
struct Waveform {
  enum class Kind { rectangular, sine, measured, trapezoid, gaussian, emission };
  Kind kind = Kind::rectangular;
  double duty = 0.5;            ///< width at half height over the period
  double rise_time_s = 0;       ///< linear edge, 0 to 100 %; of a rectangular pulse both
  double bandwidth_hz = 0;      ///< single pole of the light source; 0: none
  double jitter_s = 0;          ///< Gaussian, 1 sigma
  int harmonics = 4;            ///< number of odd harmonics that are kept (1,3,5,7); a sine has one
  double modulation_depth = 1;  ///< sine: d of the light 1 + d·cos; it has no duty and no edges
  /// measured: correlation D(τ)/S at reference phases over one period, φ = 0; its Fourier transform gives a_m, ψ_m.
  std::vector<double> correlation = {};
  // of the kinds that came later
  double fall_time_s = 0;  ///< trapezoid: linear edge at the pulse's end
  double sigma_s = 0;      ///< gaussian: width of the pulse, 1 sigma
  /// emission: the light itself over one period, any unit, from the middle of what would be a rectangular pulse on.
  std::vector<double> emission = {};
  /// measured, emission: at which phases of the period the samples are, ascending within one turn; empty: equally spaced from 0 on.
  std::vector<double> sample_phases_rad = {};
};

/// Where the light of a source comes out: at a point, or evenly all over a disk or rectangle across its axis. So many points at fixed
/// places stand for that, in equal shares (theory 2.1).
struct Area {
  enum class Kind { none, disk, rectangle };
  Kind kind = Kind::none;
  double radius_m = 0;  ///< disk
  double width_m = 0;   ///< rectangle: toward the camera's x (of an axis along x: its y)
  double height_m = 0;  ///< rectangle: across width and axis
  int points = 16;
};

/// One of the camera's light sources, in the camera frame.
struct Illumination {
  Vec3 position{0, 0, 0};
  Vec3 axis{0, 0, 1};
  double illumination_wavelength_m = 850e-9;
  double power_w = 0;        ///< optical, of a lit raw frame, mean over the modulation period
  int ring_leds = 1;         ///< number of sources, evenly on a circle about `position`, across `axis`; they share the power
  double ring_radius_m = 0;  ///< radius of the circle; the first source is toward the camera's x (of an axis along x: its y)
  Area area;                 ///< area of each source; its middle is where a point would be
  Pattern pattern;           ///< pattern of each point
  Waveform waveform;
};

/// The two-tap pixel (theory 3). Electrons per tap where nothing else is said.
struct Pixel {
  Curve quantum_efficiency;             ///< wavelength [m] → QE; one sample: a constant
  Curve contrast;                       ///< modulation frequency [Hz] → K; one sample: a constant
  Curve contrast_by_wavelength = {};    ///< wavelength [m] → factor on K; none: 1
  double bandwidth_hz = 0;              ///< single pole of the gate; 0: none
  double full_well_e = 1e30;            ///< full-well capacity of a tap
  double read_noise_e = 0;              ///< noise of reset and readout per tap, 1 sigma; reset noise alone may stand in reset_noise_e
  double column_noise_e = 0;            ///< noise of A−B that all pixels of a column share, drawn for each raw frame, 1 sigma
  double row_noise_e = 0;               ///< noise of A−B that all pixels of a row share, drawn for each raw frame, 1 sigma
  double dark_current_e_per_s = 0;      ///< dark current per tap at Temperature::reference_celsius
  double dark_current_doubling_k = 0;   ///< temperature rise that doubles the dark current; 0: it is constant
  double tap_gain_mismatch = 0;         ///< g: tap A collects 1 + g/2 of what it should, tap B 1 − g/2
  double tap_offset_mismatch_e = 0;     ///< offset of tap A less that of tap B in each raw frame
  double crosstalk_left_right = 0;      ///< share of a pixel's charge that each of the neighbours left and right collects
  double crosstalk_up_down = 0;         ///< share of a pixel's charge that each of the neighbours above and below collects
  Curve nonlinearity = {};              ///< charge of a tap [e⁻] → charge that is read of it; none: the same
  double prnu = 0;                      ///< photo response non-uniformity, 1 sigma, relative
  double dsnu_dn = 0;                   ///< offset pattern, 1 sigma [DN]
  double delay_s = 0;                   ///< fixed-pattern delay per pixel, 1 sigma
  double phase_offset_rad = 0;          ///< fixed-pattern phase per pixel, another one at each modulation frequency, 1 sigma
  unsigned long long pattern_seed = 1;  ///< seed of the fixed patterns: which specimen of the sensor
  /// Background suppression: when the smaller tap reaches the threshold, the excess is taken off both taps, at most `budget`.
  /// Each tap's removed charge x adds a variance of noise_factor² · x. Threshold 0: no suppression.
  double suppression_threshold_e = 0;
  double suppression_budget_e = 0;
  double suppression_noise_factor = 1;
  double reset_noise_e = 0;          ///< reset (kTC) noise per tap at Temperature::reference_celsius, 1 sigma, in addition to read_noise_e
  bool cancels_reset_noise = false;  ///< correlated double sampling: no reset noise, but each tap is read twice
  double blooming_share = 0;         ///< share of the charge above full well that each of the four neighbours receives; 0: none
  double blooming_limit_e = 0;  ///< a pixel that receives more than this from its neighbours in a lit raw frame is flagged as saturated
};

/// The converter of A−B to codes: code = round((A−B)/step + mid), clipped to its bits [theory: adc].
struct Adc {
  int bits = 12;
  double step_e_per_dn = 1;  ///< s
  double mid_code = 2048;    ///< 2^(bits − 1) is the middle [DN]
  int valid_min = 0;         ///< codes outside valid_min…valid_max flag the pixel as saturated
  int valid_max = 4095;
  std::vector<double> gains = {};  ///< gains that modes may choose from; the step of a mode is step_e_per_dn over its gain
};

/// One exposure of the sequence.
struct RawFrame {
  bool lit = true;
  double modulation_frequency_hz = 0;  ///< 0 where unlit
  double reference_phase_rad = 0;      ///< τ
  double integration_time_s = 0;
  double reference_delay_s = 0;  ///< delay of the light against the gate: adds 2π·f·delay to τ
};

/// One of a profile's modes: the raw frames that make a frame, in their order, and how often a frame begins.
struct Mode {
  std::string name;
  double frame_rate_hz = 0;
  std::vector<RawFrame> sequence;
  double gain = 1;  ///< gain of the amplifier before the ADC: one of Adc::gains, or 1
};

/// Image filter over the range image; invalid pixels are neither changed nor used. Bilateral and adaptive filters leave edges as they are,
/// and come before the check for flying pixels; the others come after it.
struct ImageFilter {
  enum class Kind { none, gaussian, median, bilateral, adaptive };
  Kind kind = Kind::none;
  double sigma_px = 1;   ///< gaussian, bilateral
  int radius_px = 1;     ///< median, adaptive: window (2 radius + 1)², at most
  double sigmas = 3;     ///< bilateral, adaptive: neighbours count if they differ by less than this times the noise of the difference
  double range_m = 0;    ///< bilateral: length added in quadrature to the limit that `sigmas` sets
  double goal_m = 0.01;  ///< adaptive: target noise; neighbours are added, ring by ring, until it is reached
};

/// What a decoder knows of one modulation frequency of a specimen: by how much phases are measured too large (theory 4.13).
struct FrequencyCalibration {
  double modulation_frequency_hz = 0;
  double phase_offset_rad = 0;    ///< amount by which measured phases are too large in all pixels, at DecoderCalibration::reference_celsius
  double drift_m_per_kelvin = 0;  ///< drift of half the path per kelvin above that temperature
  /// Wiggling, the phase error by harmonics: Σ_m cos[m − 1]·cos(mφ̂) + sin[m − 1]·sin(mφ̂) of the measured phase φ̂.
  std::vector<double> wiggling_cos_rad = {}, wiggling_sin_rad = {};
  std::string pixel_phase_file = {};         ///< name of the file of pixel_phase_rad: `meta` has the name alone
  std::vector<double> pixel_phase_rad = {};  ///< additional phase of each pixel, [height][width] of the image that is read out; none: 0
};

/// What decoding knows of the specimen that took the raw frames. (Camera::calibration is what raw data are off by, and is always known.)
struct DecoderCalibration {
  enum class Kind { exact, none, specimen };
  /// exact: all that the profile says, each pixel's own phase included; none: a sine, and equal pixels; specimen: the members below.
  Kind kind = Kind::exact;
  double reference_celsius = 25;                       ///< temperature at which the specimen was measured
  std::vector<FrequencyCalibration> frequencies = {};  ///< one entry for each modulation frequency of the mode
};

/// How raw frames become depth (theory 4).
struct Decoding {
  bool wiggling_correction = true;
  double noise_threshold_m = 0.07;                                 ///< σ̂ above this: low signal; also the scale of confidence
  double amplitude_threshold_e = 0;                                ///< amplitude below this: low signal
  std::optional<double> lower_saturation_dn, upper_saturation_dn;  ///< codes beyond: saturated; unless given, the ADC's valid codes
  double flying_near_z_m = 1.0;                                    ///< z from which on the limit on |Δz| grows linearly
  double flying_near_limit_m = 0.018;                              ///< limit on |Δz| up to flying_near_z_m
  double flying_far_z_m = 4.5;                                     ///< z up to which the limit on |Δz| grows
  double flying_far_limit_m = 0.14;                                ///< limit on |Δz| from flying_far_z_m on
  double flying_sigmas = 4;                                        ///< |Δz| must also exceed this times its noise; 0: the limit alone
  bool flying_check = true;                                        ///< false: flying pixels are not detected
  double asymmetry_limit_e = 0;    ///< largest |D_k + D_k'|, half a turn apart, before a pixel is flagged: inconsistent phases
  double asymmetry_sigmas = 5;     ///< |D_k + D_k'| must also exceed this times its noise
  bool asymmetry_reject = false;   ///< the depth is invalid then; otherwise the flag is a warning
  double multipath_limit_m = 0.1;  ///< largest |d_i − d_j| of two modulation frequencies before a pixel is flagged
  double multipath_sigmas = 3;     ///< |d_i − d_j| must also exceed this times its noise
  bool multipath_reject = false;   ///< the depth is invalid then; otherwise the flag is a warning
  int temporal_frames = 1;         ///< number of frames in the mean of the range, the current one and those before it; 1: no mean
  double temporal_sigmas = 3;      ///< frames count if they differ by less than this times the noise of the difference
  ImageFilter filter;
  DecoderCalibration calibration = {};
};

/// How much of the distance is drift with temperature, and with the time since the camera was switched on.
struct Temperature {
  double celsius = 25, reference_celsius = 25;
  double drift_m_per_kelvin = 0;  ///< d_off = drift · (T − reference), added to half the path
  double warm_up_m = 0;           ///< first-order warm-up: warm_up · (1 − exp(−t/time constant))
  double warm_up_time_s = 600;
  double since_start_s = 1e9;  ///< time since the camera was switched on, at frame 0
};

/// Another camera of the same kind, at the same place, whose light falls on the same surfaces (theory 3.7).
struct Interference {
  double share = 0;                    ///< light of the other camera over that of this one, in each pixel; 0: no other camera
  double frequency_difference_hz = 0;  ///< modulation frequencies of the other camera less those of this one
  double active = 1;                   ///< probability that a raw frame overlaps the other camera's exposure, 0…1
  /// Phase by which the other camera's light lags at the start of frame 0; none: drawn for each raw frame.
  std::optional<double> phase_rad = {};
};

/// What raw data are off by, the same in all pixels: delays of cables, drivers and gates. Simulated raw frames have it, too, and decoding
/// takes it off again (theory 4.10).
struct Calibration {
  double range_offset_m = 0;  ///< amount by which raw data show surfaces too far; decoding subtracts it
  /// Modulation frequency [Hz] → how much too large its phase is in raw data [rad], besides; one sample: a constant; none: 0.
  Curve phase_offset = {};
};

/// Modulation frequencies that are swept evenly over a band within each exposure, so that they disturb radios less (theory 3.9).
struct SpreadSpectrum {
  enum class Kind { center, down };
  double width = 0;          ///< width of the band over the modulation frequency; 0: none
  Kind kind = Kind::center;  ///< center: the modulation frequency is the band's middle; down: its upper end
};

/// Which of the sensor's pixels are read, and how many of them together (theory 4.8).
struct Readout {
  int binning = 1;        ///< n: the charge of n × n neighbours is added before it is read
  int left = 0, top = 0;  ///< first column and row of the sensor that are read
  int width = 0;          ///< number of columns; 0: up to the sensor's edge
  int height = 0;         ///< number of rows; 0: up to the sensor's edge
};

/// Integration times that follow the light, from frame to frame (theory 4.9).
struct AutoExposure {
  double speed = 0;       ///< 0…1: share of the way to the aim that each frame takes, by the logarithm; 0: integration times are fixed
  double aim = 0.7;       ///< share of the valid codes, and of the full well, that bright pixels are to reach
  double bright = 0.99;   ///< quantile of all pixels that counts as bright
  double shortest_s = 0;  ///< lower limit of the longest lit integration time; 0: Camera::min_integration_time_s
  double longest_s = 0;   ///< upper limit of the longest lit integration time; 0: that of the mode
};

/// Light on a pixel: by radiometry (theory 2), or by the formula that the paper prints [theory: paper-formula].
enum class PowerModel { tofray, paper_literal };

/// A camera in one of its modes: lens, light sources, pixel, ADC, the sequence of raw frames, and how they are decoded.
struct Camera {
  std::string name;
  std::string source;  ///< the file it came from
  Sensor sensor;
  Lens lens;
  Filter filter;
  std::vector<Illumination> illumination;
  Pixel pixel;
  Adc adc;
  Decoding decoding;
  Temperature temperature;
  Interference interference;
  Calibration calibration;
  SpreadSpectrum spread_spectrum;
  Readout readout;
  AutoExposure auto_exposure;
  double refractive_index = 1.0;
  double readout_time_s = 0;  ///< between the end of one exposure and the start of the next
  double min_integration_time_s = 0;
  PowerModel power_model = PowerModel::tofray;
  Mode mode;                            ///< the chosen one
  std::vector<std::string> mode_names;  ///< all that the profile has
};

}  // namespace tofray
