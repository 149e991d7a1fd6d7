// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "cli/options.h"
#include "cli/remarks.h"
#include "files/json.h"
#include "tofray/analysis.h"
#include "tofray/run.h"

/// What demo, render and process leave behind.
namespace tofray::app {

/// "600 of 616 pixels have a depth; invalid: 16 dark", a line; those that the truth knows to be whole cycles off are none of them.
/// @param which  behind "pixels ": "of the last frame ", or nothing
std::string depth_text(const Validity& of, const char* which);
/// Name of each bit of Depth::flags, from bit 0.
const std::vector<std::string>& flag_names();
/// Names of the bits that are set.
std::vector<std::string> names_of_flags(unsigned flags);

/// The GPU's name; empty where the processor computed.
std::string gpu_of(const RanOn& machine);
/// "avx512 on 2 threads", "NVIDIA H200".
std::string machine_text(const RanOn& machine);

/// One line on stderr where the backend was left to choose and no GPU is used: if `auto` was typed, or if there is a GPU all the same.
void say_fallback(const Options& options, const RanOn& machine, Remarks& remarks);

/// How a run went, for --json and for people.
/// @param remarks  the warnings and notes that were said
files::Json summary_json(const RunResult& result, const Remarks& remarks);
/// Which picture to look at, on a line of its own; nothing where there is none.
std::string picture_to_open(const RunResult& result);
std::string summary_text(const RunResult& result);
/// How long all of it took [s].
double total_time(const RunResult& result);

}  // namespace tofray::app
