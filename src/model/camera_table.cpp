// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/constants.h"
#include "base/limits.h"
#include "model/rules.h"
#include "model/tables.h"

/// What a camera profile may say, but its lights: light_table.cpp.
///
/// Ranges are wide: beyond them lies no camera, or what single precision cannot carry.
namespace tofray::model {

namespace {

using enum base::Dimension;
using enum Constant;
using base::pi;

constexpr auto mask_side = static_cast<int>(base::limit::mask_side.value);
constexpr auto kernel_side = static_cast<int>(base::limit::kernel_side.value);
constexpr int scatter_gaussians = 4;
constexpr int temporal_frames = 32, most_gains = 16, binning = 16, wiggling_orders = 32;
// Files say them by the rows themselves; `meta` has the numbers in one list.
constexpr Number mask_size{none, {1, mask_side}, "2"};
constexpr Number kernel_size{none, {1, kernel_side}, "3"};
constexpr auto raw_frames = static_cast<int>(base::limit::raw_frames.value);

constexpr Number focal_length{pixel, {1, 1e6}, "212 px"};
constexpr Number principal_point{pixel, {-1e5, 1e5}, "111.5 px"};
constexpr Number distortion{none, {-1000, 1000}, "-0.3"};
constexpr Number wavelength{length, {100e-9, 20e-6}, "850 nm"};
constexpr Number efficiency{fraction, {0, 1}, "0.4"};
constexpr Number contrast{fraction, {0, 1}, "0.75"};
constexpr Number modulation_frequency{frequency, {1e3, 1e10}, "80.32 MHz"};
constexpr Number electrons{charge, {0, 1e12}, "50 e"};
constexpr Number dark_current{charge_rate, {0, 1e12}, "1000 e/s"};
constexpr Number code_number{none, {0, 65535}, "400"};
constexpr Number flying_z{length, {0, 1e4}, "1 m"};
constexpr Number flying_limit{length, {0, 1e3}, "18 mm"};
constexpr Number sigmas{none, {0, 1e3}, "4"};
constexpr Number degrees{celsius, {-100, 200}, "25 degC"};
constexpr Number gain{none, {0.01, 100}, "4"};
constexpr Number pause{time, {0, 10}, "3.5 ms"};

}  // namespace

template <>
const Table& table_of<PixelMask>() {
  using Kind = PixelMask::Kind;
  static const Table rows = table<PixelMask>(kind<&PixelMask::kind>("kind", {"square", "table"}),
                                             grid<&PixelMask::samples, &PixelMask::rows, &PixelMask::columns>(
                                                 "samples", {none, {0, 1e12}, "1"}, 1, mask_side,
                                                 "sensitivity over the whole pixel, any unit; row by row from the top")
                                                 .when<&PixelMask::kind>(Kind::table)
                                                 .or_file("mask.csv"),
                                             number<&PixelMask::columns>("", mask_size, "").when<&PixelMask::kind>(Kind::table),
                                             number<&PixelMask::rows>("", mask_size, "").when<&PixelMask::kind>(Kind::table))
                                .check_with(masks_let_light_through);
  return rows;
}

template <>
const Table& table_of<Sensor>() {
  static const Table rows = table<Sensor>(
      number<&Sensor::width>("width", sensor_side, "columns of pixels").required(),
      number<&Sensor::height>("height", sensor_side, "rows of pixels").required(),
      number<&Sensor::pixel_pitch_m>("pixel_pitch", {length, {0.5e-6, 1e-3}, "12 um"},
                                     "distance between the centres of neighbouring pixels")
          .required(),
      number<&Sensor::fill_factor>("fill_factor", {fraction, {1e-3, 1}, "0.8"}, "share of the pixel's area that collects light"),
      record<&Sensor::mask>("mask", "where within a pixel light is collected, for several samples per pixel"));
  return rows;
}

template <>
const Table& table_of<Scatter>() {
  using Kind = Scatter::Kind;
  constexpr auto kind_of = &Scatter::kind;
  static const Table rows =
      table<Scatter>(
          kind<kind_of>("kind", {"none", "gaussians", "kernel"}),
          number<&Scatter::share>("share", {fraction, {0, 1}, "2 %"}, "share of the light that is scattered")
              .when<kind_of>(Kind::gaussians, Kind::kernel)
              .required(),
          numbers<&Scatter::sigma_px>("sigma", {pixel, {0.1, 1e4}, "8 px"}, 1, scatter_gaussians, "width of each Gaussian")
              .when<kind_of>(Kind::gaussians)
              .required(),
          numbers<&Scatter::weights>("weights", {none, {0, 1e12}, "1"}, 1, scatter_gaussians,
                                     "weight of each Gaussian, any unit; equal unless given")
              .when<kind_of>(Kind::gaussians)
              .absent(),
          grid<&Scatter::kernel, &Scatter::rows, &Scatter::columns>(
              "kernel", {none, {0, 1e12}, "1"}, 1, kernel_side,
              "weights of the kernel, any unit: row by row from the top; rows and columns odd in number; the middle is the pixel itself")
              .when<kind_of>(Kind::kernel)
              .or_file("kernel.csv"),
          number<&Scatter::columns>("", kernel_size, "").when<kind_of>(Kind::kernel),
          number<&Scatter::rows>("", kernel_size, "").when<kind_of>(Kind::kernel))
          .check_with(scatter_goes_somewhere);
  return rows;
}

template <>
const Table& table_of<Lens>() {
  constexpr auto brown_conrady = Lens::Distortion::brown_conrady;
  static const Table rows = table<Lens>(
      number<&Lens::fx_px>("fx", focal_length, "focal length over pixel pitch, along a row").required(),
      number<&Lens::fy_px>("fy", focal_length, "focal length over pixel pitch, along a column").required(),
      number<&Lens::cx_px>("cx", principal_point, "column of the principal point; the centre of pixel (0, 0) is at (0, 0)").required(),
      number<&Lens::cy_px>("cy", {pixel, principal_point.range, "85.5 px"},
                           "row of the principal point; the centre of pixel (0, 0) is at (0, 0)")
          .required(),
      group("distortion", "as in OpenCV",
            choice<&Lens::distortion>(
                "model", {"brown_conrady", "fisheye"},
                "brown_conrady: k1 to k6, p1 and p2, rational from k4 on; fisheye: k1 to k4 over the angle to the axis"),
            number<&Lens::k1>("k1", distortion, "radial coefficient of r^2; fisheye: of angle^2"),
            number<&Lens::k2>("k2", distortion, "radial coefficient of r^4; fisheye: of angle^4"),
            number<&Lens::p1>("p1", distortion, "first tangential coefficient").when<&Lens::distortion>(brown_conrady),
            number<&Lens::p2>("p2", distortion, "second tangential coefficient").when<&Lens::distortion>(brown_conrady),
            number<&Lens::k3>("k3", distortion, "radial coefficient of r^6; fisheye: of angle^6"),
            number<&Lens::k4>("k4", distortion, "radial coefficient of r^2 in the denominator; fisheye: of angle^8"),
            number<&Lens::k5>("k5", distortion, "radial coefficient of r^4 in the denominator").when<&Lens::distortion>(brown_conrady),
            number<&Lens::k6>("k6", distortion, "radial coefficient of r^6 in the denominator").when<&Lens::distortion>(brown_conrady)),
      number<&Lens::f_number>("f_number", {none, {0.3, 100}, "1.6"}, "N: focal length over the diameter of the entrance pupil")
          .required()
          .since(Stage::power),
      number<&Lens::transmission>("transmission", {fraction, {0, 1}, "0.85"},
                                  "transmission of lens and filter at the illumination wavelength")
          .since(Stage::power),
      choice<&Lens::vignetting>("vignetting", {"cos4", "off", "table"},
                                "fall-off toward the corners: cos4, off, or a table over the angle to the axis"),
      curve<&Lens::vignetting_table>("vignetting", {"angle", {angle, {0, pi / 2}, "30 deg"}}, {"factor", {none, {0, 2}, "0.6"}}, "")
          .when<&Lens::vignetting>(Lens::Vignetting::table),
      record<&Lens::scatter>("scatter", "light that lens and filter scatter over the sensor").since(Stage::power));
  return rows;
}

template <>
const Table& table_of<Filter>() {
  static const Table rows =
      table<Filter>(number<&Filter::center_m>("center", wavelength,
                                              "centre of the pass band; the illumination wavelength of the first light unless given")
                        .absent(),
                    number<&Filter::half_width_m>("half_width", {length, {0.1e-9, 10e-6}, "15 nm"},
                                                  "half width of the pass band: center - half_width to center + half_width"),
                    number<&Filter::peak>("peak", {fraction, {0, 1}, "0.9"}, "transmission of the filter in its pass band"),
                    curve<&Filter::table>("", {"wavelength", wavelength}, {"transmission", {fraction, {0, 1}, "0.9"}},
                                          "a table in place of center, half_width and peak")
                        .absent());
  return rows;
}

template <>
const Table& table_of<Pixel>() {
  static const Table rows =
      table<Pixel>(
          curve<&Pixel::quantum_efficiency>("quantum_efficiency", {"wavelength", wavelength}, {"value", efficiency},
                                            "electrons per photon, by wavelength", allowed)
              .required()
              .since(Stage::power),
          curve<&Pixel::contrast>("contrast", {"modulation_frequency", modulation_frequency}, {"value", contrast},
                                  "demodulation contrast of the pixel itself; 1 unless given", allowed)
              .absent()
              .since(Stage::power),
          curve<&Pixel::contrast_by_wavelength>("contrast_by_wavelength", {"wavelength", wavelength}, {"factor", {none, {0, 10}, "0.9"}},
                                                "factor on the contrast at the wavelength of each light; 1 unless given; not applied to a "
                                                "measured waveform, which contains it")
              .absent()
              .since(Stage::power),
          number<&Pixel::bandwidth_hz>("bandwidth", {frequency, {0, 1e12}, "180 MHz"}, "single pole of the gate; 0: none")
              .since(Stage::power),
          number<&Pixel::full_well_e>("full_well", {charge, {1, 1e30}, "100000 e"}, "full-well capacity of a tap"),
          number<&Pixel::read_noise_e>("read_noise", {charge, {0, 1e6}, "50 e"},
                                       "noise of reset and readout per tap, 1 sigma; reset noise alone may stand in reset_noise"),
          group("reset_noise", "random charge that the reset leaves in a tap",
                number<&Pixel::reset_noise_e>(
                    "sigma", {charge, {0, 1e6}, "50 e"},
                    "reset noise per tap at the camera's reference temperature, 1 sigma, in addition to read_noise"),
                flag<&Pixel::cancels_reset_noise>("cancelled", "correlated double sampling: no reset noise, but each tap is read twice")),
          number<&Pixel::column_noise_e>("column_noise", {charge, {0, 1e6}, "10 e"},
                                         "noise of A-B that all pixels of a column share, drawn for each raw frame, 1 sigma"),
          number<&Pixel::row_noise_e>("row_noise", {charge, {0, 1e6}, "10 e"},
                                      "noise of A-B that all pixels of a row share, drawn for each raw frame, 1 sigma"),
          number<&Pixel::dark_current_e_per_s>("dark_current", dark_current, "dark current per tap at the camera's reference temperature"),
          number<&Pixel::dark_current_doubling_k>("dark_current_doubling", {temperature_difference, {0, 1e3}, "8 K"},
                                                  "temperature rise that doubles the dark current; 0: it is constant"),
          group("taps", "mismatch of taps A and B, the same in all pixels; their mean is unchanged",
                number<&Pixel::tap_gain_mismatch>("gain_mismatch", {fraction, {-1, 1}, "1 %"},
                                                  "g: tap A collects 1 + g/2 of its charge, tap B 1 - g/2"),
                number<&Pixel::tap_offset_mismatch_e>(
                    "offset_mismatch", {charge, {-1e6, 1e6}, "100 e"},
                    "offset of tap A less that of tap B in each raw frame: half of it more in A, half of it less in B")),
          group("crosstalk", "crosstalk: charge that neighbours collect",
                number<&Pixel::crosstalk_left_right>("left_right", {fraction, {0, 0.25}, "1 %"},
                                                     "share of a pixel's charge that each of the neighbours left and right collects"),
                number<&Pixel::crosstalk_up_down>("up_down", {fraction, {0, 0.25}, "1 %"},
                                                  "share of a pixel's charge that each of the neighbours above and below collects"))
              .since(Stage::power),
          group("blooming", "blooming: charge above full well, which spills into neighbours",
                number<&Pixel::blooming_share>("share", {fraction, {0, 0.25}, "5 %"},
                                               "share of the charge above full well that each of the four neighbours receives"),
                number<&Pixel::blooming_limit_e>(
                    "limit", {charge, electrons.range, "1000 e"},
                    "a pixel that receives more than this from its neighbours in a lit raw frame is flagged as saturated")),
          curve<&Pixel::nonlinearity>("nonlinearity", {"charge", electrons}, {"read", electrons},
                                      "charge that is read for each charge of a tap, rising from 0 e; the charge itself unless given")
              .absent(),
          group("patterns", "fixed patterns: differences between pixels",
                number<&Pixel::prnu>("prnu", {fraction, {0, 1}, "1 %"}, "photo response non-uniformity, 1 sigma"),
                number<&Pixel::dsnu_dn>("dsnu", {code, {0, 1e4}, "2 DN"}, "offset pattern, 1 sigma"),
                number<&Pixel::delay_s>("delay", {time, {0, 1e-6}, "20 ps"}, "fixed delay per pixel, 1 sigma"),
                number<&Pixel::phase_offset_rad>("phase_offset", {angle, {0, 2 * pi}, "0.02 rad"},
                                                 "fixed phase per pixel and modulation frequency, 1 sigma"),
                number<&Pixel::pattern_seed>("seed", {none, {0, 9007199254740991.0}, "1"},
                                             "seed of the fixed patterns: which specimen of the sensor")),
          group("suppression", "background suppression; none unless given",
                number<&Pixel::suppression_threshold_e>("threshold", electrons,
                                                        "charge of the smaller tap at which suppression starts; 0: no suppression")
                    .required(),
                number<&Pixel::suppression_budget_e>("budget", electrons, "largest charge taken off each tap").required(),
                number<&Pixel::suppression_noise_factor>(
                    "noise_factor", {none, {0, 100}, "1"},
                    "factor on the noise of removed charge: charge x adds a variance of noise_factor^2 x to its tap")))
          .check_with(what_is_read_rises_with_the_charge)
          .complete_with(contrast_is_full);
  return rows;
}

template <>
const Table& table_of<Adc>() {
  static const Table rows =
      table<Adc>(
          number<&Adc::bits>("bits", {none, {1, 16}, "12"}, "codes go from 0 to 2^bits - 1").required(),
          number<&Adc::step_e_per_dn>("step", {charge_per_code, {1e-6, 1e9}, "20 e/DN"}, "electrons of A-B per code").required(),
          number<&Adc::mid_code>("mid_code", {none, code_number.range, "2048"}, "code of A-B = 0; the middle unless given").absent(),
          number<&Adc::valid_min>("valid_min", code_number, "lowest valid code; codes below are flagged as saturated; 0 unless given")
              .absent(),
          number<&Adc::valid_max>("valid_max", code_number,
                                  "highest valid code; codes above are flagged as saturated; the largest unless given")
              .absent(),
          numbers<&Adc::gains>("gains", gain, 1, most_gains, "gains that modes may choose from; a mode's step is `step` over its gain")
              .absent())
          .check_with(codes_are_in_order)
          .complete_with(codes_by_bits);
  return rows;
}

template <>
const Table& table_of<ImageFilter>() {
  using Kind = ImageFilter::Kind;
  constexpr auto kind_of = &ImageFilter::kind;
  static const Table rows = table<ImageFilter>(
      kind<kind_of>("kind", {"none", "gaussian", "median", "bilateral", "adaptive"}),
      number<&ImageFilter::sigma_px>("sigma", {pixel, {0.1, 10}, "1 px"}, "standard deviation of the kernel")
          .when<kind_of>(Kind::gaussian, Kind::bilateral),
      number<&ImageFilter::radius_px>("radius", {none, {1, 4}, "1"},
                                      "radius of the window of (2 radius + 1)^2 pixels; adaptive: of the largest one")
          .when<kind_of>(Kind::median, Kind::adaptive),
      number<&ImageFilter::sigmas>("sigmas", {none, sigmas.range, "3"}, "neighbours count if they differ by less than this times the noise")
          .when<kind_of>(Kind::bilateral, Kind::adaptive),
      number<&ImageFilter::range_m>("range", {length, {0, 1e3}, "20 mm"}, "length added in quadrature to the limit that sigmas sets")
          .when<kind_of>(Kind::bilateral),
      number<&ImageFilter::goal_m>("goal", {length, {0, 1e3}, "10 mm"}, "target noise: neighbours are added until it is reached")
          .when<kind_of>(Kind::adaptive));
  return rows;
}

template <>
const Table& table_of<FrequencyCalibration>() {
  constexpr Number swing{angle, {-1, 1}, "0.01 rad"};
  static const Table rows =
      table<FrequencyCalibration>(
          number<&FrequencyCalibration::modulation_frequency_hz>("modulation_frequency", modulation_frequency,
                                                                 "modulation frequency that this entry is for")
              .required(),
          number<&FrequencyCalibration::phase_offset_rad>("phase_offset", {angle, {-100, 100}, "0.2 rad"},
                                                          "amount by which measured phases are too large, in all pixels"),
          number<&FrequencyCalibration::drift_m_per_kelvin>(
              "drift", {drift, {-1, 1}, "0.2 mm/K"},
              "drift of the range per kelvin of temperature.actual above the calibration's reference"),
          group("wiggling", "phase error by harmonics, as cosines and sines of 1, 2, ... times the measured phase",
                numbers<&FrequencyCalibration::wiggling_cos_rad>("cos", swing, 1, wiggling_orders,
                                                                 "amplitude of each cosine, from the first order on")
                    .absent(),
                numbers<&FrequencyCalibration::wiggling_sin_rad>("sin", swing, 1, wiggling_orders,
                                                                 "amplitude of each sine, as many as cosines")
                    .absent()),
          words<&FrequencyCalibration::pixel_phase_file>(
              "pixel_phase", "a file", "phases.npy",
              "a .npy file beside this one or below: additional phase [rad] of each pixel, [height, width]; 0 unless given")
              .absent()
              .in_meta_if_set(),
          no_row<&FrequencyCalibration::pixel_phase_rad>("it is in that file"))
          .check_with(wiggling_stays_in_order);
  return rows;
}

template <>
const Table& table_of<DecoderCalibration>() {
  using Kind = DecoderCalibration::Kind;
  constexpr auto kind_of = &DecoderCalibration::kind;
  static const Table rows =
      table<DecoderCalibration>(
          kind<kind_of>("kind", {"exact", "none", "specimen"}),
          number<&DecoderCalibration::reference_celsius>("reference", degrees, "temperature at which the specimen was measured")
              .when<kind_of>(Kind::specimen),
          records<&DecoderCalibration::frequencies>("frequencies", 0, raw_frames, "one entry for each modulation frequency of the mode")
              .when<kind_of>(Kind::specimen)
              .required())
          .kind_may_be_missing()
          .or_a_file("a specimen's file, as `python3 -m tofray calibrate` writes it");
  return rows;
}

template <>
const Table& table_of<Decoding>() {
  static const Table rows =
      table<Decoding>(
          flag<&Decoding::wiggling_correction>("wiggling_correction", "correct the phase error by harmonics (wiggling)"),
          number<&Decoding::noise_threshold_m>("noise_threshold", {length, {1e-6, 1e3}, "70 mm"},
                                               "noise above which a pixel is flagged as low signal; also the scale of confidence"),
          number<&Decoding::amplitude_threshold_e>("amplitude_threshold", {charge, {0, 1e12}, "100 e"},
                                                   "amplitude below which a pixel is flagged as low signal"),
          number<&Decoding::lower_saturation_dn>("lower_saturation", code_number,
                                                 "lowest code that is not flagged as saturated; adc.valid_min unless given")
              .absent(),
          number<&Decoding::upper_saturation_dn>("upper_saturation", {none, code_number.range, "3750"},
                                                 "highest code that is not flagged as saturated; adc.valid_max unless given")
              .absent(),
          group("flying_pixel", "limits of the flying pixel flag",
                number<&Decoding::flying_near_z_m>("near_z", flying_z, "z from which on the limit on |dz| grows linearly"),
                number<&Decoding::flying_near_limit_m>("near_limit", flying_limit, "limit on |dz| up to near_z"),
                number<&Decoding::flying_far_z_m>("far_z", {length, flying_z.range, "4.5 m"}, "z up to which the limit on |dz| grows"),
                number<&Decoding::flying_far_limit_m>("far_limit", flying_limit, "limit on |dz| from far_z on"),
                number<&Decoding::flying_sigmas>("sigmas", sigmas, "|dz| must also exceed this times its noise; 0: the limit alone"),
                flag<&Decoding::flying_check>("check", "whether flying pixels are detected")),
          group("asymmetry", "check of raw frames half a period apart, whose sum is 0 unless something moves",
                number<&Decoding::asymmetry_limit_e>("limit", {charge, {0, 1e12}, "200 e"},
                                                     "largest |D_k + D_k+2| before a pixel is flagged"),
                number<&Decoding::asymmetry_sigmas>("sigmas", sigmas, "the sum must also exceed this times its noise"),
                flag<&Decoding::asymmetry_reject>("reject", "whether the depth of a flagged pixel is invalid")),
          group("multipath", "check of two modulation frequencies, whose ranges agree unless light took several paths",
                number<&Decoding::multipath_limit_m>("limit", {length, {0, 1e4}, "0.1 m"},
                                                     "largest difference of the ranges before a pixel is flagged"),
                number<&Decoding::multipath_sigmas>("sigmas", sigmas, "the difference must also exceed this times its noise"),
                flag<&Decoding::multipath_reject>("reject", "whether the depth of a flagged pixel is invalid")),
          record<&Decoding::filter>("filter", "filter over the range image"),
          record<&Decoding::calibration>(
              "calibration", "what decoding knows of the specimen: exact (everything), none (a sine, equal pixels), or a calibration file")
              .in_meta_if_set(),
          group("temporal", "mean over frames that follow each other, pixel by pixel",
                number<&Decoding::temporal_frames>("frames", {none, {1, temporal_frames}, "4"},
                                                   "number of frames in the mean, the current one and those before it; 1: no mean"),
                number<&Decoding::temporal_sigmas>("sigmas", sigmas, "frames count if they differ by less than this times the noise")))
          .check_with(far_is_beyond_near);
  return rows;
}

template <>
const Table& table_of<Temperature>() {
  static const Table rows = table<Temperature>(
      number<&Temperature::celsius>("actual", degrees, "temperature of the camera"),
      number<&Temperature::reference_celsius>("reference", degrees, "temperature at which the range has no drift"),
      number<&Temperature::drift_m_per_kelvin>("drift", {drift, {-1, 1}, "0.2 mm/K"}, "drift of the range per kelvin above the reference"),
      number<&Temperature::warm_up_m>("warm_up", {length, {-1, 1}, "5 mm"}, "drift of the range while the camera warms up, first order"),
      number<&Temperature::warm_up_time_s>("warm_up_time", {time, {1e-3, 1e6}, "600 s"}, "time constant of the warm-up"),
      number<&Temperature::since_start_s>("since_start", {time, {0, 1e12}, "600 s"}, "time since the camera was switched on, at frame 0"));
  return rows;
}

template <>
const Table& table_of<Interference>() {
  static const Table rows = table<Interference>(
      number<&Interference::share>("share", {fraction, {0, 100}, "5 %"},
                                   "light of the other camera over that of this one, in each pixel; 0: no other camera"),
      number<&Interference::frequency_difference_hz>("frequency_difference", {frequency, {-1e9, 1e9}, "30 Hz"},
                                                     "modulation frequencies of the other camera less those of this one"),
      number<&Interference::active>("active", {fraction, {0, 1}, "50 %"},
                                    "probability that a raw frame overlaps the other camera's exposure"),
      number<&Interference::phase_rad>(
          "phase", {angle, {-100, 100}, "90 deg"},
          "phase by which the other camera's light lags at the start of frame 0; drawn for each raw frame unless given")
          .absent());
  return rows;
}

template <>
const Table& table_of<Calibration>() {
  static const Table rows =
      table<Calibration>(number<&Calibration::range_offset_m>("range_offset", {length, {-1e4, 1e4}, "35 mm"},
                                                              "amount by which raw data show surfaces too far; decoding subtracts it"),
                         curve<&Calibration::phase_offset>(
                             "phase_offset", {"modulation_frequency", modulation_frequency}, {"value", {angle, {-100, 100}, "0.2 rad"}},
                             "amount by which phases of raw data are too large in addition; decoding subtracts it; 0 unless given", allowed)
                             .absent());
  return rows;
}

template <>
const Table& table_of<SpreadSpectrum>() {
  static const Table rows = table<SpreadSpectrum>(
      number<&SpreadSpectrum::width>("width", {fraction, {0, 0.5}, "1 %"}, "width of the band over the modulation frequency; 0: none"),
      choice<&SpreadSpectrum::kind>("kind", {"center", "down"},
                                    "center: the modulation frequency is the band's middle; down: its upper end"));
  return rows;
}

template <>
const Table& table_of<Readout>() {
  constexpr Number side_or_all{none, {0, static_cast<double>(base::limit::sensor_side.value)}, "8"};
  static const Table rows = table<Readout>(
      number<&Readout::binning>("binning", {none, {1, binning}, "2"}, "n: charge of n x n pixels is added before it is read"),
      group("region", "the rectangle of the sensor that is read, in pixels of the sensor",
            number<&Readout::left>("left", {none, side_or_all.range, "2"}, "first column that is read"),
            number<&Readout::top>("top", {none, side_or_all.range, "2"}, "first row that is read"),
            number<&Readout::width>("width", side_or_all, "number of columns; 0: up to the sensor's edge"),
            number<&Readout::height>("height", side_or_all, "number of rows; 0: up to the sensor's edge")));
  return rows;
}

template <>
const Table& table_of<AutoExposure>() {
  static const Table rows = table<AutoExposure>(
      number<&AutoExposure::speed>("speed", {fraction, {0, 1}, "50 %"},
                                   "share of the way to the aim that each frame takes; 0: integration times are fixed"),
      number<&AutoExposure::aim>("aim", {fraction, {0.01, 1}, "70 %"},
                                 "share of the valid codes, and of the full well, that bright pixels are to reach"),
      number<&AutoExposure::bright>("bright", {fraction, {0, 1}, "99 %"}, "quantile of all pixels that counts as bright"),
      number<&AutoExposure::shortest_s>("shortest", {time, {0, 1e3}, "100 us"},
                                        "lower limit of the longest lit integration time; 0: timing.min_integration_time"),
      number<&AutoExposure::longest_s>("longest", {time, {0, 1e3}, "2000 us"},
                                       "upper limit of the longest lit integration time; 0: that of the mode"));
  return rows;
}

template <>
const Table& table_of<RawFrame>() {
  static const Table rows =
      table<RawFrame>(
          flag<&RawFrame::lit>("lit", "whether the camera's light is on"),
          number<&RawFrame::modulation_frequency_hz>("modulation_frequency", modulation_frequency,
                                                     "modulation frequency of a lit raw frame")
              .when<&RawFrame::lit>(true)
              .absent(),
          number_or_list<&RawFrame::reference_phase_rad>("reference_phase", {angle, {-100, 100}, "90 deg"}, raw_frames,
                                                         "reference phase of a lit raw frame; a list makes one raw frame of each value")
              .when<&RawFrame::lit>(true)
              .absent(),
          number<&RawFrame::integration_time_s>("integration_time", integration_time, "time for which the raw frame collects light")
              .required()
              .since(Stage::raw),
          number_or_list<&RawFrame::reference_delay_s>("reference_delay", {time, {-1e-3, 1e-3}, "4.15 ns"}, raw_frames,
                                                       "delay of the light, in place of reference_phase")
              .when<&RawFrame::lit>(true)
              .absent())
          .check_with(lit_raw_frames_have_a_frequency);
  return rows;
}

template <>
const Table& table_of<Mode>() {
  static const Table rows =
      table<Mode>(words<&Mode::name>("", "", "", ""),
                  number<&Mode::frame_rate_hz>("frame_rate", frame_rate, "frames per second: frame i starts at i / frame_rate")
                      .required()
                      .since(Stage::raw),
                  records<&Mode::sequence>("sequence", 1, raw_frames, "the raw frames, in order").required().since(Stage::power),
                  number<&Mode::gain>("gain", gain, "gain before the ADC, one of adc.gains").since(Stage::raw));
  return rows;
}

template <>
const Table& table_of<Camera>() {
  static const Table rows =
      table<Camera>(
          words<&Camera::name>("name", "a name", "mycam", "name of the camera").required(),
          no_row<&Camera::source>("a file's place is no part of what it says"),
          record<&Camera::sensor>("sensor", "the grid of pixels").required(),
          record<&Camera::lens>("lens", "the lens: from directions to pixels").required(),
          record<&Camera::filter>("filter", "the optical filter before the sensor, for ambient light").since(Stage::power),
          records<&Camera::illumination>("illumination", 0, static_cast<int>(base::limit::lights.value),
                                         "the camera's light sources, whose light adds up")
              .required()
              .since(Stage::power),
          record<&Camera::pixel>("pixel", "the two-tap pixel").required().since(Stage::raw),
          record<&Camera::adc>("adc", "the converter from electrons to codes").required().since(Stage::raw),
          record<&Camera::decoding>("decoding", "from raw frames to depth").since(Stage::depth),
          record<&Camera::temperature>("temperature", "drift of the range").since(Stage::raw),
          record<&Camera::interference>("interference", "light of another camera of the same kind, at the same place").since(Stage::raw),
          record<&Camera::calibration>("calibration", "offsets of raw data, the same in all pixels").since(Stage::power),
          record<&Camera::spread_spectrum>("spread_spectrum", "modulation frequencies swept over a band within each exposure")
              .since(Stage::power),
          record<&Camera::readout>("readout", "which pixels of the sensor are read, and how many together"),
          record<&Camera::auto_exposure>("auto_exposure", "integration times that follow the light, from frame to frame").since(Stage::raw),
          number<&Camera::refractive_index>("refractive_index", {none, {1, 3}, "1.0003"},
                                            "refractive index of the medium that light travels in")
              .since(Stage::power),
          group("timing", "timing of the readout",
                number<&Camera::readout_time_s>("readout_time", pause, "from the end of one exposure to the start of the next"),
                number<&Camera::min_integration_time_s>("min_integration_time", {time, pause.range, "27 us"},
                                                        "shortest exposure the camera can do"))
              .since(Stage::raw),
          choice<&Camera::power_model>("power_model", {"tofray", "paper_literal"},
                                       "paper_literal: the printed formula of the paper, for comparison only")
              .since(Stage::power),
          record<&Camera::mode>("", ""),  // one out of the file's `modes`
          no_row<&Camera::mode_names>("what else the file has is no part of the camera"))
          .check_with(cameras_make_sense)
          .complete_with(filter_at_the_light);
  return rows;
}

}  // namespace tofray::model
