// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "files/json.h"
#include "tofray/sweep.h"

/// A sweep as files: sweep.csv, sweep.npz, manifest.json.
namespace tofray::sweeps {

/// A line for each cell and region: the axes' values (numbers in SI, their unit in the header), the region, the metrics; what is unknown is empty.
std::string csv_text(const Sweep& sweep);
/// `axes` (their keys), the values of each under its key (float64 in SI, or text), `regions`, `metrics`, of each metric an array
/// [axis 0][axis 1]…[region], and `meta`, as JSON: units, stages, frames of each cell, version.
std::string npz_bytes(const Sweep& sweep);
/// Axes, metrics and values, as --json prints them.
files::Json json_of(const Sweep& sweep);

}  // namespace tofray::sweeps
