// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "tofray/tofray.h"

/// The members of the public structs, and the names of their enumerators. A member that has no place here does not compile.
namespace tofray::python {

namespace detail {

/// Stands for a member of any type.
struct Anything {
  template <class T>
  operator T() const;
};

template <class T, class... Member>
consteval std::size_t member_count() {
  if constexpr (requires { T{Member{}..., Anything{}}; }) {
    return member_count<T, Member..., Anything>();
  } else {
    return sizeof...(Member);
  }
}

/// "…M = &tofray::Pixel::read_noise_e; …" out of what the compiler calls the function: what follows the last "::".
constexpr std::string_view last_name(std::string_view all, std::string_view mark) {
  const std::string_view behind = all.substr(all.find(mark) + mark.size());
  const std::string_view whole = behind.substr(0, behind.find_first_of(";]"));
  if (whole.find(')') != std::string_view::npos) return {};  // "(tofray::Noise)7"
  const std::size_t colon = whole.rfind(':');
  return colon == std::string_view::npos ? std::string_view{} : whole.substr(colon + 1);
}

}  // namespace detail

template <auto M>
constexpr std::string_view member_name() {
  return detail::last_name(__PRETTY_FUNCTION__, "M = ");
}

/// Empty where the enumeration has no such value: compilers write a number in brackets then.
template <auto E>
constexpr std::string_view enumerator_name() {
  return detail::last_name(__PRETTY_FUNCTION__, "E = ");
}

/// The names of an enumeration that counts from 0 on, at the places of their values.
template <class E, std::size_t... I>
constexpr auto enumerators_of(std::index_sequence<I...>) {
  return std::array<std::string_view, sizeof...(I)>{enumerator_name<static_cast<E>(I)>()...};
}
inline constexpr std::size_t most_enumerators = 16;
template <class E>
constexpr std::array<std::string_view, most_enumerators> enumerators() {
  return enumerators_of<E>(std::make_index_sequence<most_enumerators>());
}

template <class T, auto... M>
struct FieldList {
  static_assert(sizeof...(M) == detail::member_count<T>(), "every member of the struct needs its place in fields.h");

