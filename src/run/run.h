// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "files/output_folder.h"
#include "run/earlier_files.h"
#include "run/inputs.h"
#include "run/stopwatch.h"
#include "tofray/run.h"

namespace tofray::run {

/// Which kinds of files a run of so many frames writes: unless told, all for one frame, npz for many.
std::vector<std::string> kinds_of(const FrameFileRequest& request, std::uint64_t frames);

/// Scene and camera, ready, to the files of a folder. @param from  what the run started from, with a stopwatch that began there
RunResult perform(const RunRequest& request, const Loaded& in, const RunWatch& watch, Stopwatch& stopwatch);

/// Writes manifest.json, last of all: what made the other files.
/// @param result  the run; knows its files, machine and times afterwards, and is told what lay in the folder before
void finish(const RunRequest& request, const std::vector<InputFile>& inputs, files::OutputFolder& folder, const EarlierFiles& left,
            const Stopwatch& stopwatch, RunResult& result);

}  // namespace tofray::run
