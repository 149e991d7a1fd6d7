// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "base/limits.h"
#include "model/row.h"

/// The tables of all public structs: camera_table.cpp, light_table.cpp, scene_table.cpp, shape_table.cpp.
namespace tofray::model {

/// Shares of light, and how shiny a surface can be.
inline constexpr base::Range share{0, 1}, phong_exponent{1, 1e4};

/// What files say of a camera in two places.
inline constexpr Number sensor_side{base::Dimension::none, {1, static_cast<double>(base::limit::sensor_side.value)}, "224"};
inline constexpr Number integration_time{base::Dimension::time, {1e-9, 1e3}, "2000 us"},
    frame_rate{base::Dimension::frequency, {1e-4, 1e5}, "5 Hz"};

/// What files say of places and directions.
inline constexpr Number coordinate{base::Dimension::length, {-base::farthest_m, base::farthest_m}, "0.5 m", true};
inline constexpr Number component{base::Dimension::none, {-1e6, 1e6}, "1"};

/// What files call the shapes, in the order of the variant Object::shape.
const std::vector<std::string>& names_of_shapes();

/// What files may say of a struct.
ValueForm form_of(const Table& table);
/// Its keys: all of them, or those of one kind.
constexpr int all_kinds = -1;
std::vector<Key> keys_of(const Table& table, int kind = all_kinds);

template <>
const Table& table_of<Sensor>();
template <>
const Table& table_of<Lens>();
template <>
const Table& table_of<Filter>();
template <>
const Table& table_of<Pattern>();
template <>
const Table& table_of<Waveform>();
template <>
const Table& table_of<Area>();
template <>
const Table& table_of<Illumination>();
template <>
const Table& table_of<Pixel>();
template <>
const Table& table_of<Adc>();
template <>
const Table& table_of<RawFrame>();
template <>
const Table& table_of<Mode>();
template <>
const Table& table_of<PixelMask>();
template <>
const Table& table_of<Scatter>();
template <>
const Table& table_of<ImageFilter>();
template <>
const Table& table_of<FrequencyCalibration>();
template <>
const Table& table_of<DecoderCalibration>();
template <>
const Table& table_of<Decoding>();
template <>
const Table& table_of<Temperature>();
template <>
const Table& table_of<Interference>();
template <>
const Table& table_of<Calibration>();
template <>
const Table& table_of<SpreadSpectrum>();
template <>
const Table& table_of<Readout>();
template <>
const Table& table_of<AutoExposure>();
template <>
const Table& table_of<Camera>();

template <>
const Table& table_of<Material>();
template <>
const Table& table_of<Mesh>();  // those of other shapes are in tables_of_shapes()
template <>
const Table& table_of<Rotation>();
template <>
const Table& table_of<Object>();
template <>
const Table& table_of<Ambient>();
template <>
const Table& table_of<TransientBins>();
template <>
const Table& table_of<Transport>();
template <>
const Table& table_of<Pose>();
template <>
const Table& table_of<Keyframe>();
template <>
const Table& table_of<CameraKeyframe>();
template <>
const Table& table_of<CameraChoice>();
template <>
const Table& table_of<Scene>();

}  // namespace tofray::model