  /// Calls with each member: its name, and a pointer to it.
  template <class Call>
  static void each(const Call& call) {
    (call(member_name<M>(), M), ...);
  }
};

template <class T>
struct Fields;
template <class T>
concept Record = requires {
  Fields<T>::name;
};

#define TOFRAY_FIELDS(T, ...)                    \
  template <>                                    \
  struct Fields<T> : FieldList<T, __VA_ARGS__> { \
    static constexpr const char* name = #T;      \
  };

// clang-format off
TOFRAY_FIELDS(Curve, &Curve::x, &Curve::y)
TOFRAY_FIELDS(PixelMask, &PixelMask::kind, &PixelMask::samples, &PixelMask::columns, &PixelMask::rows)
TOFRAY_FIELDS(Sensor, &Sensor::width, &Sensor::height, &Sensor::pixel_pitch_m, &Sensor::fill_factor, &Sensor::mask)
TOFRAY_FIELDS(Scatter, &Scatter::kind, &Scatter::share, &Scatter::sigma_px, &Scatter::weights, &Scatter::kernel, &Scatter::columns,
              &Scatter::rows)
TOFRAY_FIELDS(Lens, &Lens::fx_px, &Lens::fy_px, &Lens::cx_px, &Lens::cy_px, &Lens::distortion, &Lens::k1, &Lens::k2, &Lens::p1,
              &Lens::p2, &Lens::k3, &Lens::k4, &Lens::k5, &Lens::k6, &Lens::f_number, &Lens::transmission, &Lens::vignetting,
              &Lens::vignetting_table, &Lens::scatter)
TOFRAY_FIELDS(Filter, &Filter::center_m, &Filter::half_width_m, &Filter::peak, &Filter::table)
TOFRAY_FIELDS(Pattern, &Pattern::kind, &Pattern::half_angle_rad, &Pattern::exponent, &Pattern::width_rad, &Pattern::height_rad,
              &Pattern::columns, &Pattern::rows, &Pattern::half_range_x_rad, &Pattern::half_range_y_rad, &Pattern::samples)
TOFRAY_FIELDS(Waveform, &Waveform::kind, &Waveform::duty, &Waveform::rise_time_s, &Waveform::bandwidth_hz, &Waveform::jitter_s,
              &Waveform::harmonics, &Waveform::modulation_depth, &Waveform::correlation, &Waveform::fall_time_s, &Waveform::sigma_s,
              &Waveform::emission, &Waveform::sample_phases_rad)
TOFRAY_FIELDS(Area, &Area::kind, &Area::radius_m, &Area::width_m, &Area::height_m, &Area::points)
TOFRAY_FIELDS(Illumination, &Illumination::position, &Illumination::axis, &Illumination::illumination_wavelength_m, &Illumination::power_w,
              &Illumination::ring_leds, &Illumination::ring_radius_m, &Illumination::area, &Illumination::pattern, &Illumination::waveform)
TOFRAY_FIELDS(Pixel, &Pixel::quantum_efficiency, &Pixel::contrast, &Pixel::contrast_by_wavelength, &Pixel::bandwidth_hz,
              &Pixel::full_well_e, &Pixel::read_noise_e, &Pixel::column_noise_e, &Pixel::row_noise_e, &Pixel::dark_current_e_per_s,
              &Pixel::dark_current_doubling_k, &Pixel::tap_gain_mismatch, &Pixel::tap_offset_mismatch_e, &Pixel::crosstalk_left_right,
              &Pixel::crosstalk_up_down, &Pixel::nonlinearity, &Pixel::prnu, &Pixel::dsnu_dn, &Pixel::delay_s, &Pixel::phase_offset_rad, &Pixel::pattern_seed,
              &Pixel::suppression_threshold_e, &Pixel::suppression_budget_e, &Pixel::suppression_noise_factor, &Pixel::reset_noise_e,
              &Pixel::cancels_reset_noise, &Pixel::blooming_share, &Pixel::blooming_limit_e)
TOFRAY_FIELDS(Adc, &Adc::bits, &Adc::step_e_per_dn, &Adc::mid_code, &Adc::valid_min, &Adc::valid_max, &Adc::gains)
TOFRAY_FIELDS(RawFrame, &RawFrame::lit, &RawFrame::modulation_frequency_hz, &RawFrame::reference_phase_rad, &RawFrame::integration_time_s,
              &RawFrame::reference_delay_s)
TOFRAY_FIELDS(Mode, &Mode::name, &Mode::frame_rate_hz, &Mode::sequence, &Mode::gain)
TOFRAY_FIELDS(ImageFilter, &ImageFilter::kind, &ImageFilter::sigma_px, &ImageFilter::radius_px, &ImageFilter::sigmas,
              &ImageFilter::range_m, &ImageFilter::goal_m)
TOFRAY_FIELDS(Decoding, &Decoding::wiggling_correction, &Decoding::noise_threshold_m, &Decoding::amplitude_threshold_e,
              &Decoding::lower_saturation_dn, &Decoding::upper_saturation_dn, &Decoding::flying_near_z_m, &Decoding::flying_near_limit_m,
              &Decoding::flying_far_z_m, &Decoding::flying_far_limit_m, &Decoding::flying_sigmas, &Decoding::flying_check,
              &Decoding::asymmetry_limit_e, &Decoding::asymmetry_sigmas, &Decoding::asymmetry_reject, &Decoding::multipath_limit_m,
              &Decoding::multipath_sigmas, &Decoding::multipath_reject, &Decoding::temporal_frames,
              &Decoding::temporal_sigmas, &Decoding::filter, &Decoding::calibration)
TOFRAY_FIELDS(FrequencyCalibration, &FrequencyCalibration::modulation_frequency_hz, &FrequencyCalibration::phase_offset_rad,
              &FrequencyCalibration::drift_m_per_kelvin, &FrequencyCalibration::wiggling_cos_rad, &FrequencyCalibration::wiggling_sin_rad,
              &FrequencyCalibration::pixel_phase_file, &FrequencyCalibration::pixel_phase_rad)
TOFRAY_FIELDS(DecoderCalibration, &DecoderCalibration::kind, &DecoderCalibration::reference_celsius, &DecoderCalibration::frequencies)
TOFRAY_FIELDS(Temperature, &Temperature::celsius, &Temperature::reference_celsius, &Temperature::drift_m_per_kelvin,
              &Temperature::warm_up_m, &Temperature::warm_up_time_s, &Temperature::since_start_s)
TOFRAY_FIELDS(Calibration, &Calibration::range_offset_m, &Calibration::phase_offset)
TOFRAY_FIELDS(Interference, &Interference::share, &Interference::frequency_difference_hz, &Interference::active, &Interference::phase_rad)
TOFRAY_FIELDS(SpreadSpectrum, &SpreadSpectrum::width, &SpreadSpectrum::kind)
TOFRAY_FIELDS(Readout, &Readout::binning, &Readout::left, &Readout::top, &Readout::width, &Readout::height)
TOFRAY_FIELDS(AutoExposure, &AutoExposure::speed, &AutoExposure::aim, &AutoExposure::bright, &AutoExposure::shortest_s,
              &AutoExposure::longest_s)
TOFRAY_FIELDS(Camera, &Camera::name, &Camera::source, &Camera::sensor, &Camera::lens, &Camera::filter, &Camera::illumination,
              &Camera::pixel, &Camera::adc, &Camera::decoding, &Camera::temperature, &Camera::interference, &Camera::calibration, &Camera::spread_spectrum,
              &Camera::readout, &Camera::auto_exposure, &Camera::refractive_index, &Camera::readout_time_s,
              &Camera::min_integration_time_s, &Camera::power_model, &Camera::mode, &Camera::mode_names)

TOFRAY_FIELDS(Material, &Material::name, &Material::brdf, &Material::diffuse, &Material::specular, &Material::exponent,
              &Material::roughness_rad, &Material::alpha, &Material::retro, &Material::spread_rad, &Material::map, &Material::normals,
              &Material::finish, &Material::opacity)
TOFRAY_FIELDS(Plane, &Plane::point, &Plane::normal)
TOFRAY_FIELDS(Sphere, &Sphere::center, &Sphere::radius)
TOFRAY_FIELDS(Box, &Box::min, &Box::max)
TOFRAY_FIELDS(Triangle, &Triangle::vertices)
TOFRAY_FIELDS(Cylinder, &Cylinder::center, &Cylinder::axis, &Cylinder::radius, &Cylinder::height)
TOFRAY_FIELDS(Rectangle, &Rectangle::center, &Rectangle::size)
TOFRAY_FIELDS(Disk, &Disk::center, &Disk::normal, &Disk::radius)
TOFRAY_FIELDS(Capsule, &Capsule::start, &Capsule::end, &Capsule::radius)
TOFRAY_FIELDS(Cone, &Cone::base, &Cone::axis, &Cone::radius, &Cone::height)
TOFRAY_FIELDS(Mesh, &Mesh::file, &Mesh::scale, &Mesh::up, &Mesh::animation, &Mesh::time_s, &Mesh::play, &Mesh::sha256, &Mesh::left_out, &Mesh::guessed,
              &Mesh::notices, &Mesh::triangles, &Mesh::motion)
TOFRAY_FIELDS(Rotation, &Rotation::axis, &Rotation::angle_rad, &Rotation::quaternion)
TOFRAY_FIELDS(Keyframe, &Keyframe::time_s, &Keyframe::position, &Keyframe::rotation)
TOFRAY_FIELDS(Object, &Object::name, &Object::shape, &Object::material, &Object::position, &Object::rotation, &Object::velocity_m_per_s,
              &Object::angular_velocity_rad_per_s, &Object::keyframes, &Object::class_name, &Object::key, &Object::where)
TOFRAY_FIELDS(Ambient, &Ambient::spectrum, &Ambient::quantity, &Ambient::amount, &Ambient::table_wavelength_m,
              &Ambient::table_irradiance_w_per_m3, &Ambient::direction)
TOFRAY_FIELDS(TransientBins, &TransientBins::bins, &TransientBins::first_m, &TransientBins::width_m)
TOFRAY_FIELDS(Transport, &Transport::bounces, &Transport::samples, &Transport::seed, &Transport::max_samples, &Transport::path_noise_m,
              &Transport::smooth, &Transport::transient)
TOFRAY_FIELDS(Pose, &Pose::position, &Pose::look_at, &Pose::up, &Pose::quaternion)
TOFRAY_FIELDS(CameraKeyframe, &CameraKeyframe::time_s, &CameraKeyframe::pose)
TOFRAY_FIELDS(Override, &Override::key, &Override::value, &Override::where)
TOFRAY_FIELDS(CameraChoice, &CameraChoice::profile, &CameraChoice::mode, &CameraChoice::pose, &CameraChoice::keyframes,
              &CameraChoice::overrides, &CameraChoice::profile_where, &CameraChoice::mode_where)
TOFRAY_FIELDS(SceneFile, &SceneFile::file, &SceneFile::sha256)
TOFRAY_FIELDS(Scene, &Scene::name, &Scene::source, &Scene::camera, &Scene::ambient, &Scene::transport, &Scene::materials, &Scene::objects,
              &Scene::world_up, &Scene::files, &Scene::classes)
TOFRAY_FIELDS(RanOn, &RanOn::backend, &RanOn::device, &RanOn::isa, &RanOn::threads, &RanOn::block_size, &RanOn::occupancy,
              &RanOn::fallback_reason)
TOFRAY_FIELDS(PlanStep, &PlanStep::name, &PlanStep::does, &PlanStep::part, &PlanStep::over, &PlanStep::pieces)
TOFRAY_FIELDS(ObjectInView, &ObjectInView::object, &ObjectInView::name, &ObjectInView::pixels, &ObjectInView::nearest_m, &ObjectInView::farthest_m,
              &ObjectInView::endless, &ObjectInView::low, &ObjectInView::high, &ObjectInView::behind_camera, &ObjectInView::around_camera)
TOFRAY_FIELDS(ObjectPlace, &ObjectPlace::name, &ObjectPlace::class_name, &ObjectPlace::position, &ObjectPlace::rotation, &ObjectPlace::endless,
              &ObjectPlace::low, &ObjectPlace::high)
TOFRAY_FIELDS(SceneFinding, &SceneFinding::kind, &SceneFinding::warning, &SceneFinding::objects, &SceneFinding::where, &SceneFinding::what,
              &SceneFinding::more)
TOFRAY_FIELDS(SceneReport, &SceneReport::time_s, &SceneReport::pixels, &SceneReport::outside_lens, &SceneReport::no_surface, &SceneReport::beyond_reach,
              &SceneReport::ambiguity_range_m, &SceneReport::nearest_m, &SceneReport::farthest_m, &SceneReport::objects, &SceneReport::findings)
TOFRAY_FIELDS(InvalidPixels, &InvalidPixels::pixels, &InvalidPixels::valid, &InvalidPixels::wrapped, &InvalidPixels::valid_on_wrong_cycle, &InvalidPixels::saturated, &InvalidPixels::no_surface,
              &InvalidPixels::beyond_reach, &InvalidPixels::dark, &InvalidPixels::low_signal, &InvalidPixels::no_return, &InvalidPixels::wrong_cycle,
              &InvalidPixels::flying_pixel, &InvalidPixels::outside_lens, &InvalidPixels::inconsistent_phases, &InvalidPixels::inconsistent_frequencies,
              &InvalidPixels::ambiguity_range_m, &InvalidPixels::ranges_m)
TOFRAY_FIELDS(AmbientCase, &AmbientCase::name, &AmbientCase::ambient, &AmbientCase::pose)
TOFRAY_FIELDS(CameraQuestion, &CameraQuestion::distances_m, &CameraQuestion::reflectivities, &CameraQuestion::ambients)
TOFRAY_FIELDS(NoiseAt, &NoiseAt::z_m, &NoiseAt::sigma_m, &NoiseAt::wrong_cycle, &NoiseAt::saturated)
TOFRAY_FIELDS(NoiseAtDistances, &NoiseAtDistances::reflectivity, &NoiseAtDistances::ambient, &NoiseAtDistances::saturated_up_to_m, &NoiseAtDistances::at)
TOFRAY_FIELDS(CameraReport, &CameraReport::width, &CameraReport::height, &CameraReport::width_deg, &CameraReport::height_deg, &CameraReport::diagonal_deg,
              &CameraReport::pixel_width_m, &CameraReport::pixel_height_m, &CameraReport::outside, &CameraReport::unlit, &CameraReport::darkest,
              &CameraReport::modulation_frequency_hz, &CameraReport::cycles, &CameraReport::ambiguity_range_m, &CameraReport::low_signal_m,
              &CameraReport::knows_ambient, &CameraReport::noise, &CameraReport::warnings)
TOFRAY_FIELDS(Pinhole, &Pinhole::width, &Pinhole::height, &Pinhole::fx_px, &Pinhole::fy_px, &Pinhole::cx_px, &Pinhole::cy_px, &Pinhole::pixel_centre)
TOFRAY_FIELDS(Placement, &Placement::position, &Placement::rotation)
TOFRAY_FIELDS(PlacedObject, &PlacedObject::name, &PlacedObject::start, &PlacedObject::end, &PlacedObject::keyframes)
TOFRAY_FIELDS(FrameRequest, &FrameRequest::index, &FrameRequest::seed, &FrameRequest::pose, &FrameRequest::pose_end, &FrameRequest::camera, &FrameRequest::objects, &FrameRequest::start_time_s)
TOFRAY_FIELDS(ChainRawFrame, &ChainRawFrame::lit, &ChainRawFrame::modulation_frequency_hz, &ChainRawFrame::reference_phase_rad, &ChainRawFrame::integration_time_s, &ChainRawFrame::signal_e, &ChainRawFrame::direct_e, &ChainRawFrame::indirect_e, &ChainRawFrame::multipath_m, &ChainRawFrame::path_noise_m, &ChainRawFrame::tap_a_e, &ChainRawFrame::tap_b_e, &ChainRawFrame::code_dn, &ChainRawFrame::difference_e)
TOFRAY_FIELDS(ChainPhase, &ChainPhase::modulation_frequency_hz, &ChainPhase::amplitude_e, &ChainPhase::measured_turns, &ChainPhase::calibrated_turns, &ChainPhase::half_wave_m, &ChainPhase::cycles, &ChainPhase::half_path_m, &ChainPhase::noise_e)
TOFRAY_FIELDS(UnwrapCandidate, &UnwrapCandidate::cycles, &UnwrapCandidate::range_m, &UnwrapCandidate::cost_m2, &UnwrapCandidate::chosen)
TOFRAY_FIELDS(PixelChain, &PixelChain::u, &PixelChain::v, &PixelChain::object, &PixelChain::true_range_m, &PixelChain::true_z_m, &PixelChain::reflectivity, &PixelChain::incidence_rad, &PixelChain::object_share, &PixelChain::mixed, &PixelChain::position_m, &PixelChain::normal, &PixelChain::irradiance_w_m2, &PixelChain::radiance_w_m2_sr, &PixelChain::power_w, &PixelChain::raw_frames, &PixelChain::phases, &PixelChain::candidates, &PixelChain::range_m, &PixelChain::z_m, &PixelChain::noise_m, &PixelChain::noise_threshold_m, &PixelChain::amplitude_e, &PixelChain::ambient_e, &PixelChain::confidence, &PixelChain::point_m, &PixelChain::flags)
TOFRAY_FIELDS(BounceShare, &BounceShare::first, &BounceShare::last, &BounceShare::share, &BounceShare::electrons, &BounceShare::multipath_m)
TOFRAY_FIELDS(PixelBounces, &PixelBounces::shares, &PixelBounces::unknown)
TOFRAY_FIELDS(Validity, &Validity::pixels, &Validity::reasons, &Validity::advice, &Validity::has_light)
TOFRAY_FIELDS(InputFile, &InputFile::role, &InputFile::name, &InputFile::text, &InputFile::sha256)
TOFRAY_FIELDS(FileRecord, &FileRecord::name, &FileRecord::bytes, &FileRecord::sha256)
TOFRAY_FIELDS(Remark, &Remark::warning, &Remark::where, &Remark::what, &Remark::more)
TOFRAY_FIELDS(Inputs, &Inputs::scene, &Inputs::camera, &Inputs::files, &Inputs::remarks)
TOFRAY_FIELDS(RunResult, &RunResult::folder, &RunResult::files, &RunResult::frames, &RunResult::interrupted, &RunResult::remarks, &RunResult::last, &RunResult::ran_on, &RunResult::timings_s)
// What Simulator() takes as words; `progress` is Simulator.progress in Python.
TOFRAY_FIELDS(SimulatorOptions, &SimulatorOptions::seed, &SimulatorOptions::noise, &SimulatorOptions::threads, &SimulatorOptions::backend,
              &SimulatorOptions::device, &SimulatorOptions::block_size, &SimulatorOptions::batch_bytes, &SimulatorOptions::isa,
              &SimulatorOptions::truth, &SimulatorOptions::arrays, &SimulatorOptions::last_stage, &SimulatorOptions::exposure_samples, &SimulatorOptions::subpixel,
              &SimulatorOptions::culling, &SimulatorOptions::progress)
// clang-format on
#undef TOFRAY_FIELDS

/// Calls with a null pointer of each struct that Python sees as a class of its own.
template <class Call>
void each_record(const Call& call) {
  const auto all = [&]<class... T>(std::tuple<T...>*) { (call(static_cast<T*>(nullptr)), ...); };
  using Records = std::tuple<Curve, PixelMask, Sensor, Scatter, Lens, Filter, Pattern, Waveform, Area, Illumination, Pixel, Adc, RawFrame,
                             Mode, ImageFilter, FrequencyCalibration, DecoderCalibration, Decoding, Temperature, Interference, Calibration,
                             SpreadSpectrum, Readout, AutoExposure, Camera, Material, Plane, Sphere, Box, Triangle, Cylinder, Rectangle,
                             Disk, Capsule, Cone, Mesh, Rotation, Keyframe, Object, Ambient, TransientBins, Transport, Pose, CameraKeyframe,
                             Override, CameraChoice, SceneFile, Scene, RanOn, PlanStep, Pinhole, Placement, PlacedObject, FrameRequest,
                             ObjectInView, ObjectPlace, SceneFinding, SceneReport, InvalidPixels, AmbientCase, CameraQuestion, NoiseAt,
                             NoiseAtDistances, CameraReport, ChainRawFrame, ChainPhase, UnwrapCandidate, PixelChain, BounceShare,
                             PixelBounces, Validity, InputFile, FileRecord, Remark, Inputs, RunResult>;
  all(static_cast<Records*>(nullptr));
}

}  // namespace tofray::python
