// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/checks.h"

#include "base/limits.h"
#include "base/text.h"
#include "model/check.h"
#include "simulator/check.h"

namespace tofray::simulator {

void refuse(const std::string& what, const std::string& more, ErrorKind kind) { throw Error(kind, "error: " + what + "\n  " + more); }

void within(double value, const base::Range& range, const std::string& path) {
  if (range.contains(value)) return;
  refuse(path + " is out of range",
         "got " + base::number_text(value) + ", expected " + base::number_text(range.low) + " to " + base::number_text(range.high));
}

void check(const Camera& camera) { model::check_in_code(camera); }

void check(const Scene& scene) { model::check_in_code(scene); }

void check(std::span<const FrameRequest> requests) {
  for (std::size_t i = 0; i < requests.size(); ++i) {
    if (requests[i].pose) model::check_in_code(*requests[i].pose, "requests[" + std::to_string(i) + "].pose");
  }
}

void check(const SimulatorOptions& options) {
  const std::int64_t most = base::limit::threads.value;
  if (options.threads > most)
    refuse("too many threads", "got " + std::to_string(options.threads) + ", at most " + std::to_string(most), ErrorKind::limit);
  within(options.exposure_samples, {1, 1000}, "exposure_samples");
}

}  // namespace tofray::simulator
