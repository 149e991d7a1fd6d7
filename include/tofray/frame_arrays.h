// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

/// The arrays of a frame: one row each, and no other list of them. The members of Raw, Depth, Truth and FrameArrays (tofray/frame.h) come
/// from these rows, and so do memory, copies to and from a GPU, the entries of frame.npz with their units, `--arrays`, and
/// docs/reference/arrays.md.
///
/// A row:
///
///     name     in files, in FrameArrays and in the kernels' FrameView
///     part     Frame::raw, Frame::depth or Frame::truth, and `member`, what it is called there
///     element  type of one value. Invalid ones: NaN in floats, 0 in integers
///     shape    row-major, see ArrayShape
///     stage    the one that writes it, see Stage
///     when     frames have it, see ArrayWhen
///     unit     as `meta` says it
///
/// To add one: its row here, and the place that computes it, where a kernel stores to `out.name`.
namespace tofray {

/// The pipeline's stages, in order.
enum class Stage { trace, power, raw, depth };

/// The axes of an array.
enum class ArrayShape {
  image,         ///< [height][width]
  pairs,         ///< [height][width][2]
  vectors,       ///< [height][width][3]
  stack,         ///< [phase][height][width]
  moved,         ///< [phase][height][width][2]
  by_frequency,  ///< [modulation frequency][height][width], in the order in which raw frames first have them
  bins,          ///< [bin][height][width]
  list,          ///< [phase]
};

/// When frames have an array.
enum class ArrayWhen {
  always,
  samples,    ///< with several samples in each pixel
  bounces,    ///< with light that bounces
  transient,  ///< with histograms by the length of the path
  asked,      ///< where SimulatorOptions::arrays names it: it costs time that most frames have no need of
};

// clang-format off

/// Raw: what the sensor hands out.
#define TOFRAY_RAW_ARRAYS(row) \
  /*  name   part member element        shape  stage unit  what it is */ \
  row(tap_a, raw, tap_a, float,         stack, raw, always,    "e",  "electrons of tap A, after the charge model") \
  row(tap_b, raw, tap_b, float,         stack, raw, always,    "e",  "electrons of tap B, after the charge model") \
  row(raw,   raw, raw,   std::uint16_t, stack, raw, always,    "DN", "the ADC's code of A-B")

/// Raw: when and how each raw frame was exposed. The host knows it before a frame begins: no kernel writes these.
#define TOFRAY_EXPOSURE_ARRAYS(row) \
  /*  name                     part member                   element       shape stage when unit   what it is */ \
  row(modulation_frequency_hz, raw, modulation_frequency_hz, double,       list, raw, always,    "Hz",  "modulation frequency, 0 where unlit") \
  row(reference_phase_rad,     raw, reference_phase_rad,     double,       list, raw, always,    "rad", "reference phase tau, 0 where unlit") \
  row(integration_time_s,      raw, integration_time_s,      double,       list, raw, always,    "s",   "time for which light is collected") \
  row(start_time_s,            raw, start_time_s,            double,       list, raw, always,    "s",   "start of the exposure; at 0 the scene is as written") \
  row(lit,                     raw, lit,                     std::uint8_t, list, raw, always,    "1",   "the camera's illumination is on")

/// Depth, camera frame (x right, y down, z forward).
#define TOFRAY_DEPTH_ARRAYS(row) \
  /*  name         part   member       element        shape    stage  when unit what it is */ \
  row(z_m,         depth, z_m,         float,         image,   depth, always,    "m", "depth along the optical axis") \
  row(range_m,     depth, range_m,     float,         image,   depth, always,    "m", "range along the pixel's ray") \
  row(points_m,    depth, points_m,    float,         vectors, depth, always,    "m", "x, y, z of the surface point") \
  row(amplitude_e, depth, amplitude_e, float,         image,   depth, always,    "e", "mean of the modulation frequencies' amplitudes") \
  row(ambient_e,   depth, ambient_e,   float,         image,   depth, always,    "e", "ambient charge of both taps, per lit exposure (if none is lit: per mean exposure)") \
  row(noise_m,     depth, noise_m,     float,         image,   depth, always,    "m", "the camera's estimate of the range's noise, 1 sigma; without wrong cycles, and too low of weak signals (theory 4.4)") \
  row(confidence,  depth, confidence,  std::uint8_t,  image,   depth, always,    "1", "0 to 255, by the noise and the certainty of the cycle") \
  row(amplitude_by_frequency_e, depth, amplitude_by_frequency_e, float, by_frequency, depth, asked,     "e", "amplitude of each modulation frequency; asked") \
  row(range_by_frequency_m, depth, range_by_frequency_m, float, by_frequency, depth, asked,     "m", "range by each modulation frequency alone, in the cycle of cycle_by_frequency; asked") \
  row(cycle_by_frequency, depth, cycle_by_frequency, std::int32_t, by_frequency, depth, asked,     "1", "whole cycles that unwrapping added, or -1; asked") \
  row(flags,       depth, flags,       std::uint16_t, image,   depth, always,    "1", "bits of Flag: why a depth is invalid, and warnings")

/// Ground truth at the middle of the middle raw frame, and the power of the camera's illumination.
#define TOFRAY_TRUTH_ARRAYS(row) \
  /*  name                 part   member            element       shape    stage  when unit         what it is */ \
  row(gt_range_m,          truth, range_m,          float,        image,   trace, always,    "m",         "range along the pixel's ray") \
  row(gt_z_m,              truth, z_m,              float,        image,   trace, always,    "m",         "depth along the optical axis") \
  row(gt_reflectivity,     truth, reflectivity,     float,        image,   trace, always,    "1",         "albedo (Phong: diffuse + specular)") \
  row(gt_position_m,       truth, position_m,       float,        vectors, trace, always,    "m",         "x, y, z of the surface point") \
  row(gt_normal,           truth, normal,           float,        vectors, trace, always,    "1",         "unit normal, toward the camera") \
  row(gt_object_id,        truth, object_id,        std::int32_t, image,   trace, always,    "1",         "instance: index in Scene::objects, or -1") \
  row(gt_material_id,      truth, material_id,      std::int32_t, image,   trace, always,    "1",         "index in Scene::materials, or -1") \
  row(gt_class_id,         truth, class_id,         std::int32_t, image,   trace, asked,     "1",         "class of the object: index in Scene::classes, or -1; asked") \
  row(gt_triangle_id,      truth, triangle_id,      std::int32_t, image,   trace, always,    "1",         "face: index in mesh triangles, or -1") \
  row(gt_texcoord,         truth, texcoord,         float,        pairs,   trace, always,    "1",         "u, v of TriangleMesh::texcoords, v down the picture, or NaN") \
  row(gt_velocity_m_per_s, truth, velocity_m_per_s, float,        vectors, trace, always,    "m/s",       "scene flow: velocity of the point, camera frame") \
  row(gt_flow_px,          truth, flow_px,          float,        pairs,   trace, always,    "px",        "u, v: optical flow to one frame later") \
  row(gt_mixed,            truth, mixed,            std::uint8_t, image,   trace, samples,   "1",         "the pixel sees several objects or > 5 cm of range; sub-pixel samples") \
  row(gt_object_share,     truth, object_share,     float,        image,   trace, samples,   "1",         "share of the pixel that sees gt_object_id; sub-pixel samples") \
  row(gt_irradiance_w_m2,  truth, irradiance_w_m2,  float,        image,   power, always,    "W/m2",      "irradiance of the surface by the camera's illumination") \
  row(gt_radiance_w_m2_sr, truth, radiance_w_m2_sr, float,        image,   power, always,    "W/(m2 sr)", "radiance toward the camera by the camera's illumination") \
  row(gt_power_w,          truth, power_w,          float,        image,   power, always,    "W",         "power on the pixel by the camera's illumination") \
  row(gt_ambient_e_per_s,  truth, ambient_e_per_s,  float,        image,   power, always,    "e/s",       "ambient light on the pixel, both taps") \
  row(gt_signal_e,         truth, signal_e,         float,        stack,   raw, always,    "e",         "expected electrons by the camera's illumination, both taps, 0 unlit") \
  row(gt_direct_e,         truth, direct_e,         float,        stack,   raw, bounces,   "e",         "expected electrons by one surface alone, before lens scatter; bounces") \
  row(gt_indirect_e,       truth, indirect_e,       float,        stack,   raw, bounces,   "e",         "expected electrons by several surfaces, before lens scatter; bounces") \
  row(gt_raw_dn,           truth, raw_dn,           float,        stack,   raw,   asked,     "DN",      "raw without noise, before rounding; asked") \
  row(gt_raw_direct_dn,    truth, raw_direct_dn,    float,        stack,   raw,   asked,     "DN",      "raw without noise and of light by one surface alone, before rounding and lens scatter; bounces, asked") \
  row(gt_phase_flow_px,    truth, phase_flow_px,    float,        moved,   trace, asked,     "px",      "u, v: optical flow from each raw frame to gt_time_s; asked") \
  row(gt_multipath_m,      truth, multipath_m,      float,        stack,   raw, bounces,   "m",         "half path of all light less that of direct light, NaN unlit; bounces") \
  row(gt_path_noise_m,     truth, path_noise_m,     float,        stack,   raw, bounces,   "m",         "standard error of gt_multipath_m; bounces") \
  row(gt_path_count,       truth, path_count,       std::int32_t, image,   raw, bounces,   "1",         "light paths that were followed (Monte Carlo samples); bounces") \
  row(transient_e_per_s,   truth, transient_e_per_s,   float,   bins,    power, transient, "e/s",       "light of the camera's illumination by path length, before lens scatter; transient") \
  row(transient_lost_e_per_s, truth, transient_lost_e_per_s, float, image, power, transient, "e/s",     "light of the camera's illumination outside all bins; transient")

// clang-format on

/// Arrays that kernels write.
#define TOFRAY_IMAGE_ARRAYS(row) TOFRAY_RAW_ARRAYS(row) TOFRAY_DEPTH_ARRAYS(row) TOFRAY_TRUTH_ARRAYS(row)
/// All, in the order of frame.npz.
#define TOFRAY_FRAME_ARRAYS(row) TOFRAY_RAW_ARRAYS(row) TOFRAY_EXPOSURE_ARRAYS(row) TOFRAY_DEPTH_ARRAYS(row) TOFRAY_TRUTH_ARRAYS(row)

}  // namespace tofray
