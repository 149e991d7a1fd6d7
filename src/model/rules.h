// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "model/check.h"

/// What has to hold between the members of a struct, of files and in code alike, and members that follow from others.
namespace tofray::model {

void codes_are_in_order(const Adc& adc, Complaints& complaints);
void far_is_beyond_near(const Decoding& decoding, Complaints& complaints);
void gains_are_those_of_the_adc(const Camera& camera, Complaints& complaints);
void lit_raw_frames_have_a_frequency(const RawFrame& raw, Complaints& complaints);
void what_is_read_rises_with_the_charge(const Pixel& pixel, Complaints& complaints);
/// The numbers of point sources and of samples of their patterns are within the limits.
void lights_are_within_the_limits(const Camera& camera, Complaints& complaints);
/// lights_are_within_the_limits(), and the numbers of pixels.
void cameras_are_within_the_limits(const Camera& camera, Complaints& complaints);
/// cameras_are_within_the_limits(), and the dark current at the temperature, and the mode's gain.
void cameras_make_sense(const Camera& camera, Complaints& complaints);
/// The region that is read lies on the sensor, and a binned pixel in it.
void something_is_read(const Camera& camera, Complaints& complaints);
/// Limits are in order, and the longest exposures fit into a frame.
void exposures_fit(const Camera& camera, Complaints& complaints);
/// Larger true phases are measured larger.
void wiggling_stays_in_order(const FrequencyCalibration& frequency, Complaints& complaints);
/// A specimen's calibration has each modulation frequency of the mode once, and a phase for each pixel that is read out.
void calibration_is_of_the_camera(const Camera& camera, Complaints& complaints);
void masks_let_light_through(const PixelMask& mask, Complaints& complaints);
void scatter_goes_somewhere(const Scatter& scatter, Complaints& complaints);
void tables_shine(const Pattern& pattern, Complaints& complaints);
void samples_carry_their_harmonics(const Waveform& waveform, Complaints& complaints);

void contrast_is_full(Pixel& pixel, const Given& given);
void codes_by_bits(Adc& adc, const Given& given);
void filter_at_the_light(Camera& camera, const Given& given);

void materials_send_back_no_more_than_they_get(const Material& material, Complaints& complaints);
void turns_have_an_axis(const Rotation& rotation, Complaints& complaints);
void poses_look_somewhere(const Pose& pose, Complaints& complaints);
void objects_move_one_way(const Object& object, Complaints& complaints);
void cameras_move_one_way(const CameraChoice& camera, Complaints& complaints);
void paths_have_an_aim(const Transport& transport, Complaints& complaints);
void objects_fit_their_scene(const Scene& scene, Complaints& complaints);

void light_is_the_suns(Ambient& ambient, const Given& given);

}  // namespace tofray::model
