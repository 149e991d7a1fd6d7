// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "energy/meter.h"
#include "files/json.h"

namespace tofray::app {

/// What one frame takes out of one counter.
struct FrameEnergy {
  double joules = 0;   ///< NaN where it cannot be read
  std::string what;    ///< what the counter counts: "package-0", the GPU's name
  std::string reason;  ///< why it cannot be read; empty where it can
};

/// Joules per frame of everything that takes part.
struct Energy {
  FrameEnergy cpu, gpu;
  bool with_gpu = false;
};

/// Simulates one time after the other for a while and divides what the counters say by the number of frames. What the machine takes when
/// it does nothing is in it, and so is all else that runs meanwhile. Returns at once where nothing can be read.
/// @param gpu      a null pointer where no GPU takes part
/// @param seconds  how long at least; so long, too, that there are ten calls
/// @param frames   that one call of `simulate` is
Energy energy_per_frame(energy::Meter& cpu, energy::Meter* gpu, double seconds, std::uint64_t frames,
                        const std::function<void()>& simulate);

/// Energy per frame by this machine's counters, for as long as they need: RAPL's move every millisecond, NVML's every 20 to 100 ms.
/// @param gpu_bus_id  which GPU takes part; empty: none
/// @param frames      that one call of `simulate` is
Energy energy_per_frame(const std::string& gpu_bus_id, std::uint64_t frames, const std::function<void()>& simulate);

/// {"cpu_j_per_frame", "cpu_counter", "cpu_not_readable"} and the same for the GPU where one takes part; what is not there is null.
files::Json energy_json(const Energy& energy);

/// What energy_json gave, for people: "CPU 0.0123 J (package-0); GPU not readable here: …".
std::string energy_text(const files::Json& energy);

}  // namespace tofray::app
