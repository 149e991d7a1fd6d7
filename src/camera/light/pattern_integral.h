// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

/// How much light a pattern of the peak or the samples given sends out in all: ∫ dω of the very function that kernels evaluate
/// (power/light_source.h), dω = (sin θ/θ)·dθx dθy within its rectangle and θ <= π [sr · unit of the samples].  [theory: table-angles]
namespace tofray::camera {

/// Of a table: bilinear between cell centres, clamped in the outer half cell. Right to 1e-5, however wide, narrow or coarse it is.
/// @param samples  [rows][columns]
double table_integral(const std::vector<double>& samples, int columns, int rows, double half_range_x_rad, double half_range_y_rad);

/// A flat top's fall-off along one of its axes, exp(−ln2·u⁸), u = 2θx/w or 2θy/h.                        [theory: flat-top]
double flat_top_share(double u);

/// Of exp(−ln2·((2θx/w)⁸ + (2θy/h)⁸)). Right to 1e-5.                                                  [theory: flat-top]
double flat_top_integral(double width_rad, double height_rad, double half_range_x_rad, double half_range_y_rad);

}  // namespace tofray::camera
